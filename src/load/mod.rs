//! Loads: what acts on a rod per length or at its tip, with exact derivatives.
//!
//! A distributed load is a [`Load`] on bodies that have what it needs: [`Gravity`] is one on bodies with a mass. A [`TipLoad`] acts at the
//! free end. Both are given in the body frame of the section they act on, with their derivative in a small displacement ζ of that frame.
//!
//! What lives here knows bodies and poses; it knows no element and no solver.

mod dead_wrench;
mod gravity;

pub use dead_wrench::DeadWrench;
pub use gravity::Gravity;

use nalgebra::Matrix6;

use crate::error::Result;
use crate::lie::{Pose, Wrench};

/// A wrench with its derivative in a displacement ζ of the frame it is given in (g → g exp ζ^).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadWrench {
    /// The wrench in body frame.
    pub wrench: Wrench,
    /// ∂(wrench)/∂ζ, rows and columns (angular, linear).
    pub tangent: Matrix6<f64>,
    /// Its potential energy (per length for a distributed load); `None` for a load that has none.
    pub potential: Option<f64>,
}

/// A load per length of the reference on bodies of type `B`.
pub trait Load<B: ?Sized>: Send + Sync {
    /// The load at s on a section at `pose`: N (moment per length) and N/m.
    ///
    /// # Errors
    /// Where the load or what it asks of the body is not defined.
    fn at(&self, body: &B, s: f64, pose: &Pose) -> Result<LoadWrench>;
}

/// A wrench on the tip of the rod.
pub trait TipLoad: Send + Sync {
    /// The load on a tip at `pose`: N m and N.
    ///
    /// # Errors
    /// Where the load is not defined.
    fn at(&self, pose: &Pose) -> Result<LoadWrench>;
}
