//! Gaussian elimination of the stage strains of one element, with row pivoting.

use nalgebra::{Matrix3, SMatrix};

use super::condense::COLUMNS;
use super::element::Linearisation;

/// Solves for the curvatures of up to three stages: 3S equations with C right-hand sides, which the solution replaces. `None` if they are
/// singular.
#[inline(always)]
pub(super) fn solve_rows<const S: usize, const C: usize>(
    matrix: &[[Matrix3<f64>; S]; S],
    rhs: &mut [SMatrix<f64, 3, C>; S],
) -> Option<()> {
    const MAX: usize = 9;
    let n = 3 * S;
    let mut left = [[0.0_f64; MAX]; MAX];
    let mut right = [[0.0_f64; C]; MAX];
    for k in 0..S {
        for r in 0..3 {
            for m in 0..S {
                for c in 0..3 {
                    left[3 * k + r][3 * m + c] = matrix[k][m][(r, c)];
                }
            }
            for c in 0..C {
                right[3 * k + r][c] = rhs[k][(r, c)];
            }
        }
    }
    for column in 0..n {
        let mut pivot = column;
        for row in column + 1..n {
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
        for row in column + 1..n {
            let factor = left[row][column] * inverse;
            for c in column..MAX {
                left[row][c] -= factor * pivot_left[c];
            }
            for c in 0..C {
                right[row][c] -= factor * pivot_right[c];
            }
        }
    }
    for row in (0..n).rev() {
        let inverse = 1.0 / left[row][row];
        let mut value = right[row];
        for c in row + 1..n {
            for j in 0..C {
                value[j] -= left[row][c] * right[c][j];
            }
        }
        right[row] = value.map(|v| v * inverse);
    }
    for k in 0..S {
        for r in 0..3 {
            for c in 0..C {
                rhs[k][(r, c)] = right[3 * k + r][c];
            }
        }
    }
    Some(())
}

/// As [`solve_rows`] for the curvatures that are not `fixed`: fewer equations; the others are zero.
pub(super) fn solve_free_rows<const S: usize, const C: usize>(
    matrix: &[[Matrix3<f64>; S]; S],
    rhs: &mut [SMatrix<f64, 3, C>; S],
    fixed: &[bool; 6],
) -> Option<()> {
    const MAX: usize = 9;
    let mut free = [(0, 0); MAX];
    let mut n = 0;
    for k in 0..S {
        for r in (0..3).filter(|&r| !fixed[r]) {
            free[n] = (k, r);
            n += 1;
        }
    }
    let mut rows = [[0.0_f64; MAX + COLUMNS]; MAX];
    for (row, &(k, r)) in rows.iter_mut().zip(&free[..n]) {
        for (entry, &(m, c)) in row.iter_mut().zip(&free[..n]) {
            *entry = matrix[k][m][(r, c)];
        }
        for c in 0..C {
            row[n + c] = rhs[k][(r, c)];
        }
    }
    eliminate(&mut rows[..n], n + C)?;
    rhs.iter_mut().for_each(|rhs| rhs.fill(0.0));
    for (row, &(k, r)) in rows.iter().zip(&free[..n]) {
        for c in 0..C {
            rhs[k][(r, c)] = row[n + c];
        }
    }
    Some(())
}

/// Solves A X = (P_Λ, −r, P_ζ) for all strains at once that are not fixed, rows scaled by their largest entry.
pub(super) fn solve_general<const S: usize>(
    element: &Linearisation<S>,
    fixed: &[bool; 6],
) -> Option<[SMatrix<f64, 6, COLUMNS>; S]> {
    const MAX: usize = 18;
    const WIDTH: usize = MAX + COLUMNS;
    let mut free = [(0, 0); MAX];
    let mut n = 0;
    for k in 0..S {
        for r in (0..6).filter(|&r| !fixed[r]) {
            free[n] = (k, r);
            n += 1;
        }
    }
    let mut rows = [[0.0_f64; WIDTH]; MAX];
    for (row, &(k, r)) in rows.iter_mut().zip(&free[..n]) {
        for (entry, &(m, c)) in row.iter_mut().zip(&free[..n]) {
            *entry = element.stage[k][m][(r, c)];
        }
        for c in 0..6 {
            row[n + c] = element.from_wrench[k][(r, c)];
            row[n + 7 + c] = element.from_zeta[k][(r, c)];
        }
        row[n + 6] = -element.residual[k].to_array()[r];
        let size = row[..n].iter().fold(0.0_f64, |size, v| size.max(v.abs()));
        row.iter_mut().for_each(|v| *v /= size);
    }
    eliminate(&mut rows[..n], n + COLUMNS)?;
    let mut solution = [SMatrix::zeros(); S];
    for (row, &(k, r)) in rows.iter().zip(&free[..n]) {
        for c in 0..COLUMNS {
            solution[k][(r, c)] = row[n + c];
        }
    }
    Some(solution)
}

/// Gaussian elimination with row pivoting of as many unknowns as rows, the right-hand sides in the columns after them up to `width`; the
/// solution is where they were. `None` where no pivot is left.
fn eliminate<const W: usize>(rows: &mut [[f64; W]], width: usize) -> Option<()> {
    let n = rows.len();
    for column in 0..n {
        let pivot = (column..n).max_by(|&p, &q| rows[p][column].abs().total_cmp(&rows[q][column].abs()))?;
        if !(rows[pivot][column].abs() > f64::MIN_POSITIVE && rows[pivot][column].is_finite()) {
            return None;
        }
        rows.swap(column, pivot);
        let (done, rest) = rows.split_at_mut(column + 1);
        let pivot_row = &done[column];
        for row in &mut rest[..n - column - 1] {
            let factor = row[column] / pivot_row[column];
            for c in column..width {
                row[c] -= factor * pivot_row[c];
            }
        }
    }
    for column in (0..n).rev() {
        let (above, rest) = rows.split_at_mut(column);
        let row = &mut rest[0];
        let inverse = 1.0 / row[column];
        row[n..width].iter_mut().for_each(|v| *v *= inverse);
        for other in above {
            let factor = other[column];
            for c in n..width {
                other[c] -= factor * row[c];
            }
        }
    }
    Some(())
}
