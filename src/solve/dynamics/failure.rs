use thiserror::Error;

use super::{Frame, State};
use crate::error::Error;

/// Why a step could not be made.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Reason {
    /// The options, or the state to start from, make no sense.
    #[error("{0}")]
    Options(Error),
    /// A section cannot be strained so, or a load is not defined.
    #[error("the rod cannot be evaluated: {0}")]
    Inadmissible(Error),
    /// The linearised rod has no unique answer.
    #[error("the tangent is singular: {0}")]
    Singular(Error),
    /// Newton's method did not converge.
    #[error(
        "no convergence in {limit} iterations: the last Newton step was {step:.2e}, largest at s = {s} m; take a smaller time step"
    )]
    NoConvergence {
        /// The limit.
        limit: usize,
        /// The size of the last Newton step.
        step: f64,
        /// Arc length of its largest part, m.
        s: f64,
    },
    /// A section turned further in one step than a rotation can be told apart from a smaller one.
    #[error("the section at s = {s} m turned by {angle:.2} rad in one step; take a smaller time step")]
    TooLargeTurn {
        /// Rotation in one time step, rad.
        angle: f64,
        /// Arc length, m.
        s: f64,
    },
    /// The step size fell below the least allowed.
    #[error("the step had to be cut to {step:.2e} s, below the least allowed {least:.2e} s ({cause})")]
    StepTooSmall {
        /// The step that would be next, s.
        step: f64,
        /// The least allowed, s.
        least: f64,
        /// What was wrong with the step before.
        cause: Box<Reason>,
    },
    /// An error estimate that asks for ever smaller steps.
    #[error("the estimated error of the step is {estimate:.2e}, and {tolerance:.1e} was asked for")]
    Accuracy {
        /// Estimated error of the step.
        estimate: f64,
        /// What was asked for.
        tolerance: f64,
    },
    /// The limit on the number of steps was reached.
    #[error("{limit} steps did not reach the end")]
    StepLimit {
        /// The limit.
        limit: usize,
    },
}

/// A run that ended early: when, why, and the last good state.
#[derive(Clone, PartialEq, Error)]
#[error("at t = {time} s: {reason}")]
pub struct Failure {
    /// The time to which the step was to lead, s.
    pub time: f64,
    /// Why.
    #[source]
    pub reason: Reason,
    /// The state before that step, from which a run can go on; `None` where the very start failed.
    pub last: Option<Box<State>>,
    /// The same, described.
    pub frame: Option<Box<Frame>>,
}

impl Failure {
    /// Before there is a state.
    pub(super) fn early(time: f64, reason: Reason) -> Box<Self> {
        Box::new(Self { time, reason, last: None, frame: None })
    }
}

/// Without the numbers of the state, which are many.
impl std::fmt::Debug for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Failure")
            .field("time", &self.time)
            .field("reason", &self.reason)
            .finish_non_exhaustive()
    }
}
