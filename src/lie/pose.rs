use approx::{AbsDiffEq, RelativeEq};
use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};
use num_dual::Dual2_64;
use std::ops::Mul;

use super::{
    Twist, TwistMap, se3,
    so3::{hat, vee},
};
use crate::scalar::Scalar;

/// A rigid placement g = (R, p) in SE(3): a point r of the section sits at p + R r in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<D = f64> {
    /// Rotation R, body to space.
    pub rotation: Matrix3<D>,
    /// Position p, m.
    pub position: Vector3<D>,
}

impl<D: Scalar> Pose<D> {
    /// The pose (R, p). `rotation` must be a rotation matrix.
    #[inline]
    pub fn new(rotation: Matrix3<D>, position: Vector3<D>) -> Self {
        Self { rotation, position }
    }

    /// No rotation, at the origin: a straight rod clamped here lies along +Z.
    #[inline]
    pub fn identity() -> Self {
        Self::new(Matrix3::identity(), Vector3::from_element(D::zero()))
    }

    /// g⁻¹ = (Rᵀ, −Rᵀ p).
    #[inline]
    pub fn inverse(&self) -> Self {
        Self::new(self.rotation.transpose(), -self.rotation.tr_mul(&self.position))
    }

    /// Ad_g = [[R, 0], [p^ R, R]], so that g η^ g⁻¹ = (Ad_g η)^.
    #[inline]
    pub fn adjoint(&self) -> TwistMap<D> {
        TwistMap { diagonal: self.rotation, lower: hat(&self.position) * self.rotation }
    }

    /// Ad_{g⁻¹} = Ad_g⁻¹ = [[Rᵀ, 0], [−Rᵀ p^, Rᵀ]].
    #[inline]
    pub fn adjoint_inverse(&self) -> TwistMap<D> {
        let transpose = self.rotation.transpose();
        TwistMap { diagonal: transpose, lower: -(transpose * hat(&self.position)) }
    }

    /// The twist Ω of g = exp Ω^: [`se3::log`].
    #[inline]
    pub fn log(&self) -> Twist<D> {
        se3::log(self)
    }

    /// Where a point given in this frame lies in space: p + R r.
    #[inline]
    pub fn transform_point(&self, point: &Vector3<D>) -> Vector3<D> {
        self.position + self.rotation * point
    }
}

impl Pose<f64> {
    /// The same numbers as constants of another scalar type.
    #[inline]
    pub fn cast<E: Scalar>(&self) -> Pose<E> {
        Pose::new(self.rotation.map(E::from), self.position.map(E::from))
    }

    /// The rotation as a unit quaternion (body to space).
    pub fn quaternion(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(self.rotation))
    }
}

impl Pose<Dual2_64> {
    /// A pose that is a function of time, as (g, η, η̇): the pose, its body velocity and its body acceleration.
    ///
    /// ```math
    /// \hat\eta = g^{-1}\dot g, \qquad \dot{\hat\eta} = g^{-1}\ddot g - \hat\eta\hat\eta
    /// ```
    pub fn motion(&self) -> (Pose, Twist, Twist) {
        let (rotation, position) = (self.rotation.map(|d| d.re), self.position.map(|d| d.re));
        let turned = rotation.tr_mul(&self.rotation.map(|d| d.v1));
        let velocity = Twist::new(vee(&turned), rotation.tr_mul(&self.position.map(|d| d.v1)));
        let acceleration = Twist::new(
            vee(&(rotation.tr_mul(&self.rotation.map(|d| d.v2)) - turned * turned)),
            rotation.tr_mul(&self.position.map(|d| d.v2)) - velocity.angular.cross(&velocity.linear),
        );
        (Pose::new(rotation, position), velocity, acceleration)
    }
}

impl From<Isometry3<f64>> for Pose {
    fn from(isometry: Isometry3<f64>) -> Self {
        Self::new(isometry.rotation.to_rotation_matrix().into_inner(), isometry.translation.vector)
    }
}

impl From<Pose> for Isometry3<f64> {
    fn from(pose: Pose) -> Self {
        Isometry3::from_parts(pose.position.into(), pose.quaternion())
    }
}

/// Composition g h = (R_g R_h, p_g + R_g p_h).
impl<D: Scalar> Mul for Pose<D> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::new(self.rotation * other.rotation, self.transform_point(&other.position))
    }
}

impl AbsDiffEq for Pose {
    type Epsilon = f64;
    fn default_epsilon() -> f64 {
        f64::default_epsilon()
    }
    fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
        self.rotation.abs_diff_eq(&other.rotation, epsilon)
            && self.position.abs_diff_eq(&other.position, epsilon)
    }
}

impl RelativeEq for Pose {
    fn default_max_relative() -> f64 {
        f64::default_max_relative()
    }
    fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
        self.rotation.relative_eq(&other.rotation, epsilon, max_relative)
            && self.position.relative_eq(&other.position, epsilon, max_relative)
    }
}
