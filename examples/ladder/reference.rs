//! Against the converged 2-D finite elements of the section: every case at its rung, and convergence in (p, r).

use hyperrod::Strain;
use hyperrod::material::{Request, Station};

use super::cases::{Case, cases, rung};
use super::figure::{Chart, Output};
use super::{Outcome, Tally, relative, shape, solid, warping};

fn error(case: &Case, degrees: (usize, usize)) -> Outcome<(f64, usize, usize)> {
    let section = solid(shape(&case.section), case.lambda, warping(degrees))?;
    let (at, strain) = (Station::straight(0.0), Strain::from_array(case.dxi));
    let (response, cold) = section.respond_from(None, &at, &strain, Request::Wrench)?;
    // warm: from the answer at 95 % of the strain
    let (_, near) = section.respond_from(None, &at, &(strain * 0.95), Request::Wrench)?;
    let (_, warm) = section.respond_from(Some(&near), &at, &strain, Request::Wrench)?;
    let psi = response.wrench.to_array();
    let size = psi.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let error = if case.strain == "rest" { size } else { relative(&psi, &case.psi) };
    Ok((error, cold.iterations(), warm.iterations()))
}

pub fn run(tally: &mut Tally, output: &Output, quick: bool) -> Outcome {
    let cases = cases()?;
    for case in &cases {
        let (degrees, tolerance) = rung(&case.section, &case.strain);
        let what = format!("{} {} {}: wrench", case.section, case.law, case.strain);
        tally.error(&what, &warping(degrees).to_string(), error(case, degrees)?.0, tolerance);
    }
    convergence(&cases, output, quick)
}

fn convergence(cases: &[Case], output: &Output, quick: bool) -> Outcome {
    let mut degrees =
        vec![(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (6, 0), (2, 3), (3, 2), (4, 3), (5, 4), (7, 6)];
    if !quick {
        degrees.extend([(9, 8), (11, 10)]);
    }
    println!(
        "\nError of the wrench against (p, r); in brackets Newton iterations from nothing and from 95 % of the strain"
    );
    print!("{:<28}", "case");
    degrees.iter().for_each(|d| print!("{:>15}", format!("{d:?}")));
    println!();
    let mut chart = Chart::new(
        "Wrench of a relaxed section, nu = 0.45",
        "degree p of the basis (p, p - 1)",
        "relative error",
    )
    .log(false, true);
    for case in cases.iter().filter(|c| c.strain != "rest" && (!quick || c.law == "nh045")) {
        print!("{:<28}", format!("{} {} {}", case.section, case.law, case.strain));
        for &d in &degrees {
            let (error, cold, warm) = error(case, d)?;
            print!("{:>15}", format!("{error:.0e} ({cold}, {warm})"));
        }
        println!();
        let drawn =
            [("circle", "bend0.5"), ("rect1x2", "shear0.3"), ("square", "twist0.5"), ("square", "twist1.5")];
        if case.law == "nh045" && drawn.contains(&(case.section.as_str(), case.strain.as_str())) {
            let mut points = Vec::new();
            for p in 3..=if quick { 6 } else { 10 } {
                points.push([p as f64, error(case, (p, p - 1))?.0]);
            }
            chart = chart.dots(&format!("{} {}", case.section, case.strain), points);
        }
    }
    chart.save(&output.path("convergence.svg"))
}
