//! The chain of elements solved by a sweep from the free end: half the price of elimination with pivoting, where it holds.

use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};

use super::linear::NodeStep;
use super::scale::Scale;
use crate::lie::{Wrench, so3::hat};
use crate::rod::condense::{Condensed, Transfer};

/// How far the solution may miss the equations of the chain, relative to its largest wrench. Newton's method removes what is left.
const MISFIT: f64 = 1e-7;

/// δΛ_i = S_i ζ_i + s_i, what the part of the rod beyond node i answers to a displacement of its end.
///
/// It breaks where that part, clamped at node i, is at a critical load: never for a stable state, whose parts are all stable.
/// The answer is therefore checked against the equations of the chain.
#[derive(Default)]
pub(crate) struct Sweep {
    full: Vec<(Matrix6<f64>, Vector6<f64>)>,
    dead: Vec<DeadRelation>,
    /// Of the last sweep under a dead force alone, else 0: no node resists a rotation by less, with the node before it held and the rod
    /// beyond it free.
    ///
    /// Elements that are stable by themselves make a stable rod if this is positive at every node: these are the pivots of the second variation.
    pub(super) least_stiffness: f64,
}

/// What closes the chain at the tip: δΛ_N = D ζ_N.
pub(crate) struct Tip<'a> {
    pub(crate) tangent: &'a Matrix6<f64>,
    /// Whether there is no load but on the tip.
    pub(crate) alone: bool,
}

impl Sweep {
    /// ζ and δΛ of all nodes, for a clamped base. `None` where the sweep breaks.
    ///
    /// `wrenches` are those of the nodes, `elements` one less.
    pub(crate) fn solve<const S: usize>(
        &mut self,
        elements: &[Condensed<S>],
        wrenches: &[Wrench],
        tip: &Tip<'_>,
        scale: &Scale,
        nodes: &mut Vec<NodeStep>,
    ) -> Option<()> {
        let rows = scale.wrench().map(|unit| 1.0 / unit);
        nodes.clear();
        self.least_stiffness = 0.0;
        if tip.alone && is_dead(tip.tangent, &wrenches[elements.len()].force) {
            return self.solve_dead(elements, wrenches, tip.tangent, &rows, nodes);
        }
        self.full.clear();
        self.full.resize(elements.len() + 1, (*tip.tangent, Vector6::zeros()));
        for i in (0..elements.len()).rev() {
            let (earlier, later) = self.full.split_at_mut(i + 1);
            earlier[i] = step_back(&elements[i].transfer, &later[0], &rows)?;
        }
        let (mut zeta, mut wrench) = (Vector6::zeros(), self.full[0].1);
        let mut misfit = Misfit::default();
        nodes.push((zeta, wrench));
        for (element, (s, c)) in elements.iter().zip(&self.full[1..]) {
            let t = &element.transfer;
            let next = t.zeta_from_zeta * zeta + t.zeta_from_wrench * wrench + t.zeta;
            let carried = t.wrench_from_zeta * zeta + t.wrench_from_wrench * wrench + t.wrench;
            (zeta, wrench) = (next, s * next + c);
            misfit.add(&carried, &wrench, &rows);
            nodes.push((zeta, wrench));
        }
        misfit.is_small()
    }

    /// Under nothing but a dead force on the tip (and a moment that depends on its rotation), the force is known, δn = n × w, and where the
    /// rod is does not matter: δm_i = S_i w_i + s_i, three unknowns instead of six.
    fn solve_dead<const S: usize>(
        &mut self,
        elements: &[Condensed<S>],
        wrenches: &[Wrench],
        tip: &Matrix6<f64>,
        rows: &[f64; 6],
        nodes: &mut Vec<NodeStep>,
    ) -> Option<()> {
        let corner: Matrix3<f64> = tip.fixed_view::<3, 3>(0, 0).into();
        self.dead.clear();
        self.dead.resize(elements.len() + 1, (corner, Vector3::zeros()));
        let mut least = f64::INFINITY;
        for i in (0..elements.len()).rev() {
            let (relation, stiffness) =
                step_back_dead(&elements[i].transfer, &self.dead[i + 1], &wrenches[i].force)?;
            self.dead[i] = relation;
            // not min, which would drop a NaN
            least = if stiffness > least { least } else { stiffness };
        }
        self.least_stiffness = if least > 0.0 { least } else { 0.0 };
        let (mut zeta, mut wrench) = (Vector6::zeros(), Vector6::zeros());
        wrench.fixed_rows_mut::<3>(0).copy_from(&self.dead[0].1);
        let mut misfit = Misfit::default();
        nodes.push((zeta, wrench));
        for (i, element) in elements.iter().enumerate() {
            let t = &element.transfer;
            let next = t.zeta_from_zeta * zeta + t.zeta_from_wrench * wrench + t.zeta;
            let carried = t.wrench_from_wrench * wrench + t.wrench;
            let (s, c) = &self.dead[i + 1];
            let turn: Vector3<f64> = next.fixed_rows::<3>(0).into();
            zeta = next;
            wrench.fixed_rows_mut::<3>(0).copy_from(&(s * turn + c));
            wrench.fixed_rows_mut::<3>(3).copy_from(&wrenches[i + 1].force.cross(&turn));
            misfit.add(&carried, &wrench, rows);
            nodes.push((zeta, wrench));
        }
        misfit.is_small()
    }
}

/// How far a sweep misses the balance of the elements.
#[derive(Default)]
struct Misfit {
    largest_difference: f64,
    largest: f64,
}

impl Misfit {
    #[inline(always)]
    fn add(&mut self, carried: &Vector6<f64>, wrench: &Vector6<f64>, rows: &[f64; 6]) {
        for r in 0..6 {
            let difference = (carried[r] - wrench[r]).abs() * rows[r];
            // not max, which would drop a NaN
            if !(difference <= self.largest_difference) {
                self.largest_difference = difference;
            }
            self.largest = self.largest.max(carried[r].abs() * rows[r]);
        }
    }

    fn is_small(&self) -> Option<()> {
        (self.largest_difference <= MISFIT * self.largest.max(1e-300)).then_some(())
    }
}

/// Whether D = [[·, 0], [n^, 0]].
fn is_dead(tangent: &Matrix6<f64>, force: &Vector3<f64>) -> bool {
    tangent.fixed_columns::<3>(3) == Matrix6x3::zeros() && tangent.fixed_view::<3, 3>(3, 0) == hat(force)
}

/// A lower bound for the eigenvalues of D = M P⁻¹, the stiffness of the node after an element against a rotation; not positive if D is not.
///
/// Pᵀ M = Pᵀ D P is definite as D is. λ₁ ≥ 4 det/tr² for three positive eigenvalues.
#[inline(always)]
fn stiffness_bound(matrix: &Matrix3<f64>, p: &Matrix3<f64>) -> f64 {
    let product = p.tr_mul(matrix);
    let a = (product + product.transpose()) * 0.5;
    let minor = a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(0, 1)];
    if !(a[(0, 0)] > 0.0 && minor > 0.0) {
        return 0.0;
    }
    let trace = a.trace();
    4.0 * a.determinant() / (trace * trace * p.norm_squared())
}

/// δm = S w + s: S and s.
type DeadRelation = (Matrix3<f64>, Vector3<f64>);

/// The relation of the node before an element, and the [`stiffness_bound`] of that after it.
///
/// (T_mm − S P_wm) δm_i = (S (Rᵀ + P_wn n^) − T_mn n^) w_i + S p_w + s − t_m, with T the moment rows and P the rotation rows of the transfer.
#[inline]
fn step_back_dead(t: &Transfer, (s, c): &DeadRelation, force: &Vector3<f64>) -> Option<(DeadRelation, f64)> {
    let n = hat(force);
    let p_wm: Matrix3<f64> = t.zeta_from_wrench.fixed_view::<3, 3>(0, 0).into();
    let p_wn = t.zeta_from_wrench.fixed_view::<3, 3>(0, 3);
    let matrix = t.wrench_from_wrench.fixed_view::<3, 3>(0, 0) - s * p_wm;
    let turned = t.zeta_from_zeta.fixed_view::<3, 3>(0, 0) + p_wn * n;
    let from_turn = s * turned - t.wrench_from_wrench.fixed_view::<3, 3>(0, 3) * n;
    let constant = s * t.zeta.fixed_rows::<3>(0) + c - t.wrench.fixed_rows::<3>(0);
    let mut left = [[0.0; 3]; 3];
    let mut right = [[0.0; 4]; 3];
    for r in 0..3 {
        for k in 0..3 {
            left[r][k] = matrix[(r, k)];
            right[r][k] = from_turn[(r, k)];
        }
        right[r][3] = constant[r];
    }
    eliminate(&mut left, &mut right)?;
    let relation = Matrix3::from_fn(|r, k| right[r][k]);
    let stiffness = stiffness_bound(&matrix, &p_wm);
    Some(((relation, Vector3::from_fn(|r, _| right[r][3])), stiffness))
}

/// (T_ΛΛ − S T_ζΛ) δΛ_i = (S T_ζζ − T_Λζ) ζ_i + (S t_ζ + s − t_Λ), rows in units of the rod.
fn step_back(
    t: &Transfer,
    (s, c): &(Matrix6<f64>, Vector6<f64>),
    rows: &[f64; 6],
) -> Option<(Matrix6<f64>, Vector6<f64>)> {
    let matrix = t.wrench_from_wrench - s * t.zeta_from_wrench;
    let from_zeta = s * t.zeta_from_zeta - t.wrench_from_zeta;
    let constant = s * t.zeta + c - t.wrench;
    let mut left = [[0.0_f64; 6]; 6];
    let mut right = [[0.0_f64; 7]; 6];
    for r in 0..6 {
        for k in 0..6 {
            left[r][k] = matrix[(r, k)] * rows[r];
            right[r][k] = from_zeta[(r, k)] * rows[r];
        }
        right[r][6] = constant[r] * rows[r];
    }
    eliminate(&mut left, &mut right)?;
    let relation = Matrix6::from_fn(|r, k| right[r][k]);
    Some((relation, Vector6::from_fn(|r, _| right[r][6])))
}

/// Gaussian elimination with row pivoting; the solution is in `right`.
#[inline(always)]
fn eliminate<const N: usize, const C: usize>(
    left: &mut [[f64; N]; N],
    right: &mut [[f64; C]; N],
) -> Option<()> {
    for column in 0..N {
        let mut pivot = column;
        for row in column + 1..N {
            if left[row][column].abs() > left[pivot][column].abs() {
                pivot = row;
            }
        }
        let size = left[pivot][column].abs();
        if !(size > f64::MIN_POSITIVE && size.is_finite()) {
            return None;
        }
        left.swap(column, pivot);
        right.swap(column, pivot);
        let (pivot_left, pivot_right) = (left[column], right[column]);
        let inverse = 1.0 / pivot_left[column];
        for row in column + 1..N {
            let factor = left[row][column] * inverse;
            for k in 0..N {
                left[row][k] -= factor * pivot_left[k];
            }
            for k in 0..C {
                right[row][k] -= factor * pivot_right[k];
            }
        }
    }
    for row in (0..N).rev() {
        let inverse = 1.0 / left[row][row];
        let mut value = right[row];
        for k in row + 1..N {
            for j in 0..C {
                value[j] -= left[row][k] * right[k][j];
            }
        }
        right[row] = value.map(|v| v * inverse);
    }
    Some(())
}
