//! A whip: a tapered rubber rod whose handle is turned by a right angle in 0.15 s and then stopped. The wave arrives at the tip later,
//! which is fastest when the handle has long been still.

use crate::figure::{BLUE, Chart, Drawing, GREEN, ORANGE, Outcome, PURPLE, SKY};
use hyperrod::lie::so3;
use hyperrod::material::LinearElastic;
use hyperrod::num_dual::Dual2_64;
use hyperrod::section::{Circle, Linear, Section};
use hyperrod::solve::dynamics::{Adaptive, Dynamics, Frame, Scene, Start, Step};
use hyperrod::{Body, Pose, Rod};
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

const LENGTH: f64 = 1.0; // m
const FLICK: f64 = 0.15; // s
const TIMES: [f64; 5] = [0.0, 0.08, 0.16, 0.24, 0.32]; // s, of the drawing

/// The pose of the handle: turns about Y, from rest to rest, with continuous acceleration.
fn handle(t: Dual2_64) -> Pose<Dual2_64> {
    let x = if t.re < FLICK { t * (1.0 / FLICK) } else { Dual2_64::from_re(1.0) };
    let angle = x * x * x * (x * (x * 6.0 - 15.0) + 10.0) * FRAC_PI_2;
    let zero = Dual2_64::from_re(0.0);
    Pose::new(so3::exp(&Vector3::new(zero, angle, zero)), Vector3::from_element(zero))
}

/// The axis seen from the side, m.
fn axis(frame: &Frame) -> Vec<[f64; 2]> {
    let nodes = frame.nodes.iter().map(|n| (n.s, n.pose.position));
    let mut points: Vec<_> = nodes.chain(frame.stages.iter().map(|n| (n.s, n.pose.position))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points.iter().map(|(_, p)| [p.x, p.z]).collect()
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let taper = Linear { from: 0.012, to: 0.003, length: LENGTH };
    let section = Section::new(Circle::new(taper), LinearElastic::from_poisson(5e6, 0.45)?)?;
    let body = Body::new(LENGTH, section)?.with_density(1100.0)?.with_viscosity(300.0)?; // kg/m³, Pa s
    let whip = Rod::clamped(body, Pose::identity());
    let scene = Scene::new(&whip).with_base_motion(handle);
    let (elements, tolerance) = if quick { (6, 1e-3) } else { (14, 1e-5) };
    let step = Step::Adaptive(Adaptive { tolerance, ..Adaptive::default() });
    let mut stepper = Dynamics { elements, step, ..Dynamics::default() }.start(&scene, &Start::at_rest())?;

    let mut drawing =
        Drawing::new("Whip without weight, its handle turned to the right in 0.15 s", "X, m", "Z, m");
    let mut speeds = Vec::new();
    for (time, color) in TIMES.into_iter().zip([BLUE, ORANGE, GREEN, PURPLE, SKY]) {
        while !stepper.is_at(time) {
            stepper.step_toward(time)?;
            let frame = stepper.frame()?;
            speeds.push([frame.time, frame.tip().velocity.linear.norm()]);
        }
        drawing = drawing.line(axis(&stepper.frame()?), color).legend(&format!("{time:.2} s"), color);
    }
    drawing.save(picture)?;
    // d3 of the handle moves as the tip of a rigid rod of 1 m
    let rigid = |t: f64| {
        let tip = handle(Dual2_64::from_re(t).derivative()).rotation.column(2).map(|v| v.v1);
        [t, tip.norm() * LENGTH]
    };
    let of_rigid: Vec<_> = speeds.iter().map(|[t, _]| rigid(*t)).collect();
    Chart::new("Speed of the tip", "time, s", "speed, m/s")
        .line("whip", speeds)
        .line("a rigid rod on the same handle", of_rigid)
        .save(&picture.with_file_name("whip_path.svg"))
}
