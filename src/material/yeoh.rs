use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive, require};
use crate::scalar::Scalar;

/// Yeoh's law, u = Σ C_k (Ī₁−3)ᵏ + Σ D_k (J−1)²ᵏ, k = 1, 2, 3: filled rubber, from one kind of test.
///
/// C₂ < 0 gives the softening at small and C₃ > 0 the upturn at large stretch. Free of stress at rest; small strains:
///
/// ```math
/// G = 2 C_1, \qquad \kappa = 2 D_1, \qquad E_{\text{rigid}} = \kappa + \tfrac43 G .
/// ```
///
/// **D_k multiplies** (1/D_k of finite-element codes). Defined for J > 0. u stays convex in Ī₁ where its slope
/// C₁ + 2C₂x + 3C₃x² grows; a C₂ that is too negative loses stability, which [`check`](crate::section::check) shows.
///
/// ```
/// use hyperrod::material::Yeoh;
/// let tyre = Yeoh::new([0.5e6, -0.05e6, 0.01e6], [1e9, 0.0, 0.0])?;
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// Source: Yeoh (1993), Rubber Chem. Technol. 66, 754, with volumetric terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yeoh {
    c: [f64; 3],
    d: [f64; 3],
}

impl Yeoh {
    /// From C₁, C₂, C₃ and D₁, D₂, D₃, Pa.
    ///
    /// # Errors
    /// If C₁ or D₁ is not positive and finite, or another coefficient not finite.
    pub fn new(c: [f64; 3], d: [f64; 3]) -> Result<Self> {
        positive("Yeoh coefficient C1", c[0])?;
        positive("Yeoh coefficient D1", d[0])?;
        for (quantity, value) in [
            ("Yeoh coefficient C2", c[1]),
            ("Yeoh coefficient C3", c[2]),
            ("Yeoh coefficient D2", d[1]),
            ("Yeoh coefficient D3", d[2]),
        ] {
            require(value.is_finite(), quantity, value, "finite")?;
        }
        Ok(Self { c, d })
    }
}

impl Isotropic for Yeoh {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let [c1, c2, c3] = self.c;
        let [d1, d2, d3] = self.d;
        let (x, y) = (i.i1_isochoric(), i.j() * i.j());
        x * (x * (x * c3 + c2) + c1) + y * (y * (y * d3 + d2) + d1)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }
}
