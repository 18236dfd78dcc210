//! The functions of x = θ² behind exp, dexp and dexp⁻¹, exact in value and derivatives from θ = 0 on.
//!
//! The textbook forms (sin θ/θ, (1 − cos θ)/θ², …) lose their *derivatives* near θ = 0 long before their values, and a switch
//! to a series tuned for values keeps the damage. Here nothing divides by x below x = 10.

use crate::scalar::Scalar;

/// Up to here (θ ≈ 3.16, just past π) [`stumpff`] sums a series.
pub(crate) const SERIES_LIMIT: f64 = 10.0;

/// Terms of the series. At x = 10 the first one left out changes the second derivatives of c₅ and c₆ (the slowest to
/// converge) by 4e-18 and 2e-18 of their value at 0; the values by far less.
const SERIES_TERMS: usize = 14;

/// (−1)^j / (2j + k)! for j = 0, 1, ….
const fn stumpff_series(k: usize) -> [f64; SERIES_TERMS] {
    let mut terms = [0.0; SERIES_TERMS];
    let mut factorial = 1.0;
    let mut n = 1;
    while n < k + 2 * SERIES_TERMS {
        factorial *= n as f64;
        if n >= k && (n - k).is_multiple_of(2) {
            let j = (n - k) / 2;
            terms[j] = if j.is_multiple_of(2) { 1.0 / factorial } else { -1.0 / factorial };
        }
        n += 1;
    }
    terms
}

/// Of c₅.
pub(crate) const C5: [f64; SERIES_TERMS] = stumpff_series(5);
/// Of c₆.
pub(crate) const C6: [f64; SERIES_TERMS] = stumpff_series(6);

/// The polynomial Σ aⱼ xʲ.
#[inline]
pub(super) fn horner<D: Scalar, const N: usize>(a: &[f64; N], x: D) -> D {
    a.iter().rev().fold(D::zero(), |sum, &a| sum * x + a)
}

/// The Stumpff functions c₀ … c₆ at x = θ².
///
/// ```math
/// c_k(x) = \sum_{j\ge0} \frac{(-x)^j}{(2j+k)!}, \qquad
/// c_0 = \cos\theta,\; c_1 = \frac{\sin\theta}{\theta},\; c_2 = \frac{1-\cos\theta}{\theta^2},\;
/// c_3 = \frac{\theta-\sin\theta}{\theta^3},\; \ldots,\qquad
/// c_k = \frac1{k!} - x\,c_{k+2}, \qquad c_k' = \tfrac12\,(k\,c_{k+2} - c_{k+1})
/// ```
///
/// Against 50 digits, values, first and second derivatives up to θ = π are off by at most 2 ε = 4·10⁻¹⁶ of their value at
/// x = 0, which is their largest. Past π, values keep that; second derivatives of c₃ and c₄ are off by 6 ε, of c₅ and
/// c₆ by 200 ε. NaN gives NaN. Source: Stiefel & Scheifele (1971), *Linear and Regular Celestial Mechanics*, §11.
///
/// ```
/// let c = hyperrod::lie::stumpff(0.25_f64); // θ = 1/2
/// assert!((c[1] - 0.5_f64.sin() / 0.5).abs() < 1e-15);
/// ```
#[inline]
pub fn stumpff<D: Scalar>(x: D) -> [D; 7] {
    if x.re() > SERIES_LIMIT {
        return stumpff_closed(x);
    }
    let (c5, c6) = (horner(&C5, x), horner(&C6, x));
    // Downward, from the functions that vary least: each 1/k! is at most 2.5 times x c_{k+2} away from cancelling up to
    // x = 10, except where c₀ and c₁ cross zero themselves. Upward, c_{k+2} = (1/k! − c_k)/x would divide rounding by x.
    let c4 = -x * c6 + 1.0 / 24.0;
    let c3 = -x * c5 + 1.0 / 6.0;
    let c2 = -x * c4 + 0.5;
    let c1 = -x * c3 + 1.0;
    let c0 = -x * c2 + 1.0;
    [c0, c1, c2, c3, c4, c5, c6]
}

/// [`stumpff`] past the series, where dividing by x > 10 is harmless.
fn stumpff_closed<D: Scalar>(x: D) -> [D; 7] {
    let theta = x.sqrt();
    // Half angles keep c₂ to relative accuracy at θ = 2π, where it vanishes and dexp⁻¹ divides by it.
    let (sin, cos) = (theta * 0.5).sin_cos();
    let c0 = -sin * sin * 2.0 + 1.0;
    let c1 = sin * cos * 2.0 / theta;
    let c2 = sin * sin * 2.0 / x;
    let c3 = (-c1 + 1.0) / x;
    let c4 = (-c2 + 0.5) / x;
    let c5 = (-c3 + 1.0 / 6.0) / x;
    let c6 = (-c4 + 1.0 / 24.0) / x;
    [c0, c1, c2, c3, c4, c5, c6]
}

/// The coefficients of dexp and their derivatives in x: `[[a, b, c], [a′, b′, c′]]` with
///
/// ```math
/// \mathrm{dexp}_\omega = a I + b\,\hat\omega + c\,\omega\omega^T, \qquad
/// (a, b, c) = (c_1, c_2, c_3), \qquad
/// (a', b', c') = \bigl(\tfrac12(c_3 - c_2),\; c_4 - \tfrac12 c_3,\; \tfrac12(3 c_5 - c_4)\bigr).
/// ```
#[inline]
pub fn dexp_coefficients<D: Scalar>(x: D) -> [[D; 3]; 2] {
    let [_, c1, c2, c3, c4, c5, _] = stumpff(x);
    [[c1, c2, c3], [(c3 - c2) * 0.5, c4 - c3 * 0.5, (c5 * 3.0 - c4) * 0.5]]
}

/// The coefficients of dexp⁻¹ and their derivatives in x: `[[a, b, c], [a′, b′, c′]]` with
///
/// ```math
/// \mathrm{dexp}_\omega^{-1} = a I + b\,\hat\omega + c\,\omega\omega^T, \qquad
/// a = \tfrac\theta2\cot\tfrac\theta2 = 1 - x c, \quad b = -\tfrac12, \quad
/// c = \frac{1-a}{x} = \frac{c_3 - 2 c_4}{2 c_2},
/// ```
///
/// ```math
/// c' = \tfrac12 c^2 - \tfrac32\,\frac{c - 1/12}{x}, \qquad
/// \frac{c - 1/12}{x} = \frac{2 c_6 + c_4/6 - c_5}{2 c_2}, \qquad a' = -c - x c'.
/// ```
///
/// Put in terms of Stumpff functions neither quotient needs a division by x. Up to θ = π values are off by at most 2 ε (c′ by
/// 12 ε), derivatives by 12 ε in the first and 50 ε in the second. Singular at θ = 2π, where c₂ = 0.
#[inline]
pub fn dexp_inv_coefficients<D: Scalar>(x: D) -> [[D; 3]; 2] {
    let [_, _, c2, c3, c4, c5, c6] = stumpff(x);
    let half_over_c2 = c2.recip() * 0.5;
    let c = (c3 - c4 * 2.0) * half_over_c2;
    let d_c = c * c * 0.5 - (c6 * 2.0 + c4 / 6.0 - c5) * half_over_c2 * 1.5;
    let a = -x * c + 1.0;
    let d_a = -c - x * d_c;
    [[a, D::from(-0.5), c], [d_a, D::zero(), d_c]]
}
