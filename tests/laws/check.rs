//! `section::check` finds what is known of a law, and finds fault with a law that has one.

use hyperrod::Strain;
use hyperrod::material::*;
use hyperrod::section::{Bound, CheckOptions, Circle, Rectangle, check};

const MU: f64 = 170e3;
const LAMBDA: f64 = 400e3;

fn options() -> CheckOptions {
    CheckOptions::default()
}

#[test]
fn the_report_on_saint_venant_kirchhoff_finds_where_it_gives_way() {
    let report =
        check(&Circle::new(0.01), &SaintVenantKirchhoff::new(MU, LAMBDA).unwrap(), &options()).unwrap();
    // under compression the shear stiffness mu + (lambda/2 + mu)(c² − 1) vanishes before the axial one, 3c² = 1
    let c = (1.0 - MU / (0.5 * LAMBDA + MU)).sqrt();
    let Bound::Unstable { strain, mode } = &report.ranges[5].lower else {
        panic!("{}", report.ranges[5].lower)
    };
    assert!((strain - (c - 1.0)).abs() < 1e-9, "{strain} instead of {}", c - 1.0);
    assert!(
        mode[5].abs() < 1e-6 && mode[0].abs() < 1e-6 && mode[1].abs() < 1e-6,
        "in shear or twist: {mode:?}"
    );
    assert!(matches!(report.ranges[5].upper, Bound::Beyond { strain: 2.0 }));
    // bent, the inner rim is turned inside out at 1 whatever the few points of degree 4 see
    assert!(report.ranges[0].upper.strain() < 1.01 && report.ranges[0].length > 0.0099, "{report}");
    assert_eq!(report.degree, 4);
    assert!(report.quadrature_error < 1e-15, "{:e}", report.quadrature_error);
    assert!(report.sensitivity[0].2 > 1e-4, "degree 2 is not enough: {:e}", report.sensitivity[0].2);
}

#[test]
fn moduli_and_rest_are_those_of_the_law() {
    let shape = Rectangle::new(0.02, 0.01);
    let (area, i_x, i_y) = (2e-4, 0.02 * 1e-6 / 12.0, 0.01 * 8e-6 / 12.0);
    let report = check(&shape, &NeoHookean::new(MU, LAMBDA).unwrap(), &options()).unwrap();
    let rigid = LAMBDA + 2.0 * MU;
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-13;
    assert_eq!(report.rest.to_array(), [0.0; 6]);
    assert!(close(report.moduli.axial, rigid * area) && close(report.moduli.young, rigid));
    assert!(close(report.moduli.bending[0], rigid * i_x) && close(report.moduli.bending[1], rigid * i_y));
    assert!(close(report.moduli.torsion, MU * (i_x + i_y)) && close(report.moduli.shear_modulus, MU));
    // the quotients' own accuracy
    let derivatives = report.derivatives;
    assert!(
        derivatives.wrench < 1e-8 && derivatives.tangent < 1e-8 && derivatives.asymmetry < 1e-8,
        "{derivatives:?}"
    );
    let raw = check(&shape, &MooneyRivlin::new(120e3, 40e3).unwrap(), &options()).unwrap();
    assert!(close(raw.rest.force.z, 400e3 * area));
    assert!(raw.to_string().contains("STRESS AT REST"), "{raw}");
}

#[test]
fn the_error_of_the_quadrature_falls_with_its_degree_and_is_estimated_truly() {
    let law = NeoHookean::new(MU, LAMBDA).unwrap();
    let report = check(&Circle::new(0.01), &law, &CheckOptions { sample_strain: 0.6, ..options() }).unwrap();
    let errors: Vec<f64> = report.sensitivity.iter().map(|row| row.2).collect();
    assert!(errors[0] > 1e-4 && errors[6] < 1e-14, "{errors:?}");
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0] || pair[1] < 1e-14), "{errors:?}");
    let at_degree_12 = report.sensitivity.iter().find(|row| row.0 == 12).unwrap();
    assert_eq!(report.quadrature_error, at_degree_12.2);
}

/// A law with a wrench that is not the gradient of its energy.
struct Faulty(NeoHookean);

impl Material for Faulty {
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> hyperrod::Result<Response> {
        let mut response = self.0.integrate(points, at, strain, request)?;
        response.wrench.moment.x += 1e-3 * response.wrench.moment.z;
        Ok(response)
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }
}

#[test]
fn a_wrench_without_potential_is_found_out() {
    let report =
        check(&Circle::new(0.01), &Faulty(NeoHookean::new(MU, LAMBDA).unwrap()), &options()).unwrap();
    let found = report.derivatives;
    assert!(found.wrench > 1e-5 && found.tangent > 1e-5 && found.asymmetry > 1e-5, "{found:?}");
}

#[test]
fn a_limit_of_the_law_is_named() {
    let gent = Gent::new(MU, LAMBDA, 1.0).unwrap();
    let report = check(&Circle::new(0.01), &gent, &options()).unwrap();
    let Bound::Inadmissible { strain, error } = &report.ranges[3].upper else { panic!("{}", report) };
    assert!(
        (strain - 1.0).abs() < 1e-9 && error.to_string().contains("below the limit Jm"),
        "{strain} {error}"
    );
    let Bound::Inadmissible { strain, error } = &report.ranges[5].lower else { panic!("{}", report) };
    // e² + 2(e − ln(1 + e)) = 1 at e < 0
    let measure = strain * strain + 2.0 * (strain - (1.0 + strain).ln());
    assert!((measure - 1.0).abs() < 1e-6 && error.to_string().contains("Jm"), "{strain}");
}

#[test]
fn rounding_near_a_pole_is_no_loss_of_stability() {
    // convex in this range, with a tangent that grows beyond all bounds at its ends
    let report = check(&Circle::new(0.01), &Gent::new(MU, LAMBDA, 1.5).unwrap(), &options()).unwrap();
    for range in &report.ranges {
        for bound in [&range.lower, &range.upper] {
            assert!(!matches!(bound, Bound::Unstable { .. }), "{report}");
        }
    }
}

#[test]
fn a_shape_that_is_none_is_an_error() {
    assert!(check(&Circle::new(-1.0), &NeoHookean::new(MU, LAMBDA).unwrap(), &options()).is_err());
}
