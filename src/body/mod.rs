//! What a rod is made of along s: length, section, reference strain, and mass where a scene asks for it.
//!
//! A [`Body`] starts without mass: a scene without gravity never mentions one. [`Body::with_density`] changes its *type*, and
//! only then does it have the capability [`HasMass`] that gravity requires; leaving it out is a compile error.
//!
//! What lives here knows sections, one after the other along s; it knows no pose, no load and no boundary condition.

mod area;
mod constraint;
mod mass;
mod reference;
mod viscosity;

pub use area::HasArea;
pub use constraint::Constraint;
pub use mass::{Density, HasMass, LineDensity, LineMass, MassModel, Massless};
pub use reference::ReferenceShape;
pub use viscosity::{Dissipative, IsotropicViscosity, ViscosityMatrix, ViscosityModel, Viscous};

use num_dual::Dual64;

use crate::error::{Result, positive};
use crate::lie::{Strain, Twist};
use crate::material::{Reference, Request, Response, Station};
use crate::section::CrossSection;

/// A body along the arc length s ∈ [0, L]: a section at every s, and the shape it has at rest.
///
/// ```
/// use hyperrod::Body;
/// use hyperrod::material::LinearElastic;
/// use hyperrod::section::{Circle, Section};
/// # fn main() -> hyperrod::Result<()> {
/// let section = Section::new(Circle::new(1e-3), LinearElastic::new(70e9, 26e9)?)?;
/// let wire = Body::new(0.5, section)?.with_density(2700.0)?;
/// # let _ = wire; Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Body<C, M = Massless> {
    length: f64,
    section: C,
    reference: ReferenceShape,
    constraint: Constraint,
    mass: M,
}

impl<C: CrossSection> Body<C> {
    /// A straight body of the given length, m, and section.
    ///
    /// # Errors
    /// If the length is not positive and finite.
    pub fn new(length: f64, section: C) -> Result<Self> {
        positive("length of the body", length)?;
        Ok(Self {
            length,
            section,
            reference: ReferenceShape::Straight,
            constraint: Constraint::none(),
            mass: Massless,
        })
    }

    /// The same with a density, kg/m³, of the reference: mass per length ∫ρ dV/ds, which is ρA where the reference is straight.
    ///
    /// In a [`Composite`](crate::section::Composite) it is the density of the parts that state no other.
    ///
    /// # Errors
    /// If the density is not positive and finite.
    pub fn with_density(self, density: f64) -> Result<Body<C, Density>> {
        Ok(self.with_mass(Density::new(density)?))
    }

    /// The same with a mass per length, kg/m, for a section that knows no area.
    ///
    /// # Errors
    /// If it is not positive and finite.
    pub fn with_mass_per_length(self, mass: f64) -> Result<Body<C, LineDensity>> {
        Ok(self.with_mass(LineDensity::new(mass)?))
    }

    fn with_mass<M>(self, mass: M) -> Body<C, M> {
        let Self { length, section, reference, constraint, .. } = self;
        Body { length, section, reference, constraint, mass }
    }
}

impl<C: CrossSection, M: Send + Sync> Body<C, M> {
    /// The same with a constant reference strain ξ*: an arc, a helix. The section [adapts](CrossSection::adapt_to) to it.
    ///
    /// # Errors
    /// If ξ* is not finite, its axial component (the stretch of the reference) not positive, or the section reaches the centre of
    /// its curvature.
    pub fn with_reference_strain(self, xi: Twist) -> Result<Self> {
        Self { reference: ReferenceShape::Constant(xi), ..self }.adapted()
    }

    /// The same with a reference strain ξ*(s) that varies along the rod, written over [`Dual64`] so that ξ*′ comes with it.
    ///
    /// It is examined at 17 places along the rod, to which the section [adapts](CrossSection::adapt_to).
    ///
    /// # Errors
    /// As [`with_reference_strain`](Self::with_reference_strain), at one of those places.
    pub fn with_varying_reference(
        self,
        xi: impl Fn(Dual64) -> Twist<Dual64> + Send + Sync + 'static,
    ) -> Result<Self> {
        Self { reference: ReferenceShape::varying(xi), ..self }.adapted()
    }

    /// The same without some of its strains. See [`Constraint`].
    pub fn with_constraint(self, constraint: Constraint) -> Self {
        Self { constraint, ..self }
    }

    /// Checks the reference and makes the section ready for it, at places spread over the rod.
    fn adapted(mut self) -> Result<Self> {
        const PLACES: usize = 16;
        for k in 0..=PLACES {
            let place = self.length * k as f64 / PLACES as f64;
            let at = Station { s: place, reference: self.reference.checked(place)? };
            self.section.adapt_to(&at)?;
        }
        Ok(self)
    }

    /// Length L, m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The section.
    pub fn section(&self) -> &C {
        &self.section
    }

    /// The station at s: arc length and reference strain.
    pub fn station(&self, s: f64) -> Station {
        Station { s, reference: self.reference.at(s) }
    }
}

/// What the equilibrium of a rod asks of its body; implemented by every [`Body`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not the body of a rod",
    label = "a body is needed here",
    note = "`Body::new(length, section)?` makes one; a `Result` with a body in it still wants its `?`"
)]
pub trait Elastic: Send + Sync {
    /// Length L, m.
    fn length(&self) -> f64;

    /// The reference strain ξ* and its derivative at s.
    fn reference(&self, s: f64) -> Reference;

    /// The response of the section at s to Δξ.
    ///
    /// # Errors
    /// As [`CrossSection::respond`].
    fn respond(&self, s: f64, strain: &Strain, request: Request) -> Result<Response>;

    /// As [`respond`](Self::respond) for as many arc lengths as strains at once. What it says about strains that are fixed by the
    /// [constraint](Self::constraint) is not to be relied on.
    ///
    /// # Errors
    /// As [`respond`](Self::respond), for the first that fails.
    fn respond_many(
        &self,
        places: &[f64],
        strains: &[Strain],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        for ((s, strain), out) in places.iter().zip(strains).zip(out) {
            *out = self.respond(*s, strain, request)?;
        }
        Ok(())
    }

    /// The strains that stay at their reference value; what [`respond`](Self::respond) says about them is not used.
    fn constraint(&self) -> Constraint {
        Constraint::none()
    }

    /// Arc lengths at which the response is not smooth in s; see [`CrossSection::breakpoints`].
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }
}

impl<C: CrossSection, M: Send + Sync> Elastic for Body<C, M> {
    fn length(&self) -> f64 {
        self.length
    }

    fn reference(&self, s: f64) -> Reference {
        self.reference.at(s)
    }

    fn respond(&self, s: f64, strain: &Strain, request: Request) -> Result<Response> {
        let station = Station { s, reference: self.reference.checked(s)? };
        self.section.respond(&station, strain, request)
    }

    fn respond_many(
        &self,
        places: &[f64],
        strains: &[Strain],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        /// Sites made at a time: the stages of eight elements of order 6.
        const SITES: usize = 24;
        let mut sites = [(Station::straight(0.0), Strain::zero()); SITES];
        let active = self.constraint.active();
        let all = places.chunks(SITES).zip(strains.chunks(SITES)).zip(out.chunks_mut(SITES));
        for ((places, strains), out) in all {
            for ((site, s), strain) in sites.iter_mut().zip(places).zip(strains) {
                // where it is straight, so is that of the site
                if !matches!(self.reference, ReferenceShape::Straight) {
                    site.0.reference = self.reference.checked(*s)?;
                }
                (site.0.s, site.1) = (*s, *strain);
            }
            self.section.respond_active(&sites[..places.len()], active, request, out)?;
        }
        Ok(())
    }

    fn constraint(&self) -> Constraint {
        self.constraint
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.section.breakpoints()
    }
}
