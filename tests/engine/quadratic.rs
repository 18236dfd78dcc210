//! The shortcut for quadratic laws: the integrated answer to rounding where it holds, and not used where it does not.

use hyperrod::material::*;
use hyperrod::section::{Circle, CrossSection, Linear, Rectangle, Section, Shape};
use hyperrod::{Error, Strain};

use crate::oracle::*;

/// A material that hides that it is quadratic, so that its section integrates.
struct Integrated<M>(M);

impl<M: Material> Material for Integrated<M> {
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> hyperrod::Result<Response> {
        self.0.integrate(points, at, strain, request)
    }

    fn polynomial_degree(&self) -> Option<usize> {
        self.0.polynomial_degree()
    }

    fn is_local(&self) -> bool {
        self.0.is_local()
    }
}

/// A dozen roundings of 1e-16 of numbers up to twenty times what they leave: the energy of a law that pulls at rest with 4e5 Pa sums parts
/// of ±0.3 × 4e5 to 0.03 × 4e5. Measured: 2e-14.
const ROUNDING: f64 = 4e-14;

fn strains() -> Vec<Strain> {
    let directions = [
        [0.5, -0.3, 0.7, 0.2, -0.4, 0.3],
        [-0.2, 0.6, -0.4, 0.5, 0.1, -0.3],
        [0.3, 0.3, 0.9, -0.1, 0.3, 0.1],
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    ];
    let sizes = [1e-12, 1e-6, 1e-2, 0.3];
    sizes.iter().flat_map(|size| directions.map(|d| strain(d, *size))).collect()
}

/// The largest difference of what was asked, relative to the largest entries.
fn difference(a: &Response, b: &Response) -> f64 {
    let ratio = |error: f64, scale: f64| if error == 0.0 { 0.0 } else { error / scale };
    let six = |v: [f64; 6]| (0..6).map(|i| if i < 3 { v[i] * 100.0 } else { v[i] }.abs()).fold(0.0, f64::max);
    let k = |r: &Response| r.tangent.map_with_location(|i, j, k| k * [1e2, 1.0][i / 3] * [1e2, 1.0][j / 3]);
    ratio((a.energy - b.energy).abs(), b.energy.abs())
        .max(ratio(six((a.wrench - b.wrench).to_array()), six(b.wrench.to_array())))
        .max(ratio((k(a) - k(b)).amax(), k(b).amax()))
        .max(six((a.wrench_rate - b.wrench_rate).to_array()))
}

fn holds<M: Material + Clone + 'static>(name: &str, law: M, at: Station) {
    let circle = Circle::new(0.01);
    let shifted = || Rectangle::new(0.02, 0.012).shifted(0.004, -0.003);
    let pairs: [[Box<dyn CrossSection>; 2]; 2] = [
        [
            Box::new(Section::new(circle, law.clone()).unwrap()),
            Box::new(Section::new(circle, Integrated(law.clone())).unwrap()),
        ],
        [
            Box::new(Section::new(shifted(), law.clone()).unwrap()),
            Box::new(Section::new(shifted(), Integrated(law)).unwrap()),
        ],
    ];
    for [short, long] in pairs {
        for strain in strains() {
            for request in REQUESTS {
                let answer = short.respond(&at, &strain, request).unwrap();
                assert_nothing_more(&answer, request);
                let error = difference(&answer, &long.respond(&at, &strain, request).unwrap());
                assert!(error <= ROUNDING, "{name}, {request:?} at {strain:?}: {error:.1e}");
            }
        }
    }
}

#[test]
fn the_shortcut_gives_the_integrated_answer() {
    let mooney = MooneyRivlin::new(120e3, 40e3).unwrap();
    let polynomial = Polynomial::new(&[((1, 0), 100e3), ((0, 1), 30e3)], &[500e3]).unwrap();
    assert_eq!(Isotropic::degree(&polynomial), Some(2));
    holds("Mooney-Rivlin", mooney, straight());
    holds("Mooney-Rivlin with pressure", ReferencePressure(mooney), straight());
    holds("polynomial", polynomial.clone(), straight());
    holds("polynomial with pressure", ReferencePressure(polynomial), straight());
    holds("linear elastic", LinearElastic::new(1e6, 3e5).unwrap(), straight());
    holds("linear elastic, curved", LinearElastic::new(1e6, 3e5).unwrap(), curved());
}

/// About a curved reference the energy of a local law is that of γ/j: no polynomial.
#[test]
fn a_local_law_on_a_curved_reference_is_integrated() {
    let law = ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap());
    holds("Mooney-Rivlin with pressure, curved", law, curved());
    let section = Section::new(Circle::new(0.01), law).unwrap();
    let tangent = |at| section.tangent(&at, &Strain::zero()).unwrap();
    let (on_a_curve, on_a_line) = (tangent(curved()), tangent(straight()));
    // the volume 1.1 of the reference alone makes a tenth
    assert!((on_a_curve - on_a_line).amax() > 0.05 * on_a_line.amax());
}

#[test]
fn a_law_that_is_not_called_uniform_changes_along_the_rod() {
    let graded = hyperrod::isotropic!([] degree 2; |i, at| i.i1_excess() * (at.s * 3.0 + 1.0) * 1e5);
    assert!(!Material::is_uniform(&graded));
    let section = Section::new(Circle::new(0.01), graded).unwrap();
    let strain = strain([0.5, -0.3, 0.7, 0.2, -0.4, 0.3], 0.1);
    let at = |s| section.respond(&Station::straight(s), &strain, Request::Rate).unwrap();
    let (root, tip) = (at(0.0), at(0.5));
    // 1 + 3s: 2.5 times as stiff, and d/ds = 3 of what it is at s = 0
    assert!((tip.tangent - root.tangent * 2.5).amax() <= 1e-14 * tip.tangent.amax());
    assert!((tip.energy - 2.5 * root.energy).abs() <= 1e-14 * tip.energy);
    let rate = (tip.wrench_rate - root.wrench * 3.0).to_array();
    assert!(rate.iter().all(|d| d.abs() <= 1e-14 * 3.0 * root.wrench.force.norm()));
}

#[test]
fn a_section_that_varies_is_integrated() {
    let law = ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap());
    let taper = Linear { from: 0.01, to: 0.005, length: 1.0 };
    let section = Section::new(Circle::new(taper), law).unwrap();
    let stretch = Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, 0.1]);
    let at = |s| section.respond(&Station::straight(s), &stretch, Request::Rate).unwrap();
    // N = E e π r², r = 0.01 − 0.005 s; a dozen points
    let force = |s: f64| 400e3 * 0.1 * std::f64::consts::PI * (0.01 - 0.005 * s).powi(2);
    let rate = -400e3 * 0.1 * std::f64::consts::PI * 2.0 * 0.0075 * 0.005;
    assert!((at(0.5).wrench.force.z - force(0.5)).abs() <= 1e-14 * force(0.5));
    assert!((at(0.5).wrench_rate.force.z - rate).abs() <= 1e-14 * rate.abs());
}

#[test]
fn the_shortcut_refuses_what_integration_refuses_by_the_same_name() {
    let law = MooneyRivlin::new(120e3, 40e3).unwrap();
    let short = Section::new(Circle::new(0.01), law).unwrap();
    let long = Section::new(Circle::new(0.01), Integrated(law)).unwrap();
    let mut bad = vec![
        Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, -1.0]),
        Strain::from_array([0.0, 0.0, 0.0, 0.1, 0.2, -3.0]),
        Strain::from_array([150.0, -90.0, 0.0, 0.0, 0.0, 0.0]),
    ];
    for i in 0..6 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut xi = [0.01; 6];
            xi[i] = value;
            bad.push(Strain::from_array(xi));
        }
    }
    for strain in &bad {
        for request in REQUESTS {
            let [a, b] = [&short as &dyn CrossSection, &long]
                .map(|section| section.respond(&straight(), strain, request).unwrap_err());
            match (&a, &b) {
                (
                    Error::Inadmissible { quantity: "J", value: u, x, y, s, .. },
                    Error::Inadmissible { quantity: "J", value: v, x: x1, y: y1, s: s1, .. },
                ) => {
                    // J sums four terms of up to 3
                    assert!((u - v).abs() <= 4e-15 && (x, y, s) == (x1, y1, s1), "{a} / {b}");
                }
                _ => assert_eq!(a.to_string(), b.to_string()),
            }
        }
    }
    // a law of the strain alone has no J to be positive, but no NaN either
    let linear = Section::new(Circle::new(0.01), LinearElastic::new(1e6, 3e5).unwrap()).unwrap();
    for (i, strain) in bad.iter().enumerate() {
        assert_eq!(linear.energy(&straight(), strain).is_ok(), i < 3, "{strain:?}");
    }
}
