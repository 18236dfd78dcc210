//! Rods past their critical loads.

use std::f64::consts::PI;

use hyperrod::load::DeadWrench;
use hyperrod::rod::Support;
use hyperrod::section::Stiffness;
use hyperrod::solve::{Order, PathEnd, PathEventKind, PathOptions, Rung, Stability};
use hyperrod::{Body, Pose, Rod, Statics, Twist};
use nalgebra::{Matrix3, UnitQuaternion, Vector3, vector};

use super::oracle::{complete, root};

/// A clamped rod of length 1, EI = 1 about its soft axis, whose ends are `shortening` closer than it is long; `imperfection` bends it at rest.
fn shortened(shortening: f64, imperfection: f64) -> Rod<Body<Stiffness>> {
    let section = Stiffness::diagonal([1.0, 1.5, 1.0, 1e5, 1e5, 3e5]).unwrap();
    let mut body = Body::new(1.0, section).unwrap();
    if imperfection > 0.0 {
        body = body
            .with_reference_strain(Twist::from_array([8.0 * imperfection, 0.0, 0.0, 0.0, 0.0, 1.0]))
            .unwrap();
    }
    let far = Pose::new(Matrix3::identity(), vector![0.0, 0.0, 1.0 - shortening]);
    Rod::between(body, Support::clamped(Pose::identity()), Support::clamped(far))
}

/// The thrust (4K)² of an inextensible clamped elastica with 2 (1 − E/K) of shortening.
fn thrust(shortening: f64) -> f64 {
    let log = root(-30.0, -1e-9, |log: f64| {
        let [k, e] = complete(log.exp());
        2.0 * (1.0 - e / k) - shortening
    });
    16.0 * complete(log.exp())[0].powi(2)
}

#[test]
fn a_clamped_rod_shortened_by_a_tenth_buckles_with_an_imperfection_and_without() {
    for imperfection in [1e-4, 0.0] {
        let rod = shortened(0.1, imperfection);
        let solution = Statics::to(1e-8).solve(&rod).unwrap_or_else(|e| panic!("{imperfection}: {e}"));
        let report = solution.report();
        assert_eq!(report.stability, Stability::Index { unstable: 0, neutral: 0 });
        assert!(report.rungs.contains(&Rung::Regularised), "{:?}", report.rungs);
        // the thrust shortens the rod by P/EA, and an imperfection ε changes it by about ε
        let thrust = thrust(0.1 - 40.0 / 3e5);
        let found = solution.base().wrench.force.norm();
        assert!((found / thrust - 1.0).abs() < 1e-3, "{imperfection}: {found} {thrust}");
    }
}

#[test]
fn the_straight_line_of_a_shortened_rod_is_returned_only_where_it_is_asked_for_and_called_unstable() {
    let options = Statics { accept_unstable: true, ..Statics::to(1e-8) };
    let solution = options.solve(&shortened(0.1, 0.0)).unwrap();
    assert!(solution.nodes().iter().all(|node| node.pose.position.xy().norm() < 1e-12));
    let Stability::Index { unstable, .. } = solution.report().stability else { panic!() };
    // P(1 + P(1/GA − 1/EA)) L²/EI against the (kL)² of both planes
    let p = 0.1 * 3e5;
    let passed = |ei: f64| {
        let square = p * (1.0 + p * (1.0 / 1e5 - 1.0 / 3e5)) / ei;
        let tangent = |i: usize| {
            let (a, b) = (i as f64 * PI, (i as f64 + 0.5) * PI);
            2.0 * root(a + 1e-9, b - 1e-9, |x| x.tan() - x)
        };
        let even = (1..200).filter(|i| (2.0 * PI * f64::from(*i)).powi(2) < square).count();
        even + (1..200).filter(|i| tangent(*i).powi(2) < square).count()
    };
    assert_eq!(unstable, passed(1.0) + passed(1.5));
}

#[test]
fn a_column_s_buckling_load_and_its_two_modes() {
    let section = Stiffness::diagonal([1.0, 1.0, 1.0, 1e5, 1e5, 3e5]).unwrap();
    let push = DeadWrench::force(vector![0.0, 0.0, -1.0]).unwrap();
    let rod = Rod::clamped(Body::new(1.0, section).unwrap(), Pose::identity()).with_tip_load(push);
    let options = PathOptions { factors: [0.0, 5.0], ..PathOptions::default() };
    let solver = Statics { order: Order::Six, elements: 12, ..Statics::default() };
    let buckling = solver.buckling(&rod, &options).unwrap().unwrap();
    assert_eq!((buckling.kind, buckling.modes.len()), (PathEventKind::Bifurcation, 2));
    // P (1 + P (1/GA − 1/EA)) = π²/4; the phase of six stages over π/2: 1e-11
    let p = buckling.critical.load_factor;
    let load = p * (1.0 + p * (1.0 / 1e5 - 1.0 / 3e5));
    assert!((load / (PI * PI / 4.0) - 1.0).abs() < 1e-9, "{load}");
    let tips = [0, 1].map(|mode| buckling.modes[mode].last().unwrap().linear);
    // both sideways, and not the same way
    assert!(tips.iter().all(|tip| tip.z.abs() < 1e-6 * tip.norm()));
    assert!(tips[0].cross(&tips[1]).norm() > 0.1 * tips[0].norm() * tips[1].norm());
}

#[test]
fn the_branch_that_leaves_a_column_s_critical_load_is_the_elastica() {
    let section = Stiffness::diagonal([1.0, 1.5, 1.0, 1e8, 1e8, 1e8]).unwrap();
    let push = DeadWrench::force(vector![0.0, 0.0, -1.0]).unwrap();
    let rod = Rod::clamped(Body::new(1.0, section).unwrap(), Pose::identity()).with_tip_load(push);
    let options = PathOptions { factors: [0.0, 10.0], ..PathOptions::default() };
    let solver = Statics { order: Order::Six, elements: 16, ..Statics::default() };
    let branch = solver.trace_buckled(&rod, &options).unwrap().unwrap();
    let (first, last) = (&branch.points[0], &branch.points[branch.points.len() - 1]);
    assert_eq!((branch.end.clone(), last.load_factor), (PathEnd::LoadFactor, 10.0));
    // a pitchfork: √P L = K(k) grows with the square of the way
    assert!((first.load_factor / (PI * PI / 4.0) - 1.0).abs() < 1e-2, "{}", first.load_factor);
    for point in &branch.points {
        let [p, tip] = [point.load_factor, point.solution.tip().pose.position.z];
        // k as its logarithm; the tip is at 2E/K − 1
        let log = root(-100.0, -1e-12, |log: f64| complete(log.exp())[0] - p.sqrt());
        let [k, e] = complete(log.exp());
        // strains of P/1e8, elements of order 6
        assert!((tip - (2.0 * e / k - 1.0)).abs() < 1e-6, "{p}: {tip} {}", 2.0 * e / k - 1.0);
        assert_eq!(point.solution.report().stability, Stability::Index { unstable: 0, neutral: 0 });
    }
    // straight up to the critical load, and no branch below it
    let below = PathOptions { factors: [0.0, 2.0], ..options };
    assert!(solver.trace_buckled(&rod, &below).unwrap().is_none());
}

#[test]
fn a_right_angle_frame_buckles_sideways_at_its_published_load() {
    // Argyris et al. (1979); 1.088 as recalled by later authors. L = .24, .03 × .0006, E = 7.124e10, ν = .31
    let (length, width, thickness, e, nu) = (0.24, 0.03_f64, 0.0006_f64, 7.124e10, 0.31);
    let g = e / (2.0 * (1.0 + nu));
    let (strong, weak) = (thickness * width.powi(3) / 12.0, width * thickness.powi(3) / 12.0);
    let torsion = width * thickness.powi(3) / 3.0 * (1.0 - 0.63 * thickness / width);
    let area = width * thickness;
    // x of the section in the plane of the frame: bending in the plane is about y, against the strong axis
    let section =
        Stiffness::diagonal([e * weak, e * strong, g * torsion, g * area, g * area, e * area]).unwrap();
    let body = Body::new(2.0 * length, section).unwrap();
    let corner = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
    // the second leg leaves along +x; its end is pulled along the first leg, away from the clamp (the other way it buckles at 0.679)
    let pull = DeadWrench::force(vector![0.0, 0.0, 1.0]).unwrap();
    let rod = Rod::clamped(body, Pose::identity()).with_corner(length, corner).unwrap().with_tip_load(pull);
    let options = PathOptions { factors: [0.0, 5.0], ..PathOptions::default() };
    let solver = Statics { order: Order::Six, elements: 16, ..Statics::default() };
    let buckling = solver.buckling(&rod, &options).unwrap().unwrap();
    let load = buckling.critical.load_factor;
    assert!((load - 1.088).abs() < 0.01, "{load}");
    assert_eq!(buckling.kind, PathEventKind::Bifurcation);
    assert!(buckling.modes[0].last().unwrap().linear.y.abs() > 0.1);
}
