//! Gaussian elimination of the stage strains of one element, with row pivoting.

use nalgebra::SMatrix;

use super::element::Linearisation;

/// Columns of everything that depends on the element's first node: δΛ_i, then 1, then ζ_i.
pub(super) const WRENCH: usize = 0;
pub(super) const ONE: usize = 6;
pub(super) const ZETA: usize = 7;
pub(super) const COLUMNS: usize = 13;

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
            row[n + WRENCH + c] = element.from_wrench[k][(r, c)];
            row[n + ZETA + c] = element.from_zeta[k][(r, c)];
        }
        row[n + ONE] = -element.residual[k].to_array()[r];
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
