use super::combine::Sum;
use super::fibre_direction::{FibreDirection, Helix};
use super::fibres::Fibres;
use super::isochoric_neo_hookean::IsochoricNeoHookean;
use super::kinematics::{Deformation, Point};
use super::law::Local;
use crate::error::Result;
use crate::scalar::Scalar;

/// The law of Holzapfel, Gasser and Ogden: an isochoric neo-Hookean matrix with two families of tension-only fibres.
///
/// ```math
/// u = \frac{\mu}{2}(\bar I_1 - 3) + \frac{\kappa}{2}(J-1)^2 + \sum_{f=1,2} \frac{k_1}{2k_2}\Bigl(e^{k_2 \langle I_{4f}-1\rangle^2} - 1\Bigr),
/// \qquad \langle x \rangle = \max(x, 0) .
/// ```
///
/// The directions are functions of the point ([`FibreDirection`]); [`artery`](Self::artery) takes two helices of opposite hand.
/// Free of stress at rest, with the moduli of the matrix there: shear μ, axial κ + 4μ/3. See [`Fibres`] for what happens where a
/// fibre goes slack. Defined for J > 0. Without dispersion of the fibres.
///
/// ```
/// use hyperrod::material::HolzapfelGasserOgden;
///
/// // media of a carotid artery; kappa is a choice
/// let media = HolzapfelGasserOgden::artery([3e3, 100e3], [2.3632e3, 0.8393], 29.0_f64.to_radians())?;
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// Source: Holzapfel, Gasser and Ogden (2000), J. Elasticity 61, 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HolzapfelGasserOgden<N, M = N>(Sum<IsochoricNeoHookean, Sum<Fibres<N>, Fibres<M>>>);

impl<N: FibreDirection, M: FibreDirection> HolzapfelGasserOgden<N, M> {
    /// From the matrix constants (μ, κ) in Pa, the fibre constants (k₁ in Pa, k₂) and the two directions.
    ///
    /// # Errors
    /// If a constant is not positive and finite.
    pub fn new([mu, kappa]: [f64; 2], [k1, k2]: [f64; 2], directions: (N, M)) -> Result<Self> {
        let matrix = IsochoricNeoHookean::new(mu, kappa)?;
        let (first, second) = directions;
        Ok(Self(Sum(matrix, Sum(Fibres::new(first, k1, k2)?, Fibres::new(second, k1, k2)?))))
    }
}

impl HolzapfelGasserOgden<Helix> {
    /// With fibres along two helices at ±β to the axis of the rod, β in rad.
    ///
    /// # Errors
    /// If a constant is not positive and finite, or β not finite.
    pub fn artery(matrix: [f64; 2], fibres: [f64; 2], angle: f64) -> Result<Self> {
        Self::new(matrix, fibres, (Helix::new(angle)?, Helix::new(-angle)?))
    }
}

impl<N: FibreDirection, M: FibreDirection> Local for HolzapfelGasserOgden<N, M> {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        self.0.energy_density(f, at)
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0, a fibre direction (a helix has none on the axis) and no overflow of exp(k2 (I4 - 1)^2)"
    }
}
