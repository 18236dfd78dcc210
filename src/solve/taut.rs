//! Whether the supports of a rod that keeps its length are near enough to each other.

use super::mesh::Mesh;
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::rod::Support;

/// At exactly its length a rod has a single shape, with any tension, and carries no load across it.
const TAUT: f64 = 1.0 - 1e-12;

/// Refuses supports that hold a rod that can neither stretch nor shear farther apart than it is long.
pub(super) fn check<B: Elastic, const S: usize>(mesh: &Mesh<'_, B, S>) -> Result<()> {
    let rod = mesh.rod;
    if rod.body().constraint().fixed()[3..] != [true; 3] {
        return Ok(());
    }
    let (mut last, mut length) = (rod.base_support().place_held(), 0.0);
    for i in 0..mesh.elements() {
        let slopes = mesh.twists(i, &[crate::lie::Strain::zero(); S]);
        let sum: f64 = slopes.iter().zip(mesh.table.b).map(|(xi, b)| b * xi.linear.norm()).sum();
        length += mesh.h(i) * sum;
        let joint = mesh.joint_at(i + 1).map(|j| &rod.joints()[j].fixture.support);
        let support = if i + 1 == mesh.elements() { Some(rod.tip_support()) } else { joint };
        let Some(place) = support.and_then(Support::place_held) else { continue };
        let distance = last.map_or(0.0, |last| (place - last).norm());
        if last.is_some() && distance >= TAUT * length {
            let quantity = "distance between two supports of a rod that can neither stretch nor shear";
            let requirement = "below the length of the rod between them";
            return Err(Error::InvalidAt { quantity, value: distance, requirement, s: mesh.node_s(i + 1) });
        }
        (last, length) = (Some(place), 0.0);
    }
    Ok(())
}
