//! Energy of a displaced section and its derivatives in the strain Δξ and the coefficients c of the displacement.
//!
//! Each component i of the displacement enters through Eᵢ = (∂ₓwᵢ, ∂ᵧwᵢ, wᵢ), in which H is linear,
//!
//! Hᵢ₁ = Eᵢ₁, Hᵢ₂ = Eᵢ₂, Hᵢ₃ = (Δν + Δω × r + ω × w − γ*₁ ∂ₓw − γ*₂ ∂ᵧw)ᵢ / j,
//!
//! with γ* = ν* + ω* × r and j = γ*₃: F = [e₁+∂ₓw, e₂+∂ᵧw, ν + ω × (r+w)] [e₁ e₂ γ*]⁻¹. The stiffness at a point is therefore carried
//! from H to E, a 9 × 9 matrix, and from there to the coefficients by products of large matrices.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, SMatrix, Vector6};

use super::modes::Modes;
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::material::{GradientBatch, GradientLaw, GradientState, Request, Station, packed};

/// The reference at the points: γ*₁, γ*₂ and 1/j, and the volume w j per ds of each.
pub(super) struct Frame {
    pub(super) shear: [Vec<f64>; 2],
    pub(super) inverse: Vec<f64>,
    pub(super) volume: Vec<f64>,
    /// ω = ω* + Δω.
    pub(super) omega: [f64; 3],
    pub(super) strain: [f64; 6],
}

impl Frame {
    /// # Errors
    /// Where the section reaches the centre of curvature of the reference.
    pub(super) fn new(modes: &Modes, at: &Station, strain: &Strain) -> Result<Self> {
        let points = &modes.points;
        let xi = at.reference.twist.to_array();
        let strain = strain.to_array();
        let n = points.len();
        let mut frame = Self {
            shear: [vec![0.0; n], vec![0.0; n]],
            inverse: vec![1.0; n],
            volume: points.weight.clone(),
            omega: std::array::from_fn(|i| xi[i] + strain[i]),
            strain,
        };
        for q in 0..n {
            let (x, y) = (points.x[q], points.y[q]);
            let [a, b, j] = column(&xi, x, y);
            if !(j > 0.0) {
                let requirement = "positive: the section reaches the centre of curvature of the reference";
                let quantity = "volume of the reference";
                return Err(Error::Inadmissible { quantity, value: j, requirement, s: at.s, x, y });
            }
            frame.shear[0][q] = a;
            frame.shear[1][q] = b;
            frame.inverse[q] = 1.0 / j;
            frame.volume[q] *= j;
        }
        Ok(frame)
    }
}

/// ν + ω × (x, y, 0).
pub(super) fn column(xi: &[f64; 6], x: f64, y: f64) -> [f64; 3] {
    [xi[3] - xi[2] * y, xi[4] + xi[2] * x, xi[5] + xi[0] * y - xi[1] * x]
}

/// a × b.
pub(super) fn times(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A displaced section at a strain: E and H at the points.
pub(super) struct Displaced<'a> {
    pub(super) modes: &'a Modes,
    pub(super) frame: &'a Frame,
    /// Eᵢ at the points, 3Q each.
    pub(super) e: [DVector<f64>; 3],
    /// H, entry by entry.
    pub(super) h: Vec<f64>,
}

/// First derivatives of the energy U, full in the coefficients.
pub(super) struct Slopes {
    pub(super) energy: f64,
    pub(super) strain: Vector6<f64>,
    pub(super) coefficients: DVector<f64>,
}

/// Second derivatives of U.
pub(super) struct Curvatures {
    pub(super) strain: Matrix6<f64>,
    /// Coefficients × strain.
    pub(super) mixed: DMatrix<f64>,
    pub(super) coefficients: DMatrix<f64>,
}

impl<'a> Displaced<'a> {
    pub(super) fn new(modes: &'a Modes, frame: &'a Frame, coefficients: &DVector<f64>) -> Self {
        let n = modes.points.len();
        let e: [DVector<f64>; 3] = std::array::from_fn(|i| {
            let c = coefficients.rows(modes.start(i), modes.counts[i]);
            modes.space.table.columns(0, modes.counts[i]) * c
        });
        let mut h = vec![0.0; 9 * n];
        for q in 0..n {
            let third = column(&frame.strain, modes.points.x[q], modes.points.y[q]);
            let turned = times(&frame.omega, &[e[0][2 * n + q], e[1][2 * n + q], e[2][2 * n + q]]);
            let (g, inverse) = ([frame.shear[0][q], frame.shear[1][q]], frame.inverse[q]);
            for i in 0..3 {
                let (e_x, e_y) = (e[i][q], e[i][n + q]);
                h[3 * i * n + q] = e_x;
                h[(3 * i + 1) * n + q] = e_y;
                h[(3 * i + 2) * n + q] = (third[i] + turned[i] - g[0] * e_x - g[1] * e_y) * inverse;
            }
        }
        Self { modes, frame, e, h }
    }

    /// Evaluates the law at the points; the smallest J comes back.
    pub(super) fn evaluate(
        &self,
        law: &dyn GradientLaw,
        s: f64,
        request: Request,
        out: &mut GradientState,
    ) -> f64 {
        law.evaluate(GradientBatch { points: &self.modes.points, s, h: &self.h }, request, out)
    }

    /// ∫u dV.
    pub(super) fn energy(&self, state: &GradientState) -> f64 {
        self.frame.volume.iter().zip(&state.energy).map(|(w, u)| w * u).sum()
    }

    /// r + w at point q.
    pub(super) fn position(&self, q: usize) -> [f64; 3] {
        let n = self.modes.points.len();
        let [x, y, z] = [0, 1, 2].map(|i| self.e[i][2 * n + q]);
        [self.modes.points.x[q] + x, self.modes.points.y[q] + y, z]
    }

    /// Carries stresses at the points from H to E, each times a weight: 3Q numbers for each component.
    pub(super) fn pulled(&self, stress: &[f64], weight: &[f64]) -> [DVector<f64>; 3] {
        let n = self.modes.points.len();
        let mut out: [DVector<f64>; 3] = std::array::from_fn(|_| DVector::zeros(3 * n));
        for q in 0..n {
            let (g, v, w) =
                ([self.frame.shear[0][q], self.frame.shear[1][q]], self.frame.inverse[q], weight[q]);
            let p = |i: usize, a: usize| stress[(3 * i + a) * n + q] * w;
            let third = [p(0, 2) * v, p(1, 2) * v, p(2, 2) * v];
            let turned = times(&third, &self.frame.omega); // (ω^)ᵀ p = p × ω
            for i in 0..3 {
                out[i][q] = p(i, 0) - g[0] * third[i];
                out[i][n + q] = p(i, 1) - g[1] * third[i];
                out[i][2 * n + q] = turned[i];
            }
        }
        out
    }

    /// Gᵀ f for all components, 3Q numbers each.
    pub(super) fn gather(&self, f: &[DVector<f64>; 3]) -> DVector<f64> {
        let modes = self.modes;
        let mut out = DVector::zeros(modes.full());
        for i in 0..3 {
            let part = modes.space.transposed.rows(0, modes.counts[i]) * &f[i];
            out.rows_mut(modes.start(i), modes.counts[i]).copy_from(&part);
        }
        out
    }

    /// U and its first derivatives.
    pub(super) fn slopes(&self, state: &GradientState) -> Slopes {
        let n = self.modes.points.len();
        let mut strain = Vector6::zeros();
        for q in 0..n {
            let w = self.modes.points.weight[q];
            let p = [2, 5, 8].map(|c| state.stress[c * n + q] * w);
            let moment = times(&self.position(q), &p);
            for i in 0..3 {
                strain[i] += moment[i];
                strain[3 + i] += p[i];
            }
        }
        let pulled = self.pulled(&state.stress, &self.frame.volume);
        Slopes { energy: self.energy(state), strain, coefficients: self.gather(&pulled) }
    }

    /// The second derivatives of U.
    pub(super) fn curvatures(&self, state: &GradientState) -> Curvatures {
        let n = self.modes.points.len();
        let mut strain = Matrix6::zeros();
        // stiffness in E, entry by entry, and the mixed one, weighted
        let mut stiffness = vec![0.0; 45 * n];
        let mut mixed: [DMatrix<f64>; 3] = std::array::from_fn(|_| DMatrix::zeros(3 * n, 6));
        for q in 0..n {
            let (in_e, third) = self.point_stiffness(state, q);
            let (b, w) = (self.strain_columns(q), self.frame.volume[q]);
            for (i, row) in in_e.iter().enumerate() {
                for k in i..9 {
                    stiffness[packed(i, k) * n + q] = row[k] * w;
                }
            }
            let c_33 = Matrix3::from_fn(|i, k| state.stiffness[packed_any(3 * i + 2, 3 * k + 2) * n + q]);
            strain += b.transpose() * c_33 * b * w;
            self.add_mixed(q, &third, &b, state, &mut mixed);
        }
        let (coefficients, mixed) = self.assemble(&stiffness, &mixed);
        Curvatures { strain, mixed, coefficients }
    }

    /// Adds ∂²U/∂E∂ξ at point q: Tᵀ C B, and the work of P₃ on δω × δw.
    fn add_mixed(
        &self,
        q: usize,
        third: &[[f64; 3]; 9],
        b: &SMatrix<f64, 3, 6>,
        state: &GradientState,
        mixed: &mut [DMatrix<f64>; 3],
    ) {
        let n = self.modes.points.len();
        let w = self.frame.volume[q];
        for c in 0..9 {
            for k in 0..6 {
                let sum: f64 = (0..3).map(|m| third[c][m] * b[(m, k)]).sum();
                mixed[c / 3][((c % 3) * n + q, k)] = sum * w;
            }
        }
        let p = [2, 5, 8].map(|c| state.stress[c * n + q] * w * self.frame.inverse[q]);
        for i in 0..3 {
            for k in 0..3 {
                if k != i {
                    // p · (e_k × e_i)
                    let sign = if (k + 1) % 3 == i { 1.0 } else { -1.0 };
                    mixed[i][(2 * n + q, k)] += sign * p[3 - k - i];
                }
            }
        }
    }

    /// At point q: ∂H₃/∂Δξ.
    fn strain_columns(&self, q: usize) -> SMatrix<f64, 3, 6> {
        let ([x, y, z], v) = (self.position(q), self.frame.inverse[q]);
        let (x, y, z) = (x * v, y * v, z * v);
        SMatrix::<f64, 3, 6>::from_row_slice(&[
            0.0, z, -y, v, 0.0, 0.0, //
            -z, 0.0, x, 0.0, v, 0.0, //
            y, -x, 0.0, 0.0, 0.0, v,
        ])
    }

    /// At point q: Tᵀ C T with H = T E, of which the upper triangle counts, and Tᵀ C in the columns of H₃.
    fn point_stiffness(&self, state: &GradientState, q: usize) -> ([[f64; 9]; 9], [[f64; 3]; 9]) {
        let n = self.modes.points.len();
        let mut c = [[0.0; 9]; 9];
        for i in 0..9 {
            for k in i..9 {
                let value = state.stiffness[packed(i, k) * n + q];
                c[i][k] = value;
                c[k][i] = value;
            }
        }
        self.carry_rows(&mut c, q);
        let third = std::array::from_fn(|i| [c[i][2], c[i][5], c[i][8]]);
        // the other side: transpose, once more
        let mut turned = [[0.0; 9]; 9];
        for i in 0..9 {
            for k in 0..9 {
                turned[k][i] = c[i][k];
            }
        }
        self.carry_rows(&mut turned, q);
        (turned, third)
    }

    /// Tᵀ from the left.
    fn carry_rows(&self, c: &mut [[f64; 9]; 9], q: usize) {
        let (g, v, omega) =
            ([self.frame.shear[0][q], self.frame.shear[1][q]], self.frame.inverse[q], &self.frame.omega);
        for k in 0..9 {
            let third = [c[2][k] * v, c[5][k] * v, c[8][k] * v];
            let turned = times(&third, omega);
            for i in 0..3 {
                c[3 * i][k] -= g[0] * third[i];
                c[3 * i + 1][k] -= g[1] * third[i];
                c[3 * i + 2][k] = turned[i];
            }
        }
    }

    /// Gᵀ D G and Gᵀ M over all components.
    fn assemble(&self, d: &[f64], mixed: &[DMatrix<f64>; 3]) -> (DMatrix<f64>, DMatrix<f64>) {
        let modes = self.modes;
        let (n, full) = (modes.points.len(), modes.full());
        let table = &modes.space.table;
        let mut hessian = DMatrix::zeros(full, full);
        let mut mixed_out = DMatrix::zeros(full, 6);
        for i in 0..3 {
            let (start, count) = (modes.start(i), modes.counts[i]);
            let width = full - start;
            let mut y = DMatrix::<f64>::zeros(3 * n, width + 6);
            for k in i..3 {
                for l in 0..modes.counts[k] {
                    let column = table.column(l);
                    let g = column.as_slice();
                    let mut out = y.column_mut(modes.start(k) - start + l);
                    let out = out.as_mut_slice();
                    for a in 0..3 {
                        let rows = &mut out[a * n..(a + 1) * n];
                        let entry = |b: usize| packed_any(3 * i + a, 3 * k + b) * n;
                        let [d0, d1, d2] = [0, 1, 2].map(|b| &d[entry(b)..entry(b) + n]);
                        let [g0, g1, g2] = [0, 1, 2].map(|b| &g[b * n..(b + 1) * n]);
                        for q in 0..n {
                            rows[q] = d0[q] * g0[q] + d1[q] * g1[q] + d2[q] * g2[q];
                        }
                    }
                }
            }
            y.columns_mut(width, 6).copy_from(&mixed[i]);
            let product = modes.space.transposed.rows(0, count) * y;
            hessian.view_mut((start, start), (count, width)).copy_from(&product.columns(0, width));
            mixed_out.rows_mut(start, count).copy_from(&product.columns(width, 6));
        }
        for i in 0..full {
            for k in 0..i {
                hessian[(i, k)] = hessian[(k, i)];
            }
        }
        (hessian, mixed_out)
    }
}

/// As [`packed`], for any order of the two.
pub(super) fn packed_any(i: usize, k: usize) -> usize {
    if i <= k { packed(i, k) } else { packed(k, i) }
}
