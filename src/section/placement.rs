use super::profile::Profile;
use super::shape::{Affine, Shape, arc_length, finite_size, positive_size};
use crate::error::Result;
use crate::material::Points;
use crate::quadrature::Rule;

/// A shape made larger by a factor about the axis of the rod. See [`Shape::scaled`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled<S, F = f64> {
    shape: S,
    factor: F,
}

/// A shape turned about the axis of the rod. See [`Shape::rotated`].
///
/// ```math
/// r = Q(\varphi(s))\,\hat r(s), \qquad r' = Q\,\hat r' + \varphi'\, e_3 \times r
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotated<S, A = f64> {
    shape: S,
    angle: A,
}

/// A shape moved in its plane. See [`Shape::shifted`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shifted<S, X = f64, Y = f64> {
    shape: S,
    x: X,
    y: Y,
}

impl<S, F> Scaled<S, F> {
    pub(super) fn new(shape: S, factor: F) -> Self {
        Self { shape, factor }
    }
}

impl<S, A> Rotated<S, A> {
    pub(super) fn new(shape: S, angle: A) -> Self {
        Self { shape, angle }
    }
}

impl<S, X, Y> Shifted<S, X, Y> {
    pub(super) fn new(shape: S, x: X, y: Y) -> Self {
        Self { shape, x, y }
    }
}

impl<S: Shape, F: Profile> Shape for Scaled<S, F> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        self.shape.rule(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let factor = positive_size("scale factor of the section", self.factor.at(arc_length(s)), s)?;
        Ok(Affine::stretch(factor, factor).carry(self.shape.place(rule, s)?, !self.is_constant()))
    }

    fn is_constant(&self) -> bool {
        self.shape.is_constant() && self.factor.is_constant()
    }

    fn max_degree(&self) -> usize {
        self.shape.max_degree()
    }

    fn is_ring(&self) -> bool {
        self.shape.is_ring()
    }
}

impl<S: Shape, A: Profile> Shape for Rotated<S, A> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        self.shape.rule(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let angle = finite_size("angle of the section", self.angle.at(arc_length(s)), s)?;
        Ok(Affine::rotation(angle).carry(self.shape.place(rule, s)?, !self.is_constant()))
    }

    fn is_constant(&self) -> bool {
        self.shape.is_constant() && self.angle.is_constant()
    }

    fn max_degree(&self) -> usize {
        self.shape.max_degree()
    }

    fn is_ring(&self) -> bool {
        self.shape.is_ring()
    }
}

impl<S: Shape, X: Profile, Y: Profile> Shape for Shifted<S, X, Y> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        self.shape.rule(degree)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let x = finite_size("shift of the section along x", self.x.at(arc_length(s)), s)?;
        let y = finite_size("shift of the section along y", self.y.at(arc_length(s)), s)?;
        Ok(Affine::translation(x, y).carry(self.shape.place(rule, s)?, !self.is_constant()))
    }

    fn is_constant(&self) -> bool {
        self.shape.is_constant() && self.x.is_constant() && self.y.is_constant()
    }

    fn max_degree(&self) -> usize {
        self.shape.max_degree()
    }

    fn is_ring(&self) -> bool {
        self.shape.is_ring()
    }
}
