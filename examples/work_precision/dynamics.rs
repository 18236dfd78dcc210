//! Dynamics: wall time of a simulated second against the error of the tip, over steps, meshes and schemes.

use hyperrod::body::Density;
use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::{Dynamics, Failure, Scene, Scheme, Start, Step};
use hyperrod::{Body, Pose, Rod};
use nalgebra::{Vector3, vector};

use super::figure::{Chart, Outcome, Slope, stack};
use super::page::{Page, digits, scientific};
use super::table::{Row, Table};
use super::{Run, timing};

const FILE: &str = "dynamics.csv";
const REFERENCE: &str = "dynamics_reference.csv";
const FIGURE: &str = "work_precision_dynamics.svg";

const TARGETS: [(&str, f64); 4] = [("1e-2", 1e-2), ("1e-3", 1e-3), ("1e-4", 1e-4), ("1e-5", 1e-5)];

/// When the tip is looked at, s.
const TIMES: [f64; 2] = [0.5, 1.0];

/// What two other codes agree on at these times to 3e-6, under refinement: along the rod and upwards, m.
const OTHERS: [[f64; 2]; 2] = [[0.377994, -0.830157], [0.977002, -0.204892]];

type Beam = Body<Section<Circle<f64>, LinearElastic>, Density>;
type Tips = [Vector3<f64>; 2];

/// L = 1 m, r = 25 mm, 10 MPa, released horizontally under gravity.
fn rod() -> hyperrod::Result<Rod<Beam>> {
    let section = Section::new(Circle::new(0.025), LinearElastic::new(1e7, 1e7 / 3.0)?)?;
    let body = Body::new(1.0, section)?.with_density(1000.0)?;
    Ok(Rod::clamped(body, Pose::identity()).with_load(Gravity::new(vector![-9.81, 0.0, 0.0])?))
}

fn follow(scene: &Scene<'_, Beam>, dynamics: &Dynamics) -> Result<Tips, Box<Failure>> {
    let mut stepper = dynamics.start(scene, &Start::at_rest())?;
    let mut tips = [Vector3::zeros(); 2];
    for (time, tip) in TIMES.into_iter().zip(&mut tips) {
        stepper.run_to(time)?;
        *tip = stepper.frame()?.tip().pose.position;
    }
    Ok(tips)
}

fn distance(a: &Tips, b: &Tips) -> f64 {
    a.iter().zip(b).fold(0.0, |worst, (a, b)| (a - b).norm().max(worst))
}

pub fn measure(run: &Run) -> Outcome {
    let rod = rod()?;
    let scene = Scene::new(&rod);
    let dynamics = |order, elements, scheme, steps: u32, tolerance| Dynamics {
        order,
        elements,
        scheme,
        step: Step::Fixed(1.0 / f64::from(steps)),
        tolerance,
        ..Dynamics::default()
    };
    let finest = dynamics(Order::Six, run.of(6, 16), Scheme::Esdirk43, run.of(320, 2560), 1e-11);
    let exact = follow(&scene, &finest)?;
    let others = OTHERS.map(|[along, up]| Vector3::new(up, 0.0, along));
    let mut reference = Table::new(&["elements", "steps", "distance_from_other_codes"]);
    reference.push(&[], &[finest.elements as f64, run.of(320.0, 2560.0), distance(&exact, &others)]);
    reference.save(&run.output.path(REFERENCE))?;

    let alpha = Scheme::GeneralisedAlpha { rho: 0.9 };
    let mut table = Table::new(&["scheme", "mesh", "steps", "error", "ms", "ticks"]);
    let meshes: &[(Order, usize)] = run.of(
        &[(Order::Four, 4), (Order::Six, 4)],
        &[
            (Order::Two, 16),
            (Order::Four, 4),
            (Order::Four, 8),
            (Order::Six, 2),
            (Order::Six, 4),
            (Order::Six, 8),
        ],
    );
    for (name, scheme, steps) in [
        ("ESDIRK4(3)", Scheme::Esdirk43, run.of(&[30, 60][..], &[20, 30, 40, 60, 80, 160, 320, 640])),
        ("generalised-α", alpha, run.of(&[80, 160][..], &[60, 80, 120, 160, 320, 640, 1280])),
    ] {
        for &(order, elements) in meshes {
            let tick = timing::tick();
            for &steps in steps {
                let dynamics = dynamics(order, elements, scheme, steps, 1e-8);
                let Ok(tips) = follow(&scene, &dynamics) else { continue };
                let us = timing::quartile(run, || drop(follow(&scene, &dynamics)));
                let mesh = format!("order {}, {elements} elements", 2 * (order as usize + 1));
                let error = distance(&tips, &exact);
                table.push(&[name, &mesh], &[f64::from(steps), error, us * 1e-3, us / tick]);
            }
        }
    }
    table.save(&run.output.path(FILE))
}

pub fn page(run: &Run, page: &mut Page) -> Outcome {
    let table = Table::load(&run.output.path(FILE))?;
    let reference = Table::load(&run.output.path(REFERENCE))?;
    let reference = reference.rows().next().ok_or("no reference")?;
    let finest =
        format!("{} elements of order 6, {} steps", reference.number("elements"), reference.number("steps"));
    draw(run, &table, &finest)?;
    page.heading("Dynamics");
    let far =
        page.key("dynamics.reference.distance", &scientific(reference.number("distance_from_other_codes")));
    page.paragraph(&format!(
        "L = 1 m, r = 25 mm, 10 MPa, 1000 kg/m³, released horizontally under gravity, undamped, for a second. The error is the largest distance of the tip, over \
         L, at 0.5 s and 1 s, from {finest} of ESDIRK4(3); that run is {far} from what two other codes agree on to 3e-6. Gravity comes suddenly and excites all modes, so that in this range neither scheme falls with its own order but with about the second; \
         with a smooth start both have theirs (`cargo run --release --example release`).",
    ));
    page.figure(FIGURE, "Error of the tip against the time for a simulated second");
    page.paragraph("The least time of any of these steps and meshes that is within an error, as all smaller steps are, ms for a simulated second (thousands of ticks):");
    let mut rows = Vec::new();
    for scheme in ["ESDIRK4(3)", "generalised-α"] {
        let short = if scheme.starts_with('E') { "esdirk" } else { "alpha" };
        let mut cells = vec![scheme.to_string()];
        for (name, target) in TARGETS {
            // an error that passes through zero on its way to that of a coarse mesh is luck
            let stays = |row: &Row<'_>| {
                let finer = table.rows().filter(|r| r.is("scheme", scheme) && r.is("mesh", row.text("mesh")));
                finer
                    .filter(|r| r.number("steps") >= row.number("steps"))
                    .all(|r| r.number("error") <= target)
            };
            let good = table.rows().filter(|row| row.is("scheme", scheme) && stays(row));
            let least = good.min_by(|a, b| a.number("ms").total_cmp(&b.number("ms")));
            let number = |column: &str| least.map_or(f64::NAN, |row| row.number(column));
            let ms = page.key(&format!("dynamics.{short}.to_{name}.ms"), &digits(number("ms")));
            let ticks =
                page.key(&format!("dynamics.{short}.to_{name}.kiloticks"), &digits(number("ticks") * 1e-3));
            let how = least.map_or(String::new(), |row| {
                format!(", {}, {} steps", row.text("mesh"), row.number("steps"))
            });
            cells.push(format!("{ms} ({ticks}){how}"));
        }
        rows.push(cells);
    }
    page.table(&["scheme", "1e-2", "1e-3", "1e-4", "1e-5"], &rows);
    Ok(())
}

fn draw(run: &Run, table: &Table, reference: &str) -> Outcome {
    let mut charts = Vec::new();
    for scheme in ["ESDIRK4(3)", "generalised-α"] {
        let title = format!("{scheme}, steps refined on each mesh; against {reference}");
        let mut chart =
            Chart::new(&title, "time for a simulated second, ms", "tip error / L").log(true, true);
        let mut meshes: Vec<String> = Vec::new();
        for row in table.rows().filter(|row| row.is("scheme", scheme)) {
            if meshes.iter().all(|mesh| !row.is("mesh", mesh)) {
                meshes.push(row.text("mesh").to_string());
            }
        }
        for mesh in &meshes {
            let rows = table.rows().filter(|row| row.is("scheme", scheme) && row.is("mesh", mesh));
            chart = chart.dots(
                &mesh.replace(" elements", " el."),
                rows.map(|row| [row.number("ms"), row.number("error")]),
            );
        }
        charts.push(chart.slope(Slope { order: -2.0, at: [150.0, 3e-3], ratio: 2.0 }));
    }
    stack(&run.output.path("figures").join(FIGURE), &charts)
}
