use crate::error::{Error, Result};
use crate::lie::{Strain, Wrench};
use crate::material::{Active, Material, Points, Request, Response, Station, check_strain};

/// The response of a section whose energy is quadratic in the strain and the same at every s: integrated once, at rest.
///
/// U = U₀ + Ψ₀·Δξ + ½ Δξᵀ K Δξ, Ψ = Ψ₀ + K Δξ, Ψ′ = 0.
#[derive(Clone, Debug)]
pub(super) struct Quadratic {
    rest: Response,
    /// Whether J > 0 is required at the points.
    local: bool,
}

impl Quadratic {
    /// Of a material on points that do not move; `None` where its energy is not quadratic or not known to be the same at every s.
    pub(super) fn of(material: &dyn Material, points: &Points) -> Result<Option<Self>> {
        if !(material.polynomial_degree().is_some_and(|d| d <= 2) && material.is_uniform()) {
            return Ok(None);
        }
        let rest = material.integrate(points, &Station::straight(0.0), &Strain::zero(), Request::Tangent)?;
        Ok(Some(Self { rest, local: material.is_local() }))
    }

    /// Whether it holds at this station: a local law on a curved reference is no polynomial in the strain.
    #[inline]
    pub(super) fn holds(&self, at: &Station) -> bool {
        !(self.local && at.reference.is_curved())
    }

    #[inline]
    pub(super) fn respond(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let (energy, wrench) = self.terms(points, at, strain)?;
        Ok(match request {
            Request::Energy => Response { energy, ..Response::zero() },
            Request::Wrench => Response { energy, wrench, ..Response::zero() },
            Request::Tangent | Request::Rate => {
                Response { energy, wrench, tangent: self.rest.tangent, wrench_rate: Wrench::zero() }
            }
        })
    }

    /// Writes what is asked for in the strains that are active; the rest of wrench and tangent is left as it is.
    #[inline]
    pub(super) fn answer(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        active: Active,
        request: Request,
        out: &mut Response,
    ) -> Result<()> {
        let (energy, wrench) = self.terms(points, at, strain)?;
        out.energy = energy;
        out.wrench_rate = Wrench::zero();
        let wrench = (request >= Request::Wrench).then_some(&wrench);
        active.write(wrench, (request >= Request::Tangent).then_some(&self.rest.tangent), out);
        Ok(())
    }

    /// Energy and wrench.
    #[inline(always)]
    fn terms(&self, points: &Points, at: &Station, strain: &Strain) -> Result<(f64, Wrench)> {
        let (v, n) = (strain.angular, strain.linear);
        let mut smallest = f64::INFINITY;
        if self.local {
            for (x, y) in points.x.iter().zip(&points.y) {
                smallest = smallest.min(1.0 + n.z + v.x * y - v.y * x);
            }
        }
        let slope = Wrench::from_vector(&(self.rest.tangent * strain.to_vector()));
        let energy = self.rest.energy + strain.pair(&self.rest.wrench) + 0.5 * strain.pair(&slope);
        if !(smallest > 0.0 && energy.is_finite()) {
            return Err(inadmissible(points, at, strain));
        }
        Ok((energy, self.rest.wrench + slope))
    }
}

/// Names the strain that is not finite, or the point that is turned inside out.
fn inadmissible(points: &Points, at: &Station, strain: &Strain) -> Error {
    if let Err(error) = check_strain(strain, at.s) {
        return error;
    }
    let (v, n) = (strain.angular, strain.linear);
    let j = |x: f64, y: f64| 1.0 + n.z + v.x * y - v.y * x;
    let turned = points.x.iter().zip(&points.y).find(|&(&x, &y)| !(j(x, y) > 0.0));
    let (x, y) = turned.map_or((0.0, 0.0), |(&x, &y)| (x, y));
    let (quantity, value) = match turned {
        Some(_) => ("J", j(x, y)),
        None => ("energy per length", f64::INFINITY),
    };
    let requirement = if turned.is_some() { "positive" } else { "finite" };
    Error::Inadmissible { quantity, value, requirement, s: at.s, x, y }
}
