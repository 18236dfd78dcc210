//! The ladder of relaxed sections: what becomes right at which rung, what it costs, and what it looks like.
//!
//! `cargo run --release --example section_ladder` prints tables and draws into `target/hyperrod/section_ladder`; `-- --quick` leaves out
//! the richest bases.
//!
//! Oracles: closed forms (E·A, E·I, Saint-Venant, shear factors, Mooney, Rivlin), converged 2-D finite elements of the section
//! (`tests/data/relaxed`), a 3-D finite-element cantilever (tip deflection / h = 9.8946), and the basis itself, refined.
#![allow(clippy::print_stdout)]

#[path = "ladder/bar.rs"]
mod bar;
#[path = "figure/mod.rs"]
mod figure;
#[path = "ladder/finite.rs"]
mod finite;
#[path = "ladder/picture.rs"]
mod picture;
#[path = "ladder/reference.rs"]
mod reference;
#[path = "ladder/rest.rs"]
mod rest;
#[path = "ladder/tube.rs"]
mod tube;
#[path = "ladder/work.rs"]
mod work;

use figure::{Outcome, Output, flag};
use hyperrod::Strain;
use hyperrod::material::{NeoHookean, Request, Response, Station};
use hyperrod::section::{CrossSection, Relaxed, Shape, Warping};

type Solid = Relaxed<Box<dyn Shape>, NeoHookean>;

/// Lines printed, and how many of them are within their tolerance.
#[derive(Default)]
struct Tally {
    good: usize,
    count: usize,
}

impl Tally {
    fn line(&mut self, what: &str, rung: &str, got: f64, exact: f64, tolerance: f64) {
        let error = if exact == 0.0 { got.abs() } else { (got / exact - 1.0).abs() };
        self.error(what, rung, error, tolerance);
    }

    fn error(&mut self, what: &str, rung: &str, error: f64, tolerance: f64) {
        let met = error <= tolerance;
        self.count += 1;
        self.good += usize::from(met);
        println!("{what:<46}{rung:>42}{error:>11.1e}{tolerance:>9.0e}{}", if met { "" } else { "  MISSED" });
    }
}

fn warping((in_plane, axial): (usize, usize)) -> Warping {
    Warping { in_plane, axial }
}

/// A relaxed section of the neo-Hookean law of the references, μ = 1.
fn solid(shape: Box<dyn Shape>, lambda: f64, warping: Warping) -> Outcome<Solid> {
    Ok(Relaxed::new(shape, NeoHookean::new(1.0, lambda)?)?.with_warping(warping)?)
}

fn respond(section: &dyn CrossSection, strain: [f64; 6]) -> Outcome<Response> {
    Ok(section.respond(&Station::straight(0.0), &Strain::from_array(strain), Request::Tangent)?)
}

/// The largest difference, relative to the largest entry of the second.
fn relative(got: &[f64], exact: &[f64]) -> f64 {
    let scale = exact.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    got.iter().zip(exact).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()))
        / scale.max(f64::MIN_POSITIVE)
}

fn main() -> Outcome {
    let quick = flag("--quick");
    let output = Output::of("section_ladder")?;
    let mut tally = Tally::default();
    println!("{:<46}{:>42}{:>11}{:>9}", "what", "rung (p, r)", "error", "allowed");
    rest::run(&mut tally)?;
    finite::run(&mut tally)?;
    reference::run(&mut tally, &output, quick)?;
    bar::twisted(&mut tally, quick)?;
    bar::cantilever(&mut tally, &output)?;
    tube::run(&mut tally, &output, quick)?;
    work::run(&output, quick)?;
    println!("section_ladder: {} of {} within tolerance", tally.good, tally.count);
    Ok(())
}
