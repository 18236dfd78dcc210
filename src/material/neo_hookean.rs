use super::compiled_here::compiled_here;
use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Error, Result, positive};
use crate::scalar::{Scalar, x_minus_ln_1p};

/// Compressible neo-Hookean law, u = μ/2 (I₁ − 3 − 2 ln J) + λ/2 (ln J)².
///
/// With s = a² + b² and e = J − 1 of a rigid section,
///
/// ```math
/// u = \tfrac{\mu}{2}\bigl(s + e^2 + 2\,(e - \ln(1+e))\bigr) + \tfrac{\lambda}{2}\ln^2(1+e),
/// ```
///
/// which is how it is evaluated: no term is linear in the strain, so the smallest strain keeps its digits. Small strains: shear
/// modulus μ, axial modulus of a section that cannot contract λ + 2μ. Defined for J > 0.
///
/// Source: Simo and Pister (1984), Comput. Methods Appl. Mech. Eng. 46, 201; Bonet and Wood (2008), Eq. (6.27).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    mu: f64,
    lambda: f64,
}

impl NeoHookean {
    /// From the Lamé constants μ and λ, Pa.
    ///
    /// # Errors
    /// If μ is not positive and finite, or λ + 2μ/3 (the bulk modulus) not positive and finite.
    pub fn new(mu: f64, lambda: f64) -> Result<Self> {
        let bulk = lambda + 2.0 / 3.0 * mu;
        for (quantity, value) in [("shear modulus mu", mu), ("bulk modulus lambda + 2 mu / 3", bulk)] {
            positive(quantity, value)?;
        }
        Ok(Self { mu, lambda })
    }

    /// From Young's modulus E, Pa, and Poisson's ratio ν of small strains.
    ///
    /// These are the constants of the *material*. On a rigid section, which cannot contract, the rod's axial modulus is then
    /// λ + 2μ = E(1−ν)/((1+ν)(1−2ν)), not E.
    ///
    /// # Errors
    /// If E is not positive and finite or ν not in (−1, ½).
    pub fn from_young(young: f64, poisson: f64) -> Result<Self> {
        if !(poisson > -1.0 && poisson < 0.5) {
            let quantity = "Poisson's ratio";
            return Err(Error::Invalid { quantity, value: poisson, requirement: "in (-1, 0.5)" });
        }
        let mu = young / (2.0 * (1.0 + poisson));
        Self::new(mu, 2.0 * mu * poisson / (1.0 - 2.0 * poisson))
    }
}

impl Isotropic for NeoHookean {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let ln_j = i.j().ln_1p();
        (i.i1_excess() + x_minus_ln_1p(i.j()) * 2.0) * (0.5 * self.mu) + ln_j * ln_j * (0.5 * self.lambda)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }

    compiled_here!(perform);
}
