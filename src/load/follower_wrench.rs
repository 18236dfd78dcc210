use nalgebra::{Matrix6, Vector3};

use super::{LoadWrench, TipLoad};
use crate::error::{Result, finite};
use crate::lie::{Pose, Wrench};

/// A moment and a force that turn with the section they act on: a thruster, a torque wrench.
///
/// It has no potential: it does different work along different paths.
///
/// ```
/// use hyperrod::load::FollowerWrench;
/// use nalgebra::vector;
/// # fn main() -> hyperrod::Result<()> {
/// let thruster = FollowerWrench::force(vector![0.0, 0.0, -4.0])?; // N, back along the rod's own axis
/// let key = FollowerWrench::moment(vector![0.0, 0.0, 0.3])?; // N m, twists the tip about that axis
/// # let _ = (thruster, key); Ok(()) }
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
        finite("component of a follower wrench", moment.iter().chain(&force))?;
        Ok(Self { wrench: Wrench::new(moment, force) })
    }

    /// A force alone, N, in the body frame.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn force(force: Vector3<f64>) -> Result<Self> {
        Self::new(Vector3::zeros(), force)
    }

    /// A moment alone, N m, in the body frame.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn moment(moment: Vector3<f64>) -> Result<Self> {
        Self::new(moment, Vector3::zeros())
    }
}

impl TipLoad for FollowerWrench {
    fn at(&self, _pose: &Pose) -> Result<LoadWrench> {
        Ok(LoadWrench { wrench: self.wrench, tangent: Matrix6::zeros(), potential: None })
    }
}
