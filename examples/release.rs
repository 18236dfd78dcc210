//! A soft cylinder is let go under gravity: errors against references, orders in time and space, pictures.
//!
//! `cargo run --release --example release` (`-- --quick` halves steps and meshes less often). L = 0.4 m, 2 cm thick, 500 kPa, clamped horizontally.
//! Gravity comes suddenly, or smoothly within 0.1 s. Pictures go to `target/hyperrod/release/`.
//!
//! Positions are compared with reference solutions of spectral elements and of Richardson-extrapolated differences (agreeing to 1e-8 m for the
//! sudden case, 4e-11 m for the smooth one). They give no velocities and wrenches: in the table over time steps the reference is a
//! run of ESDIRK with still smaller steps, whose position is checked against them.
#![allow(clippy::print_stdout)]

mod figure;

use figure::{Animation, BLUE, Chart, Drawing, Outcome, Output, silhouette};
use hyperrod::body::Density;
use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::{Adaptive, Dynamics, Frame, Scene, Scheme, Start, Step};
use hyperrod::{Body, Pose, Rod};
use indicatif::{ProgressBar, ProgressStyle};
use nalgebra::{Vector3, vector};

type Beam = Body<Section<Circle<f64>, LinearElastic>, Density>;

const RADIUS: f64 = 0.01;

/// Time, tip across and along, suddenly.
const SUDDEN: [[f64; 3]; 4] = [
    [0.05, -0.012287713924480513, 0.3997120347351355],
    [0.1, -0.045135406268240495, 0.39358342091362697],
    [0.2, -0.23906268056369984, 0.319609815427763],
    [0.3, -0.36976607599848954, 0.03457566686925823],
];

/// The same, smoothly.
const SMOOTH: [[f64; 3]; 5] = [
    [0.05, -0.0006812137375863958, 0.3999999225274399],
    [0.1, -0.013687092622627722, 0.3996310032390054],
    [0.2, -0.1187247984253091, 0.37318454977035953],
    [0.3, -0.3414741854755191, 0.18683879828774153],
    [0.5, -0.24628294243286364, -0.23835705095072407],
];

/// u⁴(35 − 84u + 70u² − 20u³), u = t/0.1 up to 1.
fn ramp(t: f64) -> f64 {
    let u = (t / 0.1).min(1.0);
    u.powi(4) * (35.0 - 84.0 * u + 70.0 * u * u - 20.0 * u * u * u)
}

fn rod() -> hyperrod::Result<Rod<Beam>> {
    let section = Section::new(Circle::new(RADIUS), LinearElastic::new(5e5, 5e5 / 3.0)?)?;
    Ok(Rod::clamped(Body::new(0.4, section)?.with_density(1000.0)?, Pose::identity()))
}

/// Gravity across the rod, which lies along +Z.
fn scene(rod: &Rod<Beam>, sudden: bool) -> hyperrod::Result<Scene<'_, Beam>> {
    let gravity = Gravity::new(vector![-9.81, 0.0, 0.0])?;
    Ok(Scene::new(rod).with_load(gravity, move |t| if sudden { 1.0 } else { ramp(t) }))
}

fn main() -> Outcome {
    let quick = figure::flag("--quick");
    let (rod, output) = (rod()?, Output::of("release")?);
    println!("Tip against the reference, 8 elements of order 6, ESDIRK\n");
    println!("case    step, ms    error at 0.05 s    0.1 s    0.2 s    0.3 s");
    let mut worst = [f64::INFINITY; 2];
    for (which, rows) in [&SUDDEN[..], &SMOOTH[..4]].into_iter().enumerate() {
        for (dt, elements) in [(0.02, 8), (0.01, 8), (0.005, 8), (0.0025, 16)] {
            let dynamics = Dynamics { elements, step: Step::Fixed(dt), ..Dynamics::default() };
            let errors = tip_errors(&scene(&rod, which == 0)?, &dynamics, rows)?;
            let largest = errors.iter().copied().fold(0.0, f64::max);
            worst[which] = worst[which].min(largest);
            let name = ["sudden", "smooth"][which];
            let errors: Vec<String> = errors.iter().map(|e| format!("{e:.1e}")).collect();
            println!("{name:7} {:8.1}    {}", dt * 1e3, errors.join("            "));
        }
    }
    let in_time = orders_in_time(&rod, if quick { 3 } else { 5 })?;
    let in_space = orders_in_space(&rod, if quick { 2 } else { 3 })?;
    pictures(&rod, &output)?;
    println!("\nworst tip error, smooth start: {:.1e} m", worst[1]);
    println!(
        "release: worst tip error {:.1e} m, order in time {in_time:.2}, order in space {in_space:.2}",
        worst[0]
    );
    Ok(())
}

fn tip_errors(scene: &Scene<'_, Beam>, dynamics: &Dynamics, rows: &[[f64; 3]]) -> Outcome<Vec<f64>> {
    let mut stepper = dynamics.start(scene, &Start::at_rest())?;
    let mut errors = Vec::new();
    for [time, across, along] in rows {
        stepper.run_to(*time)?;
        let tip = stepper.frame()?.tip().pose.position;
        errors.push((tip - Vector3::new(*across, 0.0, *along)).norm());
    }
    Ok(errors)
}

/// Position and velocity of the tip, moment and force of the clamp at 0.3 s of the smooth case.
fn quantities(rod: &Rod<Beam>, dynamics: &Dynamics) -> Outcome<[Vector3<f64>; 4]> {
    let scene = scene(rod, false)?;
    let mut stepper = dynamics.start(&scene, &Start::at_rest())?;
    stepper.run_to(0.3)?;
    let frame = stepper.frame()?;
    let (tip, base) = (frame.tip(), frame.base());
    let velocity = tip.pose.rotation * tip.velocity.linear;
    Ok([tip.pose.position, velocity, base.wrench.moment, base.wrench.force])
}

fn orders_in_time(rod: &Rod<Beam>, halvings: u32) -> Outcome<f64> {
    let dynamics = |scheme, steps: u32, elements| Dynamics {
        scheme,
        elements,
        step: Step::Fixed(0.3 / f64::from(steps)),
        ..Dynamics::default()
    };
    let finest = Dynamics { tolerance: 1e-13, ..dynamics(Scheme::Esdirk43, 30 << halvings, 32) };
    let mut exact = quantities(rod, &finest)?;
    let known = Vector3::new(SMOOTH[3][1], 0.0, SMOOTH[3][2]);
    println!(
        "\nOrder in time, smooth case at 0.3 s; the reference is off by {:.1e} m\n",
        (exact[0] - known).norm()
    );
    exact[0] = known;
    println!("scheme              steps   position    velocity      moment       force");
    let mut order = 0.0;
    for (name, scheme) in [
        ("ESDIRK4(3)", Scheme::Esdirk43),
        ("gen. α, ρ∞ = 0.9", Scheme::GeneralisedAlpha { rho: 0.9 }),
        ("gen. α, ρ∞ = 0.5", Scheme::GeneralisedAlpha { rho: 0.5 }),
    ] {
        let mut before: Option<[f64; 4]> = None;
        for halving in 0..halvings {
            let steps = 30 << halving;
            let found = quantities(rod, &dynamics(scheme, steps, 32))?;
            let errors: [f64; 4] = std::array::from_fn(|q| (found[q] - exact[q]).norm());
            let mut row = format!("{name:18} {steps:6}");
            for q in 0..4 {
                let observed = before.map(|before| (before[q] / errors[q]).log2());
                row += &match observed {
                    Some(p) => format!("  {:.1e} ({p:.1})", errors[q]),
                    None => format!("  {:.1e}      ", errors[q]),
                };
            }
            println!("{row}");
            if scheme == Scheme::Esdirk43 && halving <= 2 {
                order = before.map_or(0.0, |before| (before[0] / errors[0]).log2());
            }
            before = Some(errors);
        }
    }
    Ok(order)
}

fn orders_in_space(rod: &Rod<Beam>, meshes: u32) -> Outcome<f64> {
    println!(
        "\nOrder in space, smooth case up to 0.3 s, ESDIRK with 240 steps\n\nelement  elements   tip error   order"
    );
    let mut order_six = 0.0;
    for (name, order, first) in [("order 4", Order::Four, 8), ("order 6", Order::Six, 8)] {
        let mut before: Option<f64> = None;
        for refinement in 0..meshes {
            let elements = first << refinement;
            let step = Step::Fixed(0.3 / 480.0);
            let dynamics = Dynamics { order, elements, step, ..Dynamics::default() };
            let error =
                tip_errors(&scene(rod, false)?, &dynamics, &SMOOTH[..4])?.into_iter().fold(0.0, f64::max);
            let observed = before.map(|before| (before / error).log2());
            let order_text = observed.map_or(String::new(), |p| format!("{p:.2}"));
            println!("{name:8} {elements:8}     {error:.1e}   {order_text}");
            if let (Order::Six, Some(observed)) = (order, observed) {
                order_six = observed;
            }
            before = Some(error);
        }
    }
    Ok(order_six)
}

fn outline(frame: &Frame) -> Vec<[f64; 2]> {
    let stations: Vec<(Pose, f64)> = frame.nodes.iter().map(|n| (n.pose, RADIUS)).collect();
    silhouette(&stations, Vector3::x(), [Vector3::z(), Vector3::x()], 1e-3)
}

/// Shapes every 40 ms, energies against time, and the motion itself, five times slower.
fn pictures(rod: &Rod<Beam>, output: &Output) -> Outcome {
    const END: f64 = 1.2;
    let scene = scene(rod, true)?;
    let adaptive = Adaptive { tolerance: 1e-5, largest: 0.01, ..Adaptive::default() };
    let dynamics = Dynamics { elements: 10, step: Step::Adaptive(adaptive), ..Dynamics::default() };
    let bar = ProgressBar::new(120)
        .with_style(ProgressStyle::with_template("released {bar:40} {pos}/{len} {eta}")?);
    let mut stepper = dynamics.start(&scene, &Start::at_rest())?;
    let mut frames = vec![stepper.frame()?];
    for instant in 1..=120 {
        stepper.run_to(END * f64::from(instant) / 120.0)?;
        frames.push(stepper.frame()?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let mut drawing = Drawing::new("A soft cylinder let go, every 40 ms, to scale", "Z, mm", "X, mm");
    for frame in frames.iter().take(41).step_by(4).skip(1) {
        drawing = drawing.line(outline(frame), BLUE);
    }
    drawing.ghost(outline(&frames[0])).wall([0.0, -25.0], [0.0, 25.0]).save(&output.path("strobe.svg"))?;
    let along = |f: fn(&Frame) -> f64| frames.iter().map(move |frame| [frame.time, f(frame) * 1e3]);
    Chart::new("Energy", "time, s", "energy, mJ")
        .line("kinetic", along(|f| f.energies.kinetic))
        .line("elastic", along(|f| f.energies.elastic))
        .line("of the weight", along(|f| f.energies.potential.unwrap_or(f64::NAN)))
        .line("total", along(|f| f.energies.total().unwrap_or(f64::NAN)))
        .save(&output.path("energy.svg"))?;
    let mut animation = Animation::new("released, five times slower", 5.0 * END);
    for frame in &frames {
        animation.push(frame.nodes.iter().map(|n| [n.pose.position.z, n.pose.position.x]).collect());
    }
    animation.save(&output.path("release.svg"))?;
    let rows = frames.iter().map(|f| {
        let tip = f.tip().pose.position;
        [f.time, tip.x, tip.z, f.energies.kinetic, f.energies.elastic]
    });
    output.csv("release.csv", ["t_s", "tip_x_m", "tip_z_m", "kinetic_J", "elastic_J"], rows)
}
