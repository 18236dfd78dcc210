//! Laws that give way: failures that say what and where, or answers that say so.

use hyperrod::load::DeadWrench;
use hyperrod::material::{NeoHookean, SaintVenantKirchhoff};
use hyperrod::section::{Circle, Resultant, Resultants, Section};
use hyperrod::solve::{Reason, Stability};
use hyperrod::{Body, Error, Pose, Rod, Scalar, Statics, Strain};
use nalgebra::vector;

/// A fibre with two wells, U = ½ k (e² − d²)²/(4 d²) in the extension about the first well, stiff in all else.
struct TwoPhases;

impl Resultant for TwoPhases {
    fn energy<D: Scalar>(&self, strain: &Strain<D>, _s: D) -> D {
        let e = strain.linear.z;
        let bent = strain.angular.dot(&strain.angular);
        let shear = strain.linear.x * strain.linear.x + strain.linear.y * strain.linear.y;
        // wells at e = 0 and e = 1, the force has a maximum between
        let well = e * e * (e - 1.0) * (e - 1.0);
        well * 50.0 + bent * 0.5 + shear * 50.0
    }
}

#[test]
fn a_law_that_loses_its_convexity_jumps_to_its_other_phase_or_says_where_it_softens() {
    // n = 100 e (1 − e)(1 − 2e): the largest, 100/(6√3) = 9.62, at e = (1 − 1/√3)/2
    for pull in [5.0, 9.0, 9.6, 9.7, 12.0, 20.0] {
        let load = DeadWrench::force(vector![0.0, 0.0, pull]).unwrap();
        let rod = Rod::clamped(Body::new(1.0, Resultants(TwoPhases)).unwrap(), Pose::identity())
            .with_tip_load(load);
        match Statics::to(1e-8).solve(&rod) {
            Ok(solution) => {
                let e = solution.tip().strain.linear.z;
                let force = 100.0 * e * (1.0 - e) * (1.0 - 2.0 * e);
                assert!((force - pull).abs() < 1e-5, "{pull}: {force}");
                assert!(!solution.report().stability.is_unstable());
                // convex only outside the two turning points
                assert!((e - 0.5).abs() > 0.5 / 3.0_f64.sqrt());
            }
            Err(failure) => match &failure.reason {
                Reason::Unstable { stability: Stability::Softening { s } } => {
                    assert!((0.0..=1.0).contains(s))
                }
                // where the force has its maximum
                Reason::LimitPoint { load_factor } => {
                    let most = 100.0 / (6.0 * 3.0_f64.sqrt());
                    assert!((load_factor * pull / most - 1.0).abs() < 1e-6, "{pull}: {load_factor}");
                }
                Reason::IterationLimit { .. } | Reason::Singular { .. } | Reason::NoAdmissibleStep { .. } => {
                }
                reason => panic!("{pull}: {reason}"),
            },
        }
    }
}

#[test]
fn a_law_without_a_barrier_is_refused_where_j_reaches_zero() {
    // (λ + 2μ) A (c³ − c)/2 has its least value −(λ + 2μ) A/(3√3) at c = 1/√3: beyond that a dead push has no equilibrium
    let (mu, lambda, r) = (1e5, 1e5, 0.01_f64);
    let bearable = (lambda + 2.0 * mu) * std::f64::consts::PI * r * r / (3.0 * 3.0_f64.sqrt());
    let rod = |push: f64| {
        let section = Section::new(Circle::new(r), SaintVenantKirchhoff::new(mu, lambda).unwrap()).unwrap();
        let load = DeadWrench::force(vector![0.0, 0.0, -push]).unwrap();
        // short enough not to buckle first
        Rod::clamped(Body::new(0.002, section).unwrap(), Pose::identity()).with_tip_load(load)
    };
    let fine = Statics::to(1e-6).solve(&rod(0.6 * bearable)).unwrap();
    assert!(fine.tip().strain.linear.z > 1.0 / 3.0_f64.sqrt() - 1.0);
    let failure = Statics::to(1e-6).solve(&rod(1.5 * bearable)).unwrap_err();
    assert!(failure.last.is_some() && !failure.report.iterations.is_empty(), "{failure}");
    match &failure.reason {
        Reason::NoAdmissibleStep { error, .. } => {
            assert!(matches!(error, Error::Inadmissible { quantity: "J", .. }), "{error}");
        }
        Reason::LimitPoint { load_factor } => assert!((1.5 * load_factor - 1.0).abs() < 1e-6, "{failure}"),
        _ => {}
    }
}

#[test]
fn a_law_with_a_barrier_bears_any_push() {
    for push in [1.0, 1e2, 1e4] {
        let (mu, lambda, r) = (1e5, 1e5, 0.01_f64);
        let section = Section::new(Circle::new(r), NeoHookean::new(mu, lambda).unwrap()).unwrap();
        let force = push * mu * std::f64::consts::PI * r * r;
        let load = DeadWrench::force(vector![0.0, 0.0, -force]).unwrap();
        let rod = Rod::clamped(Body::new(1e-4, section).unwrap(), Pose::identity()).with_tip_load(load);
        let options = Statics { accept_unstable: true, ..Statics::to(1e-6) };
        match options.solve(&rod) {
            Ok(solution) => {
                let c = 1.0 + solution.tip().strain.linear.z;
                let bears = mu * (c - 1.0 / c) + lambda * c.ln() / c;
                assert!((bears / (push * mu) + 1.0).abs() < 1e-5, "{push}: {bears}");
            }
            Err(failure) => assert!(failure.last.is_some(), "{push}: {failure}"),
        }
    }
}
