//! Sections that relax: against closed forms, converged 2-D finite elements, finite differences and themselves.
#![allow(clippy::expect_used, clippy::unwrap_used)] // a test stops where its data are wrong

#[path = "../../examples/ladder/cases.rs"]
#[allow(dead_code, reason = "an example uses the rest")]
mod cases;
mod failures;
mod finite;
mod identities;
mod ladder;
mod rest;

use cases::{Solid, relative};
use hyperrod::Strain;
use hyperrod::material::{NeoHookean, Request, Response, Station};
use hyperrod::section::{CrossSection, Relaxed, Shape, Warping};

/// A relaxed section of the neo-Hookean law of the references, μ = 1.
fn solid(shape: impl Shape + 'static, lambda: f64, (in_plane, axial): (usize, usize)) -> Solid {
    let shape: Box<dyn Shape> = Box::new(shape);
    let law = NeoHookean::new(1.0, lambda).unwrap();
    Relaxed::new(shape, law).unwrap().with_warping(Warping { in_plane, axial }).unwrap()
}

fn at_rest() -> Station {
    Station::straight(0.0)
}

fn respond(section: &dyn CrossSection, strain: [f64; 6]) -> Response {
    section.respond(&at_rest(), &Strain::from_array(strain), Request::Tangent).unwrap()
}
