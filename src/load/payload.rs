use nalgebra::Vector3;

use super::dead_wrench::dead;
use super::{LoadWrench, TipLoad};
use crate::error::{Error, Result};
use crate::lie::{Pose, so3::hat};

/// A rigid body fixed to a section: its weight, through its centre of mass.
///
/// With the mass M and its centre r in the frame of the section,
///
/// ```math
/// n = M R^{\mathsf T} g, \qquad m = r \times n, \qquad V = -M g \cdot (p + R r) .
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
    gravity: Vector3<f64>,
}

impl Payload {
    /// A mass, kg, on the axis of the rod, under standard gravity: 9.80665 m/s² along −Z.
    ///
    /// # Errors
    /// If the mass is not positive and finite.
    pub fn new(mass: f64) -> Result<Self> {
        if !(mass > 0.0 && mass.is_finite()) {
            let quantity = "mass of a payload";
            return Err(Error::Invalid { quantity, value: mass, requirement: "positive and finite" });
        }
        Ok(Self { mass, centre: Vector3::zeros(), gravity: Vector3::new(0.0, 0.0, -9.80665) })
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
}
