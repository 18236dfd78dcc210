use thiserror::Error;

use super::{Report, Rung, Stability, StaticSolution};
use crate::error::Error;

/// Why a solve ended without an answer.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Reason {
    /// The options make no sense.
    #[error("{0}")]
    Options(Error),
    /// The supports do not hold the rod.
    #[error("{0}")]
    Supports(Error),
    /// The rod cannot be evaluated where the solve starts, at its reference shape.
    #[error("the rod cannot be evaluated at its reference shape: {0}")]
    Start(Error),
    /// No step, however short, leads to an admissible state.
    #[error(
        "no admissible step: even {fraction:.1e} of the Newton step of iteration {iteration} fails ({error})"
    )]
    NoAdmissibleStep {
        /// Iteration, counted from 0.
        iteration: usize,
        /// The last fraction tried.
        fraction: f64,
        /// What was wrong with the trial state.
        error: Error,
    },
    /// The tangent has no inverse: a limit point, or a mechanism.
    #[error(
        "the tangent of iteration {iteration} is singular ({error}): a limit point of the load, or a rod that is free to move"
    )]
    Singular {
        /// Iteration, counted from 0.
        iteration: usize,
        /// Where.
        error: Error,
    },
    /// The accuracy asked for is out of reach: of the largest mesh, or of rounding.
    #[error(
        "accuracy {asked:.1e} is not reached: estimated {estimated:.1e} with {elements} elements; rounding alone may forbid it"
    )]
    Accuracy {
        /// What was asked for.
        asked: f64,
        /// The estimated error of the last mesh, as [`ErrorEstimate::relative`](super::ErrorEstimate::relative) has it.
        estimated: f64,
        /// The elements of the last mesh.
        elements: usize,
    },
    /// Every equilibrium that was found is unstable. The last state of the failure is one.
    #[error(
        "an equilibrium was found, but no stable one ({stability}); accept_unstable takes it as the answer"
    )]
    Unstable {
        /// How it is unstable.
        stability: Stability,
    },
    /// No tension was found at which a tendon has the length asked for.
    #[error("no tension makes the tendon {asked} m long: {found} m after {solves} solves")]
    Length {
        /// What was asked for, m.
        asked: f64,
        /// The length of the last solve, m.
        found: f64,
        /// How many solves were made.
        solves: usize,
    },
    /// The path of equilibria from rest turns back before the full load, and none was found beyond.
    #[error(
        "no equilibrium was found: from rest the load can grow to {load_factor:.4} of what is asked; there the rod snaps, or moves on and on"
    )]
    LimitPoint {
        /// The largest load factor on the path. The last state of the failure is the equilibrium there.
        load_factor: f64,
    },
    /// The iteration limit was reached with steps that lead out of what is admissible.
    #[error(
        "no convergence in {limit} iterations: only {fraction:.1e} of the last step, {step:.1e}, could be taken; more of it fails ({error})"
    )]
    ShortSteps {
        /// The limit.
        limit: usize,
        /// The part of the last step that was taken.
        fraction: f64,
        /// The whole step.
        step: f64,
        /// What was wrong with a state that more of the step leads to.
        error: Error,
    },
    /// No answer, and a section that is far from free of stress at rest.
    #[error(
        "the section has stress at rest: before anything acts, a force of {force:.3e} N strains it by {strain:.2}, from its law or its actuators; `material::ReferencePressure` or `StressFree` takes it off a law; {then}"
    )]
    StressAtRest {
        /// Size of the force that the section has at s = 0 at its reference strain, N.
        force: f64,
        /// The stretch or shear that its tangent there makes of it.
        strain: f64,
        /// How the solve ended.
        then: Box<Reason>,
    },
    /// The iteration limit was reached.
    #[error(
        "no convergence in {limit} iterations: last step {step:.3e}, asked {tolerance:.1e}, nor by way of smaller loads; raise the limit, or trace the path to see how far the load can grow"
    )]
    IterationLimit {
        /// The limit.
        limit: usize,
        /// The last step.
        step: f64,
        /// The step asked for.
        tolerance: f64,
    },
}

/// A solve that failed: why, how it went, and the last state it had.
///
/// Its `Debug` form, which a `main` that returns it prints, is short: the reason, what was tried and the number of iterations.
#[derive(Clone, PartialEq, Error)]
#[error("static solve failed: {reason}{}", tried(.report))]
pub struct Failure {
    /// Why.
    #[source]
    pub reason: Reason,
    /// How it went.
    pub report: Report,
    /// The last admissible state, an equilibrium where the reason says so; `None` if there was none.
    pub last: Option<StaticSolution>,
}

impl Failure {
    /// Without a state to show.
    pub(super) fn stateless(reason: Reason, report: Report) -> Box<Self> {
        Box::new(Self { reason, report, last: None })
    }

    /// Of what was asked for, before a solve began.
    pub(super) fn of_options(error: Error) -> Box<Self> {
        Self::stateless(Reason::Options(error), Report::default())
    }
}

/// What was tried, where that was more than Newton's method.
fn tried(report: &Report) -> String {
    if report.rungs.iter().all(|rung| *rung == Rung::Newton) {
        return String::new();
    }
    let rungs: Vec<String> = report.rungs.iter().map(Rung::to_string).collect();
    format!(" (tried: {})", rungs.join(", "))
}

impl std::fmt::Debug for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let nodes = self.last.as_ref().map_or(0, |last| last.nodes().len());
        let iterations = self.report.iterations.len();
        write!(f, "{self} (after {iterations} iterations; `last` has {nodes} nodes)")
    }
}
