//! Rods with supports at both ends and between, point loads, corners and bodies, in motion.

use crate::cases::{Beam, cylinder, fixed, ramp, sideways};
use crate::ends::at;
use crate::stability::wandering;
use hyperrod::body::Constraint;
use hyperrod::lie::so3;
use hyperrod::load::{DeadWrench, FollowerWrench, Payload};
use hyperrod::num_dual::{Dual2_64, DualNum};
use hyperrod::rod::{Freedom, Support};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::{Dynamics, MovingNode, Scene, Scheme, Start};
use hyperrod::{Pose, Rod, Statics};
use nalgebra::{Matrix3, UnitQuaternion, Vector3, vector};
use std::f64::consts::PI;

pub const LENGTH: f64 = 0.4;

pub fn upright(angle: f64) -> Matrix3<f64> {
    so3::exp(&vector![0.0, angle, 0.0])
}

fn between_clamps() -> Rod<Beam> {
    Rod::between(cylinder(), Support::clamped(at(0.0)), Support::clamped(at(LENGTH)))
}

/// Position and velocity of the middle, moment and force at the base.
fn quantities(rod: &Rod<Beam>, dynamics: &Dynamics) -> [Vector3<f64>; 4] {
    let scene = Scene::new(rod).with_load(sideways(), ramp);
    let mut stepper = dynamics.start(&scene, &Start::at_rest()).unwrap();
    stepper.run_to(0.3).unwrap();
    let frame = stepper.frame().unwrap();
    let (middle, base) = (&frame.nodes[frame.nodes.len() / 2], frame.base());
    let velocity = middle.pose.rotation * middle.velocity.linear;
    [middle.pose.position, velocity, base.wrench.moment, base.wrench.force]
}

fn errors<const N: usize>(rod: &Rod<Beam>, scheme: Scheme, steps: [f64; N]) -> [[f64; 4]; N] {
    let dynamics = |scheme: Scheme, steps: f64| {
        let tolerance = 1e-13;
        Dynamics { scheme, elements: 4, tolerance, ..fixed(0.3 / steps) }
    };
    // 4 times the most steps below: its error is a hundredth of theirs
    let exact = quantities(rod, &dynamics(Scheme::Esdirk43, 960.0));
    steps.map(|n| {
        let found = quantities(rod, &dynamics(scheme, n));
        std::array::from_fn(|q| (found[q] - exact[q]).norm())
    })
}

/// Position, velocity, moment and force; of the force a part has the lower order of what a condition of index three gives.
#[test]
fn a_rod_between_two_clamps_moves_with_the_order_of_the_scheme() {
    let rod = between_clamps();
    let alpha = Scheme::GeneralisedAlpha { rho: 0.5 };
    for (scheme, steps, orders) in
        [(Scheme::Esdirk43, [60.0, 240.0], [3.6, 3.6, 3.6, 3.2]), (alpha, [240.0, 960.0], [1.8; 4])]
    {
        let errors = errors(&rod, scheme, steps);
        for (q, order) in orders.into_iter().enumerate() {
            let observed = (errors[0][q] / errors[1][q]).log2() / 2.0;
            assert!(observed > order, "{scheme:?} {q}: {observed:.2}");
        }
    }
}

/// What the second support holds across the plane is held by the first.
#[test]
fn a_planar_rod_between_supports_moves_as_the_rod_in_space() {
    let hinge = Support::pinned(at(LENGTH)).releasing([Freedom::Z]);
    for tip in [Support::clamped(at(LENGTH)), hinge] {
        let run = |constraint: Constraint| {
            let rod = Rod::between(cylinder().with_constraint(constraint), Support::clamped(at(0.0)), tip);
            let dynamics = Dynamics { elements: 4, tolerance: 1e-13, ..fixed(0.3 / 120.0) };
            quantities(&rod, &dynamics)
        };
        let (free, planar) = (run(Constraint::none()), run(Constraint::planar()));
        for (q, (a, b)) in free.iter().zip(&planar).enumerate() {
            // 120 steps whose strains each stop at 1e-13, of forces of newtons
            assert!((a - b).norm() < 1e-8, "{q}: {a:?} {b:?}");
        }
    }
}

/// Fixed strains are conditions of index three at every stage: ESDIRK then has order 2 in the end, but beginning from small errors.
/// Units are m, m/s, N m and N, for a rod of 0.4 m, 1.2 N that swings by 0.3 m.
#[test]
fn a_rod_without_shear_and_extension_moves_with_order_two_or_better() {
    let rod = Rod::clamped(cylinder().with_constraint(Constraint::kirchhoff()), at(0.0));
    let [coarse, fine] = errors(&rod, Scheme::Esdirk43, [60.0, 240.0]);
    for (q, largest) in [2e-8, 5e-7, 2e-8, 5e-7].into_iter().enumerate() {
        let observed = (coarse[q] / fine[q]).log2() / 2.0;
        assert!(fine[q] < largest && observed > 1.4, "{q}: {:.1e}, order {observed:.2}", fine[q]);
    }
    let [coarse, fine] = errors(&rod, Scheme::GeneralisedAlpha { rho: 0.5 }, [120.0, 240.0]);
    for q in 0..4 {
        let observed = (coarse[q] / fine[q]).log2();
        assert!(observed > 1.7, "generalised α, {q}: {observed:.2}");
    }
}

/// Buckled between clamps that came closer; bent by a point load and a follower, with a corner, a spring on the way and a ball joint at the end.
#[test]
fn an_equilibrium_between_supports_is_that_of_the_statics_and_stays() {
    let side = DeadWrench::force(vector![1e-3, 0.0, 0.0]).unwrap();
    let buckled = Rod::between(cylinder(), Support::clamped(at(0.0)), Support::clamped(at(0.95 * LENGTH)))
        .with_point_load(0.5 * LENGTH, side)
        .unwrap();
    let turn = UnitQuaternion::from_euler_angles(0.2, -0.3, 0.4);
    let spring = Support::free().with_frame(at(0.1)).with_spring(Freedom::X, 5.0).unwrap();
    let spring = spring.with_spring(Freedom::RotationY, 1e-3).unwrap();
    let push = FollowerWrench::new(vector![0.0, 0.0, 1e-4], vector![0.0, 3e-3, 0.0]).unwrap();
    let end = Pose::new(Matrix3::identity(), vector![-0.03, 0.02, 0.33]);
    let assembled = Rod::between(cylinder(), Support::clamped(at(0.0)), Support::pinned(end))
        .with_point_load(0.15, DeadWrench::force(vector![0.0, 0.01, 0.0]).unwrap())
        .and_then(|rod| rod.with_point_load(0.3, push))
        .and_then(|rod| rod.with_point_load(0.3, Payload::new(0.002).unwrap()))
        .and_then(|rod| rod.with_corner(0.22, turn))
        .and_then(|rod| rod.with_support(0.1, spring))
        .unwrap();
    for (what, rod) in [("buckled", buckled), ("assembled", assembled)] {
        let rest = Statics { elements: 12, order: Order::Six, ..Statics::default() }.solve(&rod).unwrap();
        let scene = Scene::new(&rod);
        for scheme in [Scheme::Esdirk43, Scheme::GeneralisedAlpha { rho: 0.9 }] {
            let dynamics = Dynamics { elements: 12, scheme, ..fixed(1e-3) };
            let start = Start::equilibrium(&rest);
            let frame = dynamics.start(&scene, &start).unwrap().frame().unwrap();
            let mut apart: [f64; 2] = [0.0; 2];
            for a in &frame.nodes {
                let same = rest.nodes().iter().filter(|b| (a.s - b.s).abs() < 1e-9);
                let differences = same.map(|b| {
                    let wrench = (a.wrench - b.wrench).to_vector().norm();
                    [(a.pose.position - b.pose.position).norm(), wrench]
                });
                let least = differences.min_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or([0.0; 2]);
                apart = [apart[0].max(least[0]), apart[1].max(least[1])];
            }
            let steps = if scheme == Scheme::Esdirk43 { 100 } else { 500 };
            let still = wandering(&scene, &dynamics, &start, steps);
            println!("{what} {scheme:?}: {apart:?} {still:?}");
            // two forms of the balance at order 6: m, and N m or N; and rounding
            assert!(apart[0] < 1e-6 && apart[1] < 1e-5, "{what}: {apart:?}");
            assert!(still[0].max(still[1]) < 1e-12, "{what} {scheme:?}: {still:?}");
        }
    }
}

pub fn shaken(t: Dual2_64) -> Pose<Dual2_64> {
    let zero = Dual2_64::from_re(0.0);
    let wave = (t * 8.0).sin().powi(3);
    let turn = so3::exp(&vector![zero, wave * 0.2, wave * 0.1]);
    Pose::new(turn, vector![wave * 0.03, zero, wave * 0.01])
}

/// A rod shaken by its first section, and the same turned round, shaken by its last. One clamp is a given pose and the other a condition;
/// the element does not read quite the same both ways, by what its order leaves.
#[test]
fn a_rod_shaken_at_either_end_moves_alike() {
    let forward = Rod::clamped(cylinder(), Pose::identity());
    let turned = Pose::new(upright(PI), Vector3::zeros());
    let backward = Rod::between(cylinder(), Support::free(), Support::clamped(turned));
    let apart = |elements: usize, scheme: Scheme| {
        let dynamics = Dynamics { elements, scheme, ..fixed(5e-3) };
        let run = |scene: &Scene<'_, Beam>| dynamics.run(scene, &Start::at_rest(), 0.3, |_| ()).unwrap();
        let first = run(&Scene::new(&forward).with_load(sideways(), ramp).with_base_motion(shaken));
        let second = run(&Scene::new(&backward)
            .with_load(sideways(), ramp)
            .with_tip_motion(move |t| shaken(t) * Pose::new(upright(PI), Vector3::zeros()).cast()));
        let held = (first.base().pose.position - second.tip().pose.position).norm();
        let force = first.base().pose.rotation * first.base().wrench.force;
        let force = force + second.tip().pose.rotation * second.tip().wrench.force;
        [(first.tip().pose.position - second.base().pose.position).norm(), held, force.norm()]
    };
    for scheme in [Scheme::Esdirk43, Scheme::GeneralisedAlpha { rho: 0.8 }] {
        let (coarse, fine) = (apart(5, scheme), apart(10, scheme));
        println!("{scheme:?} {coarse:?} {fine:?}");
        assert!(fine[0] < 0.1 * coarse[0] && fine[0] < 1e-6, "{coarse:?} {fine:?}");
        assert!(fine[1] < 1e-14 && fine[2] < 1e-4, "{fine:?}");
    }
}

/// Ten steps, a saved state, and ten more by another stepper: the same numbers to the last bit, with supports at both ends and between, a
/// body, and with fixed strains.
#[test]
fn a_run_between_supports_goes_on_from_a_saved_state_with_the_same_bits() {
    let held = Rod::between(cylinder(), Support::pinned(at(0.0)), Support::clamped(at(LENGTH)))
        .with_support(0.15, Support::free().with_spring(Freedom::Y, 3.0).unwrap())
        .and_then(|rod| rod.with_point_load(0.3, Payload::new(0.01)?))
        .unwrap();
    let fixed_strains = Rod::clamped(cylinder().with_constraint(Constraint::kirchhoff()), at(0.0));
    for rod in [held, fixed_strains] {
        let scene = Scene::new(&rod).with_load(sideways(), ramp);
        for scheme in [Scheme::Esdirk43, Scheme::GeneralisedAlpha { rho: 0.8 }] {
            let dynamics = Dynamics { scheme, elements: 4, order: Order::Four, ..fixed(4e-3) };
            let start = Start::at_rest();
            let mut whole = dynamics.start(&scene, &start).unwrap();
            let mut first = dynamics.start(&scene, &start).unwrap();
            for _ in 0..10 {
                first.step().unwrap();
                whole.step().unwrap();
            }
            let mut second = dynamics.resume(&scene, &first.state()).unwrap();
            for _ in 0..10 {
                second.step().unwrap();
                whole.step().unwrap();
            }
            assert_eq!(second.state(), whole.state(), "{scheme:?}");
            assert_eq!(second.frame().unwrap(), whole.frame().unwrap(), "{scheme:?}");
        }
    }
}

/// What cannot be is refused with its name, its value and its place.
#[test]
fn a_scene_that_contradicts_its_supports_is_refused() {
    let rod = Rod::between(cylinder(), Support::clamped(at(0.0)), Support::clamped(at(0.9 * LENGTH)));
    let refused = |scene: &Scene<'_, Beam>, dynamics: &Dynamics| {
        dynamics.start(scene, &Start::at_rest()).unwrap_err().to_string()
    };
    let message = refused(&Scene::new(&rod), &fixed(1e-3));
    assert!(message.contains("departure of the start") && message.contains("s = 0.4 m"), "{message}");
    let undamped = Dynamics { scheme: Scheme::GeneralisedAlpha { rho: 1.0 }, ..fixed(1e-3) };
    assert!(refused(&Scene::new(&rod), &undamped).contains("below 1"));
    let free = Rod::clamped(cylinder(), at(0.0));
    let message = refused(&Scene::new(&free).with_tip_motion(shaken), &fixed(1e-3));
    assert!(message.contains("motion of a support where there is none"), "{message}");
    let load = || DeadWrench::force(vector![1.0, 0.0, 0.0]).unwrap();
    assert!(Scene::new(&free).with_point_load(LENGTH, load(), |_| 1.0).is_err());
    assert!(Scene::new(&free).with_support_motion(0.2, shaken).is_err());
    let fast = Rod::between(cylinder(), Support::clamped(at(0.0)), Support::clamped(at(LENGTH)));
    let message = refused(
        &Scene::new(&fast).with_tip_motion(|t| {
            let mut pose = at(LENGTH).cast();
            pose.position.x = t;
            pose
        }),
        &fixed(1e-3),
    );
    assert!(message.contains("velocity of the start"), "{message}");
}

/// Position and velocity of the tip, velocity of the base and moment in the middle of a rod that flies, and of one that hangs on a hinge: the
/// base is no section that the scheme integrates.
#[test]
fn a_rod_with_a_base_that_moves_has_the_order_of_the_scheme() {
    let hinge = Support::pinned(at(0.0)).holding(Freedom::RotationZ, 0.0).unwrap();
    for (what, base) in [("free", Support::free()), ("hinge", hinge)] {
        let rod = Rod::between(cylinder(), base, Support::free());
        let run = |steps: f64| {
            let pull = DeadWrench::force(vector![0.0, 0.3, 0.0]).unwrap();
            let scene = Scene::new(&rod).with_load(sideways(), ramp);
            let scene = scene.with_tip_load(pull, |t| ramp(t) - ramp(t - 0.1));
            let dynamics = Dynamics { elements: 4, tolerance: 1e-13, ..fixed(0.2 / steps) };
            let mut stepper = dynamics.start(&scene, &Start::at_rest()).unwrap();
            stepper.run_to(0.2).unwrap();
            let frame = stepper.frame().unwrap();
            let (tip, base, middle) = (frame.tip(), frame.base(), &frame.nodes[frame.nodes.len() / 2]);
            let velocity = |node: &MovingNode| node.pose.rotation * node.velocity.linear;
            [tip.pose.position, velocity(tip), velocity(base), middle.wrench.moment]
        };
        let exact = run(960.0);
        let [coarse, fine] = [30.0, 120.0].map(|steps| {
            let found = run(steps);
            std::array::from_fn::<f64, 4, _>(|q| (found[q] - exact[q]).norm())
        });
        println!("{what} {coarse:?} {fine:?}");
        for q in (0..4).filter(|&q| (what, q) != ("hinge", 2)) {
            // of the moment a part is a vibration that 30 steps do not resolve
            let observed = (coarse[q] / fine[q]).log2() / 2.0;
            assert!(observed > if q == 3 { 2.7 } else { 3.5 }, "{what} {q}: {observed:.2}");
        }
        assert!(what == "free" || fine[2] < 1e-12, "{fine:?}");
    }
}
