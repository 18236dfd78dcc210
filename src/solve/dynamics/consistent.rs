//! Velocities, accelerations and reactions that are consistent with what supports and fixed strains hold.
//!
//! The stages of a Runge–Kutta step satisfy the conditions on the poses. Velocities and accelerations then do so only with the order of the
//! stages, 2 and 1, and wrenches with the latter: a system of index three. So a state is described with its velocities projected onto what the
//! conditions allow, and with the accelerations and reactions of the balance at that instant. The steps go on from what they found themselves:
//! with projected rates their poses were measured to be of order 2 instead of 3.
//!
//! Source: Hairer, Lubich and Roche (1989), *The Numerical Solution of Differential-Algebraic Systems by Runge–Kutta Methods*, ch. 6; Lubich
//! (1991), Impact Comput. Sci. Eng. 3, 32, for projection.

use super::begin::LITTLE;
use super::core::Core;
use super::present::Present;
use super::relation::Relation;
use super::scene::{Movable, Scene};
use crate::error::Result;
use crate::lie::Twist;
use crate::material::Request;

impl<const S: usize> Present<S> {
    /// Makes the rates of this state consistent.
    pub(super) fn make_consistent<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        step: f64,
    ) -> Result<()> {
        core.at_time(scene, self.time)?;
        core.swap_factors();
        let done = self.project(core, scene, step).and_then(|()| {
            if core.loose {
                self.mounts[0].acceleration = Twist::zero();
            }
            self.set_velocities(core);
            self.set_accelerations(core, scene, step)
        });
        core.swap_factors();
        done
    }

    /// The velocities that the kinematics allow and that differ least from these, in the measure of kinetic energy.
    fn project<B: Movable>(&mut self, core: &mut Core<S>, scene: &Scene<'_, B>, step: f64) -> Result<()> {
        let wanted: Vec<[Twist; S]> =
            self.points.iter().map(|points| points.map(|point| point.velocity)).collect();
        let at_mounts: Vec<Twist> = self.mounts.iter().map(|motion| motion.velocity).collect();
        self.set_velocities(core);
        self.hold(core);
        core.problem.relation = Relation::Impulse;
        core.problem.stiffness = (LITTLE * step) * (LITTLE * step);
        core.move_to_strains();
        core.respond(scene, Request::Tangent)?;
        let mut missing = wanted;
        for (missing, points) in missing.iter_mut().zip(&self.points) {
            for k in 0..S {
                missing[k] -= points[k].velocity;
            }
        }
        let at_mounts: Vec<Twist> =
            at_mounts.iter().zip(&self.mounts).map(|(wanted, motion)| *wanted - motion.velocity).collect();
        core.balance_impulses(&missing, &at_mounts);
        core.factor()?;
        core.newton_step()?;
        core.problem.stiffness = 1.0;
        self.mounts[0].velocity += Twist::from_vector(&core.base_step);
        for (points, change) in self.points.iter_mut().zip(&core.step) {
            for k in 0..S {
                points[k].strain_rate += change[k];
            }
        }
        Ok(())
    }
}
