use nalgebra::{Matrix3, Matrix6};
use std::ops::{Add, Mul, Sub};

use super::{Twist, Wrench};
use crate::scalar::Scalar;

/// A linear map of twists of the form [[A, 0], [B, A]].
///
/// Ad, ad, dexp and their inverses are all of this form, which is closed under sum and product: a product costs three
/// 3×3 products instead of eight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwistMap<D = f64> {
    /// The block A on the diagonal.
    pub diagonal: Matrix3<D>,
    /// The block B below it, from angular to linear.
    pub lower: Matrix3<D>,
}

impl<D: Scalar> TwistMap<D> {
    /// The identity.
    #[inline]
    pub fn identity() -> Self {
        Self { diagonal: Matrix3::identity(), lower: Matrix3::from_element(D::zero()) }
    }

    /// The map applied to a twist: (A w, B w + A v).
    #[inline]
    pub fn apply(&self, eta: &Twist<D>) -> Twist<D> {
        Twist::new(self.diagonal * eta.angular, self.lower * eta.angular + self.diagonal * eta.linear)
    }

    /// The transpose applied to a wrench: (Aᵀ m + Bᵀ n, Aᵀ n).
    #[inline]
    pub fn apply_transpose(&self, wrench: &Wrench<D>) -> Wrench<D> {
        Wrench::new(
            self.diagonal.tr_mul(&wrench.moment) + self.lower.tr_mul(&wrench.force),
            self.diagonal.tr_mul(&wrench.force),
        )
    }

    /// The map multiplied by a number.
    #[inline]
    pub fn scale(&self, factor: D) -> Self {
        Self { diagonal: self.diagonal * factor, lower: self.lower * factor }
    }

    /// The 6×6 matrix [[A, 0], [B, A]].
    #[inline]
    pub fn to_matrix(&self) -> Matrix6<D> {
        let mut m = Matrix6::from_element(D::zero());
        m.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.diagonal);
        m.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.diagonal);
        m.fixed_view_mut::<3, 3>(3, 0).copy_from(&self.lower);
        m
    }
}

impl<D: Scalar> Mul for TwistMap<D> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self {
            diagonal: self.diagonal * other.diagonal,
            lower: self.lower * other.diagonal + self.diagonal * other.lower,
        }
    }
}

impl<D: Scalar> Add for TwistMap<D> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { diagonal: self.diagonal + other.diagonal, lower: self.lower + other.lower }
    }
}

impl<D: Scalar> Sub for TwistMap<D> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { diagonal: self.diagonal - other.diagonal, lower: self.lower - other.lower }
    }
}
