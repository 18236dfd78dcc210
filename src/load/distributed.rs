use nalgebra::{Matrix6, Vector3};

use super::dead_wrench::dead;
use super::{Load, LoadWrench};
use crate::error::{Result, finite};
use crate::lie::{Pose, Wrench};

/// A wrench per length along the rod: the same everywhere, or a closure of s.
pub trait WrenchProfile: Send + Sync {
    /// Moment per length, N, and force per length, N/m, at s.
    fn at(&self, s: f64) -> Wrench;
}

impl WrenchProfile for Wrench {
    fn at(&self, _s: f64) -> Wrench {
        *self
    }
}

impl<F: Fn(f64) -> Wrench + Send + Sync> WrenchProfile for F {
    fn at(&self, s: f64) -> Wrench {
        self(s)
    }
}

/// A moment and a force per length of the reference that keep direction and size in space, whatever the rod does: snow, a magnet far away.
///
/// ```math
/// \bar f = (R^{\mathsf T} l(s),\; R^{\mathsf T} f(s))
/// ```
///
/// ```
/// use hyperrod::Wrench;
/// use hyperrod::load::DeadLoad;
/// use nalgebra::{Vector3, vector};
/// # fn main() -> hyperrod::Result<()> {
/// let even = DeadLoad::new(Wrench::new(Vector3::zeros(), vector![0.0, 0.0, -2.0]))?;
/// let growing = DeadLoad::varying(|s: f64| Wrench::new(Vector3::zeros(), vector![0.0, 0.0, -2.0 * s]));
/// # let _ = (even, growing); Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadLoad<F = Wrench>(F);

/// A moment and a force per length of the reference that turn with the section: a jet, the pull of a sheath.
///
/// ```math
/// \bar f = (l(s),\; f(s)) \quad \text{in the body frame}
/// ```
///
/// It has no potential.
///
/// ```
/// use hyperrod::Wrench;
/// use hyperrod::load::FollowerLoad;
/// use nalgebra::{Vector3, vector};
/// # fn main() -> hyperrod::Result<()> {
/// let across = FollowerLoad::new(Wrench::new(Vector3::zeros(), vector![3.0, 0.0, 0.0]))?;
/// # let _ = across; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowerLoad<F = Wrench>(F);

impl DeadLoad {
    /// The same everywhere: moment per length, N, and force per length, N/m, in space.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn new(wrench: Wrench) -> Result<Self> {
        finite("component of a dead load", &wrench.to_array())?;
        Ok(Self(wrench))
    }
}

impl<F: Fn(f64) -> Wrench + Send + Sync> DeadLoad<F> {
    /// A function of s.
    pub fn varying(wrench: F) -> Self {
        Self(wrench)
    }
}

impl FollowerLoad {
    /// The same everywhere: moment per length, N, and force per length, N/m, in the body frame.
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn new(wrench: Wrench) -> Result<Self> {
        finite("component of a follower load", &wrench.to_array())?;
        Ok(Self(wrench))
    }
}

impl<F: Fn(f64) -> Wrench + Send + Sync> FollowerLoad<F> {
    /// A function of s.
    pub fn varying(wrench: F) -> Self {
        Self(wrench)
    }
}

impl<B: ?Sized, F: WrenchProfile> Load<B> for DeadLoad<F> {
    fn at(&self, _body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        let Wrench { moment, force } = self.0.at(s);
        let (wrench, tangent) = dead(pose, &moment, &force);
        let conservative = moment == Vector3::zeros();
        Ok(LoadWrench { wrench, tangent, potential: conservative.then(|| -force.dot(&pose.position)) })
    }

    fn dead_force(&self, _body: &B, s: f64) -> Result<Option<Vector3<f64>>> {
        let Wrench { moment, force } = self.0.at(s);
        Ok((moment == Vector3::zeros()).then_some(force))
    }
}

impl<B: ?Sized, F: WrenchProfile> Load<B> for FollowerLoad<F> {
    fn at(&self, _body: &B, s: f64, _pose: &Pose) -> Result<LoadWrench> {
        Ok(LoadWrench { wrench: self.0.at(s), tangent: Matrix6::zeros(), potential: None })
    }
}
