//! A ribbon bent and twisted by a force at its tip: developable as paper is, or a linear strip of the same moduli.

use crate::figure::{BLUE, Drawing, ORANGE, Outcome, SKY};
use crate::ribbon_view::ribbon;
use hyperrod::load::DeadWrench;
use hyperrod::section::{CrossSection, Resultants, Ribbon, Stiffness};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics};
use nalgebra::{Isometry3, Vector3, vector};
use plotters::style::RGBColor;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

const LENGTH: f64 = 0.30; // m
const SIZE: [f64; 2] = [0.020, 0.0002]; // m, width and thickness
const YOUNG: f64 = 4e9; // Pa, a polyester film
const POISSON: f64 = 0.35;

fn solve(section: Box<dyn CrossSection>, elements: usize) -> Outcome<StaticSolution> {
    let body = Body::new(LENGTH, section)?;
    // along +X, its width along Y, its face up
    let turned =
        Isometry3::rotation(vector![0.0, FRAC_PI_2, 0.0]) * Isometry3::rotation(vector![0.0, 0.0, FRAC_PI_2]);
    let pull = DeadWrench::force(vector![0.0, 0.010, -0.006])?;
    let rod = Rod::clamped(body, Pose::from(turned)).with_tip_load(pull);
    // no tighter: where bending and twist both vanish, at the tip, a developable ribbon has no second derivative of its energy
    Ok(Statics { elements, tolerance: 1e-6, max_iterations: 200, ..Statics::default() }.solve(&rod)?)
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let [width, thickness] = SIZE;
    let plate = YOUNG * thickness.powi(3) * width / (12.0 * (1.0 - POISSON * POISSON));
    let (lateral, area) = (YOUNG * thickness * width.powi(3) / 12.0, width * thickness);
    let shear = 0.5 * YOUNG / (1.0 + POISSON) * area;
    // a flat strip: bending D w, torsion 2 (1 − ν) D w
    let torsion = 2.0 * (1.0 - POISSON) * plate;
    let strip = Stiffness::diagonal([plate, lateral, torsion, shear, shear, YOUNG * area])?;
    let film = Resultants(Ribbon::new(SIZE, YOUNG, POISSON)?);

    let elements = if quick { 16 } else { 64 };
    let view = [vector![1.0, 0.5, 0.0].normalize(), vector![-0.25, 0.5, 1.2].normalize()];
    let title = "Polyester ribbon, 6 mN down and 10 mN sideways at its tip";
    let mut drawing = Drawing::new(title, "to the right, mm", "upwards, mm")
        .legend("developable ribbon (Sadowsky)", BLUE)
        .legend("linear strip", ORANGE);
    let linear: [RGBColor; 2] = [ORANGE, RGBColor(240, 180, 140)];
    for (section, colors) in
        [(Box::new(strip) as Box<dyn CrossSection>, linear), (Box::new(film), [BLUE, SKY])]
    {
        let solution = solve(section, elements)?;
        let stations: Vec<_> = solution.nodes().iter().map(|n| n.pose).collect();
        drawing = ribbon(drawing, &stations, width, view, colors);
    }
    let end = |y: f64| view.map(|d| d.dot(&(Vector3::y() * y)) * 1e3);
    drawing.wall(end(0.014), end(-0.014)).save(picture)
}
