//! Frequencies of rods held at both ends, at one point, or nowhere, and of rods with a body at the tip.

use crate::cases::{Beam, beam, circle};
use crate::oracle::{self, Timoshenko};

use hyperrod::body::Constraint;
use hyperrod::load::{Gravity, Payload};
use hyperrod::rod::{Freedom, Support};

use hyperrod::solve::dynamics::{Dynamics, Mode, Scene, Start};
use hyperrod::{Pose, Rod};
use nalgebra::{Matrix2x4, Matrix3, vector};
use std::f64::consts::PI;

/// Two conditions on (u, θ, m, n) at an end, at a circular frequency.
type Condition = dyn Fn(f64) -> Matrix2x4<f64>;

const LENGTH: f64 = 0.4;
const RADIUS: f64 = 0.005;
const NUMBERS: [f64; 3] = [5e5, 5e5 / 3.0, 1000.0];

pub fn at(z: f64) -> Pose {
    Pose::new(Matrix3::identity(), vector![0.0, 0.0, z])
}

fn body() -> Beam {
    beam(LENGTH, circle(RADIUS), NUMBERS)
}

fn modes(rod: &Rod<Beam>, count: usize) -> Vec<Mode> {
    let dynamics = Dynamics { elements: 16, ..Dynamics::default() };
    dynamics.modes(&Scene::new(rod), &Start::at_rest(), count).unwrap()
}

/// The first roots of the frequency equation, each of which is a frequency of a mode, and no slower bending frequency is missed or added.
fn assert_bending_frequencies(
    modes: &[Mode],
    beam: &Timoshenko,
    (base, tip): (&Condition, &Condition),
    what: &str,
) {
    let slowest = (beam.bending / beam.mass).sqrt() / (beam.length * beam.length);
    let value = |omega: f64| beam.determinant(omega, base, tip);
    let mut found = Vec::new();
    let mut before = 0.02 * slowest;
    while found.len() < 3 {
        let next = before * 1.01;
        if value(before) * value(next) < 0.0 {
            let (mut a, mut b) = (before, next);
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                if value(a) * value(middle) <= 0.0 { b = middle } else { a = middle }
            }
            found.push(a);
        }
        before = next;
        assert!(before < 1e4 * slowest, "{what}: {found:?}");
    }
    for omega in found {
        let nearest = modes.iter().map(|m| (m.angular_frequency() / omega - 1.0).abs());
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{what} {omega}: {nearest:.1e}");
    }
}

/// Oracle: the frequency equation of the Timoshenko beam. A ball joint at both ends, one of them kept from spinning; springs at the tip.
#[test]
fn natural_frequencies_follow_the_end_conditions() {
    let (clamped, pinned) = (Support::clamped, Support::pinned);
    let no_spin = |support: Support| support.holding(Freedom::RotationZ, 0.0).unwrap();
    let spring = 3.0; // N/m, some 20 EI/L³
    let turning = 2e-3; // N m/rad, some 3 EI/L
    let mut sprung = Support::free();
    for (freedom, stiffness) in [
        (Freedom::X, spring),
        (Freedom::Y, spring),
        (Freedom::RotationX, turning),
        (Freedom::RotationY, turning),
    ] {
        sprung = sprung.with_spring(freedom, stiffness).unwrap();
    }
    let sliding = clamped(at(LENGTH)).releasing([Freedom::X, Freedom::Y]);
    let guided = |_: f64| Matrix2x4::new(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let on_springs = move |_: f64| Matrix2x4::new(spring, 0.0, 0.0, 1.0, 0.0, turning, 1.0, 0.0);
    let here = at(0.0);
    let there = at(LENGTH);
    let cases: [(&str, Support, Support, &Condition, &Condition); 7] = [
        ("clamped-clamped", clamped(here), clamped(there), &oracle::clamped, &oracle::clamped),
        ("clamped-pinned", clamped(here), pinned(there), &oracle::clamped, &oracle::pinned),
        ("pinned-pinned", no_spin(pinned(here)), pinned(there), &oracle::pinned, &oracle::pinned),
        ("pinned-free", no_spin(pinned(here)), Support::free(), &oracle::pinned, &oracle::free),
        ("free-free", Support::free(), Support::free(), &oracle::free, &oracle::free),
        ("clamped-guided", clamped(here), sliding, &oracle::clamped, &guided),
        ("clamped-sprung", clamped(here), sprung.with_frame(there), &oracle::clamped, &on_springs),
    ];
    let timoshenko = Timoshenko::circle(RADIUS, LENGTH, NUMBERS);
    for (what, base, tip, at_base, at_tip) in cases {
        let found = modes(&Rod::between(body(), base, tip), 16);
        assert_bending_frequencies(&found, &timoshenko, (at_base, at_tip), what);
    }
}

/// Oracle: the frequency equation with the inertia of a body whose centre is 3 cm beyond the tip, three times as heavy as the rod.
#[test]
fn a_body_at_the_tip_slows_the_rod_as_its_inertia_says() {
    let timoshenko = Timoshenko::circle(RADIUS, LENGTH, NUMBERS);
    let (mass, centre) = (3.0 * timoshenko.mass * LENGTH, 0.03);
    let moment = mass * 0.02 * 0.02;
    let with_body = move |omega: f64| {
        let w = omega * omega;
        let about_tip = moment + mass * centre * centre;
        // n = ω² M (u + c θ), m = ω² (M c u + (J + M c²) θ)
        Matrix2x4::new(-w * mass, -w * mass * centre, 0.0, 1.0, -w * mass * centre, -w * about_tip, 1.0, 0.0)
    };
    let body_at_tip = Payload::new(mass)
        .and_then(|payload| payload.with_centre(vector![0.0, 0.0, centre]))
        .and_then(|payload| payload.with_gravity(vector![0.0, 0.0, 0.0]))
        .and_then(|payload| payload.with_inertia(Matrix3::identity() * moment));
    let rod = Rod::clamped(body(), at(0.0)).with_tip_load(body_at_tip.unwrap());
    let found = modes(&rod, 12);
    assert_bending_frequencies(&found, &timoshenko, (&oracle::clamped, &with_body), "clamped-body");
}

/// Oracle: the frequency equation without shear, rotary inertia kept: a rod that is inextensible and unshearable.
#[test]
fn fixed_strains_leave_the_frequencies_of_euler_and_bernoulli_with_rotary_inertia() {
    let timoshenko = Timoshenko { shear: 1e300, ..Timoshenko::circle(RADIUS, LENGTH, NUMBERS) };
    let kirchhoff = || body().with_constraint(Constraint::kirchhoff());
    let found = modes(&Rod::clamped(kirchhoff(), at(0.0)), 12);
    assert_bending_frequencies(
        &found,
        &timoshenko,
        (&oracle::clamped, &oracle::free),
        "kirchhoff clamped-free",
    );
    let hinge = Support::pinned(at(0.0)).holding(Freedom::RotationZ, 0.0).unwrap();
    let slide = Support::pinned(at(LENGTH)).releasing([Freedom::Z]);
    let found = modes(&Rod::between(kirchhoff(), hinge, slide), 12);
    assert_bending_frequencies(
        &found,
        &timoshenko,
        (&oracle::pinned, &oracle::pinned),
        "kirchhoff pinned-pinned",
    );
}

/// Oracle: a rigid pendulum, ω² = M g l / I: a stiff rod that hangs on a hinge, its stiffness but that of its weight being far above.
#[test]
fn a_stiff_rod_on_a_hinge_has_the_frequency_of_a_pendulum() {
    let hanging = Pose::new(hyperrod::lie::so3::exp(&vector![0.0, PI, 0.0]), vector![0.0, 0.0, 0.0]);
    let hinge = Support::pinned(hanging).holding(Freedom::RotationX, 0.0).unwrap();
    let hinge = hinge.holding(Freedom::RotationZ, 0.0).unwrap();
    let (radius, length, heavy) = (0.01, 0.5, 0.3);
    let body = beam(length, circle(radius), [5e12, 2e12, 1000.0]);
    let rod = Rod::between(body, hinge, Support::free())
        .with_load(Gravity::standard())
        .with_tip_load(Payload::new(heavy).unwrap());
    let mass = 1000.0 * PI * radius * radius * length;
    let inertia = mass * (length * length / 3.0 + 0.25 * radius * radius) + heavy * length * length;
    let omega = (9.80665 * (0.5 * mass + heavy) * length / inertia).sqrt();
    let dynamics = Dynamics { elements: 3, ..Dynamics::default() };
    let found = dynamics.modes(&Scene::new(&rod), &Start::at_rest().with_base(hanging), 1).unwrap();
    // it bends by M g l²/EI, some 1e-6
    let error = found[0].angular_frequency() / omega - 1.0;
    assert!(error.abs() < 1e-5, "{error:.1e}");
}
