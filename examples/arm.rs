//! A soft arm with three tendons that steps between poses.
//!
//! `cargo run --release --example arm` (`-- --quick` makes two steps of four). Pictures go to `target/hyperrod/arm/`.
//!
//! A tapered, damped silicone arm of 25 cm hangs down. Tendons run 120° apart through it, towards its axis at the tip, and are pulled in turn: every
//! half second another one takes over within 50 ms, and the arm swings to its new pose.
#![allow(clippy::print_stdout)]

mod figure;

use figure::{Animation, BLUE, Chart, Drawing, Outcome, Output, silhouette};
use hyperrod::lie::so3;
use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Converging, Linear, Section, Tendon};
use hyperrod::solve::dynamics::{Adaptive, Dynamics, Frame, Scene, Start, Step};
use hyperrod::{Body, Pose, Rod};
use indicatif::{ProgressBar, ProgressStyle};
use nalgebra::{Vector3, vector};
use std::f64::consts::{PI, TAU};

const LENGTH: f64 = 0.25;
const RADIUS: Linear = Linear { from: 0.015, to: 0.008, length: LENGTH };

/// Seconds from one pose to the next.
const HOLD: f64 = 0.5;

/// The tendon that pulls in each of the four steps, and its tension in N.
const STEPS: [(usize, f64); 4] = [(0, 8.0), (1, 8.0), (2, 8.0), (0, 3.0)];

/// From 0 to 1 within 50 ms, smoothly.
fn smooth(t: f64) -> f64 {
    let u = (t / 0.05).clamp(0.0, 1.0);
    u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
}

/// The tension of a tendon in N: each step fades in as the one before fades out.
fn tension(tendon: usize, t: f64) -> f64 {
    let pulls = |step: usize| if STEPS[step].0 == tendon { STEPS[step].1 } else { 0.0 };
    let mut tension = 0.0;
    for step in 0..STEPS.len() {
        let before = if step == 0 { 0.0 } else { pulls(step - 1) };
        tension += (pulls(step) - before) * smooth(t - HOLD * step as f64);
    }
    tension
}

fn main() -> Outcome {
    let steps = if figure::flag("--quick") { 2 } else { STEPS.len() };
    let output = Output::of("arm")?;
    let section = Section::new(Circle::new(RADIUS), LinearElastic::new(4e5, 1.4e5)?)?;
    let body = Body::new(LENGTH, section)?.with_density(1070.0)?.with_viscosity(5000.0)?;
    let hanging = Pose::new(so3::exp(&vector![0.0, PI, 0.0]), Vector3::zeros());
    let rod = Rod::clamped(body, hanging).with_load(Gravity::standard());
    let mut scene = Scene::new(&rod);
    for tendon in 0..3 {
        let angle = TAU * tendon as f64 / 3.0;
        let at = |radius: f64| [radius * angle.cos(), radius * angle.sin()];
        let routing = Converging { from: at(0.012), to: at(0.005), length: LENGTH };
        scene = scene.with_actuator(Tendon::new(routing, 1.0)?, move |t| tension(tendon, t));
    }
    let adaptive = Adaptive { tolerance: 1e-5, largest: 0.02, ..Adaptive::default() };
    let dynamics =
        Dynamics { elements: 8, step: Step::Adaptive(adaptive), tolerance: 1e-9, ..Dynamics::default() };
    let mut stepper = dynamics.start(&scene, &Start::at_rest().balanced())?;
    let end = HOLD * steps as f64;
    let instants = (end * 100.0).round() as usize;
    let bar =
        ProgressBar::new(instants as u64).with_style(ProgressStyle::with_template("arm {bar:40} {eta}")?);
    let mut frames = vec![stepper.frame()?];
    let (mut count, mut rejected) = (0, 0);
    for instant in 1..=instants {
        let time = instant as f64 / 100.0;
        while !stepper.is_at(time) {
            let report = stepper.step_toward(time)?;
            (count, rejected) = (count + 1, rejected + report.rejected);
        }
        frames.push(stepper.frame()?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    println!("step  tendon  tension, N   tip at its end, mm (X, Y, Z)       still moving with");
    for step in 0..steps {
        let tip = frames[(step + 1) * (HOLD * 100.0) as usize].tip();
        let (p, (tendon, tension)) = (tip.pose.position * 1e3, STEPS[step]);
        let speed = tip.velocity.linear.norm() * 1e3;
        println!(
            "{step:4}  {tendon:6}  {tension:10.1}   {:8.2} {:8.2} {:8.2}   {speed:14.3} mm/s",
            p.x, p.y, p.z
        );
    }
    pictures(&frames, &output)?;
    println!("arm: {steps} poses in {count} time steps, {rejected} rejected");
    Ok(())
}

/// The arm from the side every 20 ms of the first step, its energies, and the motion at half speed.
fn pictures(frames: &[Frame], output: &Output) -> Outcome {
    let plane = [Vector3::x(), Vector3::z()];
    let outline = |frame: &Frame| {
        let radius = |s: f64| RADIUS.from + (RADIUS.to - RADIUS.from) * s / LENGTH;
        let stations: Vec<(Pose, f64)> = frame.nodes.iter().map(|n| (n.pose, radius(n.s))).collect();
        silhouette(&stations, Vector3::x(), plane, 1e-3)
    };
    let mut drawing = Drawing::new("A tendon is pulled, every 20 ms, to scale", "X, mm", "Z, mm");
    for frame in frames.iter().take(30).step_by(2) {
        drawing = drawing.line(outline(frame), BLUE);
    }
    drawing.wall([-20.0, 0.0], [20.0, 0.0]).save(&output.path("strobe.svg"))?;
    let along = |f: fn(&Frame) -> f64| frames.iter().map(move |frame| [frame.time, f(frame) * 1e3]);
    let energy = Chart::new("Energy", "time, s", "energy, mJ")
        .line("kinetic", along(|f| f.energies.kinetic))
        .line("dissipated", along(|f| f.energies.dissipated));
    let place = Chart::new("Tip", "time, s", "mm")
        .line("X", along(|f| f.tip().pose.position.x))
        .line("Y", along(|f| f.tip().pose.position.y));
    figure::stack(&output.path("energy.svg"), &[energy, place])?;
    let mut animation = Animation::new("an arm, half as fast", 2.0 * frames[frames.len() - 1].time);
    for frame in frames {
        animation.push(frame.nodes.iter().map(|n| [n.pose.position.x, n.pose.position.z]).collect());
    }
    animation.save(&output.path("arm.svg"))
}
