//! What is no section is refused by name.

use hyperrod::error::PolygonError;
use hyperrod::material::{LinearElastic, MooneyRivlin, NeoHookean, Station};
use hyperrod::quadrature::Rule;
use hyperrod::section::*;
use hyperrod::{Body, Error, Strain, Twist};
use num_dual::Dual64;

fn law() -> LinearElastic {
    LinearElastic::new(1e6, 3e5).unwrap()
}

#[test]
fn polygons_that_bound_nothing() {
    let polygon = |v: &[[f64; 2]]| Polygon::new(v.to_vec());
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let bow_tie = polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
    assert!(
        matches!(bow_tie, Err(Error::Polygon(PolygonError::SelfIntersection { ring: 0, .. }))),
        "{bow_tie:?}"
    );
    let outside = Polygon::new(square.clone()).unwrap().with_hole(vec![[2.0, 2.0], [3.0, 2.0], [2.0, 3.0]]);
    assert!(matches!(outside, Err(Error::Polygon(PolygonError::HoleOutside { ring: 1, .. }))), "{outside:?}");
    let across = Polygon::new(square).unwrap().with_hole(vec![[0.5, 0.5], [1.5, 0.5], [0.5, 0.8]]);
    assert!(matches!(across, Err(Error::Polygon(PolygonError::RingsCross { ring: 1, .. }))), "{across:?}");
    let flat = polygon(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]);
    assert!(matches!(flat, Err(Error::Polygon(PolygonError::ZeroArea { ring: 0 }))), "{flat:?}");
    let two = polygon(&[[0.0, 0.0], [1.0, 1.0]]);
    assert!(
        matches!(two, Err(Error::Polygon(PolygonError::TooFewVertices { ring: 0, count: 2 }))),
        "{two:?}"
    );
    let nan = polygon(&[[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]]);
    assert!(
        matches!(nan, Err(Error::Polygon(PolygonError::NotFinite { ring: 0, vertex: 1, .. }))),
        "{nan:?}"
    );
}

/// The quantity an error names.
fn named<T>(result: Result<T, Error>) -> &'static str {
    match result.err() {
        Some(Error::Invalid { quantity, .. } | Error::InvalidAt { quantity, .. }) => quantity,
        other => panic!("{other:?}"),
    }
}

#[test]
fn sizes_that_are_not_positive() {
    let named_in = |shape: Box<dyn Shape>| named(Section::new(shape, law()));
    for bad in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        assert_eq!(named_in(Box::new(Circle::new(bad))), "radius of the circle");
        assert_eq!(named_in(Box::new(Ellipse::new(bad, 1.0))), "semi-axis a of the ellipse");
        assert_eq!(named_in(Box::new(Ellipse::new(1.0, bad))), "semi-axis b of the ellipse");
        assert_eq!(named_in(Box::new(Annulus::new(0.0, bad))), "outer radius of the annulus");
        assert_eq!(named_in(Box::new(Circle::new(1.0).scaled(bad))), "scale factor of the section");
        let hexagon = RegularPolygon::new(6, bad).unwrap();
        assert_eq!(named_in(Box::new(hexagon)), "circumradius of the regular polygon");
    }
    assert_eq!(named_in(Box::new(Annulus::new(-1e-3, 1.0))), "inner radius of the annulus");
    assert_eq!(named_in(Box::new(Annulus::new(f64::NAN, 1.0))), "inner radius of the annulus");
    assert_eq!(named_in(Box::new(Annulus::new(1.0, 1.0))), "wall thickness of the annulus");
    assert_eq!(named_in(Box::new(Circle::new(1.0).rotated(f64::NAN))), "angle of the section");
    assert_eq!(
        named_in(Box::new(Circle::new(1.0).shifted(f64::INFINITY, 0.0))),
        "shift of the section along x"
    );
    assert_eq!(named_in(Box::new(Circle::new(1.0).shifted(0.0, f64::NAN))), "shift of the section along y");
    assert_eq!(named(RegularPolygon::new(2, 1.0)), "number of sides of a regular polygon");
    assert_eq!(named(RegularPolygon::new(1001, 1.0)), "number of sides of a regular polygon");
}

#[test]
fn a_taper_that_closes_is_refused_where_it_does() {
    let tube = Annulus::new(|s: Dual64| s * 0.1, 0.01);
    let section = Section::new(tube, law()).unwrap();
    assert!(section.wrench(&Station::straight(0.09), &Strain::zero()).is_ok());
    match section.wrench(&Station::straight(0.11), &Strain::zero()) {
        Err(Error::InvalidAt { quantity: "wall thickness of the annulus", value, s: 0.11, .. }) => {
            assert!((value + 0.001).abs() < 1e-15);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn points_of_a_lower_degree_than_the_law_needs() {
    let rule = |degree| Rule::new(vec![0.0, 0.01], vec![0.0, 0.0], vec![1e-6; 2], degree).unwrap();
    let asked = "degree asked of a section given by points";
    let law = MooneyRivlin::new(1e5, 1e4).unwrap();
    assert_eq!(named(Section::new(PointCloud::new(rule(1)), law)), asked);
    let section = Section::new(PointCloud::new(rule(2)), law).unwrap();
    assert_eq!(named(section.with_degree(3)), asked);
    // a law that is no polynomial takes what there is
    let soft = Section::new(PointCloud::new(rule(5)), NeoHookean::new(1e5, 1e5).unwrap()).unwrap();
    assert_eq!((soft.degree(), soft.point_count()), (5, 2));
    // and about a curved reference all the points are the best there is
    let ring = Twist::from_array([0.0, 30.0, 0.0, 0.0, 0.0, 1.0]);
    let curved = Body::new(1.0, soft).unwrap().with_reference_strain(ring).unwrap();
    assert_eq!(curved.section().degree(), 5);
}

#[test]
fn references_that_are_none() {
    let body = || Body::new(1.0, Section::new(Circle::new(0.01), law()).unwrap()).unwrap();
    let flat = Twist::from_array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(named(body().with_reference_strain(flat)), "nu_z of the reference strain");
    let vanishing = body().with_varying_reference(|s: Dual64| {
        let o = Dual64::from_re(0.0);
        Twist::from_array([o, o, o, o, o, -s * 1.5 + 1.0])
    });
    assert_eq!(named(vanishing), "nu_z of the reference strain");
}

#[test]
fn tolerances_ranges_and_densities() {
    let section = || Section::new(Circle::new(0.01), law()).unwrap();
    assert_eq!(named(section().with_tolerance(0.0, &StrainRange::default())), "quadrature tolerance");
    let range = StrainRange { axial: -0.1, ..Default::default() };
    assert_eq!(named(section().with_tolerance(1e-6, &range)), "axial strain of a range");
    let composite = Composite::new(section()).with_relative_density(section(), -1.0);
    assert_eq!(named(composite), "relative density of a part");
}
