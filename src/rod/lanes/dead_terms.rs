//! What dead loads add, which have no moment and keep their forces f_l in space: in the frame of the first node only their levers change,
//! δF_l = (δp_l × f_l, 0) by the strains and (p_l × (f_l × w_i), f_l × w_i) by the rotation of the node.

use super::algebra::{Matrix, Vector, add_multiple, cross, dot, scale, transpose_product, zeros};
use super::eliminate::System;
use super::linearised::Linearised;
use super::loads::{Terms, add_to};
use super::magnus::Placed;
use super::rows::{BlockRows, LOADLESS, Row, load_matrix, store_columns, store_matrix};
use super::{STAGES, Table};
use crate::scalar::Lane;

impl Terms {
    /// As [`add`](Self::add).
    #[inline(always)]
    pub(super) fn add_dead<L: Lane>(
        &mut self,
        table: &Table,
        poses: &[[Row; 12]; STAGES + 1],
        (h, soft, state): (L, bool, &Linearised),
        system: &mut System,
        strain: &mut [[BlockRows; 2]; STAGES],
        at: usize,
    ) {
        let stages = table.stages;
        for k in 0..=stages {
            let pose = Placed::<L>::load(&poses[k], at);
            let weights = if k < stages { &table.a[k] } else { &table.b };
            for m in 0..stages {
                let angular = self.brought(stages, (m, 0), (h, weights), &pose, at);
                if k < stages {
                    add_to(&mut system.angular[k][m], &angular, at);
                } else {
                    store_matrix(&angular, &mut self.end[m][0], at);
                }
                if soft {
                    let linear = self.brought(stages, (m, 1), (h, weights), &pose, at);
                    if k < stages {
                        add_to(&mut system.from_linear[k][m], &linear, at);
                    } else {
                        store_matrix(&linear, &mut self.end[m][1], at);
                    }
                }
            }
            let mut turn = zeros::<L>();
            let mut sum = [L::splat(0.0); 3];
            for l in 0..stages {
                let [.., x, y, z] = &poses[l];
                let p = [L::load(&x[at..]), L::load(&y[at..]), L::load(&z[at..])];
                let [.., x, y, z] = &state.loads.wrench[l];
                let force = [L::load(&x[at..]), L::load(&y[at..]), L::load(&z[at..])];
                let force = scale(h * L::splat(weights[l]), &force);
                add_lever(&mut turn, &force, &p);
                for r in 0..3 {
                    sum[r] = sum[r] + force[r];
                }
            }
            add_lever(&mut turn, &scale(L::splat(-1.0), &sum), &pose.position);
            let moment = transpose_product(&pose.rotation, &turn);
            if k == stages {
                store_matrix(&moment, &mut self.turn[0], at);
                store_matrix(&turned(&pose, &sum), &mut self.turn[1], at);
                continue;
            }
            let minus = L::splat(-1.0);
            store_columns(&add_multiple(zeros(), minus, &moment), &mut strain[k][0], LOADLESS, at);
            if soft {
                let force = add_multiple(zeros(), minus, &turned(&pose, &sum));
                store_columns(&force, &mut strain[k][1], LOADLESS, at);
            }
        }
    }

    /// Rᵀ h Σ_l weight_l g_lm, of the moments by δω_m or by δν_m.
    #[inline(always)]
    fn brought<L: Lane>(
        &self,
        stages: usize,
        (m, by): (usize, usize),
        (h, weights): (L, &[f64; STAGES]),
        pose: &Placed<L>,
        at: usize,
    ) -> Matrix<L> {
        let mut sum = zeros();
        for l in 0..stages {
            sum = add_multiple(sum, h * L::splat(weights[l]), &load_matrix(&self.g[l][m][by], at));
        }
        transpose_product(&pose.rotation, &sum)
    }
}

/// Adds p^ f^ = f pᵀ − (p·f) 1, the moment of f × w at p by w.
#[inline(always)]
fn add_lever<L: Lane>(to: &mut Matrix<L>, f: &Vector<L>, p: &Vector<L>) {
    let along = dot(f, p);
    for r in 0..3 {
        for c in 0..3 {
            to[r][c] = f[r].mul_add(p[c], to[r][c]);
        }
        to[r][r] = to[r][r] - along;
    }
}

/// Rᵀ f^, row by row: r · (f × w) = (r × f) · w.
#[inline(always)]
fn turned<L: Lane>(pose: &Placed<L>, f: &Vector<L>) -> Matrix<L> {
    let r = &pose.rotation;
    let mut rows = zeros();
    for i in 0..3 {
        rows[i] = cross(&[r[0][i], r[1][i], r[2][i]], f);
    }
    rows
}
