//! Curved and twisted stress-free references: F = [e₁ e₂ γ][e₁ e₂ γ*]⁻¹ with plain matrices ([`super::direct`]) is the oracle.

use hyperrod::material::{
    LinearElastic, MooneyRivlin, NeoHookean, Reference, ReferencePressure, Request, Station,
};
use hyperrod::section::*;
use hyperrod::{Body, Error, Strain, Twist};
use num_dual::{Dual64, DualNum};

use super::direct::{self, D, Direct, Energy, constant, relative_difference};

fn mooney_rivlin() -> ReferencePressure<MooneyRivlin> {
    ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap())
}

/// ξ*(s): curvature up to 40 1/m about both axes, twist and a stretch that varies.
fn reference<N: DualNum<Primitive = f64> + Copy>(s: N) -> [N; 6] {
    [
        (s * 4.0).sin() * 25.0 + 5.0,
        s * 30.0 - 12.0,
        -(s * s) * 20.0 + 7.0,
        s * 0.05,
        s * s * 0.1 - 0.02,
        s * 0.2 + 0.95,
    ]
}

fn station(s: f64) -> Station {
    let xi = reference(Dual64::from_re(s).derivative());
    let rate = Twist::from_array(xi.map(|v| v.eps));
    Station { s, reference: Reference { twist: Twist::from_array(xi.map(|v| v.re)), rate } }
}

const STRAINS: [[f64; 6]; 3] = [
    [9.0, -7.0, 12.0, 0.06, -0.05, 0.04],
    [-6.0, 11.0, -16.0, -0.1, 0.02, -0.06],
    [0.4, 0.1, -0.2, 2e-3, -1e-3, 1e-3],
];

/// Tolerances: 1e-12 of the largest moment or force, as in `rates`.
fn check(name: &str, section: &impl CrossSection, direct: &Direct<'_>) {
    for strain in STRAINS {
        for s in [0.0, 0.31] {
            let (energy, psi, rate) = direct.respond(strain, s);
            let ours = section.respond(&station(s), &Strain::from_array(strain), Request::Rate).unwrap();
            let worst = relative_difference(ours.wrench.to_array(), psi)
                .max(relative_difference(ours.wrench_rate.to_array(), rate));
            println!("{name} at {s}: {worst:.1e}, energy {:.1e}", (ours.energy - energy).abs() / energy);
            assert!(worst < 1e-12, "{name} at {s}: {worst:e}");
            assert!((ours.energy - energy).abs() < 1e-11 * energy, "{name} at {s}");
        }
    }
}

#[test]
fn nonlinear_laws_about_a_varying_curved_twisted_reference() {
    let map = |p: [f64; 2], _: D| p.map(constant);
    let one = |_: [f64; 2], _: D| constant(1.0);
    let laws: [(&str, Box<dyn hyperrod::material::Material>, Energy); 2] = [
        ("neo-Hookean", Box::new(NeoHookean::new(170e3, 400e3).unwrap()), direct::neo_hookean),
        ("Mooney-Rivlin", Box::new(mooney_rivlin()), direct::mooney_rivlin),
    ];
    for (name, law, energy) in laws {
        let section = Section::new(Circle::new(0.008), law).unwrap().with_degree(30).unwrap();
        let domain = direct::ring(0.0, 0.008, 22);
        check(name, &section, &Direct { energy, domain, map: &map, jacobian: &one, reference: &reference });
    }
}

#[test]
fn a_tapered_twisted_section_about_a_varying_reference() {
    let shape =
        Rectangle::new(0.016, 0.01).scaled(|s: Dual64| -s * 0.8 + 1.0).rotated(|s: Dual64| s * s * 9.0);
    let section =
        Section::new(shape, NeoHookean::new(170e3, 400e3).unwrap()).unwrap().with_degree(30).unwrap();
    let map = |[x, y]: [f64; 2], s: D| {
        let (sin, cos) = (s * s * 9.0).sin_cos();
        let size = -s * 0.8 + 1.0;
        [size * (cos * x - sin * y), size * (sin * x + cos * y)]
    };
    let jacobian = |_: [f64; 2], s: D| (-s * 0.8 + 1.0) * (-s * 0.8 + 1.0);
    let domain = direct::rectangle([-0.008, 0.008], [-0.005, 0.005], 20);
    let energy: Energy = direct::neo_hookean;
    check("bar", &section, &Direct { energy, domain, map: &map, jacobian: &jacobian, reference: &reference });
}

#[test]
fn a_ring_segment_at_rest_is_free_of_stress() {
    let section = Section::new(Circle::new(0.01), NeoHookean::new(170e3, 400e3).unwrap()).unwrap();
    for curvature in [1.0, 20.0, 90.0] {
        let twist = Twist::from_array([0.0, curvature, 3.0, 0.0, 0.0, 1.0]);
        let at = Station { s: 0.0, reference: Reference { twist, rate: Twist::zero() } };
        let rest = section.respond(&at, &Strain::zero(), Request::Rate).unwrap();
        assert_eq!(
            (rest.energy, rest.wrench.to_array(), rest.wrench_rate.to_array()),
            (0.0, [0.0; 6], [0.0; 6])
        );
    }
}

/// The source's law about a ring: its tension at rest, F = (2C₁ + 4C₂)A, remains, and so does a moment −∫x.
#[test]
fn a_law_stressed_at_rest_stays_so_on_a_ring() {
    let section = Section::new(Circle::new(0.01), MooneyRivlin::new(120e3, 40e3).unwrap()).unwrap();
    let twist = Twist::from_array([0.0, 30.0, 0.0, 0.0, 0.0, 1.0]);
    let at = Station { s: 0.0, reference: Reference { twist, rate: Twist::zero() } };
    let force = section.wrench(&at, &Strain::zero()).unwrap().force.z;
    let exact = 400e3 * std::f64::consts::PI * 1e-4;
    assert!((force - exact).abs() < 1e-13 * exact);
}

#[test]
fn a_body_raises_the_degree_of_its_section_only_where_the_law_needs_it() {
    let ring = Twist::from_array([0.0, 40.0, 0.0, 0.0, 0.0, 1.0]);
    let at = Station { s: 0.0, reference: Reference { twist: ring, rate: Twist::zero() } };
    let circle = || Circle::new(0.01);

    let soft = Body::new(0.1, Section::new(circle(), mooney_rivlin()).unwrap()).unwrap();
    assert_eq!(soft.section().degree(), 2);
    let soft = soft.with_reference_strain(ring).unwrap();
    let degree = soft.section().degree();
    assert!((10..30).contains(&degree), "{degree}");
    let coarse = Section::new(circle(), mooney_rivlin()).unwrap();
    let exact = Section::new(circle(), mooney_rivlin()).unwrap().with_degree(60).unwrap();
    let strain = Strain::from_array([5.0, 9.0, -7.0, 0.02, 0.01, 0.1]);
    let error = |section: &Section<_, _>| {
        let tangent = exact.tangent(&at, &strain).unwrap();
        let moments = |k: &nalgebra::Matrix6<f64>| k.fixed_view::<3, 3>(0, 0).into_owned();
        let difference = section.tangent(&at, &strain).unwrap() - tangent;
        moments(&difference).amax() / moments(&tangent).amax()
    };
    assert!(error(&coarse) > 1e-3, "the minimal rule is not enough: {:e}", error(&coarse));
    assert!(error(soft.section()) < 1e-11, "{:e}", error(soft.section()));

    let stiff = Section::new(circle(), LinearElastic::new(1e6, 3e5).unwrap()).unwrap();
    let stiff = Body::new(0.1, stiff).unwrap().with_reference_strain(ring).unwrap();
    assert_eq!(stiff.section().degree(), 2, "a sectional law stays a polynomial");

    let twisted = Body::new(0.1, Section::new(circle(), mooney_rivlin()).unwrap()).unwrap();
    let twist = Twist::from_array([0.0, 0.0, 50.0, 0.0, 0.0, 1.0]);
    let twisted = twisted.with_reference_strain(twist).unwrap();
    assert_eq!(twisted.section().degree(), 2, "twist alone leaves j = 1");
}

#[test]
fn the_degree_grows_where_the_reference_is_most_curved() {
    let section = Section::new(Circle::new(0.01), mooney_rivlin()).unwrap();
    let body = Body::new(0.4, section).unwrap().with_varying_reference(|s: Dual64| {
        let o = Dual64::from_re(0.0);
        Twist::from_array([s * 100.0, o, o, o, o, o + 1.0]) // up to 40 1/m
    });
    let degree = body.unwrap().section().degree();
    assert!((10..30).contains(&degree), "{degree}");
}

#[test]
fn a_section_that_reaches_the_centre_of_curvature_is_refused() {
    let law = NeoHookean::new(170e3, 400e3).unwrap();
    let section = Section::new(Circle::new(0.01), law).unwrap();
    let twist = Twist::from_array([0.0, 120.0, 0.0, 0.0, 0.0, 1.0]);
    let at = Station { s: 0.2, reference: Reference { twist, rate: Twist::zero() } };
    match section.wrench(&at, &Strain::zero()) {
        Err(Error::Inadmissible { quantity: "volume of the reference", value, s: 0.2, .. }) => {
            assert!(value <= 0.0)
        }
        other => panic!("{other:?}"),
    }
    let body = Body::new(0.1, Section::new(Circle::new(0.01), law).unwrap()).unwrap();
    assert!(matches!(
        body.with_reference_strain(twist),
        Err(Error::Inadmissible { quantity: "volume of the reference", .. })
    ));
}
