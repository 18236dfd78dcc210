use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive, require};
use crate::scalar::{Scalar, x_minus_ln_1p};

/// Gent's law of limited chain extensibility, u = −μJm/2 ln(1 − (I₁ − 3 − 2 ln J)/Jm) + λ/2 (ln J)².
///
/// The measure X = I₁ − 3 − 2 ln J of stretch is evaluated as
///
/// ```math
/// X = \bigl(I_1 - 3 - 2(J-1)\bigr) + 2\bigl((J-1) - \ln J\bigr) \ge 0,
/// ```
///
/// two terms of second order, so that nothing cancels. Shear modulus μ, axial modulus of a section that cannot contract λ + 2μ.
/// Defined for J > 0 and X < Jm; beyond that the section answers with an error. Jm → ∞ is [`NeoHookean`](super::NeoHookean).
///
/// ```
/// let skin = hyperrod::material::Gent::new(170e3, 400e3, 30.0)?;
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// Source: Gent (1996), Rubber Chem. Technol. 69, 59, made compressible with ln J as in Bonet and Wood (2008), Eq. (6.27).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gent {
    mu: f64,
    lambda: f64,
    limit: f64,
}

impl Gent {
    /// From the Lamé constants μ and λ, Pa, and the limit Jm of I₁ − 3 − 2 ln J.
    ///
    /// # Errors
    /// If μ, the bulk modulus λ + 2μ/3 or Jm is not positive and finite.
    pub fn new(mu: f64, lambda: f64, limit: f64) -> Result<Self> {
        positive("shear modulus mu", mu)?;
        positive("bulk modulus lambda + 2 mu / 3", lambda + 2.0 / 3.0 * mu)?;
        positive("Gent limit Jm", limit)?;
        require((mu * limit).is_finite(), "mu Jm", mu * limit, "finite")?;
        Ok(Self { mu, lambda, limit })
    }
}

impl Isotropic for Gent {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let stretch = i.i1_excess() + x_minus_ln_1p(i.j()) * 2.0;
        let ln_j = i.j().ln_1p();
        let chains = (-stretch / self.limit).ln_1p() * (-0.5 * self.mu * self.limit);
        chains + ln_j * ln_j * (0.5 * self.lambda)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0 and I1 - 3 - 2 ln J below the limit Jm"
    }
}
