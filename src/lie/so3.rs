//! Rotations SO(3): free functions on vectors ω and rotation matrices R.
//!
//! ω^ is the skew matrix with ω^ v = ω × v. [`exp`] turns by |ω| about ω. [`dexp`] is the *spatial* derivative of exp (what
//! stands to the left of R); the body derivative is `dexp(-ω)`. See [`se3`](super::se3) for how the literature names the two.
//!
//! Every function has correct first and second derivatives in dual numbers at every angle, ω = 0 included.

use nalgebra::{Matrix3, Vector3};

use super::coefficients::{dexp_coefficients, dexp_inv_coefficients, horner, stumpff};
use crate::scalar::Scalar;

/// The skew matrix v^ with v^ w = v × w.
#[inline]
pub fn hat<D: Scalar>(v: &Vector3<D>) -> Matrix3<D> {
    let o = D::zero();
    Matrix3::new(o, -v.z, v.y, v.z, o, -v.x, -v.y, v.x, o)
}

/// The vector v of a skew matrix v^, the inverse of [`hat`]. A symmetric part is ignored: v^ = (M − Mᵀ)/2.
#[inline]
pub fn vee<D: Scalar>(m: &Matrix3<D>) -> Vector3<D> {
    twice_vee(m) * D::from(0.5)
}

#[inline]
fn twice_vee<D: Scalar>(m: &Matrix3<D>) -> Vector3<D> {
    Vector3::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)])
}

/// The rotation by |ω| about ω (Rodrigues).
///
/// ```math
/// \exp\hat\omega = \cos\theta\, I + \frac{\sin\theta}{\theta}\,\hat\omega + \frac{1-\cos\theta}{\theta^2}\,\omega\omega^T,
/// \qquad \theta = |\omega|
/// ```
///
/// Source: Murray, Li & Sastry (1994), Eq. (2.14).
///
/// ```
/// use hyperrod::lie::so3;
/// use nalgebra::Vector3;
///
/// let quarter_turn = so3::exp(&Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2));
/// assert!((quarter_turn * Vector3::x() - Vector3::y()).norm() < 1e-15);
/// ```
#[inline]
pub fn exp<D: Scalar>(omega: &Vector3<D>) -> Matrix3<D> {
    let [c0, c1, c2, ..] = stumpff(omega.dot(omega));
    isotropic(&[c0, c1, c2], omega)
}

/// 1, −1/3, 1/5, …: atan t = t Σ aⱼ t²ʲ. For t ≤ tan(π/32), t² ≤ 0.0097, the first term left out is below 1e-19, its second
/// derivative in θ below 1e-17.
const ARCTAN: [f64; 9] = {
    let mut terms = [1.0; 9];
    let mut j = 1;
    while j < terms.len() {
        let sign = if j.is_multiple_of(2) { 1.0 } else { -1.0 };
        terms[j] = sign / (2 * j + 1) as f64;
        j += 1;
    }
    terms
};

/// The rotation vector ω of R = exp ω^ with |ω| ≤ π.
///
/// ```math
/// q = \bigl(\cos\tfrac\theta2, \sin\tfrac\theta2\,e\bigr), \qquad
/// u_4 = \tan\tfrac\theta4\,e = \frac{\mathrm{vec}\,q}{1 + \mathrm{re}\,q}, \qquad
/// u_{2n} = \frac{u_n}{1 + \sqrt{1 + |u_n|^2}}, \qquad
/// \omega = 32\,u_{32}\,\frac{\arctan|u_{32}|}{|u_{32}|}
/// ```
///
/// Halving the angle until the series of arctan is short has no branch and no division by θ, so the derivatives hold at R = I
/// as everywhere. The quaternion is read off the row with the largest diagonal (Shepperd 1978), which keeps the axis
/// right up to θ = π. There ω and −ω are the same rotation and either is returned.
///
/// `rotation` must be a rotation to rounding; nothing is checked. NaN gives NaN.
///
/// ```
/// use hyperrod::lie::so3;
/// use nalgebra::Vector3;
///
/// let omega = Vector3::new(0.3, -2.0, 1e-9);
/// assert!((so3::log(&so3::exp(&omega)) - omega).norm() < 1e-14);
/// ```
pub fn log<D: Scalar>(rotation: &Matrix3<D>) -> Vector3<D> {
    let (w, v) = quaternion_direction(rotation);
    let v_squared = v.dot(&v);
    // u = v / scale and z = |u|², halved thrice
    let mut scale = w + (w * w + v_squared).sqrt();
    let mut z = v_squared / (scale * scale);
    for _ in 0..3 {
        let factor = (z + 1.0).sqrt() + 1.0;
        z /= factor * factor;
        scale *= factor;
    }
    v * (horner(&ARCTAN, z) * 32.0 / scale)
}

/// A positive multiple of the quaternion (w, v) with w ≥ 0: the row of 4 q qᵀ with the largest diagonal.
fn quaternion_direction<D: Scalar>(r: &Matrix3<D>) -> (D, Vector3<D>) {
    let (xx, yy, zz) = (r[(0, 0)], r[(1, 1)], r[(2, 2)]);
    let (xy, yz, zx) = (r[(0, 1)] + r[(1, 0)], r[(1, 2)] + r[(2, 1)], r[(2, 0)] + r[(0, 2)]);
    let skew = twice_vee(r);
    let trace = xx + yy + zz;
    let largest = xx.re().max(yy.re()).max(zz.re());
    let (w, v) = if trace.re() >= largest {
        (trace + 1.0, skew)
    } else if xx.re() >= largest {
        (skew.x, Vector3::new(xx - yy - zz + 1.0, xy, zx))
    } else if yy.re() >= largest {
        (skew.y, Vector3::new(xy, yy - zz - xx + 1.0, yz))
    } else {
        (skew.z, Vector3::new(zx, yz, zz - xx - yy + 1.0))
    };
    if w.re() < 0.0 { (-w, -v) } else { (w, v) }
}

/// The derivative of exp, written to the left of the rotation.
///
/// ```math
/// \delta(\exp\hat\omega)\,\exp(-\hat\omega) = (\mathrm{dexp}_\omega\,\delta\omega)^\wedge, \qquad
/// \mathrm{dexp}_\omega = \sum_k \frac{\hat\omega^k}{(k+1)!}
///   = \frac{\sin\theta}{\theta} I + \frac{1-\cos\theta}{\theta^2}\,\hat\omega + \frac{\theta-\sin\theta}{\theta^3}\,\omega\omega^T
/// ```
///
/// To the right, `exp(ω)⁻¹ δexp(ω)` is `dexp(-ω) δω`, and `dexp(-ω)` is the transpose. Source: Iserles et al. (2000), §2 and App. B.
///
/// ```
/// use hyperrod::lie::so3;
/// use nalgebra::{Matrix3, Vector3};
///
/// let omega = Vector3::new(0.3, -2.0, 1.0);
/// assert!((so3::dexp(&omega) * so3::dexp_inv(&omega) - Matrix3::identity()).norm() < 1e-14);
/// ```
#[inline]
pub fn dexp<D: Scalar>(omega: &Vector3<D>) -> Matrix3<D> {
    let [coefficients, _] = dexp_coefficients(omega.dot(omega));
    isotropic(&coefficients, omega)
}

/// The inverse of [`dexp`], for |ω| < 2π, where it is singular.
///
/// ```math
/// \mathrm{dexp}_\omega^{-1} = \sum_k \frac{B_k}{k!}\,\hat\omega^k
///   = a I - \tfrac12\,\hat\omega + \frac{1-a}{\theta^2}\,\omega\omega^T, \qquad a = \tfrac\theta2\cot\tfrac\theta2
/// ```
///
/// Source: Iserles et al. (2000), §2 and App. B.
#[inline]
pub fn dexp_inv<D: Scalar>(omega: &Vector3<D>) -> Matrix3<D> {
    let [coefficients, _] = dexp_inv_coefficients(omega.dot(omega));
    isotropic(&coefficients, omega)
}

/// a I + b ω^ + c ω ωᵀ: every function of ω^ has this form.
#[inline]
pub(super) fn isotropic<D: Scalar>(&[a, b, c]: &[D; 3], omega: &Vector3<D>) -> Matrix3<D> {
    let [x, y, z] = [omega.x, omega.y, omega.z];
    let (bx, by, bz) = (x * b, y * b, z * b);
    let (cx, cy, cz) = (x * c, y * c, z * c);
    let (xy, yz, zx) = (cx * y, cy * z, cz * x);
    from_parts(
        &Vector3::new(cx * x + a, cy * y + a, cz * z + a),
        &Vector3::new(yz, zx, xy),
        &Vector3::new(bx, by, bz),
    )
}

/// The derivative of [`isotropic`] in direction ν, given its coefficients and their derivatives in x = θ².
#[inline]
pub(super) fn isotropic_derivative<D: Scalar>(
    [value, slope]: &[[D; 3]; 2],
    omega: &Vector3<D>,
    nu: &Vector3<D>,
) -> Matrix3<D> {
    let [_, b, c] = *value;
    let d_x = omega.dot(nu) * 2.0;
    // c (ν ωᵀ + ω νᵀ) + c′ dx ω ωᵀ = k ωᵀ + ω kᵀ with k = c ν + c′ dx ω / 2
    let k = nu * c + omega * (slope[2] * d_x * 0.5);
    let skew = nu * b + omega * (slope[1] * d_x);
    let twice_k = k * D::from(2.0);
    let diagonal = omega.component_mul(&twice_k).add_scalar(slope[0] * d_x);
    let off_diagonal = Vector3::new(
        k.y * omega.z + omega.y * k.z,
        k.z * omega.x + omega.z * k.x,
        k.x * omega.y + omega.x * k.y,
    );
    from_parts(&diagonal, &off_diagonal, &skew)
}

/// The matrix with diagonal d, symmetric part o off it (yz, zx, xy), and skew part s^.
#[inline]
fn from_parts<D: Scalar>(d: &Vector3<D>, o: &Vector3<D>, s: &Vector3<D>) -> Matrix3<D> {
    let (plus, minus) = (o + s, o - s);
    Matrix3::new(d.x, minus.z, plus.y, plus.z, d.y, minus.x, minus.y, plus.x, d.z)
}
