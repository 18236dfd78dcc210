//! The chain of a rod with any supports, solved with pivoting.

use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::chain::{EndRows, Link};
use super::equilibrium::{Configuration, JointState};
use super::linear::Buffers;
use super::mesh::Mesh;
use super::scale::Scale;
use crate::body::Elastic;
use crate::error::Result;
use crate::rod::joint::Joint;
use crate::rod::support::Equations;

impl<const S: usize> Buffers<S> {
    /// ζ and δΛ of all nodes and the reactions, by elimination with pivoting inside a window of one link. The elements are condensed.
    pub(super) fn solve_with_pivoting<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        state: &Configuration<S>,
        scale: &Scale,
    ) -> Result<()> {
        let (left, right) = (base_rows(mesh, state, scale), tip_rows(mesh, state, scale));
        let mut held = held_joints(mesh, state).peekable();
        let mut links = Vec::with_capacity(mesh.elements());
        let mut place = Vec::with_capacity(mesh.elements());
        for i in 0..mesh.elements() {
            links.push(scale.transfer(&self.condensed.transfer(i)));
            place.push(mesh.node_s(i));
            if let Some((_, j, joint)) = held.next_if(|(node, ..)| *node == i + 1) {
                let equations = joint_equations(mesh, j, joint);
                links.push(joint_link(&mesh.rod.joints()[j], &equations, scale));
                place.push(mesh.node_s(i + 1));
            }
        }
        let length = mesh.rod.body().length();
        let station = |i: usize| place.get(i).copied().unwrap_or(length);
        let states = self.chain.solve(&left, links.into_iter(), &right, station)?;

        self.step.nodes.clear();
        let mut states = states.iter().map(|y| scale.unscale(y));
        self.step.nodes.extend(states.next());
        let mut held = held_joints(mesh, state).peekable();
        for i in 1..=mesh.elements() {
            let Some(mut node) = states.next() else { break };
            if let Some((_, j, joint)) = held.next_if(|(at, ..)| *at == i) {
                let Some(after) = states.next() else { break };
                let corner = mesh.rod.joints()[j].corner.adjoint_inverse().to_matrix().transpose();
                self.step.reactions[j] = node.1 - corner * after.1 - joint.load.tangent * node.0;
                node = after;
            }
            self.step.nodes.push(node);
        }
        Ok(())
    }
}

/// Node, number and state of the joints with a support, along the rod.
fn held_joints<'a, B: Elastic, const S: usize>(
    mesh: &'a Mesh<'_, B, S>,
    state: &'a Configuration<S>,
) -> impl Iterator<Item = (usize, usize, &'a JointState)> {
    let nodes = (1..=mesh.elements()).filter_map(|node| Some((node, mesh.joint_at(node)?)));
    let all = nodes.zip(&state.joints).map(|((node, j), joint)| (node, j, joint));
    all.filter(|(_, j, _)| !mesh.rod.joints()[*j].fixture.support.is_free())
}

pub(super) fn joint_equations<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    j: usize,
    joint: &JointState,
) -> Equations {
    let support = mesh.joint_support(j);
    let target = mesh.target(&support, &mesh.start.joints[j]);
    support.linearised(&joint.pose, &joint.applied, &joint.load, &target)
}

/// What the support of the base says of its first node: it applies −Λ_0.
pub(super) fn base_equations<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> Equations {
    let support = &mesh.rod.base_fixture().support;
    if support.is_clamped() {
        // a solve starts there and never leaves
        return Equations {
            residual: Vector6::zeros(),
            from_zeta: Matrix6::identity(),
            from_wrench: Matrix6::zeros(),
        };
    }
    let applied = -state.node_wrench[0];
    let mut rows = support.linearised(&state.node_pose[0], &applied, &state.base_load, &support.held());
    rows.from_wrench = -rows.from_wrench;
    rows
}

/// What the support of the tip says of the last node: it applies Λ_N.
pub(super) fn tip_equations<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> Equations {
    let (n, support) = (mesh.elements(), mesh.tip_support());
    let target = mesh.target(&support, &mesh.start.tip);
    support.linearised(&state.node_pose[n], &state.node_wrench[n], &state.tip_load, &target)
}

fn base_rows<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
    scale: &Scale,
) -> EndRows {
    end_rows(&base_equations(mesh, state), scale)
}

fn tip_rows<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
    scale: &Scale,
) -> EndRows {
    end_rows(&tip_equations(mesh, state), scale)
}

fn end_rows(equations: &Equations, scale: &Scale) -> EndRows {
    let matrix = scale.columns(&equations.from_zeta, &equations.from_wrench);
    let mut rows = EndRows { matrix, rhs: -equations.residual };
    for r in 0..6 {
        let size = rows.matrix.row(r).amax();
        if size > 0.0 {
            rows.matrix.row_mut(r).scale_mut(1.0 / size);
            rows.rhs[r] /= size;
        }
    }
    rows
}

/// ζ⁺ = Ad_C⁻¹ ζ⁻, and the support's equations on ζ⁻ and on what it applies, δΛ⁻ − Ad_C⁻ᵀ δΛ⁺.
fn joint_link(joint: &Joint, equations: &Equations, scale: &Scale) -> Link {
    let inverse = joint.corner.adjoint_inverse().to_matrix();
    let zero = Matrix6::zeros();
    let rows = end_rows(equations, scale);
    let mut link = Link { left: SMatrix::zeros(), right: SMatrix::zeros(), rhs: SVector::zeros() };
    let same = scale.columns(&inverse, &zero);
    let units = scale.displacement();
    for r in 0..6 {
        for c in 0..12 {
            link.left[(r, c)] = same[(r, c)] / units[r];
        }
        link.right[(r, r)] = -1.0;
    }
    link.left.fixed_view_mut::<6, 12>(6, 0).copy_from(&rows.matrix);
    link.rhs.fixed_rows_mut::<6>(6).copy_from(&rows.rhs);
    let carried = scale.columns(&zero, &inverse.transpose()).fixed_columns::<6>(6).into_owned();
    let wrench_units =
        SMatrix::<f64, 6, 6>::from_diagonal(&SVector::from(scale.wrench().map(|unit| 1.0 / unit)));
    let after = rows.matrix.fixed_columns::<6>(6) * (wrench_units * carried);
    link.right.fixed_view_mut::<6, 6>(6, 6).copy_from(&-after);
    link
}
