use crate::error::Result;

use super::line::gauss_legendre;
use super::rule::{Rule, check_degree};

/// The square [−1/2, 1/2]², exact to a total degree; [`Rule::scaled`] makes it a rectangle.
///
/// Small rules where one is known with all points inside and positive weights, else the tensor product of two
/// Gauss–Legendre rules, ⌈(d + 1)/2⌉² points.
///
/// | degree | 1 | 2 | 3 | 4 | 5 | 6, 7 | 8, 9 | 10, 11 |
/// |---|---|---|---|---|---|---|---|---|
/// | points | 1 | 3 | 4 | 6 | 7 | 12 | 25 | 36 |
///
/// Degree 2: an equilateral triangle on the circle r² = 1/6, the inertia ellipse's. Degree 4: Wissmann & Becker (1986).
/// Degree 5: Radon (1948). Degree 7: Tyler (1953).
///
/// ```
/// let plank = hyperrod::quadrature::rectangle(2)?.scaled(3.0, 2.0)?;
/// let inertia: f64 = plank.iter().map(|(x, _, w)| w * x * x).sum();
/// assert!((inertia - 2.0 * 27.0 / 12.0).abs() < 1e-14);
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`](crate::Error::Invalid) when the degree is above [`MAX_DEGREE`](super::MAX_DEGREE).
pub fn rectangle(degree: usize) -> Result<Rule> {
    check_degree(degree)?;
    match degree {
        0 | 1 => from_biunit(&[(0.0, 0.0, 4.0)], 1),
        2 => from_biunit(&three_points(), 2),
        4 => from_biunit(&six_points(), 4),
        5 => from_biunit(&seven_points(), 5),
        6 | 7 => from_biunit(&twelve_points(), 7),
        _ => {
            let line = gauss_legendre((degree + 1).div_ceil(2))?;
            let points: Vec<_> =
                line.iter().flat_map(|(x, wx)| line.iter().map(move |(y, wy)| (x, y, wx * wy))).collect();
            from_biunit(&points, line.degree())
        }
    }
}

/// From [−1, 1]², where the sources give their rules, to [−1/2, 1/2]².
fn from_biunit(points: &[(f64, f64, f64)], degree: usize) -> Result<Rule> {
    Rule::from_points(points.iter().map(|&(x, y, w)| (0.5 * x, 0.5 * y, 0.25 * w)), degree)
}

/// Degree 2: the moments of an equilateral triangle inscribed in r² = 2/3.
fn three_points() -> [(f64, f64, f64); 3] {
    let r = (2.0f64 / 3.0).sqrt();
    let (half, side) = (0.5 * r, 0.5f64.sqrt());
    [(0.0, r, 4.0 / 3.0), (side, -half, 4.0 / 3.0), (-side, -half, 4.0 / 3.0)]
}

/// Degree 4, Wissmann & Becker (1986): symmetric in x, a point at the centre. The decimals are the solution of the nine
/// moment equations, by Newton's method with 40 digits.
fn six_points() -> [(f64, f64, f64); 6] {
    const X: [f64; 2] = [0.851_914_653_304_600_5, 0.630_912_788_976_754];
    const Y: [f64; 2] = [0.455_603_727_836_192_84, -0.731_629_951_573_134_5];
    const W: [f64; 2] = [0.566_072_207_007_532_1, 0.642_719_001_783_676_7];
    [
        (0.0, 0.0, 8.0 / 7.0),
        (0.0, (14.0f64 / 15.0).sqrt(), 40.0 / 91.0),
        (X[0], Y[0], W[0]),
        (-X[0], Y[0], W[0]),
        (X[1], Y[1], W[1]),
        (-X[1], Y[1], W[1]),
    ]
}

/// Degree 5, Radon (1948).
fn seven_points() -> [(f64, f64, f64); 7] {
    let far = (14.0f64 / 15.0).sqrt();
    let (x, y) = (0.6f64.sqrt(), (1.0f64 / 3.0).sqrt());
    let (axis, corner) = (20.0 / 63.0, 5.0 / 9.0);
    [
        (0.0, 0.0, 8.0 / 7.0),
        (0.0, far, axis),
        (0.0, -far, axis),
        (x, y, corner),
        (-x, y, corner),
        (x, -y, corner),
        (-x, -y, corner),
    ]
}

/// Degree 7, Tyler (1953).
fn twelve_points() -> Vec<(f64, f64, f64)> {
    let (far, root) = ((6.0f64 / 7.0).sqrt(), 583f64.sqrt());
    let axis = 98.0 / 405.0;
    let mut points = vec![(far, 0.0, axis), (-far, 0.0, axis), (0.0, far, axis), (0.0, -far, axis)];
    for sign in [-1.0, 1.0] {
        let a = ((114.0 + sign * 3.0 * root) / 287.0).sqrt();
        let w = 307.0 / 810.0 - sign * 923.0 / (270.0 * root);
        points.extend([(a, a, w), (-a, a, w), (a, -a, w), (-a, -a, w)]);
    }
    points
}
