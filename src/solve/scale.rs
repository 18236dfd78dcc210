use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::chain::{Link, State};
use crate::lie::Wrench;
use crate::rod::condense::Transfer;

/// Units that make displacements and wrenches of a rod comparable: its length, and a force its bending stiffness makes of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    pub(crate) length: f64,
    pub(crate) force: f64,
}

/// The largest components that wrenches have; one that is no number does not count.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Largest([f64; 6]);

impl Largest {
    #[inline(always)]
    pub(crate) fn add(&mut self, wrench: &Wrench) {
        for (largest, v) in self.0.iter_mut().zip(wrench.to_array()) {
            let v = v.abs();
            *largest = if v > *largest { v } else { *largest };
        }
    }
}

/// A matrix in the units of its rows and columns.
pub(crate) fn rescale(matrix: &Matrix6<f64>, rows: [f64; 6], columns: [f64; 6]) -> Matrix6<f64> {
    Matrix6::from_fn(|r, c| matrix[(r, c)] * columns[c] / rows[r])
}

impl Scale {
    /// Units of (θ, u): rotations need none.
    pub(crate) fn displacement(&self) -> [f64; 6] {
        [1.0, 1.0, 1.0, self.length, self.length, self.length]
    }

    /// Units of (m, n).
    pub(crate) fn wrench(&self) -> [f64; 6] {
        let moment = self.force * self.length;
        [moment, moment, moment, self.force, self.force, self.force]
    }

    /// The size of a wrench in these units.
    pub(crate) fn wrench_size(&self, wrench: &Wrench) -> f64 {
        let (moment, force) = (wrench.moment.amax(), wrench.force.amax());
        f64::max(moment / (self.force * self.length), force / self.force)
    }

    /// The size of the largest of some wrenches in these units.
    pub(crate) fn largest(&self, largest: &Largest) -> f64 {
        let [a, b, c, x, y, z] = largest.0;
        f64::max(a.max(b).max(c) / (self.force * self.length), x.max(y).max(z) / self.force)
    }

    /// The physical displacement and wrench of a node's scaled unknowns.
    pub(crate) fn unscale(&self, y: &State) -> (Vector6<f64>, Vector6<f64>) {
        let (d, w) = (self.displacement(), self.wrench());
        (Vector6::from_fn(|i, _| y[i] * d[i]), Vector6::from_fn(|i, _| y[6 + i] * w[i]))
    }

    /// y_{i+1} − T y_i = c in scaled unknowns, from the transfer in physical units.
    pub(crate) fn transfer(&self, element: &Transfer) -> Link {
        let t = [
            [&element.zeta_from_zeta, &element.zeta_from_wrench],
            [&element.wrench_from_zeta, &element.wrench_from_wrench],
        ];
        let c = [&element.zeta, &element.wrench];
        let units = [self.displacement(), self.wrench()];
        let mut link = Link { left: SMatrix::zeros(), right: SMatrix::identity(), rhs: SVector::zeros() };
        for i in 0..2 {
            for j in 0..2 {
                let block = -rescale(t[i][j], units[i], units[j]);
                link.left.fixed_view_mut::<6, 6>(6 * i, 6 * j).copy_from(&block);
            }
            for r in 0..6 {
                link.rhs[6 * i + r] = c[i][r] / units[i][r];
            }
        }
        link
    }

    /// The columns (ζ, δΛ) of a row in scaled unknowns.
    pub(crate) fn columns<const R: usize>(
        &self,
        from_zeta: &SMatrix<f64, R, 6>,
        from_wrench: &SMatrix<f64, R, 6>,
    ) -> SMatrix<f64, R, 12> {
        let (d, w) = (self.displacement(), self.wrench());
        SMatrix::from_fn(
            |r, c| if c < 6 { from_zeta[(r, c)] * d[c] } else { from_wrench[(r, c - 6)] * w[c - 6] },
        )
    }
}
