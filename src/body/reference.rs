use num_dual::Dual64;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::lie::Twist;
use crate::material::Reference;

type Varying = Arc<dyn Fn(Dual64) -> Twist<Dual64> + Send + Sync>;

/// The shape of a body at rest, given by its strain twist ξ*(s).
#[non_exhaustive]
#[derive(Clone, Default)]
pub enum ReferenceShape {
    /// Straight and unstretched along e₃.
    #[default]
    Straight,
    /// The same strain everywhere: an arc or a helix.
    Constant(Twist),
    /// A function of s.
    Varying(Varying),
}

impl ReferenceShape {
    /// From a function of s.
    pub fn varying(xi: impl Fn(Dual64) -> Twist<Dual64> + Send + Sync + 'static) -> Self {
        Self::Varying(Arc::new(xi))
    }

    /// ξ* and ξ*′ at s.
    pub fn at(&self, s: f64) -> Reference {
        match self {
            Self::Straight => Reference::straight(),
            Self::Constant(xi) => Reference { twist: *xi, rate: Twist::zero() },
            Self::Varying(xi) => {
                let xi = xi(Dual64::from_re(s).derivative()).to_array();
                Reference {
                    twist: Twist::from_array(xi.map(|v| v.re)),
                    rate: Twist::from_array(xi.map(|v| v.eps)),
                }
            }
        }
    }

    /// As [`at`](Self::at), refused where a function of s gives no strain that a reference can have.
    pub(super) fn checked(&self, s: f64) -> Result<Reference> {
        const NAMES: [&str; 6] = [
            "omega_x of the reference strain",
            "omega_y of the reference strain",
            "omega_z of the reference strain",
            "nu_x of the reference strain",
            "nu_y of the reference strain",
            "nu_z of the reference strain",
        ];
        if let Self::Straight = self {
            return Ok(Reference::straight());
        }
        let reference = self.at(s);
        let invalid =
            |quantity, value, requirement| Err(Error::InvalidAt { quantity, value, requirement, s });
        let values = reference.twist.to_array().into_iter().zip(reference.rate.to_array());
        for ((value, rate), quantity) in values.zip(NAMES) {
            if !(value.is_finite() && rate.is_finite()) {
                let value = if value.is_finite() { rate } else { value };
                return invalid(quantity, value, "finite, with a finite slope");
            }
        }
        let stretch = reference.twist.linear.z;
        if stretch > 0.0 { Ok(reference) } else { invalid(NAMES[5], stretch, "positive") }
    }
}

impl std::fmt::Debug for ReferenceShape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Straight => write!(f, "Straight"),
            Self::Constant(xi) => write!(f, "Constant({xi:?})"),
            Self::Varying(_) => write!(f, "Varying(..)"),
        }
    }
}
