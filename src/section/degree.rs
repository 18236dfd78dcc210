//! Which degree of quadrature a section needs: for a law that is no polynomial, or about a reference that is curved.

use super::shape::Shape;
use crate::error::{Error, Result, positive};
use crate::lie::Strain;
use crate::material::{Material, Points, Request, Response, Station};

/// The strains a quadrature is to be good for, at one station of the rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainRange {
    /// Largest axial strain |e| = |J − 1| anywhere in the section, from bending and stretch together.
    pub axial: f64,
    /// Largest shear strain |(a, b)| anywhere in the section, from twist and shear together.
    pub shear: f64,
    /// Where the section is looked at, and about which reference.
    pub at: Station,
}

impl Default for StrainRange {
    /// 30 % each way, about a straight reference at s = 0.
    fn default() -> Self {
        Self { axial: 0.3, shear: 0.3, at: Station::straight(0.0) }
    }
}

/// How well a section integrates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadratureReport {
    /// Degree of the polynomials in (x, y) that are integrated exactly.
    pub degree: usize,
    /// Number of points.
    pub points: usize,
    /// Estimated error of Ψ and ∂Ψ/∂Δξ, relative to the largest of their entries (lengths measured by the section's radius).
    pub estimated_error: f64,
    /// Whether that is within the tolerance asked for.
    pub reached: bool,
}

impl StrainRange {
    /// Strains that reach the limits in bending, twist, stretch and shear, alone and together, on a section of radius r.
    pub(super) fn samples(&self, r: f64) -> [Strain; 6] {
        let (k, t) = (self.axial / r, self.shear / r);
        let (e, g) = (self.axial, self.shear);
        [
            [k, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, k, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, t, 0.0, 0.0, e],
            [-0.45 * k, 0.6 * k, 0.5 * t, 0.3 * g, -0.4 * g, 0.25 * e],
            [0.6 * k, 0.45 * k, -t, 0.0, 0.0, -0.25 * e],
            [0.28 * k, -0.96 * k, 0.75 * t, -0.15 * g, 0.2 * g, 0.0],
        ]
        .map(Strain::from_array)
    }

    pub(super) fn check(&self) -> Result<()> {
        for (quantity, value) in
            [("axial strain of a range", self.axial), ("shear strain of a range", self.shear)]
        {
            positive(quantity, value)?;
        }
        Ok(())
    }
}

/// A shape and a material looked at through the samples of a [`StrainRange`].
pub(super) struct Probe<'a> {
    shape: &'a dyn Shape,
    material: &'a dyn Material,
    at: Station,
    radius: f64,
    samples: [Strain; 6],
}

/// Degree of the rule whose outermost point tells a section's radius, within 1 % of a circle's.
const OUTERMOST: usize = 31;
/// The degrees tried while looking for one that is fine enough, each twice the one before.
const COARSEST: usize = 6;
/// 6 · 2⁴ and some: a law that is smooth over the range needs no more, one with a kink is not served by more.
const FINEST: usize = 96;

impl<'a> Probe<'a> {
    pub(super) fn new(shape: &'a dyn Shape, material: &'a dyn Material, range: &StrainRange) -> Result<Self> {
        range.check()?;
        let points = shape.place(&shape.rule(OUTERMOST.min(shape.max_degree()))?, range.at.s)?;
        let radius = points.x.iter().zip(&points.y).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
        Ok(Self { shape, material, at: range.at, radius, samples: range.samples(radius) })
    }

    fn responses(&self, points: &Points) -> Result<Vec<Response>> {
        let respond = |strain| self.material.integrate(points, &self.at, strain, Request::Tangent);
        self.samples.iter().map(respond).collect()
    }

    fn at_degree(&self, degree: usize) -> Result<Vec<Response>> {
        self.responses(&self.shape.place(&self.shape.rule(degree)?, self.at.s)?)
    }

    /// The largest difference over the samples, in Ψ relative to Ψ and in ∂Ψ/∂Δξ relative to ∂Ψ/∂Δξ.
    fn difference(&self, one: &[Response], other: &[Response]) -> f64 {
        let length = |i: usize| if i < 3 { self.radius } else { 1.0 };
        one.iter().zip(other).fold(0.0, |worst, (p, q)| {
            let (psi, exact) = (p.wrench.to_array(), q.wrench.to_array());
            let (mut error, mut scale) = ([0.0_f64; 2], [0.0_f64; 2]);
            for i in 0..6 {
                error[0] = error[0].max((psi[i] - exact[i]).abs() / length(i));
                scale[0] = scale[0].max(exact[i].abs() / length(i));
                for j in 0..6 {
                    let unit = length(i) * length(j);
                    error[1] = error[1].max((p.tangent[(i, j)] - q.tangent[(i, j)]).abs() / unit);
                    scale[1] = scale[1].max(q.tangent[(i, j)].abs() / unit);
                }
            }
            (0..2).fold(worst, |worst, k| if scale[k] > 0.0 { worst.max(error[k] / scale[k]) } else { worst })
        })
    }

    /// Responses fine enough to measure others by: the first of two in a row, doubling the degree, that agree.
    fn fine(&self, tolerance: f64, from: usize) -> Result<(usize, Vec<Response>)> {
        let limit = self.shape.max_degree().min(FINEST);
        let mut degree = from.max(COARSEST).min(limit);
        let mut coarse = self.at_degree(degree)?;
        let mut difference = f64::INFINITY;
        let mut rounds = 0;
        while degree < limit {
            let next = (2 * degree).min(limit);
            let fine = self.at_degree(next)?;
            difference = self.difference(&coarse, &fine);
            rounds += 1;
            if difference <= tolerance {
                return Ok((degree, fine));
            }
            (degree, coarse) = (next, fine);
        }
        if limit < FINEST {
            return Ok((limit, coarse)); // a section given by points is no finer than they are
        }
        let what = "choice of a quadrature degree (try a larger tolerance or a smaller range of strains)";
        Err(Error::NoConvergence { what, iterations: rounds, residual: difference })
    }

    /// The smallest degree from `least` on whose error is within the tolerance, by bisection.
    pub(super) fn smallest_degree(&self, tolerance: f64, least: usize) -> Result<usize> {
        let (mut high, fine) = self.fine(tolerance, least)?;
        let mut low = least;
        while low < high {
            let middle = low + (high - low) / 2;
            let error = self.difference(&self.at_degree(middle)?, &fine);
            (low, high) = if error <= tolerance { (low, middle) } else { (middle + 1, high) };
        }
        Ok(low)
    }

    /// The error of a rule, measured by one of about twice its degree, or the finest there is.
    pub(super) fn error_of(&self, points: &Points, degree: usize) -> Result<f64> {
        let finer = (2 * degree + 2).max(COARSEST).min(self.shape.max_degree());
        Ok(self.difference(&self.responses(points)?, &self.at_degree(finer)?))
    }
}
