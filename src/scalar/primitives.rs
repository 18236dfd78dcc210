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
/// let exact = 5e-25 * (1.0 - 2e-12 / 3.0);
/// assert!((hyperrod::scalar::x_minus_ln_1p(1e-12) - exact).abs() < 1e-15 * exact);
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

/// eˣ − 1 − x, without cancellation in value or derivatives: what a power of a stretch leaves beyond its linear term.
///
/// ```math
/// e^x - 1 - x = \frac{x^2}{2}\Bigl(1 + \frac{x}{3}\Bigl(1 + \frac{x}{4}(1 + \dots)\Bigr)\Bigr), \qquad \frac{d}{dx} = e^x - 1
/// ```
///
/// ```
/// assert_eq!(hyperrod::scalar::exp_m1_minus_x(1e-9), 5e-19 * (1.0 + 1e-9 / 3.0));
/// ```
#[inline]
pub fn exp_m1_minus_x<D: Scalar>(x: D) -> D {
    let r = x.re();
    from_taylor(x, |k| match k {
        0 => real_exp_m1_minus_x(r),
        1 => r.exp_m1(),
        k => r.exp() / (2..=k).product::<usize>() as f64,
    })
}

/// Sixteen terms: for |x| ≤ 1 the first one left out is below 2/18! = 3e-16 of the leading one.
fn real_exp_m1_minus_x(x: f64) -> f64 {
    if x.abs() > 1.0 {
        return x.exp_m1() - x;
    }
    x * x * (3..19).rev().fold(1.0, |sum, k| 1.0 + sum * x / k as f64) * 0.5
}

/// (1 + x)ᵖ − 1, without cancellation: what a power of J leaves of its deviation from one.
///
/// ```
/// use hyperrod::scalar::pow_1p_m1;
///
/// assert!((pow_1p_m1(1e-20, 1.0 / 3.0) * 3e20 - 1.0_f64).abs() < 1e-15);
/// assert!(((1.0_f64 + 1e-20).cbrt() - 1.0) == 0.0); // the naive form has lost everything
/// ```
#[inline]
pub fn pow_1p_m1<D: Scalar>(x: D, p: f64) -> D {
    (x.ln_1p() * p).exp_m1()
}

/// xᵖ of a quantity that cannot be negative, such as I₁ − 3 − 2(J − 1), with its derivatives right where it vanishes.
///
/// num-dual's `powf` divides by powers of x and gives NaN at x = 0, the state of rest, even in the value. A quantity that is
/// smooth and never negative touches zero with a vanishing slope, x = O(a²), so that xᵖ = O(|a|²ᵖ): for p that is not an
/// integer its derivatives of order n < 2p exist and are zero. That limit is taken. Where a derivative is asked for that does not
/// exist, as the first one of |a| = (a²)^½, the result is NaN, which a section reports as an error.
///
/// ```
/// use hyperrod::scalar::pow;
/// use num_dual::{Dual2_64, DualNum};
///
/// let a = Dual2_64::from_re(0.0).derivative();
/// let right = pow(a * a, 1.5); // |a|³
/// assert_eq!((right.re, right.v1, right.v2), (0.0, 0.0, 0.0));
/// assert!((a * a).powf(1.5).re.is_nan());
/// ```
#[inline]
pub fn pow<D: Scalar>(x: D, p: f64) -> D {
    let r = x.re();
    from_taylor(x, |k| {
        let binomial = (0..k).fold(1.0, |product, j| product * (p - j as f64) / (j + 1) as f64);
        if k == 0 || r != 0.0 {
            return if binomial == 0.0 { 0.0 } else { binomial * r.powf(p - k as f64) };
        }
        match p - k as f64 {
            0.0 => binomial,
            positive if positive > 0.0 => 0.0,
            _ if binomial == 0.0 || (D::NDERIV as f64) < 2.0 * p => 0.0,
            _ => f64::NAN,
        }
    })
}

/// cosh(α arsinh √z) − 1, analytic in z ≥ 0 also at z = 0: sums of powers of two stretches that may coalesce.
///
/// With two stretches λ± = √J e^{±θ} and z = sinh²θ = (λ₊ − λ₋)²/4J,
///
/// ```math
/// \lambda_+^\alpha + \lambda_-^\alpha = 2 J^{\alpha/2} \cosh\alpha\theta .
/// ```
///
/// θ has a kink where the stretches coalesce, cosh αθ has none: w = cosh(α arsinh √z) is the hypergeometric function
/// ₂F₁(α/2, −α/2; ½; −z), and its derivatives follow from z(1+z)w⁽ᵏ⁺²⁾ + (k+½)(1+2z)w⁽ᵏ⁺¹⁾ + (k²−α²/4)w⁽ᵏ⁾ = 0.
///
/// ```
/// use hyperrod::scalar::cosh_multiple_m1;
/// assert_eq!(cosh_multiple_m1(0.03, 2.0), 2.0 * 0.03); // cosh 2θ − 1 = 2 sinh²θ
/// ```
pub fn cosh_multiple_m1<D: Scalar>(z: D, alpha: f64) -> D {
    let quarter = 0.25 * alpha * alpha;
    from_analytic_angle(z, 2.0 * quarter, quarter, |theta, k| match k {
        0 => 2.0 * (0.5 * alpha * theta).sinh().powi(2),
        1 => alpha * (alpha * theta).sinh() / (2.0 * theta).sinh(),
        _ => quarter * (alpha * theta).cosh(),
    })
}

/// (arsinh √z)², analytic in z ≥ 0 also at z = 0: the squared half-difference of two logarithmic stretches.
///
/// With λ± = √J e^{±θ} and z = (λ₊ − λ₋)²/4J it is θ², and (ln λ₊)² + (ln λ₋)² = (ln J)²/2 + 2θ².
///
/// ```
/// use hyperrod::scalar::arsinh_sqrt_squared;
/// assert_eq!(arsinh_sqrt_squared(1e-20), 1e-20); // 1e-20 − 1e-40/3 + …
/// ```
pub fn arsinh_sqrt_squared<D: Scalar>(z: D) -> D {
    from_analytic_angle(z, 1.0, 0.0, |theta, k| match k {
        0 => theta * theta,
        1 => 2.0 * theta / (2.0 * theta).sinh(),
        _ => 0.5,
    })
}

/// Where the power series in z is used, so that dividing by z(1+z) costs no more than a factor 16 of rounding in w″; that
/// is multiplied by (∂z)² = O(z) in the end.
const SERIES_LIMIT: f64 = 1.0 / 16.0;

/// Seventeen terms: the ratio of consecutive ones tends to z ≤ 1/16, so for α up to 8 the rest is below 1e-17.
const SERIES_TERMS: usize = 17;

/// A solution of z(1+z)w″ + (½+z)w′ = q w + const that is analytic at z = 0, w = c₁ z + c₂ z² + …, with
/// c_{n+1}/c_n = (q − n²)/((n+½)(n+1)).
///
/// `closed(θ, k)` gives w for k = 0, w′ for k = 1, and the right-hand side for k = 2.
fn from_analytic_angle<D: Scalar>(z: D, first: f64, q: f64, closed: impl Fn(f64, usize) -> f64) -> D {
    let r = z.re();
    let mut derivatives = [0.0; 4];
    if r.abs() <= SERIES_LIMIT {
        let mut coefficients = [0.0; SERIES_TERMS + 1];
        let mut c = first;
        for (n, coefficient) in coefficients.iter_mut().enumerate().skip(1) {
            *coefficient = c;
            let n = n as f64;
            c *= (q - n * n) / ((n + 0.5) * (n + 1.0));
        }
        for (k, derivative) in derivatives.iter_mut().enumerate() {
            *derivative = (k..=SERIES_TERMS).rev().fold(0.0, |sum, n| {
                let falling = (0..k).fold(1.0, |product, j| product * (n - j) as f64);
                sum * r + coefficients[n] * falling
            });
        }
    } else {
        let theta = r.sqrt().asinh();
        let (product, slope) = (r * (1.0 + r), 1.0 + 2.0 * r);
        derivatives[0] = closed(theta, 0);
        derivatives[1] = closed(theta, 1);
        derivatives[2] = (closed(theta, 2) - 0.5 * slope * derivatives[1]) / product;
        derivatives[3] = -(1.5 * slope * derivatives[2] + (1.0 - q) * derivatives[1]) / product;
    }
    from_taylor(z, |k| match k {
        3 => derivatives[3] / 6.0,
        2 => derivatives[2] / 2.0,
        k => derivatives.get(k).copied().unwrap_or(f64::NAN),
    })
}
