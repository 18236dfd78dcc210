//! hyperrod

pub mod error;
pub mod lie;
pub mod scalar;

pub use error::{Error, Result};
pub use lie::{Pose, Strain, Twist, TwistMap, Wrench};
pub use scalar::Scalar;
