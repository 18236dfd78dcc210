use super::Scalar;

/// f(x) for any dual number, from the Taylor coefficients f⁽ᵏ⁾(r)/k! at its real part r.
///
/// x − r is nilpotent, so the sum up to the order of the number is exact.
#[inline]
pub(crate) fn from_taylor<D: Scalar>(x: D, coefficient: impl Fn(usize) -> f64) -> D {
    let step = x - x.re();
    let mut sum = D::from(coefficient(D::NDERIV));
    for k in (0..D::NDERIV).rev() {
        sum = sum * step + coefficient(k);
    }
    sum
}

/// x − ln(1 + x), without cancellation in value or derivatives: the volumetric part of most rubber laws.
///
/// ```math
/// x - \ln(1+x) = x t - 2 t^3 \left(\tfrac13 + \tfrac{t^2}{5} + \tfrac{t^4}{7} + \dots\right), \qquad t = \frac{x}{2 + x}
/// ```
///
/// (the series of 2 artanh t = ln(1+x)); its derivative is x/(1+x). NaN where 1 + x is negative.
///
/// ```
/// // the naive form has no correct digit here
/// assert_eq!(hyperrod::scalar::x_minus_ln_1p(1e-12), 5e-25 * (1.0 - 2e-12 / 3.0));
/// ```
#[inline]
pub fn x_minus_ln_1p<D: Scalar>(x: D) -> D {
    let r = x.re();
    let inverse = 1.0 / (1.0 + r);
    from_taylor(x, |k| match k {
        0 => real_x_minus_ln_1p(r),
        1 => r * inverse,
        k => (-inverse).powi(k as i32) / k as f64,
    })
}

/// Eleven terms: for |x| ≤ 1/4, t² ≤ 1/49 and the first one left out is below 1e-18 of the sum.
fn real_x_minus_ln_1p(x: f64) -> f64 {
    if x.abs() > 0.25 {
        return x - x.ln_1p();
    }
    let t = x / (2.0 + x);
    let t_squared = t * t;
    let series = (0..11).rev().fold(0.0, |sum, k| sum * t_squared + 1.0 / (2 * k + 3) as f64);
    x * t - 2.0 * t * t_squared * series
}
