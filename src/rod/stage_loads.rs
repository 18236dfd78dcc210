use nalgebra::{Matrix6, Vector3};

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
    /// The same, with their derivatives in the strain of the stage.
    Strained(&'a [LoadWrench; S], &'a [Matrix6<f64>; S]),
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
            Self::Any(loads) | Self::Strained(loads, _) => {
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
            Self::Any(loads) | Self::Strained(loads, _) => Some(loads[l]),
        }
    }

    /// Its derivative in the strain there, where it has one.
    pub(crate) fn by_strain(&self, l: usize) -> Option<&Matrix6<f64>> {
        if let Self::Strained(_, by_strain) = self { Some(&by_strain[l]) } else { None }
    }
}
