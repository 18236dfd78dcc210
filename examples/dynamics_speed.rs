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

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let rod = rod()?;
    let scene = Scene::new(&rod);
    let alpha = Scheme::GeneralisedAlpha { rho: 0.9 };
    let meshes: &[(Order, usize)] = if quick {
        &[(Order::Four, 4), (Order::Six, 3)]
    } else {
        &[
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
        ]
    };
    println!(
        "scheme   order elements steps  iterations factorisations  error    ms per simulated second, calibration loops"
    );
    // time, and the same in calibration loops timed next to it
    let mut best = [[f64::INFINITY; 2]; 2];
    for (name, scheme, steps) in [
        ("ESDIRK", Scheme::Esdirk43, [30, 40, 50, 80, 100, 120, 160]),
        ("gen. α", alpha, [80, 160, 240, 320, 640, 1280, 1920]),
    ] {
        for &(order, elements) in meshes {
            for steps in steps {
                let dynamics = Dynamics {
                    order,
                    elements,
                    scheme,
                    step: Step::Fixed(1.0 / f64::from(steps)),
                    tolerance: 1e-6,
                    ..Dynamics::default()
                };
                let Run { error, iterations, factorisations, .. } = match run(&scene, &dynamics) {
                    Ok(found) => found,
                    Err(failure) => {
                        println!("{name:8} {order:?} {elements} {steps}: {failure}");
                        continue;
                    }
                };
                let before = calibration();
                let time = milliseconds(if quick { 5 } else { 11 }, &scene, &dynamics)?;
                let loops = time / (0.5 * (before + calibration()));
                let order = format!("{order:?}");
                println!(
                    "{name:8} {order:5} {elements:8} {steps:5} {iterations:11} {factorisations:14}  {error:.1e}  {time:8.2} {loops:8.2}"
                );
                for (best, limit) in best.iter_mut().zip([1e-3, 1e-4]) {
                    if error <= limit {
                        *best = [best[0].min(time), best[1].min(loops)];
                    }
                }
            }
        }
    }
    let [[coarse, coarse_loops], [fine, fine_loops]] = best;
    println!("within 1e-3 in {coarse_loops:.2} calibration loops of {:.2} ms", calibration());
    println!("within 1e-4 in {fine_loops:.2} calibration loops, {fine:.1} ms per simulated second");
    println!("dynamics_speed: within 1e-3 in {coarse:.1} ms per simulated second");
    Ok(())
}
