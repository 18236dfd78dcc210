//! Numbers, twists and maps of the plane, over any lane.

use std::ops::{Add, Mul, Sub};

use crate::scalar::Lane;

/// u_z + i u_x.
#[derive(Clone, Copy, Debug)]
pub(super) struct Complex<L> {
    pub(super) re: L,
    pub(super) im: L,
}

/// (ω, ν).
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneTwist<L> {
    pub(super) angular: L,
    pub(super) linear: Complex<L>,
}

/// (w, v) → (a w, b w + A v).
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneMap<L> {
    pub(super) angular: L,
    pub(super) lower: Complex<L>,
    pub(super) diagonal: Complex<L>,
}

impl<L: Lane> Complex<L> {
    #[inline(always)]
    pub(super) fn new(re: L, im: L) -> Self {
        Self { re, im }
    }

    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self::new(L::splat(0.0), L::splat(0.0))
    }

    #[inline(always)]
    pub(super) fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// i u.
    #[inline(always)]
    pub(super) fn turned(self) -> Self {
        Self::new(-self.im, self.re)
    }

    #[inline(always)]
    pub(super) fn scale(self, factor: L) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    /// self + k v.
    #[inline(always)]
    pub(super) fn add_scaled(self, k: L, v: Self) -> Self {
        Self::new(k.mul_add(v.re, self.re), k.mul_add(v.im, self.im))
    }

    /// Im(ū v): e_y · u × v.
    #[inline(always)]
    pub(super) fn cross(self, v: Self) -> L {
        self.re.mul_add(v.im, -(self.im * v.re))
    }
}

impl<L: Lane> Add for Complex<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl<L: Lane> Sub for Complex<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl<L: Lane> Mul for Complex<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let re = self.re.mul_add(other.re, -(self.im * other.im));
        Self::new(re, self.re.mul_add(other.im, self.im * other.re))
    }
}

impl<L: Lane> PlaneTwist<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self { angular: L::splat(0.0), linear: Complex::zero() }
    }

    /// self + k other.
    #[inline(always)]
    pub(super) fn add_scaled(&self, k: L, other: &Self) -> Self {
        let angular = k.mul_add(other.angular, self.angular);
        Self { angular, linear: self.linear.add_scaled(k, other.linear) }
    }

    /// [(ω, ν), (w, v)] = (0, i(ω v − w ν)).
    #[inline(always)]
    pub(super) fn bracket(&self, other: &Self) -> Self {
        let linear = (other.linear.scale(self.angular) - self.linear.scale(other.angular)).turned();
        Self { angular: L::splat(0.0), linear }
    }

    #[inline(always)]
    pub(super) fn ad(&self) -> PlaneMap<L> {
        let zero = L::splat(0.0);
        let lower = self.linear.turned().scale(L::splat(-1.0));
        PlaneMap { angular: zero, lower, diagonal: Complex::new(zero, self.angular) }
    }
}

impl<L: Lane> PlaneMap<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self { angular: L::splat(0.0), lower: Complex::zero(), diagonal: Complex::zero() }
    }

    #[inline(always)]
    pub(super) fn identity() -> Self {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        Self { angular: one, lower: Complex::zero(), diagonal: Complex::new(one, zero) }
    }

    /// self + k other.
    #[inline(always)]
    pub(super) fn add_scaled(&self, k: L, other: &Self) -> Self {
        Self {
            angular: k.mul_add(other.angular, self.angular),
            lower: self.lower.add_scaled(k, other.lower),
            diagonal: self.diagonal.add_scaled(k, other.diagonal),
        }
    }

    /// self other.
    #[inline(always)]
    pub(super) fn times(&self, other: &Self) -> Self {
        Self {
            angular: self.angular * other.angular,
            lower: self.lower.scale(other.angular) + self.diagonal * other.lower,
            diagonal: self.diagonal * other.diagonal,
        }
    }
}
