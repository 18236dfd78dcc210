//! Every law of the library: the battery, its edges, its reference values, and its derivatives against num-dual.
//!
//! One binary, since each that uses a law compiles its kernels for every kind of lane and every request.
#![allow(clippy::expect_used, clippy::unwrap_used)] // a test stops where its law fails
#![allow(dead_code)] // the oracle is shared

#[macro_use]
mod battery;
mod every_law;
#[path = "../engine/oracle.rs"]
mod oracle;
#[path = "../section_reference/mod.rs"]
mod section_reference;

mod admissibility;
mod check;
mod conformance;
mod fifty_digits;
mod levels;
mod reference;
mod section_solves;
