use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Lane;
#[cfg(target_arch = "x86_64")]
use super::x86::pair;

/// Two numbers, for any machine.
#[cfg(not(target_arch = "x86_64"))]
mod pair {
    pub(super) type Pair = [f64; 2];

    macro_rules! lanewise {
        ($($name:ident = $op:tt),*) => {
            $(#[inline(always)]
            pub(super) fn $name(a: Pair, b: Pair) -> Pair {
                [a[0] $op b[0], a[1] $op b[1]]
            })*
        };
    }
    lanewise!(add = +, sub = -, mul = *, div = /);

    #[inline(always)]
    pub(super) fn new(a: f64, b: f64) -> Pair {
        [a, b]
    }
    #[inline(always)]
    pub(super) fn sqrt(a: Pair) -> Pair {
        [a[0].sqrt(), a[1].sqrt()]
    }
    #[inline(always)]
    pub(super) fn get(a: Pair) -> [f64; 2] {
        a
    }
    #[inline(always)]
    pub(super) fn select_lt(a: Pair, bound: Pair, yes: Pair, no: Pair) -> Pair {
        let one = |i: usize| if a[i] < bound[i] { yes[i] } else { no[i] };
        [one(0), one(1)]
    }
}

use pair::Pair;

/// Four numbers in two registers: for machines without wider vectors, and for real closures, which name their number type.
#[derive(Clone, Copy)]
pub struct Portable(Pair, Pair);

impl Portable {
    #[inline(always)]
    fn to_array(self) -> [f64; 4] {
        let ([a, b], [c, d]) = (pair::get(self.0), pair::get(self.1));
        [a, b, c, d]
    }

    #[inline(always)]
    fn from_array([a, b, c, d]: [f64; 4]) -> Self {
        Self(pair::new(a, b), pair::new(c, d))
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl $trait for Portable {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(pair::$method(self.0, other.0), pair::$method(self.1, other.1))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::splat(-0.0) - self // −0 − x = −x for every x, zero included
    }
}

impl fmt::Debug for Portable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_array().fmt(f)
    }
}

impl Lane for Portable {
    const LANES: usize = 4;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(pair::new(value, value), pair::new(value, value))
    }
    #[inline(always)]
    fn load(slice: &[f64]) -> Self {
        Self(pair::new(slice[0], slice[1]), pair::new(slice[2], slice[3]))
    }
    #[inline(always)]
    fn lane(self, i: usize) -> f64 {
        self.to_array()[i]
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(pair::sqrt(self.0), pair::sqrt(self.1))
    }
    #[inline(always)]
    fn select_lt(self, bound: Self, yes: Self, no: Self) -> Self {
        Self(pair::select_lt(self.0, bound.0, yes.0, no.0), pair::select_lt(self.1, bound.1, yes.1, no.1))
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let [a, b, c, d] = self.to_array().map(split_exponent);
        (Self::from_array([a.0, b.0, c.0, d.0]), Self::from_array([a.1, b.1, c.1, d.1]))
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        self * Self::from_array(k.to_array().map(power_of_two))
    }
}

/// (m, k) with m ∈ [√½, √2) and x = m 2ᵏ, by the bits of a positive normal number.
#[inline(always)]
pub(super) fn split_exponent(x: f64) -> (f64, f64) {
    // the bits above √½, so that the exponent field of the difference rounds at √2
    let shifted = x.to_bits().wrapping_sub(HALF_SQRT_2_BITS);
    let k = (shifted as i64) >> 52;
    (f64::from_bits((shifted & MANTISSA).wrapping_add(HALF_SQRT_2_BITS)), k as f64)
}

/// Bits of √½, rounded down to the upper half of its mantissa.
pub(super) const HALF_SQRT_2_BITS: u64 = 0x3fe6_a09e_0000_0000;
pub(super) const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;

/// 2ᵏ for an integral k in the normal range.
#[inline(always)]
pub(super) fn power_of_two(k: f64) -> f64 {
    f64::from_bits(((k as i64 + 1023) as u64) << 52)
}
