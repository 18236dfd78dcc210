//! The stability of a state of a rod on its mesh.

use super::condition::Condition;
use super::index::{Chain, Stop};
use super::link::Link;
use crate::body::Elastic;
use crate::lie::Wrench;
use crate::rod::condense::Condensed;
use crate::solve::assembly::{base_equations, joint_equations, tip_equations};
use crate::solve::equilibrium::Configuration;
use crate::solve::mesh::Mesh;
use crate::solve::scale::Scale;

/// The chain of a state whose elements are condensed. `None` where a support has singular coordinates.
pub(crate) fn chain<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
    condensed: &Condensed<S>,
    scale: &Scale,
) -> Option<Chain> {
    let n = mesh.elements();
    let mut links = Vec::with_capacity(n);
    let mut stops = Vec::new();
    let mut joints = state.joints.iter();
    for i in 0..n {
        let mut end = state.end_wrench[i];
        if let Some((j, joint)) = mesh.joint_at(i + 1).and_then(|j| Some((j, joints.next()?))) {
            let fixed = &mesh.rod.joints()[j];
            if fixed.fixture.support.is_free() {
                end = fixed.corner.adjoint().apply_transpose(&(end - joint.load.wrench));
            } else {
                let equations = joint_equations(mesh, j, joint);
                let condition = Condition::of(&mesh.joint_support(j), &equations, &joint.applied, scale)?;
                stops.push(Stop { node: i + 1, condition, corner: Link::corner(&fixed.corner, scale) });
            }
        }
        links.push(Link::new(&condensed.transfer(i), &state.node_wrench[i], &end, scale));
    }
    let (base, tip) = (&mesh.rod.base_fixture().support, &mesh.tip_support());
    let mut at_base = base_equations(mesh, state);
    // in what the support applies, −Λ_0
    at_base.from_wrench = -at_base.from_wrench;
    let applied: Wrench = -state.node_wrench[0];
    let base = Condition::of(base, &at_base, &applied, scale)?;
    let tip = Condition::of(tip, &tip_equations(mesh, state), &state.node_wrench[n], scale)?;
    Some(Chain { links, stops, base, tip })
}
