//! Brazier's limit point: a bent tube of rubber ovalises until its moment falls.

use hyperrod::Wrench;
use hyperrod::material::{NeoHookean, Station};
use hyperrod::section::{Annulus, PathOptions, PathPoint, Relaxed, WrenchPath};
use std::f64::consts::TAU;

use super::figure::{Chart, Output};
use super::{Outcome, Tally, picture, warping};

const INNER: f64 = 0.5;

fn tube(degree: usize) -> Outcome<Relaxed<Annulus, NeoHookean>> {
    let law = NeoHookean::new(1.0, super::rest::LAMBDA)?; // ν = 0.3
    Ok(Relaxed::new(Annulus::new(INNER, 1.0), law)?.with_warping(warping((degree, 0)))?)
}

pub fn run(tally: &mut Tally, output: &Output, quick: bool) -> Outcome {
    println!(
        "\nBent tube, R_i/R = 0.5, nu = 0.3: the limit of the moment against the degree of r^k cos m theta"
    );
    println!("{:<14}{:>8}{:>16}{:>14}{:>14}", "(p, r)", "modes", "moment/mu R^3", "curvature R", "stretch");
    let moment = Wrench::from_array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let mut chart = Chart::new("Brazier: a bent tube, R_i/R = 0.5", "curvature × R", "moment / mu R³");
    let mut found: Vec<PathPoint> = Vec::new();
    let degrees: &[usize] = if quick { &[2, 4, 5] } else { &[2, 3, 4, 5, 6] };
    for &degree in degrees {
        let section = tube(degree)?;
        let largest = if degree < 4 { 0.7 } else { 0.32 };
        let options = PathOptions { largest, step: if degree < 5 { 0.06 } else { 0.1 }, max_points: 40 };
        let path = WrenchPath::follow(&section, &Station::straight(0.0), &moment, &options)?;
        let limit = *path.limits.first().ok_or("no limit point on the way")?;
        println!(
            "{:<14}{:>8}{:>16.6}{:>14.6}{:>14.6}",
            format!("({degree}, 0)"),
            section.mode_count(),
            limit.load,
            limit.strain.angular.x,
            limit.strain.linear.z
        );
        let points = path.points.iter().chain([&limit]).map(|p| [p.strain.angular.x, p.load]);
        let mut points: Vec<_> = points.collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        chart = chart.line(&format!("p = {degree}"), points);
        found.push(limit);
    }
    chart = chart.dots("limit points", found.iter().map(|p| [p.strain.angular.x, p.load]));
    chart.save(&output.path("brazier.svg"))?;
    let [coarse, fine] = [found[found.len() - 2], found[found.len() - 1]];
    let finest = degrees[degrees.len() - 1];
    // in the short run the bases compared are (4, 0) and (5, 0), which differ by more
    let allowed = if quick { 5e-2 } else { 1e-2 };
    let rung = warping((finest - 1, 0)).to_string();
    tally.line("bent tube: limit moment, basis refined", &rung, coarse.load, fine.load, allowed);
    let section = tube(finest)?;
    let deformed = section.deformed(&Station::straight(0.0), &fine.strain)?;
    picture::draw(&output.path("brazier_section.svg"), "Tube at its limit", &deformed, [10, 72], |a, b| {
        let (sin, cos) = (TAU * b).sin_cos();
        let r = INNER + (1.0 - INNER) * a;
        [r * cos, r * sin]
    })
}
