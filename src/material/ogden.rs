use super::coefficient_table::require_coefficient;
use super::kinematics::{Deformation, Point};
use super::law::Local;
use crate::error::{Result, positive, require};
use crate::scalar::Scalar;

/// Ogden's law in the principal stretches, u = Σ μ_p/α_p (Σᵢ λᵢ^α_p − 3 − α_p ln J) + λ/2 (ln J)².
///
/// The stretches coalesce at rest and eigenvalues are not smooth there; the sums of their powers are. They are written
/// as analytic functions of the strain ([`Deformation::stretch_powers_excess`]), so that the limit of equal stretches is exact
/// in value, wrench and tangent: nothing is perturbed. Free of stress at rest; small strains:
///
/// ```math
/// G = \tfrac12 \sum_p \mu_p \alpha_p, \qquad E_{\text{rigid}} = \lambda + 2G .
/// ```
///
/// The second constant of [`new`](Self::new) is λ, **not the bulk modulus** K of a datasheet, from which
/// [`with_bulk_modulus`](Self::with_bulk_modulus) takes λ = K − 2G/3. And a section that cannot contract bends with
/// λ + 2G: with the bulk modulus of rubber, near 1 GPa, a rod is a thousand times too stiff. Take λ = G, which makes E_rigid the 3G of the
/// incompressible rubber.
///
/// The dearest of the laws: an eigenvalue problem at every point, on numbers that carry the derivatives in all strains. Where a
/// [`Yeoh`](super::Yeoh) or [`Polynomial`](super::Polynomial) fit is as good, it is far faster, above all on a relaxed section.
///
/// Defined for J > 0. One term with α = 2 is [`NeoHookean`](super::NeoHookean) with μ = μ₁.
///
/// ```
/// use hyperrod::material::Ogden;
///
/// // Ogden's fit to Treloar's rubber: (mu in Pa, alpha)
/// let terms = [(0.63e6, 1.3), (0.0012e6, 5.0), (-0.01e6, -2.0)];
/// let shear_modulus = 0.5 * terms.iter().map(|(mu, alpha)| mu * alpha).sum::<f64>();
/// let rubber = Ogden::new(&terms, shear_modulus)?; // E = 3 G on a rigid section
/// assert_eq!(rubber.shear_modulus(), shear_modulus);
///
/// let refused = Ogden::new(&[], shear_modulus).unwrap_err().to_string();
/// assert!(refused.contains("number of terms"), "{refused}");
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// Source: Ogden (1972), Proc. R. Soc. A 328, 567, with F(J) = λ/2 (ln J)² and the pressure that frees rest of stress.
#[derive(Clone, Debug, PartialEq)]
pub struct Ogden {
    terms: Vec<(f64, f64)>,
    lambda: f64,
}

impl Ogden {
    /// From the terms (μ_p in Pa, α_p) and λ, Pa (see above for which λ to take).
    ///
    /// # Errors
    /// If there is no term, a number is not finite, an α_p is zero, or the shear modulus ½ Σ μ_p α_p or the bulk modulus λ + 2G/3
    /// is not positive.
    pub fn new(terms: &[(f64, f64)], lambda: f64) -> Result<Self> {
        require(!terms.is_empty(), "number of terms of Ogden's law", 0.0, "at least 1")?;
        for (p, &(mu, alpha)) in terms.iter().enumerate() {
            require_coefficient(mu.is_finite(), || format!("mu_{}", p + 1), mu, "finite")?;
            let usable = alpha.is_finite() && alpha != 0.0;
            require_coefficient(usable, || format!("alpha_{}", p + 1), alpha, "finite and not zero")?;
        }
        let law = Self { terms: terms.to_vec(), lambda };
        positive("Ogden shear modulus (half the sum of mu alpha)", law.shear_modulus())?;
        positive("bulk modulus lambda + 2 G / 3", lambda + 2.0 / 3.0 * law.shear_modulus())?;
        Ok(law)
    }

    /// From the terms and the bulk modulus at rest K, Pa, with which λ = K − 2G/3. For a section that [relaxes](crate::section::Relaxed): a rigid one has
    /// E_rigid = K + 4G/3, far too stiff with the K of a rubber.
    ///
    /// ```
    /// use hyperrod::material::Ogden;
    ///
    /// let rubber = Ogden::with_bulk_modulus(&[(0.63e6, 1.3), (0.0012e6, 5.0)], 1e9)?;
    /// let lambda = 1e9 - 2.0 / 3.0 * rubber.shear_modulus();
    /// assert_eq!(rubber, Ogden::new(&[(0.63e6, 1.3), (0.0012e6, 5.0)], lambda)?);
    /// # Ok::<(), hyperrod::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_bulk_modulus(terms: &[(f64, f64)], bulk: f64) -> Result<Self> {
        positive("bulk modulus", bulk)?;
        let shear = 0.5 * terms.iter().map(|(mu, alpha)| mu * alpha).sum::<f64>();
        Self::new(terms, bulk - 2.0 / 3.0 * shear)
    }

    /// G = ½ Σ μ_p α_p, Pa.
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.terms.iter().map(|(mu, alpha)| mu * alpha).sum::<f64>()
    }
}

impl Local for Ogden {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, _at: &Point<D>) -> D {
        let ln_j = f.j().ln_1p();
        self.terms.iter().fold(ln_j * ln_j * (0.5 * self.lambda), |sum, &(mu, alpha)| {
            sum + f.stretch_powers_excess(alpha) * (mu / alpha)
        })
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }
}
