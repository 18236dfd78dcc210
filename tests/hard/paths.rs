//! Snap-through, followed by arc length.

use hyperrod::body::Constraint;
use hyperrod::load::DeadWrench;
use hyperrod::rod::{Freedom, Support};
use hyperrod::section::Stiffness;
use hyperrod::solve::{Order, PathEnd, PathEventKind, PathOptions, Reason, Stability};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Twist};
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

/// x of the crown.
fn crown(solution: &StaticSolution) -> f64 {
    let node = solution.nodes().iter().find(|node| (node.s - 0.5).abs() < 1e-9).unwrap();
    node.pose.position.x
}

/// Between its two limit loads the arch is stable on either side. From rest a solve finds the near side; from the shape of a snapped arch it has to
/// find the far one, which the path by arc length knows.
#[test]
fn a_sweep_that_starts_from_the_shape_before_stays_on_its_branch() {
    let pushed =
        |load: f64| arch().with_point_load(0.5, DeadWrench::force(vector![load, 0.0, 0.0]).unwrap()).unwrap();
    let options =
        PathOptions { factors: [-200.0, 60.0], longest_step: 0.5, first_step: 0.2, ..PathOptions::default() };
    let path = solver().trace(&pushed(1.0), &options).unwrap();
    let limits: Vec<_> = path
        .events
        .iter()
        .filter(|e| e.kind == PathEventKind::LimitPoint)
        .map(|e| e.state.load_factor)
        .collect();
    let between = |load: f64| load < limits[0] && load > limits[1];
    let far = path.points.iter().rev().find(|point| between(point.load_factor)).unwrap();
    let (load, there) = (far.load_factor, crown(&far.solution));
    for statics in [solver(), Statics::to(1e-8)] {
        let from_rest = statics.solve(&pushed(load)).unwrap();
        let snapped = statics.solve(&pushed(60.0)).unwrap();
        let back = statics.solve_from(&pushed(load), &snapped).unwrap();
        assert_eq!(back.report().stability, Stability::Index { unstable: 0, neutral: 0 });
        assert!((crown(&back) - there).abs() < 1e-6, "{} and {there}", crown(&back));
        assert!((crown(&from_rest) - there).abs() > 0.05, "{} and {there}", crown(&from_rest));
    }
}

/// Strains that are fixed stay zero, whatever they were in the rod before.
#[test]
fn a_start_from_a_rod_with_more_strains_is_forgotten_where_they_are_fixed() {
    let section = || Stiffness::diagonal([1.0, 1.0, 0.8, 20.0, 20.0, 30.0]).unwrap();
    let rod = |constraint: Constraint| {
        let body = Body::new(1.0, section()).unwrap().with_constraint(constraint);
        let pull = DeadWrench::force(vector![2.0, 1.0, 1.0]).unwrap();
        Rod::clamped(body, Pose::identity()).with_tip_load(pull)
    };
    let full = solver().solve(&rod(Constraint::none())).unwrap();
    assert!(full.stages().iter().any(|stage| stage.strain.linear.norm() > 1e-2));
    for constraint in [Constraint::kirchhoff(), Constraint::inextensible()] {
        let from_rest = solver().solve(&rod(constraint)).unwrap();
        let found = solver().solve_from(&rod(constraint), &full).unwrap();
        assert!(found.stages().iter().all(|stage| stage.strain.linear.z == 0.0));
        // both end a Newton step of 1e-9 from the answer, its square off
        let off = (found.tip().pose.position - from_rest.tip().pose.position).norm();
        assert!(off < 1e-12, "{off:e}");
    }
}

#[test]
fn the_shape_of_a_rod_of_another_length_is_no_start() {
    let section = || Stiffness::diagonal([50.0, 1.0, 50.0, 4e3, 4e3, 1.2e3]).unwrap();
    let rod = |length: f64| Rod::clamped(Body::new(length, section()).unwrap(), Pose::identity());
    let longer = solver().solve(&rod(1.5)).unwrap();
    let failure = solver().solve_from(&rod(1.0), &longer).unwrap_err();
    assert!(matches!(failure.reason, Reason::Options(_)));
    let text = failure.to_string();
    assert!(text.contains("length of the rod of the earlier solution") && text.contains("1.5"), "{text}");
}
