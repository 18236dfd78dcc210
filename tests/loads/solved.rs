//! Solved rods under the loads that depend on the pose of the section in other ways than a dead one.

use hyperrod::load::*;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section, Stiffness};
use hyperrod::{Body, Pose, Rod, StaticSolution, Wrench};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6, vector};

use super::fixed_mesh::STATICS;
use super::shooting::{Shooting, State, ad_transpose, hat, join};

const LENGTH: f64 = 0.5;
const K: [f64; 6] = [4e-2, 5e-2, 3e-2, 40.0, 45.0, 120.0];

fn stiffness() -> Matrix6<f64> {
    Matrix6::from_diagonal(&Vector6::from(K))
}

type Bar = Body<Stiffness>;

fn rod() -> Rod<Bar> {
    Rod::clamped(Body::new(LENGTH, Stiffness::diagonal(K).unwrap()).unwrap(), Pose::identity())
}

fn difference(solution: &StaticSolution, position: &Vector3<f64>, rotation: &Matrix3<f64>) -> f64 {
    let pose = &solution.tip().pose;
    ((pose.position - position).norm() / LENGTH).max((pose.rotation - rotation).norm())
}

/// K Δξ′ = ad_ξᵀ K Δξ − f̄(s, R, p) by [`Shooting`], with a wrench in the body frame on the tip.
fn shoot(load: &dyn Fn(f64, &State) -> Vector6<f64>, tip: Vector6<f64>, guess: Vector6<f64>) -> State {
    let slope = |s: f64, state: &State, _: usize| {
        let balance = ad_transpose(state, &(stiffness() * state.strain)) - load(s, state);
        stiffness().lu().solve(&balance).unwrap()
    };
    let tip = |state: &State| stiffness() * state.strain - tip;
    let jump = |_: usize, state: &State| state.strain;
    Shooting { pieces: &[0.0, LENGTH], steps: 1500, slope: &slope, jump: &jump, tip: &tip }.solve(guess)
}

#[test]
fn distributed_follower_and_place_dependent_loads_meet_a_shooting_solution() {
    let wrench = |s: f64| Wrench::new(vector![0.02, 0.05 * s, -0.03], vector![0.9 - s, 0.4 + s * s, -0.3]);
    let springs = vector![3.0, 2.0, 1.0];
    let rest = |s: f64| vector![0.1 * s, 0.0, 0.9 * s];
    let (moment, force) = (vector![0.01, -0.02, 0.03], vector![0.2, 0.1, -0.1]);
    let tip = join(moment, force);
    let rod = || rod().with_tip_load(FollowerWrench::new(moment, force).unwrap());
    let flow = vector![0.4, -0.2, 0.1];

    type Given<'a> = Box<dyn Fn(f64, &State) -> Vector6<f64> + 'a>;
    let cases: [(&str, Rod<Bar>, Given<'_>); 4] = [
        ("follower tip alone", rod(), Box::new(|_, _| Vector6::zeros())),
        (
            "follower",
            rod().with_load(FollowerLoad::varying(wrench)),
            Box::new(move |s, _| wrench(s).to_vector()),
        ),
        (
            "springs",
            rod().with_load(ElasticFoundation::new(springs, rest).unwrap()),
            Box::new(move |s, state: &State| {
                let force = -springs.component_mul(&(state.position - rest(s)));
                join(Vector3::zeros(), state.rotation.transpose() * force)
            }),
        ),
        (
            "current and dead load",
            rod()
                .with_load(distributed(move |_s, pose: &Pose<LoadDual>| {
                    use num_dual::DualNum;
                    let flow = pose.rotation.tr_mul(&flow.map(LoadDual::from));
                    let across = vector![flow.x, flow.y, LoadDual::from(0.0)];
                    let speed = (flow.x * flow.x + flow.y * flow.y).sqrt();
                    Wrench::new(Vector3::zeros(), across * (speed * 3.0))
                }))
                .with_load(DeadLoad::varying(wrench)),
            Box::new(move |s, state: &State| {
                let flow = state.rotation.transpose() * flow;
                let across = vector![flow.x, flow.y, 0.0];
                let w = wrench(s);
                let turned = state.rotation.transpose();
                join(turned * w.moment, turned * w.force + across * (3.0 * across.norm()))
            }),
        ),
    ];
    for (name, rod, load) in cases {
        let solution = STATICS.solve(&rod).unwrap_or_else(|failure| panic!("{name}: {failure}"));
        let state = shoot(&load, tip, solution.base().strain.to_vector() * 1.02);
        let error = difference(&solution, &state.position, &state.rotation);
        // Runge–Kutta: (h × 15 1/m)⁴/120 with h = 0.3 mm; order six with 64 elements is below
        assert!(error < 1e-11, "{name}: {error:.1e}");
    }
}

/// A wrench that turns with the tip is known there: backwards from the tip nothing has to be searched for.
#[test]
fn a_rod_under_a_follower_tip_wrench_is_an_initial_value_problem_from_its_tip() {
    let (moment, force) = (vector![0.03, -0.02, 0.04], vector![0.5, 0.2, -0.3]);
    let solution = STATICS.solve(&rod().with_tip_load(FollowerWrench::new(moment, force).unwrap())).unwrap();
    let compliance = stiffness().try_inverse().unwrap();
    // g and Λ from the tip, where g = 1: g′ = g ξ^, Λ′ = ad_ξᵀ Λ
    let slope = |(rotation, _, wrench): &(Matrix3<f64>, Vector3<f64>, Vector6<f64>)| {
        let state = State { rotation: *rotation, position: Vector3::zeros(), strain: compliance * wrench };
        (rotation * hat(&state.omega()), rotation * state.nu(), ad_transpose(&state, wrench))
    };
    let plus = |a: &(Matrix3<f64>, Vector3<f64>, Vector6<f64>),
                b: &(Matrix3<f64>, Vector3<f64>, Vector6<f64>),
                h: f64| { (a.0 + b.0 * h, a.1 + b.1 * h, a.2 + b.2 * h) };
    let mut state = (Matrix3::identity(), Vector3::zeros(), join(moment, force));
    let steps = 2000;
    let h = -LENGTH / steps as f64;
    for _ in 0..steps {
        let a = slope(&state);
        let b = slope(&plus(&state, &a, 0.5 * h));
        let c = slope(&plus(&state, &b, 0.5 * h));
        let d = slope(&plus(&state, &c, h));
        for (k, weight) in [(&a, 1.0), (&b, 2.0), (&c, 2.0), (&d, 1.0)] {
            state = plus(&state, k, weight * h / 6.0);
        }
    }
    // the base seen from the tip
    let (rotation, position) = (state.0.transpose(), -(state.0.transpose() * state.1));
    let error = difference(&solution, &position, &rotation);
    assert!(error < 1e-12, "{error:.1e}");
    let base = (solution.base().wrench.to_vector() - state.2).norm() / state.2.norm();
    assert!(base < 1e-12, "{base:.1e}");
}

#[test]
fn a_rod_as_dense_as_the_fluid_around_it_stays_straight() {
    let acceleration = vector![3.0, 1.0, -9.0];
    let arm = |fluid: f64| {
        let section = Section::new(Circle::new(0.01), LinearElastic::new(1e6, 4e5).unwrap()).unwrap();
        let body = Body::new(0.5, section).unwrap().with_density(1030.0).unwrap();
        let rod = Rod::clamped(body, Pose::identity())
            .with_load(Gravity::new(acceleration).unwrap())
            .with_load(Buoyancy::new(fluid, acceleration).unwrap());
        STATICS.solve(&rod).unwrap()
    };
    let floating = arm(1030.0);
    let straight = floating.tip().pose.position - Vector3::z() * 0.5;
    assert!(straight.norm() < 1e-15, "{straight:?}");
    assert!(floating.load_potential().unwrap().abs() < 1e-12);
    assert!((arm(0.0).tip().pose.position - Vector3::z() * 0.5).norm() > 0.01);
}
