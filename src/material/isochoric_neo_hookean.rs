use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive};
use crate::scalar::Scalar;

/// The other common compressible neo-Hookean law, u = μ/2 (Ī₁ − 3) + κ/2 (J − 1)², with Ī₁ = J^(−2/3) I₁.
///
/// Shape and volume are kept apart: μ resists distortion, κ resists the change of volume, as nearly incompressible rubber has it. Free of
/// stress at rest; shear modulus μ, bulk modulus κ, axial modulus of a section that cannot contract κ + 4μ/3. Defined
/// for J > 0. [`NeoHookean`](super::NeoHookean) is the one with ln J; the two agree for small strains when λ = κ − 2μ/3.
///
/// Source: Simo (1988), Comput. Methods Appl. Mech. Eng. 66, 199, with the quadratic volumetric part; in finite-element
/// codes C₁₀ = μ/2, D₁ = 2/κ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsochoricNeoHookean {
    mu: f64,
    kappa: f64,
}

impl IsochoricNeoHookean {
    /// From the shear modulus μ and the bulk modulus κ, Pa.
    ///
    /// # Errors
    /// If either is not positive and finite.
    pub fn new(mu: f64, kappa: f64) -> Result<Self> {
        positive("shear modulus mu", mu)?;
        positive("bulk modulus kappa", kappa)?;
        Ok(Self { mu, kappa })
    }
}

impl Isotropic for IsochoricNeoHookean {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        i.i1_isochoric() * (0.5 * self.mu) + i.j() * i.j() * (0.5 * self.kappa)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }
}
