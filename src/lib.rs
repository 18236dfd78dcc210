//! hyperrod

#[doc(hidden)]
pub use num_dual;

pub mod body;
pub mod error;
pub mod lie;
pub mod load;
pub mod material;
pub mod quadrature;
pub mod rod;
pub mod scalar;
pub mod section;
pub mod solve;

pub use body::Body;
pub use error::{Error, Result};
pub use lie::{Pose, Strain, Twist, TwistMap, Wrench};
pub use rod::Rod;
pub use scalar::Scalar;
pub use solve::{StaticSolution, Statics};
