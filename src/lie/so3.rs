//! Rotations SO(3).
use nalgebra::{Matrix3, Vector3};

use crate::scalar::Scalar;

/// The skew matrix v^ with v^ w = v × w.
#[inline]
pub fn hat<D: Scalar>(v: &Vector3<D>) -> Matrix3<D> {
    let o = D::zero();
    Matrix3::new(o, -v.z, v.y, v.z, o, -v.x, -v.y, v.x, o)
}
