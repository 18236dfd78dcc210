//! Numbers of a block of elements in memory, and the part of them that is in registers: `at` says from which element on.

use super::algebra::{Map, Matrix, Pair, Vector};
use crate::scalar::Lane;

/// Elements in a block: lanes of the widest registers.
pub(crate) const ELEMENTS: usize = 8;

/// One number of every element.
pub(crate) type Row = [f64; ELEMENTS];

pub(crate) const NOTHING: Row = [0.0; ELEMENTS];

/// A 3×3 matrix of every element.
pub(super) type MatrixRows = [[Row; 3]; 3];

/// A [`Map`] of every element: diagonal, lower.
pub(super) type MapRows = [MatrixRows; 2];

/// Columns of everything that depends on the first node of an element: δΛ_i, then 1, then w_i where there are loads.
pub(super) const COLUMNS: usize = 10;

/// How many of them there are without loads.
pub(super) const LOADLESS: usize = 7;

/// Three equations, or unknowns, of every element.
pub(super) type BlockRows = [[Row; COLUMNS]; 3];

pub(super) const NO_MATRIX: MatrixRows = [[NOTHING; 3]; 3];
pub(super) const NO_BLOCK: BlockRows = [[NOTHING; COLUMNS]; 3];

#[inline(always)]
pub(super) fn load_vector<L: Lane>(rows: &[Row; 3], at: usize) -> Vector<L> {
    [L::load(&rows[0][at..]), L::load(&rows[1][at..]), L::load(&rows[2][at..])]
}

#[inline(always)]
pub(super) fn load_matrix<L: Lane>(rows: &MatrixRows, at: usize) -> Matrix<L> {
    [load_vector(&rows[0], at), load_vector(&rows[1], at), load_vector(&rows[2], at)]
}

#[inline(always)]
pub(super) fn load_map<L: Lane>(rows: &MapRows, at: usize) -> Map<L> {
    Map { diagonal: load_matrix(&rows[0], at), lower: load_matrix(&rows[1], at) }
}

#[inline(always)]
pub(super) fn load_pair<L: Lane>(rows: &[Row; 6], at: usize) -> Pair<L> {
    let [a, b, c, d, e, f] = rows;
    Pair {
        first: [L::load(&a[at..]), L::load(&b[at..]), L::load(&c[at..])],
        second: [L::load(&d[at..]), L::load(&e[at..]), L::load(&f[at..])],
    }
}

/// C columns from column `from` on.
#[inline(always)]
pub(super) fn load_columns<L: Lane, const C: usize>(rows: &BlockRows, from: usize, at: usize) -> [[L; C]; 3] {
    let mut block = [[L::splat(0.0); C]; 3];
    for r in 0..3 {
        for c in 0..C {
            block[r][c] = L::load(&rows[r][from + c][at..]);
        }
    }
    block
}

#[inline(always)]
pub(super) fn store_columns<L: Lane, const C: usize>(
    block: &[[L; C]; 3],
    rows: &mut BlockRows,
    from: usize,
    at: usize,
) {
    for r in 0..3 {
        for c in 0..C {
            block[r][c].store(&mut rows[r][from + c][at..]);
        }
    }
}

#[inline(always)]
pub(super) fn store_matrix<L: Lane>(m: &Matrix<L>, rows: &mut MatrixRows, at: usize) {
    for r in 0..3 {
        for c in 0..3 {
            m[r][c].store(&mut rows[r][c][at..]);
        }
    }
}

#[inline(always)]
pub(super) fn store_map<L: Lane>(map: &Map<L>, rows: &mut MapRows, at: usize) {
    store_matrix(&map.diagonal, &mut rows[0], at);
    store_matrix(&map.lower, &mut rows[1], at);
}
