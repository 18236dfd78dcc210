//! Rods without some of their strains: closed forms, the limit of growing stiffness, and the free rod where it does not use them.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

#[path = "../fixed_mesh/mod.rs"]
mod fixed_mesh;
#[path = "../reference/mod.rs"]
mod reference;
mod supports;

use fixed_mesh::STATICS;
use hyperrod::body::Constraint;
use hyperrod::load::{DeadLoad, DeadWrench, ElasticFoundation, FollowerWrench};
use hyperrod::material::NeoHookean;
use hyperrod::section::{Circle, CrossSection, Linear, Section, Stiffness};
use hyperrod::solve::{Order, Stability};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Twist, Wrench};
use nalgebra::{Vector3, vector};
use reference::{data, number};

/// Largest difference at the nodes: positions and rotations, and wrenches relative to the largest.
fn difference(a: &StaticSolution, b: &StaticSolution) -> f64 {
    let size = |w: &Wrench| w.to_vector().norm();
    let largest = b.nodes().iter().map(|n| size(&n.wrench)).fold(0.0, f64::max);
    a.nodes().iter().zip(b.nodes()).fold(0.0, |worst: f64, (a, b)| {
        let moved = (a.pose.position - b.pose.position).norm() + (a.pose.rotation - b.pose.rotation).norm();
        worst.max(moved).max(size(&(a.wrench - b.wrench)) / largest)
    })
}

/// Elliptic integrals.
#[test]
fn an_inextensible_rod_is_the_elastica_with_no_stiffness_against_extension_at_all() {
    let planar = Constraint::kirchhoff().and(Constraint::planar());
    for case in data("B1_elastica_inextensible.json")["cases"].as_array().unwrap() {
        for constraint in [Constraint::kirchhoff(), planar] {
            // shear and extension are softer than bending; their stiffness is of no consequence
            let section = Stiffness::diagonal([1.0, 1.0, 0.7, 1e-3, 2e-3, 3e-3]).unwrap();
            let body = Body::new(1.0, section).unwrap().with_constraint(constraint);
            let force = vector![number(case, "PL2_over_EI"), 0.0, 0.0];
            let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(force).unwrap());
            for statics in [STATICS, Statics::to(1e-11)] {
                let solution = statics.solve(&rod).unwrap();
                let tip = solution.tip().pose.position;
                let error = (tip.x - number(case, "transverse_x_over_L"))
                    .abs()
                    .max((tip.z - number(case, "axial_z_over_L")).abs());
                assert!(error < 1e-10, "{case}: {error:.1e}");
                for node in solution.nodes().iter().chain(solution.stages()) {
                    assert_eq!(node.strain.linear, Vector3::zeros());
                    // the reaction is the load, seen from the section; rounding of the poses
                    let force = node.pose.rotation * node.wrench.force - force;
                    assert!(force.norm() < 1e-12, "{force:?}");
                }
            }
        }
    }
}

const K: [f64; 6] = [1.1, 0.9, 0.7, 60.0, 50.0, 90.0];

/// A rod, curved at rest, under everything: all of elimination, and elimination of everything at once where springs act.
fn loaded(stiffness: [f64; 6], constraint: Constraint, springs: bool) -> StaticSolution {
    let curved = Twist::from_array([0.4, -0.8, 0.6, 0.02, -0.03, 1.02]);
    let body = Body::new(1.0, Stiffness::diagonal(stiffness).unwrap()).unwrap();
    let body = body.with_reference_strain(curved).unwrap().with_constraint(constraint);
    let mut rod = Rod::clamped(body, Pose::identity())
        .with_tip_load(DeadWrench::new(vector![0.2, -0.1, 0.3], vector![1.0, -0.7, 0.4]).unwrap())
        .with_tip_load(FollowerWrench::new(vector![0.1, 0.2, 0.0], vector![0.3, 0.1, -0.2]).unwrap());
    if springs {
        rod = rod
            .with_load(DeadLoad::new(Wrench::new(vector![0.1, 0.0, 0.2], vector![0.5, 0.3, -0.4])).unwrap())
            .with_load(ElasticFoundation::new(vector![1.0, 2.0, 0.5], |s: f64| Vector3::z() * s).unwrap());
    }
    STATICS.solve(&rod).unwrap()
}

/// y(k) = y∞ + c/k + O(1/k²), so 2 y(2k) − y(k) is the limit to O(1/k²).
#[test]
fn every_constraint_is_the_limit_of_a_growing_stiffness() {
    let named = [
        Constraint::inextensible(),
        Constraint::unshearable(),
        Constraint::kirchhoff(),
        Constraint::twist_free(),
        Constraint::planar(),
        Constraint::planar().and(Constraint::kirchhoff()),
        Constraint::fixing([true, false, false, false, true, false]),
        Constraint::fixing([false, true, true, true, false, true]),
        Constraint::fixing([true, true, true, false, false, false]),
        Constraint::fixing([true, true, true, true, true, false]),
    ];
    for constraint in named {
        for springs in [false, true] {
            let exact = loaded(K, constraint, springs);
            let stiff = |factor: f64| {
                let fixed = constraint.fixed();
                let k = std::array::from_fn(|i| if fixed[i] { K[i] * factor } else { K[i] });
                loaded(k, Constraint::none(), springs)
            };
            let factor = 1e4;
            let (once, twice) = (stiff(factor), stiff(2.0 * factor));
            let limit = twice.tip().pose.position * 2.0 - once.tip().pose.position;
            let error = (exact.tip().pose.position - limit).norm();
            let gap = (exact.tip().pose.position - once.tip().pose.position).norm();
            // the terms left out are of the size of the square of the first
            assert!(
                error < 1e-10 + 10.0 * gap * gap,
                "{constraint:?}, springs {springs}: {error:.1e}, {gap:.1e}"
            );
            let wrench = twice.base().wrench * 2.0 - once.base().wrench;
            let error = (exact.base().wrench - wrench).to_vector().norm() / wrench.to_vector().norm();
            assert!(error < 1e-7, "{constraint:?}, springs {springs}: reactions {error:.1e}");
        }
    }
}

/// A tapered neo-Hookean arm bent in its plane does not use the strains that lead out of it.
#[test]
fn a_planar_rod_is_the_rod_in_space_that_happens_to_stay_in_its_plane() {
    for curved in [false, true] {
        for order in [Order::Two, Order::Four, Order::Six] {
            for gravity in [false, true] {
                let solve = |constraint: Constraint| {
                    let radius = Linear { from: 0.02, to: 0.012, length: 0.3 };
                    let law = NeoHookean::new(2e5, 3e5).unwrap();
                    let section = Section::new(Circle::new(radius), law).unwrap();
                    let mut body = Body::new(0.3, section).unwrap();
                    if curved {
                        let xi = Twist::from_array([0.0, 3.0, 0.0, 0.01, 0.0, 1.02]);
                        body = body.with_reference_strain(xi).unwrap();
                    }
                    let tip = DeadWrench::new(vector![0.0, 0.05, 0.0], vector![1.5, 0.0, -0.4]).unwrap();
                    let mut rod =
                        Rod::clamped(body.with_constraint(constraint), Pose::identity()).with_tip_load(tip);
                    if gravity {
                        let weight = Wrench::new(Vector3::zeros(), vector![2.0, 0.0, -3.0]);
                        rod = rod.with_load(DeadLoad::new(weight).unwrap());
                    }
                    Statics { elements: 16, order, ..STATICS }.solve(&rod).unwrap()
                };
                let (free, planar) = (solve(Constraint::none()), solve(Constraint::planar()));
                let error = difference(&planar, &free);
                // the same equations, solved in another order
                assert!(error < 1e-12, "curved {curved}, {order:?}, gravity {gravity}: {error:.1e}");
                let steps = |s: &StaticSolution| s.report().iterations.len();
                assert_eq!(steps(&planar), steps(&free));
            }
        }
    }
}

/// What pushes a planar rod out of its plane is taken by whatever keeps it there: n_y and m_x, m_z are reactions.
#[test]
fn a_load_across_the_plane_is_carried_by_reactions() {
    let solve = |across: f64, springs: bool| {
        let section = Stiffness::diagonal(K).unwrap();
        let body = Body::new(1.0, section).unwrap().with_constraint(Constraint::planar());
        let tip =
            DeadWrench::new(vector![0.3 * across, 0.1, 0.2 * across], vector![1.0, across, 0.5]).unwrap();
        let mut rod = Rod::clamped(body, Pose::identity()).with_tip_load(tip);
        if springs {
            rod = rod.with_load(
                ElasticFoundation::new(vector![0.5, 0.0, 0.5], |s: f64| Vector3::z() * s).unwrap(),
            );
        }
        STATICS.solve(&rod).unwrap()
    };
    for springs in [false, true] {
        let (plain, pushed) = (solve(0.0, springs), solve(0.8, springs));
        for (a, b) in plain.nodes().iter().zip(pushed.nodes()) {
            assert!((a.pose.position - b.pose.position).norm() < 1e-13);
            assert!((b.wrench.force.y - 0.8).abs() < 1e-13);
        }
        let base = pushed.base();
        let arm = pushed.tip().pose.position - base.pose.position;
        // moments about X and Z in space: the tip's own, and the lever of 0.8 N across
        let moment = base.pose.rotation * base.wrench.moment;
        let expected = vector![0.24, 0.0, 0.16] + arm.cross(&vector![0.0, 0.8, 0.0]);
        assert!((moment.x - expected.x).abs() + (moment.z - expected.z).abs() < 1e-12, "{moment:?}");
    }
}

/// Whatever its law says about strains it cannot have: here nothing that could be inverted.
#[test]
fn the_law_is_not_asked_about_strains_that_are_fixed() {
    struct BendingAlone;
    impl CrossSection for BendingAlone {
        fn respond(
            &self,
            _at: &hyperrod::material::Station,
            strain: &hyperrod::Strain,
            _request: hyperrod::material::Request,
        ) -> hyperrod::Result<hyperrod::material::Response> {
            let mut response = hyperrod::material::Response::zero();
            response.wrench.moment = strain.angular;
            response.energy = 0.5 * strain.angular.norm_squared();
            response.tangent.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            Ok(response)
        }
    }
    let body = Body::new(1.0, BendingAlone).unwrap().with_constraint(Constraint::kirchhoff());
    let force = DeadWrench::force(vector![5.0, 0.0, 0.0]).unwrap();
    let rod = Rod::clamped(body, Pose::identity()).with_tip_load(force);
    let case = &data("B1_elastica_inextensible.json")["cases"][2];
    // nor is whoever tells whether it is stable
    for statics in [STATICS, Statics { accept_unstable: false, ..STATICS }, Statics::to(1e-11)] {
        let solution = statics.solve(&rod).unwrap();
        assert!((solution.tip().pose.position.x - number(case, "transverse_x_over_L")).abs() < 1e-11);
        assert_eq!(solution.report().stability, Stability::Index { unstable: 0, neutral: 0 });
    }
}

/// A bent cantilever has no unstable mode, whatever strains it cannot have: its force has a potential, and straightens it.
#[test]
fn constraints_do_not_make_a_rod_unstable() {
    let all = [Constraint::kirchhoff(), Constraint::inextensible(), Constraint::unshearable()];
    for constraint in all {
        for (elements, order) in [(4, Order::Four), (16, Order::Four), (8, Order::Six)] {
            let section = Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4]).unwrap();
            let body = Body::new(1.0, section).unwrap().with_constraint(constraint);
            let push = DeadWrench::force(vector![1.0, 0.5, 0.2]).unwrap();
            let rod = Rod::clamped(body, Pose::identity()).with_tip_load(push);
            let solution = Statics { elements, order, ..Statics::default() }.solve(&rod).unwrap();
            let stable = Stability::Index { unstable: 0, neutral: 0 };
            assert_eq!(solution.report().stability, stable, "{constraint:?}, {elements} {order:?}");
        }
    }
}
