//! What a rod has unknown besides its strains, the motion of a base that can move and what the supports apply: a small dense system.
//!
//! The elements are solved for a base that stays and supports that apply what they did; every further unknown answers with one column of
//! displacements and wrenches.

use nalgebra::{DMatrix, DVector, Dyn, FullPivLU, Matrix6, Vector6};

use crate::error::{Error, Result};
use crate::lie::{Strain, Wrench};

/// A singular value this small, relative to the largest, is none.
const NOTHING: f64 = 1e-9;

/// The answer of the elements to one component of what a support applies, for a base that stays.
#[derive(Clone, Debug)]
pub(super) struct Column<const S: usize> {
    /// The strains of the elements before the support, as [`back`](super::factor::FactoredElement::back) gives them.
    pub(super) strain: Vec<[Strain; S]>,
    pub(super) at_base: Wrench,
}

/// The system, scaled and factored.
pub(super) struct Border<const S: usize> {
    /// Of all components of all supports that react, in their order along the rod.
    pub(super) columns: Vec<Column<S>>,
    matrix: DMatrix<f64>,
    rows: DVector<f64>,
    scale: DVector<f64>,
    inverse: Inverse,
}

enum Inverse {
    None,
    Exact(FullPivLU<f64, Dyn, Dyn>),
    /// Of a rod that its supports leave free to move, at rest: what has no answer is left out.
    Least(DMatrix<f64>),
}

impl<const S: usize> Border<S> {
    pub(super) fn empty() -> Self {
        let (matrix, none) = (DMatrix::zeros(0, 0), DVector::zeros(0));
        Self { columns: Vec::new(), matrix, rows: none.clone(), scale: none, inverse: Inverse::None }
    }

    /// Scales rows and columns to a largest entry of one, and factors.
    pub(super) fn factor(&mut self, matrix: DMatrix<f64>, at_rest: bool) -> Result<()> {
        let n = matrix.nrows();
        let unit = |largest: f64| if largest > 0.0 { 1.0 / largest } else { 1.0 };
        let (mut rows, mut scale) = (DVector::from_element(n, 1.0), DVector::from_element(n, 1.0));
        let mut scaled = matrix.clone();
        // twice: units of rows and columns differ
        for _ in 0..2 {
            for r in 0..n {
                let factor = unit(scaled.row(r).amax());
                scaled.row_mut(r).scale_mut(factor);
                rows[r] *= factor;
            }
            for c in 0..n {
                let factor = unit(scaled.column(c).amax());
                scaled.column_mut(c).scale_mut(factor);
                scale[c] *= factor;
            }
        }
        if !scaled.iter().all(|v| v.is_finite()) {
            return Err(Error::Singular { matrix: "tangent of the supports", s: 0.0 });
        }
        (self.matrix, self.rows, self.scale) = (matrix, rows, scale);
        self.inverse = if at_rest {
            let size = scaled.amax();
            let inverse = scaled.pseudo_inverse(NOTHING * size);
            Inverse::Least(
                inverse.map_err(|_| Error::Singular { matrix: "tangent of the supports", s: 0.0 })?,
            )
        } else {
            let lu = scaled.full_piv_lu();
            if !lu.is_invertible() {
                return Err(Error::Singular { matrix: "tangent of the supports", s: 0.0 });
            }
            Inverse::Exact(lu)
        };
        Ok(())
    }

    pub(super) fn solve(&self, rhs: &DVector<f64>) -> Option<DVector<f64>> {
        let scaled = rhs.component_mul(&self.rows);
        let solved = match &self.inverse {
            Inverse::None => None,
            Inverse::Exact(lu) => lu.solve(&scaled),
            Inverse::Least(inverse) => Some(inverse * scaled),
        };
        solved.map(|x| x.component_mul(&self.scale))
    }

    /// Appends all numbers, which make the same system again.
    pub(super) fn save(&self, into: &mut Vec<f64>) {
        into.extend(self.matrix.iter());
        for column in &self.columns {
            into.extend(column.strain.iter().flatten().flat_map(|strain| strain.to_array()));
            into.extend(column.at_base.to_array());
        }
    }

    /// The opposite of [`save`](Self::save), for supports at these nodes; `None` where numbers are missing.
    pub(super) fn restore(
        &mut self,
        size: usize,
        supports: impl Iterator<Item = usize>,
        from: &mut impl Iterator<Item = f64>,
    ) -> Option<()> {
        let mut numbers = |count: usize| -> Option<Vec<f64>> {
            let taken: Vec<f64> = from.take(count).collect();
            (taken.len() == count).then_some(taken)
        };
        let matrix = DMatrix::from_vec(size, size, numbers(size * size)?);
        self.columns.clear();
        for node in supports {
            for _ in 0..6 {
                let strains = numbers(6 * S * node)?;
                let at = |i: usize, k: usize| {
                    let first = 6 * (S * i + k);
                    Strain::from_vector(&Vector6::from_column_slice(&strains[first..first + 6]))
                };
                let strain = (0..node).map(|i| std::array::from_fn(|k| at(i, k))).collect();
                let at_base = Wrench::from_vector(&Vector6::from_vec(numbers(6)?));
                self.columns.push(Column { strain, at_base });
            }
        }
        self.factor(matrix, false).ok()
    }
}

/// Puts a block of six by six.
pub(super) fn put(into: &mut DMatrix<f64>, row: usize, column: usize, block: &Matrix6<f64>) {
    into.fixed_view_mut::<6, 6>(row, column).copy_from(block);
}
