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
/// assert_eq!(hyperrod::scalar::x_minus_ln_1p(1e-12), 5e-25 * (1.0 - 2e-12 / 3.0));
/// ```
#[inline(always)]
pub fn x_minus_ln_1p<D: Scalar>(x: D) -> D {
    x.apply(&XMinusLn1p)
}
