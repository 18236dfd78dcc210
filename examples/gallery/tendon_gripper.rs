//! A gripper: two tapered fingers, each bent inwards by a tendon that runs along its inner side and is pulled at the base.

use crate::figure::{BLUE, Drawing, GREEN, ORANGE, Outcome, silhouette};
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Converging, CrossSection, Linear, Section, Tendon};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics};
use nalgebra::{Matrix3, Vector3, vector};
use std::path::Path;

const LENGTH: f64 = 0.08; // m
const RADIUS: Linear = Linear { from: 0.006, to: 0.003, length: LENGTH }; // m
const APART: f64 = 0.025; // m, from each finger to the middle

/// The finger at +X (`side` 1) or −X (`side` −1).
fn solve(side: f64, tension: f64, elements: usize) -> Outcome<StaticSolution> {
    let rubber = LinearElastic::from_poisson(1.5e6, 0.45)?;
    // inwards is −X for the finger at +X
    let path = Converging { from: [-side * 4.5e-3, 0.0], to: [-side * 2e-3, 0.0], length: LENGTH };
    let section = Section::new(Circle::new(RADIUS), rubber)?.with_actuator(Tendon::new(path, tension)?);
    let finger = Body::new(LENGTH, Box::new(section) as Box<dyn CrossSection>)?;
    let palm = Pose::new(Matrix3::identity(), vector![side * APART, 0.0, 0.0]);
    Ok(Statics { elements, ..Statics::default() }.solve(&Rod::clamped(finger, palm))?)
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let mut drawing = Drawing::new("Gripper closed by two tendons, to scale", "X, mm", "Z, mm");
    for (tension, color) in [(0.0, BLUE), (0.4, ORANGE), (1.0, GREEN)] {
        for side in [-1.0, 1.0] {
            let solution = solve(side, tension, if quick { 8 } else { 24 })?;
            let radius = |s: f64| RADIUS.from + (RADIUS.to - RADIUS.from) * s / LENGTH;
            let sides: Vec<_> = solution.nodes().iter().map(|n| (n.pose, radius(n.s))).collect();
            let outline = silhouette(&sides, Vector3::x(), [Vector3::x(), Vector3::z()], 1e-3);
            drawing = drawing.area(outline, color);
        }
        drawing = drawing.legend(&format!("tension {tension} N"), color);
    }
    drawing.wall([-15.0, 0.0], [-35.0, 0.0]).wall([35.0, 0.0], [15.0, 0.0]).save(picture)
}
