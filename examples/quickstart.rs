//! A tapered silicone arm that bends under its own weight and 20 g at its tip: from an energy density to a picture.
//!
//! `cargo run --release --example quickstart`
//!
//! Figures go to `target/hyperrod/quickstart/`; with `-- --docs` the README's picture is renewed as well; `-- --quick` takes a
//! coarse mesh.
#![allow(clippy::print_stdout)]

mod figure;

use figure::{BLUE, Chart, Drawing, GREY, Outcome, Output, silhouette};
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::{Deformation, Point};
use hyperrod::section::{Circle, Linear, Section};
use hyperrod::solve::Node;
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, isotropic};
use nalgebra::{Isometry3, Matrix3, Vector3, vector};
use std::f64::consts::{FRAC_PI_2, TAU};

const LENGTH: f64 = 0.25; // m
const RADIUS: Linear = Linear { from: 0.012, to: 0.006, length: LENGTH }; // m
const DENSITY: f64 = 1070.0; // kg/m³
const TIP_MASS: f64 = 0.020; // kg
const STEEL_BALL: f64 = 8.5; // mm, the radius of 20 g of steel

fn main() -> Outcome {
    // The material: one function of the invariants, u = C₁₀ (I₁−3) + C₂₀ (I₁−3)² + D₁ (J−1)², with the pressure −2C₁₀ (J−1) that
    // makes rest stress-free (it is inside `i1_excess` = I₁ − 3 − 2(J−1)). On a rigid section, which cannot contract sideways,
    // the rod then has the moduli E = 2C₁₀ + 8C₂₀ + 2D₁ and G = 2C₁₀. C₁₀ and D₁ are chosen so that these are a soft silicone's,
    // E = 600 kPa and G = E/3, for this section: they are not the constants one would measure on a cube of it.
    let (young, shear) = (600e3, 200e3); // Pa
    let c20 = 10e3; // Pa, stiffens in tension
    let c10 = 0.5 * shear;
    let d1 = 0.5 * young - c10 - 4.0 * c20;
    let silicone = isotropic!([c10: f64, c20: f64, d1: f64] degree 4; |i, _at| {
        i.i1_excess() * c10 + i.i1() * i.i1() * c20 + i.j() * i.j() * d1
    });

    // The rod: a section filled with it, a body with a density, a clamp that points along +X, two loads.
    let section = Section::new(Circle::new(RADIUS), silicone)?;
    let arm = Body::new(LENGTH, section)?.with_density(DENSITY)?;
    let clamp = Pose::from(Isometry3::rotation(vector![0.0, FRAC_PI_2, 0.0]));
    let rod = Rod::clamped(arm, clamp)
        .with_load(Gravity::standard())
        .with_tip_load(DeadWrench::force(vector![0.0, 0.0, -9.80665 * TIP_MASS])?);

    let elements = if figure::flag("--quick") { 8 } else { 32 };
    let solution = Statics { elements, ..Statics::default() }.solve(&rod)?;

    print_table(&solution);
    let output = Output::of("quickstart")?;
    draw_arm(&solution, &clamp, &output)?;
    plot_strains(&solution, &output)
}

/// The largest stretch of a lengthwise fibre on the rim of the section.
fn rim_stretch(node: &Node) -> f64 {
    let stretch = |angle: f64| {
        let (x, y) = (radius(node.s) * angle.cos(), radius(node.s) * angle.sin());
        let deformation = Deformation::of(&node.strain, &Point { x, y, s: node.s });
        (1.0 + deformation.stretch_squared_minus_one(&Vector3::z())).sqrt()
    };
    (0..360).map(|k| stretch(TAU * k as f64 / 360.0)).fold(0.0, f64::max)
}

fn radius(s: f64) -> f64 {
    RADIUS.from + (RADIUS.to - RADIUS.from) * s / LENGTH
}

fn print_table(solution: &StaticSolution) {
    let (tip, report) = (solution.tip().pose, solution.report());
    let turn = (solution.base().pose.inverse() * tip).log().angular.norm().to_degrees();
    let stretch = solution.nodes().iter().map(rim_stretch).fold(0.0, f64::max);
    let row = |name: &str, value: String, unit: &str| println!("{name:<34}{value:>14}  {unit}");
    println!("Tapered silicone arm, clamped horizontally, own weight and 20 g at the tip\n");
    row("tip position X", format!("{:.4}", tip.position.x * 1e3), "mm");
    row("tip position Z", format!("{:.4}", tip.position.z * 1e3), "mm");
    row("tip rotation", format!("{turn:.4}"), "degrees");
    row("largest stretch on the rim", format!("{stretch:.4}"), "");
    row("strain energy", format!("{:.4}", solution.strain_energy() * 1e3), "mJ");
    for (k, iteration) in report.iterations.iter().enumerate() {
        let name = format!("residual before step {}, {} elements", k + 1, iteration.elements);
        row(&name, format!("{:.1e}", iteration.residual), "of the largest wrench");
    }
    row("residual of the answer", format!("{:.1e}", report.residual), "of the largest wrench");
    row("estimated error, position", format!("{:.1e}", report.error.position * 1e3), "mm");
    row("estimated error, rotation", format!("{:.1e}", report.error.rotation.to_degrees()), "degrees");
    row("solve time", format!("{:.2}", report.elapsed.as_secs_f64() * 1e3), "ms");
}

/// The arm seen from the side, to scale. The section's x axis lies in the plane of the drawing.
fn draw_arm(solution: &StaticSolution, clamp: &Pose, output: &Output) -> Outcome {
    let side =
        |stations: &[(Pose, f64)]| silhouette(stations, Vector3::x(), [Vector3::x(), Vector3::z()], 1e-3);
    let bent: Vec<_> = solution.nodes().iter().map(|n| (n.pose, radius(n.s))).collect();
    let unloaded = |s: f64| (*clamp * Pose::new(Matrix3::identity(), Vector3::z() * s), radius(s));
    let tip = solution.tip().pose.position * 1e3;
    let path = output.path("arm.svg");
    Drawing::new("Silicone arm under its own weight and 20 g, to scale", "X, mm", "Z, mm")
        .ghost(side(&[unloaded(0.0), unloaded(LENGTH)]))
        .text("unloaded", [200.0, 16.0])
        .disc([tip.x, tip.z - STEEL_BALL], STEEL_BALL, GREY)
        .text("20 g", [tip.x + 22.0, tip.z - STEEL_BALL])
        .area(side(&bent), BLUE)
        .wall([0.0, -22.0], [0.0, 22.0])
        .save(&path)?;
    if figure::flag("--docs") { figure::copy_to_docs(&path, "quickstart_arm.svg") } else { Ok(()) }
}

fn plot_strains(solution: &StaticSolution, output: &Output) -> Outcome {
    let nodes = solution.nodes();
    let along = |f: fn(&Node) -> f64| nodes.iter().map(move |n| [n.s * 1e3, f(n)]);
    let curvature = Chart::new("Curvature", "arc length s, mm", "curvature, 1/m")
        .line("|ω|", along(|n| n.strain.angular.norm()));
    let stretch = Chart::new("Stretch", "arc length s, mm", "stretch")
        .line("axis", along(|n| 1.0 + n.strain.linear.z))
        .line("rim, largest", along(rim_stretch));
    figure::stack(&output.path("strains.svg"), &[curvature, stretch])?;
    let rows = nodes.iter().map(|n| [n.s, n.strain.angular.norm(), 1.0 + n.strain.linear.z, rim_stretch(n)]);
    output.csv("strains.csv", ["s_m", "curvature_per_m", "stretch_axis", "stretch_rim"], rows)
}
