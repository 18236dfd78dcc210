use super::profile::Profile;
use super::shape::{Affine, Shape, arc_length, positive_size};
use crate::error::Result;
use crate::material::Points;
use crate::quadrature::{self, Rule};

/// A full circle about the axis of the rod.
///
/// A = πR², I_x = I_y = πR⁴/4, J = πR⁴/2.
///
/// ```
/// use hyperrod::section::{Circle, Linear};
///
/// let wire = Circle::new(0.5e-3);
/// let arm = Circle::new(Linear { from: 0.012, to: 0.006, length: 0.25 });
/// # let _ = (wire, arm);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle<R = f64> {
    radius: R,
}

impl<R: Profile> Circle<R> {
    /// A circle of the given radius, m: a number, or anything that varies along s (see [`Profile`]).
    pub fn new(radius: R) -> Self {
        Self { radius }
    }
}

impl<R: Profile> Shape for Circle<R> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        quadrature::disk(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let radius = positive_size("radius of the circle", self.radius.at(arc_length(s)), s)?;
        Ok(Affine::stretch(radius, radius).place(rule, !self.is_constant()))
    }

    fn is_constant(&self) -> bool {
        self.radius.is_constant()
    }
}
