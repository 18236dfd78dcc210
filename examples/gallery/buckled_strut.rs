//! A column under a growing dead load: straight up to Euler's load, then on the path that leaves there.

use crate::figure::{BLUE, Chart, Drawing, GREEN, ORANGE, Outcome};
use crate::tube::axis;
use hyperrod::load::DeadWrench;
use hyperrod::section::{CrossSection, Stiffness};
use hyperrod::solve::{Order, PathOptions};
use hyperrod::{Body, Pose, Rod, Statics};
use nalgebra::vector;
use std::f64::consts::PI;
use std::path::Path;

/// Load over Euler's load, and sideways displacement of the tip over L, of the inextensible elastica whose tip has turned by 2 asin k.
fn elastica(k: f64) -> [f64; 2] {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..20 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt()); // arithmetic-geometric mean
    }
    let quarter_period = PI / (2.0 * a);
    [2.0 * k / quarter_period, (2.0 * quarter_period / PI).powi(2)]
}

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    // EI = 1 about y, four times that about x; next to no shear and extension
    let section = Stiffness::diagonal([4.0, 1.0, 2.0, 1e6, 1e6, 1e6])?;
    let body = Body::new(1.0, Box::new(section) as Box<dyn CrossSection>)?;
    let euler = PI * PI / 4.0;
    let push = DeadWrench::force(vector![0.0, 0.0, -euler])?; // so the load factor is P over Euler's load
    let column = Rod::clamped(body, Pose::identity()).with_tip_load(push);
    let statics = Statics { elements: if quick { 6 } else { 12 }, order: Order::Six, ..Statics::default() };
    let options = PathOptions { factors: [0.0, 3.0], longest_step: 0.2, ..PathOptions::default() };
    let path = statics.trace_buckled(&column, &options)?.ok_or("the column does not buckle")?;

    let side = path.points.last().map_or(1.0, |p| p.solution.tip().pose.position.x.signum());
    let branch =
        |side: f64| path.points.iter().map(move |p| [side * p.solution.tip().pose.position.x, p.load_factor]);
    let exact = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95].map(elastica);
    Chart::new(
        "Column, clamped below: its equilibria; straight, it is unstable above 1",
        "sideways displacement of the tip, L",
        "load, Euler's load",
    )
    .line("straight", [[0.0, 0.0], [0.0, 3.0]])
    .line("buckled", branch(side))
    .line("to the other side", branch(-side))
    .marks("elastica, exact", exact)
    .save(&picture.with_file_name("buckled_strut_path.svg"))?;

    let title = "Column beyond Euler's load, P/P_E";
    let mut drawing = Drawing::new(title, "X, L", "Z, L").line(vec![[0.0, 0.0], [0.0, 1.0]], BLUE);
    drawing = drawing.legend("up to 1", BLUE);
    for (wanted, color) in [(1.05, ORANGE), (1.5, GREEN), (3.0, crate::figure::PURPLE)] {
        let nearest = |a: &f64, b: &f64| (a - wanted).abs().total_cmp(&(b - wanted).abs());
        let Some(state) = path.points.iter().min_by(|a, b| nearest(&a.load_factor, &b.load_factor)) else {
            continue;
        };
        let line = axis(&state.solution).iter().map(|p| [side * p.x, p.z]).collect();
        drawing = drawing.line(line, color).legend(&format!("{:.2}", state.load_factor), color);
    }
    drawing.wall([0.12, 0.0], [-0.12, 0.0]).save(picture)
}
