//! Loads that turn with the rod, against a march from the tip, where the wrench is known.

use hyperrod::load::{FollowerLoad, FollowerWrench};
use hyperrod::section::Stiffness;
use hyperrod::{Body, Pose, Rod, Statics, Wrench};
use nalgebra::{Vector3, vector};

use super::oracle::marched_from_tip;

const STIFFNESS: [f64; 6] = [1.0, 1.0, 2.0 / 3.0, 1e5, 1e5, 3e5];

fn body() -> Body<Stiffness> {
    Body::new(1.0, Stiffness::diagonal(STIFFNESS).unwrap()).unwrap()
}

#[test]
fn a_follower_force_to_20() {
    for load in [1.0, 5.0, 10.0, 15.0, 20.0] {
        let force = vector![load, 0.0, 0.0];
        let rod = Rod::clamped(body(), Pose::identity())
            .with_tip_load(FollowerWrench::new(Vector3::zeros(), force).unwrap());
        let solution = Statics::to(1e-8).solve(&rod).unwrap_or_else(|e| panic!("{load}: {e}"));
        let tip = Wrench::new(Vector3::zeros(), force);
        let exact = marched_from_tip(STIFFNESS, 1.0, tip, Wrench::zero(), 20_000);
        let error = (solution.tip().pose.position - exact.position).norm();
        assert!(error < 3e-8, "{load}: {error:e}");
    }
}

#[test]
fn a_distributed_follower_load_to_25() {
    // published for a rod with some shear, which adds up to 7e-4: sideways .1251 and .4734, along .9910 and −.4042
    for (load, published) in [(1.0, Some([0.1251, 0.9910])), (10.0, None), (25.0, Some([0.4734, -0.4042]))] {
        let force = vector![load, 0.0, 0.0];
        let push = FollowerLoad::new(Wrench::new(Vector3::zeros(), force)).unwrap();
        let rod = Rod::clamped(body(), Pose::identity()).with_load(push);
        let solution = Statics::to(1e-8).solve(&rod).unwrap_or_else(|e| panic!("{load}: {e}"));
        let per_length = Wrench::new(Vector3::zeros(), force);
        let exact = marched_from_tip(STIFFNESS, 1.0, Wrench::zero(), per_length, 20_000);
        let tip = solution.tip().pose.position;
        let error = (tip - exact.position).norm();
        assert!(error < 3e-8, "{load}: {error:e}");
        if let Some([x, z]) = published {
            assert!((tip.x - x).abs() < 2e-2 * load.sqrt() && (tip.z - z).abs() < 2e-2, "{load}: {tip}");
        }
    }
}

#[test]
fn a_distributed_dead_load_to_25() {
    // published for a rod with some shear
    for (load, [x, z]) in [(1.0, [0.1241, 0.9912]), (25.0, [0.8568, 0.3851])] {
        let gravity = hyperrod::load::Gravity::new(vector![load, 0.0, 0.0]).unwrap();
        let heavy = body().with_mass_per_length(1.0).unwrap();
        let solution =
            Statics::to(1e-8).solve(&Rod::clamped(heavy, Pose::identity()).with_load(gravity)).unwrap();
        let tip = solution.tip().pose.position;
        assert!((tip.x - x).abs() < 2e-2 && (tip.z - z).abs() < 2e-2, "{load}: {tip}");
    }
}
