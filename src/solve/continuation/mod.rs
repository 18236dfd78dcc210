//! Following a family of equilibria r(x, λ) = 0 by its arc length, through limit points and past bifurcations.
//!
//! What lives here knows nothing of rods: a [`Family`] solves its own linear systems, and says how a state is moved and how steps are
//! measured. The corrector keeps to the hyperplane through the predicted point (Keller 1977, in *Applications of Bifurcation Theory*), so that
//! a limit point, where no step at fixed λ exists, is a point like any other.

mod correct;
mod family;
mod locate;
mod trace;

pub(crate) use family::{Family, Tangents};
#[cfg(test)]
pub(crate) use locate::illinois;
pub(crate) use trace::{End, Event, EventKind, PathPoint, Stride, Traced, trace, trace_branch};

#[cfg(test)]
mod tests;
