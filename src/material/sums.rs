//! Sums over the points of a section, one partial sum a lane.

use nalgebra::{ArrayStorage, Matrix6};

use super::blocks::Eight;
use super::differentiate::{FibreResponse, Level};
use super::response::{Request, Response};
use crate::lie;
use crate::scalar::lane::MAX_LANES;
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
    /// Volume j of the reference per dA ds, and one over it.
    pub(super) volume: L,
    pub(super) inverse_volume: L,
    /// w j and w/j: the weights of energy and stiffness.
    pub(super) weight_of_energy: L,
    pub(super) weight_of_stiffness: L,
}

impl<L: Lane> Block<L> {
    /// Points that do not move, on a straight reference.
    #[inline(always)]
    pub(super) fn at(x: L, y: L, weight: L) -> Self {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        Self {
            x,
            y,
            weight,
            x_rate: zero,
            y_rate: zero,
            weight_rate: zero,
            volume: one,
            inverse_volume: one,
            weight_of_energy: weight,
            weight_of_stiffness: weight,
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
        Self { energy: energy_of(xi), ..Self::zero() }
    }

    /// Adds energy and wrench of a local law at a block: w j u, w Bᵀ g, and for the rate (w′ Bᵀ + w B′ᵀ) g + w Bᵀ g′.
    #[inline(always)]
    pub(super) fn add_wrench<O: Level>(&mut self, p: &Block<L>, local: &FibreResponse<L>) {
        self.energy = p.weight_of_energy.mul_add(local.energy, self.energy);
        if O::REQUEST >= Request::Wrench {
            add_wrench(&mut self.wrench, &local.stress, p.x, p.y, p.weight);
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

    /// Adds the tangent of a local law at a block, (w/j) Bᵀ h B. A pass of its own: with the other sums there would be more than a machine has
    /// registers, and what is kept in memory waits for the store of the block before.
    #[inline(always)]
    pub(super) fn add_tangent<O: Level>(&mut self, p: &Block<L>, local: &FibreResponse<L>) {
        if O::REQUEST >= Request::Tangent {
            self.add_stiffness(&local.stiffness, p.x, p.y, p.weight_of_stiffness);
        }
    }

    /// K += w Bᵀ h B, upper triangle.
    #[inline(always)]
    fn add_stiffness(&mut self, h: &[L; 6], x: L, y: L, w: L) {
        let (aa, ab, ae) = (h[0] * w, h[1] * w, h[2] * w);
        let (bb, be, ee) = (h[3] * w, h[4] * w, h[5] * w);
        // rows of h taken to the twist about e₃: x h_b· − y h_a·
        let za = x.mul_add(ab, -(y * aa));
        let zb = x.mul_add(bb, -(y * ab));
        // a machine adds beside its multiplications, so that of two ways the one with fewer products is taken
        let (x_be, y_ae, y_ee, x_ee) = (x * be, y * ae, y * ee, x * ee);
        let ze = x_be - y_ae;
        let k = &mut self.tangent;
        k[0] = y.mul_add(y_ee, k[0]);
        k[1] = (-x).mul_add(y_ee, k[1]);
        k[2] = y.mul_add(ze, k[2]);
        k[3] = k[3] + y_ae;
        k[4] = y.mul_add(be, k[4]);
        k[5] = k[5] + y_ee;
        k[6] = x.mul_add(x_ee, k[6]);
        k[7] = (-x).mul_add(ze, k[7]);
        k[8] = (-x).mul_add(ae, k[8]);
        k[9] = k[9] - x_be;
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

    /// Adds the sums over the lanes to the totals.
    #[inline(always)]
    pub(super) fn add_to(&self, request: Request, totals: &mut Totals) {
        let (zero, w, k, r) = (L::splat(0.0), &self.wrench, &self.tangent, &self.rate);
        if request == Request::Energy {
            totals.0[0].0[0] += self.energy.sum();
            return;
        }
        totals.add::<L>(0, &[self.energy, w[0], w[1], w[2], w[3], w[4], w[5], k[0]]);
        if request >= Request::Tangent {
            totals.add::<L>(1, &[k[1], k[2], k[3], k[4], k[5], k[6], k[7], k[8]]);
            totals.add::<L>(2, &[k[9], k[10], k[11], k[12], k[13], k[14], k[15], k[16]]);
            totals.add::<L>(3, &[k[17], k[18], k[19], k[20], r[0], r[1], r[2], r[3]]);
        }
        if request >= Request::Rate {
            totals.add::<L>(4, &[r[4], r[5], zero, zero, zero, zero, zero, zero]);
        }
    }

    /// The sums of each lane as they stand, where each lane is a strain.
    #[inline(always)]
    pub(super) fn add_to_strains(&self, part: usize, request: Request, totals: &mut [Eight; ENTRIES]) {
        add_lanes(&mut totals[0], part, self.energy);
        if request >= Request::Wrench {
            for i in 0..6 {
                add_lanes(&mut totals[WRENCH + i], part, self.wrench[i]);
            }
        }
        if request >= Request::Tangent {
            for i in 0..21 {
                add_lanes(&mut totals[TANGENT + i], part, self.tangent[i]);
            }
        }
        if request >= Request::Rate {
            for i in 0..6 {
                add_lanes(&mut totals[RATE + i], part, self.rate[i]);
            }
        }
    }
}

/// Zero; NaN where a component of the strain is not finite.
#[inline(always)]
pub(super) fn energy_of<L: Lane>(xi: &[L; 6]) -> L {
    let [a, b, c, d, e, f] = *xi;
    L::splat(0.0) * (((a + b) + (c + d)) + (e + f))
}

#[inline(always)]
fn add_lanes<L: Lane>(total: &mut Eight, part: usize, value: L) {
    let sum = total.part::<L>(part) + value;
    total.set_part(part, sum);
}

/// Where wrench, tangent and rate begin among the entries of a response: the energy is the first.
const WRENCH: usize = 1;
const TANGENT: usize = 7;
const RATE: usize = 28;
/// How many entries there are.
pub(super) const ENTRIES: usize = 34;

/// U, Ψ, ∂Ψ/∂Δξ and Ψ′, an entry after the other.
#[derive(Clone, Copy, Debug)]
pub struct Totals([Eight; 5]);

impl Totals {
    pub(super) const ZERO: Self = Self([Eight::ZERO; 5]);

    /// Adds the sums over the lanes of eight entries.
    #[inline(always)]
    fn add<L: Lane>(&mut self, block: usize, values: &[L; MAX_LANES]) {
        let mut sums = Eight::ZERO;
        L::sum_each(values, &mut sums.0);
        for part in 0..MAX_LANES / L::LANES {
            let sum = self.0[block].part::<L>(part) + sums.part::<L>(part);
            self.0[block].set_part(part, sum);
        }
    }

    /// Adds other totals.
    pub(super) fn add_all(&mut self, other: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(&other.0) {
            for i in 0..MAX_LANES {
                mine.0[i] += theirs.0[i];
            }
        }
    }

    /// The totals of strain `i` of several.
    pub(super) fn of_strain(i: usize, entries: &[Eight; ENTRIES]) -> Self {
        let mut totals = Self::ZERO;
        for (k, entry) in entries.iter().enumerate() {
            totals.0[k / MAX_LANES].0[k % MAX_LANES] = entry.0[i];
        }
        totals
    }

    #[inline(always)]
    fn entry(&self, k: usize) -> f64 {
        self.0[k / MAX_LANES].0[k % MAX_LANES]
    }

    /// U; NaN where the state is not admissible or an entry that was asked for not finite.
    #[inline(always)]
    pub(super) fn judged<L: Lane>(&self, request: Request, admissible: bool) -> f64 {
        let finite = match request {
            Request::Energy => true, // speaks for itself
            Request::Wrench => {
                let six = self.six(WRENCH);
                // 0 x is 0 where x is finite and NaN elsewhere
                (six.moment + six.force).sum() * 0.0 == 0.0
            }
            Request::Tangent | Request::Rate => self.is_finite::<L>(),
        };
        if admissible && finite { self.entry(0) } else { f64::NAN }
    }

    /// The response, which is written entry by entry where it goes: what was not asked for is zero.
    #[inline(always)]
    pub(super) fn response(&self, request: Request) -> Response {
        let energy = self.entry(0);
        if request == Request::Energy {
            return Response { energy, ..Response::ZERO };
        }
        let (wrench, wrench_rate) = (self.six(WRENCH), self.six(RATE));
        let tangent = if request == Request::Wrench { Matrix6::zeros() } else { self.tangent() };
        Response { energy, wrench, tangent, wrench_rate }
    }

    #[inline(always)]
    fn tangent(&self) -> Matrix6<f64> {
        let mut columns = [[0.0; 6]; 6];
        let mut k = TANGENT;
        for i in 0..6 {
            for j in i..6 {
                columns[i][j] = self.entry(k);
                columns[j][i] = self.entry(k);
                k += 1;
            }
        }
        Matrix6::from_array_storage(ArrayStorage(columns))
    }

    #[inline(always)]
    fn six(&self, k: usize) -> lie::Wrench {
        let mut six = [0.0; 6];
        for i in 0..6 {
            six[i] = self.entry(k + i);
        }
        lie::Wrench::from_array(six)
    }

    /// Whether every entry is finite.
    #[inline(always)]
    fn is_finite<L: Lane>(&self) -> bool {
        // 0 x is 0 where x is finite and NaN elsewhere
        let zero = L::splat(0.0);
        let mut all = zero;
        for part in 0..MAX_LANES / L::LANES {
            let [a, b, c, d, e] = super::blocks::parts::<L, 5>(&self.0, part);
            all = zero.mul_add((a + b) + (c + d) + e, all);
        }
        all.sum() == 0.0
    }
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
