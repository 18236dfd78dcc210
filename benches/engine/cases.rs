//! What the engine's speed is measured on, and what it is measured against: derivatives taken by hand, and num-dual's `hessian()`.

use hyperrod::lie::Wrench;
use hyperrod::material::{Invariants, Isotropic, Local, Point, Points, Response, Sectional};
use hyperrod::scalar::{Kernel, Lane, dispatch};
use hyperrod::{Scalar, Strain};
use nalgebra::{Matrix6, SVector};
use num_dual::{Dual2SVec64, DualNum, hessian};

/// C10, C01, C20, C11 and D1 (the multiplier of (J − 1)²), Pa.
pub const POLY: [f64; 5] = [1e5, 3e4, 2e4, -5e3, 5e5];

/// μ and λ, Pa.
pub const LAME: [f64; 2] = [1.7e5, 4e5];

/// A 5-term polynomial at the isotropic level.
#[derive(Clone, Copy)]
pub struct PolyIsotropic;

impl Isotropic for PolyIsotropic {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        poly5(i.i1(), i.i2(), i.j())
    }
    fn degree(&self) -> Option<usize> {
        Some(4)
    }
}

/// The same at the local level, from γ.
#[derive(Clone, Copy)]
pub struct PolyLocal;

impl Local for PolyLocal {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &hyperrod::material::Deformation<D>, _at: &Point<D>) -> D {
        let g = f.gamma();
        poly5_of_gamma(g.x, g.y, g.z)
    }
    fn degree(&self) -> Option<usize> {
        Some(4)
    }
}

/// The same at the section level, from Δξ and the point.
#[derive(Clone, Copy)]
pub struct PolySectional;

impl Sectional for PolySectional {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, xi: &Strain<D>, at: &Point<D>) -> D {
        let (w, n) = (xi.angular, xi.linear);
        poly5_of_gamma(n.x - w.z * at.y, n.y + w.z * at.x, n.z + w.x * at.y - w.y * at.x)
    }
    fn degree(&self) -> Option<usize> {
        Some(4)
    }
}

/// I₁ − 3 taken out of the terms that have it, as in the code derived by hand and in that for num-dual.
#[inline(always)]
fn poly5<D: Scalar>(i: D, j: D, e: D) -> D {
    let [c10, c01, c20, c11, d1] = POLY;
    i * (i * c20 + j * c11 + c10) + j * c01 + e * e * d1
}

#[inline(always)]
fn poly5_of_gamma<D: Scalar>(a: D, b: D, e: D) -> D {
    let (s, q) = (a * a + b * b, e * (e + 2.0));
    poly5(s + q, s + q * 2.0, e)
}

/// Three rings of eight points in a disk: the 24-point rule of the comparison.
pub fn rings(radius: f64) -> Points {
    let line = [(0.112_701_665_379_258_3, 5.0), (0.5, 8.0), (0.887_298_334_620_741_7, 5.0)];
    let mut points = Points::default();
    for (t, w) in line {
        for k in 0..8 {
            let angle = std::f64::consts::TAU * (f64::from(k) + 0.37) / 8.0;
            points.x.push(radius * f64::sqrt(t) * angle.cos());
            points.y.push(radius * f64::sqrt(t) * angle.sin());
            points.weight.push(std::f64::consts::PI * radius * radius * w / 18.0 / 8.0);
        }
    }
    points
}

/// Reproducible random strains of a centimetre-thick rod, up to some 30 % in the outer fibres.
pub fn strains(count: usize) -> Vec<Strain> {
    let mut seed = 1_u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let size = [20.0, 20.0, 20.0, 0.1, 0.1, 0.1];
    (0..count).map(|_| Strain::from_array(size.map(|s| s * random()))).collect()
}

/// Value, gradient in (s, e) and second derivatives (ss, se, ee) of a law, by hand.
pub trait ByHand: Copy {
    fn derivatives<L: Lane>(&self, s: L, e: L) -> (L, [L; 2], [L; 3]);
}

#[derive(Clone, Copy)]
pub struct PolyByHand;

impl ByHand for PolyByHand {
    #[inline(always)]
    fn derivatives<L: Lane>(&self, s: L, e: L) -> (L, [L; 2], [L; 3]) {
        let number = L::splat;
        let [c10, c01, c20, c11, d1] = POLY;
        let t = number(2.0) + e + e;
        let q = e * (number(2.0) + e);
        let (i, j) = (s + q, s + q + q);
        let linear = number(c20).mul_add(i, number(c11).mul_add(j, number(c10)));
        let u_i = number(c20).mul_add(i, linear);
        let u_j = number(c11).mul_add(i, number(c01));
        let u = linear.mul_add(i, number(c01).mul_add(j, number(d1) * e * e));
        let both = u_i + u_j + u_j;
        let u_e = both.mul_add(t, number(2.0 * d1) * e);
        let u_ee = (t * t).mul_add(number(2.0 * c20 + 4.0 * c11), both + both + number(2.0 * d1));
        (u, [u_i + u_j, u_e], [number(2.0 * c20 + 2.0 * c11), t * number(2.0 * c20 + 3.0 * c11), u_ee])
    }
}

#[derive(Clone, Copy)]
pub struct NeoHookeanByHand;

impl ByHand for NeoHookeanByHand {
    #[inline(always)]
    fn derivatives<L: Lane>(&self, s: L, e: L) -> (L, [L; 2], [L; 3]) {
        let number = L::splat;
        let [mu, lambda] = LAME;
        let (one, zero) = (number(1.0), number(0.0));
        let inverse = one / (one + e);
        let ln = e.ln_1p();
        let quadratic = s + e * e + number(2.0) * (e - ln);
        let u = number(0.5 * mu).mul_add(quadratic, number(0.5 * lambda) * ln * ln);
        let u_e = number(mu).mul_add(e + e * inverse, number(lambda) * ln * inverse);
        let square = inverse * inverse;
        let u_ee = number(mu).mul_add(one + square, number(lambda) * (one - ln) * square);
        (u, [number(0.5 * mu), u_e], [zero, zero, u_ee])
    }
}

/// (U, Ψ, ∂Ψ/∂Δξ) with every derivative taken by hand, over any number of points at a time.
#[inline(always)]
pub fn by_hand<L: Lane>(law: impl ByHand, points: &Points, strain: &Strain) -> Response {
    let [o_x, o_y, o_z, n_x, n_y, n_z] = strain.to_array();
    let (o_x, o_y, o_z) = (L::splat(o_x), L::splat(o_y), L::splat(o_z));
    let (n_x, n_y, n_z) = (L::splat(n_x), L::splat(n_y), L::splat(n_z));
    let mut energy = L::splat(0.0);
    let mut psi = [energy; 6];
    let mut k = [energy; 21];
    let mut q = 0;
    while q < points.len() {
        let (x, y, w) = (L::load(&points.x[q..]), L::load(&points.y[q..]), L::load(&points.weight[q..]));
        let (a, b) = (n_x - o_z * y, o_z.mul_add(x, n_y));
        let e = o_x.mul_add(y, n_z - o_y * x);
        let (u, [u_s, u_e], [u_ss, u_se, u_ee]) = law.derivatives(a.mul_add(a, b * b), e);
        energy = w.mul_add(u, energy);
        let (two_a, two_b, w_s) = (a + a, b + b, w * (u_s + u_s));
        let (g_a, g_b, g_e) = (w_s * a, w_s * b, w * u_e);
        psi[0] = y.mul_add(g_e, psi[0]);
        psi[1] = psi[1] - x * g_e;
        psi[2] = x.mul_add(g_b, psi[2]) - y * g_a;
        psi[3] = psi[3] + g_a;
        psi[4] = psi[4] + g_b;
        psi[5] = psi[5] + g_e;
        let (w_ss, w_se) = (w * u_ss, w * u_se);
        let (aa, ab) = (two_a.mul_add(two_a * w_ss, w_s), two_a * two_b * w_ss);
        let (bb, ae) = (two_b.mul_add(two_b * w_ss, w_s), two_a * w_se);
        let (be, ee) = (two_b * w_se, w * u_ee);
        let (za, zb, ze) = (x * ab - y * aa, x * bb - y * ab, x * be - y * ae);
        let (y_ee, x_ee) = (y * ee, x * ee);
        k[0] = y.mul_add(y_ee, k[0]);
        k[1] = k[1] - x * y_ee;
        k[2] = y.mul_add(ze, k[2]);
        k[3] = y.mul_add(ae, k[3]);
        k[4] = y.mul_add(be, k[4]);
        k[5] = k[5] + y_ee;
        k[6] = x.mul_add(x_ee, k[6]);
        k[7] = k[7] - x * ze;
        k[8] = k[8] - x * ae;
        k[9] = k[9] - x * be;
        k[10] = k[10] - x_ee;
        k[11] = x.mul_add(zb, k[11]) - y * za;
        k[12] = k[12] + za;
        k[13] = k[13] + zb;
        k[14] = k[14] + ze;
        k[15] = k[15] + aa;
        k[16] = k[16] + ab;
        k[17] = k[17] + ae;
        k[18] = k[18] + bb;
        k[19] = k[19] + be;
        k[20] = k[20] + ee;
        q += L::LANES;
    }
    let mut out = Response::zero();
    out.energy = energy.sum();
    let [m_x, m_y, m_z, f_x, f_y, f_z] = psi;
    out.wrench = Wrench::from_array([m_x.sum(), m_y.sum(), m_z.sum(), f_x.sum(), f_y.sum(), f_z.sum()]);
    let mut entry = 0;
    for i in 0..6 {
        for j in i..6 {
            out.tangent[(i, j)] = k[entry].sum();
            out.tangent[(j, i)] = out.tangent[(i, j)];
            entry += 1;
        }
    }
    out
}

/// One point at a time, as a careful programmer writes it first.
pub fn hand_scalar(law: impl ByHand, points: &Points, strain: &Strain) -> Response {
    by_hand::<f64>(law, points, strain)
}

/// The same on the widest vectors of the machine.
pub fn hand_vector(law: impl ByHand, points: &Points, strain: &Strain) -> Response {
    struct Vectorised<'a, H>(H, &'a Points, &'a Strain);
    impl<H: ByHand> Kernel for Vectorised<'_, H> {
        type Output = Response;
        #[inline(always)]
        fn run<L: Lane>(self) -> Response {
            by_hand::<L>(self.0, self.1, self.2)
        }
    }
    dispatch(Vectorised(law, points, strain))
}

/// u(γ) as a user of num-dual writes it where speed matters: few products of dual numbers, and operators on references, since a copy of such a
/// number costs as much as an operation.
pub trait Direct {
    fn energy_density(a: &Six, b: &Six, e: &Six) -> Six;
}

/// The dual number of `hessian()` in the six strains.
pub type Six = Dual2SVec64<6>;

#[allow(clippy::op_ref)] // see `Direct`
impl Direct for PolyByHand {
    #[inline(always)]
    fn energy_density(a: &Six, b: &Six, e: &Six) -> Six {
        let [c10, c01, c20, c11, d1] = POLY;
        let (s, e_squared) = (a * a + b * b, e * e);
        let q = &e_squared + *e * 2.0;
        let (i, j) = (&s + &q, s + q * 2.0);
        &i * &(i * c20 + j * c11 + c10) + j * c01 + e_squared * d1
    }
}

#[allow(clippy::op_ref)] // see `Direct`
impl Direct for NeoHookeanByHand {
    #[inline(always)]
    fn energy_density(a: &Six, b: &Six, e: &Six) -> Six {
        let [mu, lambda] = LAME;
        let ln = e.ln_1p();
        (a * a + b * b + e * e + (e - &ln) * 2.0) * (0.5 * mu) + &ln * &ln * (0.5 * lambda)
    }
}

/// u at a point in the six strains; points are plain numbers.
#[inline(always)]
#[allow(clippy::op_ref)] // see `Direct`
fn at_point<H: Direct>(v: &SVector<Six, 6>, x: f64, y: f64) -> Six {
    let a = &v[3] - v[2] * y;
    let b = &v[4] + v[2] * x;
    let e = &v[5] + v[0] * y - v[1] * x;
    H::energy_density(&a, &b, &e)
}

/// num-dual's `hessian()` in the six strains at each point, summed in plain numbers.
pub fn num_dual_by_points<H: Direct>(_law: H, points: &Points, strain: &Strain) -> Response {
    let xi = strain.to_vector();
    let (mut energy, mut gradient, mut tangent) = (0.0, SVector::<f64, 6>::zeros(), Matrix6::zeros());
    for ((&x, &y), &w) in points.x.iter().zip(&points.y).zip(&points.weight) {
        let (u, first, second) = hessian(|v: SVector<Six, 6>| at_point::<H>(&v, x, y), &xi);
        energy += u * w;
        gradient += first * w;
        tangent += second * w;
    }
    let wrench = Wrench::from_vector(&gradient);
    Response { energy, wrench, tangent, wrench_rate: Wrench::zero() }
}

/// num-dual's `hessian()` of the sum over the points.
pub fn num_dual_of_sum<H: Direct>(_law: H, points: &Points, strain: &Strain) -> Response {
    let integral = |v: SVector<Six, 6>| {
        let mut sum = Six::from_re(0.0);
        for ((&x, &y), &w) in points.x.iter().zip(&points.y).zip(&points.weight) {
            sum += at_point::<H>(&v, x, y) * w;
        }
        sum
    };
    let (energy, gradient, tangent) = hessian(integral, &strain.to_vector());
    let wrench = Wrench::from_vector(&gradient);
    Response { energy, wrench, tangent, wrench_rate: Wrench::zero() }
}

/// Largest difference of two responses: energies relative to the work Σ |Ψ_i Δξ_i| (they may cancel), forces and moments to the largest force (times the radius),
/// blocks of the tangent to its largest axial entry (times the radius, and squared).
pub fn difference(a: &Response, b: &Response, strain: &Strain, radius: f64) -> f64 {
    let unit = |i: usize| if i < 3 { radius } else { 1.0 };
    let force = a.wrench.force.amax();
    let stiffness = a.tangent.fixed_view::<3, 3>(3, 3).amax();
    let work = a.wrench.to_array().iter().zip(strain.to_array()).map(|(p, x)| (p * x).abs()).sum::<f64>();
    let mut worst = (a.energy - b.energy).abs() / work;
    for (i, (p, q)) in a.wrench.to_array().into_iter().zip(b.wrench.to_array()).enumerate() {
        worst = worst.max((p - q).abs() / (force * unit(i)));
        for j in 0..6 {
            let k = (a.tangent[(i, j)] - b.tangent[(i, j)]).abs();
            worst = worst.max(k / (stiffness * unit(i) * unit(j)));
        }
    }
    worst
}
