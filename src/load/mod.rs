//! Loads: what acts on a rod per length or on one of its sections, with exact derivatives.
//!
//! A distributed load is a [`Load`] on bodies that have what it needs; a [`TipLoad`] acts on one section, the tip or any other. Both are given in the body
//! frame of the section they act on, with their derivative in a small displacement ζ of that frame.
//!
//! | load | acts on | needs of the body | potential |
//! |---|---|---|---|
//! | [`Gravity`] | length | [a mass](crate::body::HasMass) | yes |
//! | [`Buoyancy`] | length | [an area](crate::body::HasArea) | yes |
//! | [`DeadLoad`], [`DeadWrench`] | length, tip | | of the force |
//! | [`Payload`] | tip | | yes; in motion it has inertia too |
//! | [`FollowerLoad`], [`FollowerWrench`] | length, tip | | no |
//! | [`ElasticFoundation`] | length | | yes |
//! | [`distributed`], [`distributed_on`], [`at_tip`]: a closure that gives the wrench | length, tip | what it asks for | no |
//! | [`potential`], [`potential_at_tip`]: a closure that gives the energy | length, tip | | yes |
//!
//! A load that depends on the strain twist and its rate along the rod is −(Ā ξ′ + B̄): it gives a [`RateLoad`] in [`Load::rate`].
//!
//! What acts by the strain of the rod and has an energy, as tendons and pressure chambers, is an [`Actuator`](crate::section::Actuator) of the section.
//!
//! What lives here knows bodies and poses; it knows no element and no solver.

mod buoyancy;
mod closure;
mod dead_wrench;
mod distributed;
mod follower_wrench;
mod foundation;
mod gravity;
mod payload;
mod rate;

pub use buoyancy::Buoyancy;
pub use closure::{
    BodyLoadClosure, LoadClosure, LoadDual, PotentialClosure, PotentialDual, at_tip, distributed,
    distributed_on, potential, potential_at_tip,
};
pub use dead_wrench::DeadWrench;
pub use distributed::{DeadLoad, FollowerLoad, WrenchProfile};
pub use follower_wrench::FollowerWrench;
pub use foundation::ElasticFoundation;
pub use gravity::Gravity;
pub use payload::Payload;
pub use rate::RateLoad;

use nalgebra::{Matrix6, Vector3};

use crate::error::{Error, Result};
use crate::lie::{Pose, Twist, Wrench};

/// A wrench with its derivative in a displacement ζ of the frame it is given in (g → g exp ζ^).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadWrench {
    /// The wrench in body frame.
    pub wrench: Wrench,
    /// ∂(wrench)/∂ζ, rows and columns (angular, linear).
    pub tangent: Matrix6<f64>,
    /// Its potential energy (per length for a distributed load); `None` for a load that has none.
    pub potential: Option<f64>,
}

impl LoadWrench {
    /// What no load does: nothing, with a potential of zero.
    pub(crate) fn none() -> Self {
        Self { wrench: Wrench::zero(), tangent: Matrix6::zeros(), potential: Some(0.0) }
    }

    /// A force fixed in space, seen from `pose` and given in the frame that the pose is given in; its potential is not told.
    pub(crate) fn dead(pose: &Pose, force: &Vector3<f64>) -> Self {
        let (wrench, tangent) = dead_wrench::dead(pose, &Vector3::zeros(), force);
        Self { wrench, tangent, potential: None }
    }

    /// Adds another, taken `factor` times; the sum of one that has no potential has none.
    pub(crate) fn add_scaled(&mut self, load: &Self, factor: f64) {
        self.wrench += load.wrench * factor;
        for (total, load) in self.tangent.as_mut_slice().iter_mut().zip(load.tangent.as_slice()) {
            *total += load * factor;
        }
        self.potential = self.potential.zip(load.potential).map(|(a, b)| a + b * factor);
    }

    /// Refuses one with a number that is not finite, by the name of what it belongs to.
    pub(crate) fn check(&self, quantity: &'static str, s: f64) -> Result<()> {
        // 0 x is 0 for a finite x and NaN otherwise: one sum of every four tells of all
        let [l, m, n, x, y, z] = self.wrench.to_array();
        let mut nothing = [0.0 * l + 0.0 * m, 0.0 * n + 0.0 * x, 0.0 * y, 0.0 * z];
        for four in self.tangent.as_slice().chunks_exact(4) {
            for (sum, v) in nothing.iter_mut().zip(four) {
                *sum += 0.0 * v;
            }
        }
        if nothing == [0.0; 4] {
            return Ok(());
        }
        let size = self.wrench.to_vector().norm() + self.tangent.norm();
        Err(Error::InvalidAt { quantity, value: size, requirement: "finite", s })
    }
}

/// A load per length of the reference on bodies of type `B`.
///
/// A load of your own says in its `impl` what it needs of the body: `impl<B: HasMass> Load<B> for Mine`, with one of the capabilities of
/// [`body`](crate::body) or a trait of your own that you implement for your bodies.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a load per length on `{B}`",
    label = "a load per length is needed here",
    note = "loads are in `hyperrod::load`; one on the tip alone goes to `with_tip_load`; one of your own implements `Load`, or is a closure in `load::distributed`"
)]
pub trait Load<B: ?Sized>: Send + Sync {
    /// The load at s on a section at `pose`: N (moment per length) and N/m.
    ///
    /// # Errors
    /// Where the load or what it asks of the body is not defined.
    fn at(&self, body: &B, s: f64, pose: &Pose) -> Result<LoadWrench>;

    /// What of the load depends on the strain twist ξ and on its rate along the rod: the whole load is that of [`at`](Self::at) less Ā ξ′ + B̄. `None`, the
    /// default, where nothing does; a load that gives it gives it everywhere.
    ///
    /// A solve takes ξ′ from the [strong form](crate::Rod::strain_rate), so that such a load is one of pose and strain and the order of convergence is kept;
    /// its derivative in these, which has third derivatives of the energy in it, is taken by central differences. A rod with [fixed
    /// strains](crate::body::Constraint) has no strong form and is refused, and so is motion. What acts through the strain and has an energy is better
    /// an [`Actuator`](crate::section::Actuator): that knows its conditions at the ends too.
    ///
    /// ```
    /// use hyperrod::load::{DeadWrench, Load, LoadWrench, RateLoad};
    /// use hyperrod::{Body, Pose, Rod, Statics, Twist, Wrench, section::Stiffness};
    /// use nalgebra::{Matrix6, Vector3, vector};
    ///
    /// /// Water that flows through a hose with the momentum flux ρ A v², N, and pushes outwards where it is turned: f = −ρ A v² ω × e₃.
    /// struct Flow(f64);
    ///
    /// impl<B: ?Sized> Load<B> for Flow {
    ///     fn at(&self, _body: &B, _s: f64, _pose: &Pose) -> hyperrod::Result<LoadWrench> {
    ///         Ok(LoadWrench { wrench: Wrench::zero(), tangent: Matrix6::zeros(), potential: None })
    ///     }
    ///     fn rate(&self, _: &B, _: f64, _: &Pose, xi: &Twist) -> hyperrod::Result<Option<RateLoad>> {
    ///         let force = xi.angular.cross(&Vector3::z()) * self.0;
    ///         Ok(Some(RateLoad { a_bar: Matrix6::zeros(), b_bar: Wrench::new(Vector3::zeros(), force) }))
    ///     }
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let tip = |flux: f64| -> Result<f64, Box<dyn std::error::Error>> {
    ///     let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
    ///     let rod = Rod::clamped(body, Pose::identity())
    ///         .with_load(Flow(flux))
    ///         .with_tip_load(DeadWrench::force(vector![0.5, 0.0, 0.0])?);
    ///     Ok(Statics::default().solve(&rod)?.tip().pose.position.x)
    /// };
    /// assert!(tip(0.5)? < 0.97 * tip(0.0)?); // bends less
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`at`](Self::at).
    fn rate(&self, body: &B, s: f64, pose: &Pose, xi: &Twist) -> Result<Option<RateLoad>> {
        let _ = (body, s, pose, xi);
        Ok(None)
    }

    /// The force per length in space, N/m, of a load that is *dead* at s: a force through the axis that keeps its direction and size whatever the rod does,
    /// so that [`at`](Self::at) gives (0, Rᵀ f) and the potential −f·p. `None`, the default, for any other.
    ///
    /// It need not be overridden. A rod all of whose loads are dead is solved faster, since they are asked for once and not in every iteration.
    ///
    /// # Errors
    /// As [`at`](Self::at).
    fn dead_force(&self, body: &B, s: f64) -> Result<Option<Vector3<f64>>> {
        let _ = (body, s);
        Ok(None)
    }
}

/// A wrench on one section of the rod: its tip, its base or one between.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a load on a point of a rod",
    label = "a load on a point is needed here",
    note = "loads are in `hyperrod::load`; one per length goes to `with_load`; one of your own implements `TipLoad`, or is a closure in `load::at_tip`"
)]
pub trait TipLoad: Send + Sync {
    /// The load on a section at `pose`: N m and N.
    ///
    /// # Errors
    /// Where the load is not defined.
    fn at(&self, pose: &Pose) -> Result<LoadWrench>;

    /// The inertia matrix M of a rigid body that the load brings along, in the frame of the section and in the order (angular, linear): at a body
    /// velocity η it has the momentum M η. It counts in motion; most loads bring none.
    fn inertia(&self) -> Option<Matrix6<f64>> {
        None
    }
}

/// The example of the decision, compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../../docs/decisions/010-what-a-load-needs-of-a-body.md")]
struct Decision;
