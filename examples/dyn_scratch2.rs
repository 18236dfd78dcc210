//! x
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::*;
use hyperrod::{Body, Pose, Rod, Strain, Twist};
fn main() {
    let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 5e5 / 3.0).unwrap()).unwrap();
    let body = Body::new(0.4, section).unwrap().with_density(1000.0).unwrap();
    let rod = Rod::clamped(body, Pose::identity());
    let scene = Scene::new(&rod).with_free_base();
    for (bend, conserve) in [(2.0, false)] {
        for scheme in [Scheme::GeneralisedAlpha { rho: 1.0 }, Scheme::GeneralisedAlpha { rho: 0.9 }] {
            for (order, n) in [(Order::Two, 6), (Order::Four, 3)] {
                for dt in [4e-3, 1e-3] {
                    let dynamics = Dynamics {
                        elements: n,
                        order,
                        scheme,
                        conserve,
                        step: Step::Fixed(dt),
                        ..Default::default()
                    };
                    let start = Start::at_rest()
                        .with_base_velocity(Twist::from_array([3.0, 0.0, 5.0, 0.1, 0.0, 0.0]))
                        .with_strain(move |s| {
                            Strain::from_array([
                                0.0,
                                bend * (s / 0.4 * std::f64::consts::PI).sin().powi(2),
                                0.0,
                                0.0,
                                0.0,
                                0.0,
                            ])
                        });
                    let mut st = dynamics.start(&scene, &start).unwrap();
                    let b = st.frame().unwrap();
                    let mut out = format!("{bend} {scheme:?} {order:?} {dt}: ");
                    for i in 0..2000 {
                        match st.step() {
                            Ok(_) => {}
                            Err(e) => {
                                out += &format!("[{i} {e}]");
                                break;
                            }
                        }
                        if i % 499 == 0 {
                            let f = st.frame().unwrap();
                            out += &format!(
                                " E {:.1e} P {:.1e} L {:.1e}",
                                f.energies.total().unwrap() / b.energies.total().unwrap() - 1.0,
                                (f.linear_momentum - b.linear_momentum).norm(),
                                (f.angular_momentum - b.angular_momentum).norm()
                            );
                        }
                    }
                    println!("{out}");
                }
            }
        }
    }
}
