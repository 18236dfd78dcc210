//! Energies with branches, on strains that put the lanes of one block on both sides: the point-by-point answer of num-dual, to rounding.

use hyperrod::material::*;
use hyperrod::scalar::Scalar;
use hyperrod::{Error, Strain};

use crate::oracle::{self, *};

const YOUNG: f64 = 1e5;

/// Which way an energy branches.
#[derive(Clone, Copy, Debug)]
enum Branch {
    /// On `<` with a number: tension and compression differ.
    Less,
    /// On the real part.
    Real,
    /// On `>` of two dual numbers: the larger of two energies.
    Larger,
    /// `abs`, which selects lane by lane.
    Abs,
    /// `signum`, `is_positive` and `is_negative`.
    Sign,
    /// On the point and not on the strain.
    Place,
    /// One branch inside another.
    Nested,
}
use Branch::*;

impl Local for Branch {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        let g = f.gamma();
        let (a, b, e) = (g.x, g.y, g.z);
        let even = (a * a + b * b + e * e) * YOUNG;
        let more = (e * e * e * 0.7 + e * a * b + e * e) * YOUNG;
        match self {
            Less => {
                if e < 0.0 {
                    return even;
                }
                even + more
            }
            Real => even + if e.re() > 0.0 { more } else { a * b * YOUNG },
            Larger => {
                let (one, other) = (even + a * e * YOUNG, even + b * e * YOUNG);
                if one > other { one } else { other }
            }
            Abs => even + (a * e).abs() * e * YOUNG,
            Sign => {
                let sign = if a.is_negative() { a * a } else { a * b };
                even + e.signum() * more + if b.is_positive() { sign * YOUNG } else { D::zero() }
            }
            Place => {
                if at.x > 0.0 {
                    return even * (at.y * 20.0 + 1.0);
                }
                even * 3.0
            }
            Nested => {
                if e <= 0.0 {
                    return if a > b { even } else { even * 2.0 };
                }
                if at.y < at.x { even + more } else { even * (at.s + 1.0) }
            }
        }
    }
}

const ALL: [Branch; 7] = [Less, Real, Larger, Abs, Sign, Place, Nested];

/// As in `levels`.
const ROUNDING: f64 = 1e-13;

/// Bent about both axes, so that every block of a section has points in tension and in compression.
fn straddling() -> [Strain; 3] {
    [
        strain([0.9, -0.7, 0.4, 0.2, -0.3, 0.05], 0.2),
        strain([-0.8, 0.5, -0.9, -0.1, 0.2, -0.02], 0.3),
        strain([0.9, 0.9, 0.9, 0.1, 0.1, 0.0], 1e-7),
    ]
}

/// Whether the first four points, a block of the narrowest lanes, lie on both sides.
fn straddles(points: &Points, strain: &Strain) -> bool {
    let stretch =
        |q: usize| strain.linear.z + strain.angular.x * points.y[q] - strain.angular.y * points.x[q];
    let tense = (0..4).filter(|&q| stretch(q) > 0.0).count();
    (1..4).contains(&tense)
}

#[test]
fn an_energy_with_branches_is_that_of_num_dual_however_many_points_there_are() {
    let mut straddled = 0;
    for count in 1..=17 {
        for moving in [false, true] {
            let points = points(count, moving);
            for strain in &straddling() {
                straddled += usize::from(count >= 4 && straddles(&points, strain));
                for law in &ALL {
                    for (at, curve) in [(straight(), false), (curved(), true)] {
                        let expected = if curve {
                            expected(&Curved(law), &points, &at, strain)
                        } else {
                            expected(&oracle::Straight(law), &points, &at, strain)
                        };
                        for request in REQUESTS {
                            let answer = law.integrate(&points, &at, strain, request).unwrap();
                            let error = expected.error_of(&answer, request);
                            assert!(error <= ROUNDING, "{law:?}, {count} points, {request:?}: {error:.1e}");
                        }
                    }
                }
            }
        }
    }
    assert!(straddled >= 60, "only {straddled} blocks had both signs");
}

#[test]
fn branches_are_right_at_section_level_and_in_closures() {
    for count in [1, 3, 4, 8, 13, 17] {
        let points = points(count, true);
        for strain in &straddling() {
            for law in ALL {
                let expected = expected(&oracle::Straight(&law), &points, &straight(), strain);
                let ways: [(&str, Box<dyn Material>); 3] = [
                    (
                        "macro",
                        Box::new(hyperrod::sectional!([law: Branch] |xi, at| {
                            Local::energy_density(&law, &Deformation::of(xi, at), at)
                        })),
                    ),
                    ("local closure", Box::new(local(move |f, at| Local::energy_density(&law, f, at)))),
                    (
                        "sectional closure",
                        Box::new(sectional(move |xi, at| {
                            Local::energy_density(&law, &Deformation::of(xi, at), at)
                        })),
                    ),
                ];
                for (name, way) in ways {
                    for request in REQUESTS {
                        let answer = way.integrate(&points, &straight(), strain, request).unwrap();
                        let error = expected.error_of(&answer, request);
                        assert!(error <= ROUNDING, "{law:?}, {name}, {count} points: {error:.1e}");
                    }
                }
            }
        }
    }
}

/// The tension-only fibres of the library where part of the section is slack.
#[test]
fn slack_and_tense_fibres_in_one_block_are_those_of_num_dual() {
    let fibres = Fibres::new(hyperrod::material::Straight::axial(), 80e3, 1.2).unwrap();
    for count in 4..=17 {
        let points = points(count, true);
        for strain in &straddling() {
            assert!(straddles(&points, strain) || strain.linear.z == 0.0);
            let expected = expected(&oracle::Straight(&fibres), &points, &straight(), strain);
            for request in REQUESTS {
                let answer = fibres.integrate(&points, &straight(), strain, request).unwrap();
                let error = expected.error_of(&answer, request);
                assert!(error <= ROUNDING, "{count} points, {request:?}: {error:.1e}");
            }
        }
    }
}

/// One strain a lane: the lanes of a batch disagree too.
#[test]
fn strains_on_both_sides_of_a_branch_are_right_in_a_batch() {
    let points = points(11, false);
    let sites: Vec<(Station, Strain)> = (0..19)
        .map(|k| {
            let sign = if k % 3 == 0 { -1.0 } else { 1.0 };
            (Station::straight(0.01 * f64::from(k)), strain([0.9, -0.7, 0.4, 0.2, sign * 0.3, sign], 0.1))
        })
        .collect();
    for law in &ALL {
        for request in REQUESTS {
            let mut out = vec![Response::zero(); sites.len()];
            law.integrate_many(&points, &sites, request, &mut out).unwrap();
            for ((at, strain), answer) in sites.iter().zip(&out) {
                let error = expected(&oracle::Straight(law), &points, at, strain).error_of(answer, request);
                assert!(error <= ROUNDING, "{law:?}, {request:?}: {error:.1e}");
            }
        }
    }
}

/// An energy that does not look at a component, or returns a number where it finds none, must not hide that a strain is none.
#[test]
fn a_strain_that_is_no_number_is_refused_by_laws_that_do_not_look_at_it() {
    // zero for what is not in compression, NaN among it
    let contact = hyperrod::local!(|f, _at| {
        let e = f.gamma().z;
        if e < 0.0 { e * e * YOUNG } else { D::zero() }
    });
    let stretch = hyperrod::local!(|f, _at| f.gamma().z * f.gamma().z * YOUNG);
    let shear = hyperrod::isotropic!(|i, _at| (i.i1_excess() - i.j() * i.j()) * YOUNG);
    let sectional_stretch = hyperrod::sectional!(|xi, _at| xi.linear.z * xi.linear.z * YOUNG);
    let closure = local(|f, _at| f.gamma().z * f.gamma().z * YOUNG);
    let sectional_closure = sectional(|xi, _at| xi.linear.z * xi.linear.z * YOUNG);
    let laws: [(&str, &dyn Material); 6] = [
        ("contact", &contact),
        ("stretch", &stretch),
        ("shear", &shear),
        ("sectional stretch", &sectional_stretch),
        ("closure", &closure),
        ("sectional closure", &sectional_closure),
    ];
    for (name, law) in laws {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for i in 0..6 {
                let mut xi = [0.01; 6];
                xi[i] = bad;
                for request in REQUESTS {
                    let refused = |result: hyperrod::Result<()>| match result {
                        Err(Error::InvalidAt { .. }) => {}
                        other => panic!("{name}: component {i} = {bad} gave {other:?}"),
                    };
                    let bad = Strain::from_array(xi);
                    let points = points(5, false);
                    refused(law.integrate(&points, &straight(), &bad, request).map(|_| ()));
                    let mut sites = vec![(straight(), Strain::from_array([0.01; 6])); 11];
                    sites[4].1 = bad;
                    let mut out = vec![Response::zero(); 11];
                    refused(law.integrate_many(&points, &sites, request, &mut out));
                }
            }
        }
    }
}

/// A closure runs on four lanes, and its sums on eight where the machine has them.
#[test]
fn a_closure_that_failed_leaves_nothing_behind() {
    let law = local(|f, _| hyperrod::num_dual::DualNum::sqrt(&f.gamma().z));
    let at = Station::straight(0.0);
    let (stretched, compressed) = ([0.0, 0.0, 0.0, 0.0, 0.0, 0.1], [0.0, 0.0, 0.0, 0.0, 0.0, -0.1]);
    for count in 1..=17 {
        let points = points(count, false);
        let energy = |strain| law.integrate(&points, &at, &Strain::from_array(strain), Request::Tangent);
        let before = energy(stretched).unwrap();
        assert!(energy(compressed).is_err(), "no root of a negative stretch");
        assert_eq!(energy(stretched).unwrap(), before, "{count} points");
    }
}
