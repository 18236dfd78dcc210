//! Rods with any end conditions, interior supports, point loads and corners.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic
mod reference;

use hyperrod::load::DeadWrench;
use hyperrod::rod::{Freedom, Support};
use hyperrod::section::Stiffness;
use hyperrod::solve::Order;
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Twist, Wrench};
use nalgebra::{UnitQuaternion, Vector3, vector};

type Strip = Body<Stiffness>;

/// A soft rod, curved and twisted at rest, of unit length.
fn strip() -> Strip {
    let section = Stiffness::diagonal([1.0, 2.0, 1.5, 300.0, 400.0, 900.0]).unwrap();
    let curved = Twist::from_array([0.4, -0.3, 0.8, 0.0, 0.0, 1.0]);
    Body::new(1.0, section).unwrap().with_reference_strain(curved).unwrap()
}

/// Discretisation errors below 1e-12 on these rods.
fn fine() -> Statics {
    Statics { elements: 32, order: Order::Six, tolerance: 1e-10, ..Statics::default() }
}

/// A wrench in the frame of a section, as one fixed in space.
fn dead(pose: &Pose, wrench: &Wrench) -> DeadWrench {
    DeadWrench::new(pose.rotation * wrench.moment, pose.rotation * wrench.force).unwrap()
}

fn difference(a: &StaticSolution, b: &StaticSolution) -> f64 {
    assert_eq!(a.nodes().len(), b.nodes().len());
    let mut worst: f64 = 0.0;
    for (a, b) in a.nodes().iter().zip(b.nodes()) {
        let between = (a.pose.inverse() * b.pose).log().to_vector().norm();
        worst = worst.max(between).max((a.wrench - b.wrench).to_vector().norm());
    }
    worst
}

/// The cantilever all supports below are held against: bent by more than a radian.
fn cantilever() -> StaticSolution {
    let pull = DeadWrench::new(vector![0.3, -0.2, 0.5], vector![1.5, 0.7, -0.4]).unwrap();
    fine().solve(&Rod::clamped(strip(), Pose::identity()).with_tip_load(pull)).unwrap()
}

/// Somewhere near `pose`, so that what a support holds is not zero.
fn nearby(pose: &Pose) -> Pose {
    *pose * hyperrod::lie::se3::exp(&Twist::from_array([0.2, -0.1, 0.15, 0.03, -0.02, 0.04]))
}

fn coordinates(frame: &Pose, pose: &Pose) -> [f64; 6] {
    let relative = frame.inverse() * *pose;
    let (turn, place) = (hyperrod::lie::so3::log(&relative.rotation), relative.position);
    [turn.x, turn.y, turn.z, place.x, place.y, place.z]
}

/// A support that holds the freedoms of `mask` where `pose` has them.
fn holding(mask: u32, frame: &Pose, pose: &Pose) -> Support {
    let chi = coordinates(frame, pose);
    let mut support = Support::clamped(*frame);
    for (j, freedom) in Freedom::ALL.into_iter().enumerate() {
        support = if mask & (1 << j) != 0 {
            support.holding(freedom, chi[j]).unwrap()
        } else {
            support.releasing([freedom])
        };
    }
    support
}

/// Every subset of the six freedoms held at the tip where the cantilever has them, the rest loaded as there: the same equilibrium.
#[test]
fn a_tip_held_where_it_would_be_anyway_is_the_cantilever_for_all_64_supports() {
    let free = cantilever();
    let (pose, wrench) = (free.tip().pose, free.tip().wrench);
    let frame = nearby(&pose);
    for mask in 0..64 {
        let support = holding(mask, &frame, &pose);
        let rod = Rod::between(strip(), Support::clamped(Pose::identity()), support)
            .with_tip_load(dead(&pose, &wrench));
        let held = fine().solve(&rod).unwrap_or_else(|e| panic!("{mask:06b}: {e}"));
        // Newton's tolerance squared, and 1e-16 times the condition of the clamp, 900; measured 3e-13
        let error = difference(&free, &held);
        assert!(error < 1e-10, "{mask:06b}: {error:.1e}");
    }
}

/// The same at the base, with the tip clamped: a rod solved from its other end.
#[test]
fn a_base_held_where_it_would_be_anyway_is_the_cantilever_for_all_64_supports() {
    let free = cantilever();
    let (tip, base) = (free.tip(), free.base());
    let frame = nearby(&base.pose);
    for mask in 0..64 {
        let support = holding(mask, &frame, &base.pose);
        let rod = Rod::between(strip(), support, Support::clamped(tip.pose))
            .with_base_load(dead(&base.pose, &-base.wrench));
        let held = fine().solve(&rod).unwrap_or_else(|e| panic!("{mask:06b}: {e}"));
        let error = difference(&free, &held);
        assert!(error < 1e-10, "{mask:06b}: {error:.1e}");
    }
}

/// Freedoms shared out between both ends so that together they hold the rod.
#[test]
fn ends_that_hold_the_rod_only_together_do_so() {
    let free = cantilever();
    let (tip, base) = (free.tip(), free.base());
    // ball joints, twist held at one end; a slide at the base; a hinge and a point on a line
    for (at_base, at_tip) in [(0b111_000, 0b111_100), (0b011_111, 0b100_000), (0b111_101, 0b011_000)] {
        let rod = Rod::between(
            strip(),
            holding(at_base, &base.pose, &base.pose),
            holding(at_tip, &tip.pose, &tip.pose),
        )
        .with_base_load(dead(&base.pose, &-base.wrench))
        .with_tip_load(dead(&tip.pose, &tip.wrench));
        let held = fine().solve(&rod).unwrap_or_else(|e| panic!("{at_base:06b} {at_tip:06b}: {e}"));
        let error = difference(&free, &held);
        assert!(error < 1e-9, "{at_base:06b} {at_tip:06b}: {error:.1e}");
    }
}

/// The part of a rod beyond a place acts on the part before it like a load: three supports in the middle, point loads, corners.
#[test]
fn a_support_between_the_ends_gives_what_a_point_load_gave() {
    let s = 0.37;
    let push = vector![0.2, -0.5, 0.3];
    let loaded = || {
        let rod = Rod::clamped(strip(), Pose::identity());
        rod.with_tip_load(DeadWrench::force(vector![0.5, 0.2, 0.0]).unwrap())
    };
    let free = fine().solve(&loaded().with_point_load(s, DeadWrench::force(push).unwrap()).unwrap()).unwrap();
    let [before, after] = at(&free, s);
    // the wrench jumps by exactly the load
    let jump = before.pose.rotation * (before.wrench.force - after.wrench.force);
    assert!((jump - push).norm() < 1e-14 && (before.wrench.moment - after.wrench.moment).norm() < 1e-14);

    for mask in 0..64 {
        let support = holding(mask, &nearby(&before.pose), &before.pose);
        let rod = loaded().with_support(s, support).unwrap();
        let rod = rod.with_point_load(s, DeadWrench::force(push).unwrap()).unwrap();
        let held = fine().solve(&rod).unwrap_or_else(|e| panic!("{mask:06b}: {e}"));
        let error = difference(&free, &held);
        assert!(error < 1e-9, "{mask:06b}: {error:.1e}");
    }
}

/// The nodes before and after a joint.
fn at(solution: &StaticSolution, s: f64) -> [hyperrod::solve::Node; 2] {
    let nodes: Vec<_> = solution.nodes().iter().filter(|node| node.s == s).collect();
    assert_eq!(nodes.len(), 2, "a joint has a node on either side");
    [*nodes[0], *nodes[1]]
}

/// A corner is where two rods meet: the second one, clamped at the corner's pose, has the shape of the rest of the first.
#[test]
fn beyond_a_corner_the_rod_is_a_rod_clamped_there() {
    let straight = |length: f64| {
        let section = Stiffness::diagonal([1.0, 2.0, 1.5, 300.0, 400.0, 900.0]).unwrap();
        Body::new(length, section).unwrap()
    };
    let turn = UnitQuaternion::from_scaled_axis(vector![0.3, 1.2, -0.4]);
    let pull = || DeadWrench::new(vector![0.1, 0.2, -0.3], vector![0.8, 0.5, -0.3]).unwrap();
    let rod =
        Rod::clamped(straight(1.0), Pose::identity()).with_corner(0.375, turn).unwrap().with_tip_load(pull());
    let whole = fine().solve(&rod).unwrap();
    let [before, after] = at(&whole, 0.375);
    let relative = before.pose.inverse() * after.pose;
    let matrix = turn.to_rotation_matrix().into_inner();
    assert!((relative.rotation - matrix).norm() < 1e-14 && relative.position.norm() < 1e-15);
    assert!((after.wrench.force - matrix.transpose() * before.wrench.force).norm() < 1e-13);

    let rest = fine().solve(&Rod::clamped(straight(0.625), after.pose).with_tip_load(pull())).unwrap();
    let error = (whole.tip().pose.inverse() * rest.tip().pose).log().to_vector().norm();
    assert!(error < 1e-11, "{error:.1e}");
    assert!((rest.base().wrench - after.wrench).to_vector().norm() < 1e-10);
}

/// Springs: a tip on springs of stiffness k carries the load less k times its displacement.
#[test]
fn a_spring_pushes_back_with_its_stiffness_and_stores_the_energy() {
    let pull = vector![0.4, 0.1, 0.0];
    let start = Pose::new(nalgebra::Matrix3::identity(), vector![0.1, 0.0, 1.0]);
    let spring = Support::free().with_frame(start).with_spring(Freedom::X, 3.0).unwrap();
    let spring = spring.with_spring(Freedom::RotationY, 0.7).unwrap();
    let rod = Rod::between(strip(), Support::clamped(Pose::identity()), spring)
        .with_tip_load(DeadWrench::force(pull).unwrap());
    let solution = fine().solve(&rod).unwrap();
    let tip = solution.tip();
    let force = tip.pose.rotation * tip.wrench.force;
    let expected = pull - vector![3.0 * (tip.pose.position.x - 0.1), 0.0, 0.0];
    assert!((force - expected).norm() < 1e-13, "{force} {expected}");
    // work of the rotation vector's conjugate moment: (dexp_φ m)_y = −k φ_y, the other two nothing
    let phi = hyperrod::lie::so3::log(&tip.pose.rotation);
    let conjugate = hyperrod::lie::so3::dexp(&phi) * tip.wrench.moment;
    assert!((conjugate - vector![0.0, -0.7 * phi.y, 0.0]).norm() < 1e-12, "{conjugate}");
    let springs = 0.5 * 3.0 * (tip.pose.position.x - 0.1).powi(2) + 0.5 * 0.7 * phi.y * phi.y;
    let potential = solution.load_potential().unwrap();
    assert!((potential - (springs - pull.dot(&tip.pose.position))).abs() < 1e-13);
}

/// Orders hold with a joint inside: errors against a fine mesh fall as h^p.
#[test]
fn point_loads_and_supports_keep_the_order() {
    let scene = || {
        let held = Support::clamped(Pose::new(nalgebra::Matrix3::identity(), vector![0.05, -0.03, 0.68]));
        Rod::clamped(strip(), Pose::identity())
            .with_tip_load(DeadWrench::force(vector![0.5, 0.4, 0.1]).unwrap())
            .with_point_load(0.3, DeadWrench::force(vector![-2.0, 1.0, 0.5]).unwrap())
            .unwrap()
            .with_support(0.7, held.releasing([Freedom::RotationX, Freedom::RotationY, Freedom::Z]))
            .unwrap()
    };
    let solve = |elements: usize, order: Order| {
        Statics { elements, order, tolerance: 1e-11, ..Statics::default() }.solve(&scene()).unwrap()
    };
    let exact = solve(160, Order::Six);
    for (order, p) in [(Order::Two, 2.0), (Order::Four, 4.0), (Order::Six, 6.0)] {
        let error = |elements: usize| {
            let tip = *solve(elements, order).tip();
            (exact.tip().pose.inverse() * tip.pose).log().to_vector().norm()
        };
        let (coarse, fine) = (error(20), error(40));
        let observed = (coarse / fine).log2();
        assert!(observed > p - 0.1 || fine < 1e-12, "{order:?}: {observed:.2}, {coarse:.1e} {fine:.1e}");
    }
}

/// What holds nothing is named.
#[test]
fn a_rod_that_is_free_to_move_is_refused_by_name() {
    use hyperrod::Error;
    use hyperrod::solve::Reason;
    let frame = Pose::identity();
    let far = Pose::new(nalgebra::Matrix3::identity(), Vector3::z());
    let straight =
        || Body::new(1.0, Stiffness::diagonal([1.0, 2.0, 1.5, 300.0, 400.0, 900.0]).unwrap()).unwrap();
    let pull = || DeadWrench::force(Vector3::x()).unwrap();
    let cases = [
        (Support::free(), Support::free(), ""),
        // turns about itself
        (Support::pinned(frame), Support::pinned(far).releasing([Freedom::Z]), "rotation about"),
        (Support::clamped(frame).releasing([Freedom::X]), Support::free(), "translation along"),
    ];
    for (base, tip, expected) in cases {
        let failure = Statics::default().solve(&Rod::between(straight(), base, tip)).unwrap_err();
        let Reason::Supports(Error::FreeToMove { motion, .. }) = failure.reason else { panic!("{failure}") };
        assert!(motion.contains(expected), "{motion}");
    }
    // a dead load does not hold a rod that slides, whatever its size
    let rod = Rod::between(straight(), Support::clamped(frame).releasing([Freedom::X]), Support::free());
    assert!(Statics::default().solve(&rod.with_tip_load(pull())).is_err());
    // but a hanging weight holds a pendulum upright, up to its twist
    let base = Support::clamped(frame).releasing([Freedom::RotationX, Freedom::RotationY]);
    let weight = DeadWrench::force(vector![0.3, 0.0, 0.4]).unwrap();
    let swing =
        Statics::default().solve(&Rod::between(straight(), base, Support::free()).with_tip_load(weight));
    let tip = swing.unwrap().tip().pose.position;
    assert!((tip.x / tip.z - 0.75).abs() < 1e-9, "{tip}");

    let two = Rod::clamped(straight(), frame).with_support(0.5, Support::pinned(frame)).unwrap();
    assert!(matches!(two.with_support(0.5, Support::pinned(frame)), Err(Error::Invalid { .. })));
    let outside = Rod::clamped(straight(), frame).with_support(1.5, Support::pinned(frame)).unwrap_err();
    assert!(matches!(outside, Error::Invalid { quantity: "arc length of a joint", .. }));
}

/// Balance about the centre of mass, and Castigliano's theorem: the energy changes with the mass by g times the height of its centre.
#[test]
fn a_payload_hangs_from_its_centre_of_mass() {
    use hyperrod::load::Payload;
    let centre = vector![0.02, -0.03, 0.1];
    let payload = Payload::new(0.05).unwrap().with_centre(centre).unwrap();
    let pose = Pose::new(
        UnitQuaternion::from_scaled_axis(vector![0.0, 1.3, 0.2]).to_rotation_matrix().into_inner(),
        vector![0.1, 0.0, 0.3],
    );
    let solution = fine().solve(&Rod::clamped(strip(), pose).with_tip_load(payload)).unwrap();
    let tip = solution.tip();
    // the moment about the centre of mass vanishes, and the potential is that of a weight there
    let weight = vector![0.0, 0.0, -9.80665 * 0.05];
    let force = tip.pose.rotation * tip.wrench.force;
    assert!((force - weight).norm() < 1e-15);
    assert!((tip.wrench.moment - centre.cross(&tip.wrench.force)).norm() < 1e-15);
    let height = tip.pose.transform_point(&centre).z;
    assert!((solution.load_potential().unwrap() + weight.z * height).abs() < 1e-15);
    // central difference: (1e-3)² of the energy's curvature in the mass
    let energy = |mass: f64| {
        let payload = Payload::new(mass).unwrap().with_centre(centre).unwrap();
        let solution = fine().solve(&Rod::clamped(strip(), pose).with_tip_load(payload)).unwrap();
        solution.strain_energy() + solution.load_potential().unwrap()
    };
    let slope = (energy(0.05005) - energy(0.04995)) / 1e-4;
    assert!((slope - 9.80665 * height).abs() < 1e-6, "{slope} {}", 9.80665 * height);
}
