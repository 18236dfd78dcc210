//! Static rods against reference solutions of two independent routes each: shooting with an eighth-order Runge–Kutta method, and 16th-order
//! collocation (tests/data).
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic
mod reference;

use hyperrod::Statics;
use hyperrod::material::NeoHookean;
use hyperrod::section::{Circle, Linear, Section};
use hyperrod::solve::Order;
use hyperrod::{Body, Pose, Rod, load::DeadWrench};
use nalgebra::{Matrix3, Vector3, vector};
use reference::{data, number, static_cases};

/// The bound on positions / L, rotations, wrenches / largest wrench and strains × L on the meshes below. The hardest case (100 times its own
/// weight) has 2e-6 with 32 elements of order 4, so 2e-6 / 8⁴ = 5e-10 with 256; and 6e-9 with 32 elements of order 6, so 1e-10 with 64.
const BOUND: f64 = 1e-9;

const FINE: [Statics; 2] = [
    Statics { elements: 256, order: Order::Four, ..Statics::DEFAULT },
    Statics { elements: 64, order: Order::Six, ..Statics::DEFAULT },
];

fn matches(file: &str, count: usize) {
    let cases = static_cases(file);
    assert_eq!(cases.len(), count);
    for case in cases {
        for statics in FINE {
            let solution = statics.solve(&case.rod()).unwrap_or_else(|e| panic!("{}: {e}", case.id));
            let errors = case.errors(&solution);
            assert!(errors.worst() < BOUND, "{}, {:?}: {errors:?}", case.id, statics.order);
        }
    }
}

#[test]
fn the_elastica_matches_its_reference() {
    matches("B1_elastica_finite.json", 4);
}

#[test]
fn an_end_moment_bends_a_rod_to_a_circle() {
    matches("B2_end_moment.json", 3);
    // the closed form, to rounding on any mesh: a constant strain is exact in every element
    for turns in [0.25, 0.5, 1.0] {
        let (length, bending) = (0.8, 0.125);
        let curvature = turns * std::f64::consts::TAU / length;
        let section = hyperrod::section::Stiffness::diagonal([bending, bending, 0.1, 4e2, 4e2, 1e3]).unwrap();
        let moment = DeadWrench::moment(vector![0.0, bending * curvature, 0.0]).unwrap();
        let rod = Rod::clamped(Body::new(length, section).unwrap(), Pose::identity()).with_tip_load(moment);
        for order in [Order::Two, Order::Four, Order::Six] {
            let solution = Statics { elements: 4, order, ..Default::default() }.solve(&rod).unwrap();
            for node in solution.nodes() {
                let angle = curvature * node.s;
                let exact = vector![1.0 - angle.cos(), 0.0, angle.sin()] / curvature;
                // some ten products of poses
                assert!((node.pose.position - exact).norm() < 1e-14, "{turns} turns, s = {}", node.s);
            }
        }
    }
}

#[test]
fn the_45_degree_bend_matches_its_reference() {
    matches("B3_bend45.json", 3);
}

#[test]
fn the_heavy_elastica_matches_its_reference() {
    matches("B9_heavy_elastica.json", 4);
}

#[test]
fn the_princeton_beam_matches_its_reference() {
    matches("B5_princeton.json", 10);
}

#[test]
fn neo_hookean_cantilevers_match_their_reference() {
    matches("C4_nh_cantilever.json", 4);
}

/// Oracle: ∫c ds with A(s)(μ(c − 1/c) + λ ln c / c) = F, two quadratures in 50 digits.
#[test]
fn a_tapered_neo_hookean_rod_in_tension_matches_its_quadrature() {
    for case in data("C1_tapered_tension.json")["cases"].as_array().unwrap() {
        let (radius, length) = (number(case, "R0"), number(case, "L"));
        let law = NeoHookean::new(number(case, "mu"), number(case, "lam")).unwrap();
        let profile = Linear { from: radius, to: 0.5 * radius, length };
        let body = Body::new(length, Section::new(Circle::new(profile), law).unwrap()).unwrap();
        let rod = Rod::clamped(body, Pose::identity())
            .with_tip_load(DeadWrench::force(vector![0.0, 0.0, number(case, "F")]).unwrap());
        for statics in FINE {
            // where the force is beyond c GA a rod that shears is unstable in tension, and the straight state is the one of the reference
            let solution = Statics { accept_unstable: true, ..statics }.solve(&rod).unwrap();
            let (tip, base) = (solution.tip(), solution.base());
            let middle = &solution.nodes()[solution.nodes().len() / 2];
            let z = number(case, "tip_z");
            let error = (tip.pose.position.z - z).abs() / z;
            assert!(error < BOUND, "{}: {error:.1e}", case["id"]);
            for (node, key) in [(base, "c_base"), (middle, "c_mid"), (tip, "c_tip")] {
                // the force in a rod under tension is exact, and so is the strain it asks for
                let c = number(case, key);
                assert!((1.0 + node.strain.linear.z - c).abs() < 1e-13 * c, "{}, {key}", case["id"]);
            }
        }
    }
}

/// The same rod moved as a rigid body, loads and all: an answer in space that moves with it, and wrenches in the body that do not change.
#[test]
fn a_rod_moved_as_a_rigid_body_gives_the_moved_answer() {
    let mut case = static_cases("C4_nh_cantilever.json").pop().unwrap();
    assert_eq!(case.id, "C4/3D");
    let statics = Statics { elements: 16, ..Default::default() };
    let here = statics.solve(&case.rod_with_degree(12)).unwrap();

    let q = [0.5, -0.1, 0.7, 0.5]; // norm 1
    let turn: Matrix3<f64> = reference::rotation(q);
    let shift = vector![3.0, -2.0, 5.0];
    let turned = |v: [f64; 3]| (turn * Vector3::from(v)).into();
    case.base.p = shift.into();
    case.base.q_wxyz = q;
    case.tip_force_dead = turned(case.tip_force_dead);
    case.tip_moment_dead = turned(case.tip_moment_dead);
    case.distributed_force_dead_per_ref_length = turned(case.distributed_force_dead_per_ref_length);
    let there = statics.solve(&case.rod_with_degree(12)).unwrap();

    for (a, b) in here.nodes().iter().zip(there.nodes()) {
        // roundings of positions of six metres, 1e-15 each, over sixteen elements; wrenches of a newton and a tenth of a newton metre
        assert!((turn * a.pose.position + shift - b.pose.position).norm() < 2e-14, "s = {}", a.s);
        assert!((turn * a.pose.rotation - b.pose.rotation).norm() < 1e-14, "s = {}", a.s);
        assert!((a.wrench - b.wrench).to_vector().norm() < 1e-13, "s = {}", a.s);
        assert!((a.strain - b.strain).to_vector().norm() < 1e-11, "s = {}", a.s);
    }
    let energy = here.strain_energy();
    assert!((energy - there.strain_energy()).abs() < 1e-13 * energy);
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let case = &static_cases("C4_nh_cantilever.json")[3];
    let solve = || Statics::default().solve(&case.rod_with_degree(12)).unwrap();
    let (a, b) = (solve(), solve());
    assert_eq!(a.nodes(), b.nodes());
    assert_eq!(a.stages(), b.stages());
    assert_eq!(a.strain_energy().to_bits(), b.strain_energy().to_bits());
    assert_eq!(a.report().iterations, b.report().iterations);
    assert_eq!(a.report().error, b.report().error);
}
