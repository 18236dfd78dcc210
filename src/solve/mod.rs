//! Solving: statics by Newton's method, stability, paths of equilibria and critical loads, [dynamics], simpler models, and reports.
//!
//! What lives here drives the elements of [`rod`](crate::rod): when to step, how far, when to stop, and what to tell the user. It
//! prints nothing; give a solve an observer to watch it.

mod assembly;
mod cascade;
mod chain;
mod continuation;
mod dead;
mod describe;
pub mod dynamics;
mod equilibrium;
mod estimate;
mod extremes;
mod failure;
mod globalise;
mod linear;
mod mesh;
mod model_ladder;
mod newton;
mod path;
mod rate_loads;
mod redundant;
mod report;
mod rigid;
mod scale;
mod solution;
mod stability;
mod statics;
mod sweep;
mod taut;
mod tendon_length;
mod unknowns;
mod workspace;

pub use extremes::{RodExtremes, RodPoint};
pub use failure::{Failure, Reason};
pub use model_ladder::{LeftOut, ModelError, ModelLadder, ModelRung, Suggestion, suggest};
pub use path::{Buckling, EquilibriumPath, PathEnd, PathEvent, PathEventKind, PathOptions, PathState};
pub use report::{ErrorEstimate, Iteration, Report, Rung, Stability};
pub use solution::{Node, StaticSolution};
pub use statics::{Order, Statics};
pub use tendon_length::TendonSolution;
pub use workspace::Workspace;
