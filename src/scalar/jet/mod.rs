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
#[derive(Clone, Copy, Debug)]
pub struct Jet<L, const N: usize, const M: usize> {
    /// Value.
    pub(crate) value: L,
    /// First derivatives.
    pub(crate) gradient: [L; N],
    /// Second derivatives, upper triangle by rows.
    pub(crate) hessian: [L; M],
}

impl<L: Lane, const N: usize, const M: usize> Jet<L, N, M> {
    /// A constant.
    #[inline(always)]
    pub(crate) fn constant(value: L) -> Self {
        let zero = L::splat(0.0);
        Self { value, gradient: [zero; N], hessian: [zero; M] }
    }

    /// Variable number `index`.
    #[inline(always)]
    pub(crate) fn variable(value: L, index: usize) -> Self {
        let mut jet = Self::constant(value);
        jet.gradient[index] = L::splat(1.0);
        jet
    }

    /// Whether second derivatives are carried.
    const SECOND: bool = M > 0;

    /// f(self), from f, f′ and f″ at the value.
    #[inline(always)]
    pub(crate) fn chain(self, f0: L, f1: L, f2: L) -> Self {
        let mut out = Self { value: f0, ..self };
        for i in 0..N {
            out.gradient[i] = self.gradient[i] * f1;
        }
        if Self::SECOND {
            let mut k = 0;
            for i in 0..N {
                let factor = self.gradient[i] * f2;
                for j in i..N {
                    out.hessian[k] = factor.mul_add(self.gradient[j], self.hessian[k] * f1);
                    k += 1;
                }
            }
        }
        out
    }

    /// self × factor.
    #[inline(always)]
    pub(crate) fn times(self, factor: L) -> Self {
        let mut out = Self { value: self.value * factor, ..self };
        for i in 0..N {
            out.gradient[i] = self.gradient[i] * factor;
        }
        for k in 0..M {
            out.hessian[k] = self.hessian[k] * factor;
        }
        out
    }

    /// self², with half the products of a general one.
    #[inline(always)]
    pub(crate) fn squared(self) -> Self {
        let twice = self.value + self.value;
        self.chain(self.value * self.value, twice, L::splat(2.0))
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
        for i in 0..N {
            self.gradient[i] = self.gradient[i] + other.gradient[i];
        }
        for k in 0..M {
            self.hessian[k] = self.hessian[k] + other.hessian[k];
        }
        self
    }
}

impl<L: Lane, const N: usize, const M: usize> Sub for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        self.value = self.value - other.value;
        for i in 0..N {
            self.gradient[i] = self.gradient[i] - other.gradient[i];
        }
        for k in 0..M {
            self.hessian[k] = self.hessian[k] - other.hessian[k];
        }
        self
    }
}

impl<L: Lane, const N: usize, const M: usize> Mul for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let mut out = Self { value: a.value * b.value, ..a };
        for i in 0..N {
            out.gradient[i] = a.gradient[i].mul_add(b.value, b.gradient[i] * a.value);
        }
        if Self::SECOND {
            let mut k = 0;
            for i in 0..N {
                for j in i..N {
                    let cross = if i == j {
                        let product = a.gradient[i] * b.gradient[i];
                        product + product
                    } else {
                        a.gradient[i].mul_add(b.gradient[j], a.gradient[j] * b.gradient[i])
                    };
                    out.hessian[k] = a.hessian[k].mul_add(b.value, b.hessian[k].mul_add(a.value, cross));
                    k += 1;
                }
            }
        }
        out
    }
}

impl<L: Lane, const N: usize, const M: usize> Neg for Jet<L, N, M> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, gradient: self.gradient.map(|g| -g), hessian: self.hessian.map(|h| -h) }
    }
}

#[cfg(test)]
mod tests;
