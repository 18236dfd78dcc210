use super::kinematics::{Deformation, Point};
use super::law::Local;
use crate::error::{Result, positive};
use crate::scalar::Scalar;

/// Hencky's law, quadratic in the logarithmic strain: u = μ Σ (ln λᵢ)² + λ/2 (ln J)².
///
/// ```math
/// \sum_i (\ln \lambda_i)^2 = \tfrac12 (\ln J)^2 + 2\theta^2, \qquad \sinh^2\theta = \frac{(\lambda_+ - \lambda_-)^2}{4J}
/// ```
///
/// on a rigid section, whose stretches are 1 and λ±; smooth where they coalesce ([`Deformation::log_strain_squared`]). Free of
/// stress at rest; shear modulus μ, axial modulus of a section that cannot contract λ + 2μ. Defined for J > 0. It fits
/// metals and polymers up to stretches of about 0.7 to 1.3; beyond that it softens, and in tension the load has a maximum (at a
/// stretch of e = 2.718 where a section cannot contract).
///
/// Source: Hencky (1928), Z. Tech. Phys. 9, 215; Anand (1979), J. Appl. Mech. 46, 78.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hencky {
    mu: f64,
    lambda: f64,
}

impl Hencky {
    /// From the Lamé constants μ and λ, Pa.
    ///
    /// # Errors
    /// If μ or the bulk modulus λ + 2μ/3 is not positive and finite.
    pub fn new(mu: f64, lambda: f64) -> Result<Self> {
        positive("shear modulus mu", mu)?;
        positive("bulk modulus lambda + 2 mu / 3", lambda + 2.0 / 3.0 * mu)?;
        Ok(Self { mu, lambda })
    }
}

impl Local for Hencky {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, _at: &Point<D>) -> D {
        let ln_j = f.j().ln_1p();
        f.log_strain_squared() * self.mu + ln_j * ln_j * (0.5 * self.lambda)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }
}
