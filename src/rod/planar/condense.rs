//! The linearised element in the plane, without distributed loads, with its stage strains eliminated.

use nalgebra::Matrix6;

use super::magnus::Variations;
use super::{Complex, PLACES, change_of, complex, turned};
use crate::rod::collocation::Collocation;
use crate::rod::condense::{Condensed, ONE};
use crate::rod::element::ElementState;

/// Columns: δm_y, δn_z, δn_x, 1.
const COLUMNS: usize = 4;
type Row = [f64; COLUMNS];
/// z and x of a column each.
type ComplexRow = [Complex; COLUMNS];

/// a real quadratic form on vectors of the plane: rows and columns (z, x).
type Flexibility = [[f64; 2]; 2];

#[inline(always)]
fn apply(f: &Flexibility, u: Complex) -> Complex {
    Complex::new(f[0][0] * u.re + f[0][1] * u.im, f[1][0] * u.re + f[1][1] * u.im)
}

/// K_νν⁻¹ among the strains (ν_z, ν_x) that are free. `None` where it is not clearly definite.
#[inline(always)]
fn flexibility(k: &Matrix6<f64>, fixed: &[bool; 6]) -> Option<Flexibility> {
    /// As for the determinant in space.
    const LEAST: f64 = 1e-10;
    let (zz, xx, zx, xz) = (k[(5, 5)], k[(3, 3)], k[(5, 3)], k[(3, 5)]);
    match (fixed[5], fixed[3]) {
        (true, true) => Some([[0.0; 2]; 2]),
        (true, false) => (xx > f64::MIN_POSITIVE).then(|| [[0.0, 0.0], [0.0, 1.0 / xx]]),
        (false, true) => (zz > f64::MIN_POSITIVE).then(|| [[1.0 / zz, 0.0], [0.0, 0.0]]),
        (false, false) => {
            // divided by zz and xx apart, so that 1e150 is still fine
            let coupling = (zx / zz) * (xz / xx);
            let determinant = 1.0 - coupling;
            let definite = zz > f64::MIN_POSITIVE && xx > f64::MIN_POSITIVE && determinant > LEAST;
            let (z, x) = (1.0 / (zz * determinant), 1.0 / (xx * determinant));
            definite.then(|| [[z, -z * (zx / xx)], [-x * (xz / zz), x]])
        }
    }
}

impl<const S: usize> Condensed<S> {
    /// K_k δq_k − L(Λ_k) Σ_l B_kl δq_l = −r_k + Ad_kᵀ δΛ_i with q = (ω_y, ν), where
    /// L(Λ)(w, v) = (Im(n̄ v), −i n w) and Ad_gᵀ(m, n) = (m − Im(p̄ n), e^{−iθ} n).
    pub(in crate::rod) fn fill_in_plane(
        &mut self,
        table: &Collocation<S>,
        state: &ElementState<'_, S>,
    ) -> Option<()> {
        let variations = Variations::new(table, &state.xi, state.h);
        let fixed = state.constraint.fixed();
        let mut soft = [[[0.0; 2]; 2]; S];
        let mut rhs = [[0.0; COLUMNS]; S];
        let mut linear_rhs = [[Complex::new(0.0, 0.0); COLUMNS]; S];
        for k in 0..S {
            soft[k] = flexibility(&state.response[k].tangent, &fixed)?;
            let (pose, residual) = (&state.kinematics.stage[k], state.residual(k));
            let p = complex(&pose.position);
            // e^{−iθ}
            let back = Complex::new(pose.rotation[(0, 0)], -pose.rotation[(0, 2)]);
            rhs[k] = [1.0, p.im, -p.re, -residual.moment.y];
            linear_rhs[k] = [Complex::new(0.0, 0.0), back, turned(back), -complex(&residual.force)];
        }
        let (mut matrix, mut linear_angular) = ([[0.0; S]; S], [[Complex::new(0.0, 0.0); S]; S]);
        for l in 0..S {
            let (n, k) = (complex(&state.stage_wrench[l].force), &state.response[l].tangent);
            for m in 0..S {
                linear_angular[l][m] = turned(n) * variations.stage[l][m].angular;
            }
            linear_angular[l][l] += Complex::new(k[(5, 1)], k[(3, 1)]);
        }
        for k in 0..S {
            let (n, tangent) = (complex(&state.stage_wrench[k].force).conj(), &state.response[k].tangent);
            for l in 0..S {
                let map = &variations.stage[k][l];
                matrix[k][l] -= (n * map.lower).im;
                // the row of ν_l: −Im(n̄ A ν), and K_ων on the diagonal
                let along = n * map.diagonal;
                let mut row = Complex::new(-along.im, -along.re);
                if k == l {
                    matrix[k][k] += tangent[(1, 1)];
                    row += Complex::new(tangent[(1, 5)], tangent[(1, 3)]);
                }
                let f = &soft[l];
                let factor = [row.re * f[0][0] + row.im * f[1][0], row.re * f[0][1] + row.im * f[1][1]];
                let reduce = |u: Complex| factor[0] * u.re + factor[1] * u.im;
                for m in 0..S {
                    matrix[k][m] -= reduce(linear_angular[l][m]);
                }
                for c in 0..COLUMNS {
                    rhs[k][c] -= reduce(linear_rhs[l][c]);
                }
            }
        }
        solve(&mut matrix, &mut rhs)?;
        for k in 0..S {
            for l in 0..S {
                for c in 0..COLUMNS {
                    linear_rhs[k][c] -= linear_angular[k][l] * rhs[l][c];
                }
            }
            linear_rhs[k] = linear_rhs[k].map(|u| apply(&soft[k], u));
        }
        self.take_from_plane(state, &variations, &rhs, &linear_rhs);
        Some(())
    }

    /// ζ_{i+1} = Ad_e⁻¹ ζ_i + y_e, δΛ_{i+1} = L(Λ_{i+1}) y_e + Ad_eᵀ δΛ_i, in space again.
    #[inline(always)]
    fn take_from_plane(
        &mut self,
        state: &ElementState<'_, S>,
        variations: &Variations<S>,
        angular: &[Row; S],
        linear: &[ComplexRow; S],
    ) {
        let (mut w, mut v) = ([0.0; COLUMNS], [Complex::new(0.0, 0.0); COLUMNS]);
        for (l, map) in variations.end.iter().enumerate() {
            for c in 0..COLUMNS {
                w[c] += map.angular * angular[l][c];
                v[c] += map.lower * angular[l][c] + map.diagonal * linear[l][c];
            }
        }
        self.start_in_plane(state);
        let t = &mut self.transfer;
        for c in 0..COLUMNS {
            let zeta = [0.0, w[c], 0.0, v[c].im, 0.0, v[c].re];
            let wrench = change_of(state.wrench_at_end, &zeta);
            if let Some(&place) = PLACES.get(c) {
                for r in 0..6 {
                    t.zeta_from_wrench[(r, place)] = zeta[r];
                    t.wrench_from_wrench[(r, place)] += wrench[r];
                }
            } else {
                t.zeta = zeta.into();
                t.wrench = wrench.into();
            }
        }
        self.set_strains::<COLUMNS>(false, |k, c| {
            let column = PLACES.get(c).copied().unwrap_or(ONE);
            (column, [0.0, angular[k][c], 0.0, linear[k][c].im, 0.0, linear[k][c].re])
        });
    }

    /// ζ_{i+1} = Ad_e⁻¹ ζ_i and δΛ_{i+1} = Ad_eᵀ δΛ_i, to add to.
    #[inline(always)]
    pub(super) fn start_in_plane(&mut self, state: &ElementState<'_, S>) {
        let t = &mut self.transfer;
        t.zeta_from_zeta = state.kinematics.end.adjoint_inverse().to_matrix();
        t.wrench_from_wrench = state.kinematics.end.adjoint().to_matrix().transpose();
        t.zeta_from_wrench.fill(0.0);
        t.wrench_from_zeta.fill(0.0);
    }
}

/// Gaussian elimination with row pivoting; the solution is in `rhs`.
#[inline(always)]
fn solve<const S: usize>(matrix: &mut [[f64; S]; S], rhs: &mut [Row; S]) -> Option<()> {
    for column in 0..S {
        let mut pivot = column;
        for row in column + 1..S {
            if matrix[row][column].abs() > matrix[pivot][column].abs() {
                pivot = row;
            }
        }
        let size = matrix[pivot][column].abs();
        if !(size > f64::MIN_POSITIVE && size.is_finite()) {
            return None;
        }
        matrix.swap(column, pivot);
        rhs.swap(column, pivot);
        for row in column + 1..S {
            let factor = matrix[row][column] / matrix[column][column];
            for c in column..S {
                matrix[row][c] -= factor * matrix[column][c];
            }
            for c in 0..COLUMNS {
                rhs[row][c] -= factor * rhs[column][c];
            }
        }
    }
    for row in (0..S).rev() {
        let inverse = 1.0 / matrix[row][row];
        for c in 0..COLUMNS {
            let known: f64 = (row + 1..S).map(|m| matrix[row][m] * rhs[m][c]).sum();
            rhs[row][c] = (rhs[row][c] - known) * inverse;
        }
    }
    Some(())
}
