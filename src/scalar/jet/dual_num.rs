//! [`DualNum`] and the number traits it asks for, so that any energy runs on a [`Jet`] unchanged.

use num_dual::{Dual2_64, DualNum, DualStruct, Mappable};
use num_traits::{FromPrimitive, Inv, Num, One, Signed, Zero};
use std::fmt;
use std::iter::{Product, Sum};

use super::Jet;
use super::operators::agree;
use crate::scalar::lane::Lane;

impl<L: Lane, const N: usize, const M: usize> fmt::Display for Jet<L, N, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} + {:?}ε + {:?}ε²", self.value, self.gradient, self.hessian)
    }
}

impl<L: Lane, const N: usize, const M: usize> From<f64> for Jet<L, N, M> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self::constant(L::splat(value))
    }
}

impl<L: Lane, const N: usize, const M: usize> FromPrimitive for Jet<L, N, M> {
    fn from_i64(n: i64) -> Option<Self> {
        Some(Self::from(n as f64))
    }
    fn from_u64(n: u64) -> Option<Self> {
        Some(Self::from(n as f64))
    }
    fn from_f64(n: f64) -> Option<Self> {
        Some(Self::from(n))
    }
}

impl<L: Lane, const N: usize, const M: usize> Zero for Jet<L, N, M> {
    #[inline(always)]
    fn zero() -> Self {
        Self::from(0.0)
    }
    #[inline(always)]
    fn is_zero(&self) -> bool {
        *self == 0.0
    }
}

impl<L: Lane, const N: usize, const M: usize> One for Jet<L, N, M> {
    #[inline(always)]
    fn one() -> Self {
        Self::from(1.0)
    }
}

impl<L: Lane, const N: usize, const M: usize> Num for Jet<L, N, M> {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Self::from)
    }
}

impl<L: Lane, const N: usize, const M: usize> Signed for Jet<L, N, M> {
    #[inline(always)]
    fn abs(&self) -> Self {
        self.times(self.value.select_lt(L::splat(0.0), L::splat(-1.0), L::splat(1.0)))
    }
    fn abs_sub(&self, other: &Self) -> Self {
        let difference = *self - *other;
        difference.times(L::splat(0.0).select_lt(difference.value, L::splat(1.0), L::splat(0.0)))
    }
    #[inline(always)]
    fn signum(&self) -> Self {
        Self::constant(self.value.map(f64::signum))
    }
    #[inline(always)]
    fn is_positive(&self) -> bool {
        agree::<L, _>(|i| self.value.lane(i).is_sign_positive())
    }
    #[inline(always)]
    fn is_negative(&self) -> bool {
        agree::<L, _>(|i| self.value.lane(i).is_sign_negative())
    }
}

impl<L: Lane, const N: usize, const M: usize> Inv for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn inv(self) -> Self {
        self.reciprocal()
    }
}

impl<L: Lane, const N: usize, const M: usize> Sum for Jet<L, N, M> {
    #[inline(always)]
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::zero(), |a, b| a + b)
    }
}

impl<L: Lane, const N: usize, const M: usize> Product for Jet<L, N, M> {
    #[inline(always)]
    fn product<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::one(), |a, b| a * b)
    }
}

impl<L: Lane, const N: usize, const M: usize> DualStruct for Jet<L, N, M> {
    type Real = f64;
    type Inner = f64;
    #[inline(always)]
    fn re(&self) -> f64 {
        agree::<L, _>(|i| self.value.lane(i))
    }
    #[inline(always)]
    fn from_inner(inner: &f64) -> Self {
        Self::from(*inner)
    }
}

impl<L: Lane, const N: usize, const M: usize> Mappable<Self> for Jet<L, N, M> {
    type Output<O> = O;
    fn map_dual<F: FnOnce(Self) -> O, O>(self, f: F) -> O {
        f(self)
    }
}

impl<L: Lane, const N: usize, const M: usize> Jet<L, N, M> {
    /// A function without a vector form, lane by lane through num-dual.
    fn lane_by_lane(&self, f: impl Fn(Dual2_64) -> Dual2_64) -> Self {
        let at = |x: f64| f(Dual2_64::new(x, 1.0, 0.0));
        self.chain(self.value.map(|x| at(x).re), self.value.map(|x| at(x).v1), self.value.map(|x| at(x).v2))
    }

    /// xⁿ of the value by repeated squaring.
    #[inline(always)]
    fn value_powi(&self, n: i32) -> L {
        let mut base = if n < 0 { L::splat(1.0) / self.value } else { self.value };
        let mut exponent = n.unsigned_abs();
        let mut power = L::splat(1.0);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = power * base;
            }
            base = base * base;
            exponent >>= 1;
        }
        power
    }
}

macro_rules! lane_by_lane {
    ($($name:ident),*) => {
        $(fn $name(&self) -> Self {
            self.lane_by_lane(|x| x.$name())
        })*
    };
}

impl<L: Lane, const N: usize, const M: usize> DualNum for Jet<L, N, M> {
    type Primitive = f64;
    type InnerDual = f64;
    const NDERIV: usize = if M > 0 { 2 } else { (N > 0) as usize };

    #[inline(always)]
    fn from_re(re: f64) -> Self {
        Self::from(re)
    }
    #[inline(always)]
    fn scale(self, factor: &f64) -> Self {
        self * *factor
    }
    #[inline(always)]
    fn recip(&self) -> Self {
        self.reciprocal()
    }
    #[inline(always)]
    fn powi(&self, n: i32) -> Self {
        match n {
            0 => Self::one(),
            1 => *self,
            2 => self.squared(),
            _ => {
                let second = self.value_powi(n - 2);
                let first = second * self.value;
                let degree = f64::from(n);
                self.chain(
                    first * self.value,
                    first * L::splat(degree),
                    second * L::splat(degree * (degree - 1.0)),
                )
            }
        }
    }
    /// For x ≥ 0, or an integral p; at 0 the true limits, finite where they are (unlike num-dual's own numbers, which give NaN).
    #[inline(always)]
    fn powf(&self, p: f64) -> Self {
        let mut first = L::splat(0.0);
        let mut second = L::splat(0.0);
        if p != 0.0 {
            first = self.value.powf(p - 1.0) * L::splat(p);
        }
        if p != 0.0 && p != 1.0 {
            second = self.value.powf(p - 2.0) * L::splat(p * (p - 1.0));
        }
        self.chain(self.value.powf(p), first, second)
    }
    #[inline(always)]
    fn sqrt(&self) -> Self {
        let root = self.value.sqrt();
        let first = L::splat(0.5) / root;
        self.chain(root, first, -first * L::splat(0.5) / self.value)
    }
    #[inline(always)]
    fn exp(&self) -> Self {
        let exp = self.value.exp();
        self.chain(exp, exp, exp)
    }
    #[inline(always)]
    fn exp_m1(&self) -> Self {
        let exp_m1 = self.value.exp_m1();
        let exp = exp_m1 + L::splat(1.0);
        self.chain(exp_m1, exp, exp)
    }
    #[inline(always)]
    fn ln(&self) -> Self {
        let inverse = L::splat(1.0) / self.value;
        self.chain(self.value.ln(), inverse, -inverse * inverse)
    }
    #[inline(always)]
    fn ln_1p(&self) -> Self {
        let inverse = L::splat(1.0) / (L::splat(1.0) + self.value);
        self.chain(self.value.ln_1p(), inverse, -inverse * inverse)
    }
    fn log(&self, base: f64) -> Self {
        self.lane_by_lane(|x| x.log(base))
    }
    fn sin_cos(&self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    /// θ = θ₀ + atan((y x₀ − x y₀)/(x x₀ + y y₀)) with the values as constants: right in every quadrant.
    fn atan2(&self, other: Self) -> Self {
        let (y0, x0) = (self.value, other.value);
        let sine = self.times(x0) - other.times(y0);
        let cosine = other.times(x0) + self.times(y0);
        let mut angle = (sine / cosine).atan();
        angle.value = y0.zip_map(x0, f64::atan2);
        angle
    }
    #[inline(always)]
    fn mul_add(&self, a: Self, b: Self) -> Self {
        *self * a + b
    }
    lane_by_lane!(
        cbrt, exp2, log2, log10, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh,
        sph_j0, sph_j1, sph_j2
    );
}
