use super::profile::Profile;
use super::shape::{Affine, Shape, arc_length, positive_size};
use crate::error::Result;
use crate::material::Points;
use crate::quadrature::{self, Rule};

/// An ellipse centred on the axis of the rod, with semi-axis `a` along x and `b` along y.
///
/// A = πab, I_x = ∫y² dA = πab³/4, I_y = ∫x² dA = πa³b/4.
///
/// ```
/// use hyperrod::section::Ellipse;
///
/// let blade = Ellipse::new(8e-3, 2e-3); // bends most easily about x
/// # let _ = blade;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse<A = f64, B = f64> {
    a: A,
    b: B,
}

impl<A: Profile, B: Profile> Ellipse<A, B> {
    /// With semi-axes a (along x) and b (along y), m.
    pub fn new(a: A, b: B) -> Self {
        Self { a, b }
    }
}

impl<A: Profile, B: Profile> Shape for Ellipse<A, B> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        quadrature::disk(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let a = positive_size("semi-axis a of the ellipse", self.a.at(arc_length(s)), s)?;
        let b = positive_size("semi-axis b of the ellipse", self.b.at(arc_length(s)), s)?;
        Ok(Affine::stretch(a, b).place(rule, !self.is_constant()))
    }

    fn is_constant(&self) -> bool {
        self.a.is_constant() && self.b.is_constant()
    }
}
