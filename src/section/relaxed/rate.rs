//! Ψ′ of a relaxed section: how the wrench changes along s at fixed Δξ while the section stays in equilibrium.
//!
//! With c the coefficients of the displacement, A c = 0 the six conditions that hold no rigid motion in it, and λ their multipliers,
//! equilibrium U_c + Aᵀλ = 0 is differentiated in s: points, weights, reference and law move, the functions with the points.

use nalgebra::{DMatrix, DVector, Vector6};

use super::assembly::{Displaced, column, packed_any, times};
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

/// How the section changes along s at fixed strain and coefficients.
struct Motion<'a> {
    displaced: &'a Displaced<'a>,
    state: &'a GradientState,
    xi: [f64; 6],
    xi_rate: [f64; 6],
    /// Eᵢ′.
    e_rate: [DVector<f64>; 3],
}

/// At one point: rates of the reference, of H, of the volume, of r and of w.
struct PointMotion {
    shear: [f64; 2],
    shear_rate: [f64; 2],
    h: [f64; 9],
    weight: f64,
    volume: f64,
    position: [f64; 3],
}

/// The curvature part of six components.
fn turning(v: &[f64; 6]) -> [f64; 6] {
    [v[0], v[1], v[2], 0.0, 0.0, 0.0]
}

impl Motion<'_> {
    fn at(&self, q: usize) -> PointMotion {
        let (displaced, frame) = (self.displaced, self.displaced.frame);
        let points = &displaced.modes.points;
        let n = points.len();
        let [dx, dy, weight] =
            points.rates.as_ref().map_or([0.0; 3], |rates| [rates.x[q], rates.y[q], rates.weight[q]]);
        let (shear, inverse) = ([frame.shear[0][q], frame.shear[1][q]], frame.inverse[q]);
        let own = column(&self.xi_rate, points.x[q], points.y[q]);
        let carried = column(&turning(&self.xi), dx, dy);
        let [g_0, g_1, dj] = [0, 1, 2].map(|i| own[i] + carried[i]);
        let at_point = |e: &[DVector<f64>; 3], block: usize| [0, 1, 2].map(|i| e[i][block * n + q]);
        let d_displacement = at_point(&self.e_rate, 2);
        let [o_x, o_y, o_z, ..] = self.xi_rate;
        let turned = times(&[o_x, o_y, o_z], &at_point(&displaced.e, 2));
        let swept = times(&frame.omega, &d_displacement);
        let third = column(&turning(&frame.strain), dx, dy);
        let mut h = [0.0; 9];
        for i in 0..3 {
            let (e_x, e_y) = (displaced.e[i][q], displaced.e[i][n + q]);
            let (d_x, d_y) = (self.e_rate[i][q], self.e_rate[i][n + q]);
            let numerator =
                third[i] + turned[i] + swept[i] - g_0 * e_x - g_1 * e_y - shear[0] * d_x - shear[1] * d_y;
            h[3 * i] = d_x;
            h[3 * i + 1] = d_y;
            h[3 * i + 2] = (numerator - displaced.h[(3 * i + 2) * n + q] * dj) * inverse;
        }
        PointMotion {
            shear,
            shear_rate: [g_0, g_1],
            h,
            weight,
            volume: weight / inverse + points.weight[q] * dj,
            position: [dx + d_displacement[0], dy + d_displacement[1], d_displacement[2]],
        }
    }

    /// P and P′ = ∂P/∂s + ∂P/∂F H′ at point q.
    fn stress(&self, q: usize, h_rate: &[f64; 9]) -> ([f64; 9], [f64; 9]) {
        let n = self.displaced.modes.points.len();
        let stress = std::array::from_fn(|c| self.state.stress[c * n + q]);
        let rate = std::array::from_fn(|c| {
            let carried = |k: usize| self.state.stiffness[packed_any(c, k) * n + q] * h_rate[k];
            self.state.stress_rate[c * n + q] + (0..9).map(carried).sum::<f64>()
        });
        (stress, rate)
    }

    /// Adds point q to Tᵀ P dV and its rate, component by component, and to the rate of U_ξ.
    fn add(
        &self,
        q: usize,
        motion: &PointMotion,
        f: &mut [DVector<f64>; 3],
        f_rate: &mut [DVector<f64>; 3],
        strain: &mut Vector6<f64>,
    ) {
        let (displaced, frame) = (self.displaced, self.displaced.frame);
        let n = displaced.modes.points.len();
        let (w, volume) = (displaced.modes.points.weight[q], frame.volume[q]);
        let (p, p_rate) = self.stress(q, &motion.h);
        let force = [2, 5, 8].map(|c| w * p[c]);
        let force_rate = [2, 5, 8].map(|c| motion.weight * p[c] + w * p_rate[c]);
        let along = times(&force, &frame.omega);
        let along_rate = times(&force_rate, &frame.omega);
        let [o_x, o_y, o_z, ..] = self.xi_rate;
        let extra = times(&force, &[o_x, o_y, o_z]);
        for i in 0..3 {
            for a in 0..2 {
                let c = 3 * i + a;
                f[i][a * n + q] = volume * p[c] - motion.shear[a] * force[i];
                f_rate[i][a * n + q] = motion.volume * p[c] + volume * p_rate[c]
                    - motion.shear_rate[a] * force[i]
                    - motion.shear[a] * force_rate[i];
            }
            f[i][2 * n + q] = along[i];
            f_rate[i][2 * n + q] = along_rate[i] + extra[i];
        }
        let moved = times(&motion.position, &force);
        let grown = times(&displaced.position(q), &force_rate);
        for i in 0..3 {
            strain[i] += moved[i] + grown[i];
            strain[3 + i] += force_rate[i];
        }
    }
}

fn drift(
    displaced: &Displaced<'_>,
    state: &GradientState,
    coefficients: &DVector<f64>,
    at: &Station,
) -> Drift {
    let modes = displaced.modes;
    let n = modes.points.len();
    let e_rate: [DVector<f64>; 3] = std::array::from_fn(|i| match &modes.space.rate {
        Some(rate) => rate.columns(0, modes.counts[i]) * coefficients.rows(modes.start(i), modes.counts[i]),
        None => DVector::zeros(3 * n),
    });
    let (xi, xi_rate) = (at.reference.twist.to_array(), at.reference.rate.to_array());
    let section = Motion { displaced, state, xi, xi_rate, e_rate };
    let mut strain = Vector6::zeros();
    let mut f: [DVector<f64>; 3] = std::array::from_fn(|_| DVector::zeros(3 * n));
    let mut f_rate = f.clone();
    let (mut h, mut volume) = (Vec::with_capacity(n), Vec::with_capacity(n));
    for q in 0..n {
        let motion = section.at(q);
        section.add(q, &motion, &mut f, &mut f_rate, &mut strain);
        h.push(motion.h);
        volume.push(motion.volume);
    }
    let mut coefficients = displaced.gather(&f_rate);
    if let Some(rate) = &modes.space.rate {
        for i in 0..3 {
            let part = rate.columns(0, modes.counts[i]).tr_mul(&f[i]);
            let mut rows = coefficients.rows_mut(modes.start(i), modes.counts[i]);
            rows += part;
        }
    }
    Drift { strain, coefficients, h, volume }
}
