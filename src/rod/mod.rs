//! The rod in space: its scene, and the collocation element in the strains.
//!
//! A [`Rod`] is a body with a base, loads and a tip. The element has the strains at Gauss points as unknowns; poses follow by
//! integrating them forward (g′ = g ξ^), wrenches by the balance from the free end backward.
//!
//! What lives here states equilibrium and its exact linearisation on one element; it does not solve anything.

pub(crate) mod adjoint;
pub(crate) mod collocation;
pub(crate) mod condense;
pub(crate) mod element;
pub(crate) mod magnus;
mod scene;
mod stages;

pub use scene::Rod;
