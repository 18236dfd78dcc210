//! A shallow arch on two hinges, pushed down at its crown: it snaps through at a limit point of the load, and back at another.

use crate::figure::{BLUE, Chart, Drawing, GREEN, GREY, ORANGE, Outcome};
use crate::tube::axis;
use hyperrod::load::DeadWrench;
use hyperrod::rod::{Freedom, Support};
use hyperrod::section::{CrossSection, Stiffness};
use hyperrod::solve::{EquilibriumPath, Order, PathEventKind, PathOptions, PathState};
use hyperrod::{Body, Pose, Rod, Statics, Twist};
use nalgebra::{Matrix3, Vector3, vector};
use std::path::Path;

const HALF_ANGLE: f64 = 0.35; // rad
const LENGTH: f64 = 1.0; // and EI = 1

fn path(elements: usize) -> Outcome<EquilibriumPath> {
    // radius of gyration L/40; stiff out of the plane
    let section = Stiffness::diagonal([20.0, 1.0, 20.0, 600.0, 600.0, 1600.0])?;
    let rest = Twist::new(vector![0.0, 2.0 * HALF_ANGLE / LENGTH, 0.0], Vector3::z());
    let arch = Body::new(LENGTH, Box::new(section) as Box<dyn CrossSection>)?.with_reference_strain(rest)?;
    let (sin, cos) = HALF_ANGLE.sin_cos();
    let (normal, tangent) = (vector![sin, 0.0, -cos], vector![cos, 0.0, sin]);
    let base = Pose::new(Matrix3::from_columns(&[normal, Vector3::y(), tangent]), Vector3::zeros());
    let hinge = |frame| Support::clamped(frame).releasing([Freedom::RotationY]);
    let push = DeadWrench::force(vector![0.0, 0.0, -1.0])?; // EI/L²
    let rod = Rod::between(arch, hinge(base), hinge(base * (rest * LENGTH).exp()))
        .with_point_load(0.5 * LENGTH, push)?;
    let statics = Statics { elements, order: Order::Six, ..Statics::default() };
    let options = PathOptions { factors: [-20.0, 20.0], longest_step: 0.25, ..PathOptions::default() };
    Ok(statics.trace(&rod, &options)?)
}

fn crown(state: &PathState) -> f64 {
    let nodes = state.solution.nodes();
    let heights = nodes.iter().filter(|n| (n.s - 0.5 * LENGTH).abs() < 1e-9).map(|n| n.pose.position.z);
    heights.fold(0.0, |_, height| height)
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let path = path(if quick { 6 } else { 12 })?;
    let rise = crown(&path.points[0]);
    let place = |state: &PathState| [(rise - crown(state)) / rise, state.load_factor];
    let mut chart =
        Chart::new("Shallow arch: load against the way down of its crown", "way down, rises", "load, EI/L²");
    let unstable = |state: &PathState| state.solution.report().stability.is_unstable();
    for part in path.points.chunk_by(|a, b| unstable(a) == unstable(b)) {
        let name = if unstable(&part[0]) { "unstable" } else { "stable" };
        chart = chart.line(name, part.iter().map(place));
    }
    let limits = path.events.iter().filter(|e| e.kind == PathEventKind::LimitPoint);
    chart
        .marks("limit points", limits.map(|event| place(&event.state)))
        .save(&picture.with_file_name("snapping_arch_path.svg"))?;

    let first = path.events.iter().find(|e| e.kind == PathEventKind::LimitPoint);
    let first = first.ok_or("the arch does not snap")?;
    // beyond it, the equilibrium under the same load that is left
    let snapped = path
        .points
        .iter()
        .skip(first.after + 1)
        .find(|p| p.slope > 0.0 && p.load_factor > first.state.load_factor);
    let title = "Shallow arch at rest, about to snap, and after";
    let mut drawing = Drawing::new(title, "X, L", "Z, L");
    let shapes = [
        (Some(&path.points[0]), GREY, "at rest"),
        (Some(&first.state), BLUE, "about to snap"),
        (snapped, ORANGE, "snapped"),
    ];
    for (state, color, name) in shapes {
        let Some(state) = state else { continue };
        let line = axis(&state.solution).iter().map(|p| [p.x, p.z]).collect();
        drawing = drawing.line(line, color).legend(&format!("{name}: {:.1} EI/L²", state.load_factor), color);
    }
    let span = axis(&path.points[0].solution).last().map_or(1.0, |p| p.x);
    drawing.disc([0.0, 0.0], 0.008, GREEN).disc([span, 0.0], 0.008, GREEN).save(picture)
}
