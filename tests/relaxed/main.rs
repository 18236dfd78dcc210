//! Sections that relax: against closed forms, converged 2-D finite elements, finite differences and themselves.
#![allow(clippy::expect_used, clippy::unwrap_used)] // a test stops where its data are wrong

mod failures;
mod finite;
mod identities;
mod ladder;
mod rest;

use hyperrod::Strain;
use hyperrod::material::{NeoHookean, Request, Response, Station};
use hyperrod::section::{CrossSection, Relaxed, Shape, Warping};

type Solid = Relaxed<Box<dyn Shape>, NeoHookean>;

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

/// The largest difference, relative to the largest entry of the second.
fn relative(got: &[f64], exact: &[f64]) -> f64 {
    let scale = exact.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    got.iter().zip(exact).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs())) / scale
}
