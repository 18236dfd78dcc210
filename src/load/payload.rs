use nalgebra::{Matrix3, Matrix6, Vector3};

use super::dead_wrench::dead;
use super::{LoadWrench, TipLoad};
use crate::error::{Error, Result};
use crate::lie::{Pose, so3::hat};

/// A rigid body fixed to a section: its weight, through its centre of mass, and in motion its inertia.
///
/// With the mass M, its centre r and the moments of inertia J about that, in the frame of the section, the weight g M and the matrix 𝓜 of
/// the body's momentum 𝓜 η are
///
/// ```math
/// n = M R^{\mathsf T} g, \qquad m = r \times n, \qquad V = -M g \cdot (p + R r), \qquad
/// \mathcal M = \begin{bmatrix} J - M \hat r \hat r & M \hat r \\ -M \hat r & M \end{bmatrix} .
/// ```
///
/// It is a load, and brings no inertia: exact at rest, but a rod in [motion](crate::solve::dynamics) swings as if the body at its tip had a
/// weight and no mass.
///
/// ```
/// use hyperrod::load::Payload;
/// use nalgebra::vector;
/// # fn main() -> hyperrod::Result<()> {
/// // 50 g, 4 cm beyond the tip
/// let tool = Payload::new(0.050)?.with_centre(vector![0.0, 0.0, 0.04])?;
/// # let _ = tool; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Payload {
    mass: f64,
    centre: Vector3<f64>,
    moments: Matrix3<f64>,
    gravity: Vector3<f64>,
}

impl Payload {
    /// A mass, kg, at a point on the axis of the rod, under standard gravity: 9.80665 m/s² along −Z.
    ///
    /// # Errors
    /// If the mass is negative or not finite.
    pub fn new(mass: f64) -> Result<Self> {
        if !(mass >= 0.0 && mass.is_finite()) {
            let quantity = "mass of a payload";
            return Err(Error::Invalid { quantity, value: mass, requirement: "zero or more, and finite" });
        }
        let (centre, gravity) = (Vector3::zeros(), Vector3::new(0.0, 0.0, -9.80665));
        Ok(Self { mass, centre, moments: Matrix3::zeros(), gravity })
    }

    /// The same with moments of inertia about its centre of mass, in the frame of the section, kg m². They count in motion alone.
    ///
    /// # Errors
    /// If the matrix is not finite, not symmetric, or has a negative principal moment.
    pub fn with_inertia(self, moments: Matrix3<f64>) -> Result<Self> {
        let invalid =
            |value, requirement| Err(Error::Invalid { quantity: "inertia of a payload", value, requirement });
        if let Some(&value) = moments.iter().find(|value| !value.is_finite()) {
            return invalid(value, "finite");
        }
        let size = moments.norm();
        let skew = (moments - moments.transpose()).norm();
        if skew > 1e-12 * size {
            return invalid(skew, "symmetric");
        }
        let least = moments.symmetric_eigenvalues().min();
        if least < -1e-12 * size {
            return invalid(least, "without a negative principal moment");
        }
        Ok(Self { moments, ..self })
    }

    /// The same with its centre of mass at a place in the frame of the section, m.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn with_centre(self, centre: Vector3<f64>) -> Result<Self> {
        Ok(Self { centre: finite("component of the centre of a payload", centre)?, ..self })
    }

    /// The same under another acceleration of gravity in space, m/s².
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn with_gravity(self, acceleration: Vector3<f64>) -> Result<Self> {
        Ok(Self { gravity: finite("component of the acceleration of gravity", acceleration)?, ..self })
    }
}

fn finite(quantity: &'static str, v: Vector3<f64>) -> Result<Vector3<f64>> {
    match v.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(Error::Invalid { quantity, value, requirement: "finite" }),
        None => Ok(v),
    }
}

impl TipLoad for Payload {
    fn at(&self, pose: &Pose) -> Result<LoadWrench> {
        let weight = self.gravity * self.mass;
        let (mut wrench, mut tangent) = dead(pose, &Vector3::zeros(), &weight);
        wrench.moment = self.centre.cross(&wrench.force);
        // δ(r × n) = r × (n × w)
        tangent.fixed_view_mut::<3, 3>(0, 0).copy_from(&(hat(&self.centre) * hat(&wrench.force)));
        let potential = Some(-weight.dot(&pose.transform_point(&self.centre)));
        Ok(LoadWrench { wrench, tangent, potential })
    }

    fn inertia(&self) -> Option<Matrix6<f64>> {
        let first = hat(&self.centre) * self.mass;
        let mut matrix = Matrix6::identity() * self.mass;
        let about_section = self.moments - hat(&self.centre) * first;
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&about_section);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&first);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&-first);
        Some(matrix)
    }
}
