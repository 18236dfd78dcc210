//! What a material does in a section, measured: stress at rest, derivatives, moduli, stability, quadrature.

mod report;
mod stability;

use nalgebra::{Matrix6, Vector6};

pub use report::{AxisRange, Bound, CheckReport, Derivatives, Moduli};

use super::shape::Shape;
use crate::error::Result;
use crate::lie::{Strain, Wrench};
use crate::material::{Material, Points, Request, Response, Station};

/// How [`check`] looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckOptions {
    /// Where along the rod, m; 0 by default.
    pub s: f64,
    /// Degree of the quadrature; `None` for that of the law, or 12 where the law is no polynomial.
    pub degree: Option<usize>,
    /// The largest strain looked at; for bending and twist it is that at the rim. 2 by default.
    pub largest_strain: f64,
    /// The strain at the rim at which derivatives and quadrature are judged; 0.2 by default.
    pub sample_strain: f64,
}

impl Default for CheckOptions {
    fn default() -> Self {
        Self { s: 0.0, degree: None, largest_strain: 2.0, sample_strain: 0.2 }
    }
}

/// The degrees the quadrature is tried at.
const DEGREES: [usize; 7] = [2, 4, 8, 12, 16, 24, 32];

/// The degree that stands for the exact integral: twice the largest tried.
const EXACT_DEGREE: usize = 64;

/// The degree the ranges are found with: few points lie far inside the rim and miss what gives way there first.
const RANGE_DEGREE: usize = 32;

/// Questions a material in a shape and reports what it finds; print the report.
///
/// The section is a rigid one, as of a [`Section`](super::Section): the report says so where its E is more than three times its G, which no
/// isotropic solid has. For one that relaxes, [`EffectiveStiffness`](super::EffectiveStiffness) has the moduli.
///
/// ```
/// use hyperrod::material::NeoHookean;
/// use hyperrod::section::{CheckOptions, Circle, check};
///
/// # fn main() -> hyperrod::Result<()> {
/// let report = check(&Circle::new(0.01), &NeoHookean::new(170e3, 400e3)?, &CheckOptions::default())?;
/// assert_eq!(report.rest.to_array(), [0.0; 6]);
/// assert!(report.to_string().contains("free of stress at rest"));
/// // with the λ of a rubber instead, E would be 590 times G
/// let report = check(&Circle::new(0.01), &NeoHookean::new(170e3, 100e6)?, &CheckOptions::default())?;
/// assert!(report.to_string().contains("this section cannot contract"));
/// # Ok(()) }
/// ```
///
/// # Errors
/// If the shape is not admissible, or the material not even at rest.
pub fn check<S: Shape, M: Material>(shape: &S, material: &M, options: &CheckOptions) -> Result<CheckReport> {
    report(shape, material, options)
}

/// As [`check`], compiled once for all laws.
fn report(shape: &dyn Shape, material: &dyn Material, options: &CheckOptions) -> Result<CheckReport> {
    let degree = options.degree.or(material.polynomial_degree()).unwrap_or(12).max(2);
    let probe = |degree| Probe::new(shape, material, options.s, degree);
    let chosen = probe(degree)?;
    let rest = chosen.respond(&Strain::zero(), Request::Tangent)?;
    let sample = chosen.sample(options.sample_strain)?;
    let exact = probe(EXACT_DEGREE)?.respond(&sample, Request::Wrench)?;
    let unit = chosen.unscaled(chosen.tangent(&rest).amax() * options.sample_strain);
    let error = |response: &Response| {
        let difference = (response.wrench - exact.wrench).to_vector();
        difference.component_div(&unit).amax()
    };
    let mut sensitivity = Vec::new();
    for degree in DEGREES {
        let probe = probe(degree)?;
        sensitivity.push((degree, probe.points.len(), error(&probe.respond(&sample, Request::Wrench)?)));
    }
    Ok(CheckReport {
        degree,
        points: chosen.points.len(),
        rest: rest.wrench,
        moduli: chosen.moduli(&rest),
        derivatives: chosen.derivatives(&sample, options.sample_strain)?,
        ranges: stability::ranges(&probe(RANGE_DEGREE)?, options.largest_strain),
        quadrature_error: error(&chosen.respond(&sample, Request::Wrench)?),
        sensitivity,
    })
}

/// A material over the points of one section, with the length that makes moments and forces comparable.
struct Probe<'a> {
    material: &'a dyn Material,
    points: Points,
    at: Station,
    /// Distance of the outermost point from the axis, m.
    length: f64,
}

impl<'a> Probe<'a> {
    fn new(shape: &dyn Shape, material: &'a dyn Material, s: f64, degree: usize) -> Result<Self> {
        let points = shape.place(&shape.rule(degree)?, s)?;
        let radii = points.x.iter().zip(&points.y).map(|(x, y)| x.hypot(*y));
        let length = radii.fold(f64::MIN_POSITIVE, f64::max);
        Ok(Self { material, points, at: Station::straight(s), length })
    }

    fn respond(&self, strain: &Strain, request: Request) -> Result<Response> {
        self.material.integrate(&self.points, &self.at, strain, request)
    }

    /// The strain with the given components, of order one: angular ones times the length are strains at the rim.
    fn strain(&self, components: [f64; 6]) -> Strain {
        Strain::from_array(std::array::from_fn(|i| {
            if i < 3 { components[i] / self.length } else { components[i] }
        }))
    }

    /// What a force of the given size is as a wrench of comparable moments and forces.
    fn unscaled(&self, force: f64) -> Vector6<f64> {
        Vector6::from_fn(|i, _| if i < 3 { force * self.length } else { force })
    }

    /// The tangent with the length taken out: all entries are forces.
    fn tangent(&self, response: &Response) -> Matrix6<f64> {
        let unit = self.unscaled(1.0);
        response.tangent.component_div(&(unit * unit.transpose()))
    }

    fn force(&self, wrench: &Wrench) -> Vector6<f64> {
        wrench.to_vector().component_div(&self.unscaled(1.0))
    }

    /// A mixture of all six strains of the given size, halved until it is admissible.
    fn sample(&self, size: f64) -> Result<Strain> {
        let mut size = size;
        loop {
            let strain = self.strain([0.5, -0.4, 0.7, 0.3, -0.2, 0.3].map(|x| x * size));
            match self.respond(&strain, Request::Tangent) {
                Err(_) if size > 1e-6 => size *= 0.5,
                Err(error) => return Err(error),
                Ok(_) => return Ok(strain),
            }
        }
    }

    fn moduli(&self, rest: &Response) -> Moduli {
        let k = rest.tangent.diagonal();
        let area: f64 = self.points.weight.iter().sum();
        Moduli {
            bending: [k[0], k[1]],
            torsion: k[2],
            shear: [k[3], k[4]],
            axial: k[5],
            young: k[5] / area,
            shear_modulus: 0.5 * (k[3] + k[4]) / area,
        }
    }

    /// Ψ against differences of U, and ∂Ψ/∂Δξ against those of Ψ: central, of fourth order.
    fn derivatives(&self, sample: &Strain, size: f64) -> Result<Derivatives> {
        let response = self.respond(sample, Request::Tangent)?;
        let (force, tangent) = (self.force(&response.wrench), self.tangent(&response));
        // rounding 1e-16/h and truncation h⁴ balance here
        let h = 1e-3 * size;
        let mut slope = Vector6::zeros();
        let mut quotient = Matrix6::zeros();
        for j in 0..6 {
            let mut unit = [0.0; 6];
            unit[j] = h;
            for (multiple, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
                let near = *sample + self.strain(unit.map(|x| x * multiple));
                let near = self.respond(&near, Request::Wrench)?;
                slope[j] += weight * near.energy / (12.0 * h);
                let column = quotient.column(j) + self.force(&near.wrench) * (weight / (12.0 * h));
                quotient.set_column(j, &column);
            }
        }
        let scale = tangent.amax();
        Ok(Derivatives {
            wrench: (slope - force).amax() / (scale * size),
            tangent: (quotient - tangent).amax() / scale,
            asymmetry: (quotient - quotient.transpose()).amax() / scale,
        })
    }
}
