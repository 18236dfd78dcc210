//! The first instant: velocities from rates of strain, and accelerations that satisfy the balance.

use super::core::Core;
use super::failure::Reason;
use super::newton::{Effort, Memory, Newton};
use super::present::{BaseMotion, Moving, Present};
use super::relation::{Offset, Relation};
use super::scene::{Movable, Scene};
use super::state::Start;
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist};
use crate::material::Request;
use crate::rod::adjoint::free_motion;

use super::factor::BaseRows;

fn as_twist(strain: &Strain) -> Twist {
    Twist::new(strain.angular, strain.linear)
}

impl<const S: usize> Present<S> {
    /// The state a motion begins with.
    pub(super) fn begin<B: Movable>(
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        start: &Start,
        (tolerance, max_iterations, step): (f64, usize, f64),
    ) -> Result<Self, Reason> {
        core.at_time(scene, start.time).map_err(Reason::Inadmissible)?;
        let mut points = set_strains(core, scene, start)?;
        if start.balanced {
            balance(core, scene, tolerance, max_iterations)?;
        }
        let mut base = BaseMotion::still(core.base);
        if scene.is_free() {
            base.velocity = start.base_velocity;
        } else {
            (base.velocity, base.acceleration) = (core.base_rates.velocity, core.base_rates.acceleration);
        }
        for (points, strain) in points.iter_mut().zip(&core.strain) {
            for k in 0..S {
                points[k].strain = strain[k];
            }
        }
        let mut present =
            Self { time: start.time, base, points, dissipated: 0.0, work: 0.0, power: [0.0; 2] };
        present.set_velocities(core);
        present.set_accelerations(core, scene, step).map_err(Reason::Inadmissible)?;
        Ok(present)
    }

    /// Velocities of all stages, and their accelerations for constant rates of strain.
    fn set_velocities(&mut self, core: &mut Core<S>) {
        let grid = &core.grid;
        let (mut velocity, mut acceleration) = (self.base.velocity, self.base.acceleration);
        for (i, points) in self.points.iter_mut().enumerate() {
            let xi = grid.twists(i, &core.strain[i]);
            let rate: [Twist; S] = std::array::from_fn(|k| as_twist(&points[k].strain_rate));
            core.legs[i].fill(&grid.table, &xi, grid.h());
            let (stage, end) = free_motion(&grid.table, grid.h(), &xi, &rate);
            // η = Ad⁻¹ η_i + u, η̇ = Ad⁻¹ η̇_i + [Ad⁻¹ η_i, u] + u̇
            let moved = |leg: &crate::rod::adjoint::Leg<S>, [u, du]: [Twist; 2]| {
                let inverse = leg.pose.adjoint_inverse();
                let carried = inverse.apply(&velocity);
                (carried + u, inverse.apply(&acceleration) + carried.bracket(&u) + du)
            };
            for k in 0..S {
                (points[k].velocity, points[k].acceleration) = moved(&core.legs[i].stage[k], stage[k]);
            }
            (velocity, acceleration) = moved(&core.legs[i].end, end);
        }
    }

    /// Accelerations that satisfy the balance: one linear solve, in which next to nothing but inertia counts.
    ///
    /// A little stiffness, (1e-4 Δt)² K, is left for what has no inertia.
    fn set_accelerations<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        step: f64,
    ) -> Result<()> {
        self.hold(core);
        core.problem.stiffness = (1e-4 * step) * (1e-4 * step);
        core.move_to_strains(scene.is_free());
        core.respond(scene, Request::Tangent)?;
        core.balance();
        let rows = if scene.is_free() { BaseRows::free() } else { BaseRows::held() };
        core.factor(&rows)?;
        core.newton_step(&rows, scene.is_free())?;
        core.problem.stiffness = 1.0;
        let mut node = Twist::from_vector(&core.base_step);
        for (i, points) in self.points.iter_mut().enumerate() {
            let rate: [Twist; S] = std::array::from_fn(|k| as_twist(&core.step[i][k]));
            let (stage, end) = core.legs[i].velocities(&core.grid.table, core.grid.h(), &node, &rate);
            for k in 0..S {
                points[k].pose = core.pose[i][k];
                points[k].acceleration += stage[k];
                points[k].algorithmic = points[k].acceleration;
                points[k].strain_second = core.step[i][k];
            }
            node = end;
        }
        if scene.is_free() {
            // what has no inertia then moves as far as a step lets it, and not as far as next to no stiffness would
            core.problem.stiffness = step * step;
            core.factor(&rows)?;
            core.newton_step(&rows, true)?;
            core.problem.stiffness = 1.0;
            self.base.acceleration = Twist::from_vector(&core.base_step);
            self.base.algorithmic = self.base.acceleration;
            for (points, second) in self.points.iter_mut().zip(&core.step) {
                for k in 0..S {
                    points[k].strain_second = second[k];
                }
            }
        }
        Ok(())
    }

    /// Makes `core` have this state, with velocities and accelerations as they are.
    pub(super) fn hold(&self, core: &mut Core<S>) {
        let p = &mut core.problem;
        (p.relation, p.stiffness) = (Relation::Held, 1.0);
        p.base_offset = Offset { velocity: self.base.velocity, acceleration: self.base.acceleration };
        core.base = self.base.pose;
        for (i, points) in self.points.iter().enumerate() {
            for (k, point) in points.iter().enumerate() {
                core.strain[i][k] = point.strain;
                p.strain_before[i][k] = point.strain;
                p.strain_offset[i][k] = point.strain_rate;
                p.offset[i][k] = Offset { velocity: point.velocity, acceleration: point.acceleration };
            }
        }
    }
}

/// Puts the strains of a start into `core`, and its rates into what is returned.
pub(super) fn set_strains<B: Movable, const S: usize>(
    core: &mut Core<S>,
    scene: &Scene<'_, B>,
    start: &Start,
) -> Result<Vec<[Moving; S]>, Reason> {
    let at = |f: &Option<Box<dyn Fn(f64) -> Strain>>, s: f64| f.as_ref().map_or(Strain::zero(), |f| f(s));
    if scene.is_free() {
        core.base = start.base.unwrap_or(*scene.rod().base());
    }
    let mut points = vec![[Moving::still(); S]; core.grid.elements];
    for i in 0..core.grid.elements {
        for k in 0..S {
            let s = core.grid.stage_s(i, k);
            core.strain[i][k] = at(&start.strain, s);
            points[i][k].strain_rate = at(&start.strain_rate, s);
            check(&core.strain[i][k], s).and(check(&points[i][k].strain_rate, s))?;
        }
    }
    Ok(points)
}

fn check(strain: &Strain, s: f64) -> Result<(), Reason> {
    if strain.is_finite() {
        return Ok(());
    }
    let value = strain.to_array().into_iter().find(|v| !v.is_finite()).unwrap_or(f64::NAN);
    let quantity = "strain, or rate of strain, to start with";
    Err(Reason::Options(Error::InvalidAt { quantity, value, requirement: "finite", s }))
}

/// The static equilibrium of this mesh nearest to the strains of `core`.
pub(super) fn balance<B: Movable, const S: usize>(
    core: &mut Core<S>,
    scene: &Scene<'_, B>,
    tolerance: f64,
    max_iterations: usize,
) -> Result<(), Reason> {
    core.problem.relation = Relation::Static;
    core.problem.stiffness = 1.0;
    let (mut memory, mut effort) = (Memory::empty(), Effort::default());
    // twice: the second begins at rounding and leaves nothing to move the rod
    for tolerance in [tolerance, 1e-14] {
        let mut newton =
            Newton { tolerance, max_iterations, memory: &mut memory, effort: &mut effort, held: true };
        newton.solve(core, scene)?;
    }
    Ok(())
}
