use nalgebra::{Matrix3, Vector3};

use super::dead_wrench::dead;
use super::{Load, LoadWrench};
use crate::error::{Result, not_negative};
use crate::lie::Pose;

/// Springs along the rod that pull every section back to its place at rest: a bed of soil, a sheath (Winkler's foundation).
///
/// ```math
/// f = -k\,(p - p_0(s)) \quad\text{per length of the reference, in space}, \qquad V = \tfrac12 (p - p_0) \cdot k\,(p - p_0)
/// ```
///
/// with a symmetric stiffness k per length that does not turn with the rod. It acts on the axis and brings no moment.
///
/// ```
/// use hyperrod::load::ElasticFoundation;
/// use nalgebra::{Vector3, vector};
/// # fn main() -> hyperrod::Result<()> {
/// // a pipe along +Z on soil: soft along it, stiff across
/// let soil = ElasticFoundation::new(vector![5e4, 5e4, 1e3], |s: f64| Vector3::z() * s)?;
/// # let _ = soil; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ElasticFoundation<P> {
    stiffness: Vector3<f64>,
    rest: P,
}

impl<P: Fn(f64) -> Vector3<f64> + Send + Sync> ElasticFoundation<P> {
    /// Stiffness along X, Y and Z per length, N/m², and where the axis is at rest on the springs at s, m.
    ///
    /// # Errors
    /// If a stiffness is negative or not finite.
    pub fn new(stiffness: Vector3<f64>, rest: P) -> Result<Self> {
        stiffness.iter().try_for_each(|&value| not_negative("stiffness of a foundation", value))?;
        Ok(Self { stiffness, rest })
    }
}

impl<B: ?Sized, P: Fn(f64) -> Vector3<f64> + Send + Sync> Load<B> for ElasticFoundation<P> {
    fn at(&self, _body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        let offset = pose.position - (self.rest)(s);
        let force = -self.stiffness.component_mul(&offset);
        let (wrench, mut tangent) = dead(pose, &Vector3::zeros(), &force);
        // δp = R v
        let stiffness = Matrix3::from_diagonal(&self.stiffness);
        let from_place = -(pose.rotation.transpose() * stiffness * pose.rotation);
        tangent.fixed_view_mut::<3, 3>(3, 3).copy_from(&from_place);
        Ok(LoadWrench { wrench, tangent, potential: Some(-0.5 * force.dot(&offset)) })
    }
}
