//! Elimination of the stage strains by blocks of three, without pivoting, a lane an element.

use super::STAGES;
use super::algebra::{Matrix, Vector, add_product, cross, dot, product, subtract_product};
use super::rows::{
    BlockRows, COLUMNS, ELEMENTS, LOADLESS, MatrixRows, NO_MATRIX, NOTHING, load_columns, load_matrix,
    store_columns, store_matrix,
};
use crate::scalar::Lane;

/// A determinant may be this small against the product of the sizes of its rows: rounding then changes the Newton step in its tenth digit.
pub(crate) const LEAST_DETERMINANT: f64 = 1e-6;

/// As [`LEAST_DETERMINANT`], of the stiffness against shear and extension, which has lost nothing by elimination.
pub(crate) const LEAST_STIFFNESS: f64 = 1e-10;

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

    /// Takes the equations of the curvatures that are fixed out: they become δω = 0.
    #[inline(always)]
    pub(super) fn fix(&mut self, fixed: &[bool; 6], stages: usize, strain: &mut [[BlockRows; 2]; STAGES]) {
        for j in 0..3 {
            if !fixed[j] {
                continue;
            }
            for k in 0..stages {
                strain[k][0][j] = [NOTHING; COLUMNS];
                for l in 0..stages {
                    self.angular[k][l][j] = [NOTHING; 3];
                    self.from_linear[k][l][j] = [NOTHING; 3];
                    for r in 0..3 {
                        self.angular[k][l][r][j] = NOTHING;
                        self.to_linear[k][l][r][j] = NOTHING;
                    }
                }
                self.angular[k][k][j][j] = [1.0; ELEMENTS];
            }
        }
    }

    /// Turns the right-hand sides (a, c) in `strain` into (δω, δν). The first three columns of c are zero and not looked at.
    ///
    /// Without shear and extension, `soft` is false and there is no second equation; the columns after the seventh are those of loads.
    #[inline(always)]
    pub(super) fn solve<L: Lane>(
        &mut self,
        strain: &mut [[BlockRows; 2]; STAGES],
        stages: usize,
        (soft, loaded): (bool, bool),
        at: usize,
        suspect: &mut L,
    ) {
        if soft {
            for k in 0..stages {
                for l in 0..stages {
                    let block = load_matrix::<L>(&self.from_linear[k][l], at);
                    let factor = product(&block, &load_matrix(&self.flexibility[l], at));
                    for m in 0..stages {
                        subtract(&mut self.angular[k][m], &factor, &self.to_linear[l][m], at);
                    }
                    let linear: [[L; 4]; 3] = load_columns(&strain[l][1], 3, at);
                    subtract_columns(&mut strain[k][0], &factor, &linear, 3, at);
                    if loaded {
                        let linear: [[L; TURN]; 3] = load_columns(&strain[l][1], LOADLESS, at);
                        subtract_columns(&mut strain[k][0], &factor, &linear, LOADLESS, at);
                    }
                }
            }
        }
        self.forward(strain, stages, loaded, at, suspect);
        self.back::<L, LOADLESS>(strain, stages, 0, at);
        if loaded {
            self.back::<L, TURN>(strain, stages, LOADLESS, at);
        }
        if soft {
            self.recover::<L, LOADLESS>(strain, stages, 0, at);
            if loaded {
                self.recover::<L, TURN>(strain, stages, LOADLESS, at);
            }
        }
    }

    #[inline(always)]
    fn forward<L: Lane>(
        &mut self,
        strain: &mut [[BlockRows; 2]; STAGES],
        stages: usize,
        loaded: bool,
        at: usize,
        suspect: &mut L,
    ) {
        for k in 0..stages {
            let before = row_sizes(&load_matrix::<L>(&self.angular[k][k], at));
            for above in 0..k {
                let block = load_matrix::<L>(&self.angular[k][above], at);
                let factor = product(&block, &load_matrix(&self.pivot[above], at));
                for m in above + 1..stages {
                    let (earlier, later) = self.angular.split_at_mut(k);
                    subtract(&mut later[0][m], &factor, &earlier[above][m], at);
                }
                let upper: [[L; LOADLESS]; 3] = load_columns(&strain[above][0], 0, at);
                subtract_columns(&mut strain[k][0], &factor, &upper, 0, at);
                if loaded {
                    let upper: [[L; TURN]; 3] = load_columns(&strain[above][0], LOADLESS, at);
                    subtract_columns(&mut strain[k][0], &factor, &upper, LOADLESS, at);
                }
            }
            let block = load_matrix(&self.angular[k][k], at);
            store_matrix(&invert(&block, &before, suspect), &mut self.pivot[k], at);
        }
    }

    /// δω, of C columns.
    #[inline(always)]
    fn back<L: Lane, const C: usize>(
        &self,
        strain: &mut [[BlockRows; 2]; STAGES],
        stages: usize,
        from: usize,
        at: usize,
    ) {
        for k in (0..stages).rev() {
            let mut sum: [[L; C]; 3] = load_columns(&strain[k][0], from, at);
            for l in k + 1..stages {
                let block = load_matrix(&self.angular[k][l], at);
                sum = subtract_product(sum, &block, &load_columns(&strain[l][0], from, at));
            }
            store_columns(&product(&load_matrix(&self.pivot[k], at), &sum), &mut strain[k][0], from, at);
        }
    }

    /// δν from δω, of C columns.
    #[inline(always)]
    fn recover<L: Lane, const C: usize>(
        &self,
        strain: &mut [[BlockRows; 2]; STAGES],
        stages: usize,
        from: usize,
        at: usize,
    ) {
        for k in 0..stages {
            let mut sum: [[L; C]; 3] = load_columns(&strain[k][1], from, at);
            if from == 0 {
                for row in &mut sum {
                    row[0] = L::splat(0.0);
                    row[1] = L::splat(0.0);
                    row[2] = L::splat(0.0);
                }
            }
            for l in 0..stages {
                let block = load_matrix(&self.to_linear[k][l], at);
                sum = subtract_product(sum, &block, &load_columns(&strain[l][0], from, at));
            }
            let flexibility = load_matrix(&self.flexibility[k], at);
            store_columns(&product(&flexibility, &sum), &mut strain[k][1], from, at);
        }
    }
}

/// Columns of loads.
const TURN: usize = COLUMNS - LOADLESS;

/// block − factor other.
#[inline(always)]
fn subtract<L: Lane>(block: &mut MatrixRows, factor: &Matrix<L>, other: &MatrixRows, at: usize) {
    let rest = subtract_product(load_matrix(block, at), factor, &load_matrix(other, at));
    store_matrix(&rest, block, at);
}

/// rows − factor columns, from a column on.
#[inline(always)]
fn subtract_columns<L: Lane, const C: usize>(
    rows: &mut BlockRows,
    factor: &Matrix<L>,
    columns: &[[L; C]; 3],
    from: usize,
    at: usize,
) {
    let rest = subtract_product(load_columns(rows, from, at), factor, columns);
    store_columns(&rest, rows, from, at);
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

/// The inverse of a positive definite stiffness against shear and extension among the strains that are free, zero in the rows and columns
/// of those that are fixed; suspect where it is not clearly definite.
#[inline(always)]
pub(super) fn invert_free<L: Lane>(k: &Matrix<L>, fixed: &[bool; 6], suspect: &mut L) -> Matrix<L> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    // scaled, so that EA = 1e150 is still fine
    let mut size = zero;
    for i in 0..3 {
        if !fixed[3 + i] {
            size = size + k[i][i].abs();
        }
    }
    let scale = one / size;
    let mut scaled = *k;
    for r in 0..3 {
        for c in 0..3 {
            let held = fixed[3 + r] || fixed[3 + c];
            scaled[r][c] = if !held { k[r][c] * scale } else { L::splat(if r == c { 1.0 } else { 0.0 }) };
        }
    }
    let (rows, determinant) = cofactors(&scaled);
    let diagonal = scaled[0][0] * scaled[1][1] * scaled[2][2];
    let excess = determinant - L::splat(LEAST_STIFFNESS) * diagonal;
    for positive in [scaled[0][0], scaled[1][1], diagonal, excess] {
        *suspect = zero.select_lt(positive, *suspect, one);
    }
    let mut flexibility = transposed(scale / determinant, &rows);
    for i in 0..3 {
        if fixed[3 + i] {
            flexibility[i][i] = zero;
        }
    }
    flexibility
}

/// What the strains make of ζ_{i+1} = (w, v), C columns of it: adds B_el δξ_l.
#[inline(always)]
pub(super) fn add_end<L: Lane, const C: usize>(
    [w, v]: &mut [[[L; C]; 3]; 2],
    variation: &super::algebra::Map<L>,
    soft: bool,
    strain: &[BlockRows; 2],
    from: usize,
    at: usize,
) {
    let angular = load_columns(&strain[0], from, at);
    *w = add_product(*w, &variation.diagonal, &angular);
    *v = add_product(*v, &variation.lower, &angular);
    if soft {
        let linear = load_columns(&strain[1], from, at);
        *v = add_product(*v, &variation.diagonal, &linear);
    }
}
