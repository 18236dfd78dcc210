//! The quadrature layer against exact integrals: every monomial on every shape.

mod line;
mod polygon;
mod shapes;

use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::LazyLock;

use hyperrod::quadrature::{
    MAX_COMPRESSED_DEGREE, MAX_DEGREE, MAX_NODES, Polygon, Rule, annulus, disk, gauss_legendre, rectangle,
    triangle,
};
use hyperrod::{Error, Result};
use shapes::{Shape, polygons, shapes};

/// The rules of degree 0 to 20 of every shape, computed once for all tests.
static RULES: LazyLock<HashMap<&str, Vec<Rule>>> = LazyLock::new(|| {
    let rules = |shape: &Shape| {
        (0..=20)
            .map(|degree| (shape.rule)(degree).unwrap_or_else(|e| panic!("{}: {e}", shape.name)))
            .collect()
    };
    shapes().iter().map(|shape| (shape.name, rules(shape))).collect()
});

fn integral(rule: &Rule, a: u32, b: u32) -> f64 {
    rule.iter().map(|(x, y, w)| w * x.powi(a as i32) * y.powi(b as i32)).sum()
}

/// The largest error among monomials of one degree, relative to the area (all shapes fit in |x|, |y| ≤ 1).
fn error(rule: &Rule, moment: &dyn Fn(u32, u32) -> f64, degree: u32) -> f64 {
    let one = |a| (integral(rule, a, degree - a) - moment(a, degree - a)).abs();
    (0..=degree).map(one).fold(0.0, f64::max) / moment(0, 0)
}

/// A term w x^a y^b with rounded x, y, w is off by at most 2(a + b + 1) units of ε/2 = 1.1e-16 of itself, and |x|, |y| ≤ 1;
/// sums of up to 253 terms of varying sign, the moments kept by compression, and the exact value each add a few ε of
/// the area.
fn tolerance(degree: u32) -> f64 {
    f64::from(degree + 16) * f64::EPSILON
}

#[test]
fn rules_are_exact_for_every_monomial_up_to_their_degree() {
    for shape in shapes() {
        let mut worst = 0.0f64;
        for degree in 0..=20 {
            let rule = &RULES[shape.name][degree];
            assert!(rule.degree() >= degree);
            for k in 0..=rule.degree() as u32 {
                let error = error(rule, &shape.moment, k);
                worst = worst.max(error);
                assert!(
                    error <= tolerance(k),
                    "{} of degree {degree}: error {error:e} at degree {k}",
                    shape.name
                );
            }
        }
        println!("{}: worst moment error {worst:.1e}", shape.name);
    }
}

/// Otherwise the test of exactness could not fail. The smallest error there is, x^22 under 11 Gauss points, is 3e-13.
#[test]
fn rules_are_not_exact_beyond_their_degree() {
    for shape in shapes().iter().filter(|s| s.name != "tilted plank") {
        for degree in 0..=20 {
            let rule = &RULES[shape.name][degree];
            let beyond = rule.degree() as u32 + 1;
            let error = error(rule, &shape.moment, beyond).max(error(rule, &shape.moment, beyond + 1));
            assert!(error > 10.0 * tolerance(beyond), "{} of degree {degree}: {error:e}", shape.name);
        }
    }
}

#[test]
fn points_are_strictly_inside_and_weights_positive() {
    for shape in shapes() {
        for degree in 0..=20 {
            for (x, y, w) in RULES[shape.name][degree].iter() {
                assert!(w > 0.0, "{} of degree {degree}: weight {w}", shape.name);
                assert!((shape.inside)(x, y), "{} of degree {degree}: ({x}, {y})", shape.name);
            }
        }
    }
}

#[test]
fn rules_have_no_more_points_than_moments_and_far_fewer_at_low_degree() {
    for shape in shapes() {
        let counts: Vec<usize> = (1..=20).map(|d| RULES[shape.name][d].len()).collect();
        println!("{:24} {counts:?}", shape.name);
        for (i, count) in counts.iter().enumerate() {
            assert!(*count <= (i + 2) * (i + 3) / 2, "{} of degree {}: {count}", shape.name, i + 1);
        }
    }
    for (rule, counts) in [
        (disk as fn(usize) -> Result<Rule>, [1, 3, 4, 6, 7, 12, 12]),
        (rectangle, [1, 3, 4, 6, 7, 12, 12]),
        (triangle, [1, 3, 6, 6, 7, 16, 16]),
    ] {
        assert_eq!([1, 2, 3, 4, 5, 6, 7].map(|d| rule(d).unwrap().len()), counts);
    }
    for shape in polygons() {
        assert!(RULES[shape.name][2].len() <= 4, "{}", shape.name);
        assert!(RULES[shape.name][4].len() <= 8, "{}", shape.name);
    }
}

/// Sums over up to 5000 points are themselves off by some √5000/2 units of rounding.
#[test]
fn polygons_above_the_compressed_degrees_are_exact_too() {
    for shape in polygons() {
        for degree in [MAX_COMPRESSED_DEGREE + 1, 31] {
            let rule = (shape.rule)(degree).unwrap();
            for k in 0..=degree as u32 {
                let error = error(&rule, &shape.moment, k);
                assert!(
                    error <= tolerance(k) + 35.0 * f64::EPSILON,
                    "{} of degree {degree}: error {error:e} at degree {k}",
                    shape.name
                );
            }
        }
    }
}

/// Moments of the slender direction must hold relative to themselves: they are the weak bending stiffness.
#[test]
fn a_slender_tilted_polygon_keeps_its_weak_moment() {
    let (c, s) = (0.6, 0.8);
    let (length, thickness) = (1.0, 1e-4);
    let turn = |u: f64, v: f64| [c * u - s * v, s * u + c * v];
    let (h, t) = (0.5 * length, 0.5 * thickness);
    let plank = Polygon::new(vec![turn(-h, -t), turn(h, -t), turn(h, t), turn(-h, t)]).unwrap();
    for degree in [2, 4, 8, 12] {
        let rule = plank.rule(degree).unwrap();
        let weak: f64 = rule.iter().map(|(x, y, w)| w * (c * y - s * x).powi(2)).sum();
        let exact = length * thickness.powi(3) / 12.0;
        // the corners are rounded to ε of the length, that is ε·length/thickness = 2e-12 of the thickness
        assert!((weak / exact - 1.0).abs() < 1e-11, "degree {degree}: {weak:e} instead of {exact:e}");
    }
}

#[test]
fn compression_keeps_the_moments_of_a_rule_of_thousands_of_points() {
    let fine = rectangle(99).unwrap().scaled(2.0, 2.0).unwrap();
    assert_eq!(fine.len(), 2500);
    for degree in [0, 1, 2, 5, 10, 14] {
        let few = fine.compressed(degree).unwrap();
        assert!(few.len() <= (degree + 1) * (degree + 2) / 2);
        assert_eq!(few.degree(), degree);
        assert_eq!(few, fine.compressed(degree).unwrap(), "not deterministic");
        let points: Vec<_> = fine.iter().map(|(x, y, _)| (x, y)).collect();
        assert!(few.iter().all(|(x, y, w)| w > 0.0 && points.contains(&(x, y))));
        let exact = |a: u32, b: u32| integral(&fine, a, b);
        // the sums over 2500 points are themselves off by some √2500/2 units of rounding
        (0..=degree as u32)
            .for_each(|k| assert!(error(&few, &exact, k) < tolerance(k) + 25.0 * f64::EPSILON));
    }
}

#[test]
fn points_on_a_line_compress_although_the_monomials_are_dependent() {
    let x: Vec<f64> = (0..200).map(|i| f64::from(i) / 200.0).collect();
    let line = Rule::new(x.clone(), x, vec![0.005; 200], 200).unwrap();
    let few = line.compressed(4).unwrap();
    assert!(few.len() <= 15);
    for k in 0..=4 {
        assert!(error(&few, &|a, b| integral(&line, a, b), k) < tolerance(k));
    }
}

#[test]
fn annulus_points_follow_the_radii_smoothly() {
    let rule = annulus(6).unwrap();
    let (inner, outer) = (0.3, 0.9);
    let fixed = rule.at(inner, outer).unwrap();
    for (p, (x, y, w)) in rule.points().iter().zip(fixed.iter()) {
        let ring = outer * outer - inner * inner;
        let r = (inner * inner + p.t * ring).sqrt();
        // three or four roundings
        assert!(
            (x - r * p.cos).abs() < 1e-15
                && (y - r * p.sin).abs() < 1e-15
                && (w - ring * p.weight).abs() < 1e-15
        );
        assert!(0.0 < p.t && p.t < 1.0);
    }
    let thin = annulus(2).unwrap().at(1.0 - 1e-9, 1.0).unwrap();
    let exact = PI * ((1.0 - (1.0 - 1e-9)) * (1.0 + (1.0 - 1e-9)));
    assert!((thin.area() / exact - 1.0).abs() < 1e-15);
}

#[test]
fn bad_numbers_are_named() {
    let named = |result: Result<Rule>, what: &str, number: f64| match result {
        Err(Error::Invalid { quantity, value, .. }) => {
            assert_eq!(quantity, what);
            assert!(value == number || (value.is_nan() && number.is_nan()));
        }
        other => panic!("{other:?}"),
    };
    for rule in [disk as fn(usize) -> Result<Rule>, rectangle, triangle] {
        assert!(rule(MAX_DEGREE).is_ok());
        named(rule(MAX_DEGREE + 1), "quadrature degree", 201.0);
    }
    named(annulus(usize::MAX).and_then(|a| a.at(0.5, 1.0)), "quadrature degree", usize::MAX as f64);
    named(annulus(2).unwrap().at(-0.5, 1.0), "inner radius", -0.5);
    named(annulus(2).unwrap().at(0.5, 0.5), "outer radius", 0.5);
    named(annulus(2).unwrap().at(0.5, f64::NAN), "outer radius", f64::NAN);
    named(
        disk(2).unwrap().compressed(MAX_COMPRESSED_DEGREE + 1),
        "degree of a compressed quadrature rule",
        25.0,
    );
    named(disk(2).unwrap().scaled(0.0, 1.0), "determinant of a map of a quadrature rule", 0.0);
    named(Rule::new(vec![], vec![], vec![], 1), "number of quadrature points", 0.0);
    named(Rule::new(vec![0.0], vec![], vec![1.0], 1), "number of quadrature ordinates y", 0.0);
    named(Rule::new(vec![0.0], vec![0.0], vec![1.0, 1.0], 1), "number of quadrature weights", 2.0);
    named(Rule::new(vec![0.0], vec![0.0], vec![-1.0], 1), "quadrature weight", -1.0);
    named(Rule::new(vec![f64::NAN], vec![0.0], vec![1.0], 1), "quadrature point coordinate", f64::NAN);
    for n in [0, MAX_NODES + 1] {
        assert!(matches!(gauss_legendre(n), Err(Error::Invalid { value, .. }) if value == n as f64));
    }
    assert!(matches!(gauss_legendre(2).unwrap().on(1.0, 1.0), Err(Error::Invalid { .. })));
    assert!(polygons()[0].rule.as_ref()(MAX_DEGREE + 1).is_err());
    assert!(polygons()[0].rule.as_ref()(MAX_COMPRESSED_DEGREE + 1).is_ok());
}
