//! Slenderness and large dead loads.

use hyperrod::load::{DeadWrench, FollowerWrench, Gravity};
use hyperrod::section::Stiffness;
use hyperrod::solve::Stability;
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics};
use nalgebra::vector;

use super::oracle::{complete, elastica, root};

/// A round rod of EI = 1, ν = ½, with L/r = `slenderness`; no shear, no extension at all for an infinite one.
pub fn round(length: f64, slenderness: f64) -> Body<Stiffness> {
    let axial = 4.0 * (slenderness / length).powi(2);
    let axial = axial.min(1e100);
    Body::new(length, Stiffness::diagonal([1.0, 1.0, 2.0 / 3.0, axial / 3.0, axial / 3.0, axial]).unwrap())
        .unwrap()
}

/// Λ·ξ − U, which is the same at every s of a uniform linear rod with loads at its ends, over its largest part.
fn drift(solution: &StaticSolution) -> f64 {
    let values = solution.nodes().iter().map(|node| {
        let wrench = node.wrench;
        let strained = 0.5 * node.strain.pair(&wrench);
        (strained + wrench.force.z, strained.abs().max(wrench.force.norm()))
    });
    let (first, mut most, mut off) = (values.clone().next().unwrap().0, 0.0_f64, 0.0_f64);
    for (value, size) in values {
        most = most.max(size);
        off = off.max((value - first).abs());
    }
    off / most
}

#[test]
fn slenderness_from_1e2_to_1e6_changes_nothing_but_the_extension() {
    let exact = elastica(10.0);
    for slenderness in [1e2, 1e3, 1e4, 1e5, 1e6] {
        let pull = DeadWrench::force(vector![10.0, 0.0, 0.0]).unwrap();
        let rod = Rod::clamped(round(1.0, slenderness), Pose::identity()).with_tip_load(pull);
        let solution = Statics::to(1e-10).solve(&rod).unwrap_or_else(|e| panic!("{slenderness:e}: {e}"));
        let tip = solution.tip().pose.position;
        let error = (tip.x - exact[0]).abs().max((tip.z - exact[1]).abs());
        // strains of P/EA = 10/(4 (L/r)²) and P/GA, thrice that, act over the length; and three times the accuracy
        let most = 10.0 * slenderness.powi(-2) + 3e-10;
        assert!(error < most, "{slenderness:e}: {error:e}");
        // the axial force has its own digits
        assert!((solution.base().wrench.force - vector![10.0, 0.0, 0.0]).norm() < 1e-8);
    }
}

#[test]
fn an_inextensible_rod_is_the_elastica_to_1e_12() {
    for alpha in [0.1, 1.0, 3.0, 10.0, 30.0] {
        let pull = DeadWrench::force(vector![alpha, 0.0, 0.0]).unwrap();
        let rod = Rod::clamped(round(1.0, 1e60), Pose::identity()).with_tip_load(pull);
        let options = Statics { elements: 128, order: hyperrod::solve::Order::Six, ..Statics::default() };
        let solution = options.solve(&rod).unwrap();
        let (tip, exact) = (solution.tip().pose.position, elastica(alpha));
        assert!(
            (tip.x - exact[0]).abs() < 1e-12 && (tip.z - exact[1]).abs() < 1e-12,
            "{alpha}: {tip} {exact:?}"
        );
    }
}

#[test]
fn loads_to_1e4_times_the_stiffness_from_a_straight_start() {
    for alpha in [1.0, 10.0, 100.0, 1e3, 1e4] {
        let pull = DeadWrench::force(vector![alpha, 0.0, 0.0]).unwrap();
        let rod = Rod::clamped(round(1.0, 1e60), Pose::identity()).with_tip_load(pull);
        let solution = Statics::to(1e-8).solve(&rod).unwrap_or_else(|e| panic!("{alpha:e}: {e}"));
        let (tip, exact) = (solution.tip().pose.position, elastica(alpha));
        let error = (tip.x - exact[0]).abs().max((tip.z - exact[1]).abs());
        assert!(error < 1e-8, "{alpha:e}: {error:e}");
        assert!(!solution.report().stability.is_unstable());
    }
}

#[test]
fn oblique_loads_to_1e4_with_an_end_moment() {
    for alpha in [1.0, 10.0, 100.0, 1e3, 1e4] {
        let load = DeadWrench::new(vector![3.0, -2.0, 4.0], vector![0.6, 0.5, -0.4] * alpha).unwrap();
        let rod = Rod::clamped(round(1.0, 1e3), Pose::identity()).with_tip_load(load);
        let solution = Statics::to(1e-7).solve(&rod).unwrap_or_else(|e| panic!("{alpha:e}: {e}"));
        // the first integral, and the moment about the axis of a round rod, are constant; wrenches are asked to 1e-7 of the largest
        let drift = drift(&solution);
        assert!(drift < 1e-5, "{alpha:e}: {drift:e}");
        let [a, b] = [solution.base(), solution.tip()].map(|node| node.wrench.moment.z);
        assert!((a - b).abs() < 1e-5 * alpha.max(5.0), "{alpha:e}: {a} {b}");
    }
}

#[test]
fn a_helix_of_ten_coils_from_a_straight_start() {
    // ω = (0, κ, τ) is an equilibrium with n = c ω, c ω × ν + ω × m = 0: c = (GJ − EI) τ κ / (κ ν_z − τ ν_y)
    let stiffness = [1.0, 1.0, 2.0 / 3.0, 1e6, 1e6, 1e6];
    let turns = 10.0 * std::f64::consts::TAU;
    let (kappa, tau) = (turns * 0.8, turns * 0.6);
    let c = {
        let mut c = 0.0;
        for _ in 0..50 {
            let (shear, stretch) = (c * kappa / stiffness[4], 1.0 + c * tau / stiffness[5]);
            c = (stiffness[2] - stiffness[1]) * tau * kappa / (kappa * stretch - tau * shear);
        }
        c
    };
    let omega = vector![0.0, kappa, tau];
    let (moment, force) = (vector![0.0, kappa, stiffness[2] * tau], omega * c);
    let body = Body::new(1.0, Stiffness::diagonal(stiffness).unwrap()).unwrap();
    let rod = Rod::clamped(body, Pose::identity()).with_tip_load(FollowerWrench::new(moment, force).unwrap());
    let solution = Statics::to(1e-8).solve(&rod).unwrap();
    let xi = hyperrod::Twist::new(omega, vector![0.0, c * kappa / 1e6, 1.0 + c * tau / 1e6]);
    let exact = hyperrod::lie::se3::exp(&xi);
    let error = (solution.tip().pose.position - exact.position).norm();
    assert!(error < 3e-8, "{error:e}");
    assert!((solution.tip().pose.rotation - exact.rotation).norm() < 1e-7);
}

#[test]
fn dead_compression_to_300_times_critical() {
    // √P L = K(k): the tip hangs at 2E/K − 1
    for ratio in [1.5, 10.0, 100.0, 300.0] {
        let load = ratio * std::f64::consts::PI.powi(2) / 4.0;
        let push = DeadWrench::force(vector![0.0, 0.0, -load]).unwrap();
        let rod = Rod::clamped(round(1.0, 1e60), Pose::identity()).with_tip_load(push);
        let log = root(-100.0, -1e-12, |log: f64| complete(log.exp())[0] - load.sqrt());
        let [k, e] = complete(log.exp());
        let exact = 2.0 * e / k - 1.0;
        for asked in [1e-8, 1e-9, 1e-11] {
            let solution =
                Statics::to(asked).solve(&rod).unwrap_or_else(|e| panic!("{ratio}, {asked:e}: {e}"));
            let tip = solution.tip().pose.position.z;
            assert!((tip - exact).abs() < asked, "{ratio}, {asked:e}: {tip} {exact}");
            assert!(matches!(solution.report().stability, Stability::Index { unstable: 0, .. }));
        }
    }
}

/// The tip of EI θ″ = −w (L − s) cos θ, θ(0) = 0, θ′(L) = 0, θ from the horizontal, by second differences and Richardson's extrapolation.
fn heavy(w: f64) -> [f64; 2] {
    let tip = |n: usize, start: &[f64]| {
        let h = 1.0 / n as f64;
        let mut theta: Vec<f64> = (0..=n).map(|i| start[i * (start.len() - 1) / n]).collect();
        for _ in 0..200 {
            // tridiagonal Newton step, a ghost node beyond the tip
            let (mut diagonal, mut rhs) = (vec![0.0; n + 1], vec![0.0; n + 1]);
            for i in 1..=n {
                let load = w * (1.0 - i as f64 * h) * h * h;
                let next = if i < n { theta[i + 1] } else { theta[n - 1] };
                rhs[i] = -(theta[i - 1] - 2.0 * theta[i] + next + load * theta[i].cos());
                diagonal[i] = -2.0 - load * theta[i].sin();
            }
            let lower = |i: usize| if i == n { 2.0 } else { 1.0 };
            for i in 2..=n {
                let factor = lower(i) / diagonal[i - 1];
                diagonal[i] -= factor;
                rhs[i] -= factor * rhs[i - 1];
            }
            let mut step = vec![0.0; n + 2];
            for i in (1..=n).rev() {
                step[i] = (rhs[i] - step[i + 1]) / diagonal[i];
            }
            let largest = step.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let damped = if largest > 0.3 { 0.3 / largest } else { 1.0 };
            (1..=n).for_each(|i| theta[i] += damped * step[i]);
            if largest < 1e-13 {
                break;
            }
        }
        let along =
            |f: fn(f64) -> f64| h * (0..n).map(|i| 0.5 * (f(theta[i]) + f(theta[i + 1]))).sum::<f64>();
        ([along(f64::cos), along(f64::sin)], theta)
    };
    let (coarse, start) = tip(4000, &[0.0; 4001]);
    let fine_start: Vec<f64> = (0..=8000).map(|i| 0.5 * (start[i / 2] + start[i.div_ceil(2)])).collect();
    let (fine, _) = tip(8000, &fine_start);
    std::array::from_fn(|i| fine[i] + (fine[i] - coarse[i]) / 3.0)
}

#[test]
fn a_heavy_elastica_to_1000() {
    for weight in [1.0, 10.0, 100.0, 1000.0] {
        let body = round(1.0, 1e60).with_mass_per_length(weight).unwrap();
        let gravity = Gravity::new(vector![-1.0, 0.0, 0.0]).unwrap();
        let rod = Rod::clamped(body, Pose::identity()).with_load(gravity);
        let solution = Statics::to(1e-8).solve(&rod).unwrap_or_else(|e| panic!("{weight}: {e}"));
        let (tip, [z, x]) = (solution.tip().pose.position, heavy(weight));
        // second differences extrapolated: (w h²)² at most 1e-9
        assert!((tip.z - z).abs() < 1e-7 && (tip.x.abs() - x.abs()).abs() < 1e-7, "{weight}: {tip} {z} {x}");
    }
}
