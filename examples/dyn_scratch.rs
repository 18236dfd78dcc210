use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::*;
use hyperrod::{Body, Pose, Rod};
use nalgebra::vector;
fn ramp(t: f64) -> f64 { let u = (t / 0.1).min(1.0); u.powi(4) * (35.0 - 84.0 * u + 70.0 * u * u - 20.0 * u * u * u) }
fn main() {
    let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 5e5 / 3.0).unwrap()).unwrap();
    let body = Body::new(0.4, section).unwrap().with_density(1000.0).unwrap();
    let rod = Rod::clamped(body, Pose::identity());
    let g = Gravity::new(vector![-9.81, 0.0, 0.0]).unwrap();
    let text = std::fs::read_to_string("tests/data/D2_release.json").unwrap();
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    for case in data["cases"].as_array().unwrap() {
        println!("{} rows {} tau {}", case["id"], case["rows"].as_array().unwrap().len(), case["kelvin_voigt_tau"]);
    }
    for (id, sudden) in [("D2/release_undamped", true), ("D2/release_ramped", false)] {
        let case = data["cases"].as_array().unwrap().iter().find(|c| c["id"] == id);
        let Some(case) = case else { println!("no {id}"); continue };
        for scheme in [Scheme::Esdirk43, Scheme::GeneralisedAlpha { rho: 0.9 }] {
            for steps in [15, 30, 60, 120, 240] {
                let scene = Scene::new(&rod).with_load(g, move |t| if sudden { 1.0 } else { ramp(t) });
                let dynamics = Dynamics { elements: 8, order: Order::Six, scheme, step: Step::Fixed(0.3 / steps as f64), ..Default::default() };
                let t0 = std::time::Instant::now();
                let mut st = match dynamics.start(&scene, &Start::at_rest()) { Ok(s) => s, Err(e) => { println!("start {e}"); continue } };
                let mut worst: f64 = 0.0; let mut its = 0; let mut fac = 0;
                for row in case["rows"].as_array().unwrap() {
                    let t = row["t"].as_f64().unwrap();
                    while !st.is_at(t) { match st.step_toward(t) { Ok(r) => { its += r.iterations; fac += r.factorisations } Err(e) => { println!("{e}"); break } } }
                    let f = st.frame().unwrap();
                    let p = f.tip().pose.position;
                    worst = worst.max((p.x - row["tip_x"].as_f64().unwrap()).hypot(p.z - row["tip_z"].as_f64().unwrap()));
                }
                println!("{id} {scheme:?} {steps}: {worst:.3e} its {its} fac {fac} {:?} {:?}", t0.elapsed(), st.frame().unwrap().energies);
            }
        }
    }
}
