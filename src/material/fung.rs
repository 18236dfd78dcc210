use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive};
use crate::scalar::Scalar;

/// The exponential law of soft tissue, u = μ/2b (exp(b(Ī₁ − 3)) − 1) + κ/2 (J − 1)².
///
/// Free of stress at rest; shear modulus μ, bulk modulus κ, axial modulus of a section that cannot contract κ + 4μ/3. b is how fast it
/// stiffens; b → 0 is [`IsochoricNeoHookean`](super::IsochoricNeoHookean). Defined for J > 0; where the exponential overflows
/// (b(Ī₁ − 3) above 700) the section answers with an error.
///
/// Source: Fung (1967), Am. J. Physiol. 213, 1532; as an isotropic energy Demiray (1972), J. Biomech. 5, 309.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fung {
    mu: f64,
    kappa: f64,
    stiffening: f64,
}

impl Fung {
    /// From the shear modulus μ and the bulk modulus κ, Pa, and the exponent b.
    ///
    /// # Errors
    /// If one is not positive and finite.
    pub fn new(mu: f64, kappa: f64, stiffening: f64) -> Result<Self> {
        positive("shear modulus mu", mu)?;
        positive("bulk modulus kappa", kappa)?;
        positive("Fung exponent b", stiffening)?;
        Ok(Self { mu, kappa, stiffening })
    }
}

impl Isotropic for Fung {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let growth = (i.i1_isochoric() * self.stiffening).exp_m1();
        growth * (0.5 * self.mu / self.stiffening) + i.j() * i.j() * (0.5 * self.kappa)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0 and an exponential exp(b (I1 - 3)) that does not overflow"
    }
}
