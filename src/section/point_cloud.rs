use num_dual::Dual64;

use super::shape::{Affine, Shape};
use crate::error::{Error, Result};
use crate::material::Points;
use crate::quadrature::{MAX_COMPRESSED_DEGREE, Rule};

/// A section given by points and weights of your own, for instance from a mesh or an image.
///
/// The degree stated in the [`Rule`] is taken on trust. A law that needs less uses fewer of the points
/// ([`Rule::compressed`]); a polynomial law that needs more is refused. Errors of quadrature are measured against all the points.
///
/// ```
/// use hyperrod::quadrature::Rule;
/// use hyperrod::section::{PointCloud, Shape};
/// # fn main() -> hyperrod::Result<()> {
/// // four wires, 2 mm² each: exact by definition, so claim the degree the law asks for
/// let (x, y) = (vec![5e-3, -5e-3, 0.0, 0.0], vec![0.0, 0.0, 5e-3, -5e-3]);
/// let wires = PointCloud::new(Rule::new(x, y, vec![2e-6; 4], 12)?);
/// let stranded = wires.rotated(|s| s * 40.0);
/// # let _ = stranded; Ok(()) }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PointCloud {
    rule: Rule,
}

impl PointCloud {
    /// From points in m and weights in m².
    pub fn new(rule: Rule) -> Self {
        Self { rule }
    }
}

impl Shape for PointCloud {
    fn rule(&self, degree: usize) -> Result<Rule> {
        if degree > self.rule.degree() {
            let quantity = "degree asked of a section given by points";
            let requirement = "at most the degree the points are stated to be exact to";
            return Err(Error::Invalid { quantity, value: degree as f64, requirement });
        }
        if degree > MAX_COMPRESSED_DEGREE { Ok(self.rule.clone()) } else { self.rule.compressed(degree) }
    }

    fn place(&self, rule: &Rule, _s: f64) -> Result<Points> {
        let one = Dual64::from_re(1.0);
        Ok(Affine::stretch(one, one).place(rule, false))
    }

    fn is_constant(&self) -> bool {
        true
    }

    fn max_degree(&self) -> usize {
        self.rule.degree()
    }
}
