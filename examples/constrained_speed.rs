//! What a solve costs with fewer strains: the same rod free, Kirchhoff, planar, and both, as ratios in one run.
//!
//! `cargo run --release --example constrained_speed`
//!
//! A linear rod under a dead transverse force with PL²/EI = 10, 32 elements of order 6, and a round neo-Hookean one whose section is integrated; the fastest
//! tenth of interleaved solves, so that what else the machine does is left out. Then the answers of sections alone, in all strains, in those of a plane, and in
//! the rotations. `-- --quick` repeats less.
#![allow(clippy::print_stdout)]

use hyperrod::body::Constraint;
use hyperrod::load::{DeadLoad, DeadWrench};
use hyperrod::material::{Active, LinearElastic, NeoHookean, Point, Request, Response, Sectional, Station};
use hyperrod::section::{Circle, CrossSection, Section, Stiffness};
use hyperrod::solve::{Order, Workspace};
use hyperrod::{Body, Pose, Rod, Scalar, Statics, Strain, Wrench};
use nalgebra::{Vector3, vector};
use std::hint::black_box;
use std::time::Instant;

/// Name, rod, the memory of its solves, and their times in µs.
type Case<C> = (&'static str, Rod<Body<C>>, Workspace, Vec<f64>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let repeats = if std::env::args().any(|a| a == "--quick") { 101 } else { 2001 };
    let linear = || Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4]);
    // EI = 1 N m², like the other
    let law = NeoHookean::new(17e6, 40e6)?;
    let rubber = || Section::new(Circle::new(0.0115), law);
    let [kirchhoff, planar, _] = compare("a dead force on the tip", linear, repeats, false)?;
    let [heavy_kirchhoff, heavy_planar, _] = compare("its weight as well", linear, repeats, true)?;
    let [soft_kirchhoff, soft_planar, _] =
        compare("a neo-Hookean rod, both loads", rubber, repeats / 2, true)?;
    println!("{:<24}{:>8}{:>8}{:>12}", "section, ns a strain", "all", "plane", "rotations");
    answers("neo-Hookean", &rubber()?, repeats)?;
    answers(
        "a law of the strain",
        &Section::new(Circle::new(0.0115), OfStrain(1e6))?.with_degree(6)?,
        repeats,
    )?;
    answers(
        "linear, integrated once",
        &Section::new(Circle::new(0.0115), LinearElastic::new(1e6, 4e5)?)?,
        repeats,
    )?;
    println!(
        "\nconstrained_speed: times cheaper, tip force: planar {planar:.2}, Kirchhoff {kirchhoff:.2}; \
         with weight: planar {heavy_planar:.2}, Kirchhoff {heavy_kirchhoff:.2}; \
         neo-Hookean: planar {soft_planar:.2}, Kirchhoff {soft_kirchhoff:.2}"
    );
    Ok(())
}

/// Prints a table, and returns how many times cheaper than free the constrained rods are.
fn compare<C: CrossSection>(
    title: &str,
    section: impl Fn() -> hyperrod::Result<C>,
    repeats: usize,
    heavy: bool,
) -> Result<[f64; 3], Box<dyn std::error::Error>> {
    let both = Constraint::kirchhoff().and(Constraint::planar());
    let named = [
        ("free", Constraint::none()),
        ("Kirchhoff", Constraint::kirchhoff()),
        ("planar", Constraint::planar()),
        ("planar Kirchhoff", both),
    ];
    let mut cases: Vec<Case<C>> = Vec::new();
    for (name, constraint) in named {
        let body = Body::new(1.0, section()?)?.with_constraint(constraint);
        let force = DeadWrench::force(vector![10.0, 0.0, 0.0])?;
        let mut rod = Rod::clamped(body, Pose::identity()).with_tip_load(force);
        if heavy {
            rod = rod.with_load(DeadLoad::new(Wrench::new(Vector3::zeros(), vector![2.0, 0.0, -5.0]))?);
        }
        cases.push((name, rod, Workspace::default(), Vec::new()));
    }
    let statics = Statics { elements: 32, order: Order::Six, ..Statics::default() };
    for _ in 0..repeats {
        // in turn, so that what else the machine does meets all alike
        for (_, rod, workspace, times) in &mut cases {
            let start = Instant::now();
            black_box(statics.solve_in(workspace, rod)?);
            times.push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    println!("{title}\n{:<20}{:>12}{:>12}", "rod", "µs a solve", "iterations");
    let mut fastest = [0.0; 4];
    for (tenth, (name, rod, workspace, times)) in fastest.iter_mut().zip(&mut cases) {
        times.sort_by(f64::total_cmp);
        *tenth = times[times.len() / 10];
        let iterations = statics.solve_in(workspace, rod)?.report().iterations.len();
        println!("{name:<20}{tenth:>12.0}{iterations:>12}");
    }
    let ratios = [1, 2, 3].map(|i| fastest[0] / fastest[i]);
    println!("times cheaper: {ratios:.2?}\n");
    Ok(ratios)
}

/// A law written in the strain of the rod: stiffer the more it is stretched.
struct OfStrain(f64);

impl Sectional for OfStrain {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, strain: &Strain<D>, at: &Point<D>) -> D {
        let (v, n) = (&strain.angular, &strain.linear);
        let stretch = n.z + v.x * at.y - v.y * at.x;
        let (a, b) = (n.x - v.z * at.y, n.y + v.z * at.x);
        (stretch * stretch * (stretch * 0.3 + 1.0) * 0.5 + (a * a + b * b) / 6.0) * self.0
    }
}

/// Prints what the tangents at 24 strains of a plane cost, for each.
fn answers(
    name: &str,
    section: &impl CrossSection,
    repeats: usize,
) -> Result<(), Box<dyn std::error::Error>> {
    const SITES: usize = 24;
    let strain = |k: usize| {
        let wave = (0.7 * k as f64).sin();
        Strain::from_array([0.0, 3.0 * wave, 0.0, 0.02 * wave, 0.0, 0.01 + 0.02 * wave])
    };
    let sites: [(Station, Strain); SITES] = std::array::from_fn(|k| (Station::straight(0.0), strain(k)));
    let mut out = [Response::zero(); SITES];
    let sets = [Active::all(), Constraint::planar().active(), Constraint::kirchhoff().active()];
    let mut times = [const { Vec::new() }; 3];
    for _ in 0..repeats {
        for (active, times) in sets.iter().zip(&mut times) {
            let start = Instant::now();
            section.respond_active(black_box(&sites), *active, Request::Tangent, &mut out)?;
            times.push(start.elapsed().as_secs_f64() * 1e9 / SITES as f64);
        }
    }
    let [all, plane, rotations] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 10]
    });
    println!("{name:<24}{all:>8.0}{plane:>8.0}{rotations:>12.0}");
    Ok(())
}
