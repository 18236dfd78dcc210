use super::resultant::Resultant;
use crate::error::{Error, Result, positive};
use crate::lie::Strain;
use crate::scalar::Scalar;

/// A thin ribbon that bends without stretching its middle surface: the corrected energy of Sadowsky.
///
/// The ribbon is `width` w along x and `thickness` t along y. With the curvature κ about x and the twist τ,
///
/// ```math
/// U = \frac{D w}{2}\, Q(\kappa, \tau)
///   + \frac12\bigl(EI_y\,\omega_y^2 + GA\,(\nu_x^2 + \nu_y^2) + EA\,\nu_z^2\bigr), \quad
/// Q = \begin{cases} (\kappa^2 + \tau^2)^2/\kappa^2 & |\kappa| > |\tau| \\ 4\tau^2 & |\kappa| \le |\tau| \end{cases}, \quad
/// D = \frac{E t^3}{12(1-\nu^2)} .
/// ```
///
/// Sadowsky's (κ² + τ²)²/κ² is infinite where a twisted ribbon straightens. The second line is no smoothing of that but the limit of the
/// energy of a plate of vanishing width (Freddi et al.): the ribbon wrinkles finely there. The two lines meet with equal slope.
/// A twisted ribbon has **no stiffness against κ while |κ| ≤ |τ|**: the tangent is singular there. Q is homogeneous of
/// degree two but not quadratic, so there is no tangent at κ = τ = 0; that of Q = κ² + 2τ², the ribbon bent first, is given.
/// Reference straight; w much larger than t, and w κ small.
///
/// Source: Sadowsky (1930), Sitzungsber. Preuss. Akad. Wiss. 22, 412; Freddi, Hornung, Mora and Paroni (2016), J. Elasticity 123, 125.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ribbon {
    plate: f64,
    lateral: f64,
    shear: f64,
    axial: f64,
}

impl Ribbon {
    /// From width and thickness in m, Young's modulus in Pa and Poisson's ratio.
    ///
    /// # Errors
    /// If a size or the modulus is not positive and finite, or Poisson's ratio not in (−1, ½].
    pub fn new([width, thickness]: [f64; 2], young: f64, poisson: f64) -> Result<Self> {
        for (quantity, value) in [
            ("width of the ribbon", width),
            ("thickness of the ribbon", thickness),
            ("Young's modulus of the ribbon", young),
        ] {
            positive(quantity, value)?;
        }
        if !(poisson > -1.0 && poisson <= 0.5) {
            let quantity = "Poisson's ratio of the ribbon";
            return Err(Error::Invalid { quantity, value: poisson, requirement: "in (-1, 0.5]" });
        }
        let area = width * thickness;
        Ok(Self {
            plate: young * thickness.powi(3) * width / (12.0 * (1.0 - poisson * poisson)),
            lateral: young * thickness * width.powi(3) / 12.0,
            shear: young * area / (2.0 * (1.0 + poisson)),
            axial: young * area,
        })
    }
}

impl Resultant for Ribbon {
    fn energy<D: Scalar>(&self, strain: &Strain<D>, _s: D) -> D {
        let (omega, nu) = (strain.angular, strain.linear);
        let (bend, twist) = (omega.x * omega.x, omega.z * omega.z);
        let q = if bend > twist {
            bend + twist * 2.0 + twist * (twist / bend)
        } else if twist > 0.0 {
            twist * 4.0
        } else {
            bend + twist * 2.0
        };
        let stiff = omega.y * omega.y * self.lateral
            + (nu.x * nu.x + nu.y * nu.y) * self.shear
            + nu.z * nu.z * self.axial;
        (q * self.plate + stiff) * 0.5
    }

    fn domain(&self) -> &'static str {
        "finite for Sadowsky's ribbon"
    }
}
