use super::fibre_direction::FibreDirection;
use super::kinematics::{Deformation, Point};
use super::law::Local;
use crate::error::{Result, positive};
use crate::scalar::Scalar;

/// One family of exponential fibres that carry tension only.
///
/// ```math
/// u = \frac{k_1}{2k_2}\Bigl(e^{k_2 \varepsilon^2} - 1\Bigr) \ \text{ if } \varepsilon = I_4 - 1 > 0, \quad \text{else } 0, \qquad
/// I_4 - 1 = |F d|^2 - 1 = d_z\,(2\,d\cdot\gamma + d_z\,\gamma\cdot\gamma) .
/// ```
///
/// A fibre along the rod adds 4k₁ to the axial modulus in tension and nothing in compression. u and the stress are continuous where a
/// fibre goes slack, the tangent jumps; at ε = 0 exactly, as at rest, the tangent is that of the slack fibre. The kink also slows the
/// quadrature down: where part of a section is slack, expect second-order convergence in the point spacing, not spectral.
/// Uses the full I₄ and not its isochoric part, which would let fibres resist a change of volume
/// (Nolan et al. (2014), J. Mech. Behav. Biomed. Mater. 39, 48).
///
/// Source: Holzapfel, Gasser and Ogden (2000), J. Elasticity 61, 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibres<N> {
    direction: N,
    k1: f64,
    k2: f64,
}

impl<N: FibreDirection> Fibres<N> {
    /// From the direction, the stiffness k₁ in Pa and the exponent k₂.
    ///
    /// # Errors
    /// If k₁ or k₂ is not positive and finite.
    pub fn new(direction: N, k1: f64, k2: f64) -> Result<Self> {
        positive("fibre stiffness k1", k1)?;
        positive("fibre exponent k2", k2)?;
        Ok(Self { direction, k1, k2 })
    }
}

impl<N: FibreDirection> Local for Fibres<N> {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        let stretch = f.stretch_squared_minus_one(&self.direction.direction(at));
        if stretch <= 0.0 {
            return D::zero();
        }
        (stretch * stretch * self.k2).exp_m1() * (0.5 * self.k1 / self.k2)
    }

    fn domain(&self) -> &'static str {
        "finite, which needs a fibre direction and an exponential exp(k2 (I4 - 1)^2) that does not overflow"
    }
}
