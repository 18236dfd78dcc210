//! Whether a rod is held: no rigid motion that neither a support nor a load resists.

use nalgebra::{DMatrix, Matrix6, Vector6};

use super::equilibrium::Configuration;
use super::mesh::Mesh;
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::Pose;
use crate::load::LoadWrench;
use crate::rod::element::frame_change;
use crate::rod::support::{Condition, Support};

/// A singular value this small, relative to the largest, is none.
const NOTHING: f64 = 1e-9;

/// Refuses a rod with a rigid motion Z (g → exp(Z^) g) that no support holds and whose stiffness under the loads vanishes at the start,
/// where `state` is.
pub(super) fn check<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> Result<()> {
    let length = mesh.rod.body().length();
    let free = free_motions(mesh, state, length);
    if free.ncols() == 0 {
        return Ok(());
    }
    let (stiffness, size) = load_stiffness(mesh, state);
    let units = Vector6::from([1.0, 1.0, 1.0, length, length, length]);
    let scaled = Matrix6::from_fn(|r, c| units[r] * stiffness[(r, c)] * units[c]);
    let held = free.transpose() * scaled * &free;
    let (values, vectors) = null_space(&held, NOTHING * size * length);
    if values == 0 {
        return Ok(());
    }
    let motion = free * vectors.column(0);
    let motion: Vector6<f64> = Vector6::from_fn(|i, _| motion[i] * units[i]);
    let (turn, shift) = (motion.fixed_rows::<3>(0), motion.fixed_rows::<3>(3));
    let (name, v) = if turn.norm() * length > 1e-6 * shift.norm() {
        ("rotation about", turn.normalize())
    } else {
        ("translation along", shift.normalize())
    };
    let clean = |v: f64| if v.abs() < 1e-12 { 0.0 } else { v };
    Err(Error::FreeToMove { motion: name, x: clean(v[0]), y: clean(v[1]), z: clean(v[2]) })
}

/// A basis of the rigid motions that the supports allow, in units (rad, length).
fn free_motions<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
    length: f64,
) -> DMatrix<f64> {
    let n = mesh.elements();
    let rod = mesh.rod;
    let mut rows: Vec<Vector6<f64>> = Vec::new();
    let mut hold = |support: &Support, pose: &Pose| {
        let every = Support::clamped(*support.frame());
        let equations = every.linearised(pose, &Default::default(), &LoadWrench::none(), &[0.0; 6]);
        let map = equations.from_zeta * pose.adjoint_inverse().to_matrix();
        for (j, condition) in support.conditions().iter().enumerate() {
            if *condition != Condition::Free {
                let unit = if j < 3 { 1.0 } else { length };
                rows.push(Vector6::from_fn(|c, _| map[(j, c)] * if c < 3 { 1.0 } else { length } / unit));
            }
        }
    };
    hold(&rod.base_fixture().support, &state.node_pose[0]);
    hold(&rod.tip_fixture().support, &state.node_pose[n]);
    for (joint, at) in rod.joints().iter().zip(&state.joints) {
        hold(&joint.fixture.support, &at.pose);
    }
    let gram = rows.iter().fold(Matrix6::zeros(), |sum, row| sum + row * row.transpose());
    let gram = DMatrix::from_iterator(6, 6, gram.iter().copied());
    let (count, vectors) = null_space(&gram, NOTHING);
    vectors.columns(0, count).into_owned()
}

/// d(total wrench of the loads about the origin)/dZ, and the size of what is summed.
fn load_stiffness<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> (Matrix6<f64>, f64) {
    let mut sum = Matrix6::zeros();
    let mut size: f64 = 0.0;
    let length = mesh.rod.body().length();
    let mut add = |pose: &Pose, load: &LoadWrench, weight: f64| {
        let inverse = pose.adjoint_inverse().to_matrix();
        sum += inverse.transpose() * (load.tangent - frame_change(&load.wrench)) * inverse * weight;
        size += weight * (load.wrench.force.norm() + load.wrench.moment.norm() / length);
        size += weight * load.tangent.norm();
    };
    add(&state.node_pose[0], &state.base_load, 1.0);
    add(&state.node_pose[mesh.elements()], &state.tip_load, 1.0);
    for joint in &state.joints {
        add(&joint.pose, &joint.load, 1.0);
    }
    for (i, motion) in state.kinematics.iter().enumerate() {
        for (k, pose) in motion.stage.iter().enumerate() {
            let Some(load) = state.stage_loads(i).at_stage(k, pose) else { break };
            add(&(state.node_pose[i] * *pose), &load, mesh.h(i) * mesh.table.b[k]);
        }
    }
    (sum, size)
}

/// How many singular values are at most `tiny`, and the right singular vectors, those of the smallest values first.
fn null_space(matrix: &DMatrix<f64>, tiny: f64) -> (usize, DMatrix<f64>) {
    let n = matrix.ncols();
    let svd = matrix.clone().svd(false, true);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| svd.singular_values[*a].total_cmp(&svd.singular_values[*b]));
    let values = svd.singular_values.iter().filter(|value| **value <= tiny.max(f64::MIN_POSITIVE)).count();
    let right = svd.v_t.unwrap_or_else(|| DMatrix::identity(n, n));
    (values, DMatrix::from_fn(n, n, |r, c| right[(order[c], r)]))
}
