use nalgebra::Matrix6;

use super::CrossSection;
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::material::Station;

/// The stiffnesses a section shows about a strain, each with all other wrenches held, and its centres.
///
/// From the compliance S = (∂Ψ/∂Δξ)⁻¹: what one wrench alone does. Bending, torsion and shear are taken about the centres, so that an
/// axis off the centroid does not show in them.
///
/// ```math
/// EA = \frac{1}{S_{66}}, \quad GJ = \frac{1}{S_{33}}, \quad x_s = -\frac{S_{35}}{S_{33}}, \quad y_s = \frac{S_{34}}{S_{33}}
/// ```
///
/// EI and the centre of tension follow from S as moments and forces about the axis of the rod; EA is that of a force through the centre of
/// tension, and GA_x, GA_y those of forces through the centre of shear.
///
/// ```
/// use hyperrod::Strain;
/// use hyperrod::material::{NeoHookean, Station};
/// use hyperrod::section::{EffectiveStiffness, Rectangle, Relaxed};
/// # fn main() -> hyperrod::Result<()> {
/// let section = Relaxed::new(Rectangle::new(0.02, 0.01), NeoHookean::from_young(1e6, 0.3)?)?;
/// let report = EffectiveStiffness::of(&section, &Station::straight(0.0), &Strain::zero())?;
/// assert!((report.axial / 200.0 - 1.0).abs() < 1e-10); // E A, N
/// assert!((report.shear[0] / (5.0 / 6.0 * 200.0 / 2.6) - 1.0).abs() < 1e-4); // 5/6 G A
/// assert!(report.shear_centre[0].abs() < 1e-12); // m
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectiveStiffness {
    /// EA, N.
    pub axial: f64,
    /// EI_x and EI_y, N m².
    pub bending: [f64; 2],
    /// GJ, N m².
    pub torsion: f64,
    /// GA_x and GA_y, shear factors included, N.
    pub shear: [f64; 2],
    /// Where a transverse force does not twist, m.
    pub shear_centre: [f64; 2],
    /// Where an axial force does not bend, m.
    pub tension_centre: [f64; 2],
    /// ∂Ψ/∂Δξ itself.
    pub tangent: Matrix6<f64>,
}

impl EffectiveStiffness {
    /// Of a section at a station, about a strain.
    ///
    /// # Errors
    /// As [`CrossSection::respond`], and [`Error::Singular`] where the tangent has no inverse, as at a limit point.
    pub fn of(section: &(impl CrossSection + ?Sized), at: &Station, strain: &Strain) -> Result<Self> {
        let tangent = section.tangent(at, strain)?;
        let singular = Error::Singular { matrix: "tangent of the section", s: at.s };
        let compliance = tangent.try_inverse().ok_or(singular)?;
        let c = |i: usize, k: usize| compliance[(i - 1, k - 1)];
        let shear_centre = [-c(3, 5) / c(3, 3), c(3, 4) / c(3, 3)];
        // a force n at (x, y) brings the moments (y n, −x n): curvatures vanish where S₁₁ y − S₁₂ x = −S₁₆, S₁₂ y − S₂₂ x = −S₂₆
        let determinant = c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
        let x = (c(1, 1) * c(2, 6) - c(1, 2) * c(1, 6)) / determinant;
        let y = (c(1, 2) * c(2, 6) - c(2, 2) * c(1, 6)) / determinant;
        let through = |load: [f64; 6]| {
            let load = nalgebra::Vector6::from(load);
            1.0 / load.dot(&(compliance * load))
        };
        Ok(Self {
            axial: through([y, -x, 0.0, 0.0, 0.0, 1.0]),
            bending: [1.0 / c(1, 1), 1.0 / c(2, 2)],
            torsion: 1.0 / c(3, 3),
            shear: [
                through([0.0, 0.0, -shear_centre[1], 1.0, 0.0, 0.0]),
                through([0.0, 0.0, shear_centre[0], 0.0, 1.0, 0.0]),
            ],
            shear_centre,
            tension_centre: [x, y],
            tangent,
        })
    }
}
