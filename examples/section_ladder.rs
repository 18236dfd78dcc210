//! The ladder of relaxed sections: what becomes right at which rung, what it costs, and what it looks like.
//!
//! `cargo run --release --example section_ladder` prints tables and draws into `target/hyperrod/section_ladder`; `-- --quick` leaves out
//! the richest bases.
//!
//! Oracles: closed forms (E·A, E·I, Saint-Venant, shear factors, Mooney, Rivlin), converged 2-D finite elements of the section
//! (`tests/data/relaxed`), a 3-D finite-element cantilever (tip deflection / h = 9.8946), and the basis itself, refined. What an evaluation
//! costs is in the example `work_precision`.
#![allow(clippy::print_stdout)]

#[path = "ladder/bar.rs"]
mod bar;
#[path = "ladder/cases.rs"]
mod cases;
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

use cases::{relative, shape, solid};
use figure::{Outcome, Output, flag};
use hyperrod::Strain;
use hyperrod::material::{Request, Response, Station};
use hyperrod::section::{CrossSection, Warping};

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

fn respond(section: &dyn CrossSection, strain: [f64; 6]) -> Outcome<Response> {
    Ok(section.respond(&Station::straight(0.0), &Strain::from_array(strain), Request::Tangent)?)
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
    println!("section_ladder: {} of {} within tolerance", tally.good, tally.count);
    Ok(())
}
