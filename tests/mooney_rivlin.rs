//! Mooney–Rivlin on a rigid section is linear, and the three corrections to the source text, each against its closed form.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use std::f64::consts::PI;

use hyperrod::material::{
    self, LinearElastic, Material, MooneyRivlin, NeoHookean, ReferencePressure, Station, StressFree,
};
use hyperrod::section::{Circle, CrossSection, Linear, Rectangle, Section, Shape};
use hyperrod::{Strain, Wrench};
use nalgebra::{Matrix6, Vector6};
use num_dual::DualNum;

const C1: f64 = 120e3;
const C2: f64 = 40e3;
/// Width along x and height along y of the rectangle, m.
const SIDES: [f64; 2] = [0.02, 0.012];
const RADIUS: f64 = 0.01;

/// Sums of some ten products: a few roundings of 1e-16. Measured 8e-16.
const ROUNDING: f64 = 5e-15;

fn mooney() -> MooneyRivlin {
    MooneyRivlin::new(C1, C2).unwrap()
}

fn respond(shape: impl Shape, law: impl Material, strain: [f64; 6]) -> (Wrench, Matrix6<f64>) {
    let section = Section::new(shape, law).unwrap();
    let (at, strain) = (Station::straight(0.0), Strain::from_array(strain));
    (section.wrench(&at, &strain).unwrap(), section.tangent(&at, &strain).unwrap())
}

/// diag(EI_x, EI_y, GJ, GA, GA, EA) from (A, I_x, I_y), with I_x = ∫y² dA and I_y = ∫x² dA.
fn classical([area, i_x, i_y]: [f64; 3], young: f64, shear: f64) -> Vector6<f64> {
    Vector6::from([young * i_x, young * i_y, shear * (i_x + i_y), shear * area, shear * area, young * area])
}

fn circle() -> [f64; 3] {
    let i = PI * RADIUS.powi(4) / 4.0;
    [PI * RADIUS * RADIUS, i, i]
}

fn rectangle() -> [f64; 3] {
    let [b, h] = SIDES;
    [b * h, b * h.powi(3) / 12.0, h * b.powi(3) / 12.0]
}

/// The largest entry of K − diag relative to √(K_ii K_jj).
fn distance(k: &Matrix6<f64>, diagonal: &Vector6<f64>) -> f64 {
    let d = k - Matrix6::from_diagonal(diagonal);
    d.map_with_location(|i, j, d| d / (diagonal[i] * diagonal[j]).sqrt()).amax()
}

/// Large: bent to a radius of five half-heights, twisted, sheared by a third, stretched by a half.
const LARGE: [f64; 6] = [15.0, -20.0, 80.0, 0.3, -0.35, 0.5];

#[test]
fn with_reference_pressure_the_wrench_is_linear_for_any_strain() {
    let (young, shear) = (2.0 * C1 + 4.0 * C2, 2.0 * C1 + 2.0 * C2);
    assert_eq!((mooney().axial_modulus(), mooney().shear_modulus()), (young, shear));
    for scale in [1.0, 1e-3, 1e-12] {
        let strain = LARGE.map(|v| v * scale);
        for (area, (wrench, k)) in [
            (circle(), respond(Circle::new(RADIUS), ReferencePressure(mooney()), strain)),
            (rectangle(), respond(Rectangle::new(SIDES[0], SIDES[1]), ReferencePressure(mooney()), strain)),
        ] {
            let diagonal = classical(area, young, shear);
            assert!(distance(&k, &diagonal) < ROUNDING, "scale {scale}: {:.1e}", distance(&k, &diagonal));
            let exact = diagonal.component_mul(&Vector6::from(strain));
            // moments cancel from forces at a distance: relative to the largest, in units of the section's size
            let unit = |i: usize| if i < 3 { RADIUS } else { 1.0 };
            let size = (0..6).map(|i| (exact[i] / unit(i)).abs()).fold(0.0, f64::max);
            for (i, value) in wrench.to_array().into_iter().enumerate() {
                let error = (value - exact[i]).abs() / unit(i) / size;
                assert!(error < ROUNDING, "scale {scale}, component {i}: {error:.1e}");
            }
        }
    }
}

/// The linear law of the classical theory with the same two moduli is the same section.
#[test]
fn with_reference_pressure_it_is_the_classical_linear_rod() {
    let linear = LinearElastic::new(mooney().axial_modulus(), mooney().shear_modulus()).unwrap();
    let (a, k) = respond(Rectangle::new(SIDES[0], SIDES[1]), linear, LARGE);
    let (b, l) = respond(Rectangle::new(SIDES[0], SIDES[1]), ReferencePressure(mooney()), LARGE);
    assert!((a - b).to_vector().norm() < ROUNDING * b.to_vector().norm());
    assert!((k - l).norm() < ROUNDING * l.norm());
}

/// Correction 1: the source's energy pulls at rest with (2C₁ + 4C₂)A, which its Ψ = KΔξ leaves out.
#[test]
fn the_energy_as_the_source_writes_it_is_not_stress_free() {
    for (area, (wrench, _)) in [
        (circle(), respond(Circle::new(RADIUS), mooney(), [0.0; 6])),
        (rectangle(), respond(Rectangle::new(SIDES[0], SIDES[1]), mooney(), [0.0; 6])),
    ] {
        let pull = (2.0 * C1 + 4.0 * C2) * area[0];
        let exact = Wrench::from_array([0.0, 0.0, 0.0, 0.0, 0.0, pull]);
        assert!((wrench - exact).to_vector().norm() < ROUNDING * pull, "{wrench:?}");
    }
}

/// Correction 2: ω_x, bending about x, strains the fibres by y. The source has x² there.
#[test]
fn bending_about_x_meets_the_second_moment_of_y() {
    let [b, h] = SIDES;
    let young = 2.0 * C1 + 4.0 * C2;
    let (_, k) = respond(Rectangle::new(b, h), ReferencePressure(mooney()), [0.0; 6]);
    let (i_x, i_y) = (b * h * h * h / 12.0, h * b * b * b / 12.0);
    assert!((k[(0, 0)] / (young * i_x) - 1.0).abs() < ROUNDING);
    assert!((k[(1, 1)] / (young * i_y) - 1.0).abs() < ROUNDING);
    // with b/h = 5/3 the swapped entries are (5/3)² apart
    assert!((k[(1, 1)] / k[(0, 0)] - (b / h).powi(2)).abs() < 1e-14);
}

/// Correction 3: E = 2C₁ + 4C₂ belongs to a section that cannot contract. Let a fibre contract so that J = 1, and the same two constants give
/// E = 6(C₁ + C₂), while G = 2(C₁ + C₂) stays.
#[test]
fn a_fibre_that_contracts_has_another_axial_modulus() {
    let relaxed = material::local(|f, _at| {
        let g = f.gamma();
        let (shear, c) = (g.x * g.x + g.y * g.y, g.z + 1.0);
        let i1 = c.recip() * 2.0 + c * c + shear - 3.0;
        let i2 = (c * c).recip() + c * 2.0 + shear / c - 3.0;
        i1 * C1 + i2 * C2
    });
    let (rest, k) = respond(Rectangle::new(SIDES[0], SIDES[1]), relaxed, [0.0; 6]);
    let diagonal = classical(rectangle(), 6.0 * (C1 + C2), 2.0 * (C1 + C2));
    // the invariants are not written as deviations here: roundings of 3
    assert!(distance(&k, &diagonal) < 1e-14, "{:.1e}", distance(&k, &diagonal));
    assert!(rest.to_vector().norm() < 1e-14 * diagonal[5]);
    assert!(diagonal[5] > 2.3 * mooney().axial_modulus() * rectangle()[0]);
}

/// Correction 3 for a compressible law: λ + 2μ on a rigid section, not the Young's modulus it was made from.
#[test]
fn a_compressible_law_on_a_rigid_section_has_the_uniaxial_strain_modulus() {
    let (young, nu) = (1e6, 0.4);
    let (rest, k) = respond(Circle::new(RADIUS), NeoHookean::from_young(young, nu).unwrap(), [0.0; 6]);
    let shear = young / (2.0 * (1.0 + nu));
    let axial = young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    assert!(distance(&k, &classical(circle(), axial, shear)) < ROUNDING);
    assert!(axial > 2.1 * young);
    assert_eq!(rest, Wrench::zero());
}

#[test]
fn stress_free_takes_the_wrench_at_rest_off_any_law_and_leaves_its_tangent() {
    let pull = 5e4;
    type Pair = (&'static str, Box<dyn Material>, Box<dyn Material>);
    let laws: Vec<Pair> = vec![
        ("Mooney-Rivlin", Box::new(mooney()), Box::new(StressFree(mooney()))),
        (
            "sectional macro",
            Box::new(
                hyperrod::sectional!([pull: f64] |xi, at| (xi.linear.z + xi.angular.x * at.y) * pull + xi.angular.z * pull),
            ),
            Box::new(StressFree(
                hyperrod::sectional!([pull: f64] |xi, at| (xi.linear.z + xi.angular.x * at.y) * pull + xi.angular.z * pull),
            )),
        ),
        (
            "closure",
            Box::new(material::isotropic(move |i, at| (i.j() + 1.0).exp() * (at.x * 30.0 + 1.0) * pull)),
            Box::new(StressFree(material::isotropic(move |i, at| {
                (i.j() + 1.0).exp() * (at.x * 30.0 + 1.0) * pull
            }))),
        ),
    ];
    let at = Station::straight(0.05);
    let taper = Linear { from: 0.01, to: 0.006, length: 0.1 };
    for (name, raw, free) in laws {
        let raw = Section::new(Rectangle::new(0.02, taper), raw).unwrap();
        let free = Section::new(Rectangle::new(0.02, taper), free).unwrap();
        let zero = Strain::zero();
        assert!(raw.wrench(&at, &zero).unwrap().to_vector().norm() > 1.0, "{name} is stressed at rest");
        // the same numbers subtracted from themselves
        assert_eq!(free.energy(&at, &zero).unwrap(), 0.0, "{name}");
        assert_eq!(free.wrench(&at, &zero).unwrap(), Wrench::zero(), "{name}");
        assert_eq!(free.wrench_rate(&at, &zero).unwrap(), Wrench::zero(), "{name}");
        let strain = Strain::from_array([3.0, -2.0, 1.0, 0.01, 0.02, 0.03]);
        assert_eq!(raw.tangent(&at, &strain).unwrap(), free.tangent(&at, &strain).unwrap(), "{name}");
    }
}

/// For Mooney–Rivlin the wrench at rest is that of the pressure −(2C₁ + 4C₂)(J − 1): both wrappers are one.
#[test]
fn stress_free_and_reference_pressure_agree_on_mooney_rivlin() {
    let shape = || Rectangle::new(SIDES[0], SIDES[1]);
    let (a, k) = respond(shape(), StressFree(mooney()), LARGE);
    let (b, l) = respond(shape(), ReferencePressure(mooney()), LARGE);
    assert!((a - b).to_vector().norm() < ROUNDING * b.to_vector().norm());
    assert!((k - l).norm() < ROUNDING * l.norm());
}
