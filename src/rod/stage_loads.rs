use nalgebra::Vector3;

use super::element::Kinematics;
use crate::lie::{Pose, Wrench};
use crate::load::LoadWrench;

/// The distributed loads at the stages of an element, per length.
#[derive(Clone, Copy, Debug)]
pub(crate) enum StageLoads<'a, const S: usize> {
    /// There are none.
    None,
    /// Forces through the axis that keep direction and size in space, in the frame of the first node.
    Dead(&'a [Vector3<f64>; S]),
    /// Whatever they are, in the frames of the stages.
    Any(&'a [LoadWrench; S]),
}

impl<const S: usize> StageLoads<'_, S> {
    pub(crate) fn is_none(&self) -> bool {
        matches!(self, Self::None)
    }

    /// Brought to the first node: F_l = Ad_l⁻ᵀ f̄_l.
    #[inline(always)]
    pub(crate) fn at_node(&self, motion: &Kinematics<f64, S>) -> Option<[Wrench; S]> {
        match self {
            Self::None => None,
            Self::Dead(forces) => {
                let mut loads = [Wrench::zero(); S];
                for ((load, force), pose) in loads.iter_mut().zip(*forces).zip(&motion.stage) {
                    *load = Wrench::new(pose.position.cross(force), *force);
                }
                Some(loads)
            }
            Self::Any(loads) => {
                let mut wrenches = [Wrench::zero(); S];
                // without copying the tangents
                for (wrench, load) in wrenches.iter_mut().zip(*loads) {
                    *wrench = load.wrench;
                }
                Some(motion.at_node(&wrenches))
            }
        }
    }

    /// That of stage l, in its frame, when that lies at `pose` in the frame of the first node.
    pub(crate) fn at_stage(&self, l: usize, pose: &Pose) -> Option<LoadWrench> {
        match self {
            Self::None => None,
            Self::Dead(forces) => Some(LoadWrench::dead(pose, &forces[l])),
            Self::Any(loads) => Some(loads[l]),
        }
    }
}
