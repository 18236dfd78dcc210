//! The vector registers of x86-64, chosen at run time. The one file of the crate with `unsafe` in it.
//!
//! Soundness: a value of [`Avx2`] or [`Avx512`] is made by [`Lane::splat`] or [`Lane::load`] alone, and those are reached only inside
//! [`dispatch`], after the machine was asked whether it has the instructions. Neither type can be named outside this module.
#![allow(unsafe_code)]

use std::arch::asm;
use std::arch::x86_64::*;
use std::fmt;
use std::mem::MaybeUninit;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::portable::{HALF_SQRT_2_BITS, MANTISSA};
use super::{Kernel, Lane, MAX_LANES, Portable};

/// Four numbers in an AVX register.
#[derive(Clone, Copy)]
struct Avx2(__m256d);

/// Eight numbers in an AVX-512 register.
#[derive(Clone, Copy)]
struct Avx512(__m512d);

#[inline]
pub(super) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(test)]
    match FORCED.get() {
        Some("Portable") => return run_portable(kernel),
        // SAFETY: forced for tests, once `has` was asked.
        Some("AVX2") => return unsafe { run_avx2(kernel) },
        _ => {}
    }
    if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
        // SAFETY: the features were just detected.
        return unsafe { run_avx512(kernel) };
    }
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the features were just detected.
        return unsafe { run_avx2(kernel) };
    }
    run_portable(kernel)
}

/// As [`dispatch`], on registers of half the width: what fills no more than those is done in half the time on them.
#[inline]
pub(super) fn dispatch_few<K: Kernel>(kernel: K) -> K::Output {
    let few = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq");
    if few && is_x86_feature_detected!("avx512vl") {
        // SAFETY: the features were just detected.
        return unsafe { run_half_avx512(kernel) };
    }
    dispatch(kernel)
}

#[cfg(test)]
thread_local! {
    /// The kind of lane that tests make [`dispatch`] take; the widest if none.
    pub(super) static FORCED: std::cell::Cell<Option<&'static str>> = const { std::cell::Cell::new(None) };
}

/// Whether this machine has a kind of lane.
#[cfg(test)]
pub(super) fn has(kind: &str) -> bool {
    match kind {
        "AVX-512" => is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq"),
        "AVX2" => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
        _ => true,
    }
}

/// Kept out of line: it would only be in the way of the paths that are taken.
#[inline(never)]
fn run_portable<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Portable>()
}

/// Runs a kernel on each of the instruction sets this machine has, by name.
#[cfg(test)]
pub(super) fn run_on_each<K: Kernel + Clone>(kernel: &K, mut visit: impl FnMut(&'static str, K::Output)) {
    if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
        // SAFETY: the features were just detected.
        visit("AVX-512", unsafe { run_avx512(kernel.clone()) });
    }
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the features were just detected.
        visit("AVX2", unsafe { run_avx2(kernel.clone()) });
    }
}

/// Has the caller begin its stack frame on a cache line, and with it the places of what finds no register: those are made when it is too late to
/// align the frame for them, and a register stored across two lines is slow to be loaded again.
#[inline(always)]
#[allow(clippy::pointers_in_nomem_asm_block, reason = "the address alone is wanted")]
fn align_frame() {
    let line = MaybeUninit::<__m512d>::uninit();
    // SAFETY: no instruction at all; only the address is asked for.
    unsafe { asm!("/* {0} */", in(reg) line.as_ptr(), options(nomem, nostack, preserves_flags)) };
}

#[target_feature(enable = "avx512f,avx512dq,fma")]
fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
    if K::ALIGNED {
        align_frame();
    }
    kernel.run::<Avx512>()
}

/// [`Avx2`], with twice the registers.
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn run_half_avx512<K: Kernel>(kernel: K) -> K::Output {
    if K::ALIGNED {
        align_frame();
    }
    kernel.run::<Avx2>()
}

#[target_feature(enable = "avx2,fma")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    if K::ALIGNED {
        align_frame();
    }
    kernel.run::<Avx2>()
}

macro_rules! operators {
    ($lane:ident, $add:ident, $sub:ident, $mul:ident, $div:ident, $zero:ident, $splat:ident) => {
        operators!(@binary $lane, Add, add, $add);
        operators!(@binary $lane, Sub, sub, $sub);
        operators!(@binary $lane, Mul, mul, $mul);
        operators!(@binary $lane, Div, div, $div);

        impl Neg for $lane {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: see the module; −0 − x = −x for every x, zero included.
                unsafe { Self($sub($splat(-0.0), self.0)) }
            }
        }

        impl fmt::Debug for $lane {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_list().entries((0..Self::LANES).map(|i| self.lane(i))).finish()
            }
        }
    };
    (@binary $lane:ident, $trait:ident, $method:ident, $intrinsic:ident) => {
        impl $trait for $lane {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the module.
                unsafe { Self($intrinsic(self.0, other.0)) }
            }
        }
    };
}

operators!(
    Avx2,
    _mm256_add_pd,
    _mm256_sub_pd,
    _mm256_mul_pd,
    _mm256_div_pd,
    _mm256_setzero_pd,
    _mm256_set1_pd
);
operators!(
    Avx512,
    _mm512_add_pd,
    _mm512_sub_pd,
    _mm512_mul_pd,
    _mm512_div_pd,
    _mm512_setzero_pd,
    _mm512_set1_pd
);

/// 2⁵² as bits and as a number: or-ing a small integer into the bits and subtracting the number converts it to floating point.
const TWO_52_BITS: i64 = 0x4330_0000_0000_0000;
const TWO_52: f64 = 4503599627370496.0;

/// The sums over the lanes of four registers.
#[inline(always)]
fn sums_of_four(a: __m256d, b: __m256d, c: __m256d, d: __m256d) -> __m256d {
    // SAFETY: see the module; called with numbers of `Avx2` alone. Neighbours first, then halves.
    unsafe {
        let (ab, cd) = (_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d));
        _mm256_add_pd(_mm256_permute2f128_pd::<0x20>(ab, cd), _mm256_permute2f128_pd::<0x31>(ab, cd))
    }
}

/// In each quarter, the sum of a's pair and that of b's.
#[inline(always)]
fn pairs(a: Avx512, b: Avx512) -> Avx512 {
    // SAFETY: see the module.
    unsafe { Avx512(_mm512_add_pd(_mm512_unpacklo_pd(a.0, b.0), _mm512_unpackhi_pd(a.0, b.0))) }
}

/// The sums of neighbouring quarters, a's and then b's.
#[inline(always)]
fn quarters(a: Avx512, b: Avx512) -> Avx512 {
    // SAFETY: see the module.
    unsafe {
        let even = _mm512_shuffle_f64x2::<0b10_00_10_00>(a.0, b.0);
        Avx512(_mm512_add_pd(even, _mm512_shuffle_f64x2::<0b11_01_11_01>(a.0, b.0)))
    }
}

impl Lane for Avx2 {
    const LANES: usize = 4;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm256_set1_pd(value)) }
    }
    #[inline(always)]
    fn load(slice: &[f64]) -> Self {
        assert!(slice.len() >= Self::LANES);
        // SAFETY: the slice has four numbers; unaligned loads are allowed.
        unsafe { Self(_mm256_loadu_pd(slice.as_ptr())) }
    }
    #[inline(always)]
    fn sum_each(values: &[Self; MAX_LANES], out: &mut [f64; MAX_LANES]) {
        let [a, b, c, d, e, f, g, h] = *values;
        Self(sums_of_four(a.0, b.0, c.0, d.0)).store(&mut out[..4]);
        Self(sums_of_four(e.0, f.0, g.0, h.0)).store(&mut out[4..]);
    }
    #[inline(always)]
    fn lane(self, i: usize) -> f64 {
        let mut values = [0.0; 4];
        // SAFETY: the array has four numbers.
        unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) };
        values[i]
    }
    #[inline(always)]
    fn store(self, slice: &mut [f64]) {
        if slice.len() >= Self::LANES {
            // SAFETY: the slice has four numbers; unaligned stores are allowed.
            unsafe { _mm256_storeu_pd(slice.as_mut_ptr(), self.0) };
            return;
        }
        let mut values = [0.0; 4];
        // SAFETY: the array has four numbers.
        unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) };
        slice.copy_from_slice(&values[..slice.len()]);
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm256_fmadd_pd(self.0, a.0, b.0)) }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm256_min_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm256_sqrt_pd(self.0)) }
    }
    #[inline(always)]
    fn select_lt(self, bound: Self, yes: Self, no: Self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm256_blendv_pd(no.0, yes.0, _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, bound.0))) }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        // SAFETY: see the module. The exponent is biased by 1024 to stay positive through the logical shift.
        unsafe {
            let half_sqrt_2 = _mm256_set1_epi64x(HALF_SQRT_2_BITS as i64);
            let shifted = _mm256_sub_epi64(_mm256_castpd_si256(self.0), half_sqrt_2);
            let mantissa = _mm256_and_si256(shifted, _mm256_set1_epi64x(MANTISSA as i64));
            let m = _mm256_castsi256_pd(_mm256_add_epi64(mantissa, half_sqrt_2));
            let biased = _mm256_add_epi64(shifted, _mm256_set1_epi64x(1024_i64 << 52));
            let field = _mm256_or_si256(_mm256_srli_epi64::<52>(biased), _mm256_set1_epi64x(TWO_52_BITS));
            let k = _mm256_sub_pd(_mm256_castsi256_pd(field), _mm256_set1_pd(TWO_52 + 1024.0));
            (Self(m), Self(k))
        }
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        // SAFETY: see the module. k + 1023 + 2⁵² has k + 1023 in its lowest bits, shifted into the exponent field.
        unsafe {
            let field = _mm256_castpd_si256(_mm256_add_pd(k.0, _mm256_set1_pd(TWO_52 + 1023.0)));
            Self(_mm256_mul_pd(self.0, _mm256_castsi256_pd(_mm256_slli_epi64::<52>(field))))
        }
    }
}

impl Lane for Avx512 {
    const LANES: usize = 8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm512_set1_pd(value)) }
    }
    #[inline(always)]
    fn load(slice: &[f64]) -> Self {
        assert!(slice.len() >= Self::LANES);
        // SAFETY: the slice has eight numbers; unaligned loads are allowed.
        unsafe { Self(_mm512_loadu_pd(slice.as_ptr())) }
    }
    #[inline(always)]
    fn load_or(slice: &[f64], fill: f64) -> Self {
        if slice.len() >= Self::LANES {
            return Self::load(slice);
        }
        let mask = (1_u8 << slice.len()) - 1;
        // SAFETY: see the module; only the lanes of the mask are read, and the slice has those.
        unsafe { Self(_mm512_mask_loadu_pd(_mm512_set1_pd(fill), mask, slice.as_ptr())) }
    }
    #[inline(always)]
    fn sum_each(values: &[Self; MAX_LANES], out: &mut [f64; MAX_LANES]) {
        let [a, b, c, d, e, f, g, h] = *values;
        let first = quarters(pairs(a, b), pairs(c, d));
        let second = quarters(pairs(e, f), pairs(g, h));
        quarters(first, second).store(out);
    }
    #[inline(always)]
    fn lane(self, i: usize) -> f64 {
        let mut values = [0.0; 8];
        // SAFETY: the array has eight numbers.
        unsafe { _mm512_storeu_pd(values.as_mut_ptr(), self.0) };
        values[i]
    }
    #[inline(always)]
    fn store(self, slice: &mut [f64]) {
        if slice.len() >= Self::LANES {
            // SAFETY: the slice has eight numbers; unaligned stores are allowed.
            unsafe { _mm512_storeu_pd(slice.as_mut_ptr(), self.0) };
            return;
        }
        let mut values = [0.0; 8];
        // SAFETY: the array has eight numbers.
        unsafe { _mm512_storeu_pd(values.as_mut_ptr(), self.0) };
        slice.copy_from_slice(&values[..slice.len()]);
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm512_fmadd_pd(self.0, a.0, b.0)) }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm512_min_pd(self.0, other.0)) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm512_sqrt_pd(self.0)) }
    }
    #[inline(always)]
    fn select_lt(self, bound: Self, yes: Self, no: Self) -> Self {
        // SAFETY: see the module.
        unsafe {
            let mask = _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, bound.0);
            Self(_mm512_mask_blend_pd(mask, no.0, yes.0))
        }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let half_sqrt_2 = _mm512_set1_epi64(HALF_SQRT_2_BITS as i64);
            let shifted = _mm512_sub_epi64(_mm512_castpd_si512(self.0), half_sqrt_2);
            let mantissa = _mm512_and_si512(shifted, _mm512_set1_epi64(MANTISSA as i64));
            let m = _mm512_castsi512_pd(_mm512_add_epi64(mantissa, half_sqrt_2));
            (Self(m), Self(_mm512_cvtepi64_pd(_mm512_srai_epi64::<52>(shifted))))
        }
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        // SAFETY: see the module.
        unsafe { Self(_mm512_scalef_pd(self.0, k.0)) }
    }
    #[inline(always)]
    fn sum(self) -> f64 {
        // SAFETY: see the module. Fixed order: halves, quarters, pairs.
        unsafe { _mm512_reduce_add_pd(self.0) }
    }
    #[inline(always)]
    fn min_lane(self) -> f64 {
        // SAFETY: see the module.
        unsafe { _mm512_reduce_min_pd(self.0) }
    }
}

/// Two numbers in a register that every x86-64 has (SSE2 is part of it), for [`Portable`].
pub(super) mod pair {
    use std::arch::x86_64::*;

    pub(in super::super) type Pair = __m128d;

    macro_rules! lanewise {
        ($($name:ident = $intrinsic:ident),*) => {
            $(#[inline(always)]
            pub(in super::super) fn $name(a: Pair, b: Pair) -> Pair {
                // SAFETY: SSE2 is part of x86-64.
                unsafe { $intrinsic(a, b) }
            })*
        };
    }
    lanewise!(add = _mm_add_pd, sub = _mm_sub_pd, mul = _mm_mul_pd, div = _mm_div_pd);

    #[inline(always)]
    pub(in super::super) fn new(a: f64, b: f64) -> Pair {
        // SAFETY: as above.
        unsafe { _mm_set_pd(b, a) }
    }
    #[inline(always)]
    pub(in super::super) fn sqrt(a: Pair) -> Pair {
        // SAFETY: as above.
        unsafe { _mm_sqrt_pd(a) }
    }
    #[inline(always)]
    pub(in super::super) fn get(a: Pair) -> [f64; 2] {
        // SAFETY: as above.
        unsafe { [_mm_cvtsd_f64(a), _mm_cvtsd_f64(_mm_unpackhi_pd(a, a))] }
    }
    #[inline(always)]
    pub(in super::super) fn select_lt(a: Pair, bound: Pair, yes: Pair, no: Pair) -> Pair {
        // SAFETY: as above.
        unsafe {
            let mask = _mm_cmplt_pd(a, bound);
            _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no))
        }
    }
}
