use crate::error::{Error, Result};

use super::compress::compress;

/// The largest degree a planar rule can be asked for: 200, some 10⁴ points, where a section is better cut into pieces.
pub const MAX_DEGREE: usize = 200;

/// A planar quadrature rule: points, positive weights, and the total degree to which it is exact.
///
/// ```math
/// \int f \, \mathrm{d}A \approx \sum_i w_i \, f(x_i, y_i)
/// ```
///
/// ```
/// let square = hyperrod::quadrature::rectangle(2)?;
/// let inertia: f64 = square.iter().map(|(_, y, w)| w * y * y).sum();
/// assert!((inertia - 1.0 / 12.0).abs() < 1e-16);
/// # Ok::<(), hyperrod::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Rule {
    x: Vec<f64>,
    y: Vec<f64>,
    weights: Vec<f64>,
    degree: usize,
}

impl Rule {
    /// A rule of your own, for instance from a mesh: points, weights, and the degree it is exact to.
    ///
    /// The degree is taken on trust, the rest is checked.
    ///
    /// # Errors
    /// [`Error::Invalid`] when there are no points, the lengths differ, a coordinate is not finite, or a weight is
    /// not positive and finite.
    pub fn new(x: Vec<f64>, y: Vec<f64>, weights: Vec<f64>, degree: usize) -> Result<Self> {
        if x.is_empty() {
            return Err(invalid("number of quadrature points", 0.0, "at least 1"));
        }
        for (quantity, length) in
            [("number of quadrature ordinates y", y.len()), ("number of quadrature weights", weights.len())]
        {
            if length != x.len() {
                return Err(invalid(quantity, length as f64, "the number of abscissae x"));
            }
        }
        if let Some(&value) = x.iter().chain(&y).find(|c| !c.is_finite()) {
            return Err(invalid("quadrature point coordinate", value, "finite"));
        }
        if let Some(&value) = weights.iter().find(|w| !(**w > 0.0 && w.is_finite())) {
            return Err(invalid("quadrature weight", value, "positive and finite"));
        }
        Ok(Self { x, y, weights, degree })
    }

    /// As [`Rule::new`], from (x, y, weight) triples.
    pub(super) fn from_points(
        points: impl IntoIterator<Item = (f64, f64, f64)>,
        degree: usize,
    ) -> Result<Self> {
        let (mut x, mut y, mut weights) = (Vec::new(), Vec::new(), Vec::new());
        for (xi, yi, wi) in points {
            x.push(xi);
            y.push(yi);
            weights.push(wi);
        }
        Self::new(x, y, weights, degree)
    }

    /// First coordinates.
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Second coordinates.
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// Weights, all positive; their sum is the [`area`](Self::area).
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The total degree of the polynomials the rule integrates exactly.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of points, at least one.
    #[allow(clippy::len_without_is_empty)] // a rule is never empty
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// The sum of the weights.
    pub fn area(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// The points and weights (x, y, w) in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (f64, f64, f64)> + '_ {
        (0..self.len()).map(|i| (self.x[i], self.y[i], self.weights[i]))
    }

    /// The rule on the shape stretched by `a` along x and `b` along y: an ellipse from [`disk`](super::disk).
    ///
    /// ```
    /// let ellipse = hyperrod::quadrature::disk(4)?.scaled(2.0, 0.5)?;
    /// assert!((ellipse.area() - std::f64::consts::PI).abs() < 1e-15);
    /// # Ok::<(), hyperrod::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] when a factor is zero or not finite.
    pub fn scaled(&self, a: f64, b: f64) -> Result<Self> {
        self.transformed([[a, 0.0], [0.0, b]], [0.0, 0.0])
    }

    /// The rule on the image of the shape under (x, y) ↦ M (x, y) + c, of the same degree.
    ///
    /// ```math
    /// (x_i, y_i) \mapsto M (x_i, y_i) + c, \qquad w_i \mapsto |\det M| \, w_i
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] when M is singular or a number is not finite.
    pub fn transformed(&self, matrix: [[f64; 2]; 2], shift: [f64; 2]) -> Result<Self> {
        let [[a, b], [c, d]] = matrix;
        let det = (a * d - b * c).abs();
        if !(det > 0.0 && det.is_finite()) {
            return Err(invalid("determinant of a map of a quadrature rule", det, "finite and not zero"));
        }
        let points =
            self.iter().map(|(x, y, w)| (a * x + b * y + shift[0], c * x + d * y + shift[1], det * w));
        Self::from_points(points, self.degree)
    }

    /// A rule on at most (d+1)(d+2)/2 of these points, with positive weights and the same moments up to degree d.
    ///
    /// The moments are those of this rule, whether or not it is exact to degree d; the result states the smaller of
    /// both degrees. A rule that is small enough comes back as it is.
    ///
    /// Method: Tchakaloff's theorem made constructive, as in Litterer & Lyons (2012), "High order recombination and
    /// an application to cubature on Wiener space", with an orthonormal null space kept by reflections.
    ///
    /// ```
    /// use hyperrod::quadrature::{rectangle, Rule};
    ///
    /// let fine = rectangle(40)?; // 441 points
    /// let few = fine.compressed(3)?;
    /// assert!(few.len() <= 10);
    /// assert!((few.area() - 1.0).abs() < 1e-15);
    /// # Ok::<(), hyperrod::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] when d is above [`MAX_COMPRESSED_DEGREE`](super::MAX_COMPRESSED_DEGREE).
    pub fn compressed(&self, degree: usize) -> Result<Self> {
        compress(self, degree)
    }
}

/// `Err` for a degree above [`MAX_DEGREE`].
pub(super) fn check_degree(degree: usize) -> Result<()> {
    if degree > MAX_DEGREE {
        return Err(invalid("quadrature degree", degree as f64, "at most 200"));
    }
    Ok(())
}

/// Shorthand for [`Error::Invalid`].
pub(super) fn invalid(quantity: &'static str, value: f64, requirement: &'static str) -> Error {
    Error::Invalid { quantity, value, requirement }
}
