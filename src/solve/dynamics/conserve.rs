//! Energy and momenta kept exactly: after every step the velocities are moved, as little as can be, to where both have their first values.

use nalgebra::{Matrix6, Vector6};

use super::core::Core;
use super::present::Present;
use super::scene::{Movable, Scene};
use crate::error::Result;
use crate::lie::{Twist, Wrench};
use crate::material::Request;
use crate::rod::adjoint::{brought, left, right};

/// By how much the inner motion may be made faster or slower in a step: where it stands nearly still, its energy says little, and what is
/// missing is left to the next step.
const MOST: f64 = 0.01;

/// What is kept: the energy, and angular and linear momentum in space (about its origin).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kept {
    pub(super) energy: f64,
    pub(super) momentum: Vector6<f64>,
}

impl Kept {
    /// Of a state, if nothing but its own elasticity acts on the rod.
    pub(super) fn of<B: Movable, const S: usize>(
        present: &Present<S>,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
    ) -> Result<Self> {
        present.evaluate(core, scene)?;
        let (kinetic, elastic, _) = core.energies();
        Ok(Self { energy: kinetic + elastic, momentum: core.momentum() })
    }

    /// Corrects the velocities of a state that `core` has just arrived at.
    ///
    /// η = Ad_g⁻¹ V + u splits the motion into that of a rigid body with the same momentum, π = J V, and an inner one without momentum; their
    /// kinetic energies add up. V becomes J⁻¹ π₀, and u is multiplied by what makes the energy right. Projection onto invariants keeps
    /// the order of a scheme: Hairer, Lubich and Wanner (2006), IV.4.
    pub(super) fn restore<B: Movable, const S: usize>(
        &self,
        present: &mut Present<S>,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
    ) -> Result<()> {
        core.respond(scene, Request::Energy)?;
        let (mut inertia, mut momentum) = (Matrix6::zeros(), Vector6::zeros());
        let (mut kinetic, mut elastic) = (0.0, 0.0);
        for (i, points) in present.points.iter().enumerate() {
            for (k, point) in points.iter().enumerate() {
                let mass = core.grid.mass[i][k] * core.grid.weight(i, k);
                let inverse = point.pose.adjoint_inverse();
                let eta = point.velocity.to_vector();
                let own = mass * eta;
                inertia += left(&inverse, &right(&mass, &inverse));
                momentum += brought(&point.pose, &Wrench::from_vector(&own)).to_vector();
                kinetic += 0.5 * eta.dot(&own);
                elastic += core.grid.weight(i, k) * core.energy[i][k];
            }
        }
        let Some(factor) = inertia.cholesky() else { return Ok(()) };
        let (before, after) = (factor.solve(&momentum), factor.solve(&self.momentum));
        let inner = kinetic - 0.5 * before.dot(&momentum);
        let wanted = self.energy - elastic - 0.5 * after.dot(&self.momentum);
        let scale = if inner > 0.0 && wanted > 0.0 {
            (wanted / inner).sqrt().clamp(1.0 - MOST, 1.0 + MOST)
        } else {
            1.0
        };
        let (before, after) = (Twist::from_vector(&before), Twist::from_vector(&after));
        let corrected = |pose: &crate::lie::Pose, eta: Twist| {
            let inverse = pose.adjoint_inverse();
            inverse.apply(&after) + (eta - inverse.apply(&before)) * scale
        };
        for point in present.points.iter_mut().flatten() {
            point.velocity = corrected(&point.pose, point.velocity);
            point.strain_rate = point.strain_rate * scale;
        }
        for motion in &mut present.mounts {
            motion.velocity = corrected(&motion.pose, motion.velocity);
        }
        Ok(())
    }
}
