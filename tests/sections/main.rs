//! Sections: geometry, response, rates along s, curved references, choice of the quadrature, weight.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // helpers of tests, as tests themselves

#[path = "../reference/mod.rs"]
mod reference;

mod curved;
mod degree;
mod direct;
mod geometry;
mod gravity;
mod rates;
mod refused;
mod response;
