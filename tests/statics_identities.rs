//! Identities that a solved rod must satisfy, whatever computed it: energy and work, Castigliano's theorem, and the strong form.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic
mod reference;

use hyperrod::body::{Density, HasMass};
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::{NeoHookean, Request};
use hyperrod::section::{Circle, CrossSection, Linear, Section};
use hyperrod::solve::Order;
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Strain, Twist, Wrench};
use nalgebra::{Matrix3, Vector3, vector};
use num_dual::Dual64;
use reference::{StaticCase, static_case};

/// Discretisation errors of 1e-12 and less on the rods below.
const FINE: Statics = Statics { elements: 64, order: Order::Six, ..Statics::DEFAULT };

/// ∫ over the nodes by Romberg's rule: trapezoids of all nodes, of every second one and so on, extrapolated.
fn romberg(values: &[f64], length: f64) -> f64 {
    let n = values.len() - 1;
    let trapezoid = |stride: usize| {
        let inner: f64 = (1..n / stride).map(|i| values[i * stride]).sum();
        (0.5 * (values[0] + values[n]) + inner) * length * stride as f64 / n as f64
    };
    let mut row: Vec<f64> = (0..5).map(|level| trapezoid(1 << level)).collect();
    for order in 1..5 {
        let factor = 4.0_f64.powi(order);
        row = row.windows(2).map(|w| (factor * w[0] - w[1]) / (factor - 1.0)).collect();
    }
    row[0]
}

/// For a linear law ∫U ds = ½∫Δξ·KΔξ ds = ½∫Δξ·Ψ ds, with strains of the nodes where the solver integrates over the stages.
#[test]
fn the_strain_energy_of_a_linear_rod_is_half_of_strain_times_stiffness_times_strain() {
    for (file, id) in [
        ("B1_elastica_finite.json", "B1/finite_alpha10"),
        ("B3_bend45.json", "B3/polar_600"),
        ("B9_heavy_elastica.json", "B9/heavy_10_beta45"),
    ] {
        let case = static_case(file, id);
        let k = case.k_diag.unwrap();
        let solution = Statics { elements: 256, ..FINE }.solve(&case.rod()).unwrap();
        let density = solution.nodes().iter().map(|node| {
            let xi = node.strain.to_array();
            (0..6).map(|i| 0.5 * k[i] * xi[i] * xi[i]).sum::<f64>()
        });
        let expected = romberg(&density.collect::<Vec<_>>(), case.length);
        let error = (solution.strain_energy() / expected - 1.0).abs();
        // Romberg of order 10 from 16 to 256 intervals, measured 2e-15
        assert!(error < 1e-13, "{id}: {error:.1e}");
    }
}

/// The rod of a case with its loads multiplied by a factor.
fn scaled(case: &StaticCase, factor: f64) -> StaticCase {
    let scale = |v: [f64; 3]| v.map(|x| x * factor);
    StaticCase {
        tip_force_dead: scale(case.tip_force_dead),
        distributed_force_dead_per_ref_length: scale(case.distributed_force_dead_per_ref_length),
        ..case.clone()
    }
}

/// The work of slowly growing dead loads, ∫₀¹ λ dW₁(λ) = W₁(1) − ∫₀¹ W₁ dλ with W₁ the potential of the full load taken negative, is stored: nothing
/// is lost. Ten Gauss points in λ.
#[test]
fn the_strain_energy_is_the_work_of_slowly_growing_loads() {
    let rule = hyperrod::quadrature::gauss_legendre(10).unwrap().on(0.0, 1.0).unwrap();
    for (file, id) in
        [("C4_nh_cantilever.json", "C4/transverse_3"), ("B9_heavy_elastica.json", "B9/heavy_10_beta90")]
    {
        let full = static_case(file, id);
        let solve = |factor: f64| -> StaticSolution {
            FINE.solve(&scaled(&full, factor).rod_with_degree(24)).unwrap()
        };
        let work_to = |factor: f64| -solve(factor).load_potential().unwrap() / factor;
        let end = solve(1.0);
        let stored: f64 = work_to(1.0) - rule.iter().map(|(l, w)| w * work_to(l)).sum::<f64>();
        let error = (end.strain_energy() / stored - 1.0).abs();
        // ten Gauss points on functions that turn over once: measured 5e-11
        assert!(error < 1e-9, "{id}: {error:.1e}");
    }
}

/// Castigliano: d(U + V)/dP = ∂V/∂P = −(position of the tip), at equilibrium; by five-point differences.
#[test]
fn the_derivative_of_the_energy_by_a_dead_force_is_the_position_of_the_tip() {
    let full = static_case("C4_nh_cantilever.json", "C4/3D");
    let solve = |force: Vector3<f64>| {
        let case = StaticCase { tip_force_dead: force.into(), tip_moment_dead: [0.0; 3], ..full.clone() };
        FINE.solve(&case.rod_with_degree(24)).unwrap()
    };
    let force = Vector3::from(full.tip_force_dead);
    let tip = solve(force).tip().pose.position;
    for axis in 0..3 {
        let step = 0.02;
        let energy = |multiple: f64| {
            let mut shifted = force;
            shifted[axis] += multiple * step;
            let solution = solve(shifted);
            solution.strain_energy() + solution.load_potential().unwrap()
        };
        let slope = (8.0 * (energy(1.0) - energy(-1.0)) - (energy(2.0) - energy(-2.0))) / (12.0 * step);
        let error = (slope + tip[axis]).abs() / full.length;
        // (step/P)⁴ = 1e-8 times the fifth derivative over 30; measured 5e-10
        assert!(error < 2e-9, "axis {axis}: {error:.1e}");
    }
}

type Arm = Body<Section<Circle<Linear>, NeoHookean>, Density>;

const LENGTH: f64 = 0.3;
const WEIGHT: Vector3<f64> = vector![2.0, -9.0, 1.0];

/// A tapered, pre-curved neo-Hookean arm under its weight and a dead force and moment.
fn arm(varying_reference: bool) -> Rod<Arm> {
    let taper = Linear { from: 0.02, to: 0.012, length: LENGTH };
    let section = Section::new(Circle::new(taper), NeoHookean::new(2e5, 3e5).unwrap()).unwrap();
    let body = Body::new(LENGTH, section).unwrap();
    let body = if varying_reference {
        body.with_varying_reference(|s: Dual64| {
            let one = Dual64::from_re(1.0);
            let zero = Dual64::from_re(0.0);
            Twist::from_array([s * 6.0 + 1.0, s * s * 20.0 - 2.0, one * 0.5, zero, zero, s * 0.1 + 1.0])
        })
        .unwrap()
    } else {
        body
    };
    let tip = DeadWrench::new(vector![0.05, -0.03, 0.02], vector![1.0, 0.6, -0.3]).unwrap();
    Rod::clamped(body.with_density(1100.0).unwrap(), Pose::identity())
        .with_load(Gravity::new(WEIGHT).unwrap())
        .with_tip_load(tip)
}

/// Pose and strain along s: R′ = R ω^, p′ = R ν, and Δξ′ = K⁻¹(ad_ξᵀ Ψ − f̄ − Ψ′).
#[derive(Clone, Copy)]
struct State {
    rotation: Matrix3<f64>,
    position: Vector3<f64>,
    strain: Strain,
}

impl State {
    fn slope(&self, body: &Arm, s: f64) -> State {
        let station = body.station(s);
        let response = body.section().respond(&station, &self.strain, Request::Rate).unwrap();
        let xi = station.reference.twist + self.strain;
        let line = body.line_mass(s).unwrap();
        let acceleration = self.rotation.tr_mul(&WEIGHT);
        let centre = vector![line.first[0], line.first[1], 0.0];
        let load = Wrench::new(centre.cross(&acceleration), acceleration * line.mass);
        let psi = response.wrench;
        // m′ = −ω×m − ν×n, n′ = −ω×n − f
        let moment = -xi.angular.cross(&psi.moment) - xi.linear.cross(&psi.force);
        let balance = Wrench::new(moment, -xi.angular.cross(&psi.force)) - load - response.wrench_rate;
        let strain = response.tangent.lu().solve(&balance.to_vector()).unwrap();
        State {
            rotation: self.rotation * hyperrod::lie::so3::hat(&xi.angular),
            position: self.rotation * xi.linear,
            strain: Strain::from_vector(&strain),
        }
    }

    fn plus(&self, slope: &State, h: f64) -> State {
        State {
            rotation: self.rotation + slope.rotation * h,
            position: self.position + slope.position * h,
            strain: self.strain + slope.strain * h,
        }
    }
}

/// An initial value problem in the strains, by the classical Runge–Kutta method from the solver's strain at the clamp: another formulation, where
/// taper and reference enter through Ψ′ instead of the section at every stage. It must arrive at the solver's tip.
#[test]
fn the_strong_form_integrated_from_the_clamp_arrives_at_the_solved_tip() {
    for varying_reference in [false, true] {
        let rod = arm(varying_reference);
        let solution = FINE.solve(&rod).unwrap();
        let body = rod.body();
        let mut state = State {
            rotation: Matrix3::identity(),
            position: Vector3::zeros(),
            strain: solution.base().strain,
        };
        let steps = 64 * 16;
        let h = LENGTH / steps as f64;
        for i in 0..steps {
            if i % 16 == 0 {
                let node = &solution.nodes()[i / 16];
                let station = body.station(node.s);
                let wrench = body.section().wrench(&station, &state.strain).unwrap();
                let errors = [
                    (state.position - node.pose.position).norm() / LENGTH,
                    (state.rotation - node.pose.rotation).norm(),
                    (wrench.moment - node.wrench.moment).norm() / solution.base().wrench.moment.norm(),
                    (wrench.force - node.wrench.force).norm() / solution.base().wrench.force.norm(),
                    (state.strain - node.strain).linear.norm(),
                    (state.strain - node.strain).angular.norm() * LENGTH,
                ];
                let worst = errors.into_iter().fold(0.0, f64::max);
                // (h κ)⁴ / 120 with h = 3e-4 and κ up to 15 is 3e-12; measured 7e-12
                assert!(worst < 5e-11, "varying reference {varying_reference}, s = {}: {errors:?}", node.s);
            }
            let s = i as f64 * h;
            let a = state.slope(body, s);
            let b = state.plus(&a, 0.5 * h).slope(body, s + 0.5 * h);
            let c = state.plus(&b, 0.5 * h).slope(body, s + 0.5 * h);
            let d = state.plus(&c, h).slope(body, s + h);
            state = state.plus(&a, h / 6.0).plus(&b, h / 3.0).plus(&c, h / 3.0).plus(&d, h / 6.0);
        }
        let tip = solution.tip();
        assert!((state.position - tip.pose.position).norm() < 5e-11 * LENGTH);
    }
}
