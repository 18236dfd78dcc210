//! Polygons: which are refused and why, and any that are not.

use hyperrod::Error;
use hyperrod::error::PolygonError;
use hyperrod::quadrature::Polygon;
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use std::f64::consts::PI;

use super::shapes::{Ring, inside_polygon, polygon, polygon_moment};
use super::{error, tolerance};

fn square(half: f64, x: f64, y: f64) -> Ring {
    vec![[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]
}

fn polygon_error(rings: &[Ring]) -> PolygonError {
    match polygon(rings) {
        Err(Error::Polygon(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_ring_that_bounds_nothing_is_refused() {
    use PolygonError::*;
    let nan = polygon_error(&[vec![[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]]]);
    assert!(matches!(nan, NotFinite { ring: 0, vertex: 1, y, .. } if y.is_nan()));
    assert_eq!(polygon_error(&[vec![[0.0, 0.0], [1.0, 0.0]]]), TooFewVertices { ring: 0, count: 2 });
    let closed = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
    assert_eq!(polygon_error(&[closed]), RepeatedVertex { ring: 0, first: 0, second: 3 });
    let flat = vec![[0.0, 0.0], [0.1, 0.3], [0.2, 0.6], [0.7, 2.1]];
    assert_eq!(polygon_error(&[flat]), ZeroArea { ring: 0 });
}

#[test]
fn edges_that_cross_touch_or_fold_back_are_named() {
    use PolygonError::SelfIntersection;
    let bow_tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert_eq!(polygon_error(&[bow_tie]), SelfIntersection { ring: 0, first: 0, second: 2 });
    let touching = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert_eq!(polygon_error(&[touching]), SelfIntersection { ring: 0, first: 0, second: 2 });
    let spike = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 0.5], [0.0, 1.0]];
    assert_eq!(polygon_error(&[spike]), SelfIntersection { ring: 0, first: 1, second: 2 });
    let last_spike = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 0.0]];
    assert_eq!(polygon_error(&[last_spike]), SelfIntersection { ring: 0, first: 0, second: 3 });
}

#[test]
fn a_hole_that_crosses_leaves_or_nests_is_refused() {
    use PolygonError::*;
    let outer = square(1.0, 0.0, 0.0);
    assert_eq!(
        polygon_error(&[outer.clone(), square(0.2, 3.0, 0.0)]),
        HoleOutside { ring: 1, x: 2.8, y: -0.2 }
    );
    let around = polygon_error(&[outer.clone(), square(2.0, 0.0, 0.0)]);
    assert!(matches!(around, HoleOutside { ring: 1, .. }));
    let crossing = polygon_error(&[outer.clone(), square(0.5, 0.9, 0.0)]);
    assert_eq!(crossing, RingsCross { ring: 1, edge: 0, other: 0, other_edge: 1 });
    // the same hole clockwise: its edges keep the caller's numbers
    let mut clockwise = square(0.5, 0.9, 0.0);
    clockwise.reverse();
    assert_eq!(
        polygon_error(&[outer.clone(), clockwise]),
        RingsCross { ring: 1, edge: 2, other: 0, other_edge: 1 }
    );
    let touching = polygon_error(&[outer.clone(), vec![[1.0, 0.0], [0.5, 0.2], [0.5, -0.2]]]);
    assert!(matches!(touching, RingsCross { ring: 1, other: 0, other_edge: 1, .. }));
    let overlapping = polygon_error(&[outer.clone(), square(0.3, 0.0, 0.0), square(0.3, 0.2, 0.2)]);
    assert!(matches!(overlapping, RingsCross { ring: 2, other: 1, .. }));
    for (first, second) in [(0.2, 0.5), (0.5, 0.2)] {
        let nested = polygon_error(&[outer.clone(), square(first, 0.0, 0.0), square(second, 0.0, 0.0)]);
        assert_eq!(nested, HolesNested { ring: 2, other: 1 });
    }
    let thin = polygon_error(&[outer, vec![[0.0, 0.0], [0.1, 0.1], [0.2, 0.2]]]);
    assert_eq!(thin, ZeroArea { ring: 1 });
}

#[test]
fn a_polygon_may_have_straight_angles_and_run_either_way() {
    let forward = vec![[-1.0, -1.0], [0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mut backward = forward.clone();
    backward.reverse();
    for ring in [forward, backward] {
        let polygon = Polygon::new(ring).unwrap();
        assert_eq!(polygon.area(), 4.0);
        assert!(polygon.contains(0.0, 0.5) && !polygon.contains(1.5, 0.5));
    }
}

#[test]
fn a_small_polygon_far_from_the_origin_keeps_its_area_and_points() {
    let far: Ring = square(1e-3, 1e3, -2e3);
    let polygon = Polygon::new(far.clone()).unwrap();
    let rule = polygon.rule(4).unwrap();
    // the vertices are rounded to 1e-13 = 1e-10 of the size
    assert!((rule.area() / 4e-6 - 1.0).abs() < 1e-9 && (polygon.area() / 4e-6 - 1.0).abs() < 1e-9);
    assert!(rule.iter().all(|(x, y, _)| inside_polygon(std::slice::from_ref(&far), x, y)));
}

/// Star-shaped about the origin: increasing angles less than π apart, any radii.
fn star() -> impl Strategy<Value = Ring> {
    prop::collection::vec((0.15..1.0f64, -0.3..0.3f64), 3..12).prop_map(|spokes| {
        let n = spokes.len() as f64;
        let place = |(i, (r, jitter)): (usize, (f64, f64))| {
            let angle = 2.0 * PI * (i as f64 + jitter) / n;
            [r * angle.cos(), r * angle.sin()]
        };
        spokes.into_iter().enumerate().map(place).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 64,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct("tests/quadrature/polygon.proptest-regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn star_shaped_polygons_are_integrated_exactly(ring in star(), degree in 0usize..9) {
        let rings = [ring];
        let rule = polygon(&rings).unwrap().rule(degree).unwrap();
        prop_assert!(rule.len() <= (degree + 1) * (degree + 2) / 2);
        for (x, y, w) in rule.iter() {
            prop_assert!(w > 0.0 && inside_polygon(&rings, x, y));
        }
        let moment = |a: u32, b: u32| polygon_moment(&rings, a, b);
        // the exact moments of a sliver are themselves rounded to ε of the unit square, not of its area
        let scale = moment(0, 0).min(1.0);
        for k in 0..=degree as u32 {
            prop_assert!(error(&rule, &moment, k) * scale <= tolerance(k), "{:e}", error(&rule, &moment, k));
        }
    }
}
