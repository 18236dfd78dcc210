use std::borrow::Cow;

use nalgebra::{DVector, Matrix3};

use super::assembly::{column, times};
use super::modes::Modes;
use super::pressure;
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::material::{GradientBatch, GradientLaw, GradientState, Points, Request, Station};
use crate::section::CrossSection;

/// A section that shows its points: those of a rigid [`Section`](crate::section::Section) move with its plane, those of a
/// [`Relaxed`](super::Relaxed) one also within it. The law must be one of the deformation.
///
/// ```
/// use hyperrod::Strain;
/// use hyperrod::material::{NeoHookean, Station};
/// use hyperrod::section::{Circle, Deformable, Relaxed, Section, Warping};
/// # fn main() -> hyperrod::Result<()> {
/// let rubber = NeoHookean::from_young(1e6, 0.45)?;
/// let mut strain = Strain::zero();
/// strain.linear.z = 0.5;
/// let at = Station::straight(0.0);
/// let across = |section: &dyn Deformable| -> hyperrod::Result<f64> {
///     let centre = section.deformed(&at, &strain)?.point(0.0, 0.0)?;
///     Ok(centre.cauchy()[(0, 0)] / centre.cauchy()[(2, 2)])
/// };
/// assert!(across(&Section::new(Circle::new(0.01), rubber)?)? > 0.5); // a rigid section holds its sides by force
/// assert!(across(&Relaxed::new(Circle::new(0.01), rubber)?)?.abs() < 1e-6);
/// # Ok(()) }
/// ```
#[diagnostic::on_unimplemented(
    message = "the points of `{Self}` have no deformation and no stress",
    note = "`Section` and `Relaxed` show their points where their law is one of the deformation (`Local` or `Isotropic`)"
)]
pub trait Deformable: CrossSection {
    /// The section at a strain, to be looked at point by point.
    ///
    /// # Errors
    /// As [`CrossSection::respond`].
    fn deformed(&self, at: &Station, strain: &Strain) -> Result<Deformed<'_>>;
}

/// A section at a strain, to be looked at point by point: where its points went, and what they bear.
#[derive(Clone)]
pub struct Deformed<'a> {
    pub(super) modes: Cow<'a, Modes>,
    pub(super) law: &'a dyn GradientLaw,
    pub(super) at: Station,
    pub(super) strain: Strain,
    /// The coefficients of the displacement.
    pub(super) coefficients: DVector<f64>,
    pub(super) pressures: Vec<f64>,
}

/// A point of a deformed section, in the frame of the section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionPoint {
    /// Where it was, (x, y), m.
    pub reference: [f64; 2],
    /// Where it is, m: the third component is its warping along the rod.
    pub position: [f64; 3],
    /// Deformation gradient F.
    pub gradient: Matrix3<f64>,
    /// First Piola stress P = ∂u/∂F, Pa; its third column is the traction on the section.
    pub piola: Matrix3<f64>,
    /// Energy density u, J/m³.
    pub energy_density: f64,
}

impl SectionPoint {
    /// Cauchy's stress σ = P Fᵀ / J, Pa.
    pub fn cauchy(&self) -> Matrix3<f64> {
        self.piola * self.gradient.transpose() / self.gradient.determinant()
    }

    /// The largest principal stretch.
    pub fn largest_stretch(&self) -> f64 {
        self.gradient.singular_values().max()
    }

    /// Von Mises' equivalent of Cauchy's stress, Pa.
    pub fn von_mises(&self) -> f64 {
        let cauchy = self.cauchy();
        let deviator = cauchy - Matrix3::identity() * (cauchy.trace() / 3.0);
        (1.5 * deviator.norm_squared()).sqrt()
    }
}

/// The points of a section with the largest stretch and the largest stress, among those of the quadrature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Where the largest principal stretch is.
    pub stretch: SectionPoint,
    /// Where von Mises' stress is largest.
    pub stress: SectionPoint,
}

impl Deformed<'_> {
    /// The state of any point (x, y), m.
    ///
    /// # Errors
    /// [`Error::Inadmissible`] where the displacement, continued to that point, turns it inside out or leaves the law's domain.
    pub fn point(&self, x: f64, y: f64) -> Result<SectionPoint> {
        let modes = &*self.modes;
        let [e_x, e_y, w] = modes.at(x, y, &self.coefficients);
        let (xi, strain) = (self.at.reference.twist.to_array(), self.strain.to_array());
        let omega: [f64; 3] = std::array::from_fn(|i| xi[i] + strain[i]);
        let [g_0, g_1, j] = column(&xi, x, y);
        let (third, turned) = (column(&strain, x, y), times(&omega, &w));
        let mut h = [0.0; 9];
        for i in 0..3 {
            h[3 * i] = e_x[i];
            h[3 * i + 1] = e_y[i];
            h[3 * i + 2] = (third[i] + turned[i] - g_0 * e_x[i] - g_1 * e_y[i]) / j;
        }
        let points = Points { x: vec![x], y: vec![y], weight: vec![1.0], rates: None };
        let mut state = GradientState::default();
        let batch = GradientBatch { points: &points, s: self.at.s, h: &h };
        let smallest = self.law.evaluate(batch, Request::Tangent, &mut state);
        let s = self.at.s;
        if !(smallest > 0.0) {
            return Err(Error::Inadmissible {
                quantity: "J",
                value: smallest,
                requirement: "positive",
                s,
                x,
                y,
            });
        }
        let energy_density = state.energy[0];
        if !energy_density.is_finite() {
            let (quantity, requirement) = ("energy density", self.law.domain());
            return Err(Error::Inadmissible { quantity, value: energy_density, requirement, s, x, y });
        }
        let mut piola = Matrix3::from_row_slice(&state.stress);
        if !self.pressures.is_empty() {
            let values = modes.space.at(x, y, modes.degree());
            let pressure: f64 = self.pressures.iter().enumerate().map(|(a, p)| p * values[(2, a)]).sum();
            piola -= Matrix3::from_row_slice(&pressure::cofactor(&h).0) * pressure;
        }
        Ok(SectionPoint {
            reference: [x, y],
            position: [x + w[0], y + w[1], w[2]],
            gradient: Matrix3::from_row_slice(&h) + Matrix3::identity(),
            piola,
            energy_density,
        })
    }

    /// The state of every quadrature point, where it is most accurate.
    ///
    /// # Errors
    /// As [`point`](Self::point).
    pub fn points(&self) -> Result<Vec<SectionPoint>> {
        let points = &self.modes.points;
        points.x.iter().zip(&points.y).map(|(&x, &y)| self.point(x, y)).collect()
    }

    /// Where stretch and stress are largest.
    ///
    /// # Errors
    /// As [`point`](Self::point), and [`Error::Invalid`] for a section without points.
    pub fn extremes(&self) -> Result<Extremes> {
        let points = self.points()?;
        let largest = |measure: fn(&SectionPoint) -> f64| {
            points.iter().copied().max_by(|a, b| measure(a).total_cmp(&measure(b)))
        };
        match (largest(SectionPoint::largest_stretch), largest(SectionPoint::von_mises)) {
            (Some(stretch), Some(stress)) => Ok(Extremes { stretch, stress }),
            _ => {
                let quantity = "number of points of a section";
                Err(Error::Invalid { quantity, value: 0.0, requirement: "at least 1" })
            }
        }
    }
}
