//! Ψ′ of a relaxed section: how the wrench changes along s at fixed Δξ while the section stays in equilibrium.
//!
//! With c the coefficients of the displacement, A c = 0 the six conditions that hold no rigid motion in it, and λ their multipliers,
//! equilibrium U_c + Aᵀλ = 0 is differentiated in s: points, weights, reference and law move, the functions with the points.

use nalgebra::{DMatrix, DVector, Vector6};

use super::assembly::{Displaced, column, times};
use super::equilibrium::Equilibrium;
use super::modes::Modes;
use super::pressure;
use crate::material::{GradientState, Station};

/// Derivatives in s, at fixed strain and coefficients, of the first derivatives of U.
struct Drift {
    strain: Vector6<f64>,
    coefficients: DVector<f64>,
    /// H′ at the points, by rows, and the rate of their volumes.
    h: Vec<[f64; 9]>,
    volume: Vec<f64>,
}

/// d/ds of ∫ψₐ (J − 1) dV at fixed strain and coefficients.
fn conditions_drift(displaced: &Displaced<'_>, drift: &Drift, count: usize) -> DVector<f64> {
    let modes = displaced.modes;
    DVector::from_fn(count, |a, _| {
        (0..modes.points.len())
            .map(|q| {
                let (cofactor, change) = pressure::cofactor(&pressure::gradient_at(displaced, q));
                let (value, rate) = (pressure::function(modes, a, q), pressure::function_rate(modes, a, q));
                let growth: f64 = (0..9).map(|c| cofactor[c] * drift.h[q][c]).sum();
                let volume = displaced.frame.volume[q];
                drift.volume[q] * value * change + volume * (rate * change + value * growth)
            })
            .sum()
    })
}

/// Ψ′, from the state the law is in at `displaced` (asked for rates).
pub(super) fn wrench_rate(
    displaced: &Displaced<'_>,
    state: &GradientState,
    equilibrium: &Equilibrium,
    coefficients: &DVector<f64>,
    at: &Station,
) -> Vector6<f64> {
    let modes = displaced.modes;
    let drift = drift(displaced, state, coefficients, at);
    let Some(system) = &equilibrium.system else { return drift.strain };
    let full = &equilibrium.curvatures;
    let as_matrix = |v: &DVector<f64>| DMatrix::from_column_slice(v.len(), 1, v.as_slice());
    // rigid motions: M c′ = −A′ c and λ = −U_c / M
    let turning = conditions_rate(modes);
    let mass = modes.space.mass;
    let rigid_rate = &turning * coefficients * (-1.0 / mass);
    let multipliers = modes.rigid(&as_matrix(&equilibrium.slopes.coefficients)) * (-1.0 / mass);
    let mixed_rigid = modes.rigid(&full.mixed);
    let coupling = modes.reduce(&modes.rigid(&full.coefficients).transpose());
    let moved = &drift.coefficients + turning.tr_mul(&multipliers).column(0);
    let n = modes.len();
    let pressures = equilibrium.mixed.nrows() - n;
    let mut right = DMatrix::zeros(n + pressures, 1);
    right.rows_mut(0, n).copy_from(&(modes.reduce(&as_matrix(&moved)) + coupling * &rigid_rate));
    if pressures > 0 {
        let rigid = modes.rigid(&pressure::conditions(displaced, pressures).coefficients.transpose());
        let moved = conditions_drift(displaced, &drift, pressures) + rigid.tr_mul(&rigid_rate);
        right.rows_mut(n, pressures).copy_from(&-moved.column(0));
    }
    let rate = -system.solve(&right);
    let sum = mixed_rigid.tr_mul(&rigid_rate) + equilibrium.mixed.tr_mul(&rate);
    drift.strain + Vector6::from_iterator(sum.iter().copied())
}

/// A′: six conditions × coefficients.
fn conditions_rate(modes: &Modes) -> DMatrix<f64> {
    let (n, space) = (modes.points.len(), &modes.space);
    let mut out = DMatrix::zeros(6, modes.full());
    let (Some(rate), Some(rates)) = (&space.rate, &modes.points.rates) else { return out };
    // ∫φ_m φ_l dA changes by this
    let change = |m: usize, l: usize| -> f64 {
        let value = |q: usize, l: usize| space.table[(2 * n + q, l)];
        let moving = |q: usize, l: usize| rate[(2 * n + q, l)];
        (0..n)
            .map(|q| {
                let products = moving(q, m) * value(q, l) + value(q, m) * moving(q, l);
                rates.weight[q] * value(q, m) * value(q, l) + modes.points.weight[q] * products
            })
            .sum()
    };
    let all = modes.counts.iter().copied().max().unwrap_or(0);
    let table = DMatrix::from_fn(3, all, change);
    // the rows of a symmetric matrix that couples coefficient to coefficient of the same component, rigid ones picked
    let mut by_coefficient = DMatrix::zeros(modes.full(), modes.full());
    for component in 0..3 {
        let start = modes.start(component);
        for m in 0..3 {
            for l in 0..modes.counts[component] {
                by_coefficient[(start + m, start + l)] = table[(m, l)];
            }
        }
    }
    out.copy_from(&modes.rigid(&by_coefficient));
    out
}

fn drift(
    displaced: &Displaced<'_>,
    state: &GradientState,
    coefficients: &DVector<f64>,
    at: &Station,
) -> Drift {
    let (modes, frame) = (displaced.modes, displaced.frame);
    let n = modes.points.len();
    let zero = vec![0.0; n];
    let (dx, dy, dw) = match &modes.points.rates {
        Some(rates) => (&rates.x, &rates.y, &rates.weight),
        None => (&zero, &zero, &zero),
    };
    let e_rate: [DVector<f64>; 3] = std::array::from_fn(|i| match &modes.space.rate {
        Some(rate) => rate.columns(0, modes.counts[i]) * coefficients.rows(modes.start(i), modes.counts[i]),
        None => DVector::zeros(3 * n),
    });
    let (xi, xi_rate) = (at.reference.twist.to_array(), at.reference.rate.to_array());
    let turning = [xi_rate[0], xi_rate[1], xi_rate[2]];
    let moving = |v: &[f64; 6]| [v[0], v[1], v[2], 0.0, 0.0, 0.0];
    let mut strain = Vector6::zeros();
    let mut f: [DVector<f64>; 3] = std::array::from_fn(|_| DVector::zeros(3 * n));
    let mut f_rate = f.clone();
    let (mut h_rates, mut volume_rates) = (Vec::with_capacity(n), Vec::with_capacity(n));
    for q in 0..n {
        let (x, y, w) = (modes.points.x[q], modes.points.y[q], modes.points.weight[q]);
        let (g, v) = ([frame.shear[0][q], frame.shear[1][q]], frame.inverse[q]);
        let own = column(&xi_rate, x, y);
        let carried = column(&moving(&xi), dx[q], dy[q]);
        let [g0, g1, dj] = [0, 1, 2].map(|i| own[i] + carried[i]);
        let (volume, d_volume) = (frame.volume[q], dw[q] / v + w * dj);
        // H′
        let third = column(&moving(&frame.strain), dx[q], dy[q]);
        let at_point = |e: &[DVector<f64>; 3], block: usize| [0, 1, 2].map(|i| e[i][block * n + q]);
        let (displacement, d_displacement) = (at_point(&displaced.e, 2), at_point(&e_rate, 2));
        let turned = times(&turning, &displacement);
        let swept = times(&frame.omega, &d_displacement);
        let mut h_rate = [0.0; 9];
        for i in 0..3 {
            let (e_x, e_y) = (displaced.e[i][q], displaced.e[i][n + q]);
            let (d_x, d_y) = (e_rate[i][q], e_rate[i][n + q]);
            let numerator = third[i] + turned[i] + swept[i] - g0 * e_x - g1 * e_y - g[0] * d_x - g[1] * d_y;
            h_rate[3 * i] = d_x;
            h_rate[3 * i + 1] = d_y;
            h_rate[3 * i + 2] = (numerator - displaced.h[(3 * i + 2) * n + q] * dj) * v;
        }
        h_rates.push(h_rate);
        volume_rates.push(d_volume);
        // P′
        let p: [f64; 9] = std::array::from_fn(|c| state.stress[c * n + q]);
        let p_rate: [f64; 9] = std::array::from_fn(|c| {
            let carried = |k: usize| state.stiffness[super::assembly::packed_any(c, k) * n + q] * h_rate[k];
            state.stress_rate[c * n + q] + (0..9).map(carried).sum::<f64>()
        });
        let force = [2, 5, 8].map(|c| w * p[c]);
        let force_rate = [2, 5, 8].map(|c| dw[q] * p[c] + w * p_rate[c]);
        let (along, along_rate) = (times(&force, &frame.omega), times(&force_rate, &frame.omega));
        let extra = times(&force, &turning);
        for i in 0..3 {
            for (a, (shear, shear_rate)) in [(g[0], g0), (g[1], g1)].into_iter().enumerate() {
                f[i][a * n + q] = volume * p[3 * i + a] - shear * force[i];
                f_rate[i][a * n + q] = d_volume * p[3 * i + a] + volume * p_rate[3 * i + a]
                    - shear_rate * force[i]
                    - shear * force_rate[i];
            }
            f[i][2 * n + q] = along[i];
            f_rate[i][2 * n + q] = along_rate[i] + extra[i];
        }
        let position = displaced.position(q);
        let d_position = [dx[q] + d_displacement[0], dy[q] + d_displacement[1], d_displacement[2]];
        let (one, two) = (times(&d_position, &force), times(&position, &force_rate));
        for i in 0..3 {
            strain[i] += one[i] + two[i];
            strain[3 + i] += force_rate[i];
        }
    }
    let mut coefficients = displaced.gather(&f_rate);
    if let Some(rate) = &modes.space.rate {
        for i in 0..3 {
            let part = rate.columns(0, modes.counts[i]).tr_mul(&f[i]);
            let mut rows = coefficients.rows_mut(modes.start(i), modes.counts[i]);
            rows += part;
        }
    }
    Drift { strain, coefficients, h: h_rates, volume: volume_rates }
}
