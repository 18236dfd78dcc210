//! Three fingers of one shape and one mean modulus, graded along their length in the law itself, under the same force.

use crate::figure::{BLUE, Drawing, GREEN, ORANGE, Outcome, silhouette};
use hyperrod::load::DeadWrench;
use hyperrod::section::{CrossSection, Rectangle, Section};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, isotropic};
use nalgebra::{Vector3, vector};
use std::path::Path;

const LENGTH: f64 = 0.10; // m
const THICKNESS: f64 = 0.006; // m

/// G falls from (1 + slope) to (1 − slope) times its mean from base to tip.
fn solve(slope: f64, elements: usize) -> Outcome<StaticSolution> {
    let shear = 300e3; // Pa
    let rubber = isotropic!([shear: f64, slope: f64] degree 2; |i, at| {
        let here = (-(at.s * (2.0 / LENGTH)) + 1.0) * slope + 1.0; // of the mean
        (i.i1_excess() * 0.5 + i.j() * i.j()) * here * shear // E = 3 G
    });
    let section = Section::new(Rectangle::new(THICKNESS, 0.012), rubber)?;
    let finger = Body::new(LENGTH, Box::new(section) as Box<dyn CrossSection>)?;
    let push = DeadWrench::force(vector![0.06, 0.0, 0.0])?;
    let rod = Rod::clamped(finger, Pose::identity()).with_tip_load(push);
    Ok(Statics { elements, ..Statics::default() }.solve(&rod)?)
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let title = "Fingers of one mean modulus under the same force, to scale";
    let mut drawing = Drawing::new(title, "X, mm", "Z, mm");
    for (slope, name, color) in
        [(0.8, "soft tip", BLUE), (0.0, "uniform", ORANGE), (-0.8, "soft base", GREEN)]
    {
        let solution = solve(slope, if quick { 8 } else { 48 })?;
        let sides: Vec<_> = solution.nodes().iter().map(|n| (n.pose, 0.5 * THICKNESS)).collect();
        let outline = silhouette(&sides, Vector3::x(), [Vector3::x(), Vector3::z()], 1e-3);
        drawing = drawing.area(outline, color).legend(name, color);
    }
    drawing.wall([14.0, 0.0], [-14.0, 0.0]).save(picture)
}
