//! Every static reference case solved to an accuracy: what was asked, what was estimated, what is true.
//!
//! `cargo run --release --example statics_table`
//!
//! Rods of the sets B and C of `tests/data` (clamped and free, dead loads), each from its reference shape with nothing but the accuracy given.
//! Errors are the largest of positions / L, rotations and wrenches / largest wrench over the stations of the reference (of set C1 to C3, over
//! what those give). `-- --quick` asks for 1e-6 alone.
#![allow(clippy::print_stdout)]

#[path = "../tests/reference/mod.rs"]
mod reference;

use hyperrod::body::LineDensity;
use hyperrod::load::DeadWrench;
use hyperrod::material::{MooneyRivlin, NeoHookean, ReferencePressure};
use hyperrod::section::{Circle, CrossSection, Linear, Rectangle, Section, Stiffness};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics};
use nalgebra::{Vector3, vector};
use reference::{data, number, static_cases};
use serde_json::Value;

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// What is known of the answer.
type Error = Box<dyn Fn(&StaticSolution) -> f64>;

struct Case {
    name: String,
    rod: Rod<Body<Box<dyn CrossSection>, LineDensity>>,
    error: Error,
}

fn main() -> Outcome {
    let quick = std::env::args().any(|a| a == "--quick");
    let asked: &[f64] = if quick { &[1e-6] } else { &[1e-6, 1e-9, 1e-11] };
    println!("{:<30}{:>8}{:>11}{:>11}{:>6}{:>7}{:>9}", "case", "asked", "estimated", "true", "it", "N", "µs");
    let (mut good, mut count, mut worst) = (0, 0, 0.0_f64);
    for case in cases()? {
        for &accuracy in asked {
            count += 1;
            // set C1 stays straight, stable or not: with N > c GA (v_1.0 near its tip, v_4.0) a rigid neo-Hookean section would rather tilt
            let statics = Statics { accept_unstable: case.name.starts_with("C1"), ..Statics::to(accuracy) };
            let solution = match statics.solve(&case.rod) {
                Ok(solution) => solution,
                Err(failure) => {
                    println!("{:<30}{accuracy:>8.0e}  {failure}", case.name);
                    worst = f64::INFINITY;
                    continue;
                }
            };
            let report = solution.report();
            let error = (case.error)(&solution);
            let estimated = report.error.relative(case.rod.body().length());
            println!(
                "{:<30}{accuracy:>8.0e}{estimated:>11.1e}{error:>11.1e}{:>6}{:>7}{:>9.0}",
                case.name,
                report.iterations.len(),
                solution.nodes().len() - 1,
                report.elapsed.as_secs_f64() * 1e6
            );
            good += usize::from(error <= accuracy);
            worst = worst.max(error / accuracy);
        }
    }
    println!("statics_table: {good} of {count} within the asked error, worst true/asked {worst:.2}");
    Ok(())
}

fn cases() -> Outcome<Vec<Case>> {
    let mut cases = inextensible()?;
    for file in [
        "B1_elastica_finite.json",
        "B2_end_moment.json",
        "B3_bend45.json",
        "B4_helix_load.json",
        "B5_princeton.json",
        "B9_heavy_elastica.json",
        "C4_nh_cantilever.json",
    ] {
        for case in static_cases(file) {
            let (name, rod) = (case.id.clone(), case.rod());
            cases.push(Case { name, rod, error: Box::new(move |solution| case.errors(solution).worst()) });
        }
    }
    cases.extend(tapered_tension()?);
    cases.extend(pure_bending()?);
    cases.extend(torsion()?);
    Ok(cases)
}

fn clamped(
    length: f64,
    section: impl CrossSection + 'static,
    tip: DeadWrench,
) -> Outcome<Rod<Body<Box<dyn CrossSection>, LineDensity>>> {
    let section: Box<dyn CrossSection> = Box::new(section);
    let body = Body::new(length, section)?.with_mass_per_length(1.0)?;
    Ok(Rod::clamped(body, Pose::identity()).with_tip_load(tip))
}

fn list(file: &str) -> Vec<Value> {
    data(file)["cases"].as_array().cloned().unwrap_or_default()
}

/// B1 without extension and shear, by elliptic integrals: here EA = GA = 1e16 EI / L², which is 1e-15 away.
fn inextensible() -> Outcome<Vec<Case>> {
    let mut cases = Vec::new();
    for case in list("B1_elastica_inextensible.json") {
        let load = number(&case, "PL2_over_EI");
        let section = Stiffness::diagonal([1.0, 1.0, 1.0, 1e16, 1e16, 1e16])?;
        let rod = clamped(1.0, section, DeadWrench::force(vector![load, 0.0, 0.0])?)?;
        let tip = vector![number(&case, "transverse_x_over_L"), 0.0, number(&case, "axial_z_over_L")];
        let slope = number(&case, "tip_slope_rad");
        cases.push(Case {
            name: format!("B1/inextensible_{load}"),
            rod,
            error: Box::new(move |solution| {
                let pose = solution.tip().pose;
                let turned = pose.log().angular.y;
                (pose.position - tip).norm().max((turned - slope).abs())
            }),
        });
    }
    Ok(cases)
}

fn tapered_tension() -> Outcome<Vec<Case>> {
    let mut cases = Vec::new();
    for case in list("C1_tapered_tension.json") {
        let (radius, length) = (number(&case, "R0"), number(&case, "L"));
        let law = NeoHookean::new(number(&case, "mu"), number(&case, "lam"))?;
        let profile = Linear { from: radius, to: 0.5 * radius, length };
        let force = DeadWrench::force(vector![0.0, 0.0, number(&case, "F")])?;
        let rod = clamped(length, Section::new(Circle::new(profile), law)?, force)?;
        let z = number(&case, "tip_z");
        let error = move |solution: &StaticSolution| (solution.tip().pose.position.z - z).abs() / length;
        cases.push(Case { name: name(&case), rod, error: Box::new(error) });
    }
    Ok(cases)
}

/// A dead moment bends to an arc: the reference gives its curvature and stretch.
fn pure_bending() -> Outcome<Vec<Case>> {
    let mut cases = Vec::new();
    for case in list("C2_pure_bending.json") {
        for row in case["rows"].as_array().into_iter().flatten() {
            let Some(section) = filled(&case)? else { continue };
            let (curvature, stretch) = (number(row, "omega_y"), 1.0 + number(row, "nu_z"));
            // a third of a turn
            let length = 2.0 / curvature;
            let moment = DeadWrench::moment(Vector3::y() * number(row, "m_y"))?;
            let tip = vector![1.0 - 2.0_f64.cos(), 0.0, 2.0_f64.sin()] * (stretch / curvature);
            let error = move |solution: &StaticSolution| {
                let pose = solution.tip().pose;
                ((pose.position - tip).norm() / length).max((pose.log().angular.y - 2.0).abs())
            };
            let name = format!("{}_{curvature}", name(&case));
            cases.push(Case { name, rod: clamped(length, section, moment)?, error: Box::new(error) });
        }
    }
    Ok(cases)
}

/// A dead torque twists and lengthens.
fn torsion() -> Outcome<Vec<Case>> {
    let mut cases = Vec::new();
    for case in list("C3_torsion_poynting.json") {
        for row in case["rows"].as_array().into_iter().flatten() {
            let (Some(section), Some(torque)) = (filled(&case)?, row["torque"].as_f64()) else { continue };
            let (twist, stretch) = (number(row, "omega_z"), number(row, "axial_stretch_c"));
            let length = 2.0 / twist;
            let error = move |solution: &StaticSolution| {
                let pose = solution.tip().pose;
                let z = Vector3::z() * (stretch * length);
                ((pose.position - z).norm() / length).max((pose.log().angular.z - 2.0).abs())
            };
            let name = format!("{}_{twist}", name(&case));
            let rod = clamped(length, section, DeadWrench::moment(Vector3::z() * torque)?)?;
            cases.push(Case { name, rod, error: Box::new(error) });
        }
    }
    Ok(cases)
}

fn name(case: &Value) -> String {
    case["id"].as_str().unwrap_or_default().to_string()
}

/// The solid sections of sets C2 and C3 whose laws are in the library.
fn filled(case: &Value) -> Outcome<Option<Box<dyn CrossSection>>> {
    const DEGREE: usize = 80;
    let (constants, shape) = (&case["material"], &case["section"]);
    let outer = shape.get("R").or(shape.get("Ro")).and_then(Value::as_f64);
    let solid = shape["Ri"].as_f64().is_none_or(|inner| inner == 0.0);
    Ok(match (case["energy"].as_str(), shape["kind"].as_str(), outer) {
        (Some("neo_hookean"), Some("circle"), Some(radius)) if solid => {
            let law = NeoHookean::new(number(constants, "mu"), number(constants, "lam"))?;
            Some(Box::new(Section::new(Circle::new(radius), law)?.with_degree(DEGREE)?))
        }
        (Some("neo_hookean"), Some("rectangle"), _) => {
            let law = NeoHookean::new(number(constants, "mu"), number(constants, "lam"))?;
            let shape = Rectangle::new(number(shape, "b"), number(shape, "h"));
            Some(Box::new(Section::new(shape, law)?.with_degree(DEGREE)?))
        }
        (Some("mr_pressure"), Some("circle"), Some(radius)) if solid => {
            let law = ReferencePressure(MooneyRivlin::new(number(constants, "C1"), number(constants, "C2"))?);
            Some(Box::new(Section::new(Circle::new(radius), law)?))
        }
        _ => None,
    })
}
