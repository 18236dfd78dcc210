//! Every case of the converged 2-D finite elements, at the rung that the balance rule names.
use crate::cases::{cases, rung, shape};
use crate::{relative, respond, solid};

#[test]
fn every_reference_case_is_met_at_its_rung() {
    let cases = cases().unwrap();
    assert_eq!(cases.len(), 64);
    for case in cases {
        let (degrees, tolerance) = rung(&case.section, &case.strain);
        let response = respond(&solid(shape(&case.section), case.lambda, degrees), case.dxi);
        let psi = response.wrench.to_array();
        let error = if case.strain == "rest" {
            psi.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
        } else {
            relative(&psi, &case.psi)
        };
        let what = format!("{} {} {}", case.section, case.law, case.strain);
        assert!(error < tolerance, "{what}: {error:e} at {degrees:?}");
    }
}

/// Torsion of the square at (5, 4) against the finite elements: the energy of a Ritz basis is an upper bound and falls with the basis.
#[test]
fn the_energy_falls_towards_that_of_the_finite_elements() {
    let exact = 0.1576848011036; // square nh030 twist1.5
    let energies: Vec<f64> = [(0, 0), (3, 2), (5, 4), (7, 6), (9, 8)]
        .map(|degrees| respond(&solid(shape("square"), 1.5, degrees), [0.0, 0.0, 1.5, 0.0, 0.0, 0.0]).energy)
        .to_vec();
    assert!(energies.windows(2).all(|pair| pair[0] > pair[1] - 1e-12), "{energies:?}");
    assert!(energies[4] > exact && energies[4] / exact - 1.0 < 2e-4, "{energies:?}");
}
