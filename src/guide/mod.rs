//! Guide: how to use this crate, in short chapters with code that is compiled and run.
//!
//! | to do | chapter |
//! |---|---|
//! | go from a closure to a bent rod | [`first_rod`] |
//! | write a law of your own | [`laws`] |
//! | choose a section: rigid, relaxed, resultants, constrained | [`sections`] |
//! | choose how simple a model may be | [`models`] |
//! | write a load of your own, also one that asks something new of the body | [`loads`] |
//! | hold a rod, and move it with tendons and pressure | [`supports`] |
//! | read what a solve reports, and take the results elsewhere | [`reports`] |
//! | move a rod in time | [`motion`] |
//! | get on when a solve fails | [`failures`] |
//! | see where every equation is in the code | [`theory`] |
//!
//! What lives here is text: these modules hold no items.

pub mod failures;
pub mod first_rod;
pub mod laws;
pub mod loads;
pub mod models;
pub mod motion;
pub mod reports;
pub mod sections;
pub mod supports;
pub mod theory;
