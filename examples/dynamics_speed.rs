//! Work against precision: a rod of 1 m, 5 cm thick, 10 MPa, released horizontally under gravity and followed for a second.
//!
//! `cargo run --release --example dynamics_speed` (`-- --quick` for a few rows). The errors are the largest distance of the tip, relative to
//! the length, from the reference at 0.5 s and 1 s, which two other codes agree on to 3e-6 under refinement; times are sums of the medians of steps on one thread.
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use hyperrod::body::Density;
use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::{Dynamics, Failure, Scene, Scheme, Start, Step};
use hyperrod::{Body, Pose, Rod};
use nalgebra::{Vector3, vector};
use std::hint::black_box;
use std::time::Instant;

type Beam = Body<Section<Circle<f64>, LinearElastic>, Density>;

/// Time, and the tip along the rod and upwards.
const REFERENCE: [(f64, f64, f64); 2] = [(0.5, 0.377994, -0.830157), (1.0, 0.977002, -0.204892)];

fn rod() -> hyperrod::Result<Rod<Beam>> {
    let section = Section::new(Circle::new(0.025), LinearElastic::new(1e7, 1e7 / 3.0)?)?;
    let body = Body::new(1.0, section)?.with_density(1000.0)?;
    Ok(Rod::clamped(body, Pose::identity()).with_load(Gravity::new(vector![-9.81, 0.0, 0.0])?))
}

/// What a run over one second came to.
#[derive(Default)]
struct Run {
    error: f64,
    iterations: usize,
    factorisations: usize,
    /// Seconds of the start and of every step.
    times: Vec<f64>,
}

fn run(scene: &Scene<'_, Beam>, dynamics: &Dynamics) -> Result<Run, Box<Failure>> {
    let mut clock = Instant::now();
    let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
    let mut run = Run::default();
    let mut stepper = dynamics.start(scene, &Start::at_rest())?;
    run.times.push(lap());
    for (time, along, up) in REFERENCE {
        while !stepper.is_at(time) {
            let report = stepper.step_toward(time)?;
            run.iterations += report.iterations;
            run.factorisations += report.factorisations;
            run.times.push(lap());
        }
        let tip = stepper.frame()?.tip().pose.position;
        run.error = run.error.max((tip - Vector3::new(up, 0.0, along)).norm());
    }
    Ok(run)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Milliseconds of a run: every step takes its median over the repetitions, which do the same. Where others use the machine, a whole run
/// is interrupted more often than not, and a step seldom.
fn milliseconds(
    repetitions: usize,
    scene: &Scene<'_, Beam>,
    dynamics: &Dynamics,
) -> Result<f64, Box<Failure>> {
    let runs = (0..repetitions)
        .map(|_| Ok(run(scene, dynamics)?.times))
        .collect::<Result<Vec<_>, Box<Failure>>>()?;
    let step = |k: usize| median(runs.iter().map(|times| times[k]).collect());
    Ok((0..runs[0].len()).map(step).sum::<f64>() * 1e3)
}

/// Milliseconds of a million dependent multiply-adds, a loop that only the clock of the processor decides.
fn calibration() -> f64 {
    // in a hundred parts, for the same reason
    let part = || {
        let clock = Instant::now();
        let mut x = black_box(1.0_f64);
        for _ in 0..10_000 {
            x = x * 0.999_999 + 1e-6;
        }
        black_box(x);
        clock.elapsed().as_secs_f64()
    };
    1e3 * 100.0 * median((0..100).map(|_| part()).collect())
}

const QUICK: [(Order, usize); 2] = [(Order::Four, 4), (Order::Six, 3)];

const MESHES: [(Order, usize); 11] = [
    (Order::Two, 8),
    (Order::Two, 16),
    (Order::Four, 3),
    (Order::Four, 4),
    (Order::Four, 5),
    (Order::Four, 6),
    (Order::Four, 10),
    (Order::Six, 2),
    (Order::Six, 3),
    (Order::Six, 4),
    (Order::Six, 6),
];

/// Least milliseconds within an error, and the same in calibration loops timed next to it.
struct Best {
    error: f64,
    milliseconds: f64,
    loops: f64,
}

/// Prints how a run goes, and what it takes.
fn row(name: &str, scene: &Scene<'_, Beam>, dynamics: &Dynamics, repetitions: usize, best: &mut [Best]) {
    let Dynamics { order, elements, .. } = dynamics;
    let Step::Fixed(dt) = dynamics.step else { return };
    let steps = (1.0 / dt).round();
    let before = calibration();
    let found = run(scene, dynamics).and_then(|run| Ok((run, milliseconds(repetitions, scene, dynamics)?)));
    let (run, time) = match found {
        Ok(found) => found,
        Err(failure) => return println!("{name:8} {order:?} {elements} {steps}: {failure}"),
    };
    let loops = time / (0.5 * (before + calibration()));
    let Run { error, iterations, factorisations, .. } = run;
    let order = format!("{order:?}");
    println!(
        "{name:8} {order:5} {elements:8} {steps:5} {iterations:11} {factorisations:14}  {error:.1e}  {time:8.2} {loops:8.2}"
    );
    for best in best.iter_mut().filter(|best| error <= best.error) {
        (best.milliseconds, best.loops) = (best.milliseconds.min(time), best.loops.min(loops));
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let rod = rod()?;
    let scene = Scene::new(&rod);
    let alpha = Scheme::GeneralisedAlpha { rho: 0.9 };
    let meshes: &[(Order, usize)] = if quick { &QUICK } else { &MESHES };
    println!(
        "scheme   order elements steps  iterations factorisations  error    ms per simulated second, calibration loops"
    );
    let mut best =
        [1e-3, 1e-4].map(|error| Best { error, milliseconds: f64::INFINITY, loops: f64::INFINITY });
    for (name, scheme, steps) in [
        ("ESDIRK", Scheme::Esdirk43, [30, 40, 50, 80, 100, 120, 160]),
        ("gen. α", alpha, [80, 160, 240, 320, 640, 1280, 1920]),
    ] {
        for &(order, elements) in meshes {
            for steps in steps {
                let step = Step::Fixed(1.0 / f64::from(steps));
                let dynamics =
                    Dynamics { order, elements, scheme, step, tolerance: 1e-6, ..Dynamics::default() };
                row(name, &scene, &dynamics, if quick { 5 } else { 11 }, &mut best);
            }
        }
    }
    let [coarse, fine] = best;
    println!("within 1e-3 in {:.2} calibration loops of {:.2} ms", coarse.loops, calibration());
    println!(
        "within 1e-4 in {:.2} calibration loops, {:.1} ms per simulated second",
        fine.loops, fine.milliseconds
    );
    println!("dynamics_speed: within 1e-3 in {:.1} ms per simulated second", coarse.milliseconds);
    Ok(())
}
