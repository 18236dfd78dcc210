//! Loads and actuators: their derivatives, closed forms, and solutions by another formulation and another method.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

#[path = "../fixed_mesh/mod.rs"]
mod fixed_mesh;
#[path = "../reference/mod.rs"]
mod reference;
mod shooting;

mod dead;
mod derivatives;
mod messages;
mod rate;
mod solved;
mod strong_form;
mod tendons;
