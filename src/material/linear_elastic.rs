use super::compiled_here::compiled_here;
use super::kinematics::{Deformation, Point};
use super::law::Sectional;
use crate::error::{Error, Result, positive};
use crate::lie::Strain;
use crate::scalar::Scalar;

/// The classical rod law: each fibre in uniaxial stress, u = ½E e² + ½G(a² + b²).
///
/// ```math
/// \Psi = K\,\Delta\xi, \qquad K = \operatorname{diag}(E I_x, E I_y, G J, G A, G A, E A), \quad J = I_x + I_y
/// ```
///
/// about the principal axes through the centroid. It is written at section level and integrated over dA as it stands, also about a
/// curved reference, as the classical theory has it. Torsion and shear are those of a section that cannot warp: use a
/// [`Stiffness`](crate::section::Stiffness) where measured torsion constants or shear factors are to be typed in.
///
/// Source: Antman (2005), *Nonlinear Problems of Elasticity*, ch. 8; strains small, rotations large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearElastic {
    young: f64,
    shear: f64,
}

impl LinearElastic {
    /// From Young's modulus E and shear modulus G, Pa.
    ///
    /// # Errors
    /// If either is not positive and finite.
    pub fn new(young: f64, shear: f64) -> Result<Self> {
        for (quantity, value) in [("Young's modulus", young), ("shear modulus", shear)] {
            positive(quantity, value)?;
        }
        Ok(Self { young, shear })
    }

    /// From Young's modulus E, Pa, and Poisson's ratio ν: G = E / (2(1 + ν)).
    ///
    /// # Errors
    /// If E is not positive and finite or ν not in (−1, ½].
    pub fn from_poisson(young: f64, poisson: f64) -> Result<Self> {
        if !(poisson > -1.0 && poisson <= 0.5) {
            let quantity = "Poisson's ratio";
            return Err(Error::Invalid { quantity, value: poisson, requirement: "in (-1, 0.5]" });
        }
        Self::new(young, young / (2.0 * (1.0 + poisson)))
    }
}

impl Sectional for LinearElastic {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, strain: &Strain<D>, at: &Point<D>) -> D {
        let gamma = Deformation::of(strain, at).gamma();
        (gamma.x * gamma.x + gamma.y * gamma.y) * (0.5 * self.shear) + gamma.z * gamma.z * (0.5 * self.young)
    }

    fn degree(&self) -> Option<usize> {
        Some(2)
    }

    fn is_uniform(&self) -> bool {
        true
    }

    compiled_here!(perform_sectional);
}
