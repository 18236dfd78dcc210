//! Logarithm, exponential and power over lanes, without branches.
//!
//! Coefficients are those of the Taylor series, with enough terms for the last bit on the reduced range; a minimax fit would save
//! two or three terms and has to be taken on trust.

use super::Lane;

/// ln 2 with 32 bits, so that k ln 2 is exact for the exponents there are, and the rest of it.
const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// 2⁵⁴: brings a subnormal number into the normal range.
const TWO_54: f64 = 18_014_398_509_481_984.0;

/// 2/3, 2/5, …: ln((1+s)/(1−s)) = 2s + s³(2/3 + 2/5 s² + …). For |s| ≤ 0.1716 (a number in [√½, √2]), s² ≤ 0.0295, and the term after
/// ten, 0.0295¹¹ × 2/23, is below 2⁻⁵⁷ of the sum.
const ARTANH: [f64; 10] = [
    2.0 / 3.0,
    2.0 / 5.0,
    2.0 / 7.0,
    2.0 / 9.0,
    2.0 / 11.0,
    2.0 / 13.0,
    2.0 / 15.0,
    2.0 / 17.0,
    2.0 / 19.0,
    2.0 / 21.0,
];

/// f − ln(1 + f) = f²/2 − s (f²/2 + R), s = f/(2+f), R = s²(2/3 + 2/5 s² + …): no cancellation, as |s| < 0.18.
#[inline(always)]
fn small_remainder<L: Lane>(f: L) -> L {
    let s = f / (L::splat(2.0) + f);
    let z = s * s;
    let r = z * z.polynomial(&ARTANH);
    let half_square = L::splat(0.5) * f * f;
    half_square - s * (half_square + r)
}

/// Reduces 1 + x = 2ᵏ (1 + f) (1 + c): f, k and the rounding c of the sum. x itself is f where k = 0.
#[inline(always)]
fn reduce<L: Lane>(x: L) -> (L, L, L) {
    let one = L::splat(1.0);
    let u = one + x;
    let (m, k) = u.split_exponent();
    // what 1 + x lost: x − (u − 1) where |x| < 1, 1 − (u − x) elsewhere
    let lost = x.abs().select_lt(one, x - (u - one), one - (u - x));
    let small = k.abs().select_lt(L::splat(0.5), x, m - one);
    let correction = k.abs().select_lt(L::splat(0.5), L::splat(0.0), lost / u);
    (small, k, correction)
}

/// ln of a sum 1 + x beyond the normal range: −∞ at −1, NaN below, ∞ at ∞.
#[inline(always)]
fn outside<L: Lane>(x: L, inside: L) -> L {
    let minus_one = L::splat(-1.0);
    let beyond = x.select_lt(minus_one, L::splat(f64::NAN), L::splat(f64::NEG_INFINITY));
    let result = minus_one.select_lt(x, inside, beyond);
    // NaN and +∞ pass on
    x.select_lt(L::splat(f64::INFINITY), result, x)
}

#[inline(always)]
pub(super) fn ln_1p<L: Lane>(x: L) -> L {
    let (f, k, c) = reduce(x);
    let remainder = small_remainder(f);
    let inside = k * L::splat(LN_2_HIGH) + (f - (remainder - (k.mul_add(L::splat(LN_2_LOW), c))));
    outside(x, inside)
}

#[inline(always)]
pub(super) fn x_minus_ln_1p<L: Lane>(x: L) -> L {
    let (f, k, c) = reduce(x);
    let remainder = small_remainder(f);
    let logarithm = k * L::splat(LN_2_HIGH) + (f - (remainder - (k.mul_add(L::splat(LN_2_LOW), c))));
    let inside = k.abs().select_lt(L::splat(0.5), remainder, x - logarithm);
    let minus_one = L::splat(-1.0);
    let beyond = x.select_lt(minus_one, L::splat(f64::NAN), L::splat(f64::INFINITY));
    let result = minus_one.select_lt(x, inside, beyond);
    x.select_lt(L::splat(f64::INFINITY), result, x)
}

#[inline(always)]
pub(super) fn ln<L: Lane>(x: L) -> L {
    // subnormal numbers are brought into the normal range first
    let tiny = L::splat(f64::MIN_POSITIVE);
    let normal = x.select_lt(tiny, x * L::splat(TWO_54), x);
    let (m, k) = normal.split_exponent();
    let k = x.select_lt(tiny, k - L::splat(54.0), k);
    let f = m - L::splat(1.0);
    let inside = k * L::splat(LN_2_HIGH) + (f - (small_remainder(f) - k * L::splat(LN_2_LOW)));
    let zero = L::splat(0.0);
    let beyond = x.select_lt(zero, L::splat(f64::NAN), L::splat(f64::NEG_INFINITY));
    let result = zero.select_lt(x, inside, beyond);
    x.select_lt(L::splat(f64::INFINITY), result, x)
}

/// 1/2!, 1/3!, …: (e^r − 1 − r)/r² for |r| ≤ ln 2 / 2; the first term left out, r¹³/15!, is below 2⁻⁵⁹.
const EXPONENTIAL: [f64; 13] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
    1.0 / 87_178_291_200.0,
];

/// x = k ln 2 + r with |r| ≤ ln 2 / 2; gives (e^r − 1, k).
#[inline(always)]
fn reduced_exp_m1<L: Lane>(x: L) -> (L, L) {
    let k = (x * L::splat(std::f64::consts::LOG2_E)).round();
    let r = k.mul_add(L::splat(-LN_2_LOW), k.mul_add(L::splat(-LN_2_HIGH), x));
    (r + r * r * r.polynomial(&EXPONENTIAL), k)
}

/// `inside`, but 0 (or −1) below −708, ∞ above 709, NaN for NaN.
#[inline(always)]
fn saturate<L: Lane>(x: L, inside: L, floor: f64) -> L {
    let bounded = x.select_lt(L::splat(709.0), inside, L::splat(f64::INFINITY));
    let bounded = x.select_lt(L::splat(-708.0), L::splat(floor), bounded);
    // NaN and +∞ pass on
    x.select_lt(L::splat(f64::INFINITY), bounded, x)
}

#[inline(always)]
pub(super) fn exp<L: Lane>(x: L) -> L {
    let (e, k) = reduced_exp_m1(x.select_lt(L::splat(709.0), x, L::splat(709.0)));
    saturate(x, (L::splat(1.0) + e).scale_by_power_of_two(clamp_exponent(k)), 0.0)
}

#[inline(always)]
pub(super) fn exp_m1<L: Lane>(x: L) -> L {
    let (e, k) = reduced_exp_m1(x.select_lt(L::splat(709.0), x, L::splat(709.0)));
    let one = L::splat(1.0);
    let power = one.scale_by_power_of_two(clamp_exponent(k));
    // 2ᵏ(1 + e) − 1 = 2ᵏ e + (2ᵏ − 1)
    saturate(x, power.mul_add(e, power - one), -1.0)
}

/// The exponents that x in [−708, 709] leads to, for lanes whose result is thrown away as well.
#[inline(always)]
fn clamp_exponent<L: Lane>(k: L) -> L {
    let low = k.select_lt(L::splat(-1022.0), L::splat(-1022.0), k);
    low.select_lt(L::splat(1023.0), low, L::splat(1023.0))
}

/// a + b = s + e exactly, for |a| ≥ |b| or a = 0. Source: Dekker (1971), Numer. Math. 18, 224.
#[inline(always)]
fn two_sum<L: Lane>(a: L, b: L) -> (L, L) {
    let s = a + b;
    let b_seen = s - a;
    (s, (a - (s - b_seen)) + (b - b_seen))
}

/// v = high + low with half the digits each.
#[inline(always)]
fn split<L: Lane>(v: L) -> (L, L) {
    let c = v * L::splat(134_217_729.0); // 2²⁷ + 1
    let high = c - (c - v);
    (high, v - high)
}

/// a b = p + e exactly, without a fused multiplication. Source: Dekker (1971), with Veltkamp's splitting.
#[inline(always)]
fn two_product<L: Lane>(a: L, b: L) -> (L, L) {
    let p = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    (p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

/// xᵖ = exp(p ln x), with ln x and the product carried to about 70 bits: else an error of |p ln x| ulp. Of a negative x its size, with
/// the sign that an integral p gives.
#[inline(always)]
pub(super) fn powf<L: Lane>(x: L, p: f64) -> L {
    let zero = L::splat(0.0);
    let tiny = L::splat(f64::MIN_POSITIVE);
    let size = x.abs();
    let normal = size.select_lt(tiny, size * L::splat(TWO_54), size);
    let (m, k) = normal.split_exponent();
    let k = size.select_lt(tiny, k - L::splat(54.0), k);
    let f = m - L::splat(1.0);
    let (high, rest) = two_sum(k * L::splat(LN_2_HIGH), f);
    let low = rest + (k * L::splat(LN_2_LOW) - small_remainder(f));
    let (high, low) = two_sum(high, low);
    let power = L::splat(p);
    let (product, error) = two_product(high, power);
    let correction = error + low * power;
    let exponential = product.exp();
    // beyond, 0 or ∞ already, and a correction that may be NaN
    let positive =
        product.abs().select_lt(L::splat(709.0), exponential + exponential * correction, exponential);
    let sign = match (p.trunc() == p, p % 2.0 == 0.0) {
        (true, true) => 1.0,
        (true, false) => -1.0,
        (false, _) => f64::NAN,
    };
    // ∞ and NaN pass on, unless p is 0
    let (at_zero, beyond) = if p > 0.0 {
        (0.0, size)
    } else if p == 0.0 {
        (1.0, L::splat(1.0))
    } else {
        (f64::INFINITY, L::splat(1.0) / size)
    };
    let inside = zero.select_lt(size, positive, L::splat(at_zero));
    let result = size.select_lt(L::splat(f64::INFINITY), inside, beyond);
    x.select_lt(zero, result * L::splat(sign), result)
}
