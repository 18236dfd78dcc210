//! A law at a full deformation gradient F = I + H, differentiated in the nine entries of H: what a section that relaxes asks for.
//!
//! An isotropic law is differentiated in its three invariants, and the chain to H is written out with the tensor cross product
//! (X × Y)ᵢₐ = εᵢⱼₖ εₐᵦ꜀ Xⱼᵦ Yₖ꜀, in which cof F = ½ F × F and d(cof F) = F × dF (Bonet, Gil and Ortigosa 2015, Comput. Methods Appl.
//! Mech. Eng. 283, 1061). Any other local law is differentiated in all nine.

use std::marker::PhantomData;

use nalgebra::{Matrix3, SMatrix, SVector};
use num_dual::{Derivative, Dual2SVec64};

use super::differentiate::{Energy, Level, Rate, Tangent, Wrench};
use super::kinematics::{Deformation, Invariants, Point};
use super::law::{Isotropic, Local};
use super::response::{Points, Request};
use super::walk::Walk;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};
use crate::scalar::{Jet, Lane};

/// Entries of the symmetric 9×9 stiffness, upper triangle by rows.
pub(crate) const STIFFNESS: usize = 45;

/// Points of the section, one a lane, and H there.
#[derive(Clone, Copy, Debug)]
pub struct GradientSite<L> {
    /// x and y.
    pub position: [L; 2],
    /// x′ and y′.
    pub position_rate: [L; 2],
    /// s.
    pub s: L,
    /// H, by rows.
    pub h: [L; 9],
}

/// Value and derivatives of an energy density u(H), as far as asked.
#[derive(Clone, Copy, Debug)]
pub struct GradientResponse<L> {
    /// u, J/m³.
    pub energy: L,
    /// P = ∂u/∂F by rows, the first Piola stress, Pa.
    pub stress: [L; 9],
    /// ∂²u/∂F², Pa, upper triangle by rows.
    pub stiffness: [L; STIFFNESS],
    /// ∂P/∂s at fixed H, Pa/m.
    pub stress_rate: [L; 9],
}

impl<L: Lane> GradientSite<L> {
    #[inline(always)]
    fn only(&self, i: usize) -> Self {
        let ([x, y], [dx, dy]) = (self.position, self.position_rate);
        let mut h = self.h;
        for c in 0..9 {
            h[c] = h[c].spread(i);
        }
        Self {
            position: [x.spread(i), y.spread(i)],
            position_rate: [dx.spread(i), dy.spread(i)],
            s: self.s.spread(i),
            h,
        }
    }

    #[inline(always)]
    fn fixed_point<const N: usize, const M: usize>(&self) -> Point<Jet<L, N, M>> {
        let [x, y] = self.position;
        Point { x: Jet::constant(x), y: Jet::constant(y), s: Jet::constant(self.s) }
    }

    #[inline(always)]
    fn moving_point(&self) -> Point<Jet<L, 4, 10>> {
        let ([x, y], [dx, dy]) = (self.position, self.position_rate);
        Point {
            x: Jet::constant(x).with_slope(3, dx),
            y: Jet::constant(y).with_slope(3, dy),
            s: Jet::constant(self.s).with_slope(3, L::splat(1.0)),
        }
    }
}

impl<L: Lane> GradientResponse<L> {
    #[inline(always)]
    fn energy_only(energy: L) -> Self {
        let zero = L::splat(0.0);
        Self { energy, stress: [zero; 9], stiffness: [zero; STIFFNESS], stress_rate: [zero; 9] }
    }
}

/// X × Y by rows.
#[inline(always)]
fn cross<L: Lane>(x: &[L; 9], y: &[L; 9]) -> [L; 9] {
    let mut out = [L::splat(0.0); 9];
    for i in 0..3 {
        let (j, k) = (3 * ((i + 1) % 3), 3 * ((i + 2) % 3));
        for a in 0..3 {
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            let plus = x[j + b].mul_add(y[k + c], x[k + c] * y[j + b]);
            out[3 * i + a] = plus - x[j + c].mul_add(y[k + b], x[k + b] * y[j + c]);
        }
    }
    out
}

/// Adds factor × (the matrix of Y ↦ X × Y) to a symmetric 9×9 matrix.
#[inline(always)]
fn add_cross<L: Lane>(x: &[L; 9], factor: L, out: &mut [L; STIFFNESS]) {
    for i in 0..3 {
        for a in 0..3 {
            for (k, b, sign) in [(1, 1, 1.0), (2, 2, 1.0), (1, 2, -1.0), (2, 1, -1.0)] {
                // entry ((i, a), (i+k, a+b)) is ±X at the third row and column
                let (row, column) = (3 * i + a, 3 * ((i + k) % 3) + (a + b) % 3);
                if row < column {
                    let third = 3 * ((i + 3 - k) % 3) + (a + 3 - b) % 3;
                    let at = packed(row, column);
                    out[at] = out[at] + x[third] * factor * L::splat(sign);
                }
            }
        }
    }
}

/// Where entry (i, j), i ≤ j, of a symmetric 9×9 matrix is stored.
#[inline(always)]
pub(crate) const fn packed(i: usize, j: usize) -> usize {
    i * 9 + j - i * (i + 1) / 2
}

/// H, K = cof F − I and the invariants' deviations.
struct Kinematics<L> {
    h: [L; 9],
    change: [L; 9],
    invariants: [L; 3],
}

impl<L: Lane> Kinematics<L> {
    /// See [`Invariants::of_gradient`].
    #[inline(always)]
    fn of(h: &[L; 9]) -> Self {
        let (two, half) = (L::splat(2.0), L::splat(0.5));
        let mut cofactor = cross(h, h);
        for c in 0..9 {
            cofactor[c] = cofactor[c] * half;
        }
        let trace = h[0] + h[4] + h[8];
        let second = cofactor[0] + cofactor[4] + cofactor[8];
        let det = h[0] * cofactor[0] + h[1] * cofactor[1] + h[2] * cofactor[2];
        let mut change = cofactor;
        let (mut h_squared, mut k_squared) = (L::splat(0.0), L::splat(0.0));
        for i in 0..3 {
            change[4 * i] = change[4 * i] + trace;
            for a in 0..3 {
                change[3 * i + a] = change[3 * i + a] - h[3 * a + i];
            }
        }
        for c in 0..9 {
            h_squared = h[c].mul_add(h[c], h_squared);
            k_squared = change[c].mul_add(change[c], k_squared);
        }
        let twice = (second + det) * two;
        let invariants = [h_squared - twice, k_squared - twice - det * two, trace + second + det];
        Self { h: *h, change, invariants }
    }

    /// Derivatives of the three invariants in H, each of the order of H but for that of J.
    #[inline(always)]
    fn slopes(&self) -> [[L; 9]; 3] {
        let two = L::splat(2.0);
        let (h, k) = (&self.h, &self.change);
        let mut identity = [L::splat(0.0); 9];
        for i in 0..3 {
            identity[4 * i] = L::splat(1.0);
        }
        // cof F = I + K;  ½ d(I₁ excess) = H − K;  ½ d(I₂ excess) = F × cof F − 2 cof F = I × (K − H) + H × (K − H)
        let mut difference = *k;
        let mut f = *h;
        for c in 0..9 {
            difference[c] = k[c] - h[c];
            f[c] = h[c] + identity[c];
        }
        let (mut first, mut second, mut third) = (*k, cross(&f, &difference), *k);
        for c in 0..9 {
            first[c] = -(difference[c] * two);
            second[c] = second[c] * two;
            third[c] = k[c] + identity[c];
        }
        [first, second, third]
    }
}

/// Three variables, and the arc length as a fourth where Ψ′ is wanted; then the chain to H.
#[inline(always)]
pub(super) fn isotropic_gradient_response<M: Isotropic + ?Sized, L: Lane, O: Level>(
    law: &M,
    site: &GradientSite<L>,
) -> GradientResponse<L> {
    let kinematics = Kinematics::of(&site.h);
    let [a, b, j] = kinematics.invariants;
    match O::REQUEST {
        Request::Energy => {
            let i = Invariants::from_excess(Jet::<L, 0, 0>::constant(a), Jet::constant(b), Jet::constant(j));
            GradientResponse::energy_only(law.energy_density(&i, &site.fixed_point()).value)
        }
        Request::Wrench => {
            let i = Invariants::from_excess(
                Jet::<L, 3, 0>::variable(a, 0),
                Jet::variable(b, 1),
                Jet::variable(j, 2),
            );
            let u = law.energy_density(&i, &site.fixed_point());
            let stress = combine(&u.gradient, &kinematics.slopes());
            GradientResponse { stress, ..GradientResponse::energy_only(u.value) }
        }
        Request::Tangent => {
            let i = Invariants::from_excess(
                Jet::<L, 3, 6>::variable(a, 0),
                Jet::variable(b, 1),
                Jet::variable(j, 2),
            );
            let u = law.energy_density(&i, &site.fixed_point());
            chain(&kinematics, u.value, &u.gradient, &u.hessian)
        }
        Request::Rate => {
            let i = Invariants::from_excess(
                Jet::<L, 4, 10>::variable(a, 0),
                Jet::variable(b, 1),
                Jet::variable(j, 2),
            );
            let u = law.energy_density(&i, &site.moving_point());
            let ([u_a, u_b, u_j, _], h) = (u.gradient, u.hessian);
            let second = [h[0], h[1], h[2], h[4], h[5], h[7]];
            let mut out = chain(&kinematics, u.value, &[u_a, u_b, u_j], &second);
            out.stress_rate = combine(&[h[3], h[6], h[8]], &kinematics.slopes());
            out
        }
    }
}

#[inline(always)]
fn combine<L: Lane>(factors: &[L; 3], terms: &[[L; 9]; 3]) -> [L; 9] {
    let mut out = [L::splat(0.0); 9];
    for c in 0..9 {
        out[c] = factors[0].mul_add(terms[0][c], factors[1].mul_add(terms[1][c], factors[2] * terms[2][c]));
    }
    out
}

/// P = Σ uₙ dIₙ; ∂²u = Σ uₙₘ dIₙ ⊗ dIₘ + 2u₁ 1 + (u₃ − 2u₁ − 4u₂) (F×) + 2u₂ ((cof F)× + (F×)²).
#[inline(always)]
fn chain<L: Lane>(
    kinematics: &Kinematics<L>,
    energy: L,
    first: &[L; 3],
    second: &[L; 6],
) -> GradientResponse<L> {
    let (one, two) = (L::splat(1.0), L::splat(2.0));
    let slopes = kinematics.slopes();
    let mut out = GradientResponse::energy_only(energy);
    out.stress = combine(first, &slopes);
    let [u_1, u_2, u_3] = *first;
    let [s_11, s_12, s_13, s_22, s_23, s_33] = *second;
    let rows = [
        combine(&[s_11, s_12, s_13], &slopes),
        combine(&[s_12, s_22, s_23], &slopes),
        combine(&[s_13, s_23, s_33], &slopes),
    ];
    for i in 0..9 {
        for k in i..9 {
            let sum = slopes[0][i] * rows[0][k] + slopes[1][i] * rows[1][k];
            out.stiffness[packed(i, k)] = slopes[2][i].mul_add(rows[2][k], sum);
        }
        out.stiffness[packed(i, i)] = out.stiffness[packed(i, i)] + two * u_1;
    }
    let mut f = kinematics.h;
    for i in 0..3 {
        f[4 * i] = f[4 * i] + one;
    }
    add_cross(&f, u_3 - two * u_1 - L::splat(4.0) * u_2, &mut out.stiffness);
    let zero = L::splat(0.0);
    // |u₂| as 0 or 1 in each lane: a law that does without I₂ skips the rest
    let used = u_2.select_lt(zero, one, zero.select_lt(u_2, one, zero));
    if used.sum() == 0.0 {
        return out;
    }
    add_cross(&slopes[2], two * u_2, &mut out.stiffness);
    // (F×)² column by column: F × (F × E) for E the unit matrices, of which only the upper triangle is kept
    for k in 0..9 {
        let mut unit = [L::splat(0.0); 9];
        unit[k] = two * u_2;
        let column = cross(&f, &cross(&f, &unit));
        for i in 0..=k {
            out.stiffness[packed(i, k)] = out.stiffness[packed(i, k)] + column[i];
        }
    }
    out
}

/// Nine variables, one point at a time; s as a tenth where Ψ′ is wanted.
pub(super) fn local_gradient_response<M: Local + ?Sized, L: Lane, O: Level>(
    law: &M,
    site: &GradientSite<L>,
) -> GradientResponse<L> {
    let mut lanes = [[0.0; MAX_LANES]; 1 + 9 + STIFFNESS + 9];
    for lane in 0..L::LANES {
        let h: [f64; 9] = std::array::from_fn(|c| site.h[c].lane(lane));
        let [x, y] = site.position.map(|v| v.lane(lane));
        let at = Point { x, y, s: site.s.lane(lane) };
        match O::REQUEST {
            Request::Energy => {
                let f = Deformation::from_gradient(&Matrix3::from_row_slice(&h));
                lanes[0][lane] = law.energy_density(&f, &at);
            }
            Request::Wrench | Request::Tangent => {
                let f = Deformation::from_gradient(&variables::<9>(&h));
                let u = law.energy_density(&f, &at.cast());
                read(&u, lane, &mut lanes);
            }
            Request::Rate => {
                let [dx, dy] = site.position_rate.map(|v| v.lane(lane));
                let moving = |value: f64, rate: f64| {
                    let mut v = SVector::<f64, 10>::zeros();
                    v[9] = rate;
                    Dual2SVec64::<10>::new(value, Derivative::some(v.transpose()), Derivative::none())
                };
                let at = Point { x: moving(at.x, dx), y: moving(at.y, dy), s: moving(at.s, 1.0) };
                let u = law.energy_density(&Deformation::from_gradient(&variables::<10>(&h)), &at);
                read(&u, lane, &mut lanes);
                let v2 = u.v2.unwrap_generic(nalgebra::Const::<10>, nalgebra::Const::<10>);
                for c in 0..9 {
                    lanes[1 + 9 + STIFFNESS + c][lane] = v2[(c, 9)];
                }
            }
        }
    }
    let load = |c: usize| L::load(&lanes[c]);
    GradientResponse {
        energy: load(0),
        stress: std::array::from_fn(|c| load(1 + c)),
        stiffness: std::array::from_fn(|c| load(10 + c)),
        stress_rate: std::array::from_fn(|c| load(10 + STIFFNESS + c)),
    }
}

/// H with its entries as the first nine of N variables.
fn variables<const N: usize>(h: &[f64; 9]) -> Matrix3<Dual2SVec64<N>> {
    Matrix3::from_fn(|i, k| {
        let mut unit = SMatrix::<f64, 1, N>::zeros();
        unit[3 * i + k] = 1.0;
        Dual2SVec64::new(h[3 * i + k], Derivative::some(unit), Derivative::none())
    })
}

/// Reads value, gradient and Hessian in the first nine variables.
fn read<const N: usize>(u: &Dual2SVec64<N>, lane: usize, lanes: &mut [[f64; MAX_LANES]]) {
    let (one, n) = (nalgebra::Const::<1>, nalgebra::Const::<N>);
    let (v1, v2) = (u.v1.clone().unwrap_generic(one, n), u.v2.clone().unwrap_generic(n, n));
    lanes[0][lane] = u.re;
    for i in 0..9 {
        lanes[1 + i][lane] = v1[i];
        for k in i..9 {
            lanes[10 + packed(i, k)][lane] = v2[(i, k)];
        }
    }
}

/// H at the points of a section.
#[derive(Clone, Copy)]
pub(crate) struct GradientBatch<'a> {
    /// The points.
    pub(crate) points: &'a Points,
    /// Arc length.
    pub(crate) s: f64,
    /// H, entry by entry (by rows), for all points each.
    pub(crate) h: &'a [f64],
}

/// What a law answers at the points of a section, entry by entry, for all points each.
#[derive(Clone, Debug, Default)]
pub(crate) struct GradientState {
    /// u.
    pub(crate) energy: Vec<f64>,
    /// P.
    pub(crate) stress: Vec<f64>,
    /// ∂P/∂F.
    pub(crate) stiffness: Vec<f64>,
    /// ∂P/∂s at fixed H.
    pub(crate) stress_rate: Vec<f64>,
}

impl GradientState {
    /// Evaluates a law; the smallest J is returned (what a NaN in H makes of it is not said).
    pub(crate) fn evaluate<M: Local>(&mut self, law: &M, batch: GradientBatch<'_>, request: Request) -> f64 {
        let n = batch.points.len();
        self.energy.resize(n, 0.0);
        self.stress.resize(9 * n, 0.0);
        self.stiffness.resize(STIFFNESS * n, 0.0);
        self.stress_rate.resize(9 * n, 0.0);
        match request {
            Request::Energy => {
                dispatch(GradientKernel { law, batch, out: self, level: PhantomData::<Energy> })
            }
            Request::Wrench => {
                dispatch(GradientKernel { law, batch, out: self, level: PhantomData::<Wrench> })
            }
            Request::Tangent => {
                dispatch(GradientKernel { law, batch, out: self, level: PhantomData::<Tangent> })
            }
            Request::Rate => dispatch(GradientKernel { law, batch, out: self, level: PhantomData::<Rate> }),
        }
    }

    /// Writes a block, or one lane of it, where its points are.
    #[inline(always)]
    fn store<L: Lane, O: Level>(&mut self, q: usize, lane: Option<usize>, response: &GradientResponse<L>) {
        let n = self.energy.len();
        write(&mut self.energy[q..], lane, response.energy);
        if O::REQUEST >= Request::Wrench {
            for c in 0..9 {
                write(&mut self.stress[c * n + q..(c + 1) * n], lane, response.stress[c]);
            }
        }
        if O::REQUEST >= Request::Tangent {
            for c in 0..STIFFNESS {
                write(&mut self.stiffness[c * n + q..(c + 1) * n], lane, response.stiffness[c]);
            }
        }
        if O::REQUEST >= Request::Rate {
            for c in 0..9 {
                write(&mut self.stress_rate[c * n + q..(c + 1) * n], lane, response.stress_rate[c]);
            }
        }
    }
}

/// A block, or one lane of it, written to the points it belongs to.
#[inline(always)]
fn write<L: Lane>(to: &mut [f64], lane: Option<usize>, value: L) {
    match lane {
        Some(lane) => to[lane] = value.lane(lane),
        None => value.store(to),
    }
}

struct GradientKernel<'a, 'b, M, O> {
    law: &'a M,
    batch: GradientBatch<'a>,
    out: &'b mut GradientState,
    level: PhantomData<O>,
}

impl<M: Local, O: Level> Kernel for GradientKernel<'_, '_, M, O> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lane>(self) -> f64 {
        let Self { law, batch, out, .. } = self;
        let n = batch.points.len();
        let mut walk = Walk::over::<L>(n);
        loop {
            let mut smallest = L::splat(f64::INFINITY);
            while let Some((q, lane)) = walk.place() {
                let mut site = load::<L, O>(&batch, q);
                let trace = site.h[0] + site.h[4] + site.h[8];
                let minors = cross(&site.h, &site.h);
                let det = site.h[0] * minors[0] + site.h[1] * minors[1] + site.h[2] * minors[2];
                let change = (minors[0] + minors[4] + minors[8] + det) * L::splat(0.5) + trace;
                smallest = smallest.min(change + L::splat(1.0));
                if let Some(lane) = lane {
                    site = site.only(lane);
                }
                let response = law.respond_to_gradient::<L, O>(&site);
                if walk.advance() {
                    out.store::<L, O>(q, lane, &response);
                }
            }
            if !walk.again() {
                return smallest.min_lane();
            }
        }
    }
}

/// Points q.. of the section, the last block filled up with copies of its first point.
#[inline(always)]
fn load<L: Lane, O: Level>(batch: &GradientBatch<'_>, q: usize) -> GradientSite<L> {
    let n = batch.points.len();
    let mut position_rate = [L::splat(0.0); 2];
    if let (true, Some(rates)) = (O::REQUEST >= Request::Rate, &batch.points.rates) {
        position_rate = [load_from(&rates.x, q), load_from(&rates.y, q)];
    }
    let mut h = [L::splat(0.0); 9];
    for c in 0..9 {
        h[c] = load_from(&batch.h[c * n..(c + 1) * n], q);
    }
    let position = [load_from(&batch.points.x, q), load_from(&batch.points.y, q)];
    GradientSite { position, position_rate, s: L::splat(batch.s), h }
}

#[inline(always)]
fn load_from<L: Lane>(values: &[f64], q: usize) -> L {
    L::load_or(&values[q..], values[q])
}
