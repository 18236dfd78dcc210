use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive, require};
use crate::scalar::{Scalar, exp_m1_minus_x, x_minus_ln_1p};

/// Blatz and Ko's law of foamed rubber.
///
/// ```math
/// u = \frac{\mu f}{2}\Bigl(I_1 - 3 + \frac{J^{-2\beta} - 1}{\beta}\Bigr)
///   + \frac{\mu (1-f)}{2}\Bigl(\frac{I_2}{J^2} - 3 + \frac{J^{2\beta} - 1}{\beta}\Bigr), \qquad \beta = \frac{\nu}{1-2\nu} .
/// ```
///
/// Each bracket starts with terms linear in J − 1 that cancel. With ℓ = ln J and h = 1/J − 1 they are evaluated as
///
/// ```math
/// \bigl(I_1 - 3 - 2(J-1)\bigr) + 2(J - 1 - \ell) + \tfrac1\beta \bigl(e^{-2\beta\ell} - 1 + 2\beta\ell\bigr)
/// \quad\text{and}\quad
/// \frac{I_2 - 3 - 4(J-1)}{J^2} - h^2 + 2(h + \ell) + \tfrac1\beta \bigl(e^{2\beta\ell} - 1 - 2\beta\ell\bigr),
/// ```
///
/// all of second order. Free of stress at rest; shear modulus μ, axial modulus of a section that cannot contract 2μ(1 + β). Defined for J > 0.
/// The foam of the paper has f = 0, ν = 1/4: u = μ/2 (I₂/I₃ + 2√I₃ − 5). It loses stability in large shear and compression.
///
/// Source: Blatz and Ko (1962), Trans. Soc. Rheol. 6, 223.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlatzKo {
    mu: f64,
    beta: f64,
    fraction: f64,
}

impl BlatzKo {
    /// From the shear modulus μ, Pa, Poisson's ratio ν of small strains and the fraction f of the first part.
    ///
    /// # Errors
    /// If μ is not positive and finite, ν not in [0, ½) or f not in [0, 1].
    pub fn new(mu: f64, poisson: f64, fraction: f64) -> Result<Self> {
        positive("shear modulus mu", mu)?;
        require((0.0..0.5).contains(&poisson), "Poisson's ratio", poisson, "in [0, 0.5)")?;
        require((0.0..=1.0).contains(&fraction), "Blatz-Ko fraction f", fraction, "in [0, 1]")?;
        Ok(Self { mu, beta: poisson / (1.0 - 2.0 * poisson), fraction })
    }

    /// The foam of the paper: f = 0, ν = 1/4.
    ///
    /// # Errors
    /// If μ is not positive and finite.
    pub fn foam(mu: f64) -> Result<Self> {
        Self::new(mu, 0.25, 0.0)
    }
}

impl Isotropic for BlatzKo {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let inverse = (i.j() + 1.0).recip();
        let h = -i.j() * inverse;
        let volumetric = |sign: f64| match self.beta {
            0.0 => D::zero(), // the limit of the difference divided by β
            beta => exp_m1_minus_x(i.j().ln_1p() * (2.0 * sign * beta)) / beta,
        };
        let solid = i.i1_excess() + x_minus_ln_1p(i.j()) * 2.0 + volumetric(-1.0);
        let foam = i.i2_excess() * inverse * inverse - h * h + x_minus_ln_1p(h) * 2.0 + volumetric(1.0);
        (solid * self.fraction + foam * (1.0 - self.fraction)) * (0.5 * self.mu)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }
}
