//! Every law passes the battery, and wrong laws do not.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::battery::{self, Expected};
use crate::section_reference::relaxed_fibre;
use hyperrod::Scalar;
use hyperrod::material::*;

const MU: f64 = 170e3;
const LAMBDA: f64 = 400e3;
const KAPPA: f64 = 500e3;
const RIGID: f64 = LAMBDA + 2.0 * MU;
const RIGID_ISOCHORIC: f64 = KAPPA + 4.0 / 3.0 * MU;

/// Five coefficients and two volumetric ones.
const POLY: [Coefficient; 5] =
    [((1, 0), 100e3), ((0, 1), 30e3), ((2, 0), 20e3), ((1, 1), -5e3), ((0, 2), 1.5e3)];
const POLY_D: [f64; 2] = [500e3, 200e3];

conforms!(mooney_rivlin, MooneyRivlin::new(120e3, 40e3).unwrap(),
    shear: 320e3, axial: 400e3, rest_stress: 400e3);
conforms!(mooney_rivlin_with_pressure, ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap()),
    shear: 320e3, axial: 400e3);
conforms!(neo_hookean, NeoHookean::new(MU, LAMBDA).unwrap(), shear: MU, axial: RIGID);
conforms!(isochoric_neo_hookean, IsochoricNeoHookean::new(MU, KAPPA).unwrap(),
    shear: MU, axial: RIGID_ISOCHORIC);
conforms!(polynomial, Polynomial::new(&POLY, &POLY_D).unwrap(),
    shear: 260e3, axial: 1448e3, rest_stress: 320e3);
conforms!(polynomial_with_pressure, ReferencePressure(Polynomial::new(&POLY, &POLY_D).unwrap()),
    shear: 260e3, axial: 1448e3);
conforms!(isochoric_polynomial, IsochoricPolynomial::new(&POLY, &POLY_D).unwrap(),
    shear: 260e3, axial: 1000e3 + 4.0 / 3.0 * 260e3);
conforms!(yeoh, Yeoh::new([85e3, -4e3, 1e3], [250e3, 1e3, 0.0]).unwrap(), shear: MU, axial: RIGID_ISOCHORIC);
conforms!(gent, Gent::new(MU, LAMBDA, 30.0).unwrap(), shear: MU, axial: RIGID);
conforms!(arruda_boyce, ArrudaBoyce::new(MU, KAPPA, 3.0).unwrap(),
    shear: arruda_boyce_shear(3.0), axial: KAPPA + 4.0 / 3.0 * arruda_boyce_shear(3.0));
conforms!(ogden, Ogden::new(&[(100e3, 1.3), (2e3, 5.0), (-40e3, -2.0)], LAMBDA).unwrap(),
    shear: 110e3, axial: LAMBDA + 220e3);
conforms!(fung, Fung::new(MU, KAPPA, 2.5).unwrap(), shear: MU, axial: RIGID_ISOCHORIC);
conforms!(saint_venant_kirchhoff, SaintVenantKirchhoff::new(MU, LAMBDA).unwrap(), shear: MU, axial: RIGID);
conforms!(hencky, Hencky::new(MU, LAMBDA).unwrap(), shear: MU, axial: RIGID);
conforms!(blatz_ko, BlatzKo::new(MU, 0.3, 0.4).unwrap(), shear: MU, axial: 2.0 * MU * 1.75);
conforms!(blatz_ko_foam, BlatzKo::foam(MU).unwrap(), shear: MU, axial: 3.0 * MU);
conforms!(blatz_ko_without_contraction, BlatzKo::new(MU, 0.0, 0.5).unwrap(), shear: MU, axial: 2.0 * MU);
// an angle at which no fibre goes slack inside a difference stencil
conforms!(artery, HolzapfelGasserOgden::artery([MU, KAPPA], [80e3, 1.2], 0.5).unwrap(),
    shear: MU, axial: RIGID_ISOCHORIC, isotropic: false, size: 0.1);
conforms!(yarn, Sum(NeoHookean::new(MU, LAMBDA).unwrap(), Fibres::new(Twisted::new(40.0).unwrap(), 80e3, 1.2).unwrap()),
    shear: MU, axial: RIGID, isotropic: false, size: 0.05);
conforms!(sum_of_scaled, Sum(Scaled::new(0.25, NeoHookean::new(MU, LAMBDA).unwrap()).unwrap(),
        Scaled::new(2.0, Ogden::new(&[(MU, 2.0)], LAMBDA).unwrap()).unwrap()),
    shear: 2.25 * MU, axial: 2.25 * RIGID);
conforms!(relaxed_fibre, relaxed_fibre(120e3, 40e3), shear: 320e3, axial: 960e3);

/// The series of Arruda and Boyce (1993), typed in from the text.
fn arruda_boyce_shear(m: f64) -> f64 {
    MU * (1.0
        + 3.0 / (5.0 * m.powi(2))
        + 99.0 / (175.0 * m.powi(4))
        + 513.0 / (875.0 * m.powi(6))
        + 42039.0 / (67375.0 * m.powi(8)))
}

fn fails(check: impl FnOnce()) -> bool {
    catch_unwind(AssertUnwindSafe(check)).is_err()
}

fn neo_hookean_moduli() -> Expected {
    Expected { shear: MU, axial: RIGID, ..Default::default() }
}

#[test]
fn a_wrong_sign_fails_the_battery() {
    let wrong = hyperrod::isotropic!(|i, _at| {
        let ln_j = i.j().ln_1p();
        (i.i1_excess() - hyperrod::scalar::x_minus_ln_1p(i.j()) * 2.0) * (0.5 * MU)
            + ln_j * ln_j * (0.5 * LAMBDA)
    });
    assert!(fails(|| battery::moduli(&wrong, &neo_hookean_moduli())));
    assert!(!fails(|| battery::rest(&wrong, &neo_hookean_moduli())), "fails for what is wrong, not for all");
}

#[test]
fn a_missing_term_fails_the_battery() {
    let wrong = hyperrod::isotropic!(|i, _at| {
        (i.i1_excess() + hyperrod::scalar::x_minus_ln_1p(i.j()) * 2.0) * (0.5 * MU)
    });
    assert!(fails(|| battery::moduli(&wrong, &neo_hookean_moduli())));
}

#[test]
fn a_stressed_reference_fails_the_battery() {
    let wrong = hyperrod::isotropic!(|i, _at| i.i1() * (0.5 * MU));
    assert!(fails(|| battery::rest(&wrong, &neo_hookean_moduli())));
}

#[test]
fn cancellation_fails_the_battery() {
    // right in exact arithmetic
    let wrong = hyperrod::isotropic!(|i, _at| {
        let ln_j = (i.j() + 1.0).ln();
        (i.i1() - ln_j * 2.0) * (0.5 * MU) + ln_j * ln_j * (0.5 * LAMBDA)
    });
    assert!(!fails(|| battery::moduli(&wrong, &neo_hookean_moduli())));
    assert!(fails(|| battery::tiny(&wrong, &neo_hookean_moduli())));
}

#[test]
fn a_lost_derivative_fails_the_battery() {
    struct Detached;
    impl Isotropic for Detached {
        fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
            let frozen = i.j().re();
            (i.i1_excess() + i.j() * frozen) * MU
        }
    }
    let expected = Expected { shear: 2.0 * MU, axial: 3.0 * MU, ..Default::default() };
    assert!(fails(|| battery::differences(&Detached, &expected)));
}

#[test]
fn a_direction_in_an_isotropic_law_fails_the_battery() {
    let wrong = hyperrod::local!(|f, _at| {
        let g = f.gamma();
        (g.x * g.x + g.y * g.y * 0.9 + g.z * g.z) * MU
    });
    assert!(fails(|| battery::objective(&wrong, &neo_hookean_moduli())));
}

#[test]
fn a_law_that_answers_nan_fails_the_battery() {
    struct Nan;
    impl Material for Nan {
        fn integrate(
            &self,
            _: &Points,
            _: &Station,
            _: &hyperrod::Strain,
            _: Request,
        ) -> hyperrod::Result<Response> {
            Ok(Response { energy: f64::NAN, ..Response::zero() })
        }
        fn polynomial_degree(&self) -> Option<usize> {
            None
        }
    }
    assert!(fails(|| battery::collapse(&Nan)));
    assert!(fails(|| battery::inadmissible(&Nan)));
}
