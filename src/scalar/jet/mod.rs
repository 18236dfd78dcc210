//! The packed second-order jet the engine evaluates energies with.

mod dual_num;
mod operators;

use std::ops::{Add, Mul, Neg, Sub};

pub(crate) use operators::lanes_disagreed;

use super::lane::Lane;

/// Value, gradient and symmetric Hessian in `N` variables, over one or more [`Lane`]s of points.
///
/// `M` is the number of Hessian entries kept: N(N+1)/2 for second order (upper triangle by rows), 0 for first order; with N = M = 0 it is a
/// value. Unlike num-dual's numbers it stores each mixed derivative once, has no optional parts, and carries several points.
///
/// It implements [`num_dual::DualNum`], so any energy runs on it unchanged. **Comparisons and `re()` see one value**: where the
/// lanes disagree on a comparison they answer for lane 0 and leave a mark, and the engine redoes those points one by one.
///
/// It also knows which of its derivatives are identically zero. In code that is inlined, as in a kernel, that is known when it is
/// compiled and the work on zeros disappears: without it, a floating-point product with 0 has to be carried out.
#[derive(Clone, Copy, Debug)]
pub struct Jet<L, const N: usize, const M: usize> {
    /// Value.
    pub(crate) value: L,
    /// First derivatives.
    pub(crate) gradient: [L; N],
    /// Second derivatives, upper triangle by rows.
    pub(crate) hessian: [L; M],
    /// Bit i: first derivative i may be anything but zero.
    first: u32,
    /// Bit k: second derivative k may be anything but zero.
    second: u32,
}

/// The body for every index below `$n` (at most 7), written out: a loop is unrolled too late for the masks of zeros to be seen through.
///
/// Conditions on indices stand in `const` blocks, so that what cannot happen for a number of variables is never compiled for it.
macro_rules! each {
    ($i:ident < $n:expr, $body:block) => {
        each!(@ $i, $n, $body, 0, 1, 2, 3, 4, 5, 6)
    };
    (@ $i:ident, $n:expr, $body:block, $($index:literal),*) => {
        $(if const { $index < $n } {
            #[allow(non_upper_case_globals)]
            const $i: usize = $index;
            $body
        })*
    };
}

/// Where second derivative (i, j), i ≤ j, of n variables is stored.
///
/// Saturating, as an unoptimised build evaluates it also where i or j is no variable and nothing is stored.
#[inline(always)]
const fn packed(n: usize, i: usize, j: usize) -> usize {
    (i * n + j).saturating_sub(i * (i + 1) / 2)
}

/// Whether (i, j) is in the upper triangle, the diagonal included.
const fn upper(i: usize, j: usize) -> bool {
    i <= j
}

/// Whether bit `i` of a mask is set.
#[inline(always)]
const fn has(mask: u32, i: usize) -> bool {
    mask & (1 << i) != 0
}

impl<L: Lane, const N: usize, const M: usize> Jet<L, N, M> {
    /// A constant.
    #[inline(always)]
    pub(crate) fn constant(value: L) -> Self {
        let zero = L::splat(0.0);
        Self { value, gradient: [zero; N], hessian: [zero; M], first: 0, second: 0 }
    }

    /// Variable number `index`.
    #[inline(always)]
    pub(crate) fn variable(value: L, index: usize) -> Self {
        Self::constant(value).with_slope(index, L::splat(1.0))
    }

    /// The same with a first derivative set.
    #[inline(always)]
    pub(crate) fn with_slope(mut self, index: usize, slope: L) -> Self {
        self.gradient[index] = slope;
        self.first |= 1 << index;
        self
    }

    /// The value, as it moves with the last variable: as the second of two.
    #[inline(always)]
    pub(crate) fn along_last(self) -> Jet<L, 2, 3> {
        let fixed = Jet::constant(self.value);
        if N > 0 && has(self.first, N - 1) { fixed.with_slope(1, self.gradient[N - 1]) } else { fixed }
    }

    /// f(self), from f, f′ and f″ at the value.
    #[inline(always)]
    pub(crate) fn chain(self, f0: L, f1: L, f2: L) -> Self {
        let mut out = Self::constant(f0);
        out.first = self.first;
        each!(i < N, {
            if has(self.first, i) {
                out.gradient[i] = self.gradient[i] * f1;
            }
            each!(j < N, {
                if const { M > 0 && upper(i, j) } {
                    let k = const { packed(N, i, j) };
                    if has(self.first, i) && has(self.first, j) {
                        out.add_second(k, self.gradient[i] * self.gradient[j], f2);
                    }
                    if has(self.second, k) {
                        out.add_second(k, self.hessian[k], f1);
                    }
                }
            });
        });
        out
    }

    /// Adds a × b to second derivative k.
    #[inline(always)]
    fn add_second(&mut self, k: usize, a: L, b: L) {
        self.hessian[k] = if has(self.second, k) { a.mul_add(b, self.hessian[k]) } else { a * b };
        self.second |= 1 << k;
    }

    /// self × factor.
    #[inline(always)]
    pub(crate) fn times(mut self, factor: L) -> Self {
        self.value = self.value * factor;
        each!(i < N, {
            if has(self.first, i) {
                self.gradient[i] = self.gradient[i] * factor;
            }
            each!(j < N, {
                if const { M > 0 && upper(i, j) } {
                    let k = const { packed(N, i, j) };
                    if has(self.second, k) {
                        self.hessian[k] = self.hessian[k] * factor;
                    }
                }
            });
        });
        self
    }

    /// self², with half the products of a general one.
    #[inline(always)]
    pub(crate) fn squared(self) -> Self {
        self * self
    }

    /// 1 / self.
    #[inline(always)]
    pub(crate) fn reciprocal(self) -> Self {
        let inverse = L::splat(1.0) / self.value;
        let square = inverse * inverse;
        self.chain(inverse, -square, (square + square) * inverse)
    }
}

impl<L: Lane, const N: usize, const M: usize> Add for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self.value = self.value + other.value;
        each!(i < N, {
            if has(self.first & other.first, i) {
                self.gradient[i] = self.gradient[i] + other.gradient[i];
            } else if has(other.first, i) {
                self.gradient[i] = other.gradient[i];
            }
            each!(j < N, {
                if const { M > 0 && upper(i, j) } {
                    let k = const { packed(N, i, j) };
                    if has(self.second & other.second, k) {
                        self.hessian[k] = self.hessian[k] + other.hessian[k];
                    } else if has(other.second, k) {
                        self.hessian[k] = other.hessian[k];
                    }
                }
            });
        });
        self.first |= other.first;
        self.second |= other.second;
        self
    }
}

impl<L: Lane, const N: usize, const M: usize> Sub for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        self.value = self.value - other.value;
        each!(i < N, {
            if has(self.first & other.first, i) {
                self.gradient[i] = self.gradient[i] - other.gradient[i];
            } else if has(other.first, i) {
                self.gradient[i] = -other.gradient[i];
            }
            each!(j < N, {
                if const { M > 0 && upper(i, j) } {
                    let k = const { packed(N, i, j) };
                    if has(self.second & other.second, k) {
                        self.hessian[k] = self.hessian[k] - other.hessian[k];
                    } else if has(other.second, k) {
                        self.hessian[k] = -other.hessian[k];
                    }
                }
            });
        });
        self.first |= other.first;
        self.second |= other.second;
        self
    }
}

impl<L: Lane, const N: usize, const M: usize> Mul for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let mut out = Self::constant(a.value * b.value);
        out.first = a.first | b.first;
        each!(i < N, {
            if has(a.first & b.first, i) {
                out.gradient[i] = a.gradient[i].mul_add(b.value, b.gradient[i] * a.value);
            } else if has(a.first, i) {
                out.gradient[i] = a.gradient[i] * b.value;
            } else if has(b.first, i) {
                out.gradient[i] = b.gradient[i] * a.value;
            }
            each!(j < N, {
                if const { M > 0 && upper(i, j) } {
                    let k = const { packed(N, i, j) };
                    if has(a.first, i) && has(b.first, j) {
                        out.add_second(k, a.gradient[i], b.gradient[j]);
                    }
                    if const { i == j } && has(out.second, k) {
                        out.hessian[k] = out.hessian[k] + out.hessian[k];
                    } else if const { i != j } && has(a.first, j) && has(b.first, i) {
                        out.add_second(k, a.gradient[j], b.gradient[i]);
                    }
                    if has(a.second, k) {
                        out.add_second(k, a.hessian[k], b.value);
                    }
                    if has(b.second, k) {
                        out.add_second(k, b.hessian[k], a.value);
                    }
                }
            });
        });
        out
    }
}

impl<L: Lane, const N: usize, const M: usize> Neg for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::constant(L::splat(-0.0)) - self // −0 − x = −x for every x, zero included
    }
}

#[cfg(test)]
mod tests;
