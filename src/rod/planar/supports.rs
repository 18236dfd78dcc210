use nalgebra::{Matrix6x3, Vector3, Vector6};

use super::{OUTSIDE, PLACES};
use crate::error::{Error, Result};
use crate::lie::{Pose, Wrench};
use crate::load::LoadWrench;
use crate::rod::support::{Condition, Freedom, Support};

/// A support and where it is: the arc length and the pose of the section at the start of a solve.
pub(crate) struct Held {
    pub(crate) s: f64,
    pub(crate) pose: Pose,
    pub(crate) support: Support,
}

/// A number this small, of rotations and of displacements over the length, is rounding.
const NOTHING: f64 = 1e-9;

/// Releases what supports hold across the plane beyond what places the plane itself: a rod that cannot leave its plane cannot tell how much of such a
/// reaction is whose, and its equations would be singular. The first along the rod that place it keep it; springs stay.
///
/// # Errors
/// If one that is released holds the section anywhere but in the plane.
pub(crate) fn release_across(supports: &mut [Held], length: f64) -> Result<()> {
    let Some(first) = supports.first().map(|held| held.pose) else { return Ok(()) };
    let mut placed: Vec<Vector3<f64>> = Vec::new();
    for held in supports {
        // motions of the plane, as the section sees them
        let seen = (held.pose.inverse() * first).adjoint().to_matrix();
        let motions =
            Matrix6x3::from_fn(|r, c| seen[(r, OUTSIDE[c])] * if OUTSIDE[c] < 3 { 1.0 } else { length });
        let target = held.support.held();
        let equations = held.support.linearised(&held.pose, &Wrench::zero(), &LoadWrench::none(), &target);
        for freedom in Freedom::ALL {
            let j = freedom as usize;
            if !matches!(held.support.condition(freedom), Condition::Fixed(_)) {
                continue;
            }
            let unit = if j < 3 { 1.0 } else { length };
            let row: Vector6<f64> = equations.from_zeta.row(j).transpose() / unit;
            if PLACES.iter().any(|&place| row[place].abs() * if place < 3 { 1.0 } else { length } > NOTHING) {
                continue;
            }
            let mut new: Vector3<f64> = motions.tr_mul(&row);
            placed.iter().for_each(|old| new -= old * old.dot(&new));
            if new.norm() > NOTHING {
                placed.push(new.normalize());
                continue;
            }
            let value = equations.residual[j];
            if value.abs() > NOTHING * unit {
                let quantity = "distance out of its plane at which a support holds a planar rod";
                return Err(Error::InvalidAt { quantity, value, requirement: "zero", s: held.s });
            }
            held.support = held.support.releasing([freedom]);
        }
    }
    Ok(())
}
