//! Rotations, poses and their algebra: SO(3) and SE(3), and the vectors that live on them.
//!
//! A [`Pose`] g = (R, p) moves a rod's section in space; a [`Twist`] is an element of se(3) (the strain ξ of g′ = g ξ^, a
//! velocity, a small displacement); a [`Strain`] is the *change* Δξ = ξ − ξ* of the strain twist from its reference; a
//! [`Wrench`] is their dual. They are different types: adding a strain to a wrench, or passing Δξ where ξ is meant, does
//! not compile. Everything is in body frame, order (angular, linear), and generic over [`Scalar`](crate::Scalar).
//!
//! What lives here knows nothing of materials or rods.

mod coefficients;
mod map;
mod pose;
pub mod se3;
#[cfg(feature = "serde")]
pub(crate) mod serialize;
pub mod so3;
mod vectors;

pub(crate) use coefficients::{C5, C6, SERIES_LIMIT};
pub use coefficients::{dexp_coefficients, dexp_inv_coefficients, stumpff};
pub use map::TwistMap;
pub use pose::Pose;
pub use vectors::{Strain, Twist, Wrench};
