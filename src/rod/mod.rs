//! The rod in space: its scene, and the collocation element in the strains.
//!
//! A [`Rod`] is a body with a [`Support`] at either end, loads, and joints on the way. The element has the strains at Gauss points as unknowns; poses follow by
//! integrating them forward (g′ = g ξ^), wrenches by the balance from the free end backward.
//!
//! What lives here states equilibrium and its exact linearisation on one element; it does not solve anything.

pub(crate) mod adjoint;
pub(crate) mod collocation;
pub(crate) mod condense;
pub(crate) mod element;
pub(crate) mod joint;
pub(crate) mod lanes;
pub(crate) mod magnus;
pub(crate) mod planar;
mod scene;
pub(crate) mod stage_loads;
mod stages;
mod strong_form;
pub(crate) mod support;

pub use scene::Rod;
pub use strong_form::{Motion, SectionState, StrainRate};

pub use crate::load::RateLoad;
pub use support::{Condition, Freedom, Support};
