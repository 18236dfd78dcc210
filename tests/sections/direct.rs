//! The section's integrals written a second time and differently: F as a 3×3 matrix, invariants from C = FᵀF, one dual number
//! for Δξ and s together, and product Gauss rules made here. Shares nothing with the crate but `num_dual`.

use nalgebra::{Matrix3, Vector3};
use num_dual::{DualNum, HyperDual64};

pub type D = HyperDual64;

/// Energy per volume from F and the place (x, y, s).
pub type Energy = fn(&Matrix3<D>, [D; 3]) -> D;
/// Where a point of a fixed domain lies at s.
pub type Map<'a> = &'a dyn Fn([f64; 2], D) -> [D; 2];

pub fn constant(v: f64) -> D {
    D::from_re(v)
}

/// Gauss–Legendre on [−1, 1] by Newton's method on the recurrence.
pub fn gauss(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..100 {
                let (mut p, mut q) = (1.0, x);
                for k in 2..=n {
                    (p, q) = (q, ((2 * k - 1) as f64 * x * q - (k - 1) as f64 * p) / k as f64);
                }
                slope = n as f64 * (p - x * q) / (1.0 - x * x);
                let step = q / slope;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// The rectangle [x0, x1] × [y0, y1].
pub fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], n: usize) -> Vec<([f64; 2], f64)> {
    let line = gauss(n);
    let on = |a: f64, b: f64, t: f64| 0.5 * (a + b) + 0.5 * (b - a) * t;
    let mut points = Vec::new();
    for &(u, wu) in &line {
        for &(v, wv) in &line {
            points.push(([on(x0, x1, u), on(y0, y1, v)], 0.25 * (x1 - x0) * (y1 - y0) * wu * wv));
        }
    }
    points
}

/// The annulus between two radii, 0 ≤ inner < outer.
pub fn ring(inner: f64, outer: f64, n: usize) -> Vec<([f64; 2], f64)> {
    let mut points = Vec::new();
    let angles = 2 * n;
    for (u, w) in gauss(n) {
        let r = 0.5 * (inner + outer) + 0.5 * (outer - inner) * u;
        for k in 0..angles {
            let (sin, cos) = (std::f64::consts::TAU * (k as f64 + 0.3) / angles as f64).sin_cos();
            let weight = 0.5 * (outer - inner) * w * r * std::f64::consts::TAU / angles as f64;
            points.push(([r * cos, r * sin], weight));
        }
    }
    points
}

/// The triangle with the given vertices.
pub fn triangle([a, b, c]: [[f64; 2]; 3], n: usize) -> Vec<([f64; 2], f64)> {
    let twice = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
    rectangle([0.0, 1.0], [0.0, 1.0], n)
        .into_iter()
        .map(|([t, v], w)| {
            let place = |i: usize| a[i] + t * ((1.0 - v) * (b[i] - a[i]) + v * (c[i] - a[i]));
            ([place(0), place(1)], w * t * twice)
        })
        .collect()
}

/// What is integrated: an energy over a fixed domain that a map carries to the section at s, about a reference ξ*(s).
pub struct Direct<'a> {
    pub energy: Energy,
    pub domain: Vec<([f64; 2], f64)>,
    pub map: Map<'a>,
    /// det of the map's derivative, for the weights.
    pub jacobian: &'a dyn Fn([f64; 2], D) -> D,
    pub reference: &'a dyn Fn(D) -> [D; 6],
}

impl Direct<'_> {
    /// U(Δξ, s) = ∫ u(F) det(...) dA with F = [e₁ e₂ γ_tot][e₁ e₂ γ*]⁻¹.
    fn total(&self, strain: [D; 6], s: D) -> D {
        let reference = (self.reference)(s);
        let mut sum = constant(0.0);
        for &(p, w) in &self.domain {
            let [x, y] = (self.map)(p, s);
            let column = |xi: &[D; 6]| {
                let r = Vector3::new(x, y, constant(0.0));
                Vector3::new(xi[3], xi[4], xi[5]) + Vector3::new(xi[0], xi[1], xi[2]).cross(&r)
            };
            let total: [D; 6] = std::array::from_fn(|i| strain[i] + reference[i]);
            let (now, then) = (column(&total), column(&reference));
            let f = frame(&now) * inverse(&frame(&then));
            sum += (self.energy)(&f, [x, y, s]) * then.z * (self.jacobian)(p, s) * w;
        }
        sum
    }

    /// U, Ψ and Ψ′ by hyper-dual numbers in one component of Δξ and in s.
    pub fn respond(&self, strain: [f64; 6], s: f64) -> (f64, [f64; 6], [f64; 6]) {
        let (mut psi, mut rate, mut energy) = ([0.0; 6], [0.0; 6], 0.0);
        for i in 0..6 {
            let mut xi = strain.map(constant);
            xi[i] = xi[i].derivative1();
            let u = self.total(xi, constant(s).derivative2());
            (energy, psi[i], rate[i]) = (u.re, u.eps1, u.eps1eps2);
        }
        (energy, psi, rate)
    }
}

fn frame(third: &Vector3<D>) -> Matrix3<D> {
    let mut m = Matrix3::from_fn(|i, j| constant(if i == j { 1.0 } else { 0.0 }));
    m.set_column(2, third);
    m
}

fn determinant(m: &Matrix3<D>) -> D {
    m[(0, 0)] * (m[(1, 1)] * m[(2, 2)] - m[(1, 2)] * m[(2, 1)])
        - m[(0, 1)] * (m[(1, 0)] * m[(2, 2)] - m[(1, 2)] * m[(2, 0)])
        + m[(0, 2)] * (m[(1, 0)] * m[(2, 1)] - m[(1, 1)] * m[(2, 0)])
}

/// By cofactors.
fn inverse(m: &Matrix3<D>) -> Matrix3<D> {
    let det = determinant(m);
    Matrix3::from_fn(|i, j| {
        let (a, b, c, d) = ((j + 1) % 3, (j + 2) % 3, (i + 1) % 3, (i + 2) % 3);
        (m[(a, c)] * m[(b, d)] - m[(a, d)] * m[(b, c)]) / det
    })
}

/// I₁, I₂, J of C = FᵀF.
fn invariants(f: &Matrix3<D>) -> (D, D, D) {
    let c = f.transpose() * f;
    let i1 = c.trace();
    let square = (c * c).trace();
    (i1, (i1 * i1 - square) * 0.5, determinant(f))
}

/// μ = 170 kPa, λ = 400 kPa.
pub fn neo_hookean(f: &Matrix3<D>, _at: [D; 3]) -> D {
    let (i1, _, j) = invariants(f);
    let ln_j = j.ln();
    (i1 - 3.0 - ln_j * 2.0) * 85e3 + ln_j * ln_j * 200e3
}

/// C₁ = 120 kPa, C₂ = 40 kPa, with the reference pressure.
pub fn mooney_rivlin(f: &Matrix3<D>, _at: [D; 3]) -> D {
    let (i1, i2, j) = invariants(f);
    (i1 - 3.0) * 120e3 + (i2 - 3.0) * 40e3 - (j - 1.0) * 400e3
}

/// Neo-Hookean with a stiffness that varies along and over the section: times (1 + 0.5 sin 9s + 20 x).
pub fn graded_neo_hookean(f: &Matrix3<D>, at: [D; 3]) -> D {
    neo_hookean(f, at) * ((at[2] * 9.0).sin() * 0.5 + at[0] * 20.0 + 1.0)
}

/// The largest difference in force components relative to the largest, and of moments likewise.
pub fn relative_difference(one: [f64; 6], other: [f64; 6]) -> f64 {
    let part = |range: std::ops::Range<usize>| {
        let scale = range.clone().map(|i| other[i].abs()).fold(0.0, f64::max);
        range.map(|i| (one[i] - other[i]).abs()).fold(0.0, f64::max) / scale
    };
    part(0..3).max(part(3..6))
}
