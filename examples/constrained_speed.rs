//! What a solve costs with fewer strains: the same rod free, Kirchhoff, planar, and both, as ratios in one run.
//!
//! `cargo run --release --example constrained_speed`
//!
//! A linear rod under a dead transverse force with PL²/EI = 10, 32 elements of order 6; medians of interleaved solves. `-- --quick` repeats less.
#![allow(clippy::print_stdout)]

use hyperrod::body::Constraint;
use hyperrod::load::DeadWrench;
use hyperrod::section::Stiffness;
use hyperrod::solve::{Order, Workspace};
use hyperrod::{Body, Pose, Rod, Statics};
use nalgebra::vector;
use std::hint::black_box;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let repeats = if std::env::args().any(|a| a == "--quick") { 201 } else { 2001 };
    let both = Constraint::kirchhoff().and(Constraint::planar());
    let named = [
        ("free", Constraint::none()),
        ("Kirchhoff", Constraint::kirchhoff()),
        ("planar", Constraint::planar()),
        ("planar Kirchhoff", both),
    ];
    let mut rods = Vec::new();
    for (name, constraint) in named {
        let section = Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?;
        let body = Body::new(1.0, section)?.with_constraint(constraint);
        let force = DeadWrench::force(vector![10.0, 0.0, 0.0])?;
        rods.push((name, Rod::clamped(body, Pose::identity()).with_tip_load(force), Vec::new()));
    }
    let statics = Statics { elements: 32, order: Order::Six, ..Statics::default() };
    let mut workspace = Workspace::default();
    for _ in 0..repeats {
        // in turn, so that what else the machine does meets all alike
        for (_, rod, times) in &mut rods {
            let start = Instant::now();
            black_box(statics.solve_in(&mut workspace, rod)?);
            times.push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    let mut medians = Vec::new();
    println!("{:<20}{:>12}{:>16}{:>12}", "rod", "µs a solve", "times cheaper", "iterations");
    for (name, rod, times) in &mut rods {
        times.sort_by(f64::total_cmp);
        medians.push(times[times.len() / 2]);
        let (own, iterations) = (medians[medians.len() - 1], statics.solve(rod)?.report().iterations.len());
        println!("{name:<20}{own:>12.0}{:>16.2}{iterations:>12}", medians[0] / own);
    }
    let [free, kirchhoff, planar, both] = medians[..] else { return Ok(()) };
    let (kirchhoff, planar, both) = (free / kirchhoff, free / planar, free / both);
    println!("constrained_speed: Kirchhoff {kirchhoff:.2}, planar {planar:.2}, both {both:.2} times cheaper");
    Ok(())
}
