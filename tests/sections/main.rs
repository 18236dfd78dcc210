//! Sections: geometry, response, rates along s, curved references, choice of the quadrature, weight.
#[path = "../reference/mod.rs"]
mod reference;

mod degree;
mod direct;
mod geometry;
mod rates;
mod refused;
mod response;
