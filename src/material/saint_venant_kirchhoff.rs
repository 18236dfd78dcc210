use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive};
use crate::scalar::Scalar;

/// Saint-Venant–Kirchhoff, quadratic in the Green strain E = (FᵀF − I)/2: u = λ/2 (tr E)² + μ E:E.
///
/// With i = I₁ − 3 it is
///
/// ```math
/// \operatorname{tr} E = \tfrac{i}{2}, \qquad
/// E : E = \tfrac14 \operatorname{tr}(C - I)^2 = \tfrac14 i^2 + \bigl(I_1 - 3 - 2(J-1)\bigr) - \tfrac12 \bigl(I_2 - 3 - 4(J-1)\bigr),
/// ```
///
/// of degree 4 in the strain. Free of stress at rest; shear modulus μ, axial modulus of a section that cannot contract λ + 2μ.
/// For large rotations with small strains only: it **softens in compression**, loses stability at a stretch of √(1/3) = 0.577 and lets J
/// reach zero at no cost.
///
/// Source: Ciarlet (1988), *Mathematical Elasticity I*, sec. 3.9.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaintVenantKirchhoff {
    mu: f64,
    lambda: f64,
}

impl SaintVenantKirchhoff {
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

impl Isotropic for SaintVenantKirchhoff {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let trace_squared = i.i1() * i.i1() * 0.25;
        let squares = trace_squared + i.i1_excess() - i.i2_excess() * 0.5;
        trace_squared * (0.5 * self.lambda) + squares * self.mu
    }

    fn degree(&self) -> Option<usize> {
        Some(4)
    }

    fn is_uniform(&self) -> bool {
        true
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite"
    }
}
