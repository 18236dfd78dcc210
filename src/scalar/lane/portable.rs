use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Lane;

/// Four numbers in an array, for machines without a vector type of their own here; compilers make two or four of them a register.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Portable([f64; 4]);

macro_rules! lanewise {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait for Portable {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                let (a, b) = (self.0, o.0);
                Self([a[0] $op b[0], a[1] $op b[1], a[2] $op b[2], a[3] $op b[3]])
            }
        }
    };
}

lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl Neg for Portable {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|v| -v))
    }
}

impl Lane for Portable {
    const LANES: usize = 4;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; 4])
    }
    #[inline(always)]
    fn load(slice: &[f64]) -> Self {
        Self([slice[0], slice[1], slice[2], slice[3]])
    }
    #[inline(always)]
    fn lane(self, i: usize) -> f64 {
        self.0[i]
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn select_lt(self, bound: Self, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|i| if self.0[i] < bound.0[i] { yes.0[i] } else { no.0[i] }))
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let parts = self.0.map(split_exponent);
        (Self(parts.map(|p| p.0)), Self(parts.map(|p| p.1)))
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        self * Self(k.0.map(power_of_two))
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
