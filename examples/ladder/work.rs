//! Work and precision: what an evaluation costs against a rigid section, and what error it leaves.

use hyperrod::Strain;
use hyperrod::material::{NeoHookean, Request, Station};
use hyperrod::section::{CrossSection, Section, Warping};
use std::time::Instant;

use super::figure::{Chart, Output, stack};
use super::reference::{Case, cases};
use super::rest::shape;
use super::{Outcome, relative, solid};

/// The median time of a call, s.
fn median(repeats: usize, mut call: impl FnMut() -> Outcome) -> Outcome<f64> {
    let mut times = Vec::new();
    for _ in 0..repeats {
        let start = Instant::now();
        call()?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    Ok(times[repeats / 2])
}

pub fn run(output: &Output, quick: bool) -> Outcome {
    let repeats = if quick { 5 } else { 41 };
    let at = Station::straight(0.0);
    let drawn = [("circle", "bend0.2"), ("rect1x2", "shear0.3"), ("square", "twist0.5")];
    println!(
        "\nWork and precision (nu = 0.45): one response with tangent, times those of a rigid section; error of the wrench"
    );
    println!("{:<20}{:>7}{:>8}{:>8}{:>9}   error in {:?}", "rung", "modes", "points", "cold", "warm", drawn);
    let cases: Vec<Case> = cases()?
        .into_iter()
        .filter(|c| c.law == "nh045" && drawn.contains(&(c.section.as_str(), c.strain.as_str())))
        .collect();
    for rung in Warping::LADDER {
        let (mut cold_ratio, mut warm_ratio, mut modes, mut points) = (0.0, 0.0, 0, 0);
        let mut errors = Vec::new();
        for case in &cases {
            let strain = Strain::from_array(case.dxi);
            let rigid = Section::new(shape(&case.section), NeoHookean::new(1.0, case.lambda)?)?;
            let section = solid(shape(&case.section), case.lambda, rung)?;
            let base =
                median(20 * repeats, || Ok(rigid.respond(&at, &strain, Request::Tangent).map(|_| ())?))?;
            let cold =
                median(repeats, || Ok(section.respond(&at, &strain, Request::Tangent).map(|_| ())?))?;
            let (_, near) = section.respond_from(None, &at, &(strain * 0.98), Request::Tangent)?;
            let warm = median(repeats, || {
                Ok(section.respond_from(Some(&near), &at, &strain, Request::Tangent).map(|_| ())?)
            })?;
            let psi = section.wrench(&at, &strain)?.to_array();
            let error = relative(&psi, &case.psi);
            errors.push(error);
            cold_ratio += cold / base / cases.len() as f64;
            warm_ratio += warm / base / cases.len() as f64;
            (modes, points) = (section.mode_count(), section.point_count());
        }
        let listed: Vec<String> = errors.iter().map(|e| format!("{e:.0e}")).collect();
        println!(
            "{:<20}{modes:>7}{points:>8}{cold_ratio:>8.0}{warm_ratio:>9.0}   {}",
            rung.to_string(),
            listed.join("  ")
        );
    }
    charts(&cases, repeats, output)
}

/// Time against error: one curve a rung, along which the quadrature grows.
fn charts(cases: &[Case], repeats: usize, output: &Output) -> Outcome {
    let at = Station::straight(0.0);
    let mut charts = Vec::new();
    for case in cases {
        let title =
            format!("{} {}, nu = 0.45: quadrature of degree 2d - 2 to 2d + 6", case.section, case.strain);
        let mut chart = Chart::new(&title, "time / rigid section", "error of the wrench").log(true, true);
        let strain = Strain::from_array(case.dxi);
        let rigid = Section::new(shape(&case.section), NeoHookean::new(1.0, case.lambda)?)?;
        let base = median(20 * repeats, || Ok(rigid.respond(&at, &strain, Request::Tangent).map(|_| ())?))?;
        for rung in [Warping::ANTICLASTIC, Warping::BENDING, Warping::SHEAR, Warping::TORSION, Warping::LARGE]
        {
            let degree = rung.in_plane.max(rung.axial);
            let mut points = Vec::new();
            for quadrature in [2 * degree - 2, 2 * degree, 2 * degree + 2, 2 * degree + 6] {
                let section =
                    solid(shape(&case.section), case.lambda, rung)?.with_degree(quadrature.max(2))?;
                let Ok((_, near)) = section.respond_from(None, &at, &(strain * 0.98), Request::Tangent)
                else {
                    continue; // too poor a quadrature may lose its stability
                };
                let (response, _) = section.respond_from(Some(&near), &at, &strain, Request::Tangent)?;
                let time = median(repeats, || {
                    Ok(section.respond_from(Some(&near), &at, &strain, Request::Tangent).map(|_| ())?)
                })?;
                points.push([time / base, relative(&response.wrench.to_array(), &case.psi)]);
            }
            chart = chart.dots(&format!("({}, {})", rung.in_plane, rung.axial), points);
        }
        charts.push(chart);
    }
    stack(&output.path("work_precision.svg"), &charts)
}
