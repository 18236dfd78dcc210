//! What distributed loads add to the linearised elements of a block, where they do not depend on where they act: δf̄ = D w.

use super::algebra::{
    Forms, Matrix, Pair, add, add_hat, add_multiple, add_product, cross_columns, product, product_transpose,
    subtract_product, transpose_product, zeros,
};
use super::eliminate::System;
use super::linearised::Linearised;
use super::magnus::Placed;
use super::rows::{
    BlockRows, LOADLESS, MapRows, MatrixRows, NO_MATRIX, load_columns, load_map, load_matrix, load_pair,
    store_columns, store_matrix,
};
use super::{STAGES, Table};
use crate::scalar::Lane;

/// δF_l = Σ_m g_lm δξ_m + e_l w_i: the loads of the stages brought to node i.
#[derive(Clone)]
pub(super) struct Terms {
    /// Moment by δω_m, moment by δν_m, force by δω_m; a force is not changed by a displacement.
    pub(super) g: [[[MatrixRows; 3]; STAGES]; STAGES],
    /// Moment and force, of loads that turn.
    e: [[MatrixRows; 2]; STAGES],
    /// g and e at the end: Ad_eᵀ h Σ b_l of them.
    pub(super) end: [[MatrixRows; 3]; STAGES],
    pub(super) turn: [MatrixRows; 2],
}

impl Terms {
    pub(super) fn new() -> Self {
        Self {
            g: [[[NO_MATRIX; 3]; STAGES]; STAGES],
            e: [[NO_MATRIX; 2]; STAGES],
            end: [[NO_MATRIX; 3]; STAGES],
            turn: [NO_MATRIX; 2],
        }
    }

    /// g_lm = Ad_l⁻ᵀ(D_l − L(f̄_l)) B_lm by the [forms](Moved) of that, for stage l with its row of B.
    #[inline(always)]
    pub(super) fn set<L: Lane>(
        &mut self,
        stages: usize,
        l: usize,
        moved: &Moved<L>,
        variation: &[MapRows; STAGES],
        turning: bool,
        at: usize,
    ) {
        let Forms { angular: by_moment, linear: by_shift } = &moved.moment;
        for m in 0..stages {
            let map = load_map::<L>(&variation[m], at);
            let g = &mut self.g[l][m];
            let mut angular = product(by_shift, &map.lower);
            if turning {
                angular = add_product(angular, by_moment, &map.diagonal);
                store_matrix(&product(&moved.force, &map.diagonal), &mut g[2], at);
            }
            store_matrix(&angular, &mut g[0], at);
            store_matrix(&product(by_shift, &map.diagonal), &mut g[1], at);
        }
    }

    /// g_lm by rotations alone: moment or force.
    #[inline(always)]
    pub(super) fn set_by_rotation<L: Lane>(
        &mut self,
        (l, m): (usize, usize),
        force: bool,
        g: &Matrix<L>,
        at: usize,
    ) {
        store_matrix(g, &mut self.g[l][m][if force { 2 } else { 0 }], at);
    }

    /// e_l = Ad_l⁻ᵀ D_l Ad_l⁻¹, of loads that turn.
    #[inline(always)]
    pub(super) fn set_turn<L: Lane>(&mut self, l: usize, pose: &Placed<L>, state: &Linearised, at: usize) {
        let (r, p) = (&pose.rotation, &pose.position);
        let [moment, force] = slope::<L>(state, l, at);
        let force = product(r, &product_transpose(&force, r));
        let moment = add_product(cross_columns(p, &force), r, &product_transpose(&moment, r));
        store_matrix(&moment, &mut self.e[l][0], at);
        store_matrix(&force, &mut self.e[l][1], at);
    }

    /// Adds Ad_kᵀ h Σ a_kl δF_l to the equations of the stages, and notes the same of the end; of loads that turn.
    #[inline(always)]
    pub(super) fn add<L: Lane>(
        &mut self,
        table: &Table,
        poses: &[[super::Row; 12]; STAGES + 1],
        (h, soft): (L, bool),
        system: &mut System,
        strain: &mut [[BlockRows; 2]; STAGES],
        at: usize,
    ) {
        let stages = table.stages;
        for k in 0..=stages {
            let pose = Placed::<L>::load(&poses[k], at);
            let weights = if k < stages { &table.a[k] } else { &table.b };
            for m in 0..stages {
                let mut sum = [zeros::<L>(); 3];
                for l in 0..stages {
                    let weight = h * L::splat(weights[l]);
                    for b in 0..3 {
                        if b != 1 || soft {
                            sum[b] = add_multiple(sum[b], weight, &load_matrix(&self.g[l][m][b], at));
                        }
                    }
                }
                let [angular, force] = brought(&pose, &sum[0], &sum[2]);
                if k < stages {
                    add_to(&mut system.angular[k][m], &angular, at);
                } else {
                    store_matrix(&angular, &mut self.end[m][0], at);
                    store_matrix(&force, &mut self.end[m][2], at);
                }
                if !soft {
                    continue;
                }
                let linear = transpose_product(&pose.rotation, &sum[1]);
                if k < stages {
                    add_to(&mut system.from_linear[k][m], &linear, at);
                    add_to(&mut system.to_linear[k][m], &force, at);
                } else {
                    store_matrix(&linear, &mut self.end[m][1], at);
                }
            }
            let mut sum = [zeros::<L>(); 2];
            for l in 0..stages {
                let weight = h * L::splat(weights[l]);
                for b in 0..2 {
                    sum[b] = add_multiple(sum[b], weight, &load_matrix(&self.e[l][b], at));
                }
            }
            let turn = brought(&pose, &sum[0], &sum[1]);
            if k < stages {
                for b in 0..2 {
                    let minus = add_multiple(zeros(), L::splat(-1.0), &turn[b]);
                    store_columns(&minus, &mut strain[k][b], LOADLESS, at);
                }
            } else {
                store_matrix(&turn[0], &mut self.turn[0], at);
                store_matrix(&turn[1], &mut self.turn[1], at);
            }
        }
    }

    /// Takes Ad_eᵀ h Σ b_l δF_l from the wrench at the end.
    #[inline(always)]
    pub(super) fn take_from_end<L: Lane, const C: usize>(
        &self,
        stages: usize,
        (soft, turning): (bool, bool),
        strain: &[[BlockRows; 2]; STAGES],
        from: usize,
        [moment, force]: &mut [[[L; C]; 3]; 2],
        at: usize,
    ) {
        for l in 0..stages {
            let angular: [[L; C]; 3] = load_columns(&strain[l][0], from, at);
            let end = &self.end[l];
            *moment = subtract_product(*moment, &load_matrix(&end[0], at), &angular);
            if soft {
                let linear: [[L; C]; 3] = load_columns(&strain[l][1], from, at);
                *moment = subtract_product(*moment, &load_matrix(&end[1], at), &linear);
            }
            if turning {
                *force = subtract_product(*force, &load_matrix(&end[2], at), &angular);
            }
        }
    }

    /// As [`take_from_end`](Self::take_from_end), by the rotation of the first node itself.
    #[inline(always)]
    pub(super) fn take_turn<L: Lane, const C: usize>(&self, wrench: &mut [[[L; C]; 3]; 2], at: usize) {
        for b in 0..2 {
            let turn: Matrix<L> = load_matrix(&self.turn[b], at);
            for r in 0..3 {
                for c in 0..3 {
                    wrench[b][r][c] = wrench[b][r][c] - turn[r][c];
                }
            }
        }
    }
}

/// Ad_l⁻ᵀ(D_l − L(f̄_l)): what a displacement of stage l makes of its load, brought to node i.
pub(super) struct Moved<L> {
    pub(super) moment: Forms<L>,
    /// By the rotation: a force is not changed by a displacement.
    pub(super) force: Matrix<L>,
}

impl<L: Lane> Moved<L> {
    /// A load that is not `turning` keeps its force in space and has no moment: only its lever changes.
    #[inline(always)]
    pub(super) fn new(l: usize, pose: &Placed<L>, state: &Linearised, at: usize) -> Self {
        let minus = L::splat(-1.0);
        let load: Pair<L> = load_pair(&state.loads.wrench[l], at);
        let (r, p) = (&pose.rotation, &pose.position);
        if !state.turning {
            // R (Rᵀ f)^ = f^ R
            let linear = add_multiple(zeros(), minus, &cross_columns(&load.second, r));
            return Self { moment: Forms { angular: zeros(), linear }, force: zeros() };
        }
        let linear = product(r, &add_hat(&zeros(), minus, &load.second));
        let [moment, force] = slope(state, l, at);
        let by_turn = product(r, &add_hat(&force, minus, &load.second));
        let lever = cross_columns(p, &by_turn);
        let angular = add_product(lever, r, &add_hat(&moment, minus, &load.first));
        Self { moment: Forms { angular, linear }, force: by_turn }
    }
}

/// D_l: moment and force by the rotation of the section.
#[inline(always)]
fn slope<L: Lane>(state: &Linearised, l: usize, at: usize) -> [Matrix<L>; 2] {
    [load_matrix(&state.loads.slope[l][0], at), load_matrix(&state.loads.slope[l][1], at)]
}

/// Ad_gᵀ of columns of wrenches: Rᵀ(M − p × N), Rᵀ N.
#[inline(always)]
fn brought<L: Lane>(pose: &Placed<L>, moment: &Matrix<L>, force: &Matrix<L>) -> [Matrix<L>; 2] {
    let lever = cross_columns(&pose.position, force);
    let moment = add_multiple(*moment, L::splat(-1.0), &lever);
    [transpose_product(&pose.rotation, &moment), transpose_product(&pose.rotation, force)]
}

#[inline(always)]
pub(super) fn add_to<L: Lane>(rows: &mut MatrixRows, m: &Matrix<L>, at: usize) {
    let mut sum = load_matrix(rows, at);
    for r in 0..3 {
        sum[r] = add(&sum[r], &m[r]);
    }
    store_matrix(&sum, rows, at);
}
