//! What to do where Newton's method from rest finds nothing, or finds a state that would not stay.
//!
//! The rungs of a ladder, each climbed only where those before it did not arrive: capped Newton; a regularised Newton whose model of the energy is kept
//! convex; the loads in steps; the path of equilibria by its arc length; Newton's method from other shapes.

mod climb;
mod descend;
mod elsewhere;
mod family;
mod farther;
mod load_steps;
mod verdict;

pub(super) use climb::unstable;
pub(super) use family::RodFamily;
pub(super) use verdict::{NEUTRAL, stability};

#[cfg(test)]
mod tests;
