//! Rods with supports at both ends and between, point loads, corners and bodies, in motion.

use crate::cases::{Beam, beam, circle, cylinder, fixed, ramp, sideways};
use crate::ends::at;
use crate::energy::drift;
use crate::stability::wandering;
use hyperrod::body::Constraint;
use hyperrod::lie::so3;
use hyperrod::load::{DeadWrench, FollowerWrench, Gravity, Payload};
use hyperrod::num_dual::{Dual2_64, DualNum};
use hyperrod::rod::{Freedom, Support};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::{Dynamics, Frame, Scene, Scheme, Start};
use hyperrod::{Pose, Rod, Statics, Strain, Twist};
use nalgebra::{Matrix3, UnitQuaternion, Vector3, vector};
use std::f64::consts::PI;

const LENGTH: f64 = 0.4;

fn upright(angle: f64) -> Matrix3<f64> {
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
    let errors = steps.map(|n| {
        let found = quantities(rod, &dynamics(scheme, n));
        std::array::from_fn(|q| (found[q] - exact[q]).norm())
    });
    println!("{scheme:?} {errors:?}");
    errors
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

/// Gravity comes and goes within 0.3 s and leaves the rod swinging between a clamp and a ball joint, or bent as an inextensible one.
#[test]
fn a_swing_between_supports_keeps_its_energy() {
    let hinged = Rod::between(cylinder(), Support::clamped(at(0.0)), Support::pinned(at(LENGTH)));
    let fixed_strains = Rod::clamped(cylinder().with_constraint(Constraint::kirchhoff()), at(0.0));
    // in 1e4 steps; of the second a part in 1e8 is lost, by the order that conditions leave
    for (what, rod, largest) in [("clamped-pinned", hinged, 1e-8), ("kirchhoff", fixed_strains, 2e-8)] {
        let scene = Scene::new(&rod).with_load(sideways(), |t| 0.3 * (ramp(t) - ramp(t - 0.2)));
        let dynamics = Dynamics { elements: 3, order: Order::Four, tolerance: 1e-13, ..fixed(5e-4) };
        let mut stepper = dynamics.start(&scene, &Start::at_rest()).unwrap();
        stepper.run_to(0.3).unwrap();
        let change = drift(&mut stepper, 2000);
        println!("{what} {change:.2e}");
        assert!(change.abs() < largest, "{what}: {change:.2e}");
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

/// Oracle: the period of a rigid pendulum let go horizontally, 4 √(I/(M g l)) K(sin 45°), K by the arithmetic-geometric mean.
#[test]
fn a_stiff_rod_on_a_hinge_swings_as_a_pendulum() {
    let (length, radius) = (0.5, 0.01);
    let numbers = [5e13, 2e13, 1000.0];
    let hanging = Pose::new(upright(PI), Vector3::zeros());
    let hinge = Support::pinned(hanging).holding(Freedom::RotationX, 0.0).unwrap();
    let hinge = hinge.holding(Freedom::RotationZ, 0.0).unwrap();
    let area = PI * radius * radius;
    let (mass, second) = (1000.0 * area * length, 0.25 * area * radius * radius);
    for heavy in [0.0, 0.5] {
        let body = beam(length, circle(radius), numbers);
        let rod = Rod::between(body, hinge, Support::free()).with_load(Gravity::standard());
        let rod = rod.with_tip_load(Payload::new(heavy).unwrap());
        let inertia = mass * length * length / 3.0 + 1000.0 * second * length + heavy * length * length;
        let weight = 9.80665 * (0.5 * mass * length + heavy * length);
        let (mut a, mut b) = (1.0_f64, 0.5_f64.sqrt());
        for _ in 0..8 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        let period = 4.0 * (inertia / weight).sqrt() * PI / (2.0 * a);
        let dynamics = Dynamics { elements: 2, order: Order::Four, ..fixed(period / 400.0) };
        let scene = Scene::new(&rod);
        let start = Start::at_rest().with_base(Pose::new(upright(0.5 * PI), Vector3::zeros()));
        let mut stepper = dynamics.start(&scene, &start).unwrap();
        let mut tips = Vec::new();
        for quarter in 1..=4 {
            stepper.run_to(period * f64::from(quarter) / 4.0).unwrap();
            tips.push(stepper.frame().unwrap().tip().pose.position / length);
        }
        println!("{heavy}: {tips:?}");
        let hung = [
            vector![0.0, 0.0, -1.0],
            vector![-1.0, 0.0, 0.0],
            vector![0.0, 0.0, -1.0],
            vector![1.0, 0.0, 0.0],
        ];
        for (tip, hung) in tips.iter().zip(hung) {
            // 400 steps a period, order 4; the rod is not quite rigid
            assert!((tip - hung).norm() < 1e-7, "{tip:?} {hung:?}");
        }
    }
}

fn shaken(t: Dual2_64) -> Pose<Dual2_64> {
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

/// Energy + dissipated − work is constant, to the order of the steps: a base on a moving hinge, a tip in a moving slide with springs, a timed point load, a body on the
/// way and a corner.
#[test]
fn energy_is_what_was_given_less_what_was_taken_at_every_support() {
    let body = cylinder()
        .with_viscosity_matrix(nalgebra::Matrix6::from_diagonal(&vector![4e-5, 4e-5, 3e-5, 0.5, 0.5, 1.5]));
    let hinge = Support::pinned(at(0.0)).holding(Freedom::RotationZ, 0.0).unwrap();
    let slide = Support::clamped(at(LENGTH)).releasing([Freedom::X]).with_spring(Freedom::Z, 40.0).unwrap();
    let turn = UnitQuaternion::from_euler_angles(0.0, 0.1, 0.0);
    let tool = Payload::new(0.005).and_then(|tool| tool.with_centre(vector![0.02, 0.0, 0.0])).unwrap();
    let rod = Rod::between(body.unwrap(), hinge, slide)
        .with_corner(0.25, turn)
        .and_then(|rod| rod.with_point_load(0.15, tool))
        .unwrap();
    let rest = Statics { elements: 6, order: Order::Six, ..Statics::default() }.solve(&rod).unwrap();
    let balance = |steps: f64| {
        let scene = Scene::new(&rod)
            .with_load(sideways(), ramp)
            .with_point_load(0.3, DeadWrench::force(vector![0.0, 0.05, 0.0]).unwrap(), ramp)
            .unwrap()
            .with_base_motion(shaken)
            .with_tip_motion(|t: Dual2_64| {
                let mut pose = at(LENGTH).cast();
                pose.position.y = (t * 20.0).sin().powi(5) * 0.02;
                pose
            });
        let dynamics = Dynamics { track_work: true, ..fixed(0.2 / steps) };
        let mut stepper = dynamics.start(&scene, &Start::equilibrium(&rest)).unwrap();
        let begin = stepper.frame().unwrap().energies.elastic;
        stepper.run_to(0.2).unwrap();
        let e = stepper.frame().unwrap().energies;
        println!("{e:?}");
        assert!(e.dissipated > 1e-4 && e.work.abs() > 1e-2);
        e.kinetic + e.elastic - begin + e.dissipated - e.work
    };
    let errors = [balance(80.0), balance(160.0)].map(f64::abs);
    println!("{errors:?}");
    // the work of wrenches that hold what moves comes with order 3
    assert!(errors[1] < 1e-5 && errors[1] < errors[0] / 6.0, "{errors:?}");
}

fn momenta(frame: &Frame) -> [f64; 6] {
    let (p, l) = (frame.linear_momentum, frame.angular_momentum);
    [p.x, p.y, p.z, l.x, l.y, l.z]
}

/// Thrown with a body at either end and one between, out of line: momenta of the whole stay.
#[test]
fn a_thrown_rod_with_bodies_keeps_its_momenta() {
    let tool = |mass: f64, centre: [f64; 3]| {
        let gravity = Vector3::zeros();
        Payload::new(mass)
            .and_then(|tool| tool.with_centre(centre.into()))
            .and_then(|tool| tool.with_gravity(gravity))
            .and_then(|tool| tool.with_inertia(Matrix3::from_diagonal(&vector![1e-5, 2e-5, 2.5e-5])))
            .unwrap()
    };
    let rod = Rod::between(cylinder(), Support::free(), Support::free())
        .with_base_load(tool(0.05, [0.0, 0.01, 0.0]))
        .with_tip_load(tool(0.1, [0.02, 0.0, 0.03]))
        .with_point_load(0.15, tool(0.03, [0.0, 0.0, 0.0]))
        .unwrap();
    let scene = Scene::new(&rod);
    let spin = Twist::from_array([3.0, 0.0, 5.0, 0.1, 0.0, 0.0]);
    let bent = |s: f64| Strain::from_array([0.0, 2.0 * (s / LENGTH * PI).sin().powi(2), 0.0, 0.0, 0.0, 0.0]);
    let start = Start::at_rest().with_base_velocity(spin).with_strain(bent);
    for (scheme, dt) in
        [(Scheme::Esdirk43, 2e-3), (Scheme::Esdirk43, 1e-3), (Scheme::GeneralisedAlpha { rho: 0.9 }, 1e-3)]
    {
        let dynamics = Dynamics { scheme, elements: 4, ..fixed(dt) };
        let mut stepper = dynamics.start(&scene, &start).unwrap();
        let begin = stepper.frame().unwrap();
        stepper.run_to(0.4).unwrap();
        let frame = stepper.frame().unwrap();
        let (a, b) = (momenta(&begin), momenta(&frame));
        let change = (0..6).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
        let energy = frame.energies.total().unwrap() / begin.energies.total().unwrap() - 1.0;
        println!("{scheme:?} {dt}: momenta {change:.1e}, energy {energy:.1e}");
        // of 0.14 kg m/s; no scheme is made to keep them, and the start is rough
        let largest = if scheme == Scheme::Esdirk43 { 2e-8 } else { 2e-6 };
        assert!(change < largest && energy.abs() < 2e-4, "{scheme:?} {dt}: {change:.1e} {energy:.1e}");
    }
}

/// A rod of the same bending stiffness and mass, twice and four times thinner, comes to its inextensible, unshearable limit with the square.
#[test]
fn thin_rods_come_to_the_motion_without_shear_and_extension() {
    let tip = |radius: f64, constraint: Constraint| {
        let ratio = 0.01 / radius;
        let e = 5e5 * ratio.powi(4);
        let body = beam(LENGTH, circle(radius), [e, e / 3.0, 1000.0 * ratio * ratio]);
        let rod = Rod::clamped(body.with_constraint(constraint), at(0.0));
        let scene = Scene::new(&rod).with_load(sideways(), ramp);
        let dynamics = Dynamics { elements: 6, ..fixed(2e-3) };
        dynamics.run(&scene, &Start::at_rest(), 0.3, |_| ()).unwrap().tip().pose.position
    };
    let apart = [0.01, 0.005, 0.0025]
        .map(|radius| (tip(radius, Constraint::none()) - tip(radius, Constraint::kirchhoff())).norm());
    println!("{apart:?}");
    for pair in apart.windows(2) {
        assert!((pair[0] / pair[1] / 4.0 - 1.0).abs() < 0.1, "{apart:?}");
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
