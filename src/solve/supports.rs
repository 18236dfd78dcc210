//! What holds a rod on a mesh, and what of it makes no sense.

use super::mesh::Mesh;
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::Pose;
use crate::rod::planar::{self, Held};
use crate::rod::{Rod, Support};

/// The supports of a rod, without what they [hold across the plane](planar::release_across) of a planar one to no effect.
#[derive(Clone, Debug)]
pub(crate) struct Supports {
    pub(crate) base: Support,
    pub(crate) tip: Support,
    /// By the numbers of the joints.
    pub(crate) joints: Vec<Support>,
}

impl Supports {
    pub(super) fn of<B: Elastic>(rod: &Rod<B>) -> Self {
        let joints = rod.joints().iter().map(|joint| joint.fixture.support).collect();
        Self { base: rod.base_fixture().support, tip: rod.tip_fixture().support, joints }
    }

    pub(super) fn interior(&self) -> bool {
        self.joints.iter().any(|support| !support.is_free())
    }
}

impl<B: Elastic, const S: usize> Mesh<'_, B, S> {
    /// Refuses supports that hold a planar rod out of its plane, or one that can neither stretch nor shear farther apart than it is long.
    pub(crate) fn check_supports(&self) -> Result<()> {
        self.supports_in_plane(&self.reference_poses())?;
        if self.rod.body().constraint().fixed()[3..] == [true; 3] { self.check_distances() } else { Ok(()) }
    }

    /// See [`check_supports`](Self::check_supports). At exactly its length a rod has no freedom, and no finite tension carries a load across it.
    fn check_distances(&self) -> Result<()> {
        const TAUT: f64 = 1.0 - 1e-12;
        let Supports { base, tip, joints } = Supports::of(self.rod);
        let (mut last, mut length) = (base.place_held(), 0.0);
        for i in 0..self.elements() {
            let slopes = self.reference[i].iter().zip(self.table.b);
            length += self.h(i) * slopes.map(|(xi, b)| b * xi.linear.norm()).sum::<f64>();
            let joint = self.joint_at(i + 1).map(|j| &joints[j]);
            let support = if i + 1 == self.elements() { Some(&tip) } else { joint };
            let Some(place) = support.and_then(Support::place_held) else { continue };
            let distance = last.map_or(0.0, |last| (place - last).norm());
            if last.is_some() && distance >= TAUT * length {
                let quantity = "distance between two supports of a rod that can neither stretch nor shear";
                let requirement = "below the length of the rod between them";
                return Err(Error::InvalidAt {
                    quantity,
                    value: distance,
                    requirement,
                    s: self.node_s(i + 1),
                });
            }
            (last, length) = (Some(place), 0.0);
        }
        Ok(())
    }

    /// See [`planar::release_across`]; `None` for a rod that is not planar, or leaves its plane at a corner.
    pub(super) fn supports_in_plane(
        &self,
        (to_joints, to_tip): &(Vec<Pose>, Pose),
    ) -> Result<Option<Supports>> {
        if !(self.is_planar && to_joints.iter().chain([to_tip]).all(planar::keeps_to)) {
            return Ok(None);
        }
        let (length, first) = (self.rod.body().length(), self.start.base);
        let Supports { base, tip, joints } = Supports::of(self.rod);
        let held = |s, to: &Pose, support| Held { s, pose: first * *to, support };
        let mut all = vec![held(0.0, &Pose::identity(), base)];
        for ((to, joint), support) in to_joints.iter().zip(self.rod.joints()).zip(joints) {
            all.push(held(joint.s, to, support));
        }
        all.push(held(length, to_tip, tip));
        planar::release_across(&mut all, length)?;
        let mut supports = all.into_iter().map(|held| held.support);
        let base = supports.next().unwrap_or(base);
        let mut joints: Vec<Support> = supports.collect();
        let tip = joints.pop().unwrap_or(tip);
        Ok(Some(Supports { base, tip, joints }))
    }
}
