use super::profile::Profile;
use super::shape::{Affine, Shape, arc_length, positive_size};
use crate::error::Result;
use crate::material::Points;
use crate::quadrature::{self, Rule};

/// A rectangle centred on the axis of the rod: `width` along x, `height` along y.
///
/// A = bh, I_x = ∫y² dA = bh³/12, I_y = ∫x² dA = hb³/12.
///
/// ```
/// use hyperrod::section::Rectangle;
///
/// let strip = Rectangle::new(20e-3, 2e-3); // bends most easily about x
/// # let _ = strip;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle<B = f64, H = f64> {
    width: B,
    height: H,
}

impl<B: Profile, H: Profile> Rectangle<B, H> {
    /// Of the given width (along x) and height (along y), m.
    pub fn new(width: B, height: H) -> Self {
        Self { width, height }
    }
}

impl<B: Profile, H: Profile> Shape for Rectangle<B, H> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        quadrature::rectangle(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let width = positive_size("width of the rectangle", self.width.at(arc_length(s)), s)?;
        let height = positive_size("height of the rectangle", self.height.at(arc_length(s)), s)?;
        Ok(Affine::stretch(width, height).place(rule, !self.is_constant()))
    }

    fn is_constant(&self) -> bool {
        self.width.is_constant() && self.height.is_constant()
    }
}
