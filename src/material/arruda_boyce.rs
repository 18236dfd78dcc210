use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive, require};
use crate::scalar::{Scalar, x_minus_ln_1p};

/// The eight-chain model of Arruda and Boyce, in the five-term series of the inverse Langevin function.
///
/// ```math
/// u = \mu \sum_{i=1}^{5} \frac{c_i}{\lambda_m^{2i-2}} \bigl(\bar I_1^i - 3^i\bigr)
///   + \frac{\kappa}{2}\Bigl(\frac{J^2-1}{2} - \ln J\Bigr), \qquad
/// c = \tfrac12,\ \tfrac1{20},\ \tfrac{11}{1050},\ \tfrac{19}{7000},\ \tfrac{519}{673750} .
/// ```
///
/// The differences Ī₁ⁱ − 3ⁱ are expanded once in Ī₁ − 3, so that nothing cancels; likewise (J²−1)/2 − ln J =
/// (J−1)²/2 + (J−1) − ln J. Free of stress at rest; bulk modulus κ and the shear modulus of
/// [`shear_modulus`](Self::shear_modulus), which exceeds μ. Defined for J > 0. Being a series, it has no pole at the locking stretch √3 λ_m:
/// beyond about 0.8 of it the true inverse Langevin function is stiffer.
///
/// Source: Arruda and Boyce (1993), J. Mech. Phys. Solids 41, 389; the volumetric part as in the Abaqus Theory Guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArrudaBoyce {
    /// Coefficients of (Ī₁−3), (Ī₁−3)², …, Pa.
    powers: [f64; 5],
    kappa: f64,
}

impl ArrudaBoyce {
    const SERIES: [f64; 5] = [1.0 / 2.0, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673750.0];

    /// From μ and the bulk modulus κ, Pa, and the locking stretch λ_m of a chain.
    ///
    /// # Errors
    /// If μ or κ is not positive and finite, or λ_m not above 1.
    pub fn new(mu: f64, kappa: f64, locking_stretch: f64) -> Result<Self> {
        positive("Arruda-Boyce modulus mu", mu)?;
        positive("bulk modulus kappa", kappa)?;
        let above_one = locking_stretch > 1.0 && locking_stretch.is_finite();
        require(above_one, "locking stretch", locking_stretch, "above 1 and finite")?;
        let mut powers = [0.0; 5];
        for (i, c) in (1..).zip(Self::SERIES) {
            // (3 + x)^i − 3^i = Σ binomial(i, k) 3^(i−k) x^k, k ≥ 1
            let mut term = mu * c / locking_stretch.powi(2 * i - 2) * 3.0_f64.powi(i);
            for (k, power) in (1..=i).zip(&mut powers) {
                term *= f64::from(i - k + 1) / (3.0 * f64::from(k));
                *power += term;
            }
        }
        Ok(Self { powers, kappa })
    }

    /// The shear modulus at rest, Pa: μ (1 + 3/(5λ_m²) + 99/(175λ_m⁴) + 513/(875λ_m⁶) + 42039/(67375λ_m⁸)).
    pub fn shear_modulus(&self) -> f64 {
        2.0 * self.powers[0]
    }
}

impl Isotropic for ArrudaBoyce {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let (x, e) = (i.i1_isochoric(), i.j());
        let chains = self.powers.iter().rev().fold(D::zero(), |sum, &power| (sum + power) * x);
        chains + (e * e * 0.5 + x_minus_ln_1p(e)) * (0.5 * self.kappa)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }
}
