use nalgebra::{Vector3, vector};

use super::dead_wrench::dead;
use super::{Load, LoadWrench};
use crate::body::{HasMass, LineMass};
use crate::error::{Result, finite};
use crate::lie::{Pose, so3::hat};

/// Weight: per length of the reference, the force of gravity on its mass, through the centre of that mass.
///
/// In the body frame, with mass per length μ and its first moments μ r_c in the section,
///
/// ```math
/// n = \mu\, R^{\mathsf T} g, \qquad m = \mu r_c \times R^{\mathsf T} g, \qquad V = -g \cdot (\mu\, p + R\, \mu r_c) .
/// ```
///
/// A section whose centroid is on the axis, about a straight reference, has μ = ρA and m = 0.
///
/// It acts on bodies that [have a mass](HasMass); on one without, a scene does not compile:
///
/// ```compile_fail
/// # use hyperrod::{Body, Pose, Rod, load::Gravity, section::Stiffness};
/// # let section = Stiffness::diagonal([1.0; 6]).unwrap();
/// let body = Body::new(1.0, section).unwrap(); // no mass
/// let rod = Rod::clamped(body, Pose::identity()).with_load(Gravity::standard());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    acceleration: Vector3<f64>,
}

impl Gravity {
    /// With the given acceleration in space, m/s².
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn new(acceleration: Vector3<f64>) -> Result<Self> {
        finite("component of the acceleration of gravity", &acceleration)?;
        Ok(Self { acceleration })
    }

    /// On Earth, along −Z: 9.80665 m/s² (ISO 80000-3).
    pub fn standard() -> Self {
        Self { acceleration: vector![0.0, 0.0, -9.80665] }
    }
}

impl<B: HasMass> Load<B> for Gravity {
    fn at(&self, body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        let LineMass { mass, first: [x, y] } = body.line_mass(s)?;
        let force = self.acceleration * mass;
        let (mut wrench, mut tangent) = dead(pose, &Vector3::zeros(), &force);
        let mut potential = -force.dot(&pose.position);
        let first = vector![x, y, 0.0];
        if first != Vector3::zeros() {
            let acceleration = pose.rotation.tr_mul(&self.acceleration);
            wrench.moment += first.cross(&acceleration);
            // δ(Rᵀg) = (Rᵀg) × w
            let moment_tangent = hat(&first) * hat(&acceleration);
            tangent.fixed_view_mut::<3, 3>(0, 0).copy_from(&moment_tangent);
            potential -= first.dot(&acceleration);
        }
        Ok(LoadWrench { wrench, tangent, potential: Some(potential) })
    }

    fn dead_force(&self, body: &B, s: f64) -> Result<Option<Vector3<f64>>> {
        let LineMass { mass, first } = body.line_mass(s)?;
        Ok((first == [0.0; 2]).then(|| self.acceleration * mass))
    }
}
