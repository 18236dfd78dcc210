//! The rod linearised as a whole: matrices in its strains, and the motions that its supports and fixed strains allow.

use nalgebra::{DMatrix, Matrix6, RowVector6, Vector6};

use super::core::Core;
use super::mount::Mount;
use super::relation::Relation;
use crate::lie::{Twist, Wrench};
use crate::rod::adjoint::AdjointElement;
use crate::rod::support::Condition;

/// The rod linearised in its strains, and in the displacement of a base that can move.
pub(super) struct LinearRod<'a, const S: usize> {
    core: &'a Core<S>,
    elements: Vec<AdjointElement<S>>,
    /// What the wrench on the section of each mount answers to a displacement of it.
    tangents: Vec<Matrix6<f64>>,
}

impl<'a, const S: usize> LinearRod<'a, S> {
    /// About the state that `core` has balanced.
    pub(super) fn new(core: &'a Core<S>) -> Self {
        let relation = core.problem.relation;
        let elements = (0..core.grid.elements).map(|i| core.element(i, &Matrix6::zeros())).collect();
        let tangent = |(m, mount): (usize, &Mount)| {
            let mut tangent = mount.force_tangent(&relation);
            if !mount.support.is_free() && relation != Relation::Held {
                // −Σ (∂χ_j/∂ζ)ᵀ ∂(Q_j + k χ_j)/∂ζ over what is not held
                let (pose, rows) = (&core.node_pose[mount.node], core.equations(m));
                let chi = mount.coordinate_map(pose);
                for (j, condition) in mount.support.conditions().iter().enumerate() {
                    if !matches!(condition, Condition::Fixed(_)) {
                        tangent -= chi.row(j).transpose() * rows.from_zeta.row(j);
                    }
                }
            }
            tangent
        };
        let tangents = core.mounts.iter().enumerate().map(tangent).collect();
        Self { core, elements, tangents }
    }

    fn strains(&self) -> usize {
        6 * S * self.elements.len()
    }

    fn size(&self) -> usize {
        self.strains() + if self.core.loose { 6 } else { 0 }
    }

    /// The displacement of every node, before its corner.
    fn displacements(&self, q: &[f64]) -> Vec<Vector6<f64>> {
        let strains = self.strains();
        let mut zeta = vec![if q.len() > strains { six(q, strains) } else { Vector6::zeros() }];
        for (i, element) in self.elements.iter().enumerate() {
            let mut next = element.end_inverse.apply(&self.turned_on(i, &zeta[i]));
            for k in 0..S {
                next += element.end[k].apply(&Twist::from_vector(&six(q, 6 * (S * i + k))));
            }
            zeta.push(next.to_vector());
        }
        zeta
    }

    fn turned_on(&self, i: usize, zeta: &Vector6<f64>) -> Twist {
        let zeta = Twist::from_vector(zeta);
        self.core.between(i).map_or(zeta, |mount| mount.turned_on(&zeta))
    }

    /// The matrix whose columns are what the rod answers to unit strains, and to unit displacements of a base that can move; symmetric.
    pub(super) fn assemble(&self) -> DMatrix<f64> {
        let n = self.size();
        let mut matrix = DMatrix::zeros(n, n);
        let mut q = vec![0.0; n];
        for column in 0..n {
            q[column] = 1.0;
            let answer = self.apply(&q);
            matrix.column_mut(column).copy_from_slice(&answer[..n]);
            q[column] = 0.0;
        }
        let transpose = matrix.transpose();
        (matrix + transpose) * 0.5
    }

    /// The residuals of the stages, and minus the wrench on the base.
    fn apply(&self, q: &[f64]) -> Vec<f64> {
        let zeta = self.displacements(q);
        let n = self.elements.len();
        let mut answer = vec![0.0; self.strains() + 6];
        let mut wrench = self.tangents[self.tangents.len() - 1] * zeta[n];
        for (i, element) in self.elements.iter().enumerate().rev() {
            let beyond = Wrench::from_vector(&wrench);
            let start = self.turned_on(i, &zeta[i]).to_vector();
            let mut before = element.end_inverse.apply_transpose(&beyond).to_vector() + element.u * start;
            for k in 0..S {
                let mut row = -element.end[k].apply_transpose(&beyond).to_vector() - element.p[k] * start;
                for m in 0..S {
                    row += element.a[k][m] * six(q, 6 * (S * i + m));
                }
                answer[6 * (S * i + k)..6 * (S * i + k) + 6].copy_from_slice(row.as_slice());
                before -= element.q[k] * six(q, 6 * (S * i + k));
            }
            if let Some(mount) = self.core.between(i) {
                before = mount.turned_back(&Wrench::from_vector(&before)).to_vector();
            }
            if let Some(m) = self.core.mount_at[i] {
                before += self.tangents[m] * zeta[i];
            }
            wrench = before;
        }
        let base = self.strains();
        answer[base..].copy_from_slice((-wrench).as_slice());
        answer
    }

    /// The motions that fixed strains and supports allow, as columns.
    pub(super) fn basis(&self, core: &Core<S>) -> DMatrix<f64> {
        let (n, strains) = (self.size(), self.strains());
        let free: Vec<usize> = (0..n).filter(|&c| c >= strains || !core.grid.fixed[c % 6]).collect();
        let held = |mount: &&Mount| !mount.support.is_free() && (mount.node > 0 || core.loose);
        let mut rows: Vec<(usize, RowVector6<f64>)> = Vec::new();
        for mount in core.mounts.iter().filter(held) {
            let chi = mount.coordinate_map(&core.node_pose[mount.node]);
            for (j, condition) in mount.support.conditions().iter().enumerate() {
                if matches!(condition, Condition::Fixed(_)) {
                    let unit = if j < 3 { 1.0 } else { core.grid.length };
                    rows.push((mount.node, chi.row(j) / unit));
                }
            }
        }
        let mut conditions = DMatrix::zeros(rows.len(), free.len());
        let mut q = vec![0.0; n];
        for (c, &unknown) in free.iter().enumerate() {
            q[unknown] = 1.0;
            let zeta = self.displacements(&q);
            for (r, (node, row)) in rows.iter().enumerate() {
                conditions[(r, c)] = (row * zeta[*node])[0];
            }
            q[unknown] = 0.0;
        }
        let inner = null_space(conditions);
        let mut basis = DMatrix::zeros(n, inner.ncols());
        for (r, &unknown) in free.iter().enumerate() {
            basis.row_mut(unknown).copy_from(&inner.row(r));
        }
        basis
    }
}

/// A basis of the vectors that a matrix of few rows sends to zero: elimination with complete pivoting.
fn null_space(mut rows: DMatrix<f64>) -> DMatrix<f64> {
    /// A pivot this small says nothing that others have not said.
    const NOTHING: f64 = 1e-10;
    let n = rows.ncols();
    let mut pivots: Vec<usize> = Vec::new();
    for r in 0..rows.nrows() {
        let rest = rows.rows(r, rows.nrows() - r);
        let (row, column) = rest.iamax_full();
        if !(rest[(row, column)].abs() > NOTHING) {
            break;
        }
        rows.swap_rows(r, r + row);
        let scale = 1.0 / rows[(r, column)];
        rows.row_mut(r).scale_mut(scale);
        for other in (0..rows.nrows()).filter(|&other| other != r) {
            let factor = rows[(other, column)];
            let change = rows.row(r) * factor;
            let mut target = rows.row_mut(other);
            target -= change;
        }
        pivots.push(column);
    }
    let others: Vec<usize> = (0..n).filter(|c| !pivots.contains(c)).collect();
    let mut basis = DMatrix::zeros(n, others.len());
    for (c, &other) in others.iter().enumerate() {
        basis[(other, c)] = 1.0;
        for (r, &pivot) in pivots.iter().enumerate() {
            basis[(pivot, c)] = -rows[(r, other)];
        }
    }
    basis
}

pub(super) fn six(q: &[f64], at: usize) -> Vector6<f64> {
    Vector6::from_column_slice(&q[at..at + 6])
}
