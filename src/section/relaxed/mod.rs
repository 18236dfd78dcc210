//! Sections that deform: contraction, ovalisation and warping by a small Ritz basis, condensed to the strains of the rod.
//!
//! What lives here minimises the energy of one section over displacements of its points; all a rod sees of it is a
//! [`CrossSection`].

mod assembly;
mod choose;
mod condense;
mod deformed;
mod equilibrium;
mod modes;
mod pressure;
mod rate;
mod space;
mod system;
mod warping;

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector};

use self::condense::condense;
use self::equilibrium::Problem;
use self::modes::Modes;
use super::geometry::{AreaMoments, Geometry};
use super::shape::Shape;
use super::{CrossSection, Section};
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::material::{Local, Request, Response, Station, check_strain};
use crate::quadrature::Rule;

pub use choose::{LadderReport, LadderStep};
pub use deformed::{Deformable, Deformed, Extremes, SectionPoint};
pub use warping::Warping;

/// A shape filled with one material whose points are free to move: the section contracts, bends the other way, ovalises and warps.
///
/// The points of the section take the displacement w(x, y), a combination of the functions of its [`Warping`] without rigid
/// motions, that makes the energy smallest:
///
/// ```math
/// F = [e_1 + \partial_x w,\; e_2 + \partial_y w,\; \nu + \omega \times (r + w)]\,[e_1,\; e_2,\; \gamma^*]^{-1}, \qquad
/// U(\Delta\xi) = \min_q \int u(F)\,\gamma^*_3\,dA, \qquad \gamma^* = \nu^* + \omega^* \times r,
/// ```
/// ```math
/// \int w = 0, \quad \int x\,w_3 = \int y\,w_3 = 0, \quad \int (x w_2 - y w_1) = 0, \qquad
/// \Psi = U_\xi, \quad \frac{\partial\Psi}{\partial\Delta\xi} = U_{\xi\xi} - U_{\xi q} U_{qq}^{-1} U_{q\xi} .
/// ```
///
/// So the constants of a law are those of the material: EA = E·A, EI = E·I, torsion constants, shear factors, Poynting's and
/// Brazier's effects come out, and none is typed in. The law must be one of the deformation ([`Local`] or
/// [`Isotropic`](crate::material::Isotropic)). Answers depend on the strain alone, never on what was asked before.
///
/// ```
/// use hyperrod::Strain;
/// use hyperrod::material::{NeoHookean, Station};
/// use hyperrod::section::{CrossSection, Rectangle, Relaxed, Section};
///
/// # fn main() -> hyperrod::Result<()> {
/// let rubber = NeoHookean::from_young(1e6, 0.45)?; // E in Pa, Poisson's ratio: the datasheet's
/// let rigid = Section::new(Rectangle::new(0.01, 0.01), rubber)?;
/// let free = Relaxed::new(Rectangle::new(0.01, 0.01), rubber)?; // one word changed
///
/// let stiffness = |section: &dyn CrossSection| section.tangent(&Station::straight(0.0), &Strain::zero());
/// assert!((stiffness(&free)?[(5, 5)] - 1e6 * 1e-4).abs() < 1e-8); // E A
/// assert!(stiffness(&rigid)?[(5, 5)] > 3.7 * 1e6 * 1e-4); // (λ + 2μ) A
/// # Ok(()) }
/// ```
///
/// # Cost
///
/// Every response searches for the displacement, with all derivatives of the law at every point: hundreds of times the cost of a
/// [`Section`](super::Section), a thousand on the highest rungs. Take the lowest one that is true of the rod
/// ([`with_warping`](Self::with_warping), [`choose`](Self::choose)); the default is for torsion of shapes with corners.
///
/// # Limits
/// Polynomials serve thin-walled and re-entrant shapes poorly (10⁻² to 10⁻¹ in the torsion constant even at (7, 7)).
///
/// Source: method of the relaxed cross-section as in Berdichevsky (2009), *Variational Principles of Continuum Mechanics*, ch. 15;
/// Kumar and Mukherjee (2011), Int. J. Solids Struct. 48, 1173, for the helical symmetry of the cell problem.
#[derive(Clone, Debug)]
pub struct Relaxed<S, M> {
    shape: S,
    law: M,
    warping: Warping,
    degree: Option<usize>,
    rule: Rule,
    fixed: Option<Modes>,
    /// Whether pressures keep the volume.
    incompressible: bool,
    /// ∂q/∂Δξ and q about a straight reference at rest: where the search begins.
    predictor: Option<(DMatrix<f64>, DVector<f64>)>,
}

/// A section at a strain with the displacement that relaxes it: a start for the next strain.
#[derive(Clone, Debug)]
pub struct Relaxation {
    strain: Strain,
    amplitudes: DVector<f64>,
    sensitivity: DMatrix<f64>,
    iterations: usize,
}

impl Relaxation {
    /// How many Newton iterations it took.
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// The strain it belongs to.
    pub fn strain(&self) -> &Strain {
        &self.strain
    }

    /// The amplitudes of the modes.
    pub fn amplitudes(&self) -> &[f64] {
        self.amplitudes.as_slice()
    }

    /// q + (∂q/∂Δξ) δΔξ.
    fn predict(&self, strain: &Strain) -> DVector<f64> {
        let change = DVector::from_column_slice(&(*strain - self.strain).to_array());
        &self.amplitudes + &self.sensitivity * change
    }
}

impl<S: Shape, M: Local> Relaxed<S, M> {
    /// The smallest degree of the quadrature, unless another is asked for or the shape has no rule of it. The displacements' own error is
    /// larger than that of this rule; with none it is as for a rigid section.
    const LEAST_DEGREE: usize = 8;

    /// A section of the given shape and material with the functions of [`Warping::TORSION`].
    ///
    /// # Errors
    /// If the shape is constant and a size is not positive and finite, or the shape has too few points for the functions.
    pub fn new(shape: S, law: M) -> Result<Self> {
        Self::with(shape, law, false)
    }

    /// A section of a material that cannot change its volume, J = 1: a field of pressure holds it, and u(I₁−3, I₂−3) has no
    /// volumetric part.
    ///
    /// The pressure π, a polynomial of degree p − 1, makes stationary what the displacement makes smallest:
    ///
    /// ```math
    /// \operatorname*{stat}_{q,\,\pi} \int \bigl(u - \pi\,(J - 1)\bigr)\,dV
    /// ```
    ///
    /// ```
    /// use hyperrod::Strain;
    /// use hyperrod::material::{MooneyRivlin, ReferencePressure, Station};
    /// use hyperrod::section::{CrossSection, Rectangle, Relaxed, Warping};
    /// # fn main() -> hyperrod::Result<()> {
    /// let (c1, c2) = (120e3, 40e3);
    /// let rubber = ReferencePressure(MooneyRivlin::new(c1, c2)?);
    /// let band = Relaxed::incompressible(Rectangle::new(0.02, 0.01), rubber)?.with_warping(Warping::CONTRACTION)?;
    /// let stretch: f64 = 2.0;
    /// let mut strain = Strain::zero();
    /// strain.linear.z = stretch - 1.0;
    /// let force = band.wrench(&Station::straight(0.0), &strain)?.force.z;
    /// let exact = 2.0 * 2e-4 * (stretch - stretch.powi(-2)) * (c1 + c2 / stretch); // Mooney (1940)
    /// assert!((force / exact - 1.0).abs() < 1e-14);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new).
    ///
    /// Source: Rivlin (1948), Phil. Trans. R. Soc. A 241, 379; displacements of degree p with pressures of degree p − 1 as in Boffi,
    /// Brezzi and Fortin (2013), *Mixed Finite Element Methods and Applications*, ch. 8.
    pub fn incompressible(shape: S, law: M) -> Result<Self> {
        Self::with(shape, law, true)
    }

    fn with(shape: S, law: M, incompressible: bool) -> Result<Self> {
        let (warping, degree, fixed, predictor) = (Warping::TORSION, None, None, None);
        let rule = shape.rule(2)?; // until the degree is known
        Self { shape, law, warping, degree, rule, fixed, incompressible, predictor }.prepared()
    }

    /// The same with the functions of another rung of the ladder, or any degrees.
    ///
    /// ```
    /// use hyperrod::material::NeoHookean;
    /// use hyperrod::section::{Circle, Relaxed, Warping};
    /// # fn main() -> hyperrod::Result<()> {
    /// let arm = Relaxed::new(Circle::new(0.01), NeoHookean::from_young(1e6, 0.45)?)?.with_warping(Warping::BENDING)?;
    /// assert_eq!(arm.mode_count(), 27);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// If a degree is beyond [`Warping::MAX_DEGREE`], or the quadrature too poor for it.
    pub fn with_warping(mut self, warping: Warping) -> Result<Self> {
        self.warping = warping;
        self.prepared()
    }

    /// The same with a quadrature exact for polynomials of this degree in (x, y).
    ///
    /// Without it the degree is 2 max(p, r) + 2 (twice that on a tube) and at least 8: exact for the second derivatives at rest, and at finite strain with an
    /// error below that of the displacements.
    ///
    /// # Errors
    /// If the shape has no rule of that degree, or it is below 2 (max(p, r) − 1), which leaves displacements without an energy.
    pub fn with_degree(mut self, degree: usize) -> Result<Self> {
        self.degree = Some(degree);
        self.prepared()
    }

    fn prepared(mut self) -> Result<Self> {
        let largest = self.warping.degree();
        if largest > Warping::MAX_DEGREE {
            let quantity = "degree of a section's displacement";
            return Err(Error::Invalid { quantity, value: largest as f64, requirement: "at most 12" });
        }
        if self.incompressible && self.warping.in_plane == 0 {
            let quantity = "in-plane degree of an incompressible section";
            return Err(Error::Invalid {
                quantity,
                value: 0.0,
                requirement: "at least 1: a rigid one cannot stretch",
            });
        }
        let least = (2 * largest.max(1) - 2).max(2);
        let degree = self.quadrature_degree();
        if degree < least {
            let quantity = "degree of the quadrature of a relaxed section";
            let requirement = "at least 2 (d - 1) for displacements of degree d: a poorer one leaves some without an energy";
            return Err(Error::Invalid { quantity, value: degree as f64, requirement });
        }
        self.rule = self.shape.rule(degree)?;
        self.fixed = None;
        self.predictor = None;
        if self.shape.is_constant() {
            let modes = self.modes_at(0.0)?;
            let at = Station::straight(0.0);
            let problem = self.problem(&modes, &at);
            let rest = problem.solve(&Strain::zero(), &DVector::zeros(problem.unknowns()));
            // a law that has no rest, or none here, starts from no displacement
            self.predictor = rest.ok().map(|rest| (rest.sensitivity(), rest.q));
            self.fixed = Some(modes);
        }
        Ok(self)
    }

    fn quadrature_degree(&self) -> usize {
        // a rule of degree d on a tube has d/4 + 1 radii, and functions of degree k in the radius want k + 1 and some
        let factor = if self.shape.is_ring() { 4 } else { 2 };
        let least =
            if self.warping == Warping::RIGID { Section::<S, M>::DEFAULT_DEGREE } else { Self::LEAST_DEGREE };
        let degree = (factor * (self.warping.degree() + 1)).max(least);
        self.degree.unwrap_or(degree.min(self.shape.max_degree()))
    }

    fn modes_at(&self, s: f64) -> Result<Modes> {
        Modes::new(self.shape.place(&self.rule, s)?, self.shape.is_ring(), self.warping)
    }

    fn modes(&self, s: f64) -> Result<Cow<'_, Modes>> {
        match &self.fixed {
            Some(modes) => Ok(Cow::Borrowed(modes)),
            None => Ok(Cow::Owned(self.modes_at(s)?)),
        }
    }

    /// How many modes the section deforms in.
    pub fn mode_count(&self) -> usize {
        modes::count(self.warping, self.shape.is_ring())
    }

    /// How many quadrature points the section has.
    pub fn point_count(&self) -> usize {
        self.rule.len()
    }

    /// How the section deforms.
    pub fn warping(&self) -> Warping {
        self.warping
    }

    /// The material.
    pub fn material(&self) -> &M {
        &self.law
    }

    /// The shape.
    pub fn shape(&self) -> &S {
        &self.shape
    }

    /// As [`CrossSection::respond`], with a start, and with what a start for the next strain needs.
    ///
    /// The answer agrees with that of [`CrossSection::respond`] to rounding, in two or three iterations where strains follow one
    /// another.
    ///
    /// # Errors
    /// As [`CrossSection::respond`].
    pub fn respond_from(
        &self,
        start: Option<&Relaxation>,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<(Response, Relaxation)> {
        check_strain(strain, at.s)?;
        let modes = self.modes(at.s)?;
        let problem = self.problem(&modes, at);
        let equilibrium = problem.solve(strain, &self.start(problem.unknowns(), start, strain))?;
        let response = condense(&problem, strain, &equilibrium, request)?;
        let relaxation = Relaxation {
            strain: *strain,
            sensitivity: equilibrium.sensitivity(),
            iterations: equilibrium.iterations,
            amplitudes: equilibrium.q,
        };
        Ok((response, relaxation))
    }

    /// The section at a strain, to be looked at point by point.
    ///
    /// ```
    /// use hyperrod::Strain;
    /// use hyperrod::material::{NeoHookean, Station};
    /// use hyperrod::section::{Circle, Relaxed, Warping};
    /// # fn main() -> hyperrod::Result<()> {
    /// let cord = Relaxed::new(Circle::new(0.01), NeoHookean::from_young(1e6, 0.45)?)?.with_warping(Warping::CONTRACTION)?;
    /// let mut strain = Strain::zero();
    /// strain.linear.z = 0.5;
    /// let rim = cord.deformed(&Station::straight(0.0), &strain)?.point(0.01, 0.0)?;
    /// assert!(rim.position[0] < 0.0085 && (rim.largest_stretch() - 1.5).abs() < 1e-12);
    /// assert!(rim.cauchy()[(0, 0)].abs() < 1e-6 * rim.cauchy()[(2, 2)]); // its sides are free
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`CrossSection::respond`].
    pub fn deformed(&self, at: &Station, strain: &Strain) -> Result<Deformed<'_>> {
        let (_, relaxation) = self.respond_from(None, at, strain, Request::Wrench)?;
        let modes = self.modes(at.s)?;
        let coefficients = modes.expand(&relaxation.amplitudes);
        let pressures = relaxation.amplitudes.as_slice()[modes.len()..].to_vec();
        Ok(Deformed { modes, law: &self.law, at: *at, strain: *strain, coefficients, pressures })
    }

    fn problem<'a>(&'a self, modes: &'a Modes, at: &'a Station) -> Problem<'a> {
        let pressures = match (self.incompressible, self.warping.in_plane) {
            (false, _) | (true, 0) => 0,
            (true, 1) => 1,
            (true, degree) => modes.space.count(degree - 1),
        };
        Problem { modes, law: &self.law, at, pressures }
    }

    fn start(&self, unknowns: usize, start: Option<&Relaxation>, strain: &Strain) -> DVector<f64> {
        match (start, &self.predictor) {
            (Some(start), _) if start.amplitudes.len() == unknowns => start.predict(strain),
            (_, Some((sensitivity, rest))) => {
                rest + sensitivity * DVector::from_column_slice(&strain.to_array())
            }
            _ => DVector::zeros(unknowns),
        }
    }
}

impl<S: Shape, M: Local> CrossSection for Relaxed<S, M> {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        Ok(self.respond_from(None, at, strain, request)?.0)
    }
}

impl<S: Shape, M: Local> Deformable for Relaxed<S, M> {
    fn deformed(&self, at: &Station, strain: &Strain) -> Result<Deformed<'_>> {
        Self::deformed(self, at, strain)
    }
}

impl<S: Shape, M: Local> Deformable for Section<S, M> {
    fn deformed(&self, at: &Station, strain: &Strain) -> Result<Deformed<'_>> {
        self.energy(at, strain)?; // refuses what cannot be strained so
        let modes = Modes::new(self.points(at.s)?, self.shape().is_ring(), Warping::RIGID)?;
        let coefficients = modes.expand(&DVector::zeros(0));
        let (modes, pressures) = (Cow::Owned(modes), Vec::new());
        Ok(Deformed { modes, law: self.material(), at: *at, strain: *strain, coefficients, pressures })
    }
}

impl<S: Shape, M: Local> Geometry for Relaxed<S, M> {
    fn moments(&self, s: f64) -> Result<AreaMoments> {
        match &self.fixed {
            Some(modes) => Ok(AreaMoments::of(&modes.points)),
            None => Ok(AreaMoments::of(&self.shape.place(&self.rule, s)?)),
        }
    }

    fn weighted_third_moments(&self, s: f64) -> Result<[f64; 4]> {
        Ok(AreaMoments::third(&self.shape.place(&self.shape.rule(3)?, s)?))
    }
}
