//! Identities: the tangent, Ψ′, frames of reference, starts.
use hyperrod::material::{NeoHookean, Reference, Request, Station};
use hyperrod::section::{
    Annulus, Circle, CrossSection, Ellipse, Linear, Rectangle, Relaxed, Section, Shape, Warping,
};
use hyperrod::{Strain, Twist};
use nalgebra::Vector6;
use num_dual::Dual64;

use crate::{at_rest, relative, respond, solid};

const STRAIN: [f64; 6] = [0.2, -0.1, 0.4, 0.1, 0.05, 0.15];

/// Central differences of Ψ: step 1e-5, so that truncation (1e-10) and rounding (1e-11) are both below 1e-8.
fn differences(section: &dyn CrossSection, at: &Station, strain: [f64; 6]) -> [[f64; 6]; 6] {
    std::array::from_fn(|k| {
        let h = 1e-5;
        let psi = |sign: f64| {
            let mut moved = strain;
            moved[k] += sign * h;
            section.wrench(at, &Strain::from_array(moved)).unwrap().to_vector()
        };
        ((psi(1.0) - psi(-1.0)) / (2.0 * h)).into()
    })
}

#[test]
fn the_condensed_tangent_is_symmetric_and_the_derivative_of_the_wrench() {
    for section in [solid(Ellipse::new(1.0, 0.5), 9.0, (4, 3)), solid(Annulus::new(0.5, 1.0), 1.5, (2, 2))] {
        let k = respond(&section, STRAIN).tangent;
        assert_eq!(k, k.transpose());
        let expected = differences(&section, &at_rest(), STRAIN);
        assert!(relative(k.as_slice(), expected.as_flattened()) < 1e-8, "{k} {expected:?}");
    }
}

/// Oracle: U(ξ + δ) − U(ξ − δ) = 2 Ψ·δ; step 1e-4, truncation 1e-8 relative.
#[test]
fn the_wrench_is_the_derivative_of_the_energy() {
    let section = solid(Rectangle::new(1.0, 2.0), 9.0, (4, 3));
    let psi = respond(&section, STRAIN).wrench.to_array();
    let h = 1e-4;
    let got: [f64; 6] = std::array::from_fn(|k| {
        let energy = |sign: f64| {
            let mut moved = STRAIN;
            moved[k] += sign * h;
            section.energy(&at_rest(), &Strain::from_array(moved)).unwrap()
        };
        (energy(1.0) - energy(-1.0)) / (2.0 * h)
    });
    assert!(relative(&got, &psi) < 1e-7, "{got:?} {psi:?}");
}

/// With no functions at all it is the rigid section, about any reference.
#[test]
fn without_functions_it_is_the_rigid_section() {
    let reference = Reference {
        twist: Twist::from_array([0.2, -0.1, 0.3, 0.05, 0.0, 1.1]),
        rate: Twist::from_array([0.1, 0.2, 0.0, 0.0, 0.1, 0.0]),
    };
    let at = Station { s: 0.3, reference };
    let shape = || Ellipse::new(Linear { from: 0.5, to: 1.0, length: 1.0 }, 0.4);
    let law = NeoHookean::new(1.0, 1.5).unwrap();
    let rigid = Section::new(shape(), law).unwrap();
    let relaxed = Relaxed::new(shape(), law).unwrap().with_warping(Warping::RIGID).unwrap();
    let strain = Strain::from_array(STRAIN);
    let [a, b] =
        [&rigid as &dyn CrossSection, &relaxed].map(|s| s.respond(&at, &strain, Request::Rate).unwrap());
    assert!((a.energy - b.energy).abs() < 1e-13);
    assert!(relative(&b.wrench.to_array(), &a.wrench.to_array()) < 1e-13);
    assert!(relative(b.tangent.as_slice(), a.tangent.as_slice()) < 1e-13);
    assert!(relative(&b.wrench_rate.to_array(), &a.wrench_rate.to_array()) < 1e-13);
}

/// Oracle: central differences in s, step 1e-4; truncation 1e-8, rounding 1e-11.
fn check_rate(section: &dyn CrossSection, at: impl Fn(f64) -> Station) {
    let strain = Strain::from_array(STRAIN);
    let rate = section.wrench_rate(&at(0.3), &strain).unwrap().to_array();
    let h = 1e-4;
    let psi = |s: f64| section.wrench(&at(s), &strain).unwrap().to_vector();
    let expected: Vector6<f64> = (psi(0.3 + h) - psi(0.3 - h)) / (2.0 * h);
    assert!(expected.norm() > 1e-3, "a rate that vanishes shows nothing");
    assert!(relative(&rate, expected.as_slice()) < 1e-6, "{rate:?} {expected}");
}

#[test]
fn the_rate_of_a_section_that_tapers_turns_and_shifts_is_the_derivative_along_s() {
    let law = NeoHookean::new(1.0, 1.5).unwrap();
    let taper = Linear { from: 1.0, to: 0.7, length: 1.0 };
    let shape = Ellipse::new(taper, 0.6).rotated(|s: Dual64| s * 0.8).shifted(|s: Dual64| s * s * 0.2, 0.1);
    let section = Relaxed::new(shape, law).unwrap().with_warping(Warping { in_plane: 3, axial: 2 }).unwrap();
    check_rate(&section, Station::straight);
    assert_eq!(
        section.mode_count(),
        3 + 2 * 7 + 3,
        "three uniform ones, seven functions twice in the plane, three axial ones"
    );
    let tube = Annulus::new(0.4, Linear { from: 1.0, to: 0.8, length: 1.0 });
    let section = Relaxed::new(tube, law).unwrap().with_warping(Warping { in_plane: 2, axial: 2 }).unwrap();
    check_rate(&section, Station::straight);
}

#[test]
fn the_rate_about_a_reference_that_varies_is_the_derivative_along_s() {
    let mu = 1.3;
    let law = hyperrod::isotropic!([mu: f64] |i, at| {
        let ln_j = i.j().ln_1p();
        (i.i1_excess() + hyperrod::scalar::x_minus_ln_1p(i.j()) * 2.0 + ln_j * ln_j) * (at.s * 0.5 + at.x * 0.2 + 1.0) * mu
    });
    let section = Relaxed::new(Rectangle::new(1.0, 0.8), law)
        .unwrap()
        .with_warping(Warping { in_plane: 3, axial: 2 })
        .unwrap();
    check_rate(&section, |s| {
        let twist = Twist::from_array([0.2 + s, 0.1, 0.3 * s, 0.1 * s, 0.0, 1.0 + 0.2 * s]);
        let rate = Twist::from_array([1.0, 0.0, 0.3, 0.1, 0.0, 0.2]);
        Station { s, reference: Reference { twist, rate } }
    });
}

/// A rod curved at rest and straightened: the same energy as the same deformation the other way cannot be had, but a rigid rotation of
/// the frame can: turning shape, reference and strain by an angle about e₃ turns the wrench.
#[test]
fn the_frame_of_the_section_does_not_matter() {
    let angle: f64 = 0.7;
    let (sin, cos) = angle.sin_cos();
    let turn = |v: [f64; 6]| {
        let pair = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
        let ([a, b], [c, d]) = (pair(v[0], v[1]), pair(v[3], v[4]));
        [a, b, v[2], c, d, v[5]]
    };
    let xi = [0.3, -0.2, 0.1, 0.05, -0.1, 1.2];
    let at = |xi: [f64; 6]| Station {
        s: 0.0,
        reference: Reference { twist: Twist::from_array(xi), rate: Twist::zero() },
    };
    let one = solid(Rectangle::new(1.0, 0.6).shifted(0.1, 0.0), 9.0, (4, 3));
    let other = solid(Rectangle::new(1.0, 0.6).shifted(0.1, 0.0).rotated(angle), 9.0, (4, 3));
    let a = one.wrench(&at(xi), &Strain::from_array(STRAIN)).unwrap().to_array();
    let b = other.wrench(&at(turn(xi)), &Strain::from_array(turn(STRAIN))).unwrap().to_array();
    assert!(relative(&b, &turn(a)) < 1e-9, "{a:?} {b:?}");
}

/// The answer depends on the strain alone: bit for bit without a start, to rounding with one.
#[test]
fn answers_do_not_depend_on_what_was_asked_before() {
    let section = solid(Circle::new(1.0), 9.0, (4, 3));
    let first = respond(&section, STRAIN);
    respond(&section, STRAIN.map(|v| -v));
    assert_eq!(first, respond(&section, STRAIN));

    let ask = |start, factor: f64| {
        let strain = Strain::from_array(STRAIN.map(|v| v * factor));
        section.respond_from(start, &at_rest(), &strain, Request::Tangent).unwrap()
    };
    let (_, near) = ask(None, 0.95);
    let (warm, relaxation) = ask(Some(&near), 1.0);
    assert!(relaxation.iterations() <= 3, "{}", relaxation.iterations());
    // Ψ to the square of the last correction, ∂Ψ to the correction itself, 1e-9
    assert!(relative(&warm.wrench.to_array(), &first.wrench.to_array()) < 1e-13);
    assert!(relative(warm.tangent.as_slice(), first.tangent.as_slice()) < 1e-8);
}

/// Strains of 1e-12 keep their digits: Ψ = K Δξ to rounding.
#[test]
fn a_tiny_strain_keeps_its_digits() {
    let section = solid(Rectangle::new(1.0, 0.6), 9.0, (4, 3));
    let k = respond(&section, [0.0; 6]).tangent;
    let strain = Strain::from_array(STRAIN.map(|v| v * 1e-12));
    let psi = section.wrench(&at_rest(), &strain).unwrap().to_array();
    let expected = k * strain.to_vector();
    // second order in the strain: 1e-12 times a factor of some tens
    assert!(relative(&psi, expected.as_slice()) < 1e-10, "{psi:?} {expected}");
}
