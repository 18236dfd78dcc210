//! Closed forms at finite strain: Mooney's tension and Rivlin's torsion, with and without the pressure.
use hyperrod::Strain;
use hyperrod::material::{MooneyRivlin, NeoHookean, ReferencePressure, Request, Station};
use hyperrod::section::{Annulus, Circle, CrossSection, Ellipse, Linear, Rectangle, Relaxed, Shape, Warping};
use nalgebra::Vector6;
use std::f64::consts::PI;

use crate::{relative, respond};

type Rubber = ReferencePressure<MooneyRivlin>;

fn rubber(c1: f64, c2: f64) -> Rubber {
    ReferencePressure(MooneyRivlin::new(c1, c2).unwrap())
}

fn incompressible(
    shape: impl Shape + 'static,
    law: Rubber,
    warping: Warping,
) -> Relaxed<Box<dyn Shape>, Rubber> {
    let shape: Box<dyn Shape> = Box::new(shape);
    Relaxed::incompressible(shape, law).unwrap().with_warping(warping).unwrap()
}

/// Oracle: N = 2A(λ − λ⁻²)(C₁ + C₂/λ), and its derivative. Rounding: 1e-13 leaves two digits to the sums; the tangent carries the
/// last correction, 1e-9.
#[test]
fn incompressible_tension_is_mooney_s_to_rounding() {
    for (c1, c2) in [(0.5, 0.0), (0.4, 0.1)] {
        for (shape, area) in
            [(Box::new(Circle::new(1.0)) as Box<dyn Shape>, PI), (Box::new(Rectangle::new(2.0, 0.5)), 1.0)]
        {
            let section = incompressible(shape, rubber(c1, c2), Warping::ANTICLASTIC);
            for stretch in [0.6_f64, 1.0 + 1e-9, 1.5, 3.0] {
                let response = respond(&section, [0.0, 0.0, 0.0, 0.0, 0.0, stretch - 1.0]);
                let e = stretch - 1.0; // λ − λ⁻² without cancellation
                let exact = 2.0 * area * e * (3.0 + e * (3.0 + e)) / stretch.powi(2) * (c1 + c2 / stretch);
                assert!(
                    (response.wrench.force.z / exact - 1.0).abs() < 1e-13,
                    "{stretch}: {}",
                    response.wrench.force.z
                );
                let slope = 2.0 * area * (c1 * (1.0 + 2.0 * stretch.powi(-3)) + 3.0 * c2 * stretch.powi(-4));
                assert!((response.tangent[(5, 5)] / slope - 1.0).abs() < 1e-8, "{stretch}");
            }
        }
    }
}

/// Oracle: Rivlin (1949), M = πτa⁴(C₁ + C₂), N = −(π/2)τ²a⁴(C₁ + 2C₂) at length kept.
#[test]
fn incompressible_torsion_is_rivlin_s() {
    let a: f64 = 1.3;
    for (c1, c2) in [(0.5, 0.0), (0.4, 0.1)] {
        for warping in [Warping::CONTRACTION, Warping::SHEAR] {
            let section = incompressible(Circle::new(a), rubber(c1, c2), warping);
            for twist in [0.01, 0.5, 1.5] {
                let wrench = respond(&section, [0.0, 0.0, twist, 0.0, 0.0, 0.0]).wrench;
                let torque = PI * twist * a.powi(4) * (c1 + c2);
                let force = -0.5 * PI * twist * twist * a.powi(4) * (c1 + 2.0 * c2);
                assert!(
                    (wrench.moment.z / torque - 1.0).abs() < 1e-8,
                    "{warping} {twist}: {}",
                    wrench.moment.z / torque
                );
                assert!(
                    (wrench.force.z / force - 1.0).abs() < 1e-8,
                    "{warping} {twist}: {}",
                    wrench.force.z / force
                );
            }
        }
    }
}

/// At ν = 0.499 without the pressure: tension and torque are those of the incompressible material within 1e-3.
///
/// The axial force of twist is not: it is the integral of the pressure λ ln J alone, and what the law itself makes of it is
/// −(π/4)μτ²a⁴ [1 − (μ/λ)(1 + τ²a²/3)], 2.2e-3 below Rivlin's. It follows from the radial balance of u = μ/2 (I₁ − 3) − μ ln J + λ/2 ln²J
/// with r = R + v(R)/λ to the second order in 1/λ. What is left out is of the size (μ/λ)² = 4e-6.
#[test]
fn nearly_incompressible_rubber_needs_no_pressure_for_three_digits() {
    let (mu, poisson) = (1.0, 0.499);
    let law = NeoHookean::from_young(2.0 * mu * (1.0 + poisson), poisson).unwrap();
    let ratio = (1.0 - 2.0 * poisson) / (2.0 * poisson); // μ/λ
    let section =
        Relaxed::new(Circle::new(1.0), law).unwrap().with_warping(Warping { in_plane: 5, axial: 0 }).unwrap();
    let stretched = respond(&section, [0.0, 0.0, 0.0, 0.0, 0.0, 0.5]).wrench.force.z;
    let exact = PI * mu * (1.5 - 1.5_f64.powi(-2));
    assert!((stretched / exact - 1.0).abs() < 1e-3, "{}", stretched / exact);
    for twist in [0.2_f64, 0.5, 1.0] {
        let wrench = respond(&section, [0.0, 0.0, twist, 0.0, 0.0, 0.0]).wrench;
        assert!((wrench.moment.z / (0.5 * PI * mu * twist) - 1.0).abs() < 1e-3, "{}", wrench.moment.z);
        let rivlin = -0.25 * PI * mu * twist * twist;
        let force = rivlin * (1.0 - ratio * (1.0 + twist * twist / 3.0));
        assert!((wrench.force.z / force - 1.0).abs() < 1e-5, "{twist}: {:e}", wrench.force.z / force - 1.0);
    }
}

/// Bending of an incompressible section does not lock: EI = 3μI at rest, and at finite strain what ν → ½ tends to.
#[test]
fn incompressible_bending_is_the_limit_of_nearly_incompressible_bending() {
    let mixed = incompressible(Rectangle::new(1.0, 1.0), rubber(0.5, 0.0), Warping::SHEAR);
    let k = respond(&mixed, [0.0; 6]).tangent;
    assert!((k[(0, 0)] / (3.0 / 12.0) - 1.0).abs() < 1e-10 && (k[(3, 3)] * 1.2 - 1.0).abs() < 1e-8, "{k}");
    let moment = respond(&mixed, [0.3, 0.0, 0.0, 0.0, 0.0, 0.0]).wrench.moment.x;
    let nearly = |lambda: f64| {
        let law = NeoHookean::new(1.0, lambda).unwrap();
        let section =
            Relaxed::new(Rectangle::new(1.0, 1.0), law).unwrap().with_warping(Warping::LARGE).unwrap();
        respond(&section, [0.3, 0.0, 0.0, 0.0, 0.0, 0.0]).wrench.moment.x
    };
    // first order in 1/λ: Richardson's 2 M(2λ) − M(λ) leaves (1/λ)² = 1e-5
    let limit = 2.0 * nearly(800.0) - nearly(400.0);
    assert!((moment / limit - 1.0).abs() < 1e-3, "{moment} {limit}");
}

/// Oracle: central differences of Ψ, step 1e-5, and of Ψ along s, step 1e-4.
#[test]
fn tangent_and_rate_of_an_incompressible_section_are_derivatives() {
    let strain = [0.2, -0.1, 0.4, 0.1, 0.05, 0.15];
    let taper = Linear { from: 1.0, to: 0.7, length: 1.0 };
    let section = incompressible(Ellipse::new(taper, 0.6), rubber(0.4, 0.1), Warping::balanced(2));
    let at = Station::straight(0.3);
    let psi = |s: f64, strain: [f64; 6]| {
        section.wrench(&Station::straight(s), &Strain::from_array(strain)).unwrap().to_vector()
    };
    let response = section.respond(&at, &Strain::from_array(strain), Request::Rate).unwrap();
    for k in 0..6 {
        let moved = |sign: f64| std::array::from_fn(|i| strain[i] + if i == k { sign * 1e-5 } else { 0.0 });
        let column = (psi(0.3, moved(1.0)) - psi(0.3, moved(-1.0))) / 2e-5;
        assert!(relative(response.tangent.column(k).as_slice(), column.as_slice()) < 1e-7, "{k}");
    }
    let rate: Vector6<f64> = (psi(0.3001, strain) - psi(0.2999, strain)) / 2e-4;
    assert!(relative(&response.wrench_rate.to_array(), rate.as_slice()) < 1e-6, "{rate}");
}

/// A law of all nine entries gives what the invariants give: the same energy written by the user over the deformation gradient, at the
/// `Local` level; Ogden's law with α = 2 is a neo-Hookean one, and Hencky's has the same small strains.
#[test]
fn local_laws_relax_as_isotropic_ones_do() {
    use hyperrod::material::{Hencky, Ogden};
    let strain = [0.2, -0.1, 0.4, 0.1, 0.05, 0.15];
    let warping = Warping::balanced(2);
    let isotropic = Relaxed::new(Annulus::new(0.3, 1.0), NeoHookean::new(1.0, 1.5).unwrap()).unwrap();
    let ogden = Relaxed::new(Annulus::new(0.3, 1.0), Ogden::new(&[(1.0, 2.0)], 1.5).unwrap()).unwrap();
    let [a, b] = [
        respond(&isotropic.with_warping(warping).unwrap(), strain),
        respond(&ogden.with_warping(warping).unwrap(), strain),
    ];
    assert!((a.energy - b.energy).abs() < 1e-12, "{} {}", a.energy, b.energy);
    assert!(relative(&b.wrench.to_array(), &a.wrench.to_array()) < 1e-10);
    assert!(relative(b.tangent.as_slice(), a.tangent.as_slice()) < 1e-8);
    let hencky = Relaxed::new(Circle::new(1.0), Hencky::new(1.0, 1.5).unwrap())
        .unwrap()
        .with_warping(warping)
        .unwrap();
    // Hencky's law in tension: N = A E ln λ / λ · λ^(−2ν) in Cauchy's sense, that is E ln λ / λ on the reference area
    let force = respond(&hencky, [0.0, 0.0, 0.0, 0.0, 0.0, 0.5]).wrench.force.z;
    assert!((force / (PI * 2.6 * 1.5_f64.ln() / 1.5) - 1.0).abs() < 1e-10, "{force}");
}
