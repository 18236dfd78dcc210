//! The ladder of models: cost and modelling error of every rung on three scenes, estimated and true, and what `suggest` makes of it.

use hyperrod::body::Constraint;
use hyperrod::solve::{ModelLadder, Order, Suggestion, Workspace};
use hyperrod::{Rod, StaticSolution, Statics};
use std::hint::black_box;
use std::time::Instant;

use super::figure::{Chart, Marker, Outcome, stack};
use super::page::{Page, digits, scientific};
use super::scenes::{Beam, SECTIONS, Scene, scenes};
use super::table::{Row, Table};
use super::{Run, timing};

const FILE: &str = "models.csv";
const SUGGESTIONS: &str = "suggestions.csv";
const FIGURE: &str = "work_precision_models.svg";

/// In words, for keys, and as a constraint, from the fewest strains to all.
const STRAINS: [(&str, &str); 4] = [
    ("planar xz, Kirchhoff", "planar_kirchhoff"),
    ("planar xz", "planar"),
    ("Kirchhoff", "kirchhoff"),
    ("all strains", "all"),
];

/// How they are drawn.
const MARKERS: [Marker; 4] = [Marker::SmallRing, Marker::SmallDisc, Marker::Ring, Marker::Disc];

const TOLERANCES: [(&str, f64); 6] =
    [("1e-1", 1e-1), ("1e-2", 1e-2), ("1e-3", 1e-3), ("1e-4", 1e-4), ("1e-5", 1e-5), ("1e-6", 1e-6)];

/// Below this a modelling error is rounding.
const FLOOR: f64 = 1e-10;

pub fn measure(run: &Run) -> Outcome {
    let mut table =
        Table::new(&["scene", "section", "strains", "unknowns", "error", "estimate", "us", "ticks"]);
    let mut suggestions =
        Table::new(&["scene", "tolerance", "section", "strains", "estimate", "error", "suggest_ms"]);
    for scene in scenes() {
        let rod = scene.rod(own(), Constraint::none())?;
        let ladder = ladder(&scene, &rod)?;
        let tick = timing::tick();
        let whole = solve(run, &rod)?;
        let start = Instant::now();
        let fine = ladder.suggest(1e-6)?;
        let ms = start.elapsed().as_secs_f64() * 1e3;
        let mut truth = Vec::new();
        for rung in fine.rungs() {
            let section = if rung.section == "own section" { own() } else { &rung.section };
            let error = match solve(run, &scene.rod(section, rung.constraint)?) {
                Ok(found) => distance(&found, &whole, scene.length),
                Err(_) => f64::NAN,
            };
            truth.push(error);
            if !STRAINS.iter().any(|(strains, _)| *strains == rung.strains) {
                continue;
            }
            let us = time(run, &scene.rod(section, rung.constraint)?);
            let estimate = rung.error.size(scene.length);
            let numbers = [rung.unknowns as f64, error, estimate, us, us / tick];
            table.push(&[scene.short, section, rung.strains], &numbers);
        }
        for (name, tolerance) in TOLERANCES {
            let chosen = fine.cheapest(tolerance);
            let place = fine
                .rungs()
                .iter()
                .position(|r| r.section == chosen.section && r.constraint == chosen.constraint);
            let error = place.map_or(f64::NAN, |place| truth[place]);
            let section = if chosen.section == "own section" { own() } else { &chosen.section };
            suggestions.push(
                &[scene.short, name, section, chosen.strains],
                &[chosen.error.size(scene.length), error, ms],
            );
        }
        report(run, &scene, &fine)?;
    }
    table.save(&run.output.path(FILE))?;
    suggestions.save(&run.output.path(SUGGESTIONS))
}

fn own() -> &'static str {
    SECTIONS[SECTIONS.len() - 1]
}

fn ladder<'r>(scene: &Scene, rod: &'r Rod<Beam>) -> Outcome<ModelLadder<'r, Beam>> {
    let mut ladder = ModelLadder::of(rod);
    for section in &SECTIONS[1..SECTIONS.len() - 1] {
        ladder = ladder.with_section(section, scene.section(section)?)?;
    }
    Ok(ladder)
}

fn report(run: &Run, scene: &Scene, suggestion: &Suggestion) -> Outcome {
    let path = run.output.path(&format!("suggestion_{}.txt", scene.short));
    Ok(std::fs::write(path, format!("{}\n\n{suggestion}", scene.title))?)
}

fn statics(run: &Run) -> Statics {
    Statics { elements: run.of(4, 16), order: Order::Six, ..Statics::default() }
}

fn solve(run: &Run, rod: &Rod<Beam>) -> Outcome<StaticSolution> {
    Ok(statics(run).solve(rod)?)
}

fn time(run: &Run, rod: &Rod<Beam>) -> f64 {
    let mut workspace = Workspace::default();
    timing::quartile(run, || drop(black_box(statics(run).solve_in(&mut workspace, rod))))
}

/// The largest displacement / L or rotation between the nodes of two answers.
fn distance(a: &StaticSolution, b: &StaticSolution, length: f64) -> f64 {
    a.nodes().iter().zip(b.nodes()).fold(0.0, |worst, (a, b)| {
        let turn = (a.pose.inverse() * b.pose).log().angular.norm();
        worst.max((a.pose.position - b.pose.position).norm() / length).max(turn)
    })
}

pub fn page(run: &Run, page: &mut Page) -> Outcome {
    let table = Table::load(&run.output.path(FILE))?;
    draw(run, &table)?;
    page.heading("Which model");
    page.paragraph(&format!(
        "What each choice costs, and how far off it is. The modelling error is the largest displacement of a node over L, or rotation in rad, from the richest model, the \
         section `{}` with all strains, on the same mesh of 16 elements of order 6. In the figure a colour is a section, a marker a choice of strains; what is below {FLOOR:.0e} is rounding. The estimate is that of \
         [`suggest`](../src/solve/model_ladder/mod.rs), which solves the richest model only. *Matched* constants are λ + 2μ = E and μ = G: what a rigid section needs to have the moduli of \
         the rod.",
        own()
    ));
    page.figure(FIGURE, "Modelling error against the time of a solve, three scenes");
    for scene in scenes() {
        page.paragraph(&format!("**{}.** Modelling error (estimate), ms of a solve:", scene.title));
        let mut rows = Vec::new();
        for section in SECTIONS {
            let mut cells = vec![section.to_string()];
            for (strains, short) in STRAINS {
                let found = table.rows().find(|row| {
                    row.is("scene", scene.short) && row.is("section", section) && row.is("strains", strains)
                });
                let Some(row) = found else { continue };
                cells.push(cell(page, &format!("models.{}.{section}.{short}", scene.short), &row));
            }
            rows.push(cells);
        }
        page.table(&["section", STRAINS[0].0, STRAINS[1].0, STRAINS[2].0, STRAINS[3].0], &rows);
    }
    suggested(run, page)
}

fn cell(page: &mut Page, key: &str, row: &Row<'_>) -> String {
    let size = |value: f64| if value < FLOOR { "0".to_string() } else { scientific(value) };
    let error = page.key(&format!("{key}.error"), &size(row.number("error")));
    let ms = page.key(&format!("{key}.ms"), &digits(row.number("us") * 1e-3));
    format!("{error} ({}), {ms}", size(row.number("estimate")))
}

fn suggested(run: &Run, page: &mut Page) -> Outcome {
    let table = Table::load(&run.output.path(SUGGESTIONS))?;
    page.paragraph("What `suggest` chooses for a tolerance, with the true error of its choice:");
    let mut rows = Vec::new();
    for (name, _) in TOLERANCES {
        let mut cells = vec![name.to_string()];
        for scene in scenes() {
            let Some(row) =
                table.rows().find(|row| row.is("scene", scene.short) && row.is("tolerance", name))
            else {
                continue;
            };
            let error = row.number("error");
            let error = if error < FLOOR { "0".into() } else { scientific(error) };
            cells.push(format!("{}; {}: {error}", row.text("section"), row.text("strains")));
        }
        rows.push(cells);
    }
    page.table(&["tolerance", "arm", "catheter", "steel rod"], &rows);
    let mut times: Vec<f64> = table.rows().map(|row| row.number("suggest_ms")).collect();
    times.sort_by(f64::total_cmp);
    let ms = page.key("models.suggest.ms", &digits(times[times.len() / 2]));
    page.paragraph(&format!(
        "A suggestion takes {ms} ms here (median), nearly all of it in evaluations of the relaxed sections."
    ));
    Ok(())
}

fn draw(run: &Run, table: &Table) -> Outcome {
    let mut charts = Vec::new();
    for scene in scenes() {
        let title = scene.title.split(", E").next().unwrap_or_default();
        let title = format!("{title}; against {} with all strains", own());
        let mut chart = Chart::new(&title, "time of a solve, ms", "modelling error").log(true, true);
        for section in SECTIONS {
            let rows =
                || table.rows().filter(|row| row.is("scene", scene.short) && row.is("section", section));
            for ((strains, _), marker) in STRAINS.into_iter().zip(MARKERS) {
                let points = rows()
                    .filter(|row| row.is("strains", strains) && row.number("error") > FLOOR)
                    .map(|row| [row.number("us") * 1e-3, row.number("error")]);
                chart = chart.marks_as(section, marker, points);
            }
        }
        for ((strains, _), marker) in STRAINS.into_iter().zip(MARKERS) {
            chart = chart.key(strains, marker);
        }
        charts.push(chart);
    }
    stack(&run.output.path("figures").join(FIGURE), &charts)
}
