use nalgebra::{Matrix6, Vector3};

use super::{LoadWrench, TipLoad};
use crate::error::{Error, Result};
use crate::lie::{Pose, Wrench};

/// A moment and a force that turn with the section they act on: a thruster, a torque wrench.
///
/// It has no potential: it does different work along different paths.
///
/// ```
/// use hyperrod::load::FollowerWrench;
/// use nalgebra::{Vector3, vector};
/// # fn main() -> hyperrod::Result<()> {
/// let thruster = FollowerWrench::new(Vector3::zeros(), vector![0.0, 0.0, -4.0])?; // back along the rod's own axis
/// # let _ = thruster; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowerWrench {
    wrench: Wrench,
}

impl FollowerWrench {
    /// A moment, N m, and a force, N, in the body frame.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn new(moment: Vector3<f64>, force: Vector3<f64>) -> Result<Self> {
        let wrench = Wrench::new(moment, force);
        match wrench.to_array().into_iter().find(|v| !v.is_finite()) {
            None => Ok(Self { wrench }),
            Some(value) => {
                let quantity = "component of a follower wrench";
                Err(Error::Invalid { quantity, value, requirement: "finite" })
            }
        }
    }
}

impl TipLoad for FollowerWrench {
    fn at(&self, _pose: &Pose) -> Result<LoadWrench> {
        Ok(LoadWrench { wrench: self.wrench, tangent: Matrix6::zeros(), potential: None })
    }
}
