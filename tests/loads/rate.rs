//! Loads that depend on the strain and its rate along the rod, in a solve.

use hyperrod::load::{DeadWrench, FollowerWrench, Gravity, Load, LoadWrench, RateLoad};
use hyperrod::material::NeoHookean;
use hyperrod::rod::SectionState;
use hyperrod::section::{Circle, CrossSection, Linear, Section, Stiffness, Tendon};
use hyperrod::solve::dynamics::{Dynamics, Scene, Start};
use hyperrod::solve::{Order, Stability, Statics};
use hyperrod::{Body, Pose, Result, Rod, Strain, Twist, Wrench};
use nalgebra::{Matrix3, Matrix6, Vector3, vector};

use crate::shooting::hat;

const LENGTH: f64 = 0.3;

fn nothing() -> LoadWrench {
    LoadWrench { wrench: Wrench::zero(), tangent: Matrix6::zeros(), potential: None }
}

/// Numbers without any symmetry in Ā, and a B̄ of strain, place and pose.
struct Somehow(f64);

impl<B: ?Sized> Load<B> for Somehow {
    fn at(&self, _body: &B, _s: f64, _pose: &Pose) -> Result<LoadWrench> {
        Ok(nothing())
    }

    fn rate(&self, _body: &B, s: f64, pose: &Pose, xi: &Twist) -> Result<Option<RateLoad>> {
        let size: [f64; 6] = [4e-3, 3e-3, 2e-3, 2.0, 3.0, 4.0];
        let a_bar = Matrix6::from_fn(|r, c| {
            let wave = (1.0 + 2.3 * r as f64 + 0.7 * c as f64 + 3.0 * xi.linear.x + 0.1 * xi.angular.y).sin();
            self.0 * wave * (size[r] * size[c]).sqrt()
        });
        let along = pose.rotation.tr_mul(&vector![1.0, 0.3, 0.0]);
        let force = xi.angular.cross(&xi.linear) * 0.2 + along * (2.0 * s);
        Ok(Some(RateLoad { a_bar, b_bar: Wrench::new(xi.angular * 2e-3, force) * self.0 }))
    }
}

type Arm = Body<Section<Circle<Linear>, NeoHookean>, hyperrod::body::Density>;

/// Tapered, heavy, pulled aside.
fn arm(size: f64) -> Rod<Arm> {
    let taper = Linear { from: 0.02, to: 0.012, length: LENGTH };
    let section = Section::new(Circle::new(taper), NeoHookean::new(2e5, 3e5).unwrap()).unwrap();
    let body = Body::new(LENGTH, section).unwrap().with_density(1100.0).unwrap();
    Rod::clamped(body, Pose::identity())
        .with_load(Gravity::new(vector![2.0, -9.0, 1.0]).unwrap())
        .with_load(Somehow(size))
        .with_tip_load(DeadWrench::force(vector![1.0, 0.6, -0.3]).unwrap())
}

/// Position, rotation and strain at the tip by RK4 of the strong form from the base.
fn march(rod: &Rod<Arm>, base: Strain, steps: usize) -> (Vector3<f64>, Matrix3<f64>, Strain) {
    let h = LENGTH / steps as f64;
    let slope = |s: f64, (p, r, strain): &(Vector3<f64>, Matrix3<f64>, Strain)| {
        let at = SectionState { s, pose: Pose::new(*r, *p), strain: *strain, motion: None };
        let xi = rod.body().station(s).reference.twist + *strain;
        (r * xi.linear, r * hat(&xi.angular), rod.strain_rate(&at).unwrap().strain)
    };
    let mut state = (Vector3::zeros(), Matrix3::identity(), base);
    for i in 0..steps {
        let s = i as f64 * h;
        let plus = |k: &(Vector3<f64>, Matrix3<f64>, Strain), f: f64| {
            (state.0 + k.0 * f, state.1 + k.1 * f, state.2 + k.2 * f)
        };
        let k1 = slope(s, &state);
        let k2 = slope(s + 0.5 * h, &plus(&k1, 0.5 * h));
        let k3 = slope(s + 0.5 * h, &plus(&k2, 0.5 * h));
        let k4 = slope(s + h, &plus(&k3, h));
        let w = h / 6.0;
        state.0 += (k1.0 + k2.0 * 2.0 + k3.0 * 2.0 + k4.0) * w;
        state.1 += (k1.1 + k2.1 * 2.0 + k3.1 * 2.0 + k4.1) * w;
        state.2 += (k1.2 + k2.2 * 2.0 + k3.2 * 2.0 + k4.2) * w;
    }
    state
}

#[test]
fn a_solve_under_a_load_on_the_rate_of_strain_is_the_strong_form_marched_and_keeps_its_order() {
    let solve = |order: Order, elements: usize| {
        let statics = Statics { elements, order, tolerance: 1e-11, ..Statics::default() };
        statics.solve(&arm(0.3)).unwrap()
    };
    let fine = solve(Order::Six, 48);
    let (position, rotation, strain) = march(&arm(0.3), fine.base().strain, 2000);
    let tip = fine.tip();
    // RK4 of 2000 steps leaves 1e-11 or so, the elements 1e-10; strains of a bending of 1/m
    let error = (tip.pose.position - position).norm() / LENGTH + (tip.pose.rotation - rotation).norm();
    assert!(error < 1e-8, "{error:.1e}");
    assert!((tip.strain - strain).to_vector().norm() < 1e-6, "{:?} {strain:?}", tip.strain);
    // it does something
    let without = Statics::default().solve(&arm(0.0)).unwrap();
    assert!((without.tip().pose.position - position).norm() > 0.02 * LENGTH);
    assert_eq!(fine.report().stability, Stability::Unknown);
    for (order, p, meshes) in
        [(Order::Two, 2.0, [32, 64]), (Order::Four, 4.0, [12, 24]), (Order::Six, 6.0, [8, 16])]
    {
        let [coarse, finer] =
            meshes.map(|n| (solve(order, n).tip().pose.position - tip.pose.position).norm());
        let observed = (coarse / finer).log2();
        assert!(observed > p - 0.2, "{order:?}: {coarse:.1e} {finer:.1e}, order {observed:.2}");
    }
    // the derivative of the load is one: Newton's steps end by falling to nothing at once
    let steps: Vec<f64> = fine.report().iterations.iter().map(|i| i.step).collect();
    let last = &steps[steps.len() - 3..];
    assert!(last[1] < 1e-2 * last[0] && last[2] < 1e-2 * last[1], "{steps:?}");
}

/// A tendon taken as (Ā, B̄) on the rod without it, from the difference of the two sections.
struct AsLoad {
    with: hyperrod::section::Actuated<Stiffness>,
    without: Stiffness,
}

impl Load<Body<Stiffness>> for AsLoad {
    fn at(&self, _body: &Body<Stiffness>, _s: f64, _pose: &Pose) -> Result<LoadWrench> {
        Ok(nothing())
    }

    fn rate(&self, body: &Body<Stiffness>, s: f64, _pose: &Pose, xi: &Twist) -> Result<Option<RateLoad>> {
        let at = body.station(s);
        let strain = Strain::from_vector(&(*xi - at.reference.twist).to_vector());
        let request = hyperrod::material::Request::Rate;
        let (with, without) =
            (self.with.respond(&at, &strain, request)?, self.without.respond(&at, &strain, request)?);
        let (a_bar, pull) = (without.tangent - with.tangent, with.wrench - without.wrench);
        let b_bar = pull.ad_transpose(xi) - (with.wrench_rate - without.wrench_rate);
        Ok(Some(RateLoad { a_bar, b_bar }))
    }
}

#[test]
fn a_tendon_as_a_load_on_the_rate_of_strain_is_the_tendon_as_an_actuator() {
    let k = Stiffness::diagonal([3.9e-3, 4.5e-3, 2.6e-3, 52.0, 50.0, 157.0]).unwrap();
    let arm = vector![6e-3, 4e-3, 0.0];
    let with = || k.with_actuator(Tendon::new([arm.x, arm.y], 1.5).unwrap());
    let push = DeadWrench::force(vector![0.02, -0.03, 0.01]).unwrap();
    let statics = Statics { elements: 24, order: Order::Six, tolerance: 1e-11, ..Statics::default() };
    let actuated = Body::new(LENGTH, with()).unwrap();
    let actuated = statics.solve(&Rod::clamped(actuated, Pose::identity()).with_tip_load(push)).unwrap();
    // at its end the tendon pulls along itself
    let strain = actuated.tip().strain;
    let along = (strain.linear + Vector3::z() + strain.angular.cross(&arm)).normalize() * -1.5;
    let end = FollowerWrench::new(arm.cross(&along), along).unwrap();
    let load = AsLoad { with: with(), without: k };
    let bare = Rod::clamped(Body::new(LENGTH, k).unwrap(), Pose::identity());
    let bare = statics.solve(&bare.with_load(load).with_tip_load(push).with_tip_load(end)).unwrap();
    for (a, b) in actuated.nodes().iter().zip(bare.nodes()) {
        let error = (a.pose.position - b.pose.position).norm() / LENGTH;
        // two discretisations of 24 elements of order 6, and Newton's steps of 1e-11
        assert!(error < 1e-9, "at {}: {error:.1e}", a.s);
    }
    assert!(actuated.tip().pose.position.xy().norm() > 0.2 * LENGTH);
}

#[test]
fn a_load_on_the_rate_of_strain_is_refused_where_it_is_not_modelled() {
    let rod = arm(0.3);
    let scene = Scene::new(&rod);
    let error =
        Dynamics::default().start(&scene, &Start::at_rest()).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(error.contains("a load that depends on the rate of the strain"), "{error}");
    let stiff = Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4]).unwrap();
    let body = Body::new(LENGTH, stiff).unwrap().with_constraint(hyperrod::body::Constraint::kirchhoff());
    let rod = Rod::clamped(body, Pose::identity()).with_load(Somehow(1.0));
    let error = Statics::default().solve(&rod).unwrap_err().to_string();
    assert!(error.contains("number of strains that are fixed is 3"), "{error}");
}
