//! x
use hyperrod::load::Gravity;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::*;
use hyperrod::{Body, Pose, Rod};
use nalgebra::vector;
fn main() {
    let section = Section::new(Circle::new(0.025), LinearElastic::new(1e7, 1e7 / 3.0).unwrap()).unwrap();
    let body = Body::new(1.0, section).unwrap().with_density(1000.0).unwrap();
    let rod = Rod::clamped(body, Pose::identity()).with_load(Gravity::new(vector![-9.81, 0.0, 0.0]).unwrap());
    let scene = Scene::new(&rod);
    let refs = [(0.5, 0.377994, -0.830157), (1.0, 0.977002, -0.204892)];
    for scheme in
        [Scheme::Esdirk43, Scheme::GeneralisedAlpha { rho: 0.9 }, Scheme::GeneralisedAlpha { rho: 0.6 }]
    {
        for (order, n) in [
            (Order::Six, 2),
            (Order::Six, 3),
            (Order::Six, 4),
            (Order::Four, 3),
            (Order::Four, 4),
            (Order::Four, 6),
            (Order::Two, 8),
            (Order::Two, 12),
        ] {
            for steps in [15, 20, 25, 30, 40, 60, 80, 120, 160] {
                if matches!(scheme, Scheme::Esdirk43) && steps > 40 {
                    continue;
                }
                if !matches!(scheme, Scheme::Esdirk43) && steps < 40 {
                    continue;
                }
                let dynamics = Dynamics {
                    elements: n,
                    order,
                    scheme,
                    tolerance: 1e-6,
                    step: Step::Fixed(0.5 / steps as f64),
                    ..Default::default()
                };
                let mut best = f64::INFINITY;
                let mut out = String::new();
                let mut worst: f64 = 0.0;
                for _ in 0..7 {
                    let t0 = std::time::Instant::now();
                    let mut st = dynamics.start(&scene, &Start::at_rest()).unwrap();
                    let (mut its, mut fac) = (0, 0);
                    worst = 0.0;
                    for (t, x, z) in refs {
                        while !st.is_at(t) {
                            match st.step_toward(t) {
                                Ok(r) => {
                                    its += r.iterations;
                                    fac += r.factorisations
                                }
                                Err(e) => {
                                    println!("{e}");
                                    break;
                                }
                            }
                        }
                        let p = st.frame().unwrap().tip().pose.position;
                        // released along +z there x of peers is the horizontal
                        worst = worst.max((p.z - x).hypot(p.x - z));
                    }
                    best = best.min(t0.elapsed().as_secs_f64() * 1e3);
                    out = format!("{worst:.2e} its {its} fac {fac} {best:.2} ms");
                }
                if worst < 3e-3 {
                    println!("{scheme:?} {order:?} {n} {steps}: {out}");
                }
            }
        }
    }
}
