//! The Magnus vector, its exponential and its derivative, as in [`rod::magnus`](crate::rod::magnus) and [`lie::se3`](crate::lie::se3), on lanes.

use super::algebra::{
    Forms, Map, Matrix, Pair, Vector, add, add_multiple, add_scaled, cross, dot, from_parts, scale,
    transpose_times, zeros,
};
use super::rows::{Row, load_pair};
use super::{STAGES, Taylor, Twists};
use crate::lie::{C5, C6, SERIES_LIMIT};
use crate::scalar::Lane;

/// Poses relative to the first node.
#[derive(Clone, Copy)]
pub(super) struct Placed<L> {
    pub(super) rotation: Matrix<L>,
    pub(super) position: Vector<L>,
}

impl<L: Lane> Placed<L> {
    /// From rotation by rows, then position.
    #[inline(always)]
    pub(super) fn load(rows: &[Row; 12], at: usize) -> Self {
        let mut pose = Self { rotation: zeros(), position: [L::splat(0.0); 3] };
        for r in 0..3 {
            for j in 0..3 {
                pose.rotation[r][j] = L::load(&rows[3 * r + j][at..]);
            }
            pose.position[r] = L::load(&rows[9 + r][at..]);
        }
        pose
    }

    #[inline(always)]
    pub(super) fn store(&self, rows: &mut [Row; 12], at: usize) {
        for r in 0..3 {
            for j in 0..3 {
                self.rotation[r][j].store(&mut rows[3 * r + j][at..]);
            }
            self.position[r].store(&mut rows[9 + r][at..]);
        }
    }

    /// Ad_gᵀ Λ = (Rᵀ(m − p × n), Rᵀ n).
    #[inline(always)]
    pub(super) fn carry(&self, wrench: &Pair<L>) -> Pair<L> {
        let lever = cross(&self.position, &wrench.second);
        let moment = add_scaled(&wrench.first, L::splat(-1.0), &lever);
        Pair {
            first: transpose_times(&self.rotation, &moment),
            second: transpose_times(&self.rotation, &wrench.second),
        }
    }
}

/// α_{j+1} = h Σ_l t_jl ξ_l; what is beyond the number of stages is zero.
#[inline(always)]
pub(super) fn taylor_data<L: Lane>(
    t: &Taylor,
    twists: &Twists,
    stages: usize,
    at: usize,
) -> [Pair<L>; STAGES] {
    let h = L::load(&twists.h[at..]);
    let zero = [L::splat(0.0); 3];
    let mut alpha = [Pair { first: zero, second: zero }; STAGES];
    for l in 0..stages {
        let xi = load_pair::<L>(&twists.xi[l], at);
        for j in 0..STAGES {
            let weight = h * L::splat(t[j][l]);
            alpha[j].first = add_scaled(&alpha[j].first, weight, &xi.first);
            alpha[j].second = add_scaled(&alpha[j].second, weight, &xi.second);
        }
    }
    alpha
}

/// C₁ + 2α₃, P and Q of order 6.
#[inline(always)]
fn factors<L: Lane>(alpha: &[Pair<L>; STAGES]) -> [Pair<L>; 3] {
    let c1 = alpha[1].bracket(&alpha[0]);
    let inner = c1.add_scaled(2.0, &alpha[2]);
    let p = alpha[1].add_scaled(-1.0 / 60.0, &inner.bracket(&alpha[0]));
    let q = c1.add_scaled(-1.0, &alpha[2]).add_scaled(-20.0, &alpha[0]);
    [inner, p, q]
}

/// Ω.
#[inline(always)]
pub(super) fn exponent<L: Lane>(alpha: &[Pair<L>; STAGES], stages: usize) -> Pair<L> {
    match stages {
        1 => alpha[0],
        2 => alpha[0].add_scaled(1.0 / 12.0, &alpha[0].bracket(&alpha[1])),
        _ => {
            let [_, p, q] = factors(alpha);
            alpha[0].add_scaled(1.0 / 12.0, &alpha[2]).add_scaled(1.0 / 240.0, &p.bracket(&q))
        }
    }
}

/// ∂Ω/∂α_j, as many as there are stages.
#[inline(always)]
pub(super) fn exponent_derivative<L: Lane>(alpha: &[Pair<L>; STAGES], stages: usize) -> [Map<L>; STAGES] {
    const SCALE: f64 = 1.0 / 240.0;
    let zero = Map { diagonal: zeros(), lower: zeros() };
    let mut maps = [zero; STAGES];
    maps[0].add_identity(1.0);
    if stages == 2 {
        maps[0].add_ad(-1.0 / 12.0, &alpha[1]);
        maps[1].add_ad(1.0 / 12.0, &alpha[0]);
    } else if stages > 2 {
        let [inner, p, q] = factors(alpha);
        let q1 = Map::ad_ad(&q, &alpha[0]);
        maps[0].add_ad(-20.0 * SCALE, &p);
        maps[0].add(L::splat(SCALE), &Map::ad_ad(&p, &alpha[1]));
        maps[0].add(L::splat(-SCALE / 60.0), &q1.times_ad(&alpha[1]));
        maps[0].add(L::splat(SCALE / 60.0), &Map::ad_ad(&q, &inner));
        maps[1].add_ad(-SCALE, &q);
        maps[1].add(L::splat(-SCALE), &Map::ad_ad(&p, &alpha[0]));
        maps[1].add(L::splat(SCALE / 60.0), &q1.times_ad(&alpha[0]));
        maps[2].add_identity(1.0 / 12.0);
        maps[2].add_ad(-SCALE, &p);
        maps[2].add(L::splat(-SCALE / 30.0), &q1);
    }
    maps
}

/// R ∂Ω/∂α_j of forms R, for twists that are rotations alone, as many as there are stages.
///
/// Row vectors go through the brackets one after the other: fewer products than the matrices of [`exponent_derivative`] have entries.
#[inline(always)]
pub(super) fn forms_by_rotation<L: Lane>(
    forms: &Forms<L>,
    alpha: &[Pair<L>; STAGES],
    stages: usize,
) -> [Matrix<L>; STAGES] {
    const SCALE: f64 = 1.0 / 240.0;
    let k = L::splat;
    let mut out = [forms.angular, zeros(), zeros()];
    if stages == 2 {
        out[0] = add_multiple(out[0], k(-1.0 / 12.0), &forms.angular_times_ad(&alpha[1]));
        out[1] = add_multiple(out[1], k(1.0 / 12.0), &forms.angular_times_ad(&alpha[0]));
    } else if stages > 2 {
        let [inner, p, q] = factors(alpha);
        let (by_p, by_q) = (forms.times_ad(&p), forms.times_ad(&q));
        let by_q1 = by_q.times_ad(&alpha[0]);
        let both = by_p.combined(SCALE, -SCALE / 60.0, &by_q1);
        out[0] = add_multiple(out[0], k(-20.0 * SCALE), &by_p.angular);
        out[0] = add_multiple(out[0], k(SCALE / 60.0), &by_q.angular_times_ad(&inner));
        out[0] = add_multiple(out[0], k(1.0), &both.angular_times_ad(&alpha[1]));
        out[1] = add_multiple(out[1], k(-SCALE), &by_q.angular);
        out[1] = add_multiple(out[1], k(-1.0), &both.angular_times_ad(&alpha[0]));
        out[2] = add_multiple(out[2], k(1.0 / 12.0), &forms.angular);
        out[2] = add_multiple(out[2], k(-SCALE), &by_p.angular);
        out[2] = add_multiple(out[2], k(-SCALE / 30.0), &by_q1.angular);
    }
    out
}

/// c₀ … c₅ by their series; where that does not hold, `suspect` is set.
#[inline(always)]
pub(crate) fn stumpff<L: Lane>(x: L, suspect: &mut L) -> [L; 6] {
    *suspect = x.select_lt(L::splat(SERIES_LIMIT), *suspect, L::splat(1.0));
    let (c5, c6) = (x.polynomial(&C5), x.polynomial(&C6));
    let c4 = L::splat(1.0 / 24.0) - x * c6;
    let c3 = L::splat(1.0 / 6.0) - x * c5;
    let c2 = L::splat(0.5) - x * c4;
    let c1 = L::splat(1.0) - x * c3;
    let c0 = L::splat(1.0) - x * c2;
    [c0, c1, c2, c3, c4, c5]
}

/// exp Ω^.
#[inline(always)]
pub(super) fn exp<L: Lane>(omega: &Pair<L>, c: &[L; 6]) -> Placed<L> {
    let (w, v) = (&omega.first, &omega.second);
    let along = scale(dot(w, v) * c[3], w);
    let position = add_scaled(&add_scaled(&along, c[1], v), c[2], &cross(w, v));
    Placed { rotation: isotropic(c[0], c[1], c[2], w), position }
}

/// a I + b ω^ + c ω ωᵀ.
#[inline(always)]
fn isotropic<L: Lane>(a: L, b: L, c: L, w: &Vector<L>) -> Matrix<L> {
    let cw = scale(c, w);
    let diagonal = [cw[0].mul_add(w[0], a), cw[1].mul_add(w[1], a), cw[2].mul_add(w[2], a)];
    from_parts(&diagonal, &[cw[1] * w[2], cw[2] * w[0], cw[0] * w[1]], &scale(b, w))
}

/// dexp₋Ω.
#[inline(always)]
pub(super) fn dexp_minus<L: Lane>(omega: &Pair<L>, c: &[L; 6]) -> Map<L> {
    let (w, v) = (&omega.first, &omega.second);
    let half = L::splat(0.5);
    // derivatives of c₁, c₂, c₃ in x, by dx = 2 ω·ν
    let slope = [half * (c[3] - c[2]), c[4] - half * c[3], half * (L::splat(3.0) * c[5] - c[4])];
    let half_dx = dot(w, v);
    let dx = half_dx + half_dx;
    // even in (ω, ν) but for the skew part
    let k = add_scaled(&scale(c[3], v), slope[2] * half_dx, w);
    let skew = add_scaled(&scale(-c[2], v), -(slope[1] * dx), w);
    let twice = add(&k, &k);
    let d = slope[0] * dx;
    let diagonal = [twice[0].mul_add(w[0], d), twice[1].mul_add(w[1], d), twice[2].mul_add(w[2], d)];
    let off =
        [k[1].mul_add(w[2], w[1] * k[2]), k[2].mul_add(w[0], w[2] * k[0]), k[0].mul_add(w[1], w[0] * k[1])];
    Map { diagonal: isotropic(c[1], -c[2], c[3], w), lower: from_parts(&diagonal, &off, &skew) }
}
