//! Ψ′ of sections that taper, twist, shift and are graded, one by one and together, against hyper-dual numbers through an
//! independent formulation ([`super::direct`]).
//!
//! Tolerance 1e-12 of the largest moment or force: both sides add some 10³ terms of either sign (1e3 · 2e-16), and the independent
//! one forms F before taking I off it.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use hyperrod::material::{Points, Reference, Station};
use hyperrod::quadrature::Rule;
use hyperrod::section::*;
use hyperrod::{Strain, isotropic};
use num_dual::{Dual64, DualNum};

use super::degree::neo_hookean;
use super::direct::{self, D, Direct, Energy, constant, relative_difference};

const STRAINS: [[f64; 6]; 3] = [
    [8.0, -11.0, 14.0, 0.08, -0.05, 0.06],
    [-15.0, 6.0, -20.0, -0.11, 0.03, -0.08],
    [0.3, 0.2, -0.4, 1e-3, 2e-3, -1e-3],
];

fn taper<N: DualNum<Primitive = f64> + Copy>(s: N) -> N {
    -(s * s) * 0.7 - s * 0.9 + 1.0
}
fn angle<N: DualNum<Primitive = f64> + Copy>(s: N) -> N {
    (s * 3.0).sin() * 2.0 + s * 6.0
}
fn shift_x<N: DualNum<Primitive = f64> + Copy>(s: N) -> N {
    s * s * 0.05 + 0.001
}
fn shift_y<N: DualNum<Primitive = f64> + Copy>(s: N) -> N {
    (s * 5.0).cos() * 0.002
}

fn straight(_: D) -> [D; 6] {
    [0.0, 0.0, 0.0, 0.0, 0.0, 1.0].map(constant)
}

/// The worst of the strains at s = 0.23.
fn worst(section: &impl CrossSection, direct: &Direct<'_>) -> f64 {
    let s = 0.23;
    let mut worst: f64 = 0.0;
    for strain in STRAINS {
        let at = Station { s, reference: Reference::straight() };
        let xi = Strain::from_array(strain);
        let (energy, psi, rate) = direct.respond(strain, s);
        let ours = section.respond(&at, &xi, hyperrod::material::Request::Rate).unwrap();
        assert!((ours.energy - energy).abs() < 1e-11 * energy, "{} {energy}", ours.energy);
        worst = worst.max(relative_difference(ours.wrench.to_array(), psi));
        worst = worst.max(relative_difference(ours.wrench_rate.to_array(), rate));
    }
    worst
}

fn check(name: &str, section: &impl CrossSection, direct: &Direct<'_>) {
    let worst = worst(section, direct);
    println!("{name}: worst error {worst:.1e}");
    assert!(worst < 1e-12, "{name}: {worst:e}");
}

const NEO: Energy = direct::neo_hookean;
const N: usize = 16;

#[test]
fn a_tapered_tube_with_two_radii() {
    let section =
        Section::new(Annulus::new(|s: Dual64| s * 0.01 + 0.004, |s: Dual64| taper(s) * 0.02), neo_hookean());
    let section = section.unwrap().with_degree(24).unwrap();
    // domain 0 < r̂ < 1 with r = Ri + r̂ (Ro − Ri): another map than the section's
    let (inner, outer) = (|s: D| s * 0.01 + 0.004, |s: D| taper(s) * 0.02);
    let map = |[r, phi]: [f64; 2], s: D| {
        let radius = inner(s) + (outer(s) - inner(s)) * r;
        [radius * phi.cos(), radius * phi.sin()]
    };
    let jacobian = |[r, _]: [f64; 2], s: D| (inner(s) + (outer(s) - inner(s)) * r) * (outer(s) - inner(s));
    let turn = std::f64::consts::TAU;
    let domain = direct::gauss(N)
        .into_iter()
        .flat_map(|(u, w)| {
            (0..40).map(move |k| ([0.5 + 0.5 * u, turn * k as f64 / 40.0], 0.5 * w * turn / 40.0))
        })
        .collect();
    check(
        "tube",
        &section,
        &Direct { energy: NEO, domain, map: &map, jacobian: &jacobian, reference: &straight },
    );
}

#[test]
fn a_twisted_rectangle() {
    let section = Section::new(Rectangle::new(0.02, 0.012).rotated(|s: Dual64| angle(s)), neo_hookean());
    let section = section.unwrap().with_degree(24).unwrap();
    let map = |[x, y]: [f64; 2], s: D| {
        let (sin, cos) = angle(s).sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    };
    let domain = direct::rectangle([-0.01, 0.01], [-0.006, 0.006], N);
    let jacobian = |_: [f64; 2], _: D| constant(1.0);
    check(
        "twisted",
        &section,
        &Direct { energy: NEO, domain, map: &map, jacobian: &jacobian, reference: &straight },
    );
}

#[test]
fn a_shifted_ellipse_with_independent_axes() {
    let shape = Ellipse::new(|s: Dual64| taper(s) * 0.015, |s: Dual64| s * 0.01 + 0.004);
    let section = Section::new(shape.shifted(|s: Dual64| shift_x(s), |s: Dual64| shift_y(s)), neo_hookean());
    let section = section.unwrap().with_degree(24).unwrap();
    let map =
        |[x, y]: [f64; 2], s: D| [taper(s) * 0.015 * x + shift_x(s), (s * 0.01 + 0.004) * y + shift_y(s)];
    let jacobian = |_: [f64; 2], s: D| taper(s) * 0.015 * (s * 0.01 + 0.004);
    let domain = direct::ring(0.0, 1.0, 20);
    check(
        "shifted",
        &section,
        &Direct { energy: NEO, domain, map: &map, jacobian: &jacobian, reference: &straight },
    );
}

/// 170 kPa, 400 kPa, times (1 + 0.5 sin 9s + 20x).
fn graded() -> impl hyperrod::material::Material {
    isotropic!(|i, at| {
        let ln_j = i.j().ln_1p();
        let u = (i.i1() - ln_j * 2.0) * 85e3 + ln_j * ln_j * 200e3;
        u * ((at.s * 9.0).sin() * 0.5 + at.x * 20.0 + 1.0)
    })
}

#[test]
fn a_graded_law_on_a_constant_section() {
    let section = Section::new(Circle::new(0.012), graded()).unwrap().with_degree(24).unwrap();
    let map = |p: [f64; 2], _: D| p.map(constant);
    let jacobian = |_: [f64; 2], _: D| constant(1.0);
    let domain = direct::ring(0.0, 0.012, 20);
    let energy: Energy = direct::graded_neo_hookean;
    check(
        "graded",
        &section,
        &Direct { energy, domain, map: &map, jacobian: &jacobian, reference: &straight },
    );
}

#[test]
fn tapered_shifted_twisted_and_graded_at_once() {
    let shape = Polygon::new(vec![[-0.01, -0.006], [0.012, -0.005], [0.001, 0.011]]).unwrap();
    let shape = shape
        .scaled(|s: Dual64| taper(s))
        .shifted(|s: Dual64| shift_x(s), |s: Dual64| shift_y(s))
        .rotated(|s: Dual64| angle(s));
    let section = Section::new(shape, graded()).unwrap().with_degree(24).unwrap();
    let map = |[x, y]: [f64; 2], s: D| {
        let (u, v) = (taper(s) * x + shift_x(s), taper(s) * y + shift_y(s));
        let (sin, cos) = angle(s).sin_cos();
        [cos * u - sin * v, sin * u + cos * v]
    };
    let jacobian = |_: [f64; 2], s: D| taper(s) * taper(s);
    let domain = direct::triangle([[-0.01, -0.006], [0.012, -0.005], [0.001, 0.011]], N);
    let energy: Energy = direct::graded_neo_hookean;
    check(
        "together",
        &section,
        &Direct { energy, domain, map: &map, jacobian: &jacobian, reference: &straight },
    );
}

#[test]
fn the_rate_of_a_composite_is_that_of_its_parts() {
    let core = || Section::new(Circle::new(|s: Dual64| taper(s) * 0.005), neo_hookean()).unwrap();
    let sleeve = || Section::new(Annulus::new(|s: Dual64| taper(s) * 0.005, 0.01), graded()).unwrap();
    let both = Composite::new(core()).with(sleeve());
    let (at, xi) = (Station::straight(0.2), Strain::from_array(STRAINS[0]));
    let sum = core().wrench_rate(&at, &xi).unwrap() + sleeve().wrench_rate(&at, &xi).unwrap();
    assert_eq!(both.wrench_rate(&at, &xi).unwrap(), sum);
    let sum = core().tangent(&at, &xi).unwrap() + sleeve().tangent(&at, &xi).unwrap();
    assert_eq!(both.tangent(&at, &xi).unwrap(), sum);
}

#[test]
fn a_constant_section_has_no_rate() {
    let shape = Rectangle::new(0.02, 0.01).shifted(0.003, 0.0).rotated(0.3).scaled(1.1);
    assert!(shape.is_constant());
    let section = Section::new(shape, neo_hookean()).unwrap();
    let rate = section.wrench_rate(&Station::straight(0.1), &Strain::from_array(STRAINS[0])).unwrap();
    assert_eq!(rate.to_array(), [0.0; 6]);
}

/// A circle that counts how often its points are placed.
struct Counted<R>(Circle<R>, Arc<AtomicUsize>);

impl<R: Profile> Shape for Counted<R> {
    fn rule(&self, degree: usize) -> hyperrod::Result<Rule> {
        self.0.rule(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> hyperrod::Result<Points> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.place(rule, s)
    }

    fn is_constant(&self) -> bool {
        self.0.is_constant()
    }
}

#[test]
fn the_points_of_a_constant_section_are_placed_once() {
    let placed = |shape: &dyn Fn(Arc<AtomicUsize>) -> Box<dyn Shape>| {
        let count = Arc::new(AtomicUsize::new(0));
        let section = Section::new(shape(count.clone()), neo_hookean()).unwrap();
        for k in 0..10 {
            let at = Station::straight(0.01 * k as f64);
            section.tangent(&at, &Strain::from_array(STRAINS[0])).unwrap();
            section.moments(at.s).unwrap();
        }
        count.load(Ordering::Relaxed)
    };
    assert_eq!(
        placed(&|count| Box::new(Counted(Circle::new(0.01), count).rotated(0.2).shifted(0.001, 0.0))),
        1
    );
    assert_eq!(placed(&|count| Box::new(Counted(Circle::new(|_: Dual64| 0.01.into()), count))), 20);
}
