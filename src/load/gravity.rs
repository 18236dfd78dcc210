use nalgebra::{Vector3, vector};

use super::dead_wrench::dead;
use super::{Load, LoadWrench};
use crate::body::HasMass;
use crate::error::{Error, Result};
use crate::lie::Pose;

/// Weight: the force ρA g per length of the reference, through the axis of the rod.
///
/// It acts on bodies that [have a mass](HasMass); on one without, a scene does not compile:
///
/// ```compile_fail
/// # use hyperrod::{Body, Pose, Rod, load::Gravity, section::Stiffness};
/// # let section = Stiffness::diagonal([1.0; 6]).unwrap();
/// let body = Body::new(1.0, section).unwrap(); // no mass
/// let rod = Rod::clamped(body, Pose::identity()).with_load(Gravity::standard());
/// ```
///
/// For a section whose centroid is off the axis the moment of the weight about the axis is not included.
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
        for &value in &acceleration {
            if !value.is_finite() {
                let quantity = "component of the acceleration of gravity";
                return Err(Error::Invalid { quantity, value, requirement: "finite" });
            }
        }
        Ok(Self { acceleration })
    }

    /// On Earth, along −Z: 9.80665 m/s² (ISO 80000-3).
    pub fn standard() -> Self {
        Self { acceleration: vector![0.0, 0.0, -9.80665] }
    }
}

impl<B: HasMass> Load<B> for Gravity {
    fn at(&self, body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        let force = self.acceleration * body.mass_per_length(s)?;
        let (wrench, tangent) = dead(pose, &Vector3::zeros(), &force);
        Ok(LoadWrench { wrench, tangent, potential: Some(-force.dot(&pose.position)) })
    }
}
