//! How fast answers converge: order of the element, Newton's tail, and the error estimate.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic
mod reference;

use hyperrod::solve::Order;
use hyperrod::{StaticSolution, Statics};
use reference::{StaticCase, static_case};

fn solve(case: &StaticCase, elements: usize, order: Order) -> StaticSolution {
    Statics { elements, order, ..Default::default() }.solve(&case.rod()).unwrap()
}

/// The slope of log(error) over log(1/N), by least squares.
fn observed_order(meshes: &[usize], errors: &[f64]) -> f64 {
    let n = meshes.len() as f64;
    let x: Vec<f64> = meshes.iter().map(|&m| -(m as f64).ln()).collect();
    let y: Vec<f64> = errors.iter().map(|e| e.ln()).collect();
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let slope = |f: &dyn Fn(usize) -> f64| (0..x.len()).map(f).sum::<f64>();
    slope(&|i| (x[i] - mx) * (y[i] - my)) / slope(&|i| (x[i] - mx) * (x[i] - mx))
}

/// The order over four refinements, on position, rotation and wrench (and strain where the reference has one).
fn converges(order: Order, expected: f64, margin: f64, meshes: &[usize; 5]) {
    for case in [
        static_case("B1_elastica_finite.json", "B1/finite_alpha2"), // nothing but a tip force
        static_case("B3_bend45.json", "B3/polar_600"),              // in space, from a curved reference
        static_case("B9_heavy_elastica.json", "B9/heavy_10_beta90"), // nothing but weight
        static_case("C4_nh_cantilever.json", "C4/3D"), // in space, nonlinear, weight and tip force and moment
    ] {
        let errors: Vec<_> = meshes.iter().map(|&n| case.errors(&solve(&case, n, order))).collect();
        let strains = case.stations[0].dxi.is_some();
        for (name, pick) in [
            ("position", (|e| e.position) as fn(&reference::Errors) -> f64),
            ("rotation", |e| e.rotation),
            ("wrench", |e| e.wrench),
            ("strain", |e| e.strain),
        ] {
            if name == "strain" && !strains {
                continue;
            }
            let errors: Vec<f64> = errors.iter().map(pick).collect();
            let p = observed_order(meshes, &errors);
            assert!((p - expected).abs() < margin, "{}, {order:?}, {name}: {p:.3} from {errors:?}", case.id);
        }
    }
}

#[test]
fn one_stage_converges_with_order_two() {
    converges(Order::Two, 2.0, 0.05, &[16, 32, 64, 128, 256]);
}

#[test]
fn two_stages_converge_with_order_four() {
    converges(Order::Four, 4.0, 0.1, &[16, 32, 64, 128, 256]);
}

/// Meshes closer together: a halving is a factor of 64, and four of them would end in rounding. The coarsest are above order 6 still.
#[test]
fn three_stages_converge_with_order_six() {
    converges(Order::Six, 6.0, 0.2, &[12, 16, 24, 32, 40]);
}

/// Full Newton steps e_k on the coarse mesh, where the solve starts from rest: e_{k+1} ≈ C e_k² with one C. An approximate tangent would show
/// as a C that grows like 1/e_k.
#[test]
fn newton_converges_quadratically_on_a_nonlinear_material() {
    for id in ["C4/transverse_3", "C4/transverse_8", "C4/3D"] {
        let case = static_case("C4_nh_cantilever.json", id);
        let solution = solve(&case, 32, Order::Four);
        let coarse = solution.report().iterations.iter().filter(|i| i.elements == 16);
        let steps: Vec<f64> = coarse.filter(|i| i.fraction == 1.0).map(|i| i.step).collect();
        assert!(steps.len() >= 4 && steps.len() <= 6, "{id}: {steps:?}");
        // the last three pairs; strains × L of order one have rounding steps of 1e-15 times some ten operations
        let rounding = 1e-13;
        let mut constants = Vec::new();
        for pair in steps[steps.len() - 4..].windows(2) {
            let constant = pair[1] / (pair[0] * pair[0]);
            assert!(pair[1] <= pair[0] * pair[0] + rounding, "{id}: {steps:?}");
            if pair[1] > rounding {
                constants.push(constant);
            }
        }
        // measured: C from 0.02 to 0.25, neighbours within 4.4
        assert!(constants.len() >= 2, "{id}: {steps:?}");
        for pair in constants.windows(2) {
            assert!(pair[1] < 6.0 * pair[0], "{id}: constants {constants:?} from steps {steps:?}");
        }
    }
}

/// The error is measured against 256 elements of order 6, whose own is below 1e-12 (tests/statics.rs). Measured: factors from 0.6 to 1.45.
#[test]
fn the_error_estimate_is_within_a_factor_of_three_of_the_error() {
    for (file, id) in [
        ("B1_elastica_finite.json", "B1/finite_alpha10"),
        ("B3_bend45.json", "B3/polar_600"),
        ("B9_heavy_elastica.json", "B9/heavy_10_beta90"),
        ("B9_heavy_elastica.json", "B9/heavy_100_beta45"),
        ("C4_nh_cantilever.json", "C4/transverse_8"),
        ("C4_nh_cantilever.json", "C4/3D"),
    ] {
        let case = static_case(file, id);
        let exact = solve(&case, 256, Order::Six);
        for (order, elements) in [
            (Order::Two, 32),
            (Order::Two, 128),
            (Order::Four, 32),
            (Order::Four, 128),
            (Order::Six, 16),
            (Order::Six, 32),
        ] {
            let solution = solve(&case, elements, order);
            let (mut position, mut rotation) = (0.0_f64, 0.0_f64);
            for (node, exact) in solution.nodes().iter().zip(exact.nodes().iter().step_by(256 / elements)) {
                position = position.max((node.pose.position - exact.pose.position).norm());
                rotation = rotation.max((exact.pose.inverse() * node.pose).log().angular.norm());
            }
            let estimate = solution.report().error;
            for ratio in [estimate.position / position, estimate.rotation / rotation] {
                assert!((1.0 / 3.0..3.0).contains(&ratio), "{id}, {order:?}, {elements} elements: {ratio}");
            }
        }
    }
}
