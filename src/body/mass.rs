use super::Body;
use crate::error::{Error, Result};
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

/// How a body's mass per length follows from its section.
#[diagnostic::on_unimplemented(
    message = "this body has no mass",
    label = "a mass is needed here",
    note = "give the body one: `Body::new(length, section)?.with_density(kg_per_m3)?`"
)]
pub trait MassModel<C>: Send + Sync {
    /// Mass per length of the reference at s, kg/m.
    ///
    /// # Errors
    /// As [`Geometry::moments`].
    fn mass_per_length(&self, section: &C, s: f64) -> Result<f64>;
}

impl<C: Geometry> MassModel<C> for Density {
    fn mass_per_length(&self, section: &C, s: f64) -> Result<f64> {
        Ok(self.0 * section.moments(s)?.area)
    }
}

impl<C> MassModel<C> for LineDensity {
    fn mass_per_length(&self, _section: &C, _s: f64) -> Result<f64> {
        Ok(self.0)
    }
}

/// A body that knows its mass per length: what gravity requires.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no mass, and this load needs one",
    label = "needs a body with mass",
    note = "give the body a density: `Body::new(length, section)?.with_density(kg_per_m3)?`"
)]
pub trait HasMass {
    /// Mass per length of the reference at s, kg/m.
    ///
    /// # Errors
    /// Where a size of the section is not what it must be.
    fn mass_per_length(&self, s: f64) -> Result<f64>;
}

impl<C: CrossSection, M: MassModel<C>> HasMass for Body<C, M> {
    fn mass_per_length(&self, s: f64) -> Result<f64> {
        self.mass.mass_per_length(&self.section, s)
    }
}
