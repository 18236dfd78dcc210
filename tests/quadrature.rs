//! The quadrature layer against exact integrals: closed forms on disks and squares, Green's theorem on polygons, and
//! 25-digit Gauss–Legendre nodes from mpmath.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::LazyLock;

use hyperrod::error::PolygonError;
use hyperrod::quadrature::{
    MAX_COMPRESSED_DEGREE, MAX_DEGREE, MAX_NODES, Polygon, Rule, annulus, disk, gauss_legendre, rectangle,
    triangle,
};
use hyperrod::{Error, Result};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

type Ring = Vec<[f64; 2]>;

/// A shape of size 1: its rule of a degree, its exact moments ∫ x^a y^b dA, and whether a point is strictly inside.
struct Shape {
    name: &'static str,
    rule: Box<dyn Fn(usize) -> Result<Rule>>,
    moment: Box<dyn Fn(u32, u32) -> f64>,
    inside: Box<dyn Fn(f64, f64) -> bool>,
}

fn double_factorial(n: u32) -> f64 {
    (1..=n).rev().step_by(2).map(f64::from).product()
}

/// ∫ x^a y^b over the annulus ρ < r < 1: ∫ r^(a+b+1) dr ∫ cos^a sin^b dθ.
fn annulus_moment(inner: f64, a: u32, b: u32) -> f64 {
    if a % 2 == 1 || b % 2 == 1 {
        return 0.0;
    }
    let angle = 2.0 * PI * double_factorial(a.saturating_sub(1)) * double_factorial(b.saturating_sub(1))
        / double_factorial(a + b);
    angle * (1.0 - inner.powi((a + b + 2) as i32)) / f64::from(a + b + 2)
}

fn binomial(n: u32, k: u32) -> f64 {
    (0..k).fold(1.0, |c, i| c * f64::from(n - i) / f64::from(i + 1))
}

/// ∫ x^a y^b dA = 1/(a+1) ∮ x^(a+1) y^b dy (Green), each edge in Bernstein form: no cancellation beyond the signs of
/// the coordinates.
fn polygon_moment(rings: &[Ring], a: u32, b: u32) -> f64 {
    let p = a + 1;
    let edge = |[x0, y0]: [f64; 2], [x1, y1]: [f64; 2]| {
        let mut sum = 0.0;
        for i in 0..=p {
            for j in 0..=b {
                let x = binomial(p, i) * x0.powi((p - i) as i32) * x1.powi(i as i32);
                let y = binomial(b, j) * y0.powi((b - j) as i32) * y1.powi(j as i32);
                sum += x * y / (binomial(p + b, i + j) * f64::from(p + b + 1));
            }
        }
        sum * (y1 - y0) / f64::from(p)
    };
    let ring = |r: &Ring| (0..r.len()).map(|i| edge(r[i], r[(i + 1) % r.len()])).sum::<f64>();
    rings
        .iter()
        .enumerate()
        .map(|(k, r)| {
            let area: f64 = (0..r.len())
                .map(|i| {
                    let (p, q) = (r[i], r[(i + 1) % r.len()]);
                    p[0] * q[1] - p[1] * q[0]
                })
                .sum();
            area.signum() * if k == 0 { 1.0 } else { -1.0 } * ring(r)
        })
        .sum()
}

/// Strictly inside: an odd number of edges of all rings to the right, and off every edge.
fn inside_polygon(rings: &[Ring], x: f64, y: f64) -> bool {
    let mut inside = false;
    for ring in rings {
        for i in 0..ring.len() {
            let ([x0, y0], [x1, y1]) = (ring[i], ring[(i + 1) % ring.len()]);
            if (y0 <= y) != (y1 <= y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0) {
                inside = !inside;
            }
            let length = (x1 - x0).hypot(y1 - y0);
            let along = (((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / length.powi(2)).clamp(0.0, 1.0);
            // the edge itself is known to rounding only
            if (x - x0 - along * (x1 - x0)).hypot(y - y0 - along * (y1 - y0)) < 1e-15 {
                return false;
            }
        }
    }
    inside
}

fn polygon(rings: &[Ring]) -> Result<Polygon> {
    rings[1..].iter().try_fold(Polygon::new(rings[0].clone())?, |p, hole| p.with_hole(hole.clone()))
}

fn polygon_shape(name: &'static str, rings: Vec<Ring>) -> Shape {
    let (a, b, c) = (rings.clone(), rings.clone(), rings);
    Shape {
        name,
        rule: Box::new(move |d| polygon(&a)?.rule(d)),
        moment: Box::new(move |p, q| polygon_moment(&b, p, q)),
        inside: Box::new(move |x, y| inside_polygon(&c, x, y)),
    }
}

fn polygons() -> Vec<Shape> {
    let l = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, -0.5], [-0.4, -0.5], [-0.4, 1.0], [-1.0, 1.0]];
    let arrow = vec![[0.0, -0.6], [1.0, -1.0], [0.4, 1.0], [0.0, 0.5], [-0.7, 0.9], [-1.0, -0.8]];
    let hole = vec![[-0.5, -0.4], [-0.3, 0.2], [0.1, -0.1]]; // clockwise
    let slit = vec![[0.3, -0.3], [0.6, -0.5], [0.4, 0.1], [0.2, 0.2]];
    let hexagon = (0..6).map(|k| f64::from(k) * PI / 3.0).map(|t| [t.cos(), t.sin()]).collect();
    let plank = vec![[-0.7, -0.71], [0.71, 0.7], [0.7, 0.71], [-0.71, -0.7]]; // 100:1, tilted
    vec![
        polygon_shape("L", vec![l]),
        polygon_shape("arrow with two holes", vec![arrow, hole, slit]),
        polygon_shape("hexagon", vec![hexagon]),
        polygon_shape("tilted plank", vec![plank]),
    ]
}

fn closed_form_shapes() -> Vec<Shape> {
    let corners = vec![vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]];
    let corners_again = corners.clone();
    vec![
        Shape {
            name: "disk",
            rule: Box::new(disk),
            moment: Box::new(|a, b| annulus_moment(0.0, a, b)),
            inside: Box::new(|x, y| x.hypot(y) < 1.0),
        },
        Shape {
            name: "annulus",
            rule: Box::new(|d| annulus(d)?.at(0.5, 1.0)),
            moment: Box::new(|a, b| annulus_moment(0.5, a, b)),
            inside: Box::new(|x, y| (0.5..1.0).contains(&x.hypot(y)) && x.hypot(y) > 0.5),
        },
        Shape {
            name: "ellipse",
            rule: Box::new(|d| disk(d)?.scaled(1.0, 0.3)),
            moment: Box::new(|a, b| 0.3f64.powi(b as i32 + 1) * annulus_moment(0.0, a, b)),
            inside: Box::new(|x, y| x.hypot(y / 0.3) < 1.0),
        },
        Shape {
            name: "rectangle",
            rule: Box::new(|d| rectangle(d)?.scaled(2.0, 1.0)),
            moment: Box::new(|a, b| {
                let line = |n: u32, h: f64| {
                    if n % 2 == 1 { 0.0 } else { 2.0 * h.powi(n as i32 + 1) / f64::from(n + 1) }
                };
                line(a, 1.0) * line(b, 0.5)
            }),
            inside: Box::new(|x, y| x.abs() < 1.0 && y.abs() < 0.5),
        },
        Shape {
            name: "triangle",
            rule: Box::new(triangle),
            moment: Box::new(move |a, b| polygon_moment(&corners, a, b)),
            inside: Box::new(move |x, y| inside_polygon(&corners_again, x, y)),
        },
    ]
}

fn shapes() -> Vec<Shape> {
    closed_form_shapes().into_iter().chain(polygons()).collect()
}

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
fn gauss_legendre_agrees_with_25_digit_values() {
    let table = include_str!("data/gauss_legendre.txt");
    let mut rows = 0;
    let (mut worst_node, mut worst_weight) = (0.0f64, 0.0f64);
    for line in table.lines().filter(|l| !l.starts_with('#')) {
        let field: Vec<&str> = line.split_whitespace().collect();
        let n: usize = field[0].parse().unwrap();
        let (x, w): (f64, f64) = (field[1].parse().unwrap(), field[2].parse().unwrap());
        let rule = gauss_legendre(n).unwrap();
        let nearest = rule.iter().min_by(|p, q| (p.0 - x).abs().total_cmp(&(q.0 - x).abs())).unwrap();
        worst_node = worst_node.max((nearest.0 - x).abs());
        worst_weight = worst_weight.max((nearest.1 / w - 1.0).abs());
        rows += 1;
    }
    println!("nodes {worst_node:e}, weights {worst_weight:e}");
    assert_eq!(rows, 203);
    // one ulp of 1 for the nodes; the recurrence's n roundings for the weights, mostly cancelling
    assert!(
        worst_node <= f64::EPSILON && worst_weight <= 20.0 * f64::EPSILON,
        "{worst_node:e}, {worst_weight:e}"
    );
}

/// In Legendre polynomials, ∫ P_k = 0 for k ≥ 1: a sharp test to degree 199, where x^198 would hide everything inside.
#[test]
fn gauss_legendre_is_exact_to_degree_2n_minus_1_and_no_further() {
    for n in 1..=100 {
        let rule = gauss_legendre(n).unwrap();
        assert!(rule.nodes().windows(2).all(|x| x[0] < x[1]) && rule.nodes()[0] > -1.0);
        let integral = |k: usize| -> f64 {
            let legendre = |x: f64| {
                (1..k)
                    .fold((1.0, x), |(b, p), j| {
                        (p, ((2 * j + 1) as f64 * x * p - j as f64 * b) / (j + 1) as f64)
                    })
                    .1
            };
            rule.iter().map(|(x, w)| w * legendre(x)).sum()
        };
        assert!((rule.weights().iter().sum::<f64>() - 2.0).abs() < 1e-14);
        for k in 1..2 * n {
            // |P_k| ≤ 1, Σ w = 2, and P_k varies by k²·ε/2 at most over the rounding of a node near the ends, where the
            // weights are of size 1/k²
            assert!(integral(k).abs() < 2e-14, "n = {n}, degree {k}: {:e}", integral(k));
        }
        assert!(integral(2 * n).abs() > 1e-3, "n = {n}");
    }
}

#[test]
fn an_interval_rule_keeps_its_symmetry() {
    for n in [2, 7, 30, MAX_NODES] {
        let rule = gauss_legendre(n).unwrap();
        for i in 0..n {
            assert_eq!(rule.nodes()[i], -rule.nodes()[n - 1 - i]);
            assert_eq!(rule.weights()[i], rule.weights()[n - 1 - i]);
        }
    }
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
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct("tests/quadrature.proptest-regressions"))),
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
