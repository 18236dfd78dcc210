//! Sums over the points of a section, one partial sum a lane.

use super::differentiate::{FibreResponse, Level};
use super::response::{Request, Response};
use crate::lie;
use crate::scalar::{Jet, Lane};

/// Partial sums of U, Ψ, ∂Ψ/∂Δξ (upper triangle by rows) and Ψ′.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums<L> {
    energy: L,
    wrench: [L; 6],
    tangent: [L; 21],
    rate: [L; 6],
}

/// Coordinates and weight of a block of points, with their derivatives along s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block<L> {
    pub(super) x: L,
    pub(super) y: L,
    pub(super) weight: L,
    pub(super) x_rate: L,
    pub(super) y_rate: L,
    pub(super) weight_rate: L,
    /// Volume of the reference per dA ds, and one over it.
    pub(super) volume: L,
    pub(super) inverse_volume: L,
}

impl<L: Lane> Block<L> {
    /// Points that do not move, on a straight reference.
    #[inline(always)]
    pub(super) fn at(x: L, y: L, weight: L) -> Self {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        Self { x, y, weight, x_rate: zero, y_rate: zero, weight_rate: zero, volume: one, inverse_volume: one }
    }

    /// The same point in every lane.
    #[inline(always)]
    pub(super) fn fixed(x: f64, y: f64, weight: f64) -> Self {
        Self::at(L::splat(x), L::splat(y), L::splat(weight))
    }

    /// The point of lane `i` in every lane, its weight in one.
    #[inline(always)]
    pub(super) fn only(&self, i: usize) -> Self {
        Self {
            x: self.x.spread(i),
            y: self.y.spread(i),
            weight: self.weight.isolate(i),
            x_rate: self.x_rate.spread(i),
            y_rate: self.y_rate.spread(i),
            weight_rate: self.weight_rate.isolate(i),
            volume: self.volume.spread(i),
            inverse_volume: self.inverse_volume.spread(i),
        }
    }
}

impl<L: Lane> Sums<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        let zero = L::splat(0.0);
        Self { energy: zero, wrench: [zero; 6], tangent: [zero; 21], rate: [zero; 6] }
    }

    /// Zero, with an energy that is NaN where a component of the strain is not finite: a law need not look at every one.
    #[inline(always)]
    pub(super) fn of(xi: &[L; 6]) -> Self {
        let mut sums = Self::zero();
        for &component in xi {
            sums.energy = component.mul_add(L::splat(0.0), sums.energy);
        }
        sums
    }

    /// Adds a block of a local law: w j u, w Bᵀ g, (w/j) Bᵀ h B and (w′ Bᵀ + w B′ᵀ) g + w Bᵀ g′.
    #[inline(always)]
    pub(super) fn add_local<O: Level>(&mut self, p: &Block<L>, local: &FibreResponse<L>) {
        self.energy = (p.weight * p.volume).mul_add(local.energy, self.energy);
        if O::REQUEST >= Request::Wrench {
            add_wrench(&mut self.wrench, &local.stress, p.x, p.y, p.weight);
        }
        if O::REQUEST >= Request::Tangent {
            self.add_tangent(&local.stiffness, p.x, p.y, p.weight * p.inverse_volume);
        }
        if O::REQUEST >= Request::Rate {
            add_wrench(&mut self.rate, &local.stress, p.x, p.y, p.weight_rate);
            add_wrench(&mut self.rate, &local.stress_rate, p.x, p.y, p.weight);
            let g = local.stress;
            let (g_a, g_b, g_e) = (g[0] * p.weight, g[1] * p.weight, g[2] * p.weight);
            self.rate[0] = p.y_rate.mul_add(g_e, self.rate[0]);
            self.rate[1] = self.rate[1] - p.x_rate * g_e;
            self.rate[2] = self.rate[2] + p.x_rate.mul_add(g_b, -(p.y_rate * g_a));
        }
    }

    /// K += w Bᵀ h B, upper triangle.
    #[inline(always)]
    fn add_tangent(&mut self, h: &[L; 6], x: L, y: L, w: L) {
        let (aa, ab, ae) = (h[0] * w, h[1] * w, h[2] * w);
        let (bb, be, ee) = (h[3] * w, h[4] * w, h[5] * w);
        // rows of h taken to the twist about e₃: x h_b· − y h_a·
        let za = x.mul_add(ab, -(y * aa));
        let zb = x.mul_add(bb, -(y * ab));
        let ze = x.mul_add(be, -(y * ae));
        let (y_ee, x_ee) = (y * ee, x * ee);
        let k = &mut self.tangent;
        k[0] = y.mul_add(y_ee, k[0]);
        k[1] = (-x).mul_add(y_ee, k[1]);
        k[2] = y.mul_add(ze, k[2]);
        k[3] = y.mul_add(ae, k[3]);
        k[4] = y.mul_add(be, k[4]);
        k[5] = k[5] + y_ee;
        k[6] = x.mul_add(x_ee, k[6]);
        k[7] = (-x).mul_add(ze, k[7]);
        k[8] = (-x).mul_add(ae, k[8]);
        k[9] = (-x).mul_add(be, k[9]);
        k[10] = k[10] - x_ee;
        k[11] = x.mul_add(zb, (-y).mul_add(za, k[11]));
        k[12] = k[12] + za;
        k[13] = k[13] + zb;
        k[14] = k[14] + ze;
        k[15] = k[15] + aa;
        k[16] = k[16] + ab;
        k[17] = k[17] + ae;
        k[18] = k[18] + bb;
        k[19] = k[19] + be;
        k[20] = k[20] + ee;
    }

    /// Adds a block of a section-level law, a jet in Δξ, or in (Δξ, s): w u, w ∂u/∂Δξ, w ∂²u/∂Δξ² and w ∂²u/∂Δξ∂s + w′ ∂u/∂Δξ.
    #[inline(always)]
    pub(super) fn add_sectional<const N: usize, const M: usize>(&mut self, p: &Block<L>, u: &Jet<L, N, M>) {
        let w = p.weight;
        self.energy = w.mul_add(u.value, self.energy);
        for i in 0..N.min(6) {
            self.wrench[i] = w.mul_add(u.gradient[i], self.wrench[i]);
            for j in i..if M > 0 { 6 } else { 0 } {
                let k = packed_index(6, i, j);
                self.tangent[k] = w.mul_add(u.hessian[packed_index(N, i, j)], self.tangent[k]);
            }
            if N > 6 {
                let mixed = u.hessian[packed_index(N, i, N - 1)];
                self.rate[i] = w.mul_add(mixed, p.weight_rate.mul_add(u.gradient[i], self.rate[i]));
            }
        }
    }

    /// The sums of one lane, where each lane is a strain.
    #[inline(always)]
    pub(super) fn read_lane(&self, lane: usize, request: Request, out: &mut Response) {
        *out = Response::zero();
        out.energy = self.energy.lane(lane);
        let six = |v: &[L; 6]| lie::Wrench::from_array(std::array::from_fn(|i| v[i].lane(lane)));
        if request >= Request::Wrench {
            out.wrench = six(&self.wrench);
        }
        if request >= Request::Tangent {
            for i in 0..6 {
                for j in i..6 {
                    let k = self.tangent[packed_index(6, i, j)].lane(lane);
                    out.tangent[(i, j)] = k;
                    out.tangent[(j, i)] = k;
                }
            }
        }
        if request >= Request::Rate {
            out.wrench_rate = six(&self.rate);
        }
    }

    /// The sums over the lanes.
    #[inline(always)]
    pub(super) fn finish(&self, request: Request) -> Response {
        let mut out = Response::zero();
        out.energy = self.energy.sum();
        if request >= Request::Wrench {
            out.wrench = lie::Wrench::from_array(sum6(&self.wrench));
        }
        if request >= Request::Tangent {
            for i in 0..6 {
                for j in i..6 {
                    let sum = self.tangent[packed_index(6, i, j)].sum();
                    out.tangent[(i, j)] = sum;
                    out.tangent[(j, i)] = sum;
                }
            }
        }
        if request >= Request::Rate {
            out.wrench_rate = lie::Wrench::from_array(sum6(&self.rate));
        }
        out
    }
}

#[inline(always)]
fn sum6<L: Lane>(v: &[L; 6]) -> [f64; 6] {
    [v[0].sum(), v[1].sum(), v[2].sum(), v[3].sum(), v[4].sum(), v[5].sum()]
}

/// Where entry (i, j), i ≤ j, of a symmetric n×n matrix lies in its upper triangle stored by rows.
const fn packed_index(n: usize, i: usize, j: usize) -> usize {
    i * n - i * (i + 1) / 2 + j
}

/// Ψ += w Bᵀ g.
#[inline(always)]
fn add_wrench<L: Lane>(wrench: &mut [L; 6], g: &[L; 3], x: L, y: L, w: L) {
    let (g_a, g_b, g_e) = (g[0] * w, g[1] * w, g[2] * w);
    wrench[0] = y.mul_add(g_e, wrench[0]);
    wrench[1] = (-x).mul_add(g_e, wrench[1]);
    wrench[2] = x.mul_add(g_b, (-y).mul_add(g_a, wrench[2]));
    wrench[3] = wrench[3] + g_a;
    wrench[4] = wrench[4] + g_b;
    wrench[5] = wrench[5] + g_e;
}
