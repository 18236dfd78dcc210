//! The Poynting effect: a twisted rubber cylinder, free to change its length, grows longer. How much depends on the law.

use crate::figure::{Chart, Outcome};
use hyperrod::Wrench;
use hyperrod::material::{MooneyRivlin, ReferencePressure, Station};
use hyperrod::section::{Circle, PathOptions, Relaxed, Warping, WrenchPath};
use std::path::Path;

const RADIUS: f64 = 0.010; // m
const SHEAR: f64 = 400e3; // Pa, 2 (C₁ + C₂)

/// (twist times radius, axial stretch − 1 in per cent) for a share of C₂ in C₁ + C₂.
fn curve(share: f64, step: f64) -> Outcome<Vec<[f64; 2]>> {
    let rubber = MooneyRivlin::new(0.5 * SHEAR * (1.0 - share), 0.5 * SHEAR * share)?;
    let cylinder = Relaxed::incompressible(Circle::new(RADIUS), ReferencePressure(rubber))?;
    let cylinder = cylinder.with_warping(Warping::CONTRACTION)?;
    let torque = Wrench::from_array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    let options = PathOptions { largest: 0.75, step, ..PathOptions::default() };
    let path = WrenchPath::follow(&cylinder, &Station::straight(0.0), &torque, &options)?;
    Ok(path.points.iter().map(|p| [p.strain.angular.z * RADIUS, p.strain.linear.z * 1e2]).collect())
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let step = if quick { 0.15 } else { 0.03 };
    // neo-Hookean, Rivlin (1948): the axial force vanishes where λ³ = 1 + (ωa)²/4
    let exact = (0..=11).map(|k| {
        let twist = 0.2 * f64::from(k);
        [twist, 1e2 * ((1.0 + 0.25 * twist * twist).cbrt() - 1.0)]
    });
    let title = "Poynting effect: a twisted incompressible cylinder grows longer";
    Chart::new(title, "twist times radius, rad", "elongation, %")
        .line("C₂ = 0 (neo-Hookean)", curve(0.0, step)?)
        .line("C₂ = C₁", curve(0.5, step)?)
        .line("C₁ = 0", curve(1.0, step)?)
        .marks("C₂ = 0, exact (Rivlin)", exact)
        .save(picture)
}
