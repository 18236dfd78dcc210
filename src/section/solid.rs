use super::CrossSection;
use super::degree::{Probe, QuadratureReport, StrainRange};
use super::geometry::{AreaMoments, Geometry};
use super::lines;
use super::quadratic::Quadratic;
use super::shape::Shape;
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist};
use crate::material::{Active, Material, Points, Request, Response, Station};
use crate::quadrature::Rule;

/// A shape filled with one material; plane sections stay plane and keep their shape (rigid section).
///
/// ```math
/// U = \int u\,dA, \qquad \Psi = \int \nabla_{\Delta\xi} u\,dA, \qquad \Psi' = \frac{\partial}{\partial s}\Psi\Big|_{\Delta\xi}
/// ```
///
/// # Quadrature
/// Where u is a polynomial of degree d in the strain (and in x and y, for a law graded over the section), Ψ and ∂Ψ are integrals of
/// polynomials of degree d and come exact from a rule of degree d. Otherwise the degree is [`Section::DEFAULT_DEGREE`], or what
/// [`with_degree`](Self::with_degree) or [`with_tolerance`](Self::with_tolerance) ask for. About a curved reference a law of the
/// deformation is no polynomial any more: its energy is that of γ/j, per volume j dA. A [`Body`](crate::Body) therefore
/// [adapts](CrossSection::adapt_to) its section to its reference, to [`Section::CURVED_TOLERANCE`]; a section used without a body
/// must be told.
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
    choice: DegreeChoice,
    degree: usize,
    rule: Rule,
    fixed: Option<(Points, AreaMoments)>,
    quadratic: Option<Quadratic>,
    /// Fewer points for strains in the plane, where there are such.
    lines: Option<Points>,
    adapted_to: Option<Twist>,
}

/// Who chose the degree of the quadrature.
#[derive(Clone, Copy, Debug)]
enum DegreeChoice {
    /// The law, or the default.
    Law,
    /// The user.
    User,
    /// A tolerance over a range of strains.
    Tolerance(f64, StrainRange),
}

impl<S, M> Section<S, M> {
    /// The degree of the quadrature for a law that is not a polynomial: with axial strains up to 30 %, a neo-Hookean section has an
    /// error below 1e-8 with it, up to 50 % below 1e-5 (see [`QuadratureReport`]).
    pub const DEFAULT_DEGREE: usize = 12;

    /// To what the curvature of a reference is resolved, unless a degree or a tolerance was asked for.
    pub const CURVED_TOLERANCE: f64 = 1e-12;

    /// Second moments, which gravity and inertia ask for, need this much.
    const LEAST_DEGREE: usize = 2;
}

impl<S: Shape, M: Material> Section<S, M> {
    /// A section of the given shape and material.
    ///
    /// # Errors
    /// If the shape is constant and a size is not positive and finite, or has no rule of the degree of the law.
    pub fn new(shape: S, material: M) -> Result<Self> {
        let default = Self::DEFAULT_DEGREE.min(shape.max_degree());
        let degree = material.polynomial_degree().unwrap_or(default).max(Self::LEAST_DEGREE);
        let rule = shape.rule(degree)?;
        Self {
            choice: DegreeChoice::Law,
            degree,
            rule,
            fixed: None,
            quadratic: None,
            lines: None,
            adapted_to: None,
            shape,
            material,
        }
        .prepared()
    }

    /// The same with a quadrature exact for polynomials of this degree in (x, y).
    ///
    /// # Errors
    /// If the shape has no rule of that degree.
    pub fn with_degree(mut self, degree: usize) -> Result<Self> {
        self.choice = DegreeChoice::User;
        self.set_degree(degree.max(Self::LEAST_DEGREE))?;
        Ok(self)
    }

    /// The same with the smallest degree whose estimated error of Ψ and ∂Ψ/∂Δξ, relative to their largest entries, is below the
    /// tolerance for sample strains that reach the limits of the range.
    ///
    /// ```
    /// use hyperrod::material::NeoHookean;
    /// use hyperrod::section::{Circle, Section, StrainRange};
    /// # fn main() -> hyperrod::Result<()> {
    /// let range = StrainRange { axial: 0.5, ..Default::default() };
    /// let section = Section::new(Circle::new(0.01), NeoHookean::from_young(1e6, 0.45)?)?.with_tolerance(1e-8, &range)?;
    /// let report = section.quadrature_report(1e-8, &range)?;
    /// assert!(report.reached && report.estimated_error < 1e-8);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`Error::NoConvergence`] if no degree up to 96 is enough, as for a law with a kink; whatever the law says if a strain of the
    /// range is inadmissible; [`Error::Invalid`] if the tolerance or the range is not positive and finite.
    pub fn with_tolerance(mut self, tolerance: f64, range: &StrainRange) -> Result<Self> {
        self.choice = DegreeChoice::Tolerance(check_tolerance(tolerance)?, *range);
        let probe = Probe::new(&self.shape, &self.material, range)?;
        let degree = probe.smallest_degree(tolerance, Self::LEAST_DEGREE)?;
        self.set_degree(degree)?;
        Ok(self)
    }

    /// How well this section integrates over a range of strains, by comparison with about twice the degree.
    ///
    /// # Errors
    /// As [`with_tolerance`](Self::with_tolerance), except that a tolerance missed is reported.
    pub fn quadrature_report(&self, tolerance: f64, range: &StrainRange) -> Result<QuadratureReport> {
        check_tolerance(tolerance)?;
        let probe = Probe::new(&self.shape, &self.material, range)?;
        let estimated_error = self.with_points(range.at.s, |points| probe.error_of(points, self.degree))?;
        let reached = estimated_error <= tolerance;
        Ok(QuadratureReport { degree: self.degree, points: self.rule.len(), estimated_error, reached })
    }

    fn set_degree(&mut self, degree: usize) -> Result<()> {
        self.degree = degree;
        self.rule = self.shape.rule(degree)?;
        self.prepare()
    }

    /// Places the points once and for all where the shape does not vary.
    fn prepare(&mut self) -> Result<()> {
        (self.fixed, self.lines) = (None, None);
        if self.shape.is_constant() {
            let points = self.shape.place(&self.rule, 0.0)?;
            let moments = AreaMoments::of(&points);
            self.quadratic = Quadratic::of(&self.material, &points)?;
            self.lines = if self.material.is_homogeneous() { lines::lines(&points) } else { None };
            self.fixed = Some((points, moments));
        }
        Ok(())
    }

    fn prepared(mut self) -> Result<Self> {
        self.prepare()?;
        Ok(self)
    }

    /// How many quadrature points the section has.
    pub fn point_count(&self) -> usize {
        self.rule.len()
    }

    /// The degree of the polynomials in (x, y) that are integrated exactly.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The material.
    pub fn material(&self) -> &M {
        &self.material
    }

    /// The shape.
    pub fn shape(&self) -> &S {
        &self.shape
    }

    /// The quadrature points at s.
    pub(super) fn points(&self, s: f64) -> Result<Points>
    where
        S: Shape,
    {
        match &self.fixed {
            Some((points, _)) => Ok(points.clone()),
            None => self.shape.place(&self.rule, s),
        }
    }

    /// Calls `f` with the points of the section at s.
    fn with_points<T>(&self, s: f64, f: impl FnOnce(&Points) -> Result<T>) -> Result<T> {
        match &self.fixed {
            Some((points, _)) => f(points),
            None => f(&self.shape.place(&self.rule, s)?),
        }
    }
}

impl<S: Shape, M: Material> CrossSection for Section<S, M> {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        if let (Some(quadratic), Some((points, _))) = (&self.quadratic, &self.fixed)
            && quadratic.holds(at)
        {
            return quadratic.respond(points, at, strain, request);
        }
        self.with_points(at.s, |points| self.material.integrate(points, at, strain, request))
    }

    fn respond_many(
        &self,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        self.respond_active(sites, Active::all(), request, out)
    }

    fn respond_active(
        &self,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        if let (Some((points, _)), None) = (&self.fixed, &self.quadratic) {
            // what is refused is refused once more at the points themselves, so that one of them is named
            if let Some(lines) = self.lines.as_ref().filter(|_| lines::are_alike(active, sites))
                && self.material.integrate_active(lines, sites, active, request, out).is_ok()
            {
                return Ok(());
            }
            return self.material.integrate_active(points, sites, active, request, out);
        }
        for ((at, strain), out) in sites.iter().zip(out) {
            match (&self.quadratic, &self.fixed) {
                (Some(quadratic), Some((points, _))) if quadratic.holds(at) => {
                    quadratic.answer(points, at, strain, active, request, out)?;
                }
                _ => *out = self.respond(at, strain, request)?,
            }
        }
        Ok(())
    }

    /// Raises the degree until the curvature of the reference is resolved; a degree that the user asked for stays.
    fn adapt_to(&mut self, at: &Station) -> Result<()> {
        /// Small, so that it is the curvature of the reference that is measured and not that of the law.
        const STRAIN: f64 = 1e-3;
        let xi = at.reference.twist;
        let known = self.fixed.is_some() && self.adapted_to == Some(xi);
        if known || (xi.angular.x == 0.0 && xi.angular.y == 0.0) {
            return Ok(());
        }
        self.adapted_to = Some(xi);
        let (tolerance, range) = match self.choice {
            DegreeChoice::User => return Ok(()),
            DegreeChoice::Law => {
                (Self::CURVED_TOLERANCE, StrainRange { axial: STRAIN, shear: STRAIN, at: *at })
            }
            DegreeChoice::Tolerance(tolerance, range) => (tolerance, StrainRange { at: *at, ..range }),
        };
        let probe = Probe::new(&self.shape, &self.material, &range)?;
        let degree = probe.smallest_degree(tolerance, self.degree)?;
        if degree > self.degree { self.set_degree(degree) } else { Ok(()) }
    }
}

impl<S: Shape, M: Material> Geometry for Section<S, M> {
    fn moments(&self, s: f64) -> Result<AreaMoments> {
        match &self.fixed {
            Some((_, moments)) => Ok(*moments),
            None => Ok(AreaMoments::of(&self.shape.place(&self.rule, s)?)),
        }
    }

    fn weighted_third_moments(&self, s: f64) -> Result<[f64; 4]> {
        const DEGREE: usize = 3;
        if self.degree >= DEGREE {
            return self.with_points(s, |points| Ok(AreaMoments::third(points)));
        }
        Ok(AreaMoments::third(&self.shape.place(&self.shape.rule(DEGREE)?, s)?))
    }
}

fn check_tolerance(tolerance: f64) -> Result<f64> {
    if tolerance > 0.0 && tolerance.is_finite() {
        return Ok(tolerance);
    }
    let quantity = "quadrature tolerance";
    Err(Error::Invalid { quantity, value: tolerance, requirement: "positive and finite" })
}
