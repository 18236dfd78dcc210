//! At the edge of a law: the exact limit or an error that says what and where, never NaN. And laws that must coincide.

use hyperrod::material::*;
use hyperrod::section::{Circle, CrossSection, Resultant, Resultants, Ribbon, Section, Stiffness};
use hyperrod::{Error, Scalar, Strain};

const MU: f64 = 170e3;
const LAMBDA: f64 = 400e3;
const KAPPA: f64 = 500e3;

fn strain(xi: [f64; 6]) -> Strain {
    Strain::from_array(xi)
}

fn point() -> Points {
    Points { x: vec![0.003], y: vec![0.004], weight: vec![1.0], rates: None }
}

fn respond(law: &dyn Material, xi: [f64; 6], request: Request) -> hyperrod::Result<Response> {
    law.integrate(&point(), &Station::straight(0.25), &strain(xi), request)
}

/// Two laws that must agree, over strains from 1e-12 to large.
fn assert_same(a: &dyn Material, b: &dyn Material, tolerance: f64) {
    for size in [1e-12, 1e-4, 0.1, 0.6] {
        for xi in [[30.0, -20.0, 60.0, 0.3, -0.4, 0.5], [-40.0, 9.0, -80.0, 0.6, 0.1, -0.7]] {
            let xi = xi.map(|x| x * size);
            let [a, b] = [respond(a, xi, Request::Tangent), respond(b, xi, Request::Tangent)];
            let [a, b] = [a.expect("admissible"), b.expect("admissible")];
            assert!((a.energy - b.energy).abs() <= tolerance * b.energy, "{size}: {} {}", a.energy, b.energy);
            let wrench = (a.wrench - b.wrench).to_vector().norm();
            assert!(wrench <= tolerance * b.wrench.to_vector().norm(), "{size}: wrench by {wrench:e}");
            let tangent = (a.tangent - b.tangent).norm();
            assert!(tangent <= tolerance * b.tangent.norm(), "{size}: tangent by {tangent:e}");
        }
    }
}

#[test]
fn gent_answers_up_to_its_limit_and_refuses_beyond() {
    let gent = Gent::new(MU, LAMBDA, 1.0).unwrap();
    // in simple shear the measure of stretch is the shear squared
    for shear in [0.5, 0.99, 1.0 - 1e-12] {
        let response = respond(&gent, [0.0, 0.0, 0.0, shear, 0.0, 0.0], Request::Tangent).expect("within");
        let expected = MU * shear / ((1.0 - shear) * (1.0 + shear));
        // 1e-12 from the pole the measure has lost four digits more than twelve
        assert!((response.wrench.force.x / expected - 1.0).abs() < 1e-15 / (1.0 - shear) + 1e-14);
    }
    for shear in [1.0, 1.0 + 1e-15, 2.0, 1e6] {
        for request in [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate] {
            let error =
                respond(&gent, [0.0, 0.0, 0.0, shear, 0.0, 0.0], request).expect_err("past the limit");
            assert!(matches!(
                error,
                Error::Inadmissible { quantity: "energy density", s: 0.25, x: 0.003, .. }
            ));
            assert!(error.to_string().contains("below the limit Jm"), "{error}");
        }
    }
}

#[test]
fn ogden_at_equal_stretches_is_the_limit_of_unequal_ones() {
    let ogden = Ogden::new(&[(100e3, 1.3), (2e3, 5.0), (-40e3, -2.0)], LAMBDA).unwrap();
    let near = |shear: f64| respond(&ogden, [0.0, 0.0, 0.0, shear, 0.0, 0.0], Request::Tangent).unwrap();
    let limit = near(0.0);
    assert_eq!(limit.energy, 0.0);
    assert_eq!(limit.wrench.to_array(), [0.0; 6]);
    for shear in [1e-300, 1e-160, 1e-20, 1e-9] {
        // shear and stretch couple in proportion to the shear
        assert!(
            (near(shear).tangent - limit.tangent).norm() <= (1e-14 + 10.0 * shear) * limit.tangent.norm(),
            "{shear:e}"
        );
        assert!((near(shear).wrench.force.x / (110e3 * shear) - 1.0).abs() < 1e-14);
    }
    // a path on which λ₊ passes the third stretch, which is 1
    let along = |t: f64| respond(&ogden, [0.0, 0.0, 0.0, 0.2 * t, 0.1, -0.3 + t], Request::Tangent).unwrap();
    for step in 0..400 {
        let t = step as f64 * 1e-3;
        let (a, b) = (along(t).tangent, along(t + 1e-3).tangent);
        assert!((a - b).norm() < 0.02 * a.norm(), "a jump at {t}");
    }
}

#[test]
fn laws_coincide_where_their_formulas_do() {
    let neo_hookean = NeoHookean::new(MU, LAMBDA).unwrap();
    assert_same(&Ogden::new(&[(MU, 2.0)], LAMBDA).unwrap(), &neo_hookean, 1e-13);
    assert_same(&Gent::new(MU, LAMBDA, 1e12).unwrap(), &neo_hookean, 1e-11);
    assert_same(
        &Sum(Scaled::new(0.3, neo_hookean).unwrap(), Scaled::new(0.7, neo_hookean).unwrap()),
        &neo_hookean,
        1e-14,
    );
    // Blatz–Ko with f = 1 and β → 0: (J^(−2β) − 1)/β → −2 ln J
    let blatz_ko = BlatzKo::new(MU, 0.0, 1.0).unwrap();
    assert_same(&blatz_ko, &NeoHookean::new(MU, 0.0).unwrap(), 1e-14);
    assert_same(&BlatzKo::new(MU, 1e-9, 0.3).unwrap(), &BlatzKo::new(MU, 0.0, 0.3).unwrap(), 1e-7);
    let isochoric = IsochoricNeoHookean::new(MU, KAPPA).unwrap();
    let table = [((1, 0), 0.5 * MU)];
    assert_same(&IsochoricPolynomial::new(&table, &[0.5 * KAPPA]).unwrap(), &isochoric, 1e-14);
    assert_same(&IsochoricPolynomial::with_divisors(&table, &[2.0 / KAPPA]).unwrap(), &isochoric, 1e-14);
    assert_same(&Yeoh::new([0.5 * MU, 0.0, 0.0], [0.5 * KAPPA, 0.0, 0.0]).unwrap(), &isochoric, 1e-14);
    assert_same(&Fung::new(MU, KAPPA, 1e-12).unwrap(), &isochoric, 1e-11);
    let yeoh = [((1, 0), 9e4), ((2, 0), -3e3), ((3, 0), 1e3)];
    let yeoh = IsochoricPolynomial::new(&yeoh, &[2e5, 0.0, 4e4]).unwrap();
    assert_same(&Yeoh::new([9e4, -3e3, 1e3], [2e5, 0.0, 4e4]).unwrap(), &yeoh, 1e-14);
    let raw = ReferencePressure(Polynomial::new(&[((1, 0), 120e3), ((0, 1), 40e3)], &[]).unwrap());
    assert_same(&raw, &ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap()), 1e-14);
    let five = Polynomial::mooney_rivlin_5([1e5, 3e4, 2e4, -5e3, 1.5e3], [5e5, 2e5]).unwrap();
    let table = [((0, 2), 1.5e3), ((1, 1), -5e3), ((1, 0), 1e5), ((2, 0), 2e4), ((0, 1), 3e4)];
    assert_eq!(five, Polynomial::new(&table, &[5e5, 2e5]).unwrap(), "the order of a table does not matter");
}

#[test]
fn hencky_and_the_exponential_laws_obey_their_closed_forms_in_tension() {
    let c = 1.7_f64;
    let tension = [0.0, 0.0, 0.0, 0.0, 0.0, c - 1.0];
    let hencky = respond(&Hencky::new(MU, LAMBDA).unwrap(), tension, Request::Tangent).unwrap();
    assert!((hencky.wrench.force.z / ((LAMBDA + 2.0 * MU) * c.ln() / c) - 1.0).abs() < 1e-14);
    let fung = respond(&Fung::new(MU, KAPPA, 2.0).unwrap(), tension, Request::Wrench).unwrap();
    let i1 = c.powf(4.0 / 3.0) + 2.0 * c.powf(-2.0 / 3.0) - 3.0;
    let slope = 4.0 / 3.0 * (c.cbrt() - c.powf(-5.0 / 3.0));
    let expected = 0.5 * MU * (2.0 * i1).exp() * slope + KAPPA * (c - 1.0);
    assert!((fung.wrench.force.z / expected - 1.0).abs() < 1e-13);
    let blatz_ko = respond(&BlatzKo::foam(MU).unwrap(), tension, Request::Wrench).unwrap();
    // u = μ/2 (2 + 1/c² + 2c − 5)
    assert!((blatz_ko.wrench.force.z / (MU * (1.0 - c.powi(-3))) - 1.0).abs() < 1e-14);
    let fibres = Fibres::new(Straight::axial(), 80e3, 1.2).unwrap();
    let pulled = respond(&fibres, tension, Request::Wrench).unwrap().wrench.force.z;
    let e4 = c * c - 1.0;
    assert!((pulled / (80e3 * e4 * (1.2 * e4 * e4).exp() * 2.0 * c) - 1.0).abs() < 1e-13);
}

#[test]
fn the_polynomial_in_tension_is_its_own_text() {
    let c = 1.4_f64;
    let terms = [((1, 0), 1e5), ((0, 1), 2e4), ((2, 1), 3e3), ((0, 3), -1e2), ((4, 0), 50.0)];
    let law = Polynomial::new(&terms, &[1e5, 0.0, 7e3]).unwrap();
    let (i1, i2, e) = (c * c - 1.0, 2.0 * c * c - 2.0, c - 1.0);
    let direct: f64 = terms.iter().map(|&((i, j), v)| v * i1.powi(i as i32) * i2.powi(j as i32)).sum();
    let direct = direct + 1e5 * e * e + 7e3 * e.powi(6);
    let energy = respond(&law, [0.0, 0.0, 0.0, 0.0, 0.0, e], Request::Energy).unwrap().energy;
    assert!((energy / direct - 1.0).abs() < 1e-14);
    assert_eq!(Isotropic::degree(&law), Some(8));
    assert_eq!(Isotropic::degree(&Polynomial::new(&terms[..2], &[1e5, 0.0, 7e3]).unwrap()), Some(6));
    assert_eq!(Isotropic::degree(&Polynomial::new(&terms[1..2], &[]).unwrap()), Some(2));
}

#[test]
fn fibres_at_zero_strain_are_slack_and_finite() {
    let fibres = Fibres::new(Straight::axial(), 80e3, 1.2).unwrap();
    let at = |e: f64| respond(&fibres, [0.0, 0.0, 0.0, 0.0, 0.0, e], Request::Tangent).unwrap();
    assert_eq!(at(0.0), Response::zero());
    assert_eq!(at(-0.3), Response::zero());
    for e in [1e-300, 1e-100, 1e-15] {
        assert!((at(e).tangent[(5, 5)] / (4.0 * 80e3) - 1.0).abs() < 1e-14, "tension side at {e:e}");
    }
}

#[test]
fn a_helix_has_no_direction_on_the_axis_and_a_twisted_yarn_has() {
    let centre = Points { x: vec![0.0], y: vec![0.0], weight: vec![1.0], rates: None };
    let stretched = strain([0.0, 0.0, 0.0, 0.0, 0.0, 0.1]);
    let artery = HolzapfelGasserOgden::artery([MU, KAPPA], [8e4, 1.0], 0.5).unwrap();
    for request in [Request::Energy, Request::Wrench, Request::Tangent] {
        let error = artery
            .integrate(&centre, &Station::straight(0.0), &stretched, request)
            .expect_err("no direction");
        assert!(error.to_string().contains("helix has none on the axis"), "{error}");
    }
    let yarn = Fibres::new(Twisted::new(100.0).unwrap(), 8e4, 1.0).unwrap();
    let axial = Fibres::new(Straight::axial(), 8e4, 1.0).unwrap();
    let [a, b] = [
        yarn.integrate(&centre, &Station::straight(0.0), &stretched, Request::Wrench),
        axial.integrate(&centre, &Station::straight(0.0), &stretched, Request::Wrench),
    ];
    assert_eq!(a.unwrap().wrench.force.z, b.unwrap().wrench.force.z);
}

#[test]
fn a_screw_of_fibres_couples_twist_and_tension() {
    let yarn = |hand: f64| {
        Sum(
            NeoHookean::new(MU, LAMBDA).unwrap(),
            Fibres::new(Twisted::new(hand * 100.0).unwrap(), 8e5, 1.0).unwrap(),
        )
    };
    let pull = strain([0.0, 0.0, 0.0, 0.0, 0.0, 0.05]);
    let moment = |hand: f64| {
        let section = Section::new(Circle::new(0.01), yarn(hand)).unwrap();
        section.wrench(&Station::straight(0.0), &pull).unwrap().moment.z
    };
    let (right, left) = (moment(1.0), moment(-1.0));
    // pulled fibres straighten: a right-hand screw wants to twist back, its moment against further right-hand twist is positive
    assert!(right > 0.0 && (right + left).abs() < 1e-12 * right);
}

#[test]
fn tables_that_mean_nothing_are_refused_by_name() {
    let refused = |c: &[Coefficient], d: &[f64], name: &str| {
        for error in [Polynomial::new(c, d).unwrap_err(), IsochoricPolynomial::new(c, d).unwrap_err()] {
            assert!(matches!(&error, Error::Coefficient { name: n, .. } if n == name), "{error}");
        }
    };
    refused(&[((1, 0), 1.0), ((0, 0), 2.0)], &[], "C_00");
    refused(&[((1, 0), 1.0), ((2, 1), f64::NAN)], &[], "C_21");
    refused(&[((1, 0), 1.0), ((2, 1), 3.0), ((1, 0), 1.0)], &[], "C_10");
    refused(&[((1, 0), 1.0)], &[1.0, f64::INFINITY], "D_2");
    refused(&[((1, 0), 0.0), ((0, 1), 0.0)], &[0.0], "largest in size");
    refused(&[], &[], "largest in size");
    let message = Polynomial::new(&[((0, 0), 2.0)], &[]).unwrap_err().to_string();
    assert!(message.starts_with("coefficient C_00 is 2, but must be left out"), "{message}");
    assert!(
        matches!(Ogden::new(&[(1e5, 2.0), (1e5, 0.0)], 1e5), Err(Error::Coefficient { name, .. }) if name == "alpha_2")
    );
    assert!(Ogden::new(&[], 1e5).is_err() && Ogden::new(&[(1e5, -2.0)], 1e5).is_err());
}

#[test]
fn constants_out_of_range_are_refused_by_every_law() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let errors = [
            IsochoricNeoHookean::new(bad, KAPPA).err(),
            IsochoricNeoHookean::new(MU, bad).err(),
            Gent::new(MU, LAMBDA, bad).err(),
            Gent::new(bad, LAMBDA, 30.0).err(),
            ArrudaBoyce::new(MU, bad, 3.0).err(),
            ArrudaBoyce::new(MU, KAPPA, bad).err(),
            Fung::new(MU, KAPPA, bad).err(),
            Hencky::new(bad, LAMBDA).err(),
            SaintVenantKirchhoff::new(bad, LAMBDA).err(),
            BlatzKo::foam(bad).err(),
            Yeoh::new([bad, 0.0, 0.0], [1.0, 0.0, 0.0]).err(),
            Fibres::new(Straight::axial(), bad, 1.0).err(),
            HolzapfelGasserOgden::artery([MU, KAPPA], [MU, bad], 0.5).err(),
            Ribbon::new([bad, 1e-3], 1e9, 0.3).err(),
        ];
        for (index, error) in errors.into_iter().enumerate() {
            let error = error.unwrap_or_else(|| panic!("constructor {index} took {bad}"));
            assert!(matches!(error, Error::Invalid { .. }), "{error}");
        }
    }
    assert!(
        Straight::new([0.0; 3]).is_err()
            && Helix::new(f64::NAN).is_err()
            && Twisted::new(f64::INFINITY).is_err()
    );
    assert!(Scaled::new(f64::NAN, Hencky::new(MU, LAMBDA).unwrap()).is_err());
    assert!(BlatzKo::new(MU, 0.5, 0.5).is_err() && BlatzKo::new(MU, 0.3, 1.1).is_err());
}

/// Ψ = K Δξ written as an energy that grows along s.
struct Growing;

impl Resultant for Growing {
    fn energy<D: Scalar>(&self, strain: &Strain<D>, s: D) -> D {
        let xi = strain.to_array();
        let stiffness = [1.0, 2.0, 3.0, 40.0, 50.0, 60.0];
        xi.into_iter().zip(stiffness).fold(D::zero(), |sum, (x, k)| sum + x * x * (0.5 * k)) * (s * s + 1.0)
    }
}

#[test]
fn a_resultant_energy_is_a_cross_section() {
    let (at, xi) = (Station::straight(0.5), strain([0.3, -0.2, 0.5, 0.01, 0.02, -0.03]));
    let stiffness = Stiffness::diagonal([1.0, 2.0, 3.0, 40.0, 50.0, 60.0]).unwrap();
    let expected = stiffness.respond(&at, &xi, Request::Tangent).unwrap();
    let actual = Resultants(Growing).respond(&at, &xi, Request::Rate).unwrap();
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-15 * (1.0 + b.abs());
    assert!(close(actual.energy, 1.25 * expected.energy));
    assert!((actual.tangent - expected.tangent * 1.25).amax() < 1e-13);
    for (a, b) in actual.wrench.to_array().into_iter().zip(expected.wrench.to_array()) {
        assert!(close(a, 1.25 * b));
    }
    for (a, b) in actual.wrench_rate.to_array().into_iter().zip(expected.wrench.to_array()) {
        assert!(close(a, b)); // d(1 + s²)/ds = 1 at s = 1/2
    }
    for request in [Request::Energy, Request::Wrench, Request::Tangent] {
        let partial = Resultants(Growing).respond(&at, &xi, request).unwrap();
        assert_eq!(partial.energy, actual.energy);
    }
    assert!(Resultants(Growing).wrench(&at, &strain([f64::NAN; 6])).is_err());
}

#[test]
fn the_ribbon_follows_sadowsky_where_bent_and_meets_the_flat_branch_smoothly() {
    let ribbon = Resultants(Ribbon::new([0.02, 2e-4], 2e9, 0.3).unwrap());
    let plate = 2e9 * 2e-4_f64.powi(3) * 0.02 / (12.0 * (1.0 - 0.09));
    let at = Station::straight(0.0);
    let respond = |kappa: f64, tau: f64| {
        ribbon.respond(&at, &strain([kappa, 0.0, tau, 0.0, 0.0, 0.0]), Request::Tangent).unwrap()
    };
    let (kappa, tau) = (5.0_f64, 2.0_f64);
    let energy = 0.5 * plate * (kappa * kappa + tau * tau).powi(2) / (kappa * kappa);
    assert!((respond(kappa, tau).energy / energy - 1.0).abs() < 1e-14);
    assert!((respond(1.0, 4.0).energy / (0.5 * plate * 64.0) - 1.0).abs() < 1e-14);
    let (flat, bent) = (respond(3.0, 3.0), respond(3.0_f64.next_up(), 3.0));
    assert!((flat.wrench - bent.wrench).to_vector().norm() < 1e-14 * bent.wrench.to_vector().norm());
    assert!(
        respond(0.0, 0.0).is_finite() && respond(0.0, 1e-200).is_finite() && respond(1e-200, 0.0).is_finite()
    );
    assert!((respond(0.0, 0.0).tangent[(0, 0)] / plate - 1.0).abs() < 1e-14);
}
