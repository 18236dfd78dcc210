//! Cross-sections: shapes whose points move along s, and what a section answers to a strain.
//!
//! A [`Section`] is a [`Shape`] filled with a [`Material`](crate::material::Material), a [`Composite`] several of them; a [`Stiffness`] is
//! a section given by its resultants alone. All are a [`CrossSection`]: strain in, energy, wrench Ψ, tangent ∂Ψ/∂Δξ and rate Ψ′ out. What a section
//! weighs follows from its [`Geometry`].
//!
//! What lives here knows one section at a time: nothing of lengths, poses or loads.

mod actuation;
mod annulus;
mod check;
mod circle;
mod composite;
mod degree;
mod effective;
mod ellipse;
mod geometry;
mod lines;
mod path;
mod placement;
mod point_cloud;
mod polygon;
mod profile;
mod quadratic;
mod rectangle;
mod regular_polygon;
mod relaxed;
mod resultant;
mod ribbon;
mod shape;
mod solid;
mod stiffness;

pub use crate::quadrature::Polygon;
pub use actuation::{Actuated, Actuator, Converging, Helical, PressureChamber, Routing, Tendon};
pub use annulus::Annulus;
pub use check::{AxisRange, Bound, CheckOptions, CheckReport, Derivatives, Moduli, check};
pub use circle::Circle;
pub use composite::Composite;
pub use degree::{QuadratureReport, StrainRange};
pub use effective::EffectiveStiffness;
pub use ellipse::Ellipse;
pub use geometry::{AreaMoments, Geometry, PrincipalAxes};
pub use path::{PathOptions, PathPoint, WrenchPath};
pub use placement::{Rotated, Scaled, Shifted};
pub use point_cloud::PointCloud;
pub use profile::{Linear, Profile};
pub use rectangle::Rectangle;
pub use regular_polygon::RegularPolygon;
pub use relaxed::{
    Deformable, Deformed, Extremes, LadderReport, LadderStep, Relaxation, Relaxed, SectionPoint, Warping,
};
pub use resultant::{Resultant, Resultants};
pub use ribbon::Ribbon;
pub use shape::{Affine, Shape};
pub use solid::Section;
pub use stiffness::Stiffness;

use nalgebra::Matrix6;

use crate::error::Result;
use crate::lie::{Strain, Wrench};
use crate::material::{Active, Request, Response, Station};

/// What a rod asks of its section: the response to a strain at a station, in `f64`; it can be made into an object.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a cross-section",
    label = "a rod's body needs a cross-section here",
    note = "build one with `Section::new(shape, material)`, or give the resultants with `Stiffness`"
)]
pub trait CrossSection: Send + Sync {
    /// Energy, wrench, tangent and rate at a station, as far as asked.
    ///
    /// # Errors
    /// [`Error::Inadmissible`](crate::Error::Inadmissible) where the material cannot be strained so;
    /// [`Error::InvalidAt`](crate::Error::InvalidAt) where a size of the section or the strain is not what it must be.
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response>;

    /// As [`respond`](Self::respond) for many stations and strains at once, which what assembles elements wants.
    ///
    /// # Errors
    /// As [`respond`](Self::respond), for the first that fails.
    fn respond_many(
        &self,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        for ((at, strain), out) in sites.iter().zip(out) {
            *out = self.respond(at, strain, request)?;
        }
        Ok(())
    }

    /// As [`respond_many`](Self::respond_many), in the strains alone that are [active](Active), which is what a constrained rod asks for. What is said about
    /// others is not to be relied on; by default they are all differentiated.
    ///
    /// # Errors
    /// As [`respond_many`](Self::respond_many).
    fn respond_active(
        &self,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        let _ = active;
        self.respond_many(sites, request, out)
    }

    /// The strain energy per length U = ∫u dA, J/m.
    ///
    /// # Errors
    /// As [`respond`](Self::respond).
    fn energy(&self, at: &Station, strain: &Strain) -> Result<f64> {
        Ok(self.respond(at, strain, Request::Energy)?.energy)
    }

    /// The internal wrench Ψ = ∫∇u dA: moment in N m, force in N.
    ///
    /// # Errors
    /// As [`respond`](Self::respond).
    #[doc(alias = "Psi")]
    fn wrench(&self, at: &Station, strain: &Strain) -> Result<Wrench> {
        Ok(self.respond(at, strain, Request::Wrench)?.wrench)
    }

    /// The tangent ∂Ψ/∂Δξ, rows and columns (angular, linear).
    ///
    /// # Errors
    /// As [`respond`](Self::respond).
    #[doc(alias = "Psi_der")]
    fn tangent(&self, at: &Station, strain: &Strain) -> Result<Matrix6<f64>> {
        Ok(self.respond(at, strain, Request::Tangent)?.tangent)
    }

    /// Ψ′ = ∂Ψ/∂s at fixed Δξ: what taper, twist and grading add. Moment part in N, force part in N/m.
    ///
    /// # Errors
    /// As [`respond`](Self::respond).
    #[doc(alias = "Psi_prime")]
    fn wrench_rate(&self, at: &Station, strain: &Strain) -> Result<Wrench> {
        Ok(self.respond(at, strain, Request::Rate)?.wrench_rate)
    }

    /// Makes ready for the reference at a station, as by a finer quadrature where that is curved; a body does it for its section.
    ///
    /// # Errors
    /// As [`respond`](Self::respond), and [`Error::NoConvergence`](crate::Error::NoConvergence) where no quadrature resolves the curvature.
    fn adapt_to(&mut self, _at: &Station) -> Result<()> {
        Ok(())
    }

    /// Arc lengths at which the response is not smooth in s, in any order: a mesh wants nodes there. At such an s the response is
    /// that of what lies before.
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }

    /// The same with an [`Actuator`] on it: a tendon, a pressure chamber.
    fn with_actuator(self, actuator: impl Actuator + 'static) -> Actuated<Self>
    where
        Self: Sized,
    {
        Actuated::new(self).with_actuator(actuator)
    }
}

impl CrossSection for Box<dyn CrossSection> {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        (**self).respond(at, strain, request)
    }

    fn respond_many(
        &self,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        (**self).respond_many(sites, request, out)
    }

    fn respond_active(
        &self,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        (**self).respond_active(sites, active, request, out)
    }

    fn adapt_to(&mut self, at: &Station) -> Result<()> {
        (**self).adapt_to(at)
    }

    fn breakpoints(&self) -> Vec<f64> {
        (**self).breakpoints()
    }
}
