//! From a coarse mesh to a fine one: every mesh starts Newton's method with the strain polynomials of the one before.

use super::describe::{describe, failed, strain_correction};
use super::estimate::{Defect, Level, cuts, difference, estimate, first_elements, promised};
use super::failure::{Failure, Reason};
use super::globalise::unstable;
use super::linear::Buffers;
use super::mesh::Mesh;
use super::newton::{Newton, Outcome, Stop};
use super::report::Report;
use super::rigid;
use super::solution::StaticSolution;
use super::taut;
use super::unknowns::Unknowns;
use crate::body::Elastic;
use crate::error::Error;
use crate::lie::{Strain, Wrench};
use crate::material::Request;
use crate::rod::Rod;

/// Meshes a solve to an accuracy may try.
const MAX_LEVELS: usize = 16;

/// The most elements it may use.
const MAX_ELEMENTS: usize = 20_000;

/// Meshes on which the estimate does not fall, of which more are no use.
const MAX_STALLS: usize = 2;

/// An element is cut into at most this many pieces at a time: further the prediction does not reach.
const MOST_PARTS: f64 = 7.0;

/// As [`MOST_PARTS`], of the first mesh, whose error is only guessed.
const FIRST_PARTS: f64 = 4.0;

/// The error that Newton's method may leave on the first mesh, whose own is larger.
const FIRST_NEWTON: f64 = 1e-3;

/// The same on a finer mesh, however little is asked: pivots of a step larger than this tell nothing of stability, and to find that out
/// otherwise costs ten times the iteration that is spared.
const MOST_NEWTON: f64 = 1e-4;

/// The error that Newton's method may leave on a mesh, of that of the mesh.
const NEWTON_SHARE: f64 = 0.02;

/// A larger amplification is that of a residual which does not see what the step mends: supports that move a rod at rest.
const MOST_AMPLIFIED: f64 = 1e3;

/// What a Newton step of size s leaves is of size s²; a residual of more than so many times that is not one it could remove.
const LEFT: f64 = 100.0;

/// A residual that rounding may leave.
const ROUNDING_RESIDUAL: f64 = 1e-10;

/// The most elements of a first mesh that an earlier solution asks for: enough for a shape.
const MOST_FIRST: usize = 64;

/// A section that strains itself by more than this is not meant to.
const MUCH: f64 = 0.2;

/// What a support holds to no effect may differ by this, rad and lengths, from what fixed strains make of it.
const HELD: f64 = 1e-6;

/// How often a first mesh on which Newton's method fails is made four times finer.
const FIRST_MESHES: u32 = 3;

pub(super) struct Cascade<'r, 'o, B, const S: usize> {
    rod: &'r Rod<B>,
    pub(super) newton: Newton<'o>,
    pub(super) buffers: &'o mut Buffers<S>,
    pub(super) report: Report,
    /// Whose shape Newton's method starts from, where it is given.
    pub(super) earlier: Option<&'o StaticSolution>,
    /// Whether an equilibrium that would not stay is an answer.
    pub(super) accept_unstable: bool,
    /// Whether the first mesh already is to have a stable state: after an answer that was none.
    pub(super) careful: bool,
    /// The first of the meshes on which the further rungs are climbed.
    pub(super) tier: usize,
    /// Whether every rung was climbed in vain.
    pub(super) exhausted: bool,
    /// The failure for which the further rungs are to be climbed at once.
    pub(super) failed: Option<Box<Failure>>,
    /// Where the path from rest turns back, if it does: the load factor and the rod there.
    pub(super) turned: Option<(f64, StaticSolution)>,
    /// Neutral modes of the last state whose stability was told.
    pub(super) neutral: usize,
}

type Solved = Result<StaticSolution, Box<Failure>>;

impl<'r, 'o, B: Elastic, const S: usize> Cascade<'r, 'o, B, S> {
    pub(super) fn new(
        rod: &'r Rod<B>,
        newton: Newton<'o>,
        buffers: &'o mut Buffers<S>,
        accept_unstable: bool,
    ) -> Self {
        Self {
            rod,
            newton,
            buffers,
            report: Report::default(),
            earlier: None,
            accept_unstable,
            careful: false,
            tier: 0,
            exhausted: false,
            failed: None,
            turned: None,
            neutral: 0,
        }
    }

    /// A mesh of so many equal elements, then one of twice as many, which is the answer.
    pub(super) fn on_mesh(&mut self, coarse_elements: usize) -> Solved {
        self.persistently(|cascade| cascade.on_mesh_once(coarse_elements))
    }

    /// Again, from a start that is looked for with more care, where there may be an answer that was not found.
    fn persistently(&mut self, solve: impl Fn(&mut Self) -> Solved) -> Solved {
        loop {
            match solve(self) {
                Err(failure) if retried(&failure.reason) && self.next_try(&failure) => {}
                solved => return solved.map_err(|failure| self.with_stress_at_rest(failure)),
            }
        }
    }

    /// Says of a failure that the section strains itself, where it does so by much: laws that forget their pressure are a common cause.
    fn with_stress_at_rest(&self, mut failure: Box<Failure>) -> Box<Failure> {
        let told = !matches!(failure.reason, Reason::Accuracy { .. }) && retried(&failure.reason)
            || matches!(failure.reason, Reason::LimitPoint { .. });
        let (body, rest) = (self.rod.body(), Strain::zero());
        if told
            && let Ok(response) = body.respond(0.0, &rest, Request::Wrench)
            && let Some(change) = strain_correction(body, 0.0, &Wrench::zero(), &rest)
            && let Some(strain) = change.linear.iter().copied().find(|strain| strain.abs() > MUCH)
        {
            let then = Box::new(failure.reason);
            failure.reason = Reason::StressAtRest { force: response.wrench.force.norm(), strain, then };
        }
        failure
    }

    fn on_mesh_once(&mut self, coarse_elements: usize) -> Solved {
        self.check_supports()?;
        let coarse_mesh = Mesh::<B, S>::uniform(self.rod, coarse_elements);
        let (coarse_mesh, coarse) = self.climb(std::iter::once(coarse_mesh))?;
        let parts = vec![2; coarse_mesh.elements()];
        let mut mesh = coarse_mesh.refined(&parts);
        let start = coarse.unknowns.prolonged(&coarse_mesh, &parts, None);
        self.hold_neutral_modes(&mut mesh, &start);
        let fine = self.solve_near(&mesh, start)?;
        if let (Some(coarse), Some(fine)) = (&coarse.state, &fine.state) {
            // a difference of (2^p − 1) errors of the finer one
            let factor = 1.0 / (4.0_f64.powi(S as i32) - 1.0);
            let length = self.rod.body().length();
            self.report.error = difference(coarse, fine, parts.into_iter(), length)
                .scaled(factor)
                .at_least(self.rounding(mesh.elements()), length);
        }
        let answer = self.answer(&mesh, &fine, None);
        for outcome in [coarse, fine] {
            outcome.recycle(self.buffers);
        }
        answer
    }

    /// Cuts elements until the estimated error is below `accuracy`.
    pub(super) fn to(&mut self, accuracy: f64) -> Solved {
        self.persistently(|cascade| cascade.reach_once(accuracy))
    }

    fn reach_once(&mut self, accuracy: f64) -> Solved {
        self.check_supports()?;
        let length = self.rod.body().length();
        self.newton.stop = Stop::Error(FIRST_NEWTON);
        let mut level = self.first_level()?;
        // the sum of the defects is of the size of the error: enough to choose the second mesh
        let mut predicted = level.defect.total();
        let mut parts = cuts(&level.defect.shares, accuracy / predicted, 2 * S, FIRST_PARTS);
        let (mut best, mut stalls) = (f64::INFINITY, 0);
        for _ in 0..MAX_LEVELS {
            predicted *= promised(&level.defect.shares, &parts, 2 * S);
            self.newton.stop =
                Stop::Error((NEWTON_SHARE * predicted.max(accuracy)).clamp(1e-18, MOST_NEWTON));
            let fine = self.finer(&level, &parts)?;
            self.report.error =
                estimate(&level, &fine, &parts, length).at_least(self.rounding(fine.mesh.elements()), length);
            let estimated = self.report.error.relative(length);
            if estimated <= accuracy {
                let answer = self.answer(&fine.mesh, &fine.outcome, Some(&fine.defect.ends));
                for outcome in [level.outcome, fine.outcome] {
                    outcome.recycle(self.buffers);
                }
                return answer;
            }
            parts = cuts(&fine.defect.shares, accuracy / estimated, 2 * S, MOST_PARTS);
            predicted = estimated;
            let elements: usize = parts.iter().sum();
            std::mem::replace(&mut level, fine).outcome.recycle(self.buffers);
            if estimated > 0.5 * best {
                stalls += 1;
            }
            // below 1e-9 an error that no longer falls is rounding
            if elements > MAX_ELEMENTS || stalls > MAX_STALLS || (estimated < 1e-9 && estimated > 0.5 * best)
            {
                break;
            }
            best = best.min(estimated);
        }
        let elements = level.mesh.elements();
        let estimated = self.report.error.relative(length);
        let reason = Reason::Accuracy { asked: accuracy, estimated, elements };
        let last = self.answer(&level.mesh, &level.outcome, Some(&level.defect.ends)).ok();
        Err(Box::new(Failure { reason, report: self.report.clone(), last }))
    }

    /// What rounding alone leaves: poses are products along the mesh, whose errors of ε each add up as a random walk; wrenches are known to ε of the
    /// largest, of which Newton's method makes [`amplification`](Newton::amplification) times as much.
    fn rounding(&self, elements: usize) -> f64 {
        f64::EPSILON * ((elements as f64).sqrt() + self.newton.amplification.min(MOST_AMPLIFIED))
    }

    /// Refuses a rod that nothing holds.
    fn check_supports(&mut self) -> Result<(), Box<Failure>> {
        let probe = Mesh::<B, S>::uniform(self.rod, 1);
        if probe.is_cantilever() {
            return Ok(());
        }
        let mut state = self.buffers.configuration();
        // what cannot be evaluated is found again, and named, by the solve
        let held = match probe.configure(&Unknowns::at_rest(&probe), &mut state) {
            Ok(()) => taut::check(&probe).and_then(|()| rigid::check(&probe, &state)),
            Err(_) => Ok(()),
        };
        self.buffers.recycle(state);
        held.map_err(|error| Failure::stateless(Reason::Supports(error), self.report.clone()))
    }

    /// The first mesh, from rest; a finer one where Newton's method fails on it.
    fn first_level(&mut self) -> Result<Level<'r, B, S>, Box<Failure>> {
        let probe = Mesh::<B, S>::uniform(self.rod, 1);
        let mut state = self.buffers.configuration();
        let elements = match probe.configure(&Unknowns::at_rest(&probe), &mut state) {
            Ok(()) => first_elements(&probe, &state),
            Err(_) => 2, // the solve finds the same, and says so
        };
        self.buffers.recycle(state);
        // with both ends held, those alone would tell nothing of the error between
        let elements = elements.max(if probe.is_cantilever() { 1 } else { 2 });
        // half as fine as a shape that is known already, within reason
        let known = self.earlier.map_or(0, |earlier| earlier.nodes().len() / 2);
        let elements = elements.max(known.min(MOST_FIRST));
        let rod = self.rod;
        let meshes = (0..FIRST_MESHES).map(|trial| Mesh::uniform(rod, elements * 4_usize.pow(trial)));
        let (mesh, outcome) = self.climb(meshes)?;
        Ok(Self::level_of(mesh, outcome))
    }

    /// The next mesh, from the strains of the last with what is known of their ends; from the strains alone where those go out of what is admissible.
    fn finer(&mut self, level: &Level<'r, B, S>, parts: &[usize]) -> Result<Level<'r, B, S>, Box<Failure>> {
        let start = |ends| level.outcome.unknowns.prolonged(&level.mesh, parts, ends);
        match self.level(level.mesh.refined(parts), start(Some(&level.defect.ends))) {
            Err(failure) if matches!(failure.reason, Reason::NoAdmissibleStep { iteration: 0, .. }) => {
                self.level(level.mesh.refined(parts), start(None))
            }
            finer => finer,
        }
    }

    fn level(
        &mut self,
        mut mesh: Mesh<'r, B, S>,
        start: Unknowns<S>,
    ) -> Result<Level<'r, B, S>, Box<Failure>> {
        self.hold_neutral_modes(&mut mesh, &start);
        let outcome = self.solve_near(&mesh, start)?;
        Ok(Self::level_of(mesh, outcome))
    }

    fn level_of(mesh: Mesh<'r, B, S>, outcome: Outcome<S>) -> Level<'r, B, S> {
        let defect = match &outcome.state {
            Some(state) => Defect::of(&mesh, &outcome.unknowns.strains, state),
            None => Defect::none(mesh.elements()),
        };
        Level { mesh, outcome, defect }
    }

    pub(super) fn solve(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        start: Unknowns<S>,
    ) -> Result<Outcome<S>, Box<Failure>> {
        let from = (!self.buffers.neutral.is_empty()).then(|| start.clone());
        let mut outcome = self.newton.solve(mesh, start, self.buffers, &mut self.report.iterations);
        self.buffers.neutral.clear();
        if let Some(from) = from
            && outcome.residual > LEFT * outcome.last_step.powi(2) + ROUNDING_RESIDUAL
        {
            // a mode that was kept out of the steps was not neutral
            outcome = self.newton.solve(mesh, from, self.buffers, &mut self.report.iterations);
        }
        self.report.residual = outcome.residual;
        if outcome.failure.is_some() {
            return Err(failed(mesh, outcome, self.report.clone()));
        }
        Ok(outcome)
    }

    /// As [`solve`](Self::solve), from a coarser mesh's answer: where Newton's method leaves it, by the convex model.
    fn solve_near(&mut self, mesh: &Mesh<'r, B, S>, start: Unknowns<S>) -> Result<Outcome<S>, Box<Failure>> {
        let from = self.careful.then(|| start.clone());
        // what fails without care may have begun with a state that is none
        let near = self.solve(mesh, start).or_else(|failure| {
            let found = from.and_then(|from| self.descend(mesh, &from)).ok_or(failure)?;
            self.solve(mesh, found)
        });
        near.map_err(not_at_rest)
    }

    /// Refuses supports that hold a rod with fixed strains where it cannot be.
    fn check_redundant(&self, mesh: &Mesh<'_, B, S>, outcome: &Outcome<S>) -> Result<(), Box<Failure>> {
        let (Some(redundant), Some(state)) = (mesh.redundant(), &outcome.state) else { return Ok(()) };
        let tolerance = HELD.max(10.0 * self.report.error.relative(self.rod.body().length()));
        let agreed = redundant.check(mesh, state, tolerance);
        agreed.map_err(|error| Failure::stateless(Reason::Supports(error), self.report.clone()))
    }

    fn answer(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        outcome: &Outcome<S>,
        ends: Option<&[[Strain; 2]]>,
    ) -> Solved {
        self.check_redundant(mesh, outcome)?;
        self.report.stability = self.stability_of(mesh, outcome, self.neutral_in(mesh, outcome));
        if self.report.stability.is_unstable() && !self.accept_unstable {
            return Err(unstable(mesh, outcome, self.report.stability, self));
        }
        let Some(state) = &outcome.state else {
            let reason = Reason::Singular {
                iteration: outcome.iterations,
                error: Error::Singular { matrix: "tangent of the rod", s: 0.0 },
            };
            return Err(Failure::stateless(reason, self.report.clone()));
        };
        Ok(describe(mesh, &outcome.unknowns.strains, state, ends, self.report.clone()))
    }
}

/// A failure at the start of a solve that did not start at rest.
fn not_at_rest(mut failure: Box<Failure>) -> Box<Failure> {
    if let Reason::Start(error) = failure.reason {
        failure.reason = Reason::NoAdmissibleStep { iteration: 0, fraction: 0.0, error };
    }
    failure
}

/// Whether a failure may be one of a state that would not stay, or that costs nothing to turn.
fn retried(reason: &Reason) -> bool {
    matches!(
        reason,
        Reason::Unstable { .. }
            | Reason::Accuracy { .. }
            | Reason::IterationLimit { .. }
            | Reason::ShortSteps { .. }
            | Reason::Singular { .. }
            | Reason::NoAdmissibleStep { .. }
    )
}
