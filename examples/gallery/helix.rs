//! A helical spring of steel wire, coiled at rest, with weights on a hook at its axis.

use crate::figure::{BLUE, Drawing, GREEN, GREY, ORANGE, Outcome};
use crate::tube::{axis, tube};
use hyperrod::load::Payload;
use hyperrod::section::{CrossSection, Stiffness};
use hyperrod::solve::Order;
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Twist};
use nalgebra::{Matrix3, Rotation3, Vector3, vector};
use std::f64::consts::{PI, TAU};
use std::path::Path;

const COIL: f64 = 0.020; // m, radius of the coils
const RISE: f64 = 0.008 / TAU; // m per radian
const TURNS: f64 = 6.0;
const WIRE: f64 = 0.00075; // m, radius of the wire

fn solve(mass: f64, elements: usize) -> Outcome<StaticSolution> {
    let (area, second_moment) = (PI * WIRE * WIRE, PI * WIRE.powi(4) / 4.0);
    let (young, shear) = (200e9, 77e9);
    let (ei, ga) = (young * second_moment, shear * area);
    let wire = Stiffness::diagonal([ei, ei, 2.0 * shear * second_moment, ga, ga, young * area])?;
    // coiled at rest: curvature about y, torsion about z, with x towards the axis of the helix
    let along = (COIL * COIL + RISE * RISE).sqrt();
    let rest = Twist::new(vector![0.0, COIL, RISE] / (along * along), Vector3::z());
    let section = Box::new(wire) as Box<dyn CrossSection>;
    let spring = Body::new(TAU * TURNS * along, section)?.with_reference_strain(rest)?;
    // normal, binormal and tangent of a helix about +Z, turned upside down to hang
    let (binormal, tangent) = (vector![0.0, -RISE, COIL] / along, vector![0.0, COIL, RISE] / along);
    let frame = Pose::new(Matrix3::from_columns(&[-Vector3::x(), binormal, tangent]), Vector3::x() * COIL);
    let hang = Rotation3::from_axis_angle(&Vector3::x_axis(), PI).into_inner();
    let statics = Statics { elements, order: Order::Six, ..Statics::default() };
    let rod = Rod::clamped(spring, Pose::new(hang, Vector3::zeros()) * frame);
    if mass == 0.0 {
        return Ok(statics.solve(&rod)?);
    }
    let weight = Payload::new(mass)?.with_centre(Vector3::x() * COIL)?; // the hook reaches to the axis
    Ok(statics.solve(&rod.with_tip_load(weight))?)
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let view = [Vector3::x(), vector![0.0, 0.25, 1.0].normalize()];
    let title = "Spring of 1.5 mm steel wire, coiled at rest, under weights on its axis";
    let mut drawing = Drawing::new(title, "X, mm (springs side by side)", "height in the picture, mm");
    for (k, (mass, color)) in [(0.0, BLUE), (0.6, ORANGE), (1.2, GREEN)].into_iter().enumerate() {
        let solution = solve(mass, if quick { 40 } else { 56 })?;
        let aside = vector![0.08 * k as f64, 0.0, 0.0];
        let path: Vec<_> = axis(&solution).iter().map(|p| p + aside).collect();
        let end = solution.tip().pose.transform_point(&(Vector3::x() * COIL)) + aside;
        let place = |p: &Vector3<f64>| view.map(|d| d.dot(p) * 1e3);
        let hook = vec![place(&path[path.len() - 1]), place(&end)];
        drawing = tube(drawing, &path, WIRE, view, color).line(hook, GREY);
        if mass > 0.0 {
            // a ball of steel, 7850 kg/m³, below the hook
            let size = 1e3 * (mass / 7850.0 * 3.0 / (4.0 * PI)).cbrt();
            let at = place(&end);
            drawing = drawing.line(vec![at, [at[0], at[1] - 12.0]], GREY);
            drawing = drawing.disc([at[0], at[1] - 12.0 - size], size, GREY);
        }
        let clamp = 20.0 + 80.0 * k as f64;
        drawing = drawing.wall([clamp - 12.0, 0.0], [clamp + 12.0, 0.0]).legend(&format!("{mass} kg"), color);
    }
    drawing.save(picture)
}
