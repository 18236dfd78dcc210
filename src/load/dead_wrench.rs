use nalgebra::{ArrayStorage, Matrix6, Vector3};

use super::{LoadWrench, TipLoad};
use crate::error::{Result, finite};
use crate::lie::{Pose, Wrench};

/// A moment and a force with fixed direction and size in space: a hanging weight, a pull along a line.
///
/// In body frame (Rᵀ m, Rᵀ n). A dead moment has no potential: it does different work along different paths.
///
/// ```
/// use hyperrod::load::DeadWrench;
/// use nalgebra::vector;
/// # fn main() -> hyperrod::Result<()> {
/// let weight = DeadWrench::force(vector![0.0, 0.0, -9.81 * 0.020])?;
/// # let _ = weight; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadWrench {
    moment: Vector3<f64>,
    force: Vector3<f64>,
}

impl DeadWrench {
    /// A moment, N m, and a force, N, in space.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn new(moment: Vector3<f64>, force: Vector3<f64>) -> Result<Self> {
        finite("component of a dead wrench", moment.iter().chain(&force))?;
        Ok(Self { moment, force })
    }

    /// A force alone, N.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn force(force: Vector3<f64>) -> Result<Self> {
        Self::new(Vector3::zeros(), force)
    }

    /// A moment alone, N m.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn moment(moment: Vector3<f64>) -> Result<Self> {
        Self::new(moment, Vector3::zeros())
    }
}

/// A vector v fixed in space seen from a frame that turns by ζ = (w, ·): δ(Rᵀ v) = (Rᵀ v) × w.
#[inline(always)]
pub(super) fn dead(pose: &Pose, moment: &Vector3<f64>, force: &Vector3<f64>) -> (Wrench, Matrix6<f64>) {
    let wrench = Wrench::new(pose.rotation.tr_mul(moment), pose.rotation.tr_mul(force));
    let ([l, m, n, x, y, z], o) = (wrench.to_array(), 0.0);
    let columns = [[o, n, -m, o, z, -y], [-n, o, l, -z, o, x], [m, -l, o, y, -x, o], [o; 6], [o; 6], [o; 6]];
    (wrench, Matrix6::from_array_storage(ArrayStorage(columns)))
}

impl TipLoad for DeadWrench {
    fn at(&self, pose: &Pose) -> Result<LoadWrench> {
        let (wrench, tangent) = dead(pose, &self.moment, &self.force);
        let conservative = self.moment == Vector3::zeros();
        let potential = conservative.then(|| -self.force.dot(&pose.position));
        Ok(LoadWrench { wrench, tangent, potential })
    }
}
