//! Folds, snap-back and branches of small problems with known answers.

use nalgebra::{DMatrix, DVector};

use super::*;
use crate::error::{Error, Result};

type Point = DVector<f64>;

/// r, ∂r/∂λ and K, the gradient of an energy and its Hessian.
type Gradient = fn(&Point, f64) -> (Point, Point, DMatrix<f64>);

struct Potential(Gradient);

impl Family for Potential {
    type State = Point;
    type Step = Point;

    fn tangents(&mut self, state: &Point, factor: f64) -> Result<Tangents<Point>> {
        let (r, r_factor, k) = self.0(state, factor);
        let lu = k.lu();
        let singular = Error::Singular { matrix: "Hessian", s: 0.0 };
        let correction = lu.solve(&-r).ok_or(singular.clone())?;
        Ok(Tangents { correction, per_factor: lu.solve(&-r_factor).ok_or(singular)? })
    }

    fn moved(&self, state: &Point, step: &Point) -> Point {
        state + step
    }

    fn combined(&self, a: f64, x: &Point, b: f64, y: &Point) -> Point {
        x * a + y * b
    }

    fn product(&self, x: &Point, y: &Point) -> f64 {
        x.dot(y)
    }

    fn index(&mut self, state: &Point, factor: f64) -> Option<usize> {
        let eigen = self.0(state, factor).2.symmetric_eigenvalues();
        Some(eigen.iter().filter(|&&value| value < 0.0).count())
    }
}

fn at(x: &[f64]) -> Point {
    Point::from_column_slice(x)
}

/// x³ − x = λ.
fn cubic(x: &Point, factor: f64) -> (Point, Point, DMatrix<f64>) {
    let x = x[0];
    (at(&[x * x * x - x - factor]), at(&[-1.0]), DMatrix::from_element(1, 1, 3.0 * x * x - 1.0))
}

fn events<S>(traced: &Traced<S>, kind: EventKind) -> Vec<&Event<S>> {
    traced.events.iter().filter(|event| event.kind == kind).collect()
}

#[test]
fn a_path_snaps_through_both_limit_points_of_a_cubic() {
    let stride = Stride { factors: [-10.0, 2.0], ..Stride::default() };
    let start = -1.324_717_957_244_746; // x³ − x = −1
    let traced = trace(&mut Potential(cubic), at(&[start]), -1.0, &stride, |_| false).unwrap();
    let limits = events(&traced, EventKind::LimitPoint);
    let [first, second] = limits[..] else { panic!("{} limit points", limits.len()) };
    // the factor is stationary there: the slope of 1e-7 at which the search may end is 1e-14 in λ, rounding the rest
    let exact = 2.0 / (3.0 * 3.0_f64.sqrt());
    assert!((first.point.factor - exact).abs() < 1e-11 && (second.point.factor + exact).abs() < 1e-11);
    assert!(events(&traced, EventKind::Bifurcation).is_empty());
    assert_eq!(traced.end, End::Factor);
    let last = traced.points.last().unwrap();
    assert!(last.factor == 2.0 && (last.state[0] - 1.5213797068045676).abs() < 1e-12);
    for point in &traced.points {
        let unstable = usize::from(point.state[0].abs() < 1.0 / 3.0_f64.sqrt());
        assert_eq!(point.index, Some(unstable));
    }
}

/// The same bar behind a spring that is softer than it: pulled at the end of the spring, y − x = 4 (λ − …) snaps back.
fn snap_back(x: &Point, factor: f64) -> (Point, Point, DMatrix<f64>) {
    // energy x⁴/4 − x²/2 + ½ k (y − x)², y prescribed through a stiff machine ½ c (y − λ)²
    let (k, c, x, y) = (0.4, 50.0, x[0], x[1]);
    let r = at(&[x * x * x - x - k * (y - x), k * (y - x) + c * (y - factor)]);
    let stiffness = DMatrix::from_row_slice(2, 2, &[3.0 * x * x - 1.0 + k, -k, -k, k + c]);
    (r, at(&[0.0, -c]), stiffness)
}

#[test]
fn a_path_follows_snap_back_where_load_and_displacement_both_turn() {
    let (k, c) = (0.4, 50.0);
    let x0 = -1.5_f64;
    let y0 = x0 + (x0.powi(3) - x0) / k;
    let factor = y0 + k * (y0 - x0) / c;
    let stride = Stride { factors: [-1e3, -factor], longest: 0.2, ..Stride::default() };
    let traced = trace(&mut Potential(snap_back), at(&[x0, y0]), factor, &stride, |_| false).unwrap();
    // dλ/dx = 0: with y = x + (x³ − x)/k and λ = y + (x³ − x)/c, 1 + (3x² − 1)(1/k + 1/c) = 0
    let x = ((1.0 - 1.0 / (1.0 / k + 1.0 / c)) / 3.0_f64).sqrt();
    let limits = events(&traced, EventKind::LimitPoint);
    assert_eq!(limits.len(), 2);
    assert!((limits[0].point.state[0] + x).abs() < 1e-6 && (limits[1].point.state[0] - x).abs() < 1e-6);
    let last = traced.points.last().unwrap();
    assert!((last.state[0] + x0).abs() < 1e-10 && traced.end == End::Factor);
}

/// ½(x − λ)² + ½(1 − x)(y² + z²) + ¼(y⁴ + z⁴) + y²z²: at λ = 1 a square column buckles in two ways at once.
fn square_column(p: &Point, factor: f64) -> (Point, Point, DMatrix<f64>) {
    let (x, y, z) = (p[0], p[1], p[2]);
    let (yy, zz) = (y * y, z * z);
    let r = at(&[x - factor - 0.5 * (yy + zz), (1.0 - x + yy + 2.0 * zz) * y, (1.0 - x + zz + 2.0 * yy) * z]);
    let (k_y, k_z) = (1.0 - x + 3.0 * yy + 2.0 * zz, 1.0 - x + 3.0 * zz + 2.0 * yy);
    let k = DMatrix::from_row_slice(3, 3, &[1.0, -y, -z, -y, k_y, 4.0 * y * z, -z, 4.0 * y * z, k_z]);
    (r, at(&[-1.0, 0.0, 0.0]), k)
}

#[test]
fn a_double_bifurcation_is_found_and_its_branch_followed() {
    let mut family = Potential(square_column);
    let stride = Stride { factors: [-1.0, 1.5], ..Stride::default() };
    let traced = trace(&mut family, at(&[0.0, 0.0, 0.0]), 0.0, &stride, |_| false).unwrap();
    let found = events(&traced, EventKind::Bifurcation);
    let [bifurcation] = found[..] else { panic!("{} bifurcations", found.len()) };
    // bisection to 1e-13 of a step of one half
    assert!((bifurcation.point.factor - 1.0).abs() < 1e-12);
    assert_eq!(traced.points.last().unwrap().index, Some(2));

    let mode = at(&[0.0, 1.0, 0.1]);
    let branch = trace_branch(&mut family, &bifurcation.point, &mode, &stride, |_| false).unwrap();
    let last = branch.points.last().unwrap();
    // x = 1 + y², x − λ = y²/2: y² = 2 (λ − 1); the last point is solved to rounding
    assert!((last.state[1] - 1.0).abs() < 1e-12 && last.state[2].abs() < 1e-12, "{}", last.state);
    assert_eq!((last.index, branch.end), (Some(0), End::Factor));
}

#[test]
fn a_walk_that_cannot_go_on_says_so() {
    // x = λ, and no state beyond x = 1
    fn wall(x: &Point, factor: f64) -> (Point, Point, DMatrix<f64>) {
        let residual = if x[0] > 1.0 { f64::NAN } else { x[0] - factor };
        (at(&[residual]), at(&[-1.0]), DMatrix::from_element(1, 1, 1.0))
    }
    let stride = Stride { factors: [-0.5, 2.0], ..Stride::default() };
    let traced = trace(&mut Potential(wall), at(&[0.6]), 0.6, &stride, |_| false).unwrap();
    assert!(matches!(traced.end, End::Stuck(Error::NoConvergence { .. })), "{:?}", traced.end);
    // the last step is at most twice the shortest
    let last = traced.points.last().unwrap();
    assert!(last.factor <= 1.0 && last.factor > 1.0 - 1e-6, "{}", last.factor);
}
