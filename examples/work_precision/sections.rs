//! Relaxed sections: time of an evaluation against the error of the wrench, one curve a rung.

use hyperrod::Strain;
use hyperrod::material::{NeoHookean, Request, Station};
use hyperrod::section::{CrossSection, EffectiveStiffness, Section, Warping};
use std::hint::black_box;

use super::figure::{Chart, Outcome, stack};
use super::page::{Page, digits, scientific};
use super::section_cases::{Case, cases, relative, shape, solid};
use super::table::{Row, Table};
use super::{Run, timing};

const FILE: &str = "sections.csv";
const FIGURE: &str = "work_precision_sections.svg";

/// What is drawn: section, strain, in words.
const DRAWN: [(&str, &str, &str); 3] = [
    ("circle", "bend0.2", "circle bent to 20 % at its surface"),
    ("rect1x2", "shear0.3", "rectangle 1:2 sheared by 0.3"),
    ("square", "twist0.5", "square twisted by 0.5 a side"),
];

const LAW: &str = "nh045";

pub fn measure(run: &Run) -> Outcome {
    let mut table = Table::new(&[
        "case",
        "rung",
        "modes",
        "quadrature",
        "points",
        "error",
        "us",
        "cold_us",
        "of_rigid",
        "ticks",
    ]);
    let at = Station::straight(0.0);
    for case in cases()? {
        let Some((.., name)) =
            DRAWN.iter().find(|(s, x, _)| case.law == LAW && case.section == *s && case.strain == *x)
        else {
            continue;
        };
        let strain = Strain::from_array(case.dxi);
        let rigid = Section::new(shape(&case.section), NeoHookean::new(1.0, case.lambda)?)?;
        let tick = timing::tick();
        let base = timing::quartile(run, || {
            drop(black_box(rigid.respond(&at, black_box(&strain), Request::Tangent)))
        });
        let error = relative(&rigid.wrench(&at, &strain)?.to_array(), &case.psi);
        let points = rigid.point_count() as f64;
        table.push(
            &[name, "rigid"],
            &[0.0, rigid.degree() as f64, points, error, base, base, 1.0, base / tick],
        );
        for rung in Warping::LADDER.into_iter().skip(1) {
            let degree = rung.in_plane.max(rung.axial);
            let least = (2 * degree).max(4);
            for quadrature in [None, Some(least - 2), Some(least), Some(least + 6)] {
                if run.quick && quadrature.is_some() {
                    continue;
                }
                evaluate(run, &case, name, rung, quadrature, [base, tick], &mut table)?;
            }
        }
    }
    table.save(&run.output.path(FILE))
}

/// Times and error of a rung; `None` is the quadrature it takes by itself.
fn evaluate(
    run: &Run,
    case: &Case,
    name: &str,
    rung: Warping,
    quadrature: Option<usize>,
    [base, tick]: [f64; 2],
    table: &mut Table,
) -> Outcome {
    let (at, strain) = (Station::straight(0.0), Strain::from_array(case.dxi));
    let section = solid(shape(&case.section), case.lambda, rung)?;
    let section = match quadrature {
        Some(degree) => section.with_degree(degree)?,
        None => section,
    };
    let Ok((_, near)) = section.respond_from(None, &at, &(strain * 0.98), Request::Tangent) else {
        return Ok(()); // too poor a quadrature may lose its stability
    };
    let (response, _) = section.respond_from(Some(&near), &at, &strain, Request::Tangent)?;
    let warm = timing::quartile(run, || {
        drop(black_box(section.respond_from(Some(&near), &at, black_box(&strain), Request::Tangent)));
    });
    let cold = match quadrature {
        None => timing::quartile(run, || {
            drop(black_box(section.respond(&at, black_box(&strain), Request::Tangent)))
        }),
        Some(_) => f64::NAN,
    };
    let error = relative(&response.wrench.to_array(), &case.psi);
    let (modes, points) = (section.mode_count() as f64, section.point_count() as f64);
    let degree = quadrature.map_or(0.0, |d| d as f64);
    table.push(
        &[name, &rung.to_string()],
        &[modes, degree, points, error, warm, cold, warm / base, warm / tick],
    );
    Ok(())
}

pub fn page(run: &Run, page: &mut Page) -> Outcome {
    let table = Table::load(&run.output.path(FILE))?;
    draw(run, &table)?;
    page.heading("Sections that relax");
    page.paragraph(
        "One evaluation is energy, Ψ and tangent at one strain, neo-Hookean with ν = 0.45; *warm* starts from the answer at 98 % of the strain, as a rod \
         that converges does, *cold* from rest. The error is that of Ψ, relative to its largest entry, against converged 2-D finite elements of the section \
         (`tests/data/relaxed`). In the figure each rung is a curve over its quadrature. Rungs are those of \
         [`Warping`](../src/section/relaxed/warping.rs).",
    );
    page.figure(FIGURE, "Time of an evaluation against the error of the wrench, one curve a rung");
    for (_, _, name) in DRAWN {
        let mut rows = Vec::new();
        let own = |row: &Row<'_>| {
            row.is("case", name) && (row.number("quadrature") == 0.0 || row.is("rung", "rigid"))
        };
        for row in table.rows().filter(own) {
            let rung = row.text("rung");
            let short = rung.split(" (").next().unwrap_or_default();
            let key = format!("sections.{}.{short}", name.split(' ').next().unwrap_or_default());
            rows.push(vec![
                rung.to_string(),
                row.number("modes").to_string(),
                row.number("points").to_string(),
                page.key(&format!("{key}.us"), &digits(row.number("us"))),
                digits(row.number("ticks")),
                digits(row.number("cold_us")),
                page.key(&format!("{key}.of_rigid"), &digits(row.number("of_rigid"))),
                page.key(&format!("{key}.error"), &scientific(row.number("error"))),
            ]);
        }
        page.table(
            &[
                &format!("{name}: rung (p, r)"),
                "modes",
                "points",
                "warm, µs",
                "ticks",
                "cold, µs",
                "warm / rigid",
                "error of Ψ",
            ],
            &rows,
        );
    }
    let [much, more] = [0.49, 0.4999].map(stiffer);
    let (much, more) = (
        page.key("sections.rigid.axial_0.49", &digits(much?)),
        page.key("sections.rigid.axial_0.4999", &digits(more?)),
    );
    page.paragraph(&format!(
        "A rigid section with the constants of a datasheet is too stiff in tension by (λ + 2μ)/E: {much} times with ν = 0.49, {more} times with ν = 0.4999."
    ));
    Ok(())
}

/// EA of a rigid section over E·A.
fn stiffer(poisson: f64) -> Outcome<f64> {
    let section = Section::new(shape("circle"), NeoHookean::from_young(1.0, poisson)?)?;
    let stiffness = EffectiveStiffness::of(&section, &Station::straight(0.0), &Strain::zero())?;
    Ok(stiffness.axial / std::f64::consts::PI)
}

fn draw(run: &Run, table: &Table) -> Outcome {
    let mut charts = Vec::new();
    for (_, _, name) in DRAWN {
        let title = format!("{name}, ν = 0.45; against converged 2-D finite elements");
        let mut chart = Chart::new(&title, "time of an evaluation, µs", "error of Ψ").log(true, true);
        let mut rungs: Vec<String> = Vec::new();
        for row in table.rows().filter(|row| row.is("case", name)) {
            if rungs.iter().all(|rung| !row.is("rung", rung)) {
                rungs.push(row.text("rung").to_string());
            }
        }
        for rung in &rungs {
            let rows = table.rows().filter(|row| row.is("case", name) && row.is("rung", rung));
            let mut points: Vec<_> = rows.map(|row| [row.number("us"), row.number("error")]).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            chart = chart.dots(
                rung.replace("uniform contraction", "contraction").split(" (").next().unwrap_or_default(),
                points,
            );
        }
        charts.push(chart);
    }
    stack(&run.output.path("figures").join(FIGURE), &charts)
}
