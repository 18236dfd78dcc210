use crate::cases::{clamped, cylinder, fixed, ramp, release_errors, sideways};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::{Dynamics, Scene, Scheme, Start};

/// Tip position, tip velocity, base moment and base force at 0.3 s in the ramped case.
fn quantities(dynamics: &Dynamics) -> [nalgebra::Vector3<f64>; 4] {
    let rod = clamped(cylinder());
    let scene = Scene::new(&rod).with_load(sideways(), ramp);
    let mut stepper = dynamics.start(&scene, &Start::at_rest()).unwrap();
    stepper.run_to(0.3).unwrap();
    let frame = stepper.frame().unwrap();
    let (tip, base) = (frame.tip(), frame.base());
    let velocity = tip.pose.rotation * tip.velocity.linear;
    [tip.pose.position, velocity, base.wrench.moment, base.wrench.force]
}

/// Position, velocity, moment and force fall alike, each scheme with its order; against a run of the other scheme's family with steps eight times
/// smaller than the last, whose own error is then below 1/4000 (order 4).
#[test]
fn poses_velocities_and_wrenches_have_the_order_of_the_scheme() {
    let dynamics = |scheme: Scheme, steps: f64| Dynamics { scheme, elements: 8, ..fixed(0.3 / steps) };
    let exact = quantities(&dynamics(Scheme::Esdirk43, 960.0));
    for (scheme, order, steps) in [
        (Scheme::Esdirk43, 4.0, [30.0, 60.0, 120.0]),
        (Scheme::GeneralisedAlpha { rho: 0.5 }, 2.0, [120.0, 240.0, 480.0]),
    ] {
        let errors = steps.map(|n| {
            let found = quantities(&dynamics(scheme, n));
            std::array::from_fn::<f64, 4, _>(|q| (found[q] - exact[q]).norm())
        });
        for q in 0..4 {
            let observed = (errors[0][q] / errors[2][q]).log2() / 2.0;
            let name = ["position", "velocity", "moment", "force"][q];
            println!(
                "{scheme:?} {name}: {:.2e} {:.2e} {:.2e}, order {observed:.2}",
                errors[0][q], errors[1][q], errors[2][q]
            );
            assert!(observed > order - 0.35, "{scheme:?} {name}: {observed}");
        }
    }
}

/// Oracle: D2 ramped at 0.3 s.
#[test]
fn the_element_keeps_its_order_in_space() {
    for (order, p, elements) in
        [(Order::Two, 2.0, [16, 32]), (Order::Four, 4.0, [8, 16]), (Order::Six, 5.0, [8, 16])]
    {
        let errors = elements.map(|n| {
            let dynamics = Dynamics { order, elements: n, ..fixed(0.3 / 160.0) };
            release_errors(&dynamics, true, 0.3)[3]
        });
        let observed = (errors[0] / errors[1]).log2();
        println!("{order:?}: {errors:?}, order {observed:.2}");
        assert!(observed > p - 0.1, "{order:?}: {observed}");
    }
}
