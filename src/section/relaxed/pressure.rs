//! The pressure that keeps the volume: L = ∫(u − π (J − 1)) dV, π made of the functions of the displacement up to one degree less.

use nalgebra::{DMatrix, DVector, SMatrix, Vector6};

use super::assembly::{Displaced, packed_any, times};
use super::modes::Modes;
use crate::material::{GradientState, Request};

/// Conditions on the volume, cₐ = ∫ψₐ (J − 1) dV, and their first derivatives.
pub(super) struct Conditions {
    pub(super) values: DVector<f64>,
    /// ∂c/∂c: conditions × coefficients.
    pub(super) coefficients: DMatrix<f64>,
    /// ∂c/∂Δξ.
    pub(super) strain: DMatrix<f64>,
}

/// ψₐ at point q.
pub(super) fn function(modes: &Modes, a: usize, q: usize) -> f64 {
    modes.space.table[(2 * modes.points.len() + q, a)]
}

/// dψₐ/ds at point q, which moves.
pub(super) fn function_rate(modes: &Modes, a: usize, q: usize) -> f64 {
    modes.space.rate.as_ref().map_or(0.0, |rate| rate[(2 * modes.points.len() + q, a)])
}

/// H at point q.
pub(super) fn gradient_at(displaced: &Displaced<'_>, q: usize) -> [f64; 9] {
    let n = displaced.modes.points.len();
    std::array::from_fn(|c| displaced.h[c * n + q])
}

/// cof F by rows, and J − 1.
pub(super) fn cofactor(h: &[f64; 9]) -> ([f64; 9], f64) {
    let mut f = *h;
    for i in 0..3 {
        f[4 * i] += 1.0;
    }
    let mut cofactor = [0.0; 9];
    let (mut minors, mut det) = (0.0, 0.0);
    for i in 0..3 {
        let (j, k) = (3 * ((i + 1) % 3), 3 * ((i + 2) % 3));
        for a in 0..3 {
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            cofactor[3 * i + a] = f[j + b] * f[k + c] - f[j + c] * f[k + b];
            let own = h[j + b] * h[k + c] - h[j + c] * h[k + b];
            if i == a {
                minors += own;
            }
            if i == 0 {
                det += h[a] * own;
            }
        }
    }
    (cofactor, h[0] + h[4] + h[8] + minors + det)
}

/// Adds what the pressure does to the state of the law: P − π cof F, ∂P − π F×, P′ − π′ cof F.
pub(super) fn press(
    displaced: &Displaced<'_>,
    pressures: &[f64],
    request: Request,
    state: &mut GradientState,
) {
    let modes = displaced.modes;
    let n = modes.points.len();
    for q in 0..n {
        let sum = |f: &dyn Fn(usize) -> f64| pressures.iter().enumerate().map(|(a, p)| p * f(a)).sum::<f64>();
        let pressure = sum(&|a| function(modes, a, q));
        let h = gradient_at(displaced, q);
        let (cofactor, _) = cofactor(&h);
        for c in 0..9 {
            state.stress[c * n + q] -= pressure * cofactor[c];
        }
        if request >= Request::Tangent {
            for row in 0..9 {
                for column in row + 1..9 {
                    if let Some((third, sign)) = crossed(row, column) {
                        let f = h[third] + if third % 4 == 0 { 1.0 } else { 0.0 };
                        state.stiffness[packed_any(row, column) * n + q] -= pressure * sign * f;
                    }
                }
            }
        }
        if request >= Request::Rate {
            let rate = sum(&|a| function_rate(modes, a, q));
            for c in 0..9 {
                state.stress_rate[c * n + q] -= rate * cofactor[c];
            }
        }
    }
}

/// ∂²J/∂F∂F has ±F there: which entry of F, with which sign.
fn crossed(row: usize, column: usize) -> Option<(usize, f64)> {
    let ((i, a), (k, b)) = ((row / 3, row % 3), (column / 3, column % 3));
    if i == k || a == b {
        return None;
    }
    let sign = |from: usize, to: usize| if (from + 1) % 3 == to { 1.0 } else { -1.0 };
    Some((3 * (3 - i - k) + (3 - a - b), sign(i, k) * sign(a, b)))
}

/// The conditions on the volume with their derivatives, for the first `count` functions.
pub(super) fn conditions(displaced: &Displaced<'_>, count: usize) -> Conditions {
    let modes = displaced.modes;
    let n = modes.points.len();
    let mut values = DVector::zeros(count);
    let mut strain = DMatrix::zeros(count, 6);
    let mut coefficients = DMatrix::zeros(count, modes.full());
    let mut cofactors = vec![0.0; 9 * n];
    let mut columns = Vec::with_capacity(n);
    let mut changes = Vec::with_capacity(n);
    for q in 0..n {
        let (cofactor, change) = cofactor(&gradient_at(displaced, q));
        for c in 0..9 {
            cofactors[c * n + q] = cofactor[c];
        }
        let third = [cofactor[2], cofactor[5], cofactor[8]];
        let moment = times(&displaced.position(q), &third);
        let [a, b, c] = moment;
        columns.push(SMatrix::<f64, 1, 6>::from([[a], [b], [c], [third[0]], [third[1]], [third[2]]]));
        changes.push(change);
    }
    for a in 0..count {
        let weight: Vec<f64> = (0..n).map(|q| displaced.frame.volume[q] * function(modes, a, q)).collect();
        let pulled = displaced.pulled(&cofactors, &weight);
        coefficients.set_row(a, &displaced.gather(&pulled).transpose());
        let mut sum = Vector6::zeros().transpose();
        for q in 0..n {
            values[a] += weight[q] * changes[q];
            sum += columns[q] * (weight[q] * displaced.frame.inverse[q]);
        }
        strain.set_row(a, &sum);
    }
    Conditions { values, coefficients, strain }
}
