//! Several real numbers worked on at once: one `f64`, or as many as the machine's vector registers hold.

mod elementary;
mod portable;
#[cfg(target_arch = "x86_64")]
mod x86;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

pub use portable::Portable;

/// A fixed number of real numbers with lane-wise arithmetic.
///
/// `f64` is the one-lane case; [`Portable`] works everywhere; the vector types of the machine are chosen at run time by
/// [`dispatch`].
pub trait Lane:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// How many numbers.
    const LANES: usize;

    /// The same number in every lane.
    fn splat(value: f64) -> Self;

    /// The first [`LANES`](Self::LANES) numbers of a slice, which must have as many.
    fn load(slice: &[f64]) -> Self;

    /// The first numbers of a slice, `fill` in the lanes that it has none for.
    #[inline(always)]
    fn load_or(slice: &[f64], fill: f64) -> Self {
        if slice.len() >= Self::LANES {
            return Self::load(slice);
        }
        let mut values = [fill; MAX_LANES];
        for (value, v) in values.iter_mut().zip(slice) {
            *value = *v;
        }
        Self::load(&values)
    }

    /// The number in lane `i`.
    fn lane(self, i: usize) -> f64;

    /// Writes the numbers into a slice, as many as it has room for.
    #[inline(always)]
    fn store(self, slice: &mut [f64]) {
        for (i, to) in slice.iter_mut().enumerate().take(Self::LANES) {
            *to = self.lane(i);
        }
    }

    /// self × a + b, fused where the machine does so.
    fn mul_add(self, a: Self, b: Self) -> Self;

    /// √ of each lane.
    fn sqrt(self) -> Self;

    /// Per lane `yes` where `self < bound`, `no` elsewhere (also for NaN).
    fn select_lt(self, bound: Self, yes: Self, no: Self) -> Self;

    /// The smaller of each lane; which one, if either is NaN, is not said.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.select_lt(other, self, other)
    }

    /// For a positive normal number, (m, k) with m ∈ [√½, √2) and x = m 2ᵏ.
    fn split_exponent(self) -> (Self, Self);

    /// x 2ᵏ for an integral k, −1022 ≤ k ≤ 1023.
    fn scale_by_power_of_two(self, k: Self) -> Self;

    /// The sum over the lanes, in a fixed order.
    #[inline(always)]
    fn sum(self) -> f64 {
        (0..Self::LANES).fold(0.0, |sum, i| sum + self.lane(i))
    }

    /// The [`sum`](Self::sum) over the lanes of each of eight, in an order of its own that is fixed as well.
    #[inline(always)]
    fn sum_each(values: &[Self; MAX_LANES], out: &mut [f64; MAX_LANES]) {
        for i in 0..MAX_LANES {
            out[i] = values[i].sum();
        }
    }

    /// The smallest number; which one, if any is NaN, is not said.
    #[inline(always)]
    fn min_lane(self) -> f64 {
        let mut smallest = f64::INFINITY;
        for i in 0..Self::LANES {
            smallest = smallest.min(self.lane(i));
        }
        smallest
    }

    /// The number of lane `i` in every lane.
    #[inline(always)]
    fn spread(self, i: usize) -> Self {
        Self::splat(self.lane(i))
    }

    /// A function of each lane on its own: what has no vector form.
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut values = [0.0; MAX_LANES];
        for (i, value) in values.iter_mut().enumerate().take(Self::LANES) {
            *value = f(self.lane(i));
        }
        Self::load(&values)
    }

    /// As [`map`](Self::map), of two numbers.
    #[inline(always)]
    fn zip_map(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut values = [0.0; MAX_LANES];
        for (i, value) in values.iter_mut().enumerate().take(Self::LANES) {
            *value = f(self.lane(i), other.lane(i));
        }
        Self::load(&values)
    }

    /// |x|.
    #[inline(always)]
    fn abs(self) -> Self {
        self.select_lt(Self::splat(0.0), -self, self)
    }

    /// Nearest integer below 2⁵¹ in size.
    #[inline(always)]
    fn round(self) -> Self {
        let shift = Self::splat(6755399441055744.0); // 1.5 × 2⁵²: adding it leaves no fraction bits
        (self + shift) - shift
    }

    /// Σ c_k x^k by Horner's rule, constant term first.
    #[inline(always)]
    fn polynomial(self, coefficients: &[f64]) -> Self {
        let mut sum = Self::splat(0.0);
        for &c in coefficients.iter().rev() {
            sum = sum.mul_add(self, Self::splat(c));
        }
        sum
    }

    /// ln(1 + x), within 1 ulp, however small x is. NaN below −1, −∞ at −1.
    #[inline(always)]
    fn ln_1p(self) -> Self {
        elementary::ln_1p(self)
    }

    /// x − ln(1 + x), within 4 ulp of itself however small x is.
    #[inline(always)]
    fn x_minus_ln_1p(self) -> Self {
        elementary::x_minus_ln_1p(self)
    }

    /// ln x, within 1 ulp, also near 1 and for subnormal x. NaN below 0, −∞ at 0.
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }

    /// eˣ, within 1 ulp. 0 below −708 and ∞ above 709, except that one `f64` goes on to the ends of the format.
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }

    /// eˣ − 1, within 1.5 ulp, however small x is; saturates as [`exp`](Self::exp).
    #[inline(always)]
    fn exp_m1(self) -> Self {
        elementary::exp_m1(self)
    }

    /// xᵖ, within 1 + |p|/20 ulp where |p ln x| < 708, saturating beyond as [`exp`](Self::exp); at 0 and ∞ the limit, NaN for x < 0 unless p
    /// is integral.
    #[inline(always)]
    fn powf(self, p: f64) -> Self {
        elementary::powf(self, p)
    }
}

/// The most lanes any [`Lane`] has.
pub(crate) const MAX_LANES: usize = 8;

impl Lane for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn load(slice: &[f64]) -> Self {
        slice[0]
    }
    #[inline(always)]
    fn lane(self, _i: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b // not f64::mul_add: without the FMA feature that is a library call
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn select_lt(self, bound: Self, yes: Self, no: Self) -> Self {
        if self < bound { yes } else { no }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        portable::split_exponent(self)
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        self * portable::power_of_two(k)
    }
    #[inline]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }
    #[inline]
    fn ln_1p(self) -> Self {
        f64::ln_1p(self)
    }
    #[inline]
    fn ln(self) -> Self {
        f64::ln(self)
    }
    #[inline]
    fn exp(self) -> Self {
        f64::exp(self)
    }
    #[inline]
    fn exp_m1(self) -> Self {
        f64::exp_m1(self)
    }
    #[inline]
    fn powf(self, p: f64) -> Self {
        f64::powf(self, p)
    }
}

/// A computation written once for any [`Lane`], to be run on the best one the machine has: see [`dispatch`].
///
/// ```
/// use hyperrod::scalar::{Kernel, Lane, dispatch};
///
/// struct SumOfSquares<'a>(&'a [f64]);
///
/// impl Kernel for SumOfSquares<'_> {
///     type Output = f64;
///
///     #[inline(always)]
///     fn run<L: Lane>(self) -> f64 {
///         let mut sum = L::splat(0.0);
///         for block in self.0.chunks_exact(L::LANES) {
///             let x = L::load(block);
///             sum = x.mul_add(x, sum);
///         }
///         sum.sum()
///     }
/// }
///
/// assert_eq!(dispatch(SumOfSquares(&[2.0; 80])), 320.0);
/// ```
pub trait Kernel {
    /// What it computes.
    type Output;

    /// Whether its stack frame begins on a cache line. What finds no register is then stored within one, and loaded again without waiting:
    /// 5 to 25 % of the time of the sums over a section. Not every kernel gains.
    #[doc(hidden)]
    const ALIGNED: bool = false;

    /// The computation. Mark it and what it calls `#[inline(always)]`, so that the body is compiled with the instructions of the
    /// machine; closures cannot be marked so and are better avoided.
    fn run<L: Lane>(self) -> Self::Output;
}

/// Runs a kernel on the widest vectors of this machine: AVX-512, else AVX2 with FMA, else what every x86-64 (or other) machine has.
///
/// The choice is made at run time and is the same for every call, so a default build is as fast as one with `RUSTFLAGS`, and
/// results do not change from call to call.
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    return x86::dispatch(kernel);
    #[cfg(not(target_arch = "x86_64"))]
    return kernel.run::<Portable>();
}

/// As [`dispatch`], for a kernel that has use for no more than four lanes; the same to the bit, faster where the registers are wider.
#[inline]
pub(crate) fn dispatch_few<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    return x86::dispatch_few(kernel);
    #[cfg(not(target_arch = "x86_64"))]
    return dispatch(kernel);
}

/// Runs a kernel on every kind of lane this machine has, by name.
#[cfg(test)]
pub(crate) fn run_on_each<K: Kernel + Clone>(kernel: &K, mut visit: impl FnMut(&'static str, K::Output)) {
    visit("f64", kernel.clone().run::<f64>());
    visit("Portable", kernel.clone().run::<Portable>());
    #[cfg(target_arch = "x86_64")]
    x86::run_on_each(kernel, visit);
}

/// Does something with [`dispatch`] made to take each kind of lane this machine has, by name.
#[cfg(test)]
pub(crate) fn with_each(mut act: impl FnMut(&'static str)) {
    for kind in ["Portable", "AVX2", "AVX-512"] {
        #[cfg(target_arch = "x86_64")]
        if x86::has(kind) {
            x86::FORCED.set(Some(kind));
            act(kind);
            x86::FORCED.set(None);
        }
        #[cfg(not(target_arch = "x86_64"))]
        if kind == "Portable" {
            act(kind);
        }
    }
}

#[cfg(test)]
mod tests;
