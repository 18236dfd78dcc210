use num_dual::{Dual64, DualStruct};

use crate::error::{Error, Result};
use crate::material::{PointRates, Points};
use crate::quadrature::Rule;

/// A plane shape that may vary along the rod: a quadrature rule on a fixed domain, and where its points lie at s.
pub trait Shape: Send + Sync {
    /// A rule on the fixed domain such that its image integrates polynomials in (x, y) of this degree exactly, at every s.
    ///
    /// # Errors
    /// If the degree is beyond what the shape offers.
    fn rule(&self, degree: usize) -> Result<Rule>;

    /// The rule's points and weights on the section at s, with their derivatives in s where the shape varies.
    ///
    /// # Errors
    /// [`Error::InvalidAt`] where a size is not positive and finite.
    fn place(&self, rule: &Rule, s: f64) -> Result<Points>;

    /// Whether the section is the same at every s.
    fn is_constant(&self) -> bool;
}

/// An affine map of the plane that may vary along s: r = M(s) r̂ + c(s).
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    /// M, by rows.
    pub matrix: [[Dual64; 2]; 2],
    /// c, m.
    pub shift: [Dual64; 2],
}

impl Affine {
    /// Stretches by `a` along x and `b` along y.
    pub fn stretch(a: Dual64, b: Dual64) -> Self {
        let o = Dual64::from_re(0.0);
        Self { matrix: [[a, o], [o, b]], shift: [o, o] }
    }

    /// The image of a rule: points M r̂ + c, weights ŵ det M, and their derivatives if `varying`.
    pub fn place(&self, rule: &Rule, varying: bool) -> Points {
        let [[a, b], [c, d]] = self.matrix;
        let determinant = a * d - b * c;
        let mut points = Points::default();
        let mut rates = PointRates::default();
        for (x, y, w) in rule.iter() {
            let image = [a * x + b * y + self.shift[0], c * x + d * y + self.shift[1], determinant * w];
            points.x.push(image[0].re);
            points.y.push(image[1].re);
            points.weight.push(image[2].re);
            rates.x.push(image[0].eps);
            rates.y.push(image[1].eps);
            rates.weight.push(image[2].eps);
        }
        points.rates = varying.then_some(rates);
        points
    }
}

/// The arc length as the variable of differentiation.
pub(crate) fn arc_length(s: f64) -> Dual64 {
    Dual64::from_re(s).derivative()
}

/// A size that must be positive and finite, or an error with its name and place.
pub(crate) fn positive_size(quantity: &'static str, value: Dual64, s: f64) -> Result<Dual64> {
    if value.re() > 0.0 && value.re.is_finite() && value.eps.is_finite() {
        return Ok(value);
    }
    let value = if value.eps.is_finite() { value.re } else { value.eps };
    Err(Error::InvalidAt { quantity, value, requirement: "positive and finite, with a finite slope", s })
}
