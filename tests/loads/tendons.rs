//! Tendons and pressure chambers against closed forms, formulas derived by hand, and [`super::shooting`].

use hyperrod::load::DeadWrench;
use hyperrod::material::{NeoHookean, Reference, Request, Station};
use hyperrod::section::{
    Actuated, Circle, Converging, CrossSection, Helical, Linear, PressureChamber, Section, Stiffness, Tendon,
};
use hyperrod::{Body, Pose, Rod, Statics, Strain, Twist, Wrench};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6, vector};
use num_dual::{Dual2_64, DualNum};

use super::fixed_mesh::STATICS;
use super::reference::{data, number, rotation};
use super::shooting::{Shooting, State, ad_transpose, hat, join};

/// Closed form: tendons parallel to the axis give a constant strain, and g(L) = exp(L ξ^).
#[test]
fn tendons_parallel_to_the_axis_bend_a_rod_to_the_reference_arc() {
    for case in data("B10_tendon.json")["cases"].as_array().unwrap() {
        let array = |key: &str| -> Vec<f64> { serde_json::from_value(case[key].clone()).unwrap() };
        let k: [f64; 6] = array("K_diag").try_into().unwrap();
        let mut section = Actuated::new(Stiffness::diagonal(k).unwrap());
        for tendon in case["tendons"].as_array().unwrap() {
            let place = [number(tendon, "x"), number(tendon, "y")];
            section = section.with_actuator(Tendon::new(place, number(tendon, "T")).unwrap());
        }
        let length = number(case, "L");
        let rod = Rod::clamped(Body::new(length, section).unwrap(), Pose::identity());
        let solution = Statics { elements: 4, ..STATICS }.solve(&rod).unwrap();

        let (xi, psi, p) = (array("xi"), array("psi"), array("tip_p"));
        let tip = solution.tip();
        let position = (tip.pose.position - Vector3::from_column_slice(&p)).norm() / length;
        let q: [f64; 4] = array("tip_q_wxyz").try_into().unwrap();
        let turned = (tip.pose.rotation - rotation(q)).norm();
        let total = Wrench::zero(); // rod and tendons together carry nothing: no other load acts
        for node in solution.nodes().iter().chain(solution.stages()) {
            let strain = Twist::straight() + node.strain;
            let exact = Twist::from_array(xi.clone().try_into().unwrap());
            let d = Strain::between(&exact, &strain);
            assert!(d.linear.norm() + d.angular.norm() * length < 1e-13, "{d:?}");
            assert!((node.wrench - total).to_vector().norm() < 1e-13 * psi[5].abs());
        }
        // asked for: 1e-10; rounding, and the reference's own 7e-15
        assert!(position < 1e-13 && turned < 1e-13, "{}: {position:.1e} {turned:.1e}", case["id"]);
    }
}

/// The tendon by hand (Rucker and Webster 2011): with P = (1 − t tᵀ)/|γ|,
/// f = T (P γ′ + ω × t), γ′ = ν′ − r × ω′ + ω × r′ + r″, and f̄ = (r × f, f) = −(Ā ξ′ + B̄).
struct ByHand {
    pull: Vector6<f64>,
    a_bar: Matrix6<f64>,
    b_bar: Vector6<f64>,
}

fn by_hand(tension: f64, [r, dr, ddr]: [Vector3<f64>; 3], omega: &Vector3<f64>, nu: &Vector3<f64>) -> ByHand {
    let gamma = nu + omega.cross(&r) + dr;
    let t = gamma.normalize();
    let p = (Matrix3::identity() - t * t.transpose()) / gamma.norm();
    let arm = hat(&r);
    let mut a_bar = Matrix6::zeros();
    a_bar.fixed_view_mut::<3, 3>(0, 0).copy_from(&(arm * p * arm * tension));
    a_bar.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-arm * p * tension));
    a_bar.fixed_view_mut::<3, 3>(3, 0).copy_from(&(p * arm * tension));
    a_bar.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-p * tension));
    let b = (p * (omega.cross(&dr) + ddr) + omega.cross(&t)) * tension;
    ByHand { pull: join(r.cross(&t), t) * tension, a_bar, b_bar: -join(r.cross(&b), b) }
}

/// r, r′ and r″ of a routing given by closed formulas.
type Path = fn(f64) -> [Vector3<f64>; 3];

/// Tension, path, and where it ends.
type Route = (f64, Path, f64);

const LENGTH: f64 = 0.4;

/// Helix of radius 8 mm, one turn in 0.3 m.
fn helix(s: f64) -> [Vector3<f64>; 3] {
    let (rate, radius) = (std::f64::consts::TAU / 0.3, 8e-3);
    let (sin, cos) = (rate * s + 0.4).sin_cos();
    let radial = vector![cos, sin, 0.0] * radius;
    [radial, vector![-sin, cos, 0.0] * (radius * rate), -radial * (rate * rate)]
}

/// From (8, −3) mm to (1, 2) mm.
fn converging(s: f64) -> [Vector3<f64>; 3] {
    let (from, to) = (vector![8e-3, -3e-3, 0.0], vector![1e-3, 2e-3, 0.0]);
    [from + (to - from) * (s / LENGTH), (to - from) / LENGTH, Vector3::zeros()]
}

fn helical_tendon(tension: f64) -> Tendon<Helical> {
    Tendon::new(Helical { radius: 8e-3, pitch: 0.3, start: 0.4 }, tension).unwrap()
}

fn converging_tendon(tension: f64) -> Tendon<Converging> {
    let routing = Converging { from: [8e-3, -3e-3], to: [1e-3, 2e-3], length: LENGTH };
    Tendon::new(routing, tension).unwrap()
}

/// A section that answers nothing, so that what is seen is the actuator alone.
struct Nothing;

impl CrossSection for Nothing {
    fn respond(
        &self,
        _at: &Station,
        _strain: &Strain,
        _request: Request,
    ) -> hyperrod::Result<hyperrod::material::Response> {
        Ok(hyperrod::material::Response::zero())
    }
}

#[test]
fn the_derivatives_of_a_tendon_are_the_formulas_derived_by_hand() {
    let strains = [[9.0, -7.0, 12.0, 0.06, -0.05, 0.04], [-6.0, 11.0, -16.0, -0.1, 0.02, -0.06], [0.0; 6]];
    let curved = |s: f64| Reference {
        twist: Twist::from_array([3.0 - 4.0 * s, 2.0, -5.0 + s, 0.02 * s, -0.01, 1.0 + 0.1 * s]),
        rate: Twist::from_array([-4.0, 0.0, 1.0, 0.02, 0.0, 0.1]),
    };
    let closure = |s: Dual2_64| {
        let (sin, cos) = (s * (std::f64::consts::TAU / 0.3) + 0.4).sin_cos();
        [cos * 8e-3, sin * 8e-3]
    };
    let routes: [(Actuated<Nothing>, Path); 3] = [
        (Nothing.with_actuator(helical_tendon(2.5)), helix),
        (Nothing.with_actuator(Tendon::new(closure, 2.5).unwrap()), helix),
        (Nothing.with_actuator(converging_tendon(2.5)), converging),
    ];
    for (tendon, path) in &routes {
        for strain in strains {
            for (s, reference) in [(0.07, Reference::straight()), (0.31, curved(0.31))] {
                let (strain, at) = (Strain::from_array(strain), Station { s, reference });
                let ours = tendon.respond(&at, &strain, Request::Rate).unwrap();
                let xi = reference.twist + strain;
                let hand = by_hand(2.5, path(s), &xi.angular, &xi.linear);
                // Ψ′ at fixed Δξ moves ξ by ξ*′, so f̄ is −(Ā ξ*′ + B̄) there: B̄ = ad_ξᵀ Ψ − Ψ′ − Ā ξ*′
                let b_bar = (ours.wrench.ad_transpose(&xi) - ours.wrench_rate).to_vector()
                    - hand.a_bar * reference.rate.to_vector();
                let error = (ours.wrench.to_vector() - hand.pull).norm() / 2.5
                    + (ours.tangent + hand.a_bar).norm() / 2.5
                    + (b_bar - hand.b_bar).norm() / hand.b_bar.norm().max(1.0);
                // some tens of roundings of numbers of size one to ten
                assert!(error < 1e-13, "s = {s}: {error:.1e}");
                let value = tendon.respond(&at, &strain, Request::Wrench).unwrap();
                assert!((value.wrench - ours.wrench).to_vector().norm() < 1e-14);
            }
        }
    }
}

const K: [f64; 6] = [3.9e-3, 4.5e-3, 2.6e-3, 52.0, 52.0, 157.0];

fn stiffness() -> Matrix6<f64> {
    Matrix6::from_diagonal(&Vector6::from(K))
}

/// Tip force in space.
const FORCE: Vector3<f64> = vector![0.02, -0.03, 0.01];

/// Tendons of (tension, path, end) on a linear rod with a dead force on its tip, by [`Shooting`]: (K − Ā) ξ′ = ad_ξᵀ K Δξ + B̄, and
/// K Δξ = Rᵀ F − T (r × t, t) at the end of a tendon that reaches the tip.
fn shoot(tendons: &[Route], pieces: &[f64], guess: Vector6<f64>) -> State {
    let hand = |s: f64, state: &State, until: f64| {
        let acting = tendons.iter().filter(move |(_, _, end)| *end >= until);
        acting.map(|&(tension, path, _)| by_hand(tension, path(s), &state.omega(), &state.nu())).fold(
            ByHand { pull: Vector6::zeros(), a_bar: Matrix6::zeros(), b_bar: Vector6::zeros() },
            |sum, one| ByHand {
                pull: sum.pull + one.pull,
                a_bar: sum.a_bar + one.a_bar,
                b_bar: sum.b_bar + one.b_bar,
            },
        )
    };
    let slope = |s: f64, state: &State, piece: usize| {
        let tendons = hand(s, state, pieces[piece + 1]);
        let balance = ad_transpose(state, &(stiffness() * state.strain)) + tendons.b_bar;
        (stiffness() - tendons.a_bar).lu().solve(&balance).unwrap()
    };
    // the wrench of rod and tendons together goes on: K Δξ⁺ + pull⁺(Δξ⁺) = K Δξ⁻ + pull⁻(Δξ⁻), by iteration
    let jump = |node: usize, state: &State| {
        let s = pieces[node];
        let total = stiffness() * state.strain + hand(s, state, pieces[node]).pull;
        let mut after = *state;
        for _ in 0..200 {
            let pull = hand(s, &after, pieces[node + 1]).pull;
            after.strain = stiffness().lu().solve(&(total - pull)).unwrap();
        }
        after.strain
    };
    let tip = |state: &State| {
        let dead = join(Vector3::zeros(), state.rotation.transpose() * FORCE);
        stiffness() * state.strain + hand(LENGTH, state, LENGTH).pull - dead
    };
    Shooting { pieces, steps: 1000, slope: &slope, jump: &jump, tip: &tip }.solve(guess)
}

fn solve(section: Actuated<Stiffness>) -> hyperrod::StaticSolution {
    let rod = Rod::clamped(Body::new(LENGTH, section).unwrap(), Pose::identity())
        .with_tip_load(DeadWrench::force(FORCE).unwrap());
    STATICS.solve(&rod).unwrap()
}

/// Position and rotation of the tip, relative to the length.
fn difference(solution: &hyperrod::StaticSolution, state: &State) -> f64 {
    let pose = &solution.tip().pose;
    let moved = (pose.position - state.position).norm() / LENGTH;
    moved.max((pose.rotation - state.rotation).norm())
}

#[test]
fn helical_and_converging_tendons_meet_a_shooting_solution() {
    let section = || Actuated::new(Stiffness::diagonal(K).unwrap());
    let straight: Path = |_| [vector![5e-3, 0.0, 0.0], Vector3::zeros(), Vector3::zeros()];
    let cases: [(Actuated<Stiffness>, Vec<Route>); 3] = [
        (section().with_actuator(helical_tendon(1.2)), vec![(1.2, helix, LENGTH)]),
        (section().with_actuator(converging_tendon(0.8)), vec![(0.8, converging, LENGTH)]),
        (
            section()
                .with_actuator(helical_tendon(0.7))
                .with_actuator(converging_tendon(0.5))
                .with_actuator(Tendon::new([5e-3, 0.0], 0.3).unwrap()),
            vec![(0.7, helix, LENGTH), (0.5, converging, LENGTH), (0.3, straight, LENGTH)],
        ),
    ];
    for (section, tendons) in cases {
        let solution = solve(section);
        let guess = solution.base().strain.to_vector() * 1.05;
        let error = difference(&solution, &shoot(&tendons, &[0.0, LENGTH], guess));
        // Runge–Kutta: (h × 20 1/m)⁴/120 with h = 0.4 mm; order six with 64 elements is below; measured 1e-11
        assert!(error < 1e-10, "{error:.1e}");
    }
}

/// Ends at a node of the mesh.
#[test]
fn a_tendon_that_ends_before_the_tip_meets_a_shooting_solution_with_a_jump() {
    let end = 0.25;
    let section =
        Stiffness::diagonal(K).unwrap().with_actuator(converging_tendon(0.9).ending_at(end).unwrap());
    assert_eq!(CrossSection::breakpoints(&section), [end]);
    let solution = solve(section);
    let guess = solution.base().strain.to_vector();
    let error = difference(&solution, &shoot(&[(0.9, converging, end)], &[0.0, end, LENGTH], guess));
    assert!(error < 1e-10, "{error:.1e}");
}

/// One Newton solve; the energy is at its least: T and the length of the tendon by Castigliano, ∂(U + V)/∂T = ∫|γ| ds.
#[test]
fn a_tendon_in_a_tapered_neo_hookean_arm_is_solved_at_once_and_its_length_is_the_slope_of_the_energy() {
    let arm = |tension: f64| {
        let radius = Linear { from: 0.012, to: 0.007, length: LENGTH };
        let law = NeoHookean::new(2e5, 3e5).unwrap();
        let section = Section::new(Circle::new(radius), law).unwrap().with_actuator(helical_tendon(tension));
        let rod = Rod::clamped(Body::new(LENGTH, section).unwrap(), Pose::identity())
            .with_tip_load(DeadWrench::force(vector![0.1, 0.3, 0.0]).unwrap());
        STATICS.solve(&rod).unwrap()
    };
    let energy = |tension: f64| {
        let solution = arm(tension);
        solution.strain_energy() + solution.load_potential().unwrap()
    };
    let (tension, step) = (4.0, 0.02);
    let slope = (8.0 * (energy(tension + step) - energy(tension - step)) - energy(tension + 2.0 * step)
        + energy(tension - 2.0 * step))
        / (12.0 * step);
    let solution = arm(tension);
    let steps: Vec<f64> = solution.report().iterations.iter().map(|i| i.step).collect();
    assert!(steps.len() <= 12, "{steps:?}");
    let length =
        solution.integrate(|node| helical_tendon(tension).stretch(&Station::straight(node.s), &node.strain));
    // order six: 64 times less than with 32 elements, which shows 5e-10; the differences themselves leave 1e-12
    let error = (slope / length - 1.0).abs();
    assert!(error < 5e-11, "{error:.1e}");
}

/// Ψ = p A_c (r × e₃, e₃) with a minus: the rod takes a constant strain K⁻¹ p A_c (r × e₃, e₃).
#[test]
fn a_pressure_chamber_bends_a_linear_rod_to_the_arc_of_its_closed_form() {
    let (p, area, place) = (40e3, 20e-6, [5e-3, 2e-3]);
    let section =
        Stiffness::diagonal(K).unwrap().with_actuator(PressureChamber::new(place, area, p).unwrap());
    let rod = Rod::clamped(Body::new(LENGTH, section).unwrap(), Pose::identity());
    let solution = Statics { elements: 4, ..STATICS }.solve(&rod).unwrap();
    let strain = [p * area * place[1] / K[0], -p * area * place[0] / K[1], 0.0, 0.0, 0.0, p * area / K[5]];
    let xi = Twist::straight() + Strain::from_array(strain);
    let exact = (xi * LENGTH).exp();
    let tip = solution.tip().pose;
    assert!((tip.position - exact.position).norm() < 1e-14 && (tip.rotation - exact.rotation).norm() < 1e-13);
}

/// The load of a chamber whose place varies: Ψ′ against a difference of Ψ in s.
#[test]
fn the_rate_of_a_varying_chamber_is_its_derivative_in_s() {
    let area = |s: num_dual::Dual64| s * 2e-5 + 1e-5;
    let place = |s: Dual2_64| [s * s * 0.02, -(s * 0.01)];
    let section = Nothing.with_actuator(PressureChamber::new(place, area, 3e4).unwrap());
    let strain = Strain::from_array([9.0, -7.0, 12.0, 0.06, -0.05, 0.04]);
    let wrench = |s: f64| section.wrench(&Station::straight(s), &strain).unwrap();
    let (s, h) = (0.2, 1e-4);
    let difference = (wrench(s + h) - wrench(s - h)) * (0.5 / h);
    let rate = section.wrench_rate(&Station::straight(s), &strain).unwrap();
    // the formula is a cubic in s: h² times its third derivative, 1e-8
    assert!((rate - difference).to_vector().norm() < 1e-6 * rate.to_vector().norm());
}

/// There and back: the length under a tension, and the tension that gives that length; linear and neo-Hookean.
#[test]
fn a_tendon_given_by_its_length_closes_on_it() {
    let force = || DeadWrench::force(vector![0.05, 0.1, 0.0]).unwrap();
    let linear = |tendon: Tendon<Helical>| {
        let section = Stiffness::diagonal(K)?.with_actuator(tendon);
        Ok(Rod::clamped(Body::new(LENGTH, section)?, Pose::identity()).with_tip_load(force()))
    };
    let solution = STATICS.solve_tendon_length(0.385, helical_tendon(0.2), linear).unwrap();
    assert!((solution.length - 0.385).abs() < 1e-10 && solution.solves < 15, "{}", solution.solves);
    let given = STATICS.solve(&linear(helical_tendon(solution.tension)).unwrap()).unwrap();
    // the tension is that of the length: dT/dℓ is some 1e2 N/m
    assert!((given.tip().pose.position - solution.solution.tip().pose.position).norm() < 1e-12);

    let soft = |tendon: Tendon<Helical>| {
        let radius = Linear { from: 0.012, to: 0.007, length: LENGTH };
        let section = Section::new(Circle::new(radius), NeoHookean::new(2e5, 3e5)?)?.with_actuator(tendon);
        Ok(Rod::clamped(Body::new(LENGTH, section)?, Pose::identity()).with_tip_load(force()))
    };
    let rod = soft(helical_tendon(4.0)).unwrap();
    let length = helical_tendon(4.0).length_in(rod.body(), &STATICS.solve(&rod).unwrap());
    let back = STATICS.solve_tendon_length(length, helical_tendon(1.0), soft).unwrap();
    assert!((back.length - length).abs() < 1e-10, "{:e}", back.length - length);
    assert!((back.tension - 4.0).abs() < 1e-7, "{:e}", back.tension - 4.0);

    let slack = STATICS.solve_tendon_length(0.45, helical_tendon(1.0), linear).unwrap_err();
    assert_eq!(
        slack.reason.to_string(),
        "length of the tendon is 0.45, but must be shorter than the slack tendon"
    );
}

/// To an accuracy, on a mesh of the solver's choice, with an end that no even mesh has a node at.
#[test]
fn a_tendon_that_ends_anywhere_is_solved_to_an_accuracy() {
    let end = 0.1234;
    let section =
        Stiffness::diagonal(K).unwrap().with_actuator(converging_tendon(0.9).ending_at(end).unwrap());
    let rod = Rod::clamped(Body::new(LENGTH, section).unwrap(), Pose::identity())
        .with_tip_load(DeadWrench::force(FORCE).unwrap());
    let solution = Statics::to(1e-9).solve(&rod).unwrap();
    assert!(solution.nodes().iter().any(|node| node.s == end));
    let guess = solution.base().strain.to_vector();
    let error = difference(&solution, &shoot(&[(0.9, converging, end)], &[0.0, end, LENGTH], guess));
    println!("{error:.1e}, {} elements", solution.nodes().len() - 1);
    assert!(error < 1e-9, "{error:.1e}");
    // no more than twice what the same tendon needs that goes on to the tip
    let whole = Stiffness::diagonal(K).unwrap().with_actuator(converging_tendon(0.9));
    let whole = Rod::clamped(Body::new(LENGTH, whole).unwrap(), Pose::identity())
        .with_tip_load(DeadWrench::force(FORCE).unwrap());
    let needed = Statics::to(1e-9).solve(&whole).unwrap().nodes().len();
    assert!(solution.nodes().len() < 2 * needed, "{} nodes, {needed}", solution.nodes().len());
}
