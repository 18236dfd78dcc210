//! The first instant: velocities from rates of strain, and accelerations that satisfy the balance.

use super::core::Core;
use super::failure::Reason;
use super::newton::{Effort, Memory, Newton};
use super::place::Place;
use super::present::{Moving, NodeMotion, Present};
use super::relation::{Offset, Relation};
use super::scene::{Movable, Scene};
use super::state::Start;
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist};
use crate::material::Request;
use crate::rod::adjoint::free_motion;
use crate::rod::support::Condition;

/// The stiffness that is left where rates are sought, (… Δt)² K.
pub(super) const LITTLE: f64 = 1e-4;

impl<const S: usize> Present<S> {
    /// The state a motion begins with.
    pub(super) fn begin<B: Movable>(
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        start: &Start,
        (tolerance, max_iterations, step): (f64, usize, f64),
    ) -> Result<Self, Reason> {
        core.at_time(scene, start.time).map_err(Reason::Inadmissible)?;
        let mut points = set_strains(core, start)?;
        if start.balanced {
            balance(core, scene, tolerance, max_iterations)?;
        }
        core.move_to_strains();
        let mut mounts: Vec<NodeMotion> =
            core.mounts.iter().map(|mount| NodeMotion::still(core.node_pose[mount.node])).collect();
        if core.loose {
            mounts[0].velocity = start.base_velocity;
        } else {
            let rates = core.base_rates();
            (mounts[0].velocity, mounts[0].acceleration) = (rates.velocity, rates.acceleration);
        }
        for (points, strain) in points.iter_mut().zip(&core.strain) {
            for k in 0..S {
                points[k].strain = strain[k];
            }
        }
        let mut present =
            Self { time: start.time, mounts, points, dissipated: 0.0, work: 0.0, power: [0.0; 2] };
        present.set_velocities(core);
        present.check_supports(core)?;
        present.set_accelerations(core, scene, step).map_err(Reason::Inadmissible)?;
        Ok(present)
    }

    /// Velocities of all stages, and their accelerations for constant rates of strain.
    pub(super) fn set_velocities(&mut self, core: &mut Core<S>) {
        let grid = &core.grid;
        let (mut velocity, mut acceleration) = (self.mounts[0].velocity, self.mounts[0].acceleration);
        for (i, points) in self.points.iter_mut().enumerate() {
            if let Some(mount) = core.between(i) {
                (velocity, acceleration) = (mount.turned_on(&velocity), mount.turned_on(&acceleration));
            }
            let xi = grid.twists(i, &core.strain[i]);
            let rate: [Twist; S] = std::array::from_fn(|k| points[k].strain_rate.as_twist());
            core.legs[i].fill(&grid.table, &xi, grid.h(i));
            let (stage, end) = free_motion(&grid.table, grid.h(i), &xi, &rate);
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
            if let Some(m) = core.mount_at[i + 1] {
                (self.mounts[m].velocity, self.mounts[m].acceleration) = (velocity, acceleration);
            }
        }
    }

    /// Accelerations that satisfy the balance: one linear solve, in which next to nothing but inertia counts.
    ///
    /// A little stiffness, (1e-4 Δt)² K, is left for what has no inertia.
    pub(super) fn set_accelerations<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        step: f64,
    ) -> Result<()> {
        self.hold(core);
        core.problem.stiffness = (LITTLE * step) * (LITTLE * step);
        core.move_to_strains();
        core.respond(scene, Request::Tangent)?;
        core.balance();
        core.factor()?;
        core.newton_step()?;
        core.problem.stiffness = 1.0;
        let mut node = Twist::from_vector(&core.base_step);
        self.mounts[0].acceleration += node;
        for (motion, step) in self.mounts.iter_mut().zip(&core.reaction_step) {
            motion.reaction += *step;
        }
        for (i, points) in self.points.iter_mut().enumerate() {
            if let Some(mount) = core.between(i) {
                node = mount.turned_on(&node);
            }
            let rate: [Twist; S] = std::array::from_fn(|k| core.step[i][k].as_twist());
            let (stage, end) = core.legs[i].velocities(&core.grid.table, core.grid.h(i), &node, &rate);
            for k in 0..S {
                points[k].pose = core.pose[i][k];
                points[k].acceleration += stage[k];
                points[k].algorithmic = points[k].acceleration;
                points[k].strain_second = core.step[i][k];
            }
            node = end;
            if let Some(m) = core.mount_at[i + 1] {
                self.mounts[m].acceleration += node;
            }
        }
        if core.loose {
            self.move_what_has_no_inertia(core, step)?;
        }
        for motion in &mut self.mounts {
            motion.algorithmic = motion.acceleration;
        }
        Ok(())
    }

    /// What has no inertia moves as far as a step lets it, and not as far as next to no stiffness would: a second solve, with Δt² K.
    fn move_what_has_no_inertia(&mut self, core: &mut Core<S>, step: f64) -> Result<()> {
        let base = core.base_step;
        core.problem.stiffness = step * step;
        core.factor()?;
        core.newton_step()?;
        core.problem.stiffness = 1.0;
        if core.mounts[0].mass.is_none() {
            self.mounts[0].acceleration += Twist::from_vector(&(core.base_step - base));
        }
        for (points, second) in self.points.iter_mut().zip(&core.step) {
            for k in 0..S {
                points[k].strain_second = second[k];
            }
        }
        Ok(())
    }

    /// Refuses a start that the supports do not allow.
    fn check_supports(&self, core: &mut Core<S>) -> Result<(), Reason> {
        self.hold(core);
        core.move_to_strains();
        let length = core.grid.length;
        let size = |twist: &Twist| twist.angular.norm() + twist.linear.norm() / length;
        let fastest = self.points().map(|point| size(&point.velocity)).fold(0.0, f64::max);
        for mount in &core.mounts {
            let s = core.grid.node_s(mount.node);
            let given = mount.place == Place::Base && !core.loose;
            if given || mount.support.is_free() {
                continue;
            }
            let [place, speed, _] = mount.departure(&core.node_pose[mount.node]);
            let allowed = [1e-8, 1e-7 * fastest.max(mount.frame_speed(length)) + 1e-12];
            let names = [
                ("departure of the start from what a support holds", "none: begin from an equilibrium"),
                ("velocity of the start against what a support holds", "none"),
            ];
            for (values, (allowed, (quantity, requirement))) in
                [place, speed].iter().zip(allowed.into_iter().zip(names))
            {
                for (j, condition) in mount.support.conditions().iter().enumerate() {
                    let unit = if j < 3 { 1.0 } else { length };
                    let value = values[j];
                    if matches!(condition, Condition::Fixed(_)) && !(value.abs() <= allowed * unit) {
                        return Err(Reason::Options(Error::InvalidAt { quantity, value, requirement, s }));
                    }
                }
            }
        }
        Ok(())
    }

    /// Makes `core` have this state, with velocities and accelerations as they are.
    pub(super) fn hold(&self, core: &mut Core<S>) {
        let p = &mut core.problem;
        (p.relation, p.stiffness) = (Relation::Held, 1.0);
        for (mount, motion) in core.mounts.iter_mut().zip(&self.mounts) {
            mount.offset = Offset { velocity: motion.velocity, acceleration: motion.acceleration };
            mount.reaction = motion.reaction;
        }
        core.base = self.base().pose;
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
pub(super) fn set_strains<const S: usize>(
    core: &mut Core<S>,
    start: &Start,
) -> Result<Vec<[Moving; S]>, Reason> {
    let at = |f: &Option<Box<dyn Fn(f64) -> Strain>>, s: f64| f.as_ref().map_or(Strain::zero(), |f| f(s));
    if let Some(base) = start.base.filter(|_| core.loose) {
        core.base = base;
    }
    let mut points = vec![[Moving::still(); S]; core.grid.elements];
    for i in 0..core.grid.elements {
        for k in 0..S {
            let s = core.grid.stage_s(i, k);
            core.strain[i][k] = at(&start.strain, s);
            points[i][k].strain_rate = at(&start.strain_rate, s);
            for strain in [&core.strain[i][k], &points[i][k].strain_rate] {
                check(strain, &core.grid.fixed, s)?;
            }
        }
    }
    Ok(points)
}

fn check(strain: &Strain, fixed: &[bool; 6], s: f64) -> Result<(), Reason> {
    let strain = strain.to_array();
    let refused = |quantity, value, requirement| {
        Err(Reason::Options(Error::InvalidAt { quantity, value, requirement, s }))
    };
    if let Some(&value) = strain.iter().find(|v| !v.is_finite()) {
        return refused("strain, or rate of strain, to start with", value, "finite");
    }
    match (0..6).find(|&c| fixed[c] && strain[c] != 0.0) {
        None => Ok(()),
        Some(c) => refused("fixed strain, or its rate, to start with", strain[c], "zero"),
    }
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
    // a rod that nothing holds is balanced in itself: its base stays where it is
    let loose = core.loose;
    core.loose &= core.mounts.iter().any(|mount| !mount.support.is_free());
    // twice: the second begins at rounding and leaves nothing to move the rod
    let found = [tolerance, 1e-14].into_iter().try_for_each(|tolerance| {
        let mut newton = Newton { tolerance, max_iterations, memory: &mut memory, effort: &mut effort };
        newton.solve(core, scene)
    });
    core.loose = loose;
    found
}
