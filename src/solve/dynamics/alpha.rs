//! A step of generalised-α: one implicit instant.

use super::core::Core;
use super::failure::Reason;
use super::march::{How, Made, March, begin_step};
use super::present::Present;
use super::relation::{Offset, Relation};
use super::scene::{Movable, Scene};
use super::scheme::Alpha;
use crate::lie::Twist;

impl<const S: usize> March<S> {
    pub(super) fn alpha<B: Movable>(
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
        for (mount, m) in core.mounts.iter_mut().zip(&present.mounts) {
            mount.offset = offset(m.velocity, m.acceleration, m.algorithmic);
        }
        core.at_time(scene, present.time + h).map_err(Reason::Inadmissible)?;
        let known = self.last_step > 0.0;
        if core.loose {
            let base = present.base();
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

    /// Mean rates of the last two steps.
    pub(super) fn keep_differences(&mut self, core: &Core<S>, present: &Present<S>, dt: f64) {
        let first = self.last_step == 0.0;
        self.last_rates.swap(0, 1);
        for (i, points) in present.points.iter().enumerate() {
            for (k, point) in points.iter().enumerate() {
                self.last_rates[0][i][k] = (core.strain[i][k] - point.strain) * (1.0 / dt);
            }
        }
        self.last_base = [core.base_rates().phi * (1.0 / dt), self.last_base[0]];
        if first {
            let [last, before] = &mut self.last_rates;
            before.clone_from(last);
            self.last_base[1] = self.last_base[0];
        }
    }
}

impl Alpha {
    /// The algorithmic accelerations at the end of a step, a = (φ − h v_n − h²(½ − β) a_n)/(β h²).
    pub(super) fn accelerate<const S: usize>(&self, core: &Core<S>, present: &mut Present<S>, h: f64) {
        let (ahead, scale) = (h * h * (0.5 - self.beta), 1.0 / (self.beta * h * h));
        for (i, points) in present.points.iter_mut().enumerate() {
            for (k, point) in points.iter_mut().enumerate() {
                let phi = core.rates[i][k].phi;
                point.algorithmic = (phi - point.velocity * h - point.algorithmic * ahead) * scale;
                let change = core.strain[i][k] - point.strain;
                point.strain_second = (change - point.strain_rate * h - point.strain_second * ahead) * scale;
            }
        }
        for (motion, mount) in present.mounts.iter_mut().zip(&core.mounts).filter(|(_, m)| m.follows) {
            let phi = mount.rates.phi;
            motion.algorithmic = (phi - motion.velocity * h - motion.algorithmic * ahead) * scale;
        }
    }
}
