//! A tapered silicone arm under its own weight, lifted by a pressure chamber along its lower side.

use crate::figure::{BLUE, Drawing, GREEN, ORANGE, Outcome, silhouette};
use hyperrod::load::Gravity;
use hyperrod::material::NeoHookean;
use hyperrod::section::{Circle, CrossSection, Linear, PressureChamber, Section};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics};
use nalgebra::{Isometry3, Vector3, vector};
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

const LENGTH: f64 = 0.20; // m
const RADIUS: Linear = Linear { from: 0.014, to: 0.009, length: LENGTH }; // m

fn solve(pressure: f64, elements: usize) -> Outcome<StaticSolution> {
    // G = 200 kPa, and E = 3 G on a section that cannot contract
    let silicone = NeoHookean::new(200e3, 200e3)?;
    // 60 mm², 7 mm off the axis, along x: downwards, the arm lying along +X
    let chamber = PressureChamber::new([7e-3, 0.0], 60e-6, pressure)?;
    let section = Section::new(Circle::new(RADIUS), silicone)?.with_actuator(chamber);
    let arm = Body::new(LENGTH, section)?.with_density(1070.0)?;
    let clamp = Pose::from(Isometry3::rotation(vector![0.0, FRAC_PI_2, 0.0]));
    let rod = Rod::clamped(arm, clamp).with_load(Gravity::standard());
    Ok(Statics { elements, ..Statics::default() }.solve(&rod)?)
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let mut drawing = Drawing::new("Silicone arm lifted by a pressure chamber, to scale", "X, mm", "Z, mm");
    for (pressure, color) in [(0.0, BLUE), (40e3, ORANGE), (80e3, GREEN)] {
        let solution = solve(pressure, if quick { 8 } else { 24 })?;
        let radius = |s: f64| RADIUS.from + (RADIUS.to - RADIUS.from) * s / LENGTH;
        let sides: Vec<_> = solution.nodes().iter().map(|n| (n.pose, radius(n.s))).collect();
        let outline = silhouette(&sides, Vector3::x(), [Vector3::x(), Vector3::z()], 1e-3);
        drawing = drawing.area(outline, color).legend(&format!("{} kPa", pressure / 1e3), color);
    }
    drawing.wall([0.0, -24.0], [0.0, 24.0]).save(picture)
}
