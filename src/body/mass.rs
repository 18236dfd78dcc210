use super::Body;
use crate::error::{Error, Result};
use crate::material::Station;
use crate::section::{CrossSection, Geometry};

/// No mass: what a body has until a scene needs one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Massless;

/// A density of the reference, kg/m³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Density(f64);

/// A mass per length of the reference, kg/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineDensity(f64);

fn positive(quantity: &'static str, value: f64) -> Result<f64> {
    if value > 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(Error::Invalid { quantity, value, requirement: "positive and finite" })
}

impl Density {
    pub(super) fn new(density: f64) -> Result<Self> {
        Ok(Self(positive("density", density)?))
    }
}

impl LineDensity {
    pub(super) fn new(mass: f64) -> Result<Self> {
        Ok(Self(positive("mass per length", mass)?))
    }
}

/// The mass of a slice of the rod, per length of the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineMass {
    /// Mass per length ∫ρ dV/ds, kg/m.
    pub mass: f64,
    /// First moments (∫ρx dV/ds, ∫ρy dV/ds), kg: mass per length times the place of its centre in the section.
    pub first: [f64; 2],
}

/// How a body's mass per length follows from its section.
#[diagnostic::on_unimplemented(
    message = "this body has no mass",
    label = "a mass is needed here",
    note = "give the body one: `Body::new(length, section)?.with_density(kg_per_m3)?`"
)]
pub trait MassModel<C>: Send + Sync {
    /// Mass and first moments per length of the reference at a station.
    ///
    /// # Errors
    /// As [`Geometry::moments`].
    fn line_mass(&self, section: &C, at: &Station) -> Result<LineMass>;
}

impl<C: Geometry> MassModel<C> for Density {
    /// ```math
    /// \int \rho\,(1, x, y)\, j\,dA, \qquad j = \nu^*_z + \omega^*_x y - \omega^*_y x
    /// ```
    ///
    /// A slice of a curved body is thicker on the outside: j is the volume per dA ds.
    fn line_mass(&self, section: &C, at: &Station) -> Result<LineMass> {
        let m = section.weighted_moments(at.s)?;
        let (xi, density) = (&at.reference.twist, self.0);
        let (nu, x_rate, y_rate) = (xi.linear.z, -xi.angular.y, xi.angular.x);
        let [first_x, first_y] = m.first;
        Ok(LineMass {
            mass: density * (nu * m.area + x_rate * first_x + y_rate * first_y),
            first: [
                density * (nu * first_x + x_rate * m.i_y + y_rate * m.i_xy),
                density * (nu * first_y + x_rate * m.i_xy + y_rate * m.i_x),
            ],
        })
    }
}

impl<C> MassModel<C> for LineDensity {
    /// On the axis: a section known by its stiffness has no other place for it.
    fn line_mass(&self, _section: &C, _at: &Station) -> Result<LineMass> {
        Ok(LineMass { mass: self.0, first: [0.0; 2] })
    }
}

/// A body that knows its mass per length: what gravity requires.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no mass, and this load needs one",
    label = "needs a body with mass",
    note = "give the body a density: `Body::new(length, section)?.with_density(kg_per_m3)?`"
)]
pub trait HasMass {
    /// Mass and first moments per length of the reference at s.
    ///
    /// # Errors
    /// Where a size of the section is not what it must be.
    fn line_mass(&self, s: f64) -> Result<LineMass>;

    /// Mass per length of the reference at s, kg/m.
    ///
    /// # Errors
    /// As [`line_mass`](Self::line_mass).
    fn mass_per_length(&self, s: f64) -> Result<f64> {
        Ok(self.line_mass(s)?.mass)
    }
}

impl<C: CrossSection, M: MassModel<C>> HasMass for Body<C, M> {
    fn line_mass(&self, s: f64) -> Result<LineMass> {
        self.mass.line_mass(&self.section, &self.station(s))
    }
}
