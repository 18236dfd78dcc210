use super::CrossSection;
use super::geometry::{AreaMoments, Geometry};
use super::shape::Shape;
use crate::error::Result;
use crate::lie::Strain;
use crate::material::{Material, Points, Request, Response, Station};
use crate::quadrature::Rule;

/// A shape filled with one material; plane sections stay plane and keep their shape (rigid section).
///
/// ```math
/// U = \int u\,dA, \qquad \Psi = \int \nabla_{\Delta\xi} u\,dA, \qquad \Psi' = \frac{\partial}{\partial s}\Psi\Big|_{\Delta\xi}
/// ```
///
/// The quadrature is exact for the degree of the law where that is a polynomial; otherwise it has [`Section::DEFAULT_DEGREE`],
/// or what [`with_degree`](Self::with_degree) asks for.
///
/// ```
/// use hyperrod::material::{MooneyRivlin, ReferencePressure, Station};
/// use hyperrod::section::{Circle, CrossSection, Section};
/// use hyperrod::Strain;
///
/// # fn main() -> hyperrod::Result<()> {
/// let section = Section::new(Circle::new(0.01), ReferencePressure(MooneyRivlin::new(120e3, 40e3)?))?;
/// let mut strain = Strain::zero();
/// strain.angular.x = 5.0; // bent about x to a radius of 0.2 m
/// let wrench = section.wrench(&Station::straight(0.0), &strain)?;
/// let ei_x = (2.0 * 120e3 + 4.0 * 40e3) * std::f64::consts::PI * 0.01_f64.powi(4) / 4.0;
/// assert!((wrench.moment.x - ei_x * 5.0).abs() < 1e-14 * ei_x);
/// # Ok(()) }
/// ```
///
/// Source: Ψ, ∂Ψ/∂Δξ and Ψ′ as in the theory of Cosserat rods with a hyperelastic section, Antman (2005), ch. 8.
#[derive(Clone, Debug)]
pub struct Section<S, M> {
    shape: S,
    material: M,
    rule: Rule,
    fixed: Option<Points>,
}

impl<S, M> Section<S, M> {
    /// The degree of the quadrature for a law that is not a polynomial.
    pub const DEFAULT_DEGREE: usize = 12;
}

impl<S: Shape, M: Material> Section<S, M> {
    /// A section of the given shape and material.
    ///
    /// # Errors
    /// If the shape is constant and a size is not positive and finite.
    pub fn new(shape: S, material: M) -> Result<Self> {
        let degree = material.polynomial_degree().unwrap_or(Self::DEFAULT_DEGREE);
        Self { rule: shape.rule(degree.max(2))?, fixed: None, shape, material }.prepared()
    }

    /// The same with a quadrature exact for polynomials of this degree in (x, y).
    ///
    /// # Errors
    /// If the shape has no rule of that degree.
    pub fn with_degree(mut self, degree: usize) -> Result<Self> {
        self.rule = self.shape.rule(degree.max(2))?;
        self.prepared()
    }

    /// Places the points once and for all where the shape does not vary.
    fn prepared(mut self) -> Result<Self> {
        self.fixed = if self.shape.is_constant() { Some(self.shape.place(&self.rule, 0.0)?) } else { None };
        Ok(self)
    }

    /// How many quadrature points the section has.
    pub fn point_count(&self) -> usize {
        self.rule.len()
    }

    /// The material.
    pub fn material(&self) -> &M {
        &self.material
    }

    /// Calls `f` with the points of the section at s.
    fn with_points<T>(&self, s: f64, f: impl FnOnce(&Points) -> Result<T>) -> Result<T> {
        match &self.fixed {
            Some(points) => f(points),
            None => f(&self.shape.place(&self.rule, s)?),
        }
    }
}

impl<S: Shape, M: Material> CrossSection for Section<S, M> {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        self.with_points(at.s, |points| self.material.integrate(points, at, strain, request))
    }
}

impl<S: Shape, M: Material> Geometry for Section<S, M> {
    fn moments(&self, s: f64) -> Result<AreaMoments> {
        self.with_points(s, |points| {
            let mut sum = AreaMoments::default();
            for ((x, y), w) in points.x.iter().zip(&points.y).zip(&points.weight) {
                sum.area += w;
                sum.first[0] += w * x;
                sum.first[1] += w * y;
                sum.i_x += w * y * y;
                sum.i_y += w * x * x;
                sum.i_xy += w * x * y;
            }
            Ok(sum)
        })
    }
}
