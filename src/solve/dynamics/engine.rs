//! A run of steps on a mesh of one order.

use super::conserve::Kept;
use super::core::Core;
use super::failure::{Failure, Reason};
use super::frame::Frame;
use super::grid::Grid;
use super::march::{How, Made, March};
use super::options::{Adaptive, Dynamics, Step};
use super::present::Present;
use super::relation::Relation;
use super::report::StepReport;
use super::scene::{Movable, Scene};
use super::scheme::Scheme;
use super::state::{SavedMemory, Start, State};
use crate::error::Error;

/// How a stepper looks from outside, whatever the order of its elements.
pub(super) trait Engine {
    fn time(&self) -> f64;
    fn advance(&mut self, limit: f64) -> Result<StepReport, Box<Failure>>;
    fn frame(&mut self) -> Result<Frame, Box<Failure>>;
    fn save(&self) -> State;
}

pub(super) struct Run<'s, 'r, B, const S: usize> {
    scene: &'s Scene<'r, B>,
    core: Core<S>,
    present: Present<S>,
    march: March<S>,
    how: How,
    step: Step,
    /// The step an adaptive run would take next.
    next: f64,
    /// What a conserving run keeps.
    kept: Option<Kept>,
}

/// Memory for a scene on the mesh of the options.
pub(super) fn on_mesh<B: Movable, const S: usize>(
    options: &Dynamics,
    scene: &Scene<'_, B>,
    time: f64,
) -> Result<Core<S>, Box<Failure>> {
    scene.check().map_err(|error| Failure::early(time, Reason::Options(error)))?;
    match Grid::new(scene, options.elements) {
        Ok(grid) => Ok(Core::new(grid, scene)),
        Err(error) => Err(Failure::early(time, Reason::Inadmissible(error))),
    }
}

/// A step that ends closer to the limit than this, relative to its length, is made to end there.
const CLOSE: f64 = 1e-6;

impl<'s, 'r, B: Movable, const S: usize> Run<'s, 'r, B, S> {
    pub(super) fn begin(
        options: &Dynamics,
        scene: &'s Scene<'r, B>,
        start: &Start,
    ) -> Result<Self, Box<Failure>> {
        let early = |reason| Failure::early(start.time, reason);
        let mut core = on_mesh(options, scene, start.time)?;
        let numbers = (options.tolerance, options.max_iterations.max(50), options.first_step());
        let present = Present::begin(&mut core, scene, start, numbers).map_err(early)?;
        let mut run = Self::with(options, scene, core, present);
        if options.conserve {
            let Run { present, core, .. } = &mut run;
            let kept = Kept::of(present, core, scene).map_err(|error| early(Reason::Inadmissible(error)))?;
            run.kept = Some(kept);
        }
        Ok(run)
    }

    pub(super) fn resume(
        options: &Dynamics,
        scene: &'s Scene<'r, B>,
        state: &State,
    ) -> Result<Self, Box<Failure>> {
        let early = |error| Failure::early(state.time, Reason::Options(error));
        let mut core = on_mesh(options, scene, state.time)?;
        let mut present = Present::restore(state, core.grid.elements, core.mounts.len()).map_err(early)?;
        core.at_time(scene, state.time).map_err(early)?;
        present.hold(&mut core);
        core.move_to_strains();
        for (motion, mount) in present.mounts.iter_mut().zip(&core.mounts).skip(1) {
            motion.pose = core.node_pose[mount.node];
        }
        for (points, poses) in present.points.iter_mut().zip(&core.pose) {
            for k in 0..S {
                points[k].pose = poses[k];
            }
        }
        let mut run = Self::with(options, scene, core, present);
        if options.conserve {
            run.kept = state.kept.map(|[energy, momentum @ ..]| Kept { energy, momentum: momentum.into() });
        }
        if let Some(memory) = &state.memory {
            run.recall(memory).map_err(early)?;
        }
        Ok(run)
    }

    fn with(options: &Dynamics, scene: &'s Scene<'r, B>, core: Core<S>, present: Present<S>) -> Self {
        let march = March::new(core.grid.elements, core.mounts.len());
        let how = How {
            scheme: options.scheme,
            tolerance: options.tolerance,
            max_iterations: options.max_iterations,
            track_work: options.track_work,
        };
        Self { scene, core, present, march, how, step: options.step, next: options.first_step(), kept: None }
    }

    fn recall(&mut self, memory: &SavedMemory) -> Result<(), Error> {
        let quantity = "saved memory of a run";
        let wrong =
            Error::Invalid { quantity, value: self.core.grid.elements as f64, requirement: "of this mesh" };
        self.next = memory.next_step;
        self.march.last_step = memory.last_step;
        self.march.memory.rate = memory.rate;
        self.march.memory.factored = Relation::from_numbers(memory.relation);
        self.march.restore_slopes(&memory.slopes).ok_or(wrong.clone())?;
        if self.march.memory.factored.is_some() {
            self.core.restore_factors(&memory.factors).ok_or(wrong)?;
        }
        Ok(())
    }

    fn attempt(&mut self, dt: f64) -> Result<Made, Reason> {
        self.march.attempt(&mut self.core, self.scene, &self.present, dt, &self.how)
    }

    fn accept(&mut self, dt: f64, made: &Made) {
        self.march.accept(&self.core, &mut self.present, dt, &self.how.scheme, made);
        if let Some(kept) = self.kept {
            // strains that Newton's method accepted can be evaluated
            let done = kept.restore(&mut self.present, &mut self.core, self.scene);
            debug_assert!(done.is_ok());
        }
    }

    fn fail(&mut self, time: f64, reason: Reason) -> Box<Failure> {
        let last = Some(Box::new(self.save()));
        let frame = self.describe().ok().map(Box::new);
        Box::new(Failure { time, reason, last, frame })
    }

    /// The present, described: after a step of ESDIRK with rates that are consistent with what is held.
    fn describe(&mut self) -> Result<Frame, Error> {
        let step = self.march.last_step;
        if step > 0.0 && self.how.scheme == Scheme::Esdirk43 && self.scene.is_constrained() {
            let mut consistent = self.present.clone();
            consistent.make_consistent(&mut self.core, self.scene, step)?;
            return consistent.describe(&mut self.core, self.scene);
        }
        self.present.describe(&mut self.core, self.scene)
    }

    fn report(&self, dt: f64, made: &Made, rejected: usize) -> StepReport {
        StepReport {
            time: self.present.time,
            step: dt,
            error: made.error,
            iterations: made.effort.iterations,
            factorisations: made.effort.factorisations,
            rejected,
        }
    }

    /// The length of a step that shall not pass the limit.
    fn clipped(&self, dt: f64, limit: f64) -> f64 {
        let left = limit - self.present.time;
        if dt > left * (1.0 - CLOSE) { left } else { dt }
    }

    fn fixed(&mut self, dt: f64, limit: f64) -> Result<StepReport, Box<Failure>> {
        let left = limit - self.present.time;
        // not to be clipped by rounding, which would cost new factors
        let dt = if (dt - left).abs() < CLOSE * dt { dt } else { self.clipped(dt, limit) };
        match self.attempt(dt) {
            Ok(made) => {
                self.accept(dt, &made);
                Ok(self.report(dt, &made, 0))
            }
            Err(reason) => {
                let time = self.present.time + dt;
                Err(self.fail(time, reason))
            }
        }
    }

    fn adaptive(&mut self, options: &Adaptive, limit: f64) -> Result<StepReport, Box<Failure>> {
        let order = match self.how.scheme {
            Scheme::Esdirk43 => 4.0,
            Scheme::GeneralisedAlpha { .. } => 3.0,
        };
        let mut wanted = self.next.min(options.largest);
        for rejected in 0..options.max_rejections {
            let dt = self.clipped(wanted, limit);
            let cause = match self.attempt(dt) {
                Ok(made) if made.error <= options.tolerance => {
                    self.accept(dt, &made);
                    let factor = 0.9 * (options.tolerance / made.error.max(1e-300)).powf(1.0 / order);
                    // a step that stays keeps its factors
                    let factor = if (0.95..1.3).contains(&factor) { 1.0 } else { factor.clamp(0.3, 2.0) };
                    if dt == wanted || factor < 1.0 {
                        self.next = (dt * factor).min(options.largest);
                    }
                    return Ok(self.report(dt, &made, rejected));
                }
                Ok(made) => {
                    let factor = 0.9 * (options.tolerance / made.error).powf(1.0 / order);
                    wanted = dt * factor.clamp(0.1, 0.8);
                    Reason::Accuracy { estimate: made.error, tolerance: options.tolerance }
                }
                Err(reason) => {
                    wanted = 0.5 * dt;
                    reason
                }
            };
            if wanted < options.least || rejected + 1 == options.max_rejections {
                let time = self.present.time + dt;
                let cause = Box::new(cause);
                let (step, least) = (wanted, options.least);
                return Err(self.fail(time, Reason::StepTooSmall { step, least, cause }));
            }
        }
        let time = self.present.time;
        Err(self.fail(time, Reason::StepLimit { limit: options.max_rejections }))
    }
}

impl<B: Movable, const S: usize> Engine for Run<'_, '_, B, S> {
    fn time(&self) -> f64 {
        self.present.time
    }

    fn advance(&mut self, limit: f64) -> Result<StepReport, Box<Failure>> {
        match self.step {
            Step::Fixed(dt) => self.fixed(dt, limit),
            Step::Adaptive(options) => self.adaptive(&options, limit),
        }
    }

    fn frame(&mut self) -> Result<Frame, Box<Failure>> {
        match self.describe() {
            Ok(frame) => Ok(frame),
            Err(error) => {
                let time = self.present.time;
                Err(self.fail(time, Reason::Inadmissible(error)))
            }
        }
    }

    fn save(&self) -> State {
        let mut state = self.present.save();
        let memory = &self.march.memory;
        state.kept =
            self.kept.map(|Kept { energy, momentum: m }| [energy, m[0], m[1], m[2], m[3], m[4], m[5]]);
        state.memory = Some(SavedMemory {
            next_step: self.next,
            last_step: self.march.last_step,
            rate: memory.rate,
            relation: memory.factored.map_or((0, 0.0, 0.0), |relation| relation.to_numbers()),
            factors: if memory.factored.is_some() { self.core.save_factors() } else { Vec::new() },
            slopes: self.march.save_slopes(),
        });
        state
    }
}
