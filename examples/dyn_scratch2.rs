//! x
use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::*;
use hyperrod::{Body, Pose, Rod};
use nalgebra::vector;
fn ramp(t: f64) -> f64 {
    let u = (t / 0.1).min(1.0);
    u.powi(4) * (35.0 - 84.0 * u + 70.0 * u * u - 20.0 * u * u * u)
}
fn main() {
    let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 5e5 / 3.0).unwrap()).unwrap();
    let body = Body::new(0.4, section).unwrap().with_density(1000.0).unwrap();
    let rod = Rod::clamped(body, Pose::identity());
    let g = Gravity::new(vector![-9.81, 0.0, 0.0]).unwrap();
    let text = std::fs::read_to_string("tests/data/D2_release.json").unwrap();
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    let case = data["cases"].as_array().unwrap().iter().find(|c| c["id"] == "D2/release_ramped").unwrap();
    for (order, ns) in [
        (Order::Six, vec![2, 4, 8, 16, 32]),
        (Order::Four, vec![4, 8, 16, 32, 64]),
        (Order::Two, vec![16, 32, 64, 128]),
    ] {
        for n in ns {
            let scene = Scene::new(&rod).with_load(g, ramp);
            let dynamics =
                Dynamics { elements: n, order, step: Step::Fixed(0.1 / 40.), ..Default::default() };
            let mut st = dynamics.start(&scene, &Start::at_rest()).unwrap();
            let mut e = vec![];
            for row in case["rows"].as_array().unwrap() {
                let t = row["t"].as_f64().unwrap();
                if t > 0.31 {
                    break;
                }
                if let Err(e) = st.run_to(t) {
                    println!("{e}");
                    break;
                }
                let p = st.frame().unwrap().tip().pose.position;
                e.push(format!(
                    "{:.2e}",
                    (p.x - row["tip_x"].as_f64().unwrap()).hypot(p.z - row["tip_z"].as_f64().unwrap())
                ));
            }
            println!("{order:?} {n}: {}", e.join(" "));
        }
    }
}
