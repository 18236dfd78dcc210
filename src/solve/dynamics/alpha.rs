//! A step of generalised-α: one implicit instant.

use super::core::Core;
use super::failure::Reason;
use super::march::{Attempt, March};
use super::present::Present;
use super::relation::{Offset, Relation};
use super::scene::Movable;
use super::scheme::Alpha;
use crate::lie::Twist;

impl<const S: usize> March<S> {
    pub(super) fn alpha<B: Movable>(
        &mut self,
        attempt: &mut Attempt<'_, '_, B, S>,
        a: &Alpha,
    ) -> Result<(), Reason> {
        let Attempt { core, scene, present, dt: h, .. } = attempt;
        let (present, h) = (*present, *h);
        let beta = a.beta;
        let (velocity, acceleration) = a.slopes(h);
        core.problem.relation = Relation::Newmark { velocity, acceleration };
        for (mount, m) in core.mounts.iter_mut().zip(&present.mounts) {
            mount.offset = a.offset(h, [m.velocity, m.acceleration, m.algorithmic]);
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
                core.problem.offset[i][k] =
                    a.offset(h, [point.velocity, point.acceleration, point.algorithmic]);
                let (rate, second) = (point.strain_rate, point.strain_second);
                let p = rate * h + second * (h * h * (0.5 - beta));
                core.problem.strain_offset[i][k] = rate + second * (h * (1.0 - a.gamma)) - p * velocity;
                // differences of the strains themselves: in what has no inertia, the rates of the scheme are noise
                core.strain[i][k] = point.strain
                    + if known {
                        self.last_rates[0][i][k] * (2.0 * h) - self.last_rates[1][i][k] * h
                    } else {
                        rate * h + second * (0.5 * h * h)
                    };
            }
        }
        self.solve(attempt)?;
        let Attempt { core, how, made, .. } = attempt;
        made.power = core.power(how.track_work);
        made.error = a.error(core, present, h);
        Ok(())
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
    /// By how much velocity and acceleration change with φ over a step h: γ/(β h), and (1 − α_m)/((1 − α_f) β h²).
    fn slopes(&self, h: f64) -> (f64, f64) {
        (self.gamma / (self.beta * h), (1.0 - self.alpha_m) / ((1.0 - self.alpha_f) * self.beta * h * h))
    }

    /// φ as far as it is known at the beginning of a step, h v_n + h²(½ − β) a_n.
    fn ahead(&self, h: f64, velocity: Twist, algorithmic: Twist) -> Twist {
        velocity * h + algorithmic * (h * h * (0.5 - self.beta))
    }

    /// What does not depend on φ, of velocity, acceleration and algorithmic acceleration at the beginning.
    fn offset(&self, h: f64, [v, dv, a_n]: [Twist; 3]) -> Offset {
        let (p, (velocity, acceleration)) = (self.ahead(h, v, a_n), self.slopes(h));
        Offset {
            velocity: v + a_n * (h * (1.0 - self.gamma)) - p * velocity,
            acceleration: (a_n * self.alpha_m - dv * self.alpha_f) * (1.0 / (1.0 - self.alpha_f))
                - p * acceleration,
        }
    }

    /// What a linear acceleration would have added to φ: the largest rotation, or displacement over the length. Source: Zienkiewicz and Xie (1991).
    fn error<const S: usize>(&self, core: &Core<S>, present: &Present<S>, h: f64) -> f64 {
        let mut largest: f64 = 0.0;
        for (points, rates) in present.points.iter().zip(&core.rates) {
            for (point, rates) in points.iter().zip(rates) {
                let p = self.ahead(h, point.velocity, point.algorithmic);
                let after = (rates.phi - p) * (1.0 / (self.beta * h * h));
                let error = (after - point.algorithmic) * (h * h * (self.beta - 1.0 / 6.0));
                largest = largest.max(error.angular.norm()).max(error.linear.norm() / core.grid.length);
            }
        }
        largest
    }

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
