use num_dual::DualNum;

use super::profile::Profile;
use super::shape::{Shape, arc_length, finite_size, positive_size, refuse};
use crate::error::Result;
use crate::material::{PointRates, Points};
use crate::quadrature::{self, Rule};

/// A round tube about the axis of the rod, between an inner and an outer radius that may vary independently.
///
/// A = π(Rₒ² − Rᵢ²), I_x = I_y = π(Rₒ⁴ − Rᵢ⁴)/4.
///
/// Its points are those of a unit disk, carried along the radii by the map that keeps areas in proportion:
///
/// ```math
/// r = \sqrt{R_i^2 + t\,(R_o^2 - R_i^2)}, \quad t = \hat x^2 + \hat y^2, \qquad
/// (x, y) = \frac{r}{\sqrt t}\,(\hat x, \hat y), \qquad w = (R_o^2 - R_i^2)\,\hat w ,
/// ```
///
/// smooth in both radii and exact for every pair of them.
///
/// ```
/// use hyperrod::section::{Annulus, Linear};
///
/// let tube = Annulus::new(4e-3, 5e-3);
/// let needle = Annulus::new(0.2e-3, Linear { from: 0.8e-3, to: 0.4e-3, length: 0.1 });
/// # let _ = (tube, needle);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annulus<I = f64, O = f64> {
    inner: I,
    outer: O,
}

impl<I: Profile, O: Profile> Annulus<I, O> {
    /// Between the inner radius, at least zero, and the outer one, m.
    pub fn new(inner: I, outer: O) -> Self {
        Self { inner, outer }
    }
}

impl<I: Profile, O: Profile> Shape for Annulus<I, O> {
    fn rule(&self, degree: usize) -> Result<Rule> {
        quadrature::annulus(degree)?.at(0.0, 1.0)
    }

    fn place(&self, rule: &Rule, s: f64) -> Result<Points> {
        let inner = finite_size("inner radius of the annulus", self.inner.at(arc_length(s)), s)?;
        let outer = positive_size("outer radius of the annulus", self.outer.at(arc_length(s)), s)?;
        if inner.re < 0.0 {
            return refuse("inner radius of the annulus", inner, "not negative", s);
        }
        let wall = positive_size("wall thickness of the annulus", outer - inner, s)?;
        let ring = wall * (outer + inner);
        let hollow = (inner / outer) * (inner / outer);
        let (mut points, mut rates) = (Points::default(), PointRates::default());
        for (x, y, w) in rule.iter() {
            let t = x * x + y * y; // never zero: see `quadrature::annulus`
            let stretch = outer * (hollow * ((1.0 - t) / t) + 1.0).sqrt();
            for (value, (points, rates)) in [stretch * x, stretch * y, ring * w].into_iter().zip([
                (&mut points.x, &mut rates.x),
                (&mut points.y, &mut rates.y),
                (&mut points.weight, &mut rates.weight),
            ]) {
                points.push(value.re);
                rates.push(value.eps);
            }
        }
        points.rates = (!self.is_constant()).then_some(rates);
        Ok(points)
    }

    fn is_constant(&self) -> bool {
        self.inner.is_constant() && self.outer.is_constant()
    }

    fn is_ring(&self) -> bool {
        true
    }
}
