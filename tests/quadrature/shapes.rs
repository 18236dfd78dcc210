//! Shapes with their exact moments: closed forms on disks and squares, Green's theorem on polygons.

use hyperrod::Result;
use hyperrod::quadrature::{Polygon, Rule, annulus, disk, rectangle, triangle};
use std::f64::consts::PI;

pub type Ring = Vec<[f64; 2]>;

/// A shape of size 1: its rule of a degree, its exact moments ∫ x^a y^b dA, and whether a point is strictly inside.
pub struct Shape {
    pub name: &'static str,
    pub rule: Box<dyn Fn(usize) -> Result<Rule>>,
    pub moment: Box<dyn Fn(u32, u32) -> f64>,
    pub inside: Box<dyn Fn(f64, f64) -> bool>,
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
pub fn polygon_moment(rings: &[Ring], a: u32, b: u32) -> f64 {
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
pub fn inside_polygon(rings: &[Ring], x: f64, y: f64) -> bool {
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

pub fn polygon(rings: &[Ring]) -> Result<Polygon> {
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

pub fn polygons() -> Vec<Shape> {
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

pub fn shapes() -> Vec<Shape> {
    closed_form_shapes().into_iter().chain(polygons()).collect()
}
