//! Actuators as energies of the strain: tendons, pressure chambers, and whatever else pulls or pushes along the rod.
//!
//! An [`Actuator`] is an energy per length in the whole strain twist ξ = ξ* + Δξ. [`Actuated`] adds it to that of a section, so that wrench,
//! tangent, rate and the conditions at the ends come from the same differentiation as those of the material.

mod differentiate;
mod pressure;
mod routing;
mod tendon;

pub use pressure::PressureChamber;
pub use routing::{Converging, Helical, Routing};
pub use tendon::Tendon;

use super::geometry::{AreaMoments, Geometry};
use super::{CrossSection, Deformable, Deformed};
use crate::error::Result;
use crate::lie::{Strain, Twist};
use crate::material::{Active, Request, Response, Station};
use crate::scalar::Scalar;
use differentiate::Actuation;

/// What acts along a rod by an energy per length of its whole strain twist ξ, J/m.
///
/// ```math
/// \Psi \to \Psi + \frac{\partial U}{\partial \xi}, \qquad
/// \bar A = -\frac{\partial^2 U}{\partial \xi^2}, \qquad
/// \bar B = \mathrm{ad}_\xi^{\mathsf T}\,\frac{\partial U}{\partial \xi} - \frac{\partial^2 U}{\partial s\,\partial \xi}
/// ```
///
/// The first is what the rod sees; Ā and B̄ are the same actuator taken as a load f̄ = −(Ā ξ′ + B̄) on the rod without it.
/// All follow by differentiation in ξ and s. [`Tendon`] and [`PressureChamber`] are two; here is a spring along the axis:
///
/// ```
/// use hyperrod::section::{Actuator, CrossSection, Stiffness};
/// use hyperrod::{Scalar, Twist};
///
/// /// A spring along the axis, unstretched at half the length of the rod.
/// struct Spring(f64);
///
/// impl Actuator for Spring {
///     fn energy<D: Scalar>(&self, xi: &Twist<D>, _s: D) -> D {
///         let stretch = xi.linear.dot(&xi.linear).sqrt() - 0.5;
///         stretch * stretch * (0.5 * self.0)
///     }
/// }
///
/// # fn main() -> hyperrod::Result<()> {
/// let section = Stiffness::diagonal([1.0, 1.0, 0.8, 1e3, 1e3, 3e3])?.with_actuator(Spring(200.0));
/// let at_rest = section.wrench(&hyperrod::material::Station::straight(0.0), &hyperrod::Strain::zero())?;
/// assert!((at_rest.force.z - 100.0).abs() < 1e-12); // pulls the rod together
/// # Ok(()) }
/// ```
pub trait Actuator: Send + Sync {
    /// The energy per length of the reference, J/m.
    fn energy<D: Scalar>(&self, xi: &Twist<D>, s: D) -> D;

    /// Where along the rod the energy is not smooth in s, as at the end of a tendon; at such an s it belongs to what lies before.
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Where the energy is defined, in words for an error message.
    fn domain(&self) -> &'static str {
        "finite"
    }
}

/// A section with actuators on it.
///
/// ```
/// use hyperrod::section::{CrossSection, Stiffness, Tendon};
/// # fn main() -> hyperrod::Result<()> {
/// // two tendons parallel to the axis, 8 mm beside it
/// let finger = Stiffness::diagonal([4e-3, 4e-3, 3e-3, 50.0, 50.0, 150.0])?
///     .with_actuator(Tendon::new([8e-3, 0.0], 1.0)?)
///     .with_actuator(Tendon::new([-8e-3, 0.0], 0.4)?);
/// # let _ = finger; Ok(()) }
/// ```
pub struct Actuated<C> {
    section: C,
    actuators: Vec<Box<dyn Actuation>>,
}

impl<C: CrossSection> Actuated<C> {
    /// A section ready for actuators, without any.
    pub fn new(section: C) -> Self {
        Self { section, actuators: Vec::new() }
    }

    /// The same with another actuator.
    pub fn with_actuator(mut self, actuator: impl Actuator + 'static) -> Self {
        self.actuators.push(Box::new(actuator));
        self
    }

    /// The section without its actuators.
    pub fn section(&self) -> &C {
        &self.section
    }
}

impl<C: CrossSection> CrossSection for Actuated<C> {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        let mut total = self.section.respond(at, strain, request)?;
        for actuator in &self.actuators {
            total += actuator.respond(at, strain, request)?;
        }
        Ok(total)
    }

    fn respond_many(
        &self,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        self.respond_active(sites, Active::all(), request, out)
    }

    /// The section with all the strains, and then the actuators; one strain at a time where the section refuses one, so that the first of all is named.
    fn respond_active(
        &self,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        if self.section.respond_active(sites, active, request, out).is_err() {
            for ((at, strain), out) in sites.iter().zip(out) {
                *out = self.respond(at, strain, request)?;
            }
            return Ok(());
        }
        for ((at, strain), out) in sites.iter().zip(out) {
            for actuator in &self.actuators {
                *out += actuator.respond_active(at, strain, active, request)?;
            }
        }
        Ok(())
    }

    fn adapt_to(&mut self, at: &Station) -> Result<()> {
        self.section.adapt_to(at)
    }

    fn breakpoints(&self) -> Vec<f64> {
        let mut all = self.section.breakpoints();
        all.extend(self.actuators.iter().flat_map(|actuator| actuator.breakpoints()));
        all
    }
}

/// Actuators weigh nothing: the geometry is that of the section.
impl<C: Deformable> Deformable for Actuated<C> {
    fn deformed(&self, at: &Station, strain: &Strain) -> Result<Deformed<'_>> {
        self.section.deformed(at, strain)
    }
}

impl<C: Geometry> Geometry for Actuated<C> {
    fn moments(&self, s: f64) -> Result<AreaMoments> {
        self.section.moments(s)
    }

    fn weighted_moments(&self, s: f64) -> Result<AreaMoments> {
        self.section.weighted_moments(s)
    }

    fn weighted_third_moments(&self, s: f64) -> Result<[f64; 4]> {
        self.section.weighted_third_moments(s)
    }
}

impl<C: std::fmt::Debug> std::fmt::Debug for Actuated<C> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Actuated")
            .field("section", &self.section)
            .field("actuators", &self.actuators.len())
            .finish()
    }
}
