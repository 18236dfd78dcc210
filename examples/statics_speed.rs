//! Time against error of the static solver, on the case its peers were measured with.
//!
//! `cargo run --release --example statics_speed`
//!
//! L = 1 m, r = 10 mm, E = 10 MPa, G = E/3, a dead transverse force on the tip with PL²/EI = 10; single thread, default build, workspace reused, medians.
//! Figures and tables go to `target/hyperrod/statics_speed/`. `-- --quick` repeats less and stops at a thousand elements.
#![allow(clippy::print_stdout)]

mod figure;

use figure::{Chart, Outcome, Output};
use hyperrod::body::Elastic;
use hyperrod::load::DeadWrench;
use hyperrod::material::{NeoHookean, Polynomial, ReferencePressure};
use hyperrod::section::{Circle, Section, Stiffness};
use hyperrod::solve::{Order, Workspace};
use hyperrod::{Body, Pose, Rod, Statics};
use nalgebra::{Vector3, vector};
use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

const RADIUS: f64 = 0.01; // m
const YOUNG: f64 = 1e7; // Pa
const SHEAR: f64 = YOUNG / 3.0;
const SECOND_MOMENT: f64 = PI * RADIUS * RADIUS * RADIUS * RADIUS / 4.0;

/// Asked accuracies, three a decade.
const ASKED: [f64; 28] = {
    let (mut values, mut i) = ([0.0; 28], 0);
    while i < 28 {
        let decade = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11][i / 3];
        values[i] = decade * [1.0, 0.464, 0.215][i % 3];
        i += 1;
    }
    values
};

struct Point {
    label: String,
    elements: usize,
    error: f64,
    micros: f64,
}

fn main() -> Outcome {
    let quick = figure::flag("--quick");
    let repeats = if quick { 15 } else { 301 };
    let output = Output::of("statics_speed")?;
    let tick = calibration(repeats);
    println!("calibration loop of a million dependent multiply-adds: {tick:.0} µs\n");

    let area = PI * RADIUS * RADIUS;
    let (bending, torsion) = (YOUNG * SECOND_MOMENT, 2.0 * SHEAR * SECOND_MOMENT);
    let linear = Stiffness::diagonal([bending, bending, torsion, SHEAR * area, SHEAR * area, YOUNG * area])?;
    let rod = cantilever(Body::new(1.0, linear)?)?;
    let points = sweep(&rod, repeats)?;
    let mut chart = Chart::new("A cantilever with PL²/EI = 10", "tip error / L", "µs").log(true, true);
    for label in ["order 2", "order 4", "order 6", "to an accuracy"] {
        let own = points.iter().filter(|p| p.label == label);
        chart = chart.line(label, own.map(|p| [p.error.max(1e-16), p.micros]));
    }
    chart.save(&output.path("time_against_error.svg"))?;
    output.csv(
        "time_against_error.csv",
        ["order_or_0_for_accuracy", "elements", "tip_error", "microseconds", "ratio_to_calibration"],
        points.iter().map(|p| {
            let order = p.label.strip_prefix("order ").and_then(|o| o.parse().ok()).unwrap_or(0.0);
            [order, p.elements as f64, p.error, p.micros, p.micros / tick]
        }),
    )?;
    let best = best_times(&points);
    println!("{:<26}{:>10}{:>10}{:>10}{:>10}", "section", "1e-4", "1e-6", "1e-8", "1e-10");
    row("linear, µs", &best);
    row("  ratio to calibration", &best.map(|t| t / tick));
    // λ + 2μ = E and μ = G: the same rod at small strain
    let neo_hookean = NeoHookean::new(SHEAR, YOUNG - 2.0 * SHEAR)?;
    let rod = cantilever(Body::new(1.0, Section::new(Circle::new(RADIUS), neo_hookean)?)?)?;
    row("neo-Hookean, µs", &best_times(&sweep(&rod, repeats / 3 + 1)?));
    let rod = cantilever(Body::new(1.0, Section::new(Circle::new(RADIUS), polynomial()?)?)?)?;
    row("5-term polynomial, µs", &best_times(&sweep(&rod, repeats / 3 + 1)?));

    scaling(if quick { 1_000 } else { 100_000 }, &output)?;
    let [a, b, c, d] = best;
    println!("statics_speed: 1e-4 {a:.0} us, 1e-6 {b:.0} us, 1e-8 {c:.0} us, 1e-10 {d:.0} us");
    Ok(())
}

/// Five terms with moduli of about E and G at rest.
fn polynomial() -> Outcome<ReferencePressure<Polynomial>> {
    let (c10, c01, c20, c11) = (0.4 * SHEAR, 0.1 * SHEAR, 0.02 * SHEAR, -0.005 * SHEAR);
    let d = 0.5 * YOUNG - c10 - 2.0 * c01;
    let terms = [((1, 0), c10), ((0, 1), c01), ((2, 0), c20), ((1, 1), c11)];
    Ok(ReferencePressure(Polynomial::new(&terms, &[d])?))
}

fn cantilever<B: Elastic>(body: B) -> Outcome<Rod<B>> {
    let force = vector![10.0 * YOUNG * SECOND_MOMENT, 0.0, 0.0];
    Ok(Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(force)?))
}

/// Every order on meshes of its own, and every accuracy asked.
fn sweep<B: Elastic>(rod: &Rod<B>, repeats: usize) -> Outcome<Vec<Point>> {
    let exact = Statics { elements: 256, order: Order::Six, ..Statics::default() }.solve(rod)?;
    let exact = exact.tip().pose.position;
    let mut workspace = Workspace::default();
    let mut points = Vec::new();
    for (order, label, meshes) in [
        (Order::Two, "order 2", &[4, 16, 64, 256, 1024][..]),
        (Order::Four, "order 4", &[2, 4, 8, 16, 32, 64, 128]),
        (Order::Six, "order 6", &[2, 4, 6, 8, 12, 16, 24, 32]),
    ] {
        for &elements in meshes {
            let statics = Statics { elements, order, ..Statics::default() };
            points.push(measure(&statics, label, rod, &exact, &mut workspace, repeats)?);
        }
    }
    for asked in ASKED {
        points.push(measure(&Statics::to(asked), "to an accuracy", rod, &exact, &mut workspace, repeats)?);
    }
    Ok(points)
}

fn measure<B: Elastic>(
    statics: &Statics,
    label: &str,
    rod: &Rod<B>,
    exact: &Vector3<f64>,
    workspace: &mut Workspace,
    repeats: usize,
) -> Outcome<Point> {
    let solution = statics.solve_in(workspace, rod)?;
    let mut times = Vec::with_capacity(repeats);
    for _ in 0..repeats {
        let start = Instant::now();
        black_box(statics.solve_in(workspace, rod)?);
        times.push(start.elapsed().as_secs_f64() * 1e6);
    }
    Ok(Point {
        label: label.to_string(),
        elements: solution.nodes().len() - 1,
        error: (solution.tip().pose.position - exact).norm(),
        micros: median(times),
    })
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The least time that reaches 1e-4, 1e-6, 1e-8 and 1e-10.
fn best_times(points: &[Point]) -> [f64; 4] {
    [1e-4, 1e-6, 1e-8, 1e-10].map(|target| {
        points.iter().filter(|p| p.error <= target).map(|p| p.micros).fold(f64::INFINITY, f64::min)
    })
}

fn row(name: &str, values: &[f64; 4]) {
    let [a, b, c, d] = values.map(|v| if v < 1.0 { format!("{v:.3}") } else { format!("{v:.0}") });
    println!("{name:<26}{a:>10}{b:>10}{c:>10}{d:>10}");
}

/// Microseconds of a loop that only the clock of the processor decides.
fn calibration(repeats: usize) -> f64 {
    let run = || {
        let start = Instant::now();
        let mut x = black_box(1.0_f64);
        for _ in 0..1_000_000 {
            x = x * 0.999_999 + 1e-6;
        }
        black_box(x);
        start.elapsed().as_secs_f64() * 1e6
    };
    median((0..repeats.min(31)).map(|_| run()).collect())
}

/// Time an element and iteration, which must not grow with their number.
fn scaling(most: usize, output: &Output) -> Outcome {
    let area = PI * RADIUS * RADIUS;
    let (bending, torsion) = (YOUNG * SECOND_MOMENT, 2.0 * SHEAR * SECOND_MOMENT);
    let linear = Stiffness::diagonal([bending, bending, torsion, SHEAR * area, SHEAR * area, YOUNG * area])?;
    let rod = cantilever(Body::new(1.0, linear)?)?;
    let mut workspace = Workspace::default();
    let mut rows = Vec::new();
    println!("\n{:>10}{:>14}{:>26}", "elements", "ms", "µs/element/iteration");
    let mut elements = 100;
    while elements <= most {
        let statics = Statics { elements, order: Order::Six, ..Statics::default() };
        statics.solve_in(&mut workspace, &rod)?;
        let solution = statics.solve_in(&mut workspace, &rod)?;
        let work: usize = solution.report().iterations.iter().map(|i| i.elements).sum();
        let micros = solution.report().elapsed.as_secs_f64() * 1e6;
        println!("{elements:>10}{:>14.2}{:>26.2}", micros / 1e3, micros / work as f64);
        rows.push([elements as f64, micros, micros / work as f64]);
        elements *= 10;
    }
    println!();
    output.csv("scaling.csv", ["elements", "microseconds", "microseconds_per_element_and_iteration"], rows)
}
