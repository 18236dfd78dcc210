//! One step of either scheme, from one state to the next. The state changes only when a step is accepted: one that fails or is rejected
//! leaves no trace.

use super::core::Core;
use super::failure::Reason;
use super::newton::{Effort, Memory, Newton};
use super::present::Present;
use super::relation::{Offset, Relation};
use super::scene::{Movable, Scene};
use super::scheme::{A, Alpha, B as WEIGHTS, B_EMBEDDED, C, GAMMA, STAGES, Scheme};
use crate::lie::{Strain, Twist};

/// φ̇, η̇ and ξ̇ at one instant.
#[derive(Clone)]
pub(super) struct Slopes<const S: usize> {
    base: [Twist; 2],
    points: Vec<[(Twist, Twist, Strain); S]>,
    /// Rates at which damping takes and loads give energy, W.
    power: [f64; 2],
}

/// What a march keeps between steps.
pub(super) struct March<const S: usize> {
    pub(super) memory: Memory,
    slopes: Vec<Slopes<S>>,
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
    power: [f64; 2],
}

impl<const S: usize> March<S> {
    pub(super) fn new(elements: usize) -> Self {
        let zero = Twist::zero();
        let slopes = Slopes {
            base: [zero; 2],
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

    fn runge_kutta<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        present: &Present<S>,
        dt: f64,
        how: &How,
    ) -> Result<Made, Reason> {
        let mut made = Made::default();
        begin_step(core, present);
        let first = &mut self.slopes[0];
        first.base = [present.base.velocity, present.base.acceleration];
        first.power = present.power;
        for (slopes, points) in first.points.iter_mut().zip(&present.points) {
            *slopes = points.map(|p| (p.velocity, p.acceleration, p.strain_rate));
        }
        core.problem.relation = Relation::RungeKutta { c: 1.0 / (GAMMA * dt) };
        for stage in 1..STAGES {
            self.set_offsets(core, present, stage, dt);
            core.at_time(scene, present.time + C[stage] * dt).map_err(Reason::Inadmissible)?;
            self.guess(core, scene, present, stage, dt);
            self.solve(core, scene, present, how, &mut made)?;
            let slopes = &mut self.slopes[stage];
            slopes.base = [core.base_rates.slope, core.base_rates.acceleration];
            for i in 0..core.grid.elements {
                for k in 0..S {
                    let rates = &core.rates[i][k];
                    slopes.points[i][k] = (rates.slope, rates.acceleration, core.strain_rate[i][k]);
                }
            }
            slopes.power = core.power(how.track_work);
        }
        made.error = self.estimate(core.grid.length, dt);
        made.power = self.slopes[STAGES - 1].power;
        Ok(made)
    }

    /// What the next step wants to know of an accepted one.
    fn keep_slopes(&mut self, present: &mut Present<S>, dt: f64) {
        for (old, new) in [(0, STAGES - 2), (1, STAGES - 3)] {
            for (rates, slopes) in self.last_rates[old].iter_mut().zip(&self.slopes[new].points) {
                *rates = slopes.map(|(_, _, rate)| rate);
            }
            self.last_base[old] = self.slopes[new].base[0];
        }
        let sum = |which: usize| -> f64 {
            (0..STAGES).map(|j| WEIGHTS[j] * self.slopes[j].power[which]).sum::<f64>() * dt
        };
        present.dissipated += sum(0);
        present.work += sum(1);
    }

    /// Mean rates of the last two steps.
    fn keep_differences(&mut self, core: &Core<S>, present: &Present<S>, dt: f64) {
        let first = self.last_step == 0.0;
        self.last_rates.swap(0, 1);
        for (i, points) in present.points.iter().enumerate() {
            for (k, point) in points.iter().enumerate() {
                self.last_rates[0][i][k] = (core.strain[i][k] - point.strain) * (1.0 / dt);
            }
        }
        self.last_base = [core.base_rates.phi * (1.0 / dt), self.last_base[0]];
        if first {
            let [last, before] = &mut self.last_rates;
            before.clone_from(last);
            self.last_base[1] = self.last_base[0];
        }
    }

    /// Solves for an instant from the guess in `core`; if that fails, from the strains the step began with.
    fn solve<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        present: &Present<S>,
        how: &How,
        made: &mut Made,
    ) -> Result<(), Reason> {
        let (memory, effort) = (&mut self.memory, &mut made.effort);
        let mut newton = Newton {
            tolerance: how.tolerance,
            max_iterations: how.max_iterations,
            memory,
            effort,
            held: false,
        };
        let Err(first) = newton.solve(core, scene) else { return Ok(()) };
        for (strain, points) in core.strain.iter_mut().zip(&present.points) {
            *strain = points.map(|point| point.strain);
        }
        if scene.is_free() {
            core.base = present.base.pose;
        }
        newton.memory.factored = None;
        newton.solve(core, scene).map_err(|_| first)
    }

    /// φ̇₀ = −Σ a_ij φ̇_j/γ, η̇₀ = −η_n/(γΔt) − Σ a_ij η̇_j/γ, ξ̇₀ = −Σ a_ij ξ̇_j/γ.
    #[inline(always)]
    fn set_offsets(&self, core: &mut Core<S>, present: &Present<S>, stage: usize, dt: f64) {
        let c = 1.0 / (GAMMA * dt);
        let weights: [f64; STAGES] = std::array::from_fn(|j| -A[stage][j] / GAMMA);
        let earlier = &self.slopes[..stage];
        let p = &mut core.problem;
        let mut base = Offset { velocity: Twist::zero(), acceleration: present.base.velocity * -c };
        for (slopes, &weight) in earlier.iter().zip(&weights) {
            base.velocity += slopes.base[0] * weight;
            base.acceleration += slopes.base[1] * weight;
        }
        p.base_offset = base;
        for i in 0..core.grid.elements {
            for k in 0..S {
                let mut offset =
                    Offset { velocity: Twist::zero(), acceleration: present.points[i][k].velocity * -c };
                let mut strain = Strain::zero();
                for (slopes, &weight) in earlier.iter().zip(&weights) {
                    let (slope, acceleration, rate) = &slopes.points[i][k];
                    offset.velocity += *slope * weight;
                    offset.acceleration += *acceleration * weight;
                    strain += *rate * weight;
                }
                p.offset[i][k] = offset;
                p.strain_offset[i][k] = strain;
            }
        }
    }

    /// Strains at a stage from an interpolation of the rates of strain known so far.
    #[inline(always)]
    fn guess<B: Movable>(
        &self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        present: &Present<S>,
        stage: usize,
        dt: f64,
    ) {
        /// Which earlier stages are used; −1 and −2 are the last but one and the one before of the previous step.
        const SOURCES: [&[i8]; STAGES] =
            [&[], &[0, -1, -2], &[0, 1, -1], &[0, 1, 2], &[0, 1, 2, 3], &[1, 2, 3, 4]];
        let before = self.last_step / dt;
        let mut nodes = [0.0; 4];
        let mut sources = [0_i8; 4];
        let mut count = 0;
        for &source in SOURCES[stage] {
            if source < 0 && self.last_step == 0.0 {
                continue;
            }
            sources[count] = source;
            nodes[count] = match source {
                -1 => (C[STAGES - 2] - 1.0) * before,
                -2 => (C[STAGES - 3] - 1.0) * before,
                _ => C[source as usize],
            };
            count += 1;
        }
        let weights = integral_weights(&nodes[..count], C[stage]);
        let mut phi = Twist::zero();
        for j in 0..count {
            phi += match sources[j] {
                -1 => self.last_base[0],
                -2 => self.last_base[1],
                source => self.slopes[source as usize].base[0],
            } * (dt * weights[j]);
        }
        if scene.is_free() {
            core.base = present.base.pose * phi.exp();
        }
        for i in 0..core.grid.elements {
            for k in 0..S {
                let mut strain = present.points[i][k].strain;
                for j in 0..count {
                    let rate = match sources[j] {
                        -1 => self.last_rates[0][i][k],
                        -2 => self.last_rates[1][i][k],
                        source => self.slopes[source as usize].points[i][k].2,
                    };
                    strain += rate * (dt * weights[j]);
                }
                core.strain[i][k] = strain;
            }
        }
    }

    /// Δt Σ (b_j − b̂_j) φ̇_j: the largest rotation, or displacement over the length.
    fn estimate(&self, length: f64, dt: f64) -> f64 {
        let mut largest: f64 = 0.0;
        for i in 0..self.slopes[0].points.len() {
            for k in 0..S {
                let mut error = Twist::zero();
                for j in 0..STAGES {
                    error += self.slopes[j].points[i][k].0 * (dt * (WEIGHTS[j] - B_EMBEDDED[j]));
                }
                largest = largest.max(error.angular.norm()).max(error.linear.norm() / length);
            }
        }
        largest
    }

    fn alpha<B: Movable>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
        present: &Present<S>,
        h: f64,
        a: &Alpha,
        how: &How,
    ) -> Result<Made, Reason> {
        let mut made = Made::default();
        begin_step(core, present);
        let (beta, gamma) = (a.beta, a.gamma);
        let velocity = gamma / (beta * h);
        let acceleration = (1.0 - a.alpha_m) / ((1.0 - a.alpha_f) * beta * h * h);
        core.problem.relation = Relation::Newmark { velocity, acceleration };
        let ahead = |v: Twist, a_n: Twist| v * h + a_n * (h * h * (0.5 - beta));
        let offset = |v: Twist, dv: Twist, a_n: Twist| {
            let p = ahead(v, a_n);
            Offset {
                velocity: v + a_n * (h * (1.0 - gamma)) - p * velocity,
                acceleration: (a_n * a.alpha_m - dv * a.alpha_f) * (1.0 / (1.0 - a.alpha_f))
                    - p * acceleration,
            }
        };
        let base = present.base;
        core.problem.base_offset = offset(base.velocity, base.acceleration, base.algorithmic);
        core.at_time(scene, present.time + h).map_err(Reason::Inadmissible)?;
        let known = self.last_step > 0.0;
        if scene.is_free() {
            let [last, before] = self.last_base;
            let phi = if known {
                last * (2.0 * h) - before * h
            } else {
                base.velocity * h + base.algorithmic * (0.5 * h * h)
            };
            core.base = base.pose * phi.exp();
        }
        for (i, points) in present.points.iter().enumerate() {
            for (k, point) in points.iter().enumerate() {
                core.problem.offset[i][k] = offset(point.velocity, point.acceleration, point.algorithmic);
                let (rate, second) = (point.strain_rate, point.strain_second);
                let p = rate * h + second * (h * h * (0.5 - beta));
                core.problem.strain_offset[i][k] = rate + second * (h * (1.0 - gamma)) - p * velocity;
                // differences of the strains themselves: in what has no inertia, the rates of the scheme are noise
                core.strain[i][k] = point.strain
                    + if known {
                        self.last_rates[0][i][k] * (2.0 * h) - self.last_rates[1][i][k] * h
                    } else {
                        rate * h + second * (0.5 * h * h)
                    };
            }
        }
        self.solve(core, scene, present, how, &mut made)?;
        made.power = core.power(how.track_work);
        let mut largest: f64 = 0.0;
        for (i, points) in present.points.iter().enumerate() {
            for (k, point) in points.iter().enumerate() {
                let p = ahead(point.velocity, point.algorithmic);
                let after = (core.rates[i][k].phi - p) * (1.0 / (beta * h * h));
                // Zienkiewicz and Xie (1991): what a linear acceleration would have added
                let error = (after - point.algorithmic) * (h * h * (beta - 1.0 / 6.0));
                largest = largest.max(error.angular.norm()).max(error.linear.norm() / core.grid.length);
            }
        }
        made.error = largest;
        Ok(made)
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

impl Alpha {
    /// The algorithmic accelerations at the end of a step, a = (φ − h v_n − h²(½ − β) a_n)/(β h²).
    fn accelerate<const S: usize>(&self, core: &Core<S>, present: &mut Present<S>, h: f64) {
        let (ahead, scale) = (h * h * (0.5 - self.beta), 1.0 / (self.beta * h * h));
        for (i, points) in present.points.iter_mut().enumerate() {
            for (k, point) in points.iter_mut().enumerate() {
                let phi = core.rates[i][k].phi;
                point.algorithmic = (phi - point.velocity * h - point.algorithmic * ahead) * scale;
                let change = core.strain[i][k] - point.strain;
                point.strain_second = (change - point.strain_rate * h - point.strain_second * ahead) * scale;
            }
        }
        let base = &mut present.base;
        if core.base_rates.phi == Twist::zero() {
            return; // the base does not follow the scheme
        }
        base.algorithmic = (core.base_rates.phi - base.velocity * h - base.algorithmic * ahead) * scale;
    }
}

/// Puts the beginning of a step into the constants of its solves.
fn begin_step<const S: usize>(core: &mut Core<S>, present: &Present<S>) {
    core.problem.stiffness = 1.0;
    core.problem.base_before = present.base.pose;
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
        self.base.pose = core.base;
        self.base.velocity = core.base_rates.velocity;
        self.base.acceleration = core.base_rates.acceleration;
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
    fn power(&self, work: bool) -> [f64; 2] {
        let (mut damping, mut given) = (0.0, 0.0);
        for (i, viscosity) in self.grid.viscosity.iter().enumerate() {
            for k in 0..S {
                let rate = self.strain_rate[i][k].to_vector();
                damping += self.grid.weight(k) * rate.dot(&(viscosity[k] * rate));
            }
        }
        if work {
            for (loads, rates) in self.load.iter().zip(&self.rates) {
                for k in 0..S {
                    given += self.grid.weight(k) * rates[k].velocity.pair(&loads[k].wrench);
                }
            }
            given += self.node_velocities(|_| ()).pair(&self.tip_load.wrench);
            given -= self.base_rates.velocity.pair(&self.node_wrench[0]);
        }
        [damping, given]
    }
}

/// w_j with ∫₀ᶜ p = Σ w_j p(x_j) for polynomials p of degree below the number of nodes, at most four.
fn integral_weights(nodes: &[f64], c: f64) -> [f64; 4] {
    let mut weights = [0.0; 4];
    for (j, &x) in nodes.iter().enumerate() {
        // the Lagrange polynomial of node j, constant term first
        let mut p = [1.0, 0.0, 0.0, 0.0];
        for (_, &other) in nodes.iter().enumerate().filter(|(m, _)| *m != j) {
            let scale = 1.0 / (x - other);
            for q in (0..4).rev() {
                let lower = if q > 0 { p[q - 1] } else { 0.0 };
                p[q] = (lower - other * p[q]) * scale;
            }
        }
        weights[j] = (0..4).rev().fold(0.0, |sum, q| (sum + p[q] / (q + 1) as f64) * c);
    }
    weights
}
