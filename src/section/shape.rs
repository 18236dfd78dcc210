use num_dual::{Dual64, DualNum, DualStruct};

use super::placement::{Rotated, Scaled, Shifted};
use super::profile::Profile;
use crate::error::{Error, Result};
use crate::material::{PointRates, Points};
use crate::quadrature::{MAX_DEGREE, Rule};

/// A plane shape that may vary along the rod: a quadrature rule on a fixed domain, and where its points lie at s.
///
/// Any shape can be moved: [`scaled`](Self::scaled), [`rotated`](Self::rotated) and [`shifted`](Self::shifted) act in the order they are
/// written, each by a number or by anything that varies along s.
///
/// ```
/// use hyperrod::section::{Rectangle, Shape};
/// use hyperrod::num_dual::Dual64;
///
/// // a strip beside the axis that winds round it once every 0.2 m
/// let strand = Rectangle::new(4e-3, 1e-3).shifted(5e-3, 0.0).rotated(|s: Dual64| s * (std::f64::consts::TAU / 0.2));
/// assert!(!strand.is_constant());
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a shape of a section",
    label = "a shape is needed here",
    note = "the shape comes first, the law second: `Section::new(Circle::new(radius), law)?`"
)]
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

    /// The largest degree [`rule`](Self::rule) offers.
    fn max_degree(&self) -> usize {
        MAX_DEGREE
    }

    /// Whether it is a round tube, for which a [relaxed section](super::Relaxed) takes functions of radius and angle.
    fn is_ring(&self) -> bool {
        false
    }

    /// The same, larger by a factor about the axis of the rod.
    fn scaled<F: Profile>(self, factor: F) -> Scaled<Self, F>
    where
        Self: Sized,
    {
        Scaled::new(self, factor)
    }

    /// The same, turned about the axis of the rod by an angle in rad, from x towards y.
    fn rotated<A: Profile>(self, angle: A) -> Rotated<Self, A>
    where
        Self: Sized,
    {
        Rotated::new(self, angle)
    }

    /// The same, moved by (x, y) in m.
    fn shifted<X: Profile, Y: Profile>(self, x: X, y: Y) -> Shifted<Self, X, Y>
    where
        Self: Sized,
    {
        Shifted::new(self, x, y)
    }
}

impl Shape for Box<dyn Shape> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        (**self).rule(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        (**self).place(rule, s)
    }

    fn is_constant(&self) -> bool {
        (**self).is_constant()
    }

    fn max_degree(&self) -> usize {
        (**self).max_degree()
    }

    fn is_ring(&self) -> bool {
        (**self).is_ring()
    }
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

    /// Turns by an angle, from x towards y.
    pub fn rotation(angle: Dual64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { matrix: [[cos, -sin], [sin, cos]], shift: [Dual64::from_re(0.0); 2] }
    }

    /// Moves by (x, y).
    pub fn translation(x: Dual64, y: Dual64) -> Self {
        Self { shift: [x, y], ..Self::stretch(Dual64::from_re(1.0), Dual64::from_re(1.0)) }
    }

    /// The image of a rule: points M r̂ + c, weights ŵ det M, and their derivatives if `varying`.
    pub fn place(&self, rule: &Rule, varying: bool) -> Points {
        let (x, y, weight) = (rule.x().to_vec(), rule.y().to_vec(), rule.weights().to_vec());
        self.carry(Points { x, y, weight, rates: None }, varying)
    }

    /// The image of points that may move themselves; by the product rule their derivatives in s if `varying`.
    pub fn carry(&self, mut points: Points, varying: bool) -> Points {
        let [[a, b], [c, d]] = self.matrix;
        let area = a * d - b * c;
        let rates = points.rates.take();
        let mut moved = PointRates::default();
        for q in 0..points.len() {
            let [dx, dy, dw] = rates.as_ref().map_or([0.0; 3], |r| [r.x[q], r.y[q], r.weight[q]]);
            let x = Dual64::new(points.x[q], dx);
            let y = Dual64::new(points.y[q], dy);
            let w = Dual64::new(points.weight[q], dw);
            let image = [a * x + b * y + self.shift[0], c * x + d * y + self.shift[1], area * w];
            [points.x[q], points.y[q], points.weight[q]] = image.map(|v| v.re);
            if varying {
                moved.x.push(image[0].eps);
                moved.y.push(image[1].eps);
                moved.weight.push(image[2].eps);
            }
        }
        points.rates = varying.then_some(moved);
        points
    }
}

/// The arc length as the variable of differentiation.
pub(super) fn arc_length(s: f64) -> Dual64 {
    Dual64::from_re(s).derivative()
}

/// A size that must be positive and finite, or an error with its name and place.
pub(super) fn positive_size(quantity: &'static str, value: Dual64, s: f64) -> Result<Dual64> {
    if value.re() > 0.0 && value.re.is_finite() && value.eps.is_finite() {
        return Ok(value);
    }
    refuse(quantity, value, "positive and finite, with a finite slope", s)
}

/// A number that may have either sign but must be finite, or an error with its name and place.
pub(super) fn finite_size(quantity: &'static str, value: Dual64, s: f64) -> Result<Dual64> {
    if value.re.is_finite() && value.eps.is_finite() {
        return Ok(value);
    }
    refuse(quantity, value, "finite, with a finite slope", s)
}

/// The error for a value, or for its slope where that is what is not finite.
pub(super) fn refuse<T>(
    quantity: &'static str,
    value: Dual64,
    requirement: &'static str,
    s: f64,
) -> Result<T> {
    let value = if value.eps.is_finite() { value.re } else { value.eps };
    Err(Error::InvalidAt { quantity, value, requirement, s })
}
