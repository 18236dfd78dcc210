use std::f64::consts::TAU;

use crate::error::Result;

use super::line::{LineRule, gauss_legendre, gauss_radau};
use super::rule::{Rule, check_degree, invalid};

/// A point of a [`PolarRule`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolarPoint {
    /// Squared radius, from 0 at the inner circle to 1 at the outer one.
    pub t: f64,
    /// Cosine of the polar angle.
    pub cos: f64,
    /// Sine of the polar angle.
    pub sin: f64,
    /// Weight per Rₒ² − Rᵢ²; they add up to π.
    pub weight: f64,
}

/// A quadrature rule for a disk or annulus of any radii, in a form smooth in the radii.
///
/// ```math
/// r_i = \sqrt{R_i^2 + t_i (R_o^2 - R_i^2)}, \qquad (x_i, y_i) = r_i (\cos\theta_i, \sin\theta_i), \qquad
/// w_i = (R_o^2 - R_i^2) \, \tilde w_i
/// ```
///
/// t, θ and w̃ do not depend on the radii: a section whose radii vary along a rod differentiates these three lines and
/// has moving points that stay exact.
#[derive(Debug, Clone, PartialEq)]
pub struct PolarRule {
    points: Vec<PolarPoint>,
    degree: usize,
}

impl PolarRule {
    /// The points, in the reference form.
    pub fn points(&self) -> &[PolarPoint] {
        &self.points
    }

    /// The total degree of the polynomials in (x, y) the rule integrates exactly.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The rule between the radii `inner` ≥ 0 and `outer` > `inner`.
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) when the radii are not finite, negative or not increasing.
    pub fn at(&self, inner: f64, outer: f64) -> Result<Rule> {
        if !(inner >= 0.0 && inner.is_finite()) {
            return Err(invalid("inner radius", inner, "finite and not negative"));
        }
        if !(outer > inner && outer.is_finite()) {
            return Err(invalid("outer radius", outer, "finite and larger than the inner radius"));
        }
        // (Rₒ − Rᵢ)(Rₒ + Rᵢ) keeps a thin wall's area to the last digit; so does r for radii of any size.
        let ring = (outer - inner) * (outer + inner);
        let ratio = inner / outer;
        let points = self.points.iter().map(|p| {
            let r = outer * (p.t + (1.0 - p.t) * ratio * ratio).sqrt();
            (r * p.cos, r * p.sin, ring * p.weight)
        });
        Rule::from_points(points, self.degree)
    }

    /// Rings of `angles` points at the nodes of a rule in t on [0, 1], a node at t = 0 being one point.
    fn product(rings: &LineRule, angles: usize, degree: usize) -> Self {
        let mut points = Vec::with_capacity(rings.len() * angles);
        for (t, w) in rings.iter() {
            if t == 0.0 {
                points.push(PolarPoint { t, cos: 1.0, sin: 0.0, weight: 0.5 * TAU * w });
            } else {
                push_ring(&mut points, angles, 0.0, t, 0.5 * TAU * w / angles as f64);
            }
        }
        Self { points, degree }
    }
}

/// The centred disk of radius 1, exact to a total degree; [`Rule::scaled`] makes it an ellipse.
///
/// Over the angle, M = d + 1 equispaced points are exact to degree d. What is left is a polynomial of degree
/// q = ⌊d/2⌋ in t = r², integrated by Gauss–Legendre when q is odd and by Gauss–Radau with one point at the centre when
/// q is even: ⌈q/2⌉ (d + 1) points, and the centre. Degrees 6 and 7 share 12 points, Stroud (1971), S₂:7-1.
///
/// | degree | 1 | 2 | 3 | 4 | 5 | 6, 7 | 8 | 9 | 10 |
/// |---|---|---|---|---|---|---|---|---|---|
/// | points | 1 | 3 | 4 | 6 | 7 | 12 | 19 | 21 | 33 |
///
/// # Errors
/// [`Error::Invalid`](crate::Error::Invalid) when the degree is above [`MAX_DEGREE`](super::MAX_DEGREE).
///
/// ```
/// let disk = hyperrod::quadrature::disk(4)?;
/// let moment: f64 = disk.iter().map(|(x, _, w)| w * x.powi(4)).sum();
/// assert_eq!(disk.len(), 6);
/// assert!((moment - std::f64::consts::PI / 8.0).abs() < 1e-15);
/// # Ok::<(), hyperrod::Error>(())
/// ```
pub fn disk(degree: usize) -> Result<Rule> {
    check_degree(degree)?;
    let degree = degree.max(1);
    let q = degree / 2;
    let rule = match degree {
        6 | 7 => twelve_points(),
        _ if q % 2 == 1 => {
            PolarRule::product(&gauss_legendre(q.div_ceil(2))?.on(0.0, 1.0)?, degree + 1, degree)
        }
        _ => PolarRule::product(&gauss_radau(q / 2 + 1)?.on(0.0, 1.0)?, degree + 1, degree),
    };
    rule.at(0.0, 1.0)
}

/// The centred annulus, exact to a total degree for any two radii.
///
/// As [`disk`], with Gauss–Legendre in t throughout since an annulus has no centre: ⌈(q + 1)/2⌉ (d + 1) points.
///
/// ```
/// use std::f64::consts::PI;
///
/// let tube = hyperrod::quadrature::annulus(2)?.at(0.9, 1.0)?;
/// let inertia: f64 = tube.iter().map(|(_, y, w)| w * y * y).sum();
/// assert!((inertia - PI / 4.0 * (1.0 - 0.9f64.powi(4))).abs() < 1e-15);
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`](crate::Error::Invalid) when the degree is above [`MAX_DEGREE`](super::MAX_DEGREE).
pub fn annulus(degree: usize) -> Result<PolarRule> {
    check_degree(degree)?;
    let rings = gauss_legendre((degree / 2 + 1).div_ceil(2))?.on(0.0, 1.0)?;
    Ok(PolarRule::product(&rings, degree + 1, degree))
}

/// Stroud (1971), S₂:7-1: three squares of points, in closed form.
fn twelve_points() -> PolarRule {
    let root = 29f64.sqrt();
    let mut points = Vec::with_capacity(12);
    let pi = 0.5 * TAU;
    push_ring(&mut points, 4, 0.0, 3.0 / 4.0, pi * 2.0 / 27.0);
    for sign in [-1.0, 1.0] {
        let t = (27.0 + sign * 3.0 * root) / 52.0;
        push_ring(&mut points, 4, 0.125, t, pi * (551.0 - sign * 41.0 * root) / 6264.0);
    }
    PolarRule { points, degree: 7 }
}

/// Appends `angles` equispaced points, the first at `phase` turns.
fn push_ring(points: &mut Vec<PolarPoint>, angles: usize, phase: f64, t: f64, weight: f64) {
    points.extend((0..angles).map(|k| {
        let (sin, cos) = (TAU * (phase + k as f64 / angles as f64)).sin_cos();
        PolarPoint { t, cos, sin, weight }
    }));
}
