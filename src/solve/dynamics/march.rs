//! One step of either scheme, from one state to the next. The state changes only when a step is accepted: one that fails or is rejected
//! leaves no trace.

use super::core::Core;
use super::failure::Reason;
use super::newton::{Effort, Memory, Newton};
use super::present::Present;
use super::scene::{Movable, Scene};
use super::scheme::{Alpha, STAGES, Scheme};
use crate::lie::{Strain, Twist};

/// φ̇, η̇ and ξ̇ at one instant; of the mounts, the base first, φ̇ and η̇.
#[derive(Clone)]
pub(super) struct Slopes<const S: usize> {
    pub(super) mounts: Vec<[Twist; 2]>,
    pub(super) points: Vec<[(Twist, Twist, Strain); S]>,
    /// Rates at which damping takes and loads give energy, W.
    pub(super) power: [f64; 2],
}

/// What a march keeps between steps.
pub(super) struct March<const S: usize> {
    pub(super) memory: Memory,
    pub(super) slopes: Vec<Slopes<S>>,
    /// The step before, 0 if there is none, and for the guess: ξ̇ at its last two instants before the end, or the mean ξ̇ of the last two steps.
    pub(super) last_step: f64,
    pub(super) last_rates: [Vec<[Strain; S]>; 2],
    pub(super) last_base: [Twist; 2],
}

/// Options of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct How {
    pub(super) scheme: Scheme,
    pub(super) tolerance: f64,
    pub(super) max_iterations: usize,
    pub(super) track_work: bool,
}

/// What a step took, and its estimated error (relative to the length, or rad).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Made {
    pub(super) error: f64,
    pub(super) effort: Effort,
    pub(super) power: [f64; 2],
}

impl<const S: usize> March<S> {
    pub(super) fn new(elements: usize, mounts: usize) -> Self {
        let zero = Twist::zero();
        let slopes = Slopes {
            mounts: vec![[zero; 2]; mounts],
            points: vec![[(zero, zero, Strain::zero()); S]; elements],
            power: [0.0; 2],
        };
        let rates = vec![[Strain::zero(); S]; elements];
        Self {
            memory: Memory::empty(),
            slopes: vec![slopes; STAGES],
            last_step: 0.0,
            last_rates: [rates.clone(), rates],
            last_base: [zero; 2],
        }
    }

    /// Finds the state after a step of length dt, in `core`.
    pub(super) fn attempt<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        present: &Present<S>,
        dt: f64,
        how: &How,
    ) -> Result<Made, Reason> {
        match how.scheme {
            Scheme::Esdirk43 => self.runge_kutta(core, scene, present, dt, how),
            Scheme::GeneralisedAlpha { rho } => self.alpha(core, scene, present, dt, &Alpha::new(rho), how),
        }
    }

    /// Makes what was found the present.
    pub(super) fn accept(
        &mut self,
        core: &Core<S>,
        present: &mut Present<S>,
        dt: f64,
        scheme: &Scheme,
        made: &Made,
    ) {
        match scheme {
            Scheme::Esdirk43 => self.keep_slopes(present, dt),
            Scheme::GeneralisedAlpha { rho } => {
                present.dissipated += 0.5 * dt * (present.power[0] + made.power[0]);
                present.work += 0.5 * dt * (present.power[1] + made.power[1]);
                self.keep_differences(core, present, dt);
                Alpha::new(*rho).accelerate(core, present, dt);
            }
        }
        present.power = made.power;
        present.arrive(core, dt);
        self.last_step = dt;
    }

    /// Solves for an instant from the guess in `core`; if that fails, from the strains the step began with.
    pub(super) fn solve<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        present: &Present<S>,
        how: &How,
        made: &mut Made,
    ) -> Result<(), Reason> {
        let (memory, effort) = (&mut self.memory, &mut made.effort);
        let mut newton =
            Newton { tolerance: how.tolerance, max_iterations: how.max_iterations, memory, effort };
        let Err(first) = newton.solve(core, scene) else { return Ok(()) };
        for (strain, points) in core.strain.iter_mut().zip(&present.points) {
            *strain = points.map(|point| point.strain);
        }
        if core.loose {
            core.base = present.base().pose;
        }
        newton.memory.factored = None;
        newton.solve(core, scene).map_err(|_| first)
    }

    /// Slopes of the last step as numbers.
    pub(super) fn save_slopes(&self) -> Vec<f64> {
        let rates = self.last_rates.iter().flatten().flatten().flat_map(|rate| rate.to_array());
        rates.chain(self.last_base.iter().flat_map(|slope| slope.to_array())).collect()
    }

    /// The opposite of [`save_slopes`](Self::save_slopes).
    pub(super) fn restore_slopes(&mut self, numbers: &[f64]) -> Option<()> {
        let mut sixes = numbers.chunks_exact(6).map(|six| six.try_into().unwrap_or([0.0; 6]));
        for rate in self.last_rates.iter_mut().flatten().flatten() {
            *rate = Strain::from_array(sixes.next()?);
        }
        for slope in &mut self.last_base {
            *slope = Twist::from_array(sixes.next()?);
        }
        Some(())
    }
}

/// Puts the beginning of a step into the constants of its solves.
pub(super) fn begin_step<const S: usize>(core: &mut Core<S>, present: &Present<S>) {
    core.problem.stiffness = 1.0;
    for (mount, motion) in core.mounts.iter_mut().zip(&present.mounts) {
        mount.pose_before = motion.pose;
    }
    for (i, points) in present.points.iter().enumerate() {
        for (k, point) in points.iter().enumerate() {
            core.problem.pose_before[i][k] = point.pose;
            core.problem.strain_before[i][k] = point.strain;
        }
    }
}

impl<const S: usize> Present<S> {
    /// Takes over what the last solve of a step found.
    fn arrive(&mut self, core: &Core<S>, dt: f64) {
        self.time += dt;
        for (motion, mount) in self.mounts.iter_mut().zip(&core.mounts) {
            motion.pose = core.node_pose[mount.node];
            motion.velocity = mount.rates.velocity;
            motion.acceleration = mount.rates.acceleration;
            motion.reaction = mount.reaction;
        }
        for (i, points) in self.points.iter_mut().enumerate() {
            for (k, point) in points.iter_mut().enumerate() {
                point.pose = core.pose[i][k];
                point.strain = core.strain[i][k];
                point.strain_rate = core.strain_rate[i][k];
                point.velocity = core.rates[i][k].velocity;
                point.acceleration = core.rates[i][k].acceleration;
            }
        }
    }
}

impl<const S: usize> Core<S> {
    /// The rates at which damping takes energy, and at which loads and a driven base give it, W.
    pub(super) fn power(&self, work: bool) -> [f64; 2] {
        let (mut damping, mut given) = (0.0, 0.0);
        for (i, viscosity) in self.grid.viscosity.iter().enumerate() {
            for k in 0..S {
                let rate = self.strain_rate[i][k].to_vector();
                damping += self.grid.weight(i, k) * rate.dot(&(viscosity[k] * rate));
            }
        }
        if work {
            for (i, (loads, rates)) in self.load.iter().zip(&self.rates).enumerate() {
                for k in 0..S {
                    given += self.grid.weight(i, k) * rates[k].velocity.pair(&loads[k].wrench);
                }
            }
            let mut at_node = 0;
            self.node_velocities(|velocity| {
                if let Some(m) = self.mount_at[at_node] {
                    let load = self.mounts[m].load.wrench;
                    given += velocity.pair(&(load + self.reaction(m)));
                }
                at_node += 1;
            });
        }
        [damping, given]
    }
}
