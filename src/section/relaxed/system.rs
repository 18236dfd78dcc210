//! The linear system of a section's relaxation: positive definite, or with pressures a saddle.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// H z = b for the Hessian of the energy in the amplitudes, or of the Lagrangian in amplitudes and pressures,
///
/// [A −Bᵀ; −B 0]: with A + ρBᵀB in place of A, which changes no solution, it is solved through S = B (A + ρBᵀB)⁻¹ Bᵀ. That A is positive
/// on displacements that keep the volume is then that A + ρBᵀB is positive (Finsler's lemma).
pub(super) struct System {
    factor: Cholesky<f64, Dyn>,
    volume: Option<Volume>,
    /// Whether the Hessian had to be shifted to become positive.
    pub(super) shifted: bool,
}

struct Volume {
    b: DMatrix<f64>,
    rho: f64,
    /// (A + ρBᵀB)⁻¹ Bᵀ.
    spread: DMatrix<f64>,
    schur: Cholesky<f64, Dyn>,
}

/// ρ, relative to the largest diagonal entries of A and BᵀB.
const AUGMENTATION: f64 = 100.0;

/// Shifts tried, from 1e-4 of the largest diagonal entry, each four times the one before.
const SHIFTS: usize = 20;

impl System {
    /// `None` where no shift makes the Hessian positive, or the pressures are not independent.
    pub(super) fn new(hessian: &DMatrix<f64>, b: Option<&DMatrix<f64>>) -> Option<Self> {
        let Some(b) = b else {
            let (factor, shifted) = factorise(hessian)?;
            return Some(Self { factor, volume: None, shifted });
        };
        let (augmented, rho) = augmented(hessian, b);
        let (factor, shifted) = factorise(&augmented)?;
        let spread = factor.solve(&b.transpose());
        let schur = (b * &spread).cholesky()?;
        Some(Self { factor, volume: Some(Volume { b: b.clone(), rho, spread, schur }), shifted })
    }

    /// z for every column of b.
    pub(super) fn solve(&self, right: &DMatrix<f64>) -> DMatrix<f64> {
        let Some(Volume { b, rho, spread, schur }) = &self.volume else { return self.factor.solve(right) };
        let (n, m) = (b.ncols(), b.nrows());
        // A z − Bᵀ p = f, −B z = g: (A + ρBᵀB) z − Bᵀ p = f − ρBᵀ g
        let g = right.rows(n, m);
        let f = right.rows(0, n) - b.tr_mul(&g) * *rho;
        let free = self.factor.solve(&f);
        let pressures = schur.solve(&(-g - b * &free));
        let mut out = DMatrix::zeros(n + m, right.ncols());
        out.rows_mut(0, n).copy_from(&(free + spread * &pressures));
        out.rows_mut(n, m).copy_from(&pressures);
        out
    }

    /// z for one column.
    pub(super) fn solve_one(&self, right: &DVector<f64>) -> DVector<f64> {
        let right = DMatrix::from_column_slice(right.len(), 1, right.as_slice());
        self.solve(&right).column(0).into_owned()
    }
}

/// A + ρBᵀB, whose sign tells of stability, and ρ.
pub(super) fn augmented(hessian: &DMatrix<f64>, b: &DMatrix<f64>) -> (DMatrix<f64>, f64) {
    let square = b.tr_mul(b);
    let rho = AUGMENTATION * hessian.diagonal().amax() / square.diagonal().amax();
    (hessian + square * rho, rho)
}

/// The Cholesky factor of a Hessian, shifted by as much as makes it positive definite, and whether it had to be.
fn factorise(hessian: &DMatrix<f64>) -> Option<(Cholesky<f64, Dyn>, bool)> {
    if let Some(factor) = hessian.clone().cholesky() {
        return Some((factor, false));
    }
    let mut shift = 1e-4 * hessian.diagonal().amax();
    for _ in 0..SHIFTS {
        let mut moved = hessian.clone();
        for i in 0..moved.nrows() {
            moved[(i, i)] += shift;
        }
        if let Some(factor) = moved.cholesky() {
            return Some((factor, true));
        }
        shift *= 4.0;
    }
    None
}
