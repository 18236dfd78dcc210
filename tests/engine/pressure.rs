//! The pressure that a law has at rest, taken off by the engine, against the law with its pressure taken off by hand.

use hyperrod::material::{Invariants, Isotropic, Point, ReferencePressure, Request, Station};
use hyperrod::section::{Circle, CrossSection, Linear, Rectangle, Relaxed, Section, Shape, Warping};
use hyperrod::{Scalar, Strain};
use num_dual::{Dual2_64, Dual64};

/// Pulls at rest with ∂u/∂J = 2c: c (I₁ − 3) + κ/2 (J − 1)², with c growing along the rod and over the section.
#[derive(Clone, Copy)]
struct Graded;

/// The same, less 2c (J − 1).
#[derive(Clone, Copy)]
struct ByHand;

const KAPPA: f64 = 5e5;

fn shear<D: Scalar>(at: &Point<D>) -> D {
    (at.s * 0.8 + at.x * 30.0 - at.y * 20.0).exp() * 1e5
}

impl Isotropic for Graded {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, at: &Point<D>) -> D {
        // locks, so that it is no polynomial
        let c = shear(at);
        let i1 = i.i1();
        i1 * c + (i1 * i1 * 0.1).exp_m1() * c + i.j() * i.j() * (0.5 * KAPPA)
    }
}

impl Isotropic for ByHand {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, at: &Point<D>) -> D {
        let c = shear(at);
        let i1 = i.i1();
        i.i1_excess() * c + (i1 * i1 * 0.1).exp_m1() * c + i.j() * i.j() * (0.5 * KAPPA)
    }
}

/// A dozen roundings of numbers ten times what they leave. Measured: 3e-15.
const ROUNDING: f64 = 3e-14;

fn strains() -> [Strain; 3] {
    [[0.0; 6], [3.0, -5.0, 8.0, 0.02, -0.04, 0.05], [-8.0, 2.0, 20.0, 0.1, 0.05, -0.1]]
        .map(Strain::from_array)
}

fn agree(name: &str, found: &dyn CrossSection, by_hand: &dyn CrossSection) {
    for at in [0.0, 0.15] {
        for strain in strains() {
            for request in [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate] {
                let at = Station::straight(at);
                let [a, b] = [found, by_hand].map(|section| section.respond(&at, &strain, request).unwrap());
                let scale = by_hand.respond(&at, &strains()[1], Request::Rate).unwrap();
                assert!((a.energy - b.energy).abs() < ROUNDING * scale.energy, "{name} {request:?}");
                for (a, b, scale) in
                    [(a.wrench, b.wrench, scale.wrench), (a.wrench_rate, b.wrench_rate, scale.wrench_rate)]
                {
                    let worst = (a - b).to_vector().component_div(&scale.to_vector()).amax();
                    assert!(worst < ROUNDING, "{name} {request:?}: {worst:e}\n{a:?}\n{b:?}");
                }
                let worst = (a.tangent - b.tangent).amax() / scale.tangent.amax();
                assert!(worst < ROUNDING, "{name} {request:?}: {worst:e}");
            }
        }
    }
}

/// Its gradients along the rod and in the section are in Ψ′ as well: the section tapers and shifts.
#[test]
fn a_graded_law_is_freed_of_its_pressure_at_every_point() {
    let taper = || Circle::new(Linear { from: 0.012, to: 0.006, length: 0.3 });
    let shift = |s: Dual64| s * 0.01;
    let shape = || taper().shifted(shift, 0.002);
    agree(
        "tapered",
        &Section::new(shape(), ReferencePressure(Graded)).unwrap(),
        &Section::new(shape(), ByHand).unwrap(),
    );
    let oblong = || Rectangle::new(0.02, 0.01);
    agree(
        "relaxed",
        &Relaxed::new(oblong(), ReferencePressure(Graded))
            .unwrap()
            .with_warping(Warping::ANTICLASTIC)
            .unwrap(),
        &Relaxed::new(oblong(), ByHand).unwrap().with_warping(Warping::ANTICLASTIC).unwrap(),
    );
}

/// On the numbers of others too, with the derivatives of the pressure in the place.
#[test]
fn the_pressure_comes_off_on_any_dual_number() {
    let place = |s: Dual2_64| Point { x: Dual2_64::from_re(3e-3), y: s * 0.1, s };
    let s = Dual2_64::from_re(0.2).derivative();
    let i = Invariants::from_shear_and_stretch(s * 0.1, s * s);
    let found = ReferencePressure(Graded).energy_density(&i, &place(s));
    let by_hand = ByHand.energy_density(&i, &place(s));
    for (a, b) in [(found.re, by_hand.re), (found.v1, by_hand.v1), (found.v2, by_hand.v2)] {
        assert!((a - b).abs() < 1e-14 * b.abs(), "{a} {b}");
    }
}
