use nalgebra::Vector3;

use super::kinematics::Point;
use crate::error::{Result, require};
use crate::scalar::Scalar;

/// The direction of fibres in the reference, a unit vector that may depend on the point.
///
/// A law over it is generic in the point, so that its change along s is differentiated too. Write one in a few lines:
///
/// ```
/// use hyperrod::Scalar;
/// use hyperrod::material::{FibreDirection, Point};
/// use nalgebra::Vector3;
///
/// /// Along the rod at s = 0, turning towards x with s.
/// struct Fan { turn_per_length: f64 }
///
/// impl FibreDirection for Fan {
///     fn direction<D: Scalar>(&self, at: &Point<D>) -> Vector3<D> {
///         let angle = at.s * self.turn_per_length;
///         Vector3::new(angle.sin(), D::zero(), angle.cos())
///     }
/// }
/// ```
pub trait FibreDirection: Send + Sync {
    /// The unit vector at a point, in the frame of the section (x, y, along the rod).
    fn direction<D: Scalar>(&self, at: &Point<D>) -> Vector3<D>;
}

/// Fibres in one direction everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Straight {
    direction: [f64; 3],
}

impl Straight {
    /// Along a vector, which need not have length one.
    ///
    /// # Errors
    /// If its length is not positive and finite.
    pub fn new(direction: [f64; 3]) -> Result<Self> {
        let vector = Vector3::from(direction);
        let length = vector.norm();
        let usable = length > 0.0 && length.is_finite();
        require(usable, "length of the fibre direction", length, "positive and finite")?;
        Ok(Self { direction: (vector / length).into() })
    }

    /// Along the rod.
    pub fn axial() -> Self {
        Self { direction: [0.0, 0.0, 1.0] }
    }
}

impl FibreDirection for Straight {
    #[inline(always)]
    fn direction<D: Scalar>(&self, _at: &Point<D>) -> Vector3<D> {
        Vector3::from(self.direction.map(D::from))
    }
}

/// Helices of one angle β to the axis of the rod at every radius: the windings of a tube, the layers of an artery.
///
/// d = cos β e₃ + sin β (−y, x, 0)/r. It has no limit on the axis itself, r = 0: a section with a quadrature point there
/// answers with an error. Use it on a tube, or [`Twisted`] on a full section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    sine: f64,
    cosine: f64,
}

impl Helix {
    /// At the angle β to the axis, in rad; positive turns like a right-hand screw.
    ///
    /// # Errors
    /// If β is not finite.
    pub fn new(angle: f64) -> Result<Self> {
        require(angle.is_finite(), "helix angle", angle, "finite")?;
        Ok(Self { sine: angle.sin(), cosine: angle.cos() })
    }
}

impl FibreDirection for Helix {
    #[inline(always)]
    fn direction<D: Scalar>(&self, at: &Point<D>) -> Vector3<D> {
        let per_radius = (at.x * at.x + at.y * at.y).sqrt().recip() * self.sine;
        Vector3::new(-at.y * per_radius, at.x * per_radius, D::from(self.cosine))
    }
}

/// Helices of one pitch, as in a twisted yarn: d ∝ (−τy, τx, 1), smooth across the whole section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twisted {
    twist: f64,
}

impl Twisted {
    /// Of the given twist τ in rad/m, 2π over the pitch; positive turns like a right-hand screw.
    ///
    /// # Errors
    /// If τ is not finite.
    pub fn new(twist: f64) -> Result<Self> {
        require(twist.is_finite(), "fibre twist", twist, "finite")?;
        Ok(Self { twist })
    }
}

impl FibreDirection for Twisted {
    #[inline(always)]
    fn direction<D: Scalar>(&self, at: &Point<D>) -> Vector3<D> {
        let [x, y] = [at.x * self.twist, at.y * self.twist];
        let scale = (x * x + y * y + 1.0).sqrt().recip();
        Vector3::new(-y * scale, x * scale, scale)
    }
}
