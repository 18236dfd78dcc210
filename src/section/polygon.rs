use num_dual::Dual64;

use super::shape::{Affine, Shape};
use crate::error::Result;
use crate::material::Points;
use crate::quadrature::{Polygon, Rule};

/// A polygon with holes, in m about the axis of the rod, is a shape as it stands; move it with [`Shape::scaled`] and the like.
///
/// ```
/// use hyperrod::section::{Linear, Polygon, Shape};
/// # fn main() -> hyperrod::Result<()> {
/// let outline = vec![[-10e-3, -5e-3], [10e-3, -5e-3], [0.0, 12e-3]];
/// let bore = vec![[-1e-3, -1e-3], [1e-3, -1e-3], [1e-3, 1e-3], [-1e-3, 1e-3]];
/// let prism = Polygon::new(outline)?.with_hole(bore)?;
/// let horn = prism.scaled(Linear { from: 1.0, to: 0.4, length: 0.1 });
/// # let _ = horn; Ok(()) }
/// ```
impl Shape for Polygon {
    fn rule(&self, degree: usize) -> Result<Rule> {
        Polygon::rule(self, degree)
    }

    fn place(&self, rule: &Rule, _s: f64) -> Result<Points> {
        let one = Dual64::from_re(1.0);
        Ok(Affine::stretch(one, one).place(rule, false))
    }

    fn is_constant(&self) -> bool {
        true
    }
}
