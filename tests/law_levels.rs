//! One law, written at three levels and in three ways: the answers differ by rounding alone, whatever is asked.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use hyperrod::material::{
    self, Deformation, Invariants, Isotropic, Local, Material, Point, Reference, Request, Response,
};
use hyperrod::material::{Sectional, Station};
use hyperrod::scalar::x_minus_ln_1p;
use hyperrod::section::{Circle, CrossSection, Linear, Rectangle, Section};
use hyperrod::{Scalar, Strain, Twist};

const MU: f64 = 2e5;
const LAMBDA: f64 = 3e5;

/// Neo-Hookean, and stiffer by a slope in x, y and s: every way that a law can depend on its point.
fn graded<D: Scalar>(i: &Invariants<D>, at: &Point<D>) -> D {
    let ln_j = i.j().ln_1p();
    let u = (i.i1_excess() + x_minus_ln_1p(i.j()) * 2.0) * (0.5 * MU) + ln_j * ln_j * (0.5 * LAMBDA);
    u * (at.x * 20.0 + at.y * at.y * 900.0 + at.s * at.s * 3.0 + 1.0)
}

struct AsIsotropic;
struct AsLocal;
struct AsSectional;

impl Isotropic for AsIsotropic {
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, at: &Point<D>) -> D {
        graded(i, at)
    }
}

impl Local for AsLocal {
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        graded(&f.invariants(), at)
    }
}

impl Sectional for AsSectional {
    fn energy_density<D: Scalar>(&self, strain: &Strain<D>, at: &Point<D>) -> D {
        graded(&Deformation::of(strain, at).invariants(), at)
    }
}

type Named = (&'static str, Box<dyn Material>);

/// The law in the two levels that know the volume of a curved reference.
fn local_ways() -> Vec<Named> {
    vec![
        ("isotropic trait", Box::new(AsIsotropic)),
        ("isotropic macro", Box::new(hyperrod::isotropic!(|i, at| graded(i, at)))),
        ("isotropic closure", Box::new(material::isotropic(graded))),
        ("local trait", Box::new(AsLocal)),
        ("local macro", Box::new(hyperrod::local!(|f, at| graded(&f.invariants(), at)))),
        ("local closure", Box::new(material::local(|f, at| graded(&f.invariants(), at)))),
    ]
}

/// The law at section level.
fn sectional_ways() -> Vec<Named> {
    vec![
        ("sectional trait", Box::new(AsSectional)),
        (
            "sectional macro",
            Box::new(hyperrod::sectional!(|xi, at| graded(&Deformation::of(xi, at).invariants(), at))),
        ),
        (
            "sectional closure",
            Box::new(material::sectional(|xi, at| graded(&Deformation::of(xi, at).invariants(), at))),
        ),
    ]
}

fn strains() -> [Strain; 3] {
    [
        Strain::from_array([12.0, -30.0, 25.0, 0.1, -0.05, 0.2]),
        Strain::from_array([-5.0, 8.0, -60.0, -0.3, 0.2, -0.15]),
        Strain::from_array([1e-3, 2e-3, -1e-3, 1e-5, 3e-5, -2e-5]),
    ]
}

/// The largest difference of two responses, each quantity relative to its scale on a section of about a centimetre.
fn difference(a: &Response, b: &Response) -> f64 {
    let relative = |x: [f64; 6], y: [f64; 6]| {
        let size = |v: [f64; 6]| {
            v.iter()
                .enumerate()
                .map(|(i, v)| if i < 3 { v * 100.0 } else { *v })
                .fold(0.0, |m, v| f64::max(m, v.abs()))
        };
        size(std::array::from_fn(|i| x[i] - y[i])) / size(y).max(f64::MIN_POSITIVE)
    };
    let mut worst = (a.energy - b.energy).abs() / b.energy;
    worst = worst.max(relative(a.wrench.to_array(), b.wrench.to_array()));
    worst = worst.max(relative(a.wrench_rate.to_array(), b.wrench_rate.to_array()));
    if b.tangent.amax() > 0.0 {
        let k = &b.tangent;
        let scaled = (a.tangent - k).map_with_location(|i, j, d| d / (k[(i, i)] * k[(j, j)]).sqrt());
        worst = worst.max(scaled.amax());
    }
    worst
}

/// On a tapered circle, a rectangle with one side that varies, and a circle that does not.
fn sections(law: fn() -> Vec<Named>) -> [Vec<(&'static str, Box<dyn CrossSection>)>; 3] {
    let taper = |from, to| Linear { from, to, length: 0.3 };
    [
        law()
            .into_iter()
            .map(|(name, law)| {
                (name, Box::new(Section::new(Circle::new(taper(0.012, 0.006)), law).unwrap()) as _)
            })
            .collect(),
        law()
            .into_iter()
            .map(|(name, law)| {
                (name, Box::new(Section::new(Rectangle::new(0.01, taper(0.006, 0.016)), law).unwrap()) as _)
            })
            .collect(),
        law()
            .into_iter()
            .map(|(name, law)| (name, Box::new(Section::new(Circle::new(0.01), law).unwrap()) as _))
            .collect(),
    ]
}

/// Tens of roundings a point, summed over some sixty points; measured 1e-15.
const ROUNDING: f64 = 1e-14;

fn agree(ways: fn() -> Vec<Named>, at: &Station) {
    for ways in sections(ways) {
        for strain in strains() {
            let (first, section) = &ways[0];
            let expected = section.respond(at, &strain, Request::Rate).unwrap();
            assert!(expected.wrench_rate.force.norm() > 0.0, "the grading alone gives a rate");
            for (name, section) in &ways[1..] {
                let answer = section.respond(at, &strain, Request::Rate).unwrap();
                let error = difference(&answer, &expected);
                assert!(error < ROUNDING, "{name} against {first} at {strain:?}: {error:.1e}");
            }
        }
    }
}

#[test]
fn all_levels_and_all_ways_agree_on_a_straight_reference() {
    fn all() -> Vec<Named> {
        local_ways().into_iter().chain(sectional_ways()).collect()
    }
    agree(all, &Station::straight(0.11));
}

#[test]
fn isotropic_and_local_laws_agree_on_a_curved_reference() {
    let twist = Twist::from_array([5.0, -8.0, 3.0, 0.02, -0.01, 1.1]);
    let rate = Twist::from_array([20.0, 10.0, -30.0, 0.3, 0.2, -0.4]);
    agree(local_ways, &Station { s: 0.11, reference: Reference { twist, rate } });
}

/// Ψ′ held against differences of Ψ along s: an independent route through taper, grading and a reference that varies.
#[test]
fn the_rate_is_the_derivative_of_the_wrench_along_the_rod() {
    let reference = |s: f64| {
        let twist = Twist::from_array([5.0, -8.0, 3.0, 0.02, -0.01, 1.1]);
        let rate = Twist::from_array([20.0, 10.0, -30.0, 0.3, 0.2, -0.4]);
        Station { s, reference: Reference { twist: twist + rate * (s - 0.11), rate } }
    };
    for ways in sections(local_ways).into_iter().chain(sections(sectional_ways)) {
        for (name, section) in ways {
            for strain in strains() {
                let rate = section.wrench_rate(&reference(0.11), &strain).unwrap();
                let wrench = |s| section.wrench(&reference(s), &strain).unwrap();
                // five points: step⁴ Ψ⁽⁵⁾/30 and ε/step, with lengths over which Ψ changes of some centimetres
                let h = 3e-4;
                let slope = ((wrench(0.11 + h) - wrench(0.11 - h)) * 8.0
                    - (wrench(0.11 + 2.0 * h) - wrench(0.11 - 2.0 * h)))
                    * (1.0 / (12.0 * h));
                let d = slope - rate;
                let scale = rate.force.norm().max(rate.moment.norm() * 100.0);
                let error = d.force.norm().max(d.moment.norm() * 100.0) / scale;
                assert!(error < 1e-9, "{name} at {strain:?}: {error:.1e}");
            }
        }
    }
}

/// Energy, wrench and tangent do not depend on what else is asked; what is not asked is zero.
#[test]
fn a_smaller_request_gives_the_same_answer_as_a_larger_one() {
    let at = Station::straight(0.11);
    for ways in sections(local_ways).into_iter().chain(sections(sectional_ways)) {
        for (name, section) in ways {
            for strain in strains() {
                let full = section.respond(&at, &strain, Request::Rate).unwrap();
                for request in [Request::Energy, Request::Wrench, Request::Tangent] {
                    let answer = section.respond(&at, &strain, request).unwrap();
                    let mut expected = full;
                    // a closure pays for everything and may give it
                    if request < Request::Rate {
                        expected.wrench_rate = answer.wrench_rate;
                    }
                    if request < Request::Tangent {
                        expected.tangent = answer.tangent;
                    }
                    if request < Request::Wrench {
                        expected.wrench = answer.wrench;
                    }
                    let error = difference(&answer, &expected);
                    assert!(error < ROUNDING, "{name}, {request:?} at {strain:?}: {error:.1e}");
                }
            }
        }
    }
}
