//! Arithmetic with references and numbers, and comparisons, which all lanes have to agree on.

use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Rem, RemAssign, Sub, SubAssign};

use super::Jet;
use crate::scalar::lane::Lane;

thread_local! {
    /// Set when the lanes of a jet disagreed on a comparison since [`lanes_disagreed`] was last asked.
    static DISAGREED: Cell<bool> = const { Cell::new(false) };
}

/// Whether the lanes of some jet disagreed on a comparison since this was last asked.
#[inline(always)]
pub(crate) fn lanes_disagreed() -> bool {
    DISAGREED.replace(false)
}

/// The answer all lanes give, or lane 0's with a mark.
#[inline(always)]
pub(super) fn agree<L: Lane, T: PartialEq>(answer: impl Fn(usize) -> T) -> T {
    let first = answer(0);
    for i in 1..L::LANES {
        if answer(i) != first {
            DISAGREED.set(true);
        }
    }
    first
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign:ident) => {
        impl<L: Lane, const N: usize, const M: usize> $trait<&Jet<L, N, M>> for Jet<L, N, M> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: &Self) -> Self {
                $trait::$method(self, *other)
            }
        }
        impl<L: Lane, const N: usize, const M: usize> $assign_trait for Jet<L, N, M> {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = $trait::$method(*self, other);
            }
        }
        impl<L: Lane, const N: usize, const M: usize> $assign_trait<f64> for Jet<L, N, M> {
            #[inline(always)]
            fn $assign(&mut self, other: f64) {
                *self = $trait::$method(*self, other);
            }
        }
    };
}

operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div, DivAssign, div_assign);
operator!(Rem, rem, RemAssign, rem_assign);

impl<L: Lane, const N: usize, const M: usize> Div for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let mut quotient = self * other.reciprocal();
        quotient.value = self.value / other.value;
        quotient
    }
}

/// a − b trunc(a/b); the truncated quotient is taken as a constant.
#[allow(clippy::suspicious_arithmetic_impl, reason = "that is what a remainder is")]
impl<L: Lane, const N: usize, const M: usize> Rem for Jet<L, N, M> {
    type Output = Self;
    fn rem(self, other: Self) -> Self {
        self - other.times(self.value.zip_map(other.value, |a, b| (a / b).trunc()))
    }
}

impl<L: Lane, const N: usize, const M: usize> Add<f64> for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: f64) -> Self {
        self.value = self.value + L::splat(other);
        self
    }
}

impl<L: Lane, const N: usize, const M: usize> Sub<f64> for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: f64) -> Self {
        self.value = self.value - L::splat(other);
        self
    }
}

impl<L: Lane, const N: usize, const M: usize> Mul<f64> for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.times(L::splat(other))
    }
}

impl<L: Lane, const N: usize, const M: usize> Div<f64> for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: f64) -> Self {
        let mut quotient = self.times(L::splat(1.0 / other));
        quotient.value = self.value / L::splat(other);
        quotient
    }
}

impl<L: Lane, const N: usize, const M: usize> Rem<f64> for Jet<L, N, M> {
    type Output = Self;
    fn rem(self, other: f64) -> Self {
        self % Self::from(other)
    }
}

impl<L: Lane, const N: usize, const M: usize> PartialEq for Jet<L, N, M> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        agree::<L, _>(|i| self.value.lane(i) == other.value.lane(i))
    }
}

impl<L: Lane, const N: usize, const M: usize> PartialEq<f64> for Jet<L, N, M> {
    #[inline(always)]
    fn eq(&self, other: &f64) -> bool {
        agree::<L, _>(|i| self.value.lane(i) == *other)
    }
}

impl<L: Lane, const N: usize, const M: usize> PartialOrd for Jet<L, N, M> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        agree::<L, _>(|i| self.value.lane(i).partial_cmp(&other.value.lane(i)))
    }
}

impl<L: Lane, const N: usize, const M: usize> PartialOrd<f64> for Jet<L, N, M> {
    #[inline(always)]
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        agree::<L, _>(|i| self.value.lane(i).partial_cmp(other))
    }
}
