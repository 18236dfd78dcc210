//! The rods and references of set D in `tests/data`.

use hyperrod::body::Density;
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::LinearElastic;
use hyperrod::section::{Rectangle, Section, Shape};
use hyperrod::solve::dynamics::{Dynamics, Scene, Start, Step};
use hyperrod::{Body, Pose, Rod};
use nalgebra::{Vector3, vector};
use serde_json::Value;

/// One type of section for the whole binary: each costs seconds of compilation.
pub type Beam = Body<Section<Box<dyn Shape>, LinearElastic>, Density>;

pub fn cases(name: &str) -> Vec<Value> {
    let path = format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let data: Value = serde_json::from_str(&text).unwrap();
    data["cases"].as_array().unwrap().clone()
}

pub fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}

pub fn circle(radius: f64) -> Box<dyn Shape> {
    Box::new(hyperrod::section::Circle::new(radius))
}

pub fn beam(length: f64, shape: Box<dyn Shape>, [e, g, density]: [f64; 3]) -> Beam {
    let section = Section::new(shape, LinearElastic::new(e, g).unwrap()).unwrap();
    Body::new(length, section).unwrap().with_density(density).unwrap()
}

/// The soft cylinder of sets D1 and D2: 40 cm long, 2 cm thick, 500 kPa.
pub fn cylinder() -> Beam {
    beam(0.4, circle(0.01), [5e5, 5e5 / 3.0, 1000.0])
}

pub fn clamped(body: Beam) -> Rod<Beam> {
    Rod::clamped(body, Pose::identity())
}

/// Gravity across a rod that lies along +Z.
pub fn sideways() -> Gravity {
    Gravity::new(vector![-9.81, 0.0, 0.0]).unwrap()
}

/// The smooth ramp of the references: u⁴(35 − 84u + 70u² − 20u³), u = t/0.1 up to 1.
pub fn ramp(t: f64) -> f64 {
    let u = (t / 0.1).clamp(0.0, 1.0);
    u.powi(4) * (35.0 - 84.0 * u + 70.0 * u * u - 20.0 * u * u * u)
}

/// Distances of the tip from the reference at the rows up to a time.
pub fn release_errors(dynamics: &Dynamics, ramped: bool, until: f64) -> Vec<f64> {
    let id = if ramped { "D2/release_ramped" } else { "D2/release_undamped" };
    let case = cases("D2_release.json").into_iter().find(|case| case["id"] == id).unwrap();
    let rod = clamped(cylinder());
    let scene = Scene::new(&rod).with_load(sideways(), move |t| if ramped { ramp(t) } else { 1.0 });
    let mut stepper = dynamics.start(&scene, &Start::at_rest()).unwrap();
    let mut errors = Vec::new();
    for row in case["rows"].as_array().unwrap().iter().filter(|row| number(row, "t") <= until) {
        stepper.run_to(number(row, "t")).unwrap();
        let tip = stepper.frame().unwrap().tip().pose.position;
        errors.push((tip.x - number(row, "tip_x")).hypot(tip.z - number(row, "tip_z")));
    }
    errors
}

pub fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Case D4: a rectangular cantilever under gravity, a force and a moment, all ramped.
pub fn three_dimensional_errors(dynamics: &Dynamics) -> Vec<f64> {
    let case = &cases("D4_dynamics_3d.json")[0];
    let shape = Rectangle::new(number(&case["section"], "b"), number(&case["section"], "h"));
    let numbers = ["E", "G", "rho"].map(|key| number(case, key));
    let rod = clamped(beam(number(case, "L"), Box::new(shape), numbers));
    let vector = |key: &str| Vector3::from_fn(|i, _| case[key][i].as_f64().unwrap());
    let wrench = DeadWrench::new(vector("tip_moment_dead"), vector("tip_force_dead")).unwrap();
    let scene =
        Scene::new(&rod).with_load(Gravity::new(vector("g")).unwrap(), ramp).with_tip_load(wrench, ramp);
    let mut stepper = dynamics.start(&scene, &Start::at_rest()).unwrap();
    let rows = case["rows"].as_array().unwrap();
    rows.iter()
        .map(|row| {
            stepper.run_to(number(row, "t")).unwrap();
            let tip = stepper.frame().unwrap().tip().pose.position;
            (tip - Vector3::from_fn(|i, _| row["tip_p"][i].as_f64().unwrap())).norm()
        })
        .collect()
}

pub fn fixed(dt: f64) -> Dynamics {
    Dynamics { step: Step::Fixed(dt), ..Dynamics::default() }
}
