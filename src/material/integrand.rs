use super::active::Active;
use super::integrate::Site;
use super::law::Sectional;
use super::response::{Points, Request, Response, Station};
use super::task::{Many, Task};
use crate::error::Result;
use crate::lie::Strain;

/// What a section asks of its material: the integral of an energy density and of its derivatives.
///
/// Every law is one, at whichever level and in whichever way it was written; the trait can be made into an object, so
/// materials can be boxed and mixed.
pub trait Material: Send + Sync {
    /// U = ∫u dA, Ψ = ∫∇u dA, ∂Ψ/∂Δξ and Ψ′ over the given points, as far as asked.
    ///
    /// # Errors
    /// [`Error::Inadmissible`](crate::Error::Inadmissible) where a point is turned inside out (J ≤ 0) or leaves the law's domain;
    /// [`Error::InvalidAt`](crate::Error::InvalidAt) where the strain is not finite.
    fn integrate(&self, points: &Points, at: &Station, strain: &Strain, request: Request)
    -> Result<Response>;

    /// As [`integrate`](Self::integrate) for many strains on the same points: a lane a strain, which saves the sums over the lanes.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), for the first strain that fails.
    fn integrate_many(
        &self,
        points: &Points,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        for ((at, strain), out) in sites.iter().zip(out) {
            *out = self.integrate(points, at, strain, request)?;
        }
        Ok(())
    }

    /// As [`integrate_many`](Self::integrate_many), in the strains alone that are [active](Active). What is said about others is not to be relied on; by
    /// default they are all differentiated.
    ///
    /// # Errors
    /// As [`integrate_many`](Self::integrate_many).
    fn integrate_active(
        &self,
        points: &Points,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        let _ = active;
        self.integrate_many(points, sites, request, out)
    }

    /// The degree of the energy density as a polynomial in the strain, x and y; `None` where it is not one.
    fn polynomial_degree(&self) -> Option<usize>;

    /// Whether the energy density is the same at every s.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Whether J > 0 is required and the volume of a curved reference accounted for: all but the [`Sectional`] laws.
    fn is_local(&self) -> bool {
        true
    }

    /// Whether the energy density is one of the deformation at the point and the same everywhere in a section, so that points that are deformed alike may be
    /// taken together.
    fn is_homogeneous(&self) -> bool {
        false
    }
}

impl<L: Sectional> Material for L {
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        self.perform(&mut Task::one(Site { points, at, strain }, request))
    }

    fn integrate_many(
        &self,
        points: &Points,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        self.integrate_active(points, sites, Active::all(), request, out)
    }

    fn integrate_active(
        &self,
        points: &Points,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        self.perform(&mut Task::many(Many { points, sites, active, request, out })).map(|_| ())
    }

    fn polynomial_degree(&self) -> Option<usize> {
        Sectional::degree(self)
    }

    fn is_uniform(&self) -> bool {
        Sectional::is_uniform(self)
    }

    fn is_local(&self) -> bool {
        Sectional::is_local(self)
    }

    fn is_homogeneous(&self) -> bool {
        Sectional::is_homogeneous(self)
    }
}

impl Material for Box<dyn Material> {
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        (**self).integrate(points, at, strain, request)
    }

    fn integrate_many(
        &self,
        points: &Points,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        (**self).integrate_many(points, sites, request, out)
    }

    fn integrate_active(
        &self,
        points: &Points,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        (**self).integrate_active(points, sites, active, request, out)
    }

    fn polynomial_degree(&self) -> Option<usize> {
        (**self).polynomial_degree()
    }

    fn is_uniform(&self) -> bool {
        (**self).is_uniform()
    }

    fn is_local(&self) -> bool {
        (**self).is_local()
    }

    fn is_homogeneous(&self) -> bool {
        (**self).is_homogeneous()
    }
}
