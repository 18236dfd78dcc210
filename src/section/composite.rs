use super::CrossSection;
use super::geometry::{AreaMoments, Geometry};
use crate::error::{Result, not_negative};
use crate::lie::Strain;
use crate::material::{Active, Request, Response, Station};

/// Several sections bonded together, each with its own shape and material: a stiff core in a soft sleeve.
///
/// They share one strain, so energies, wrenches, tangents and rates add up. That the parts do not overlap is the caller's care.
///
/// ```
/// use hyperrod::material::{LinearElastic, NeoHookean};
/// use hyperrod::section::{Annulus, Circle, Composite, Geometry, Section};
/// # fn main() -> hyperrod::Result<()> {
/// let core = Section::new(Circle::new(0.5e-3), LinearElastic::new(70e9, 26e9)?)?;
/// let sleeve = Section::new(Annulus::new(0.5e-3, 5e-3), NeoHookean::from_young(1e6, 0.45)?)?;
/// // a body's density is then that of the sleeve
/// let cable = Composite::new(sleeve).with_relative_density(core, 2700.0 / 1100.0)?;
/// assert!((cable.moments(0.0)?.area - std::f64::consts::PI * 25e-6).abs() < 1e-18);
/// # Ok(()) }
/// ```
pub struct Composite {
    parts: Vec<(Box<dyn Part>, f64)>,
}

/// A section that can be one of several: it responds to strains and knows its area.
trait Part: CrossSection + Geometry {}

impl<C: CrossSection + Geometry> Part for C {}

impl Composite {
    /// Of a first part; add the others with [`with`](Self::with).
    pub fn new(section: impl CrossSection + Geometry + 'static) -> Self {
        Self { parts: vec![(Box::new(section), 1.0)] }
    }

    /// The same with another part, as dense as the body's density says.
    pub fn with(mut self, section: impl CrossSection + Geometry + 'static) -> Self {
        self.parts.push((Box::new(section), 1.0));
        self
    }

    /// The same with another part, denser than the body's density by a factor.
    ///
    /// # Errors
    /// If the factor is negative or not finite.
    pub fn with_relative_density(
        mut self,
        section: impl CrossSection + Geometry + 'static,
        factor: f64,
    ) -> Result<Self> {
        not_negative("relative density of a part", factor)?;
        self.parts.push((Box::new(section), factor));
        Ok(self)
    }

    /// How many parts there are.
    pub fn part_count(&self) -> usize {
        self.parts.len()
    }
}

impl CrossSection for Composite {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        let mut total = Response::zero();
        for (part, _) in &self.parts {
            total += part.respond(at, strain, request)?;
        }
        Ok(total)
    }

    /// Part by part, each with all the strains; one strain at a time where a part refuses one, so that the first of all is named.
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
        let count = sites.len().min(out.len());
        let (sites, out) = (&sites[..count], &mut out[..count]);
        let mut totals = vec![Response::zero(); count];
        let mut of_part = totals.clone();
        for (part, _) in &self.parts {
            if part.respond_active(sites, active, request, &mut of_part).is_err() {
                for ((at, strain), out) in sites.iter().zip(out) {
                    *out = self.respond(at, strain, request)?;
                }
                return Ok(());
            }
            totals.iter_mut().zip(&of_part).for_each(|(total, response)| *total += *response);
        }
        out.copy_from_slice(&totals);
        Ok(())
    }

    fn adapt_to(&mut self, at: &Station) -> Result<()> {
        self.parts.iter_mut().try_for_each(|(part, _)| part.adapt_to(at))
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.parts.iter().flat_map(|(part, _)| part.breakpoints()).collect()
    }
}

impl Geometry for Composite {
    fn moments(&self, s: f64) -> Result<AreaMoments> {
        let mut total = AreaMoments::default();
        for (part, _) in &self.parts {
            total += part.moments(s)?;
        }
        Ok(total.without_rounding())
    }

    fn weighted_moments(&self, s: f64) -> Result<AreaMoments> {
        let mut total = AreaMoments::default();
        for (part, factor) in &self.parts {
            total += part.weighted_moments(s)? * *factor;
        }
        Ok(total.without_rounding())
    }

    fn weighted_third_moments(&self, s: f64) -> Result<[f64; 4]> {
        let mut total = [0.0; 4];
        for (part, factor) in &self.parts {
            let third = part.weighted_third_moments(s)?;
            total = std::array::from_fn(|i| total[i] + factor * third[i]);
        }
        Ok(total)
    }
}

impl std::fmt::Debug for Composite {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Composite").field("parts", &self.parts.len()).finish()
    }
}
