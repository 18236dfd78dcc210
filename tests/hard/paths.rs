//! Snap-through, followed by arc length.

use hyperrod::load::DeadWrench;
use hyperrod::rod::{Freedom, Support};
use hyperrod::section::Stiffness;
use hyperrod::solve::{Order, PathEnd, PathEventKind, PathOptions};
use hyperrod::{Body, Rod, Statics, Twist};
use nalgebra::vector;

/// A shallow circular arch in the x–z plane, rising towards +x, between hinges about y; of unit length and radius of curvature 1/κ.
const CURVATURE: f64 = 0.6;

fn ends() -> [Support; 2] {
    let strain = Twist::from_array([0.0, CURVATURE, 0.0, 0.0, 0.0, 1.0]);
    let half = hyperrod::lie::se3::exp(&(strain * 0.5));
    // the crown at the origin, its tangent along +z; curvature about +y bends towards +x, so the feet lie at positive x
    [half.inverse(), half].map(|pose| Support::pinned(pose).holding(Freedom::RotationX, 0.0).unwrap())
}

fn arch() -> Rod<Body<Stiffness>> {
    let section = Stiffness::diagonal([50.0, 1.0, 50.0, 4e3, 4e3, 1.2e3]).unwrap();
    let strain = Twist::from_array([0.0, CURVATURE, 0.0, 0.0, 0.0, 1.0]);
    let body = Body::new(1.0, section).unwrap().with_reference_strain(strain).unwrap();
    let [left, right] = ends();
    // out of plane nothing moves at the hinges but the turn about y
    let hinge = |s: Support| s.holding(Freedom::RotationZ, 0.0).unwrap();
    Rod::between(body, hinge(left), hinge(right))
}

fn solver() -> Statics {
    Statics { order: Order::Six, elements: 12, ..Statics::default() }
}

#[test]
fn a_shallow_arch_snaps_through_both_limit_points() {
    let push = DeadWrench::force(vector![1.0, 0.0, 0.0]).unwrap();
    let rod = arch().with_point_load(0.5, push).unwrap();
    let options =
        PathOptions { factors: [-200.0, 60.0], longest_step: 0.5, first_step: 0.2, ..PathOptions::default() };
    let path = solver().trace(&rod, &options).unwrap();
    assert_eq!(path.end, PathEnd::LoadFactor);
    let limits: Vec<_> = path.events.iter().filter(|e| e.kind == PathEventKind::LimitPoint).collect();
    assert_eq!(
        limits.len(),
        2,
        "{:?}",
        path.events.iter().map(|e| (e.kind, e.state.load_factor)).collect::<Vec<_>>()
    );
    // the same extrema with the crown held at a displacement: the reaction is the load
    let reaction = |x: f64| {
        let crown = Support::free().holding(Freedom::X, x).unwrap();
        let held = arch().with_support(0.5, crown).unwrap();
        let options = Statics { accept_unstable: true, tolerance: 1e-11, ..solver() };
        let solution = options.solve(&held).unwrap_or_else(|e| panic!("{x}: {e}"));
        let nodes = solution.nodes();
        let k = (1..nodes.len()).find(|&k| nodes[k].s == nodes[k - 1].s).unwrap();
        let [before, after] = [k - 1, k].map(|k| nodes[k].pose.rotation * nodes[k].wrench.force);
        (before - after).x
    };
    for limit in limits {
        let nodes = limit.state.solution.nodes();
        let k = (1..nodes.len()).find(|&k| nodes[k].s == nodes[k - 1].s).unwrap();
        let (x, load) = (nodes[k].pose.position.x, limit.state.load_factor);
        let at = reaction(x);
        // extremum: three points of a parabola, 1e-3 apart
        let [left, right] = [-1e-3, 1e-3].map(|d| reaction(x + d));
        let slope = (right - left) / 2e-3;
        let bend = (right + left - 2.0 * at) / 1e-6;
        assert!((at - load).abs() < 1e-6 * load.abs().max(1.0), "{at} {load}");
        assert!((slope / bend).abs() < 1e-4, "the extremum is {:e} away", slope / bend);
    }
}
