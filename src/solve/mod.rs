//! Solving: Newton's method for static equilibrium, the chain of linearised elements, and reports.
//!
//! What lives here drives the elements of [`rod`](crate::rod): when to step, how far, when to stop, and what to tell the user. It
//! prints nothing; give a solve an observer to watch it.

mod cascade;
mod chain;
mod describe;
pub mod dynamics;
mod equilibrium;
mod estimate;
mod failure;
mod linear;
mod mesh;
mod newton;
mod report;
mod solution;
mod statics;
mod sweep;
mod workspace;

pub use failure::{Failure, Reason};
pub use report::{ErrorEstimate, Iteration, Report};
pub use solution::{Node, StaticSolution};
pub use statics::{Order, Statics};
pub use workspace::Workspace;
