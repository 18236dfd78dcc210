//! Newton's method for one instant, with factors that are kept while it converges fast.

use super::core::Core;
use super::failure::Reason;
use super::relation::Relation;
use super::scene::{Movable, Scene};
use crate::lie::Twist;
use crate::material::Request;

/// Factors are renewed where an iteration reduces the step by less than this.
const SLOW: f64 = 0.1;

/// A factorisation costs as much as so many iterations, or somewhat less.
const WORTH: f64 = 4.0;

/// The rate that a fresh tangent is trusted with until it is known.
const FRESH: f64 = 0.05;

/// A rate below this is not relied on.
const LEAST_RATE: f64 = 0.01;

/// A fresh tangent that does not reduce the step by this will not converge.
const HOPELESS: f64 = 2.0;

/// The largest rotation of a node in one iteration, rad.
const ROTATION_CAP: f64 = 1.0;

/// The largest rotation of a section in one time step, rad: beyond π its logarithm is another one.
const LARGEST_TURN: f64 = 2.5;

/// How often a step to an inadmissible state is halved.
const HALVINGS: usize = 8;

/// A step below this that no longer shrinks is rounding.
const ROUNDING_STEP: f64 = 1e-9;

/// So many steps below that are enough, however they go.
const SMALL_STEPS: usize = 5;

/// What Newton's method keeps from one solve to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Memory {
    /// The relation the factors are for; `None` without factors.
    pub(super) factored: Option<Relation>,
    /// By what an iteration reduced the step, lately.
    pub(super) rate: f64,
}

impl Memory {
    pub(super) fn empty() -> Self {
        Self { factored: None, rate: FRESH }
    }
}

/// How a solve went.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Effort {
    pub(super) iterations: usize,
    pub(super) factorisations: usize,
}

pub(super) struct Newton<'a> {
    pub(super) tolerance: f64,
    pub(super) max_iterations: usize,
    pub(super) memory: &'a mut Memory,
    pub(super) effort: &'a mut Effort,
}

impl Newton<'_> {
    /// Improves the strains (and the base, where it is free) of `core` until they satisfy the balance; poses and rates then belong to them.
    pub(super) fn solve<B: Movable, const S: usize>(
        &mut self,
        core: &mut Core<S>,
        scene: &Scene<'_, B>,
    ) -> Result<(), Reason> {
        let mut renew = self.memory.factored != Some(core.problem.relation);
        let (mut previous, mut taken, mut halvings, mut fresh) = (f64::INFINITY, 0.0, 0, false);
        let (mut last, mut small_steps) = ((0.0, 0.0), 0);
        for iteration in 0..self.max_iterations {
            core.move_to_strains();
            let request = if renew { Request::Tangent } else { Request::Wrench };
            if let Err(error) = core.respond(scene, request) {
                if iteration == 0 || halvings == HALVINGS {
                    return Err(Reason::Inadmissible(error));
                }
                halvings += 1;
                taken *= 0.5;
                core.advance(-taken);
                previous = f64::INFINITY;
                continue;
            }
            core.balance();
            if renew {
                core.factor().map_err(Reason::Singular)?;
                self.memory.factored = Some(core.problem.relation);
                self.memory.rate = FRESH;
                self.effort.factorisations += 1;
                fresh = true;
                previous = f64::INFINITY; // by another tangent
            }
            let step = core.newton_step().map_err(Reason::Singular)?;
            self.effort.iterations += 1;
            last = (step.size, step.s);
            let known = previous.is_finite();
            small_steps += usize::from(step.size < ROUNDING_STEP);
            let rounding =
                step.size < ROUNDING_STEP && (step.size > 0.5 * previous || small_steps == SMALL_STEPS);
            if known && !rounding {
                self.memory.rate = (step.size / previous).clamp(LEAST_RATE, 1.0);
                if fresh && step.size > HOPELESS * previous {
                    break;
                }
            }
            renew = known && !rounding && self.is_slow(step.size);
            taken = (ROTATION_CAP / step.rotation).min(1.0);
            core.advance(taken);
            let left = step.size * self.memory.rate / (1.0 - self.memory.rate.min(0.5));
            let small = step.size <= self.tolerance || left <= self.tolerance || rounding;
            if taken == 1.0 && small {
                core.move_to_strains();
                return turned_too_far(core);
            }
            previous = if taken == 1.0 { step.size } else { f64::INFINITY };
        }
        self.memory.factored = None;
        let (step, s) = last;
        Err(Reason::NoConvergence { limit: self.max_iterations, step, s })
    }
}

impl Newton<'_> {
    /// Whether new factors are cheaper than the iterations that the old ones would still need.
    fn is_slow(&self, step: f64) -> bool {
        let rate = self.memory.rate;
        let needed = (self.tolerance / step).ln() / rate.ln();
        rate > SLOW || needed > WORTH
    }
}

/// Whether a section turned so far that the logarithm of its motion is in doubt.
fn turned_too_far<const S: usize>(core: &Core<S>) -> Result<(), Reason> {
    let turn = |phi: &Twist| phi.angular.norm_squared();
    for (i, rates) in core.rates.iter().enumerate() {
        for (k, rates) in rates.iter().enumerate() {
            if turn(&rates.phi) > LARGEST_TURN * LARGEST_TURN {
                let angle = turn(&rates.phi).sqrt();
                return Err(Reason::TooLargeTurn { angle, s: core.grid.stage_s(i, k) });
            }
        }
    }
    Ok(())
}
