//! Rods of relaxed sections: a bar twisted once round, and a cantilever of rubber beside what a rigid section makes of it.

use hyperrod::load::DeadWrench;
use hyperrod::material::{NeoHookean, Station};
use hyperrod::section::{CrossSection, PathOptions, Rectangle, Relaxed, Section, Warping, WrenchPath};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Strain, Wrench};
use indicatif::{ProgressBar, ProgressStyle};
use nalgebra::{Vector3, vector};
use std::f64::consts::TAU;

use super::figure::{BLUE, Chart, Drawing, GREY, ORANGE, Output, silhouette};
use super::{Outcome, Tally, respond, warping};

/// Torque and stretch of a bar of square section twisted by ω, free of axial force.
fn free_twist(section: &dyn CrossSection, twist: f64) -> Outcome<[f64; 2]> {
    let mut stretch = 0.0;
    for _ in 0..30 {
        let response = respond(section, [0.0, 0.0, twist, 0.0, 0.0, stretch])?;
        let step = -response.wrench.force.z / response.tangent[(5, 5)];
        stretch += step;
        if step.abs() < 1e-13 {
            let response = respond(section, [0.0, 0.0, twist, 0.0, 0.0, stretch])?;
            return Ok([response.wrench.moment.z, stretch]);
        }
    }
    Err("the stretch of a twisted bar did not converge".into())
}

/// A turn of 2π over ten sides, by sections of growing degree and by a rod at the richest.
pub fn twisted(tally: &mut Tally, quick: bool) -> Outcome {
    let rubber = NeoHookean::from_young(2.6, 0.3)?;
    let twist = TAU / 10.0;
    let square = |degrees| -> Outcome<_> {
        Ok(Relaxed::new(Rectangle::new(1.0, 1.0), rubber)?.with_warping(warping(degrees))?)
    };
    println!("\nSquare bar twisted by 2 pi over L/h = 10, free axially, nu = 0.3");
    println!("{:<14}{:>10}{:>14}{:>14}", "(p, r)", "modes", "torque/mu h^3", "elongation");
    let mut rungs = vec![(0, 0), (1, 0), (3, 2), (4, 4), (5, 4), (7, 6)];
    rungs.push(if quick { (9, 8) } else { (11, 10) });
    let mut values = Vec::new();
    for &degrees in &rungs {
        let section = square(degrees)?;
        let [torque, stretch] = free_twist(&section, twist)?;
        println!("{:<14}{:>10}{torque:>14.6}{stretch:>14.3e}", format!("{degrees:?}"), section.mode_count());
        values.push([torque, stretch]);
    }
    let [coarse, fine] = [values[values.len() - 2], values[values.len() - 1]];
    let rung = warping((7, 6)).to_string();
    tally.line("twisted square: torque, basis refined", &rung, coarse[0], fine[0], 2e-2);
    tally.line("twisted square: elongation, basis refined", &rung, coarse[1], fine[1], 2e-2);
    // the same bar as a rod, under the torque found: it must turn once round and be as long
    let body = Body::new(10.0, square((7, 6))?)?;
    let load = DeadWrench::moment(vector![0.0, 0.0, coarse[0]])?;
    let statics = Statics { elements: 2, ..Statics::default() };
    let solution = statics.solve(&Rod::clamped(body, Pose::identity()).with_tip_load(load))?;
    let tip = solution.tip();
    tally.line("twisted square as a rod: twist at the tip", &rung, tip.strain.angular.z, twist, 1e-8);
    tally.line("twisted square as a rod: length", &rung, tip.pose.position.z, 10.0 * (1.0 + coarse[1]), 1e-8);
    Ok(())
}

const SIDE: f64 = 1.0;
const LENGTH: f64 = 20.0;

fn solve(section: impl CrossSection) -> Outcome<StaticSolution> {
    let load = 2.0 * 2.6 * SIDE.powi(4) / 12.0 / LENGTH.powi(2); // 2 E I / L²
    let body = Body::new(LENGTH, section)?;
    let tip = DeadWrench::force(vector![0.0, -load, 0.0])?;
    let rod = Rod::clamped(body, Pose::identity()).with_tip_load(tip);
    // every iteration evaluates some dozens of relaxed sections: worth a line on the terminal
    let style = ProgressStyle::with_template("{spinner} cantilever, iteration {pos}: {msg}")?;
    let bar = ProgressBar::new_spinner().with_style(style);
    let solution = Statics::to(1e-6).solve_observed(&rod, |iteration| {
        bar.inc(1);
        bar.set_message(format!("{} elements, residual {:.1e}", iteration.elements, iteration.residual));
    });
    bar.finish_and_clear();
    Ok(solution?)
}

/// Square section, L/h = 20, ν = 0.3, dead tip load 2EI/L². Oracle: 3-D finite elements whose clamp lets the end slide in its plane.
pub fn cantilever(tally: &mut Tally, output: &Output) -> Outcome {
    const FINITE_ELEMENTS: f64 = 9.8946;
    let rubber = NeoHookean::from_young(2.6, 0.3)?;
    let solid = |warping| -> Outcome<_> {
        Ok(Relaxed::new(Rectangle::new(SIDE, SIDE), rubber)?.with_warping(warping)?)
    };
    let relaxed = solve(solid(Warping::SHEAR)?)?;
    let rigid = solve(Section::new(Rectangle::new(SIDE, SIDE), rubber)?)?;
    let deflection = |solution: &StaticSolution| -solution.tip().pose.position.y / SIDE;
    let [free, stiff] = [deflection(&relaxed), deflection(&rigid)];
    println!(
        "\nRubber cantilever: tip deflection / h relaxed {free:.4}, rigid {stiff:.4}, 3-D finite elements {FINITE_ELEMENTS}"
    );
    let rung = Warping::SHEAR.to_string();
    tally.line("rubber cantilever: tip deflection", &rung, free, FINITE_ELEMENTS, 5e-4);
    println!("  a rigid section is off by {:.1} %", (stiff / FINITE_ELEMENTS - 1.0) * 100.0);
    let largest = relaxed.extremes(&Body::new(LENGTH, solid(Warping::SHEAR)?)?)?;
    println!(
        "  largest stretch {:.4}, largest von Mises stress {:.4} mu, at s = {} h",
        largest.stretch.point.largest_stretch(),
        largest.stress.point.von_mises(),
        largest.stress.s
    );
    let outline = |solution: &StaticSolution| {
        let mut nodes: Vec<_> = solution.nodes().iter().chain(solution.stages()).collect();
        nodes.sort_by(|a, b| a.s.total_cmp(&b.s));
        let stations: Vec<_> = nodes.iter().map(|node| (node.pose, 0.5 * SIDE)).collect();
        silhouette(&stations, Vector3::y(), [Vector3::z(), Vector3::y()], SIDE)
    };
    let end = [relaxed.tip().pose.position.z / SIDE, -FINITE_ELEMENTS];
    Drawing::new("One word apart: Section::new and Relaxed::new", "z / h", "y / h")
        .wall([0.0, -1.5], [0.0, 1.5])
        .area(outline(&rigid), GREY)
        .area(outline(&relaxed), BLUE)
        .disc(end, 0.25, ORANGE)
        .text("rigid section", [15.2, -4.6])
        .text("relaxed; dot: 3-D finite elements", [8.5, -9.0])
        .save(&output.path("cantilever.svg"))?;
    curves(output)
}

/// Moment–curvature, torque–twist and force–stretch curves of the square, rigid and relaxed.
fn curves(output: &Output) -> Outcome {
    let rubber = NeoHookean::from_young(2.6, 0.3)?;
    let relaxed = Relaxed::new(Rectangle::new(SIDE, SIDE), rubber)?.with_warping(Warping::TORSION)?;
    let rigid = Section::new(Rectangle::new(SIDE, SIDE), rubber)?;
    let mut charts = Vec::new();
    for (place, title, x, y) in [
        (0, "Bending", "curvature × h", "moment / mu h³"),
        (2, "Torsion", "twist × h", "torque / mu h³"),
        (5, "Tension", "stretch − 1", "force / mu h²"),
    ] {
        let mut chart = Chart::new(title, x, y);
        for (name, section) in [("rigid", &rigid as &dyn CrossSection), ("relaxed", &relaxed)] {
            let direction: [f64; 6] = std::array::from_fn(|i| f64::from(u8::from(i == place)));
            let options = PathOptions { largest: 0.3, step: 0.05, max_points: 12 };
            let path = WrenchPath::follow(
                section,
                &Station::straight(0.0),
                &Wrench::from_array(direction),
                &options,
            )?;
            let component = |strain: &Strain| strain.to_array()[place];
            chart = chart.dots(name, path.points.iter().map(|p| [component(&p.strain), p.load]));
        }
        charts.push(chart);
    }
    super::figure::stack(&output.path("curves.svg"), &charts)
}
