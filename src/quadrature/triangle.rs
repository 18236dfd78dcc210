use crate::error::Result;

use super::line::{gauss_jacobi, gauss_legendre};
use super::rule::{Rule, check_degree};

/// The triangle (0,0), (1,0), (0,1), exact to a total degree.
///
/// Up to degree 5 the symmetric rules of 1, 3, 6 and 7 points in closed form: Strang & Fix (1973), Cowper (1973), Radon
/// (1948). Above, the square is collapsed onto the triangle, (x, y) = (t(1 − v), t v) with dA = t dt dv: a Gauss rule
/// for the weight t times a Gauss–Legendre rule, ⌈(d + 1)/2⌉² points (Stroud 1971, section 2.4).
///
/// ```
/// let triangle = hyperrod::quadrature::triangle(3)?;
/// let moment: f64 = triangle.iter().map(|(x, y, w)| w * x * x * y).sum();
/// assert!((moment - 1.0 / 60.0).abs() < 1e-16);
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`](crate::Error::Invalid) when the degree is above [`MAX_DEGREE`](super::MAX_DEGREE).
pub fn triangle(degree: usize) -> Result<Rule> {
    check_degree(degree)?;
    match degree {
        0 | 1 => Rule::from_points([(1.0 / 3.0, 1.0 / 3.0, 0.5)], 1),
        2 => Rule::from_points(orbit(1.0 / 6.0, 1.0 / 6.0), 2),
        3 | 4 => Rule::from_points(six_points(), 4),
        5 => Rule::from_points(seven_points(), 5),
        _ => {
            let n = (degree + 1).div_ceil(2);
            let (along, across) = (gauss_jacobi(n)?, gauss_legendre(n)?.on(0.0, 1.0)?);
            let points = along
                .iter()
                .flat_map(|(t, wt)| across.iter().map(move |(v, wv)| (t * (1.0 - v), t * v, wt * wv)));
            Rule::from_points(points.collect::<Vec<_>>(), 2 * n - 1)
        }
    }
}

/// The three points with two barycentric coordinates equal to a.
fn orbit(a: f64, weight: f64) -> [(f64, f64, f64); 3] {
    let b = 1.0 - 2.0 * a;
    [(a, a, weight), (a, b, weight), (b, a, weight)]
}

/// Degree 4: two orbits, Cowper (1973).
fn six_points() -> Vec<(f64, f64, f64)> {
    let ten = 10f64.sqrt();
    let inner = (38.0 - 44.0 * 0.4f64.sqrt()).sqrt();
    let weight = (213125.0 - 53320.0 * ten).sqrt();
    [1.0, -1.0]
        .into_iter()
        .flat_map(|sign| orbit((8.0 - ten + sign * inner) / 18.0, (620.0 + sign * weight) / 7440.0))
        .collect()
}

/// Degree 5: the centroid and two orbits, Radon (1948).
fn seven_points() -> Vec<(f64, f64, f64)> {
    let root = 15f64.sqrt();
    let mut points = vec![(1.0 / 3.0, 1.0 / 3.0, 9.0 / 80.0)];
    for sign in [-1.0, 1.0] {
        points.extend(orbit((6.0 + sign * root) / 21.0, (155.0 + sign * root) / 2400.0));
    }
    points
}
