//! The degree of the quadrature: exact for polynomials, by a tolerance otherwise, and reported.

use hyperrod::material::{MooneyRivlin, NeoHookean, ReferencePressure, Station};
use hyperrod::section::*;
use hyperrod::{Error, Strain, local};

pub fn neo_hookean() -> NeoHookean {
    NeoHookean::new(170e3, 400e3).unwrap()
}

fn shapes() -> Vec<(&'static str, Box<dyn Shape>)> {
    let corner = vec![
        [-0.011, -0.006],
        [0.019, -0.006],
        [0.019, 0.0],
        [-0.005, 0.0],
        [-0.005, 0.014],
        [-0.011, 0.014],
    ];
    vec![
        ("circle", Box::new(Circle::new(0.01))),
        ("annulus", Box::new(Annulus::new(0.006, 0.01))),
        ("ellipse", Box::new(Ellipse::new(0.01, 0.004))),
        ("rectangle", Box::new(Rectangle::new(0.02, 0.012))),
        ("hexagon", Box::new(RegularPolygon::new(6, 0.01).unwrap())),
        ("L", Box::new(Polygon::new(corner).unwrap())),
    ]
}

#[test]
fn a_polynomial_law_has_its_own_degree_and_few_points() {
    for (name, shape) in shapes() {
        let law = ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap());
        let section = Section::new(shape, law).unwrap();
        let report = section.quadrature_report(1e-13, &StrainRange::default()).unwrap();
        println!("{name}: {report:?}");
        assert!(section.point_count() <= 6, "{name}");
        assert!(report.reached && report.degree == 2, "{name} {report:?}");
    }
    for (name, shape) in shapes() {
        let law = local!(degree 4; |f, _at| {
            let e = f.gamma().z * (f.gamma().z + 2.0) + f.gamma().x * f.gamma().x;
            e * e * 1e5 + f.gamma().y * f.gamma().y * 3e4
        });
        let section = Section::new(shape, law).unwrap();
        let report = section.quadrature_report(1e-13, &StrainRange::default()).unwrap();
        assert!(section.point_count() <= 15, "{name}");
        assert!(report.reached && report.degree == 4, "{name} {report:?}");
    }
}

/// The error is measured again against degree 60, at other strains of the range than the sampled ones.
#[test]
fn a_tolerance_is_met_with_the_smallest_degree_that_does() {
    let range = StrainRange { axial: 0.4, shear: 0.3, ..Default::default() };
    for (name, _) in shapes() {
        let mut last = 0;
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let shape = || shapes().into_iter().find(|(n, _)| *n == name).unwrap().1;
            let section =
                Section::new(shape(), neo_hookean()).unwrap().with_tolerance(tolerance, &range).unwrap();
            let report = section.quadrature_report(tolerance, &range).unwrap();
            println!("{name} {tolerance:e}: {report:?}");
            assert!(report.estimated_error <= 1.1 * tolerance, "{name} {report:?}");
            assert!(report.degree > last, "{name}: a finer tolerance needs a higher degree");
            assert_eq!((report.degree, report.points), (section.degree(), section.point_count()));
            last = report.degree;
            if report.degree > 3 {
                let coarser = section.with_degree(report.degree - 2).unwrap();
                let report = coarser.quadrature_report(tolerance, &range).unwrap();
                assert!(!report.reached, "{name}: two degrees less would do: {report:?}");
            }

            let section =
                Section::new(shape(), neo_hookean()).unwrap().with_tolerance(tolerance, &range).unwrap();
            let exact = Section::new(shape(), neo_hookean()).unwrap().with_degree(60).unwrap();
            for strain in [[9.0, 11.0, -14.0, 0.05, 0.1, 0.1], [-4.0, 13.0, 9.0, 0.0, -0.1, -0.15]] {
                let respond = |section: &dyn CrossSection| {
                    section.wrench(&Station::straight(0.0), &Strain::from_array(strain)).unwrap().to_array()
                };
                let error = super::direct::relative_difference(respond(&section), respond(&exact));
                assert!(error < 10.0 * tolerance, "{name} {tolerance:e}: {error:e}");
            }
        }
    }
}

#[test]
fn the_default_degree_does_what_its_documentation_says() {
    for (axial, bound) in [(0.3, 1e-8), (0.5, 1e-5)] {
        let range = StrainRange { axial, ..Default::default() };
        for (name, shape) in shapes() {
            let section = Section::new(shape, neo_hookean()).unwrap();
            let report = section.quadrature_report(bound, &range).unwrap();
            println!("{name} {axial}: {report:?}");
            assert!(report.reached, "{name} {axial} {report:?}");
        }
    }
}

#[test]
fn a_law_with_a_kink_is_told_that_no_degree_will_do() {
    let tension_only = local!(|f, _at| {
        let e = f.gamma().z;
        if e.re() > 0.0 { e * e * 5e5 } else { e * e * 1e3 }
    });
    let section = Section::new(Rectangle::new(0.02, 0.01), tension_only).unwrap();
    match section.with_tolerance(1e-10, &StrainRange::default()) {
        Err(Error::NoConvergence { residual, .. }) => assert!(residual > 1e-8),
        other => panic!("{:?}", other.map(|s| s.degree())),
    }
}

#[test]
fn a_range_beyond_the_law_is_refused_by_the_law() {
    let range = StrainRange { axial: 1.2, ..Default::default() };
    let section = Section::new(Circle::new(0.01), neo_hookean()).unwrap();
    assert!(matches!(section.with_tolerance(1e-6, &range), Err(Error::Inadmissible { quantity: "J", .. })));
}

/// The degree of a law graded over the section counts its powers of x and y too.
#[test]
fn a_graded_polynomial_law_is_exact_at_its_whole_degree() {
    let law = local!(degree 4; |f, at| {
        let e = f.gamma().z;
        e * e * (at.y * at.x * 2e3 + 1.0) * 5e5
    });
    let section = Section::new(Rectangle::new(0.02, 0.01), law).unwrap();
    let range = StrainRange::default();
    assert!(section.quadrature_report(1e-13, &range).unwrap().reached);
    let short = section.with_degree(2).unwrap().quadrature_report(1e-13, &range).unwrap();
    assert!(!short.reached && short.estimated_error > 1e-4, "{short:?}");
}
