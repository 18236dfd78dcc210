use nalgebra::{Matrix3, Matrix6, Vector3};

use super::dead_wrench::dead;
use super::{LoadWrench, TipLoad};
use crate::error::{Result, finite, not_negative, require};
use crate::lie::{Pose, so3::hat};

/// A rigid body fixed to a section: its weight, through its centre of mass, and in motion its inertia.
///
/// With the mass M, its centre r and the moments of inertia J about that, in the frame of the section, the weight and the matrix N of the
/// body's momentum N η are
///
/// ```math
/// n = M R^{\mathsf T} g, \qquad m = r \times n, \qquad V = -M g \cdot (p + R r), \qquad
/// N = \begin{bmatrix} J - M \hat r \hat r & M \hat r \\ -M \hat r & M \end{bmatrix} .
/// ```
///
/// A rod in [motion](crate::solve::dynamics) feels its inertia wherever it is put: at the tip, between, or on a base that can move.
///
/// ```
/// use hyperrod::load::Payload;
/// use nalgebra::{Matrix3, vector};
/// # fn main() -> hyperrod::Result<()> {
/// // 50 g, 4 cm beyond the tip
/// let tool = Payload::new(0.050)?.with_centre(vector![0.0, 0.0, 0.04])?;
/// // in motion: a ball of 2 cm, 2/5 M r² about its centre
/// let ball = tool.with_inertia(Matrix3::identity() * 0.4 * 0.050 * 0.02 * 0.02)?;
/// # let _ = ball; Ok(()) }
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
        not_negative("mass of a payload", mass)?;
        let (centre, gravity) = (Vector3::zeros(), Vector3::new(0.0, 0.0, -9.80665));
        Ok(Self { mass, centre, moments: Matrix3::zeros(), gravity })
    }

    /// The same with moments of inertia about its centre of mass, in the frame of the section, kg m². They count in motion alone.
    ///
    /// # Errors
    /// If the matrix is not finite, not symmetric, or has a negative principal moment.
    pub fn with_inertia(self, moments: Matrix3<f64>) -> Result<Self> {
        let quantity = "inertia of a payload";
        finite(quantity, &moments)?;
        let size = moments.norm();
        let skew = (moments - moments.transpose()).norm();
        require(skew <= 1e-12 * size, quantity, skew, "symmetric")?;
        let least = moments.symmetric_eigenvalues().min();
        require(least >= -1e-12 * size, quantity, least, "without a negative principal moment")?;
        Ok(Self { moments, ..self })
    }

    /// The same with its centre of mass at a place in the frame of the section, m.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn with_centre(self, centre: Vector3<f64>) -> Result<Self> {
        finite("component of the centre of a payload", &centre)?;
        Ok(Self { centre, ..self })
    }

    /// The same under another acceleration of gravity in space, m/s².
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn with_gravity(self, acceleration: Vector3<f64>) -> Result<Self> {
        finite("component of the acceleration of gravity", &acceleration)?;
        Ok(Self { gravity: acceleration, ..self })
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
