use std::fmt;

use crate::error::Error;
use crate::lie::Wrench;

/// The names of the six strains.
const AXES: [&str; 6] = ["omega_x", "omega_y", "omega_z", "nu_x", "nu_y", "nu_z"];

/// E/G = 2 (1 + ν) of an isotropic solid is 3 at most; the rest is room for rounding.
const LARGEST_RATIO: f64 = 3.0 + 1e-6;

/// What [`check`](super::check) found. Its `Display` is meant to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckReport {
    /// Degree of the quadrature.
    pub degree: usize,
    /// Its number of points.
    pub points: usize,
    /// The wrench at rest: zero for a law that is free of stress there.
    pub rest: Wrench,
    /// The stiffnesses at rest.
    pub moduli: Moduli,
    /// How well the derivatives agree with difference quotients.
    pub derivatives: Derivatives,
    /// How far each strain alone can go with a positive definite tangent.
    pub ranges: [AxisRange; 6],
    /// Error of the quadrature in Ψ at the sample strain, relative to the stiffness times that strain.
    pub quadrature_error: f64,
    /// The same for other degrees: (degree, points, error).
    pub sensitivity: Vec<(usize, usize, f64)>,
}

/// The diagonal of ∂Ψ/∂Δξ at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    /// EI about x and y, N m².
    pub bending: [f64; 2],
    /// GJ, N m².
    pub torsion: f64,
    /// GA along x and y, N.
    pub shear: [f64; 2],
    /// EA, N.
    pub axial: f64,
    /// EA/A, Pa.
    pub young: f64,
    /// GA/A, Pa.
    pub shear_modulus: f64,
}

/// Disagreement of automatic derivatives with fourth-order difference quotients, relative to the largest stiffness; about 1e-9 is
/// what the quotients themselves can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// Ψ against U.
    pub wrench: f64,
    /// ∂Ψ/∂Δξ against Ψ.
    pub tangent: f64,
    /// Asymmetry of the quotient of Ψ: whether Ψ has a potential at all.
    pub asymmetry: f64,
}

/// The range of one strain, the others zero, in which ∂Ψ/∂Δξ is positive definite.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisRange {
    /// Which of (ω_x, ω_y, ω_z, ν_x, ν_y, ν_z).
    pub axis: usize,
    /// Towards negative strain.
    pub lower: Bound,
    /// Towards positive strain.
    pub upper: Bound,
    /// What divides the strains of the bounds into the component: distance of the outermost point for ω in m, 1 for ν.
    pub length: f64,
}

/// Where a range ends; strains of bending and twist are those at the outermost quadrature point.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub enum Bound {
    /// Not within the strains looked at.
    Beyond {
        /// The last one looked at.
        strain: f64,
    },
    /// The tangent ceases to be positive definite.
    Unstable {
        /// There.
        strain: f64,
        /// The direction in which the stiffness is lost first, lengths taken out, of length one.
        mode: [f64; 6],
    },
    /// The section refuses the strain.
    Inadmissible {
        /// There.
        strain: f64,
        /// Why.
        error: Error,
    },
}

impl Bound {
    /// The strain where the range ends.
    pub fn strain(&self) -> f64 {
        match self {
            Self::Beyond { strain } | Self::Unstable { strain, .. } | Self::Inadmissible { strain, .. } => {
                *strain
            }
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Beyond { strain } => write!(f, "stable to {strain:+.3}"),
            Self::Inadmissible { strain, error: Error::Inadmissible { quantity, requirement, .. } } => {
                write!(f, "refused at {strain:+.4}: {quantity} must be {requirement}")
            }
            Self::Inadmissible { strain, error } => write!(f, "refused at {strain:+.4}: {error}"),
            Self::Unstable { strain, mode } => {
                write!(f, "stability lost at {strain:+.4} in")?;
                let parts = AXES.iter().zip(mode).filter(|(_, part)| part.abs() > 0.1);
                parts.into_iter().try_for_each(|(axis, part)| write!(f, " {part:+.2} {axis}"))
            }
        }
    }
}

impl fmt::Display for CheckReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Moduli { bending, torsion, shear, axial, young, shear_modulus } = self.moduli;
        let size = self.rest.to_vector().amax();
        if size == 0.0 {
            writeln!(f, "free of stress at rest")?;
        } else {
            let (m, n) = (self.rest.moment, self.rest.force);
            writeln!(f, "STRESS AT REST: moment ({:.3e}, {:.3e}, {:.3e}) N m,", m.x, m.y, m.z)?;
            writeln!(f, "                force ({:.3e}, {:.3e}, {:.3e}) N", n.x, n.y, n.z)?;
        }
        writeln!(f, "at rest: EA {axial:.4e} N, GA {:.4e}, {:.4e} N", shear[0], shear[1])?;
        writeln!(f, "         EI {:.4e}, {:.4e}, GJ {torsion:.4e} N m2", bending[0], bending[1])?;
        writeln!(f, "         EA/A {young:.4e} Pa, GA/A {shear_modulus:.4e} Pa")?;
        if young > LARGEST_RATIO * shear_modulus {
            let ratio = young / shear_modulus;
            writeln!(
                f,
                "         E IS {ratio:.3} G: an isotropic solid has 3 at most, but this section cannot contract;"
            )?;
            writeln!(
                f,
                "         take constants for the E that the rod shall have, or Relaxed instead of Section"
            )?;
        }
        let Derivatives { wrench, tangent, asymmetry } = self.derivatives;
        writeln!(
            f,
            "against difference quotients: wrench {wrench:.0e}, tangent {tangent:.0e}; asymmetry {asymmetry:.0e}"
        )?;
        writeln!(f, "positive definite tangent (strain at the rim):")?;
        for range in &self.ranges {
            writeln!(f, "  {:<8} {}", AXES[range.axis], range.lower)?;
            writeln!(f, "  {:<8} {}", "", range.upper)?;
        }
        writeln!(
            f,
            "quadrature of degree {} with {} points: error {:.0e}",
            self.degree, self.points, self.quadrature_error
        )?;
        write!(f, "  by degree (points):")?;
        for (degree, points, error) in &self.sensitivity {
            write!(f, " {degree} ({points}) {error:.0e};")?;
        }
        Ok(())
    }
}
