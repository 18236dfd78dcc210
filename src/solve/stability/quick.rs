//! Whether a cantilever is stable, without counting.

use nalgebra::Matrix6;

use super::index::Chain;

/// A pivot below this part of its diagonal is not surely positive.
const SURELY: f64 = 1e-7;

impl Chain {
    /// Whether a rod that is clamped at its base, and held by nothing but springs and loads elsewhere, surely has no unstable and no neutral mode.
    ///
    /// From the tip, −P being what the rod beyond a node answers: with the blocks of an element, X = Dᵀ + Bᵀ P, the pivot of its far node is positive if
    /// X B is, and P ← (Cᵀ + Aᵀ P) X⁻¹ at its near one.
    pub(crate) fn is_surely_stable(&self) -> bool {
        let clamped = self.base.fixed == [true; 6];
        if !clamped || !self.stops.is_empty() || self.tip.fixed != [false; 6] {
            return false;
        }
        let mut p = self.tip.stiffness;
        for link in self.links.iter().rev() {
            let x = link.momentum_momentum.transpose() + link.zeta_momentum.tr_mul(&p);
            if !is_surely_positive(&(x * link.zeta_momentum)) {
                return false;
            }
            let Some(inverse) = x.try_inverse() else { return false };
            p = (link.momentum_zeta.transpose() + link.zeta_zeta.tr_mul(&p)) * inverse;
            p = 0.5 * (p + p.transpose());
        }
        true
    }
}

/// Cholesky's factorisation of the symmetric part, with pivots that are well above rounding.
fn is_surely_positive(matrix: &Matrix6<f64>) -> bool {
    let mut a = 0.5 * (matrix + matrix.transpose());
    for k in 0..6 {
        let diagonal = matrix[(k, k)];
        if !(a[(k, k)] > SURELY * diagonal && diagonal > 0.0) {
            return false;
        }
        let inverse = 1.0 / a[(k, k)];
        for r in k + 1..6 {
            let factor = a[(r, k)] * inverse;
            for c in k + 1..=r {
                a[(r, c)] -= factor * a[(c, k)];
            }
        }
    }
    true
}
