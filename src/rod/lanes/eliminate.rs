//! Elimination of the stage strains of loadless elements by blocks of three, without pivoting, a lane an element.

use super::STAGES;
use super::algebra::{Matrix, Vector, add_product, cross, dot, product, subtract_product};
use super::rows::{BlockRows, MatrixRows, NO_MATRIX, load_columns, load_matrix, store_columns, store_matrix};
use crate::scalar::Lane;

/// A determinant may be this small against the product of the sizes of its rows: rounding then changes the Newton step in its tenth digit.
const LEAST_DETERMINANT: f64 = 1e-6;

/// As [`LEAST_DETERMINANT`], of the stiffness against shear and extension, which has lost nothing by elimination.
const LEAST_STIFFNESS: f64 = 1e-10;

/// The equations of the stages: A_kl δω_l + B_kl δν_l = a_k and C_kl δω_l + K_νν δν_k = c_k.
#[derive(Clone)]
pub(super) struct System {
    pub(super) angular: [[MatrixRows; STAGES]; STAGES],
    pub(super) from_linear: [[MatrixRows; STAGES]; STAGES],
    pub(super) to_linear: [[MatrixRows; STAGES]; STAGES],
    /// K_νν⁻¹.
    pub(super) flexibility: [MatrixRows; STAGES],
    /// Inverses of the pivots.
    pivot: [MatrixRows; STAGES],
}

impl System {
    pub(super) fn new() -> Self {
        let blocks = [[NO_MATRIX; STAGES]; STAGES];
        let some = [NO_MATRIX; STAGES];
        Self { angular: blocks, from_linear: blocks, to_linear: blocks, flexibility: some, pivot: some }
    }

    /// Turns the right-hand sides (a, c) in `strain` into (δω, δν). The first three columns of c are zero and not looked at.
    #[inline(always)]
    pub(super) fn solve<L: Lane>(
        &mut self,
        strain: &mut [[BlockRows; 2]; STAGES],
        stages: usize,
        at: usize,
        suspect: &mut L,
    ) {
        for k in 0..stages {
            for l in 0..stages {
                let block = load_matrix::<L>(&self.from_linear[k][l], at);
                let factor = product(&block, &load_matrix(&self.flexibility[l], at));
                for m in 0..stages {
                    let to_linear = load_matrix(&self.to_linear[l][m], at);
                    let block = load_matrix(&self.angular[k][m], at);
                    store_matrix(&subtract_product(block, &factor, &to_linear), &mut self.angular[k][m], at);
                }
                let linear: [[L; 4]; 3] = load_columns(&strain[l][1], 3, at);
                let rhs = load_columns(&strain[k][0], 3, at);
                store_columns(&subtract_product(rhs, &factor, &linear), &mut strain[k][0], 3, at);
            }
        }
        self.forward(strain, stages, at, suspect);
        self.back::<L>(strain, stages, at);
        for k in 0..stages {
            let linear: [[L; 4]; 3] = load_columns(&strain[k][1], 3, at);
            let mut sum = [[L::splat(0.0); 7]; 3];
            for r in 0..3 {
                for c in 0..4 {
                    sum[r][3 + c] = linear[r][c];
                }
            }
            for l in 0..stages {
                let block = load_matrix(&self.to_linear[k][l], at);
                sum = subtract_product(sum, &block, &load_columns(&strain[l][0], 0, at));
            }
            let flexibility = load_matrix(&self.flexibility[k], at);
            store_columns(&product(&flexibility, &sum), &mut strain[k][1], 0, at);
        }
    }

    #[inline(always)]
    fn forward<L: Lane>(
        &mut self,
        strain: &mut [[BlockRows; 2]; STAGES],
        stages: usize,
        at: usize,
        suspect: &mut L,
    ) {
        for k in 0..stages {
            let before = row_sizes(&load_matrix::<L>(&self.angular[k][k], at));
            for above in 0..k {
                let block = load_matrix::<L>(&self.angular[k][above], at);
                let factor = product(&block, &load_matrix(&self.pivot[above], at));
                for m in above + 1..stages {
                    let upper = load_matrix(&self.angular[above][m], at);
                    let block = load_matrix(&self.angular[k][m], at);
                    store_matrix(&subtract_product(block, &factor, &upper), &mut self.angular[k][m], at);
                }
                let upper: [[L; 7]; 3] = load_columns(&strain[above][0], 0, at);
                let rhs = load_columns(&strain[k][0], 0, at);
                store_columns(&subtract_product(rhs, &factor, &upper), &mut strain[k][0], 0, at);
            }
            let block = load_matrix(&self.angular[k][k], at);
            store_matrix(&invert(&block, &before, suspect), &mut self.pivot[k], at);
        }
    }

    #[inline(always)]
    fn back<L: Lane>(&mut self, strain: &mut [[BlockRows; 2]; STAGES], stages: usize, at: usize) {
        for k in (0..stages).rev() {
            let mut sum: [[L; 7]; 3] = load_columns(&strain[k][0], 0, at);
            for l in k + 1..stages {
                let block = load_matrix(&self.angular[k][l], at);
                sum = subtract_product(sum, &block, &load_columns(&strain[l][0], 0, at));
            }
            store_columns(&product(&load_matrix(&self.pivot[k], at), &sum), &mut strain[k][0], 0, at);
        }
    }
}

/// Σ |entries| of every row.
#[inline(always)]
fn row_sizes<L: Lane>(m: &Matrix<L>) -> Vector<L> {
    let mut sizes = m[0];
    for r in 0..3 {
        sizes[r] = m[r][0].abs() + m[r][1].abs() + m[r][2].abs();
    }
    sizes
}

/// The inverse by cofactors, which are rows here for the columns of the inverse, and the determinant.
#[inline(always)]
fn cofactors<L: Lane>([a, b, c]: &Matrix<L>) -> (Matrix<L>, L) {
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, &rows[0]);
    (rows, determinant)
}

#[inline(always)]
fn transposed<L: Lane>(factor: L, m: &Matrix<L>) -> Matrix<L> {
    let mut out = *m;
    for r in 0..3 {
        for c in 0..3 {
            out[r][c] = m[c][r] * factor;
        }
    }
    out
}

/// The inverse of a pivot whose rows had the given sizes before the elimination; suspect where it lost its digits.
#[inline(always)]
fn invert<L: Lane>(m: &Matrix<L>, before: &Vector<L>, suspect: &mut L) -> Matrix<L> {
    let after = row_sizes(m);
    let mut size = L::splat(LEAST_DETERMINANT);
    for r in 0..3 {
        size = size * before[r].select_lt(after[r], after[r], before[r]);
    }
    let (rows, determinant) = cofactors(m);
    *suspect = size.select_lt(determinant.abs(), *suspect, L::splat(1.0));
    transposed(L::splat(1.0) / determinant, &rows)
}

/// The inverse of a positive definite stiffness against shear and extension; suspect where it is not clearly definite.
#[inline(always)]
pub(super) fn invert_definite<L: Lane>(k: &Matrix<L>, suspect: &mut L) -> Matrix<L> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    // scaled, so that EA = 1e150 is still fine
    let scale = one / (k[0][0].abs() + k[1][1].abs() + k[2][2].abs());
    let mut scaled = *k;
    for r in 0..3 {
        for c in 0..3 {
            scaled[r][c] = k[r][c] * scale;
        }
    }
    let (rows, determinant) = cofactors(&scaled);
    let diagonal = scaled[0][0] * scaled[1][1] * scaled[2][2];
    let excess = determinant - L::splat(LEAST_STIFFNESS) * diagonal;
    for positive in [scaled[0][0], scaled[1][1], diagonal, excess] {
        *suspect = zero.select_lt(positive, *suspect, one);
    }
    transposed(scale / determinant, &rows)
}

/// What the strains make of ζ_{i+1} = (w, v): adds B_el δξ_l.
#[inline(always)]
pub(super) fn add_end<L: Lane>(
    [w, v]: &mut [[[L; 7]; 3]; 2],
    variation: &super::algebra::Map<L>,
    strain: &[BlockRows; 2],
    at: usize,
) {
    let (angular, linear) = (load_columns(&strain[0], 0, at), load_columns(&strain[1], 0, at));
    *w = add_product(*w, &variation.diagonal, &angular);
    *v = add_product(*v, &variation.lower, &angular);
    *v = add_product(*v, &variation.diagonal, &linear);
}
