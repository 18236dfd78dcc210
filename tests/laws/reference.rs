//! Every law against 54-digit integrals over the section (set A), tiny strains included.

use crate::section_reference::{DEGREE, groups};

/// What is reached is rounding: some 20 operations in u, and a sum of up to 1e4 points whose errors average.
const TOLERANCE: f64 = 1e-13;

#[test]
fn wrench_and_tangent_of_every_law_agree_with_the_reference() {
    let (mut cases, mut tangents) = (0, 0);
    for group in groups() {
        let Some(points) = group.points(DEGREE) else { continue };
        for (case, errors) in group.errors(&points) {
            let name = format!("{} on {}, {}", group.law, group.section, case.kind);
            assert!(errors.psi <= TOLERANCE, "{name}: Psi is off by {:e}", errors.psi);
            assert!(errors.k.unwrap_or(0.0) <= TOLERANCE, "{name}: K is off by {:?}", errors.k);
            cases += 1;
            tangents += usize::from(errors.k.is_some());
        }
    }
    assert!(
        cases >= 4 * 8 * 9 && tangents >= 4 * 8 * 4,
        "only {cases} cases with {tangents} tangents were read"
    );
}

#[test]
fn polynomial_laws_need_no_more_than_their_degree() {
    for group in groups() {
        let degree = match group.law.as_str() {
            "mr_raw" | "mr_pressure" => 2,
            "poly5_raw" | "svk" => 4,
            _ => continue,
        };
        let Some(points) = group.points(degree) else { continue };
        for (case, errors) in group.errors(&points) {
            let worst = errors.psi.max(errors.k.unwrap_or(0.0));
            assert!(worst <= TOLERANCE, "{} on {}, {}: {worst:e}", group.law, group.section, case.kind);
        }
    }
}

#[test]
fn a_constant_off_by_one_part_in_a_billion_is_seen() {
    for mut group in groups() {
        let Some(points) = group.points(12) else { continue };
        let name = ["C1", "C10", "mu"].into_iter().find(|name| !group.constants[*name].is_null()).unwrap();
        let value = group.constants[name].as_f64().unwrap();
        group.constants[name] = (value * (1.0 + 1e-9)).into();
        let worst = group.errors(&points).iter().map(|(_, errors)| errors.psi).fold(0.0, f64::max);
        assert!(worst > 1e-10, "{}: {worst:e}", group.law);
    }
}
