//! Statics: time against the error of the tip, by order, mesh and law, and against the accuracy asked for.

use hyperrod::load::DeadWrench;
use hyperrod::material::{NeoHookean, Polynomial, ReferencePressure};
use hyperrod::section::{Circle, CrossSection, Section, Stiffness};
use hyperrod::solve::{Order, Workspace};
use hyperrod::{Body, Pose, Rod, Statics};
use nalgebra::{Vector3, vector};
use std::f64::consts::PI;
use std::hint::black_box;

use super::figure::{Chart, Outcome, Slope, stack};
use super::page::{Page, digits, scientific};
use super::scenes::Beam;
use super::table::{Row, Table};
use super::{Run, timing};

const FILE: &str = "statics.csv";
const FIGURE: &str = "work_precision_statics.svg";
const TIME_FIGURE: &str = "work_precision_statics_time.svg";
const ASKED_FIGURE: &str = "work_precision_statics_asked.svg";

const RADIUS: f64 = 0.01; // m
const YOUNG: f64 = 1e7; // Pa
const SHEAR: f64 = YOUNG / 3.0;
const SECOND_MOMENT: f64 = PI * RADIUS * RADIUS * RADIUS * RADIUS / 4.0;

const LAWS: [&str; 3] = ["linear", "neo-Hookean", "polynomial"];

/// Errors that the table of least times has.
const TARGETS: [(&str, f64); 4] = [("1e-4", 1e-4), ("1e-6", 1e-6), ("1e-8", 1e-8), ("1e-10", 1e-10)];

/// L = 1 m, r = 10 mm, a dead force across the tip with PL²/EI = 10.
fn cantilever(law: &str) -> Outcome<Rod<Beam>> {
    let circle = Circle::new(RADIUS);
    let section: Box<dyn CrossSection> = match law {
        "linear" => {
            let area = PI * RADIUS * RADIUS;
            let (bending, torsion) = (YOUNG * SECOND_MOMENT, 2.0 * SHEAR * SECOND_MOMENT);
            let entries = [bending, bending, torsion, SHEAR * area, SHEAR * area, YOUNG * area];
            Box::new(Stiffness::diagonal(entries)?)
        }
        // λ + 2μ = E and μ = G: the same rod at small strain
        "neo-Hookean" => Box::new(Section::new(circle, NeoHookean::new(SHEAR, YOUNG - 2.0 * SHEAR)?)?),
        _ => Box::new(Section::new(circle, polynomial()?)?),
    };
    let force = DeadWrench::force(vector![10.0 * YOUNG * SECOND_MOMENT, 0.0, 0.0])?;
    rod(section, force)
}

/// 1 m long; its mass is of no effect here.
fn rod(section: Box<dyn CrossSection>, force: DeadWrench) -> Outcome<Rod<Beam>> {
    let body = Body::new(1.0, section)?.with_mass_per_length(1.0)?;
    Ok(Rod::clamped(body, Pose::identity()).with_tip_load(force))
}

/// Five terms with moduli of about E and G at rest.
fn polynomial() -> Outcome<ReferencePressure<Polynomial>> {
    let (c10, c01, c20, c11) = (0.4 * SHEAR, 0.1 * SHEAR, 0.02 * SHEAR, -0.005 * SHEAR);
    let d = 0.5 * YOUNG - c10 - 2.0 * c01;
    let terms = [((1, 0), c10), ((0, 1), c01), ((2, 0), c20), ((1, 1), c11)];
    Ok(ReferencePressure(Polynomial::new(&terms, &[d])?))
}

pub fn measure(run: &Run) -> Outcome {
    let mut table = Table::new(&["law", "method", "elements", "asked", "error", "us", "ticks"]);
    for law in LAWS {
        let (rod, tick) = (cantilever(law)?, timing::tick());
        let exact = Statics { elements: 256, order: Order::Six, ..Statics::default() }.solve(&rod)?;
        let exact = exact.tip().pose.position;
        let mut workspace = Workspace::default();
        let mut time = |method: &str, asked: f64, statics: &Statics| -> Outcome {
            let solution = statics.solve_in(&mut workspace, &rod)?;
            let error = (solution.tip().pose.position - exact).norm();
            let elements = solution.nodes().len() - 1;
            let us = timing::quartile(run, || {
                let _ = black_box(statics.solve_in(&mut workspace, &rod));
            });
            table.push(&[law, method], &[elements as f64, asked, error, us, us / tick]);
            Ok(())
        };
        let meshes: [(&str, Order, &[usize]); 3] = [
            ("order 2", Order::Two, run.of(&[4, 16, 64], &[4, 8, 16, 32, 64, 128, 256, 512, 1024])),
            ("order 4", Order::Four, run.of(&[4, 16, 64], &[2, 4, 8, 16, 32, 64, 128, 256])),
            ("order 6", Order::Six, run.of(&[4, 8, 24], &[2, 4, 6, 8, 12, 16, 24, 32, 48])),
        ];
        for (method, order, meshes) in meshes {
            for &elements in meshes {
                time(method, f64::NAN, &Statics { elements, order, ..Statics::default() })?;
            }
        }
        let steps = run.of(1, 3);
        for step in 0..=9 * steps {
            let asked = 1e-2 * 10.0_f64.powf(-f64::from(step) / f64::from(steps));
            time("asked", asked, &Statics::to(asked))?;
        }
    }
    table.save(&run.output.path(FILE))
}

/// How far this solver is from the tip that collocation and shooting agree on, on a thicker rod with the same load.
fn distance_from_reference() -> Outcome<f64> {
    let known = [0.819379901134296, 0.0, 0.443545611563864];
    let (bending, torsion) = (4.908738521234054, 3.2724923474893686);
    let (shear, axial) = (2617.993877991494, 7853.981633974484);
    let section = Stiffness::diagonal([bending, bending, torsion, shear, shear, axial])?;
    let force = DeadWrench::force(vector![10.0 * bending, 0.0, 0.0])?;
    let rod = rod(Box::new(section), force)?;
    let solution = Statics { elements: 256, order: Order::Six, ..Statics::default() }.solve(&rod)?;
    Ok((solution.tip().pose.position - Vector3::from(known)).norm())
}

pub fn page(run: &Run, page: &mut Page) -> Outcome {
    let table = Table::load(&run.output.path(FILE))?;
    draw(run, &table)?;
    draw_asked(run, &table)?;
    page.heading("Statics");
    let far = scientific(distance_from_reference()?);
    page.paragraph(&format!(
        "A cantilever, L = 1 m, r = 10 mm, E = 10 MPa, a dead force across its tip with PL²/EI = 10, from straight. The error is the distance of \
         the tip, over L, from 256 elements of order 6; on a reference case that collocation and shooting agree on to 1e-13 \
         (`tests/data/B1_elastica_finite.json`, PL²/EI = 10) that solver is off by {far}."
    ));
    page.figure(TIME_FIGURE, "Error of the tip against time, by the order of the element");
    page.figure(FIGURE, "Error of the tip against the number of elements, and against time for three laws");
    let mut rows = Vec::new();
    for law in LAWS {
        let mut cells = vec![law.to_string()];
        for (name, target) in TARGETS {
            let good = table.rows().filter(|row| row.is("law", law) && row.number("error") <= target);
            let least = good.min_by(|a, b| a.number("us").total_cmp(&b.number("us")));
            let number = |column: &str| digits(least.map_or(f64::NAN, |row: Row<'_>| row.number(column)));
            let us = page.key(&format!("statics.{law}.to_{name}.us"), &number("us"));
            let ticks = page.key(&format!("statics.{law}.to_{name}.ticks"), &number("ticks"));
            cells.push(format!("{us} ({ticks})"));
        }
        rows.push(cells);
    }
    page.paragraph(
        "The least time of any of these meshes and accuracies that is within an error, µs (ticks):",
    );
    page.table(&["law", "1e-4", "1e-6", "1e-8", "1e-10"], &rows);
    page.paragraph("What comes of an accuracy that is asked for with `Statics::to`: true error of the tip, elements, µs.");
    page.figure(ASKED_FIGURE, "True error against the accuracy asked for");
    asked_table(&table, page);
    Ok(())
}

fn asked_table(table: &Table, page: &mut Page) {
    let mut rows = Vec::new();
    for decade in [2, 4, 6, 8, 10] {
        let mut cells = vec![format!("1e-{decade}")];
        for law in LAWS {
            let asked = |row: &Row<'_>| (row.number("asked").log10() + f64::from(decade)).abs() < 1e-6;
            let found =
                table.rows().find(|row| row.is("law", law) && row.is("method", "asked") && asked(row));
            let Some(row) = found else { continue };
            let key = format!("statics.{law}.asked_1e-{decade}");
            let error = page.key(&format!("{key}.error"), &scientific(row.number("error")));
            let us = page.key(&format!("{key}.us"), &digits(row.number("us")));
            cells.push(format!("{error}, {}, {us}", row.number("elements")));
        }
        rows.push(cells);
    }
    page.table(&["asked", "linear", "neo-Hookean", "polynomial"], &rows);
}

/// The least error that is drawn: below is rounding.
const FLOOR: f64 = 1e-15;

fn points<'a>(
    table: &'a Table,
    law: &'a str,
    method: &'a str,
    x: &'a str,
) -> impl Iterator<Item = [f64; 2]> + 'a {
    let rows = table.rows().filter(move |row| row.is("law", law) && row.is("method", method));
    rows.map(move |row| [row.number(x), row.number("error").max(FLOOR)])
}

fn draw(run: &Run, table: &Table) -> Outcome {
    let reference = "against 256 elements of order 6";
    let mut meshes =
        Chart::new(&format!("Linear law: error and elements, {reference}"), "elements", "tip error / L")
            .log(true, true);
    let mut times = Chart::new(
        &format!("Linear law: error and time, {reference}"),
        "time of a solve, µs",
        "tip error / L",
    )
    .log(true, true);
    for method in ["order 2", "order 4", "order 6"] {
        meshes = meshes.dots(method, points(table, "linear", method, "elements"));
        times = times.dots(method, points(table, "linear", method, "us"));
    }
    times = times.dots("to an accuracy", points(table, "linear", "asked", "us"));
    for (order, at) in [(-2.0, [100.0, 3e-3]), (-4.0, [60.0, 1e-6]), (-6.0, [20.0, 1e-8])] {
        meshes = meshes.slope(Slope { order, at, ratio: 2.0 });
    }
    let mut laws = Chart::new(
        &format!("To an accuracy, three laws, {reference}"),
        "time of a solve, µs",
        "tip error / L",
    )
    .log(true, true);
    for law in LAWS {
        laws = laws.dots(law, points(table, law, "asked", "us"));
    }
    times.save(&run.output.path("figures").join(TIME_FIGURE))?;
    stack(&run.output.path("figures").join(FIGURE), &[meshes, laws])
}

fn draw_asked(run: &Run, table: &Table) -> Outcome {
    let title = "True error against the accuracy asked for; true from 256 elements of order 6";
    let mut chart = Chart::new(title, "accuracy asked for", "tip error / L").log(true, true);
    for law in LAWS {
        chart = chart.dots(law, points(table, law, "asked", "asked"));
    }
    chart = chart.line("error = asked", [[1e-11, 1e-11], [1e-2, 1e-2]]);
    chart.save(&run.output.path("figures").join(ASKED_FIGURE))
}
