//! A step of ESDIRK: five implicit instants, each from the slopes of those before.

use super::core::Core;
use super::failure::Reason;
use super::march::{How, Made, March, begin_step};
use super::present::Present;
use super::relation::{Offset, Relation};
use super::scene::{Movable, Scene};
use super::scheme::{A, B as WEIGHTS, B_EMBEDDED, C, GAMMA, STAGES};
use crate::lie::{Strain, Twist};

impl<const S: usize> March<S> {
    pub(super) fn runge_kutta<B: Movable>(
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
        for (slopes, m) in first.mounts.iter_mut().zip(&present.mounts) {
            *slopes = [m.velocity, m.acceleration];
        }
        first.power = present.power;
        for (slopes, points) in first.points.iter_mut().zip(&present.points) {
            *slopes = points.map(|p| (p.velocity, p.acceleration, p.strain_rate));
        }
        core.problem.relation = Relation::RungeKutta { c: 1.0 / (GAMMA * dt) };
        for stage in 1..STAGES {
            self.set_offsets(core, present, stage, dt);
            core.at_time(scene, present.time + C[stage] * dt).map_err(Reason::Inadmissible)?;
            self.guess(core, present, stage, dt);
            self.solve(core, scene, present, how, &mut made)?;
            let slopes = &mut self.slopes[stage];
            for (slopes, mount) in slopes.mounts.iter_mut().zip(&core.mounts) {
                *slopes = [mount.rates.slope, mount.rates.acceleration];
            }
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
    pub(super) fn keep_slopes(&mut self, present: &mut Present<S>, dt: f64) {
        for (old, new) in [(0, STAGES - 2), (1, STAGES - 3)] {
            for (rates, slopes) in self.last_rates[old].iter_mut().zip(&self.slopes[new].points) {
                *rates = slopes.map(|(_, _, rate)| rate);
            }
            self.last_base[old] = self.slopes[new].mounts[0][0];
        }
        let sum = |which: usize| -> f64 {
            (0..STAGES).map(|j| WEIGHTS[j] * self.slopes[j].power[which]).sum::<f64>() * dt
        };
        present.dissipated += sum(0);
        present.work += sum(1);
    }

    /// φ̇₀ = −Σ a_ij φ̇_j/γ, η̇₀ = −η_n/(γΔt) − Σ a_ij η̇_j/γ, ξ̇₀ = −Σ a_ij ξ̇_j/γ.
    #[inline(always)]
    fn set_offsets(&self, core: &mut Core<S>, present: &Present<S>, stage: usize, dt: f64) {
        let c = 1.0 / (GAMMA * dt);
        let weights: [f64; STAGES] = std::array::from_fn(|j| -A[stage][j] / GAMMA);
        let earlier = &self.slopes[..stage];
        for (m, mount) in core.mounts.iter_mut().enumerate() {
            let acceleration = present.mounts[m].velocity * -c;
            mount.offset = Offset { velocity: Twist::zero(), acceleration };
            for (slopes, &weight) in earlier.iter().zip(&weights) {
                let [slope, acceleration] = slopes.mounts[m];
                mount.offset.velocity += slope * weight;
                mount.offset.acceleration += acceleration * weight;
            }
        }
        let p = &mut core.problem;
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
    fn guess(&self, core: &mut Core<S>, present: &Present<S>, stage: usize, dt: f64) {
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
                source => self.slopes[source as usize].mounts[0][0],
            } * (dt * weights[j]);
        }
        if core.loose {
            core.base = present.base().pose * phi.exp();
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
