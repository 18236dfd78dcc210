use std::f64::consts::TAU;

use super::profile::Profile;
use super::shape::{Affine, Shape, arc_length, positive_size};
use crate::error::{Error, Result};
use crate::material::Points;
use crate::quadrature::{Polygon, Rule};

/// A regular polygon centred on the axis of the rod, with a vertex on x.
///
/// With n sides and circumradius R,
///
/// ```math
/// A = \tfrac n2 R^2 \sin\tfrac{2\pi}{n}, \qquad
/// I_x = I_y = \tfrac n{24} R^4 \sin\tfrac{2\pi}{n}\,\bigl(2 + \cos\tfrac{2\pi}{n}\bigr) .
/// ```
///
/// ```
/// use hyperrod::section::RegularPolygon;
/// # fn main() -> hyperrod::Result<()> {
/// let pencil = RegularPolygon::new(6, 3.7e-3)?;
/// # let _ = pencil; Ok(()) }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RegularPolygon<R = f64> {
    outline: Polygon,
    circumradius: R,
}

impl<R: Profile> RegularPolygon<R> {
    /// The largest number of sides: 1000, whose outline is within 5e-6 of the radius of a circle.
    pub const MAX_SIDES: usize = 1000;

    /// With the given number of sides and the distance of its vertices from the axis, m.
    ///
    /// # Errors
    /// If there are fewer than 3 sides, or more than [`MAX_SIDES`](Self::MAX_SIDES).
    pub fn new(sides: usize, circumradius: R) -> Result<Self> {
        if !(3..=Self::MAX_SIDES).contains(&sides) {
            let quantity = "number of sides of a regular polygon";
            return Err(Error::Invalid { quantity, value: sides as f64, requirement: "from 3 to 1000" });
        }
        let vertex = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / sides as f64).sin_cos();
            [cos, sin]
        };
        Ok(Self { outline: Polygon::new((0..sides).map(vertex).collect())?, circumradius })
    }
}

impl<R: Profile> Shape for RegularPolygon<R> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        self.outline.rule(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let quantity = "circumradius of the regular polygon";
        let radius = positive_size(quantity, self.circumradius.at(arc_length(s)), s)?;
        Ok(Affine::stretch(radius, radius).place(rule, !self.is_constant()))
    }

    fn is_constant(&self) -> bool {
        self.circumradius.is_constant()
    }
}
