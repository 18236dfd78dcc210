use super::Scalar;
use super::lane::Lane;

/// A function of one real number, given by its Taylor coefficients over any number of [`Lane`]s.
///
/// [`Scalar::apply`] makes a function of dual numbers of it. Coefficients that are computed without cancellation give derivatives
/// without cancellation, where differentiating the formula of the value would not.
pub trait Univariate {
    /// f⁽ᵏ⁾(x)/k!.
    fn taylor<L: Lane>(&self, x: L, k: usize) -> L;
}

/// f(x) for any dual number: x − re(x) is nilpotent, so the Taylor sum up to the order of the number is exact.
#[inline]
pub(super) fn from_taylor<D: Scalar>(x: D, f: &impl Univariate) -> D {
    let real = x.re();
    let step = x - real;
    let mut sum = D::from(f.taylor(real, D::NDERIV));
    for k in (0..D::NDERIV).rev() {
        sum = sum * step + f.taylor(real, k);
    }
    sum
}

/// (−1)ᵏ⁺¹ … of x − ln(1 + x): x/(1+x), then (−1/(1+x))ᵏ/k.
struct XMinusLn1p;

impl Univariate for XMinusLn1p {
    #[inline(always)]
    fn taylor<L: Lane>(&self, x: L, k: usize) -> L {
        let inverse = L::splat(1.0) / (L::splat(1.0) + x);
        match k {
            0 => x.x_minus_ln_1p(),
            1 => x * inverse,
            2 => L::splat(0.5) * inverse * inverse,
            k => {
                let mut power = L::splat(1.0);
                for _ in 0..k {
                    power = -(power * inverse);
                }
                power * L::splat(1.0 / k as f64)
            }
        }
    }
}

/// x − ln(1 + x), without cancellation in value or derivatives: the volumetric part of most rubber laws.
///
/// ```math
/// x - \ln(1+x) = \frac{x^2}{2} - s\Bigl(\frac{x^2}{2} + \frac{2}{3}s^2 + \frac{2}{5}s^4 + \dots\Bigr), \qquad s = \frac{x}{2 + x}
/// ```
///
/// near 0; its derivative is x/(1+x). NaN where 1 + x is negative.
///
/// ```
/// // the naive form has no correct digit here
/// let exact = 5e-25 * (1.0 - 2e-12 / 3.0);
/// assert!((hyperrod::scalar::x_minus_ln_1p(1e-12) - exact).abs() < 1e-15 * exact);
/// ```
#[inline(always)]
pub fn x_minus_ln_1p<D: Scalar>(x: D) -> D {
    x.apply(&XMinusLn1p)
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
#[inline(always)]
pub fn exp_m1_minus_x<D: Scalar>(x: D) -> D {
    x.apply(&ExpM1MinusX)
}

struct ExpM1MinusX;

impl Univariate for ExpM1MinusX {
    #[inline(always)]
    fn taylor<L: Lane>(&self, x: L, k: usize) -> L {
        match k {
            0 => {
                // 1/2!, 1/3!, …: for |x| ≤ 1 the first term left out is below 2/18! = 3e-16 of the leading one
                let mut sum = L::splat(0.0);
                for n in (3..19).rev() {
                    sum = (sum + L::splat(1.0)) * x * L::splat(1.0 / n as f64);
                }
                let series = x * x * L::splat(0.5) * (L::splat(1.0) + sum);
                x.abs().select_lt(L::splat(1.0), series, x.exp_m1() - x)
            }
            1 => x.exp_m1(),
            k => x.exp() * L::splat(1.0 / (2..=k).product::<usize>() as f64),
        }
    }
}

/// (1 + x)ᵖ − 1, without cancellation: what a power of J leaves of its deviation from one.
///
/// ```
/// use hyperrod::scalar::pow_1p_m1;
///
/// assert!((pow_1p_m1(1e-20, 1.0 / 3.0) - 1e-20 / 3.0).abs() < 1e-35);
/// assert!(((1.0_f64 + 1e-20).cbrt() - 1.0) == 0.0); // the naive form has lost everything
/// ```
#[inline(always)]
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
#[inline(always)]
pub fn pow<D: Scalar>(x: D, p: f64) -> D {
    x.apply(&Power { p, order: D::NDERIV })
}

struct Power {
    p: f64,
    order: usize,
}

impl Univariate for Power {
    #[inline(always)]
    fn taylor<L: Lane>(&self, x: L, k: usize) -> L {
        let p = self.p;
        let mut binomial = 1.0;
        for j in 0..k {
            binomial *= (p - j as f64) / (j + 1) as f64;
        }
        if binomial == 0.0 {
            return L::splat(0.0);
        }
        let elsewhere = x.powf(p - k as f64) * L::splat(binomial);
        if k == 0 || p >= k as f64 {
            return elsewhere;
        }
        let at_zero = if (self.order as f64) < 2.0 * p { 0.0 } else { f64::NAN };
        let zero = L::splat(0.0);
        let below = x.select_lt(zero, elsewhere, L::splat(at_zero));
        zero.select_lt(x, elsewhere, below)
    }
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
    z.apply(&AnalyticAngle {
        first: 2.0 * quarter,
        q: quarter,
        closed: |theta: f64, k| match k {
            0 => 2.0 * (0.5 * alpha * theta).sinh().powi(2),
            1 => alpha * (alpha * theta).sinh() / (2.0 * theta).sinh(),
            _ => quarter * (alpha * theta).cosh(),
        },
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
    z.apply(&AnalyticAngle {
        first: 1.0,
        q: 0.0,
        closed: |theta: f64, k| match k {
            0 => theta * theta,
            1 => 2.0 * theta / (2.0 * theta).sinh(),
            _ => 0.5,
        },
    })
}

/// Where the power series in z is used, so that dividing by z(1+z) costs no more than a factor 16 of rounding in w″; that
/// is multiplied by (∂z)² = O(z) in the end.
const SERIES_LIMIT: f64 = 1.0 / 16.0;

/// Seventeen terms: the ratio of consecutive ones tends to z ≤ 1/16, so for α up to 8 the rest is below 1e-17.
const SERIES_TERMS: usize = 17;

/// A solution of z(1+z)w″ + (½+z)w′ = q w + const that is analytic at z = 0, w = c₁ z + c₂ z² + …, with
/// c_{n+1}/c_n = (q − n²)/((n+½)(n+1)).
struct AnalyticAngle<F> {
    /// c₁.
    first: f64,
    q: f64,
    /// (θ, k) to w for k = 0, w′ for k = 1, and the right-hand side for k = 2.
    closed: F,
}

impl<F: Fn(f64, usize) -> f64> AnalyticAngle<F> {
    fn series(&self, z: f64, k: usize) -> f64 {
        let mut coefficients = [0.0; SERIES_TERMS + 1];
        let mut c = self.first;
        for n in 1..=SERIES_TERMS {
            coefficients[n] = c;
            let n = n as f64;
            c *= (self.q - n * n) / ((n + 0.5) * (n + 1.0));
        }
        (k..=SERIES_TERMS).rev().fold(0.0, |sum, n| {
            let binomial = (0..k).fold(1.0, |product, j| product * (n - j) as f64 / (j + 1) as f64);
            sum * z + coefficients[n] * binomial
        })
    }

    fn beyond(&self, z: f64, k: usize) -> f64 {
        let theta = z.sqrt().asinh();
        let (product, slope) = (z * (1.0 + z), 1.0 + 2.0 * z);
        let second = || ((self.closed)(theta, 2) - 0.5 * slope * (self.closed)(theta, 1)) / product;
        match k {
            0 | 1 => (self.closed)(theta, k),
            2 => second() / 2.0,
            3 => -(1.5 * slope * second() + (1.0 - self.q) * (self.closed)(theta, 1)) / product / 6.0,
            _ => f64::NAN,
        }
    }
}

impl<F: Fn(f64, usize) -> f64> Univariate for AnalyticAngle<F> {
    fn taylor<L: Lane>(&self, z: L, k: usize) -> L {
        z.map(|z| if z.abs() <= SERIES_LIMIT { self.series(z, k) } else { self.beyond(z, k) })
    }
}
