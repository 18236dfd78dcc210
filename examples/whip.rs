//! A whip: a tapered, damped silicone rod swung by its handle, with steps chosen by their estimated error.
//!
//! `cargo run --release --example whip` (`-- --quick` follows half the time). Pictures go to `target/hyperrod/whip/`.
#![allow(clippy::print_stdout)]

mod figure;

use figure::{Animation, BLUE, Chart, Drawing, ORANGE, Outcome, Output};
use hyperrod::lie::so3;
use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::num_dual::{Dual2_64, DualNum};
use hyperrod::section::{Circle, Linear, Section};
use hyperrod::solve::dynamics::{Adaptive, Dynamics, Frame, Scene, Start, Step};
use hyperrod::{Body, Pose, Rod};
use indicatif::{ProgressBar, ProgressStyle};
use nalgebra::{Vector3, vector};

const LENGTH: f64 = 0.8;

/// The handle, from which the whip hangs, turns by some 0.9 rad about Y and back within a second, and comes to rest.
fn handle(t: Dual2_64) -> Pose<Dual2_64> {
    let zero = Dual2_64::from_re(0.0);
    let angle = if t.re < 1.0 {
        let pulse = (t * std::f64::consts::PI).sin();
        // sin³ starts and ends smoothly
        pulse * pulse * pulse * (t * std::f64::consts::TAU).cos() * 0.9
    } else {
        zero
    };
    // half a turn, so that the rod hangs
    Pose::new(so3::exp(&vector![zero, angle + std::f64::consts::PI, zero]), vector![zero, zero, zero])
}

fn main() -> Outcome {
    let end = if figure::flag("--quick") { 0.75 } else { 1.5 };
    let output = Output::of("whip")?;
    let taper = Linear { from: 0.012, to: 0.003, length: LENGTH };
    let section = Section::new(Circle::new(taper), LinearElastic::new(8e5, 3e5)?)?;
    let body = Body::new(LENGTH, section)?.with_density(1070.0)?.with_viscosity(300.0)?;
    let rod = Rod::clamped(body, Pose::identity()).with_load(Gravity::standard());
    let scene = Scene::new(&rod).with_base_motion(handle);
    let dynamics = Dynamics {
        elements: 12,
        step: Step::Adaptive(Adaptive { tolerance: 1e-5, first: 1e-3, largest: 0.02, ..Adaptive::default() }),
        tolerance: 1e-9,
        track_work: true,
        ..Dynamics::default()
    };
    let mut stepper = dynamics.start(&scene, &Start::at_rest())?;
    let bar = ProgressBar::new(1000).with_style(ProgressStyle::with_template("whip {bar:40} {percent} %")?);
    let mut frames = vec![stepper.frame()?];
    let (mut steps, mut rejected, mut shortest) = (0, 0, f64::INFINITY);
    // frames 10 ms apart, whatever the steps are
    for instant in 1..=(end * 100.0) as usize {
        let time = instant as f64 / 100.0;
        while !stepper.is_at(time) {
            let report = stepper.step_toward(time)?;
            steps += 1;
            rejected += report.rejected;
            shortest = report.step.min(shortest);
        }
        frames.push(stepper.frame()?);
        bar.set_position((1000.0 * time / end) as u64);
    }
    bar.finish_and_clear();
    let speed = |f: &Frame| f.tip().velocity.linear.norm();
    let fastest = frames.iter().map(speed).fold(0.0, f64::max);
    println!("steps {steps}, rejected {rejected}, shortest {:.2} ms", shortest * 1e3);
    println!("fastest tip: {fastest:.1} m/s");
    let e = frames[frames.len() - 1].energies;
    let balance = e.kinetic + e.elastic + e.dissipated - e.work - frames[0].energies.elastic;
    println!(
        "work {:.3} J, dissipated {:.3} J, missing in the balance {:.1e} J",
        e.work,
        e.dissipated,
        balance.abs()
    );
    pictures(&frames, &output)?;
    println!("whip: tip reaches {fastest:.1} m/s in {steps} steps");
    Ok(())
}

fn pictures(frames: &[Frame], output: &Output) -> Outcome {
    let curve = |frame: &Frame| -> Vec<[f64; 2]> {
        frame.nodes.iter().map(|n| [n.pose.position.x * 1e3, n.pose.position.z * 1e3]).collect()
    };
    let mut drawing = Drawing::new("A whip, every 30 ms, to scale", "X, mm", "Z, mm");
    for (k, frame) in frames.iter().step_by(3).enumerate() {
        drawing = drawing.line(curve(frame), if k % 5 == 0 { ORANGE } else { BLUE });
    }
    drawing.save(&output.path("strobe.svg"))?;
    let along = |f: fn(&Frame) -> f64| frames.iter().map(move |frame| [frame.time, f(frame)]);
    let energy = Chart::new("Energy", "time, s", "energy, J")
        .line("kinetic", along(|f| f.energies.kinetic))
        .line("elastic", along(|f| f.energies.elastic))
        .line("dissipated", along(|f| f.energies.dissipated))
        .line("work of handle and weight", along(|f| f.energies.work));
    let speed =
        Chart::new("Tip", "time, s", "speed, m/s").line("tip", along(|f| f.tip().velocity.linear.norm()));
    figure::stack(&output.path("energy.svg"), &[energy, speed])?;
    let mut animation = Animation::new("a whip, four times slower", 4.0 * frames[frames.len() - 1].time);
    frames.iter().for_each(|frame| animation.push(curve(frame)));
    animation.save(&output.path("whip.svg"))?;
    let rows = frames.iter().map(|f| {
        let p: Vector3<f64> = f.tip().pose.position;
        [f.time, p.x, p.z, f.tip().velocity.linear.norm()]
    });
    output.csv("whip.csv", ["t_s", "tip_x_m", "tip_z_m", "tip_speed_m_per_s"], rows)
}
