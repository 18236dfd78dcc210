//! Rods without some of their strains, held at more places than one.

use hyperrod::body::Constraint;
use hyperrod::load::{DeadLoad, DeadWrench};
use hyperrod::rod::{Freedom, Support};
use hyperrod::section::Stiffness;
use hyperrod::solve::{Reason, Stability};
use hyperrod::{Body, Error, Pose, Rod, StaticSolution, Statics, Wrench};
use nalgebra::{Isometry3, Vector3, vector};

use super::difference;
use super::fixed_mesh::STATICS;

/// Softest against bending about y, so that what buckles does so in the plane of x and z.
fn body(constraint: Constraint) -> Body<Stiffness> {
    let section = Stiffness::diagonal([6.0, 1.0, 5.0, 300.0, 250.0, 900.0]).unwrap();
    Body::new(1.0, section).unwrap().with_constraint(constraint)
}

/// A place in the plane of x and z, turned in it.
fn at(x: f64, z: f64, turn: f64) -> Pose {
    Pose::from(Isometry3::new(vector![x, 0.0, z], vector![0.0, turn, 0.0]))
}

/// A load in that plane.
fn pushed(rod: Rod<Body<Stiffness>>) -> Rod<Body<Stiffness>> {
    let push = Wrench::new(vector![0.0, 0.3, 0.0], vector![3.0, 0.0, -0.5]);
    rod.with_load(DeadLoad::new(push).unwrap())
}

/// Supports hold a planar rod in its plane, where it is anyway: nothing tells those reactions from the rod's own, and the shape is that of the free rod.
#[test]
fn a_planar_rod_held_at_many_places_is_the_free_rod_that_stays_in_its_plane() {
    let clamp = || Support::clamped(at(0.0, 0.0, 0.0));
    let twist = Support::pinned(at(0.0, 0.0, 0.1)).holding(Freedom::RotationZ, 0.0).unwrap();
    let ends = [
        (clamp(), Support::clamped(at(0.2, 0.9, 0.4))),
        (clamp(), Support::pinned(at(0.2, 0.92, 0.7))),
        (clamp(), Support::clamped(at(0.1, 0.9, -0.2)).releasing([Freedom::Z])),
        (twist, Support::pinned(at(0.1, 0.97, 0.0)).releasing([Freedom::Z])),
        (Support::free(), Support::clamped(at(0.1, 0.9, 0.2))),
    ];
    for (base, tip) in ends {
        for inside in [false, true] {
            let solve = |constraint: Constraint| {
                let mut rod = pushed(Rod::between(body(constraint), base, tip));
                if inside {
                    let hold = Support::pinned(at(0.06, 0.46, 0.3)).releasing([Freedom::Z]);
                    rod = rod.with_support(0.5, hold).unwrap();
                }
                STATICS.solve(&rod).unwrap()
            };
            let (free, planar) = (solve(Constraint::none()), solve(Constraint::planar()));
            // 3e-16 times the condition of such a rod, some 1e4
            let error = difference(&planar, &free);
            assert!(error < 1e-10, "{base:?} {tip:?} {inside}: {error:.1e}");
            stays(&planar, &Constraint::planar());
        }
    }
}

/// The strains that are fixed are zero, bit by bit.
fn stays(solution: &StaticSolution, constraint: &Constraint) {
    for node in solution.nodes().iter().chain(solution.stages()) {
        for (strain, fixed) in node.strain.to_array().into_iter().zip(constraint.fixed()) {
            assert!(!fixed || strain == 0.0, "{constraint:?}: {:?} at {} m", node.strain, node.s);
        }
    }
}

/// A strut found by further rungs than Newton's method, whose starts are bent aside, has none of that in the strains that it cannot have.
#[test]
fn a_strut_buckles_within_its_constraint() {
    let solve = |constraint: Constraint| {
        let push = DeadWrench::force(vector![0.0, 0.0, -6.0]).unwrap(); // beyond π² EI/4 L²
        let rod = Rod::clamped(body(constraint), Pose::identity()).with_tip_load(push);
        Statics { elements: 64, ..Statics::to(1e-11) }.solve(&rod).unwrap()
    };
    let side = |solution: &StaticSolution| {
        let tip = solution.tip().pose.position;
        vector![tip.x.abs(), tip.y, tip.z]
    };
    let free = side(&solve(Constraint::none()));
    assert!(free.x > 0.3);
    let twistless = Constraint::twist_free();
    for constraint in [Constraint::planar(), twistless, Constraint::planar().and(twistless)] {
        let strut = solve(constraint);
        stays(&strut, &constraint);
        assert_eq!(strut.report().stability, Stability::Index { unstable: 0, neutral: 0 });
        // the errors asked for, of both
        let error = (side(&strut) - free).norm();
        assert!(error < 2e-11, "{constraint:?}: {error:.1e}");
    }
}

/// Between clamps at its own length or farther apart it has no shape, or a single one with any tension.
#[test]
fn supports_farther_apart_than_a_rod_that_cannot_stretch_is_long_are_refused_by_name() {
    let solve = |constraint: Constraint, far: f64, roller: bool| {
        let clamp = Support::clamped(at(0.0, 0.0, 0.0));
        let mut rod = Rod::between(body(constraint), clamp, Support::clamped(at(0.0, far, 0.0)));
        if roller {
            rod = rod.with_support(0.5, Support::pinned(at(0.0, 0.51, 0.0))).unwrap();
        }
        STATICS.solve(&rod).map_err(|failure| failure.to_string())
    };
    let kirchhoff = Constraint::kirchhoff();
    for (constraint, far, roller) in
        [(kirchhoff, 1.1, false), (kirchhoff, 1.0, false), (kirchhoff.and(Constraint::planar()), 0.95, true)]
    {
        let message = solve(constraint, far, roller).unwrap_err();
        assert!(
            message.contains("distance between two supports of a rod that can neither stretch"),
            "{message}"
        );
    }
    // one that shears grows longer
    assert!(solve(Constraint::inextensible(), 1.01, false).is_ok());
    assert!(solve(Constraint::unshearable(), 1.01, false).is_ok());
    assert!(solve(kirchhoff, 0.99, false).is_ok());
}

/// What a rod without some strains cannot do is refused by the freedom and its place, and what it can do but barely is not.
#[test]
fn supports_that_ask_for_more_than_a_rod_can_do_are_refused_by_name() {
    let planar = Constraint::planar();
    let stretch = Constraint::fixing([true, true, true, true, true, false]);
    let spin = Constraint::fixing([true, true, false, true, true, true]);
    let turned = |turn: Vector3<f64>| Pose::from(Isometry3::new(vector![0.0, 0.0, 0.97], turn));
    let aside = Pose::from(Isometry3::translation(0.1, 0.2, 0.97));
    let cases = [
        (planar, Support::pinned(aside), "y", [0.0, -0.2]),
        (planar, Support::clamped(turned(vector![0.0, 0.0, 0.3])), "rotation about z", [0.0, -0.3]),
        (stretch, Support::pinned(aside).releasing([Freedom::Y]), "x", [0.0, -0.1]),
        (spin, Support::free().with_frame(aside).holding(Freedom::Z, 0.0).unwrap(), "z", [0.0, 0.03]),
    ];
    for (constraint, tip, name, values) in cases {
        let rod = pushed(Rod::between(body(constraint), Support::clamped(Pose::identity()), tip));
        let failure = STATICS.solve(&rod).unwrap_err();
        let Reason::Supports(Error::OverDetermined { freedom, s, held, found }) = failure.reason else {
            panic!("{failure}")
        };
        assert_eq!((freedom, s), (name, 1.0));
        assert!((held - values[0]).abs() + (found - values[1]).abs() < 1e-12, "{held} {found}");
    }
    // an inextensible strut cannot move its tip along itself while it is straight, and can when it is bent
    let nearer = Support::clamped(at(0.0, 0.95, 0.0));
    let rod = Rod::between(body(Constraint::kirchhoff()), Support::clamped(Pose::identity()), nearer);
    let bent = Statics::default().solve(&pushed(rod)).unwrap();
    assert!((bent.tip().pose.position - vector![0.0, 0.0, 0.95]).norm() < 1e-12);
}
