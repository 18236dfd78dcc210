//! The linear system of a chain: 12 unknowns a node, 12 equations an element, 6 at each end.

use nalgebra::{SMatrix, SVector};

use crate::error::{Error, Result};

pub(crate) type State = SVector<f64, 12>;

/// Six equations C y = d at one end.
#[derive(Clone, Debug)]
pub(crate) struct EndRows {
    pub(crate) matrix: SMatrix<f64, 6, 12>,
    pub(crate) rhs: SVector<f64, 6>,
}

/// Twelve equations A y_i + B y_{i+1} = c between two nodes.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) left: SMatrix<f64, 12, 12>,
    pub(crate) right: SMatrix<f64, 12, 12>,
    pub(crate) rhs: State,
}

const WIDTH: usize = 25;
type Row = [f64; WIDTH];

/// Memory of the elimination, kept from solve to solve.
#[derive(Default)]
pub(crate) struct Chain {
    pivots: Vec<[Row; 12]>,
    states: Vec<State>,
}

impl Chain {
    /// Solves the chain by Gaussian elimination with row pivoting inside a window of one link: O(N), and stable where
    /// marching y_{i+1} = T y_i + c (linear shooting) loses all digits.
    ///
    /// `station` gives the arc length of node i, for the error alone.
    pub(crate) fn solve(
        &mut self,
        left: &EndRows,
        links: impl Iterator<Item = Link>,
        right: &EndRows,
        station: impl Fn(usize) -> f64,
    ) -> Result<&[State]> {
        let mut carry: [Row; 6] = std::array::from_fn(|r| end_row(left, r));
        self.pivots.clear();
        for link in links {
            let mut window = [[0.0; WIDTH]; 18];
            window[..6].copy_from_slice(&carry);
            for r in 0..12 {
                let row = &mut window[6 + r];
                for c in 0..12 {
                    row[c] = link.left[(r, c)];
                    row[12 + c] = link.right[(r, c)];
                }
                row[24] = link.rhs[r];
            }
            eliminate(&mut window).ok_or_else(|| singular(station(self.pivots.len())))?;
            self.pivots.push(std::array::from_fn(|r| window[r]));
            carry = std::array::from_fn(|r| {
                let mut row = [0.0; WIDTH];
                row[..12].copy_from_slice(&window[12 + r][12..24]);
                row[24] = window[12 + r][24];
                row
            });
        }
        let mut last = [[0.0; WIDTH]; 12];
        last[..6].copy_from_slice(&carry);
        for r in 0..6 {
            last[6 + r] = end_row(right, r);
        }
        eliminate(&mut last).ok_or_else(|| singular(station(self.pivots.len())))?;
        self.pivots.push(last);
        substitute(&self.pivots, &mut self.states);
        Ok(&self.states)
    }
}

fn singular(s: f64) -> Error {
    Error::Singular { matrix: "tangent of the rod", s }
}

fn end_row(rows: &EndRows, r: usize) -> Row {
    let mut row = [0.0; WIDTH];
    for c in 0..12 {
        row[c] = rows.matrix[(r, c)];
    }
    row[24] = rows.rhs[r];
    row
}

/// Eliminates the first 12 columns; the first 12 rows become the pivot rows. `None` where no pivot is left.
fn eliminate(rows: &mut [Row]) -> Option<()> {
    for column in 0..12 {
        let pivot =
            (column..rows.len()).max_by(|&p, &q| rows[p][column].abs().total_cmp(&rows[q][column].abs()))?;
        if !(rows[pivot][column].abs() > f64::MIN_POSITIVE && rows[pivot][column].is_finite()) {
            return None;
        }
        rows.swap(column, pivot);
        let (done, rest) = rows.split_at_mut(column + 1);
        let pivot_row = &done[column];
        for row in rest {
            let factor = row[column] / pivot_row[column];
            if factor != 0.0 {
                for c in column..WIDTH {
                    row[c] -= factor * pivot_row[c];
                }
            }
        }
    }
    Some(())
}

fn substitute(pivots: &[[Row; 12]], states: &mut Vec<State>) {
    states.clear();
    states.resize(pivots.len(), State::zeros());
    let mut next = State::zeros();
    for (rows, state) in pivots.iter().zip(states).rev() {
        for r in (0..12).rev() {
            let mut value = rows[r][24];
            for c in 0..12 {
                value -= rows[r][12 + c] * next[c];
            }
            for c in r + 1..12 {
                value -= rows[r][c] * state[c];
            }
            state[r] = value / rows[r][r];
        }
        next = *state;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// A reproducible number in (−1, 1).
    fn noise(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    #[test]
    fn the_chain_agrees_with_a_dense_solve() {
        let n = 5;
        let mut seed = 7;
        let mut end = || EndRows {
            matrix: SMatrix::from_fn(|_, _| noise(&mut seed)),
            rhs: SVector::from_fn(|_, _| noise(&mut seed)),
        };
        let (left, right) = (end(), end());
        let links: Vec<_> = (0..n)
            .map(|_| Link {
                left: SMatrix::from_fn(|_, _| noise(&mut seed)),
                right: SMatrix::from_fn(|_, _| noise(&mut seed)),
                rhs: SVector::from_fn(|_, _| noise(&mut seed)),
            })
            .collect();
        let size = 12 * (n + 1);
        let (mut a, mut b) = (DMatrix::zeros(size, size), DVector::zeros(size));
        a.view_mut((0, 0), (6, 12)).copy_from(&left.matrix);
        b.rows_mut(0, 6).copy_from(&left.rhs);
        for (i, link) in links.iter().enumerate() {
            let row = 6 + 12 * i;
            a.view_mut((row, 12 * i), (12, 12)).copy_from(&link.left);
            a.view_mut((row, 12 * i + 12), (12, 12)).copy_from(&link.right);
            b.rows_mut(row, 12).copy_from(&link.rhs);
        }
        a.view_mut((size - 6, size - 12), (6, 12)).copy_from(&right.matrix);
        b.rows_mut(size - 6, 6).copy_from(&right.rhs);
        let dense = a.lu().solve(&b).unwrap();
        let mut chain = Chain::default();
        let chain = chain.solve(&left, links.into_iter(), &right, |i| i as f64).unwrap();
        for (i, y) in chain.iter().enumerate() {
            for c in 0..12 {
                // a random 72×72 system has condition of order 1e3: 1e-16 × 1e3 with room for the growth of both
                assert!((y[c] - dense[12 * i + c]).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn a_chain_without_a_solution_says_where() {
        let rows = EndRows { matrix: SMatrix::zeros(), rhs: SVector::zeros() };
        let error = Chain::default().solve(&rows, std::iter::empty(), &rows, |_| 0.25).unwrap_err();
        assert_eq!(error, Error::Singular { matrix: "tangent of the rod", s: 0.25 });
    }
}
