//! Poses SE(3): exp, log and their derivatives, on [`Twist`] and [`Pose`].
//!
//! **Conventions, and where books differ.** Twists are ordered (angular, linear), poses move in body frame, g′ = g ξ^. [`dexp`] is
//! the series Σ adᵏ/(k+1)!, the spatial derivative δg g⁻¹ of g = exp Ω^, as in Iserles et al. (2000, *Lie-group methods*, Acta Numerica 9); the body derivative is
//! g⁻¹ δg = (dexp_{−Ω} δΩ)^. Solà et al. (2018) and Barfoot (2017) call them left and right Jacobian, J_l = dexp_Ω and
//! J_r = dexp_{−Ω}, and so does Chirikjian (2012); but Solà, Barfoot and Murray, Li & Sastry (1994) put the *linear* part first, so
//! their 6×6 matrices are ours with both block rows and block columns swapped. Iserles et al. solve Y′ = A Y, which
//! moves from the left: in their Magnus series every bracket changes sign to serve g′ = g ξ^.
//!
//! A 6×6 function of ad is [[A, 0], [B, A]] with A that function of ω^ and B the derivative of A in the direction ν: se(3) is so(3)
//! over numbers a + ε b with ε² = 0. That is how the lower blocks below come about.

use super::coefficients::{dexp_coefficients, dexp_inv_coefficients};
use super::so3::{self, isotropic, isotropic_derivative};
use super::{Pose, Twist, TwistMap};
use crate::scalar::Scalar;

/// The pose reached by moving one unit along a constant twist.
///
/// ```math
/// \exp\hat\Omega = (\exp\hat\omega,\; \mathrm{dexp}_\omega\,\nu), \qquad \Omega = (\omega, \nu)
/// ```
///
/// Source: Murray, Li & Sastry (1994), Eq. (2.36).
///
/// ```
/// use hyperrod::lie::{Twist, se3};
/// use nalgebra::Vector3;
///
/// // a half circle of length 1
/// let g = se3::exp(&Twist::new(Vector3::new(0.0, std::f64::consts::PI, 0.0), Vector3::z()));
/// assert!((g.position.x - 2.0 / std::f64::consts::PI).abs() < 1e-15);
/// ```
#[inline]
pub fn exp<D: Scalar>(twist: &Twist<D>) -> Pose<D> {
    let omega = &twist.angular;
    let [c0, c1, c2, c3, ..] = super::stumpff(omega.dot(omega));
    // dexp_ω ν without its matrix
    let position =
        twist.linear * c1 + omega.cross(&twist.linear) * c2 + omega * (omega.dot(&twist.linear) * c3);
    Pose::new(isotropic(&[c0, c1, c2], omega), position)
}

/// The twist Ω of g = exp Ω^ with |ω| ≤ π; the inverse of [`exp`].
///
/// ```math
/// \log(R, p) = (\omega,\; \mathrm{dexp}_\omega^{-1}\,p), \qquad \omega = \log R
/// ```
///
/// At a half turn the axis may come out either way: see [`so3::log`].
///
/// ```
/// use hyperrod::lie::{Twist, se3};
///
/// let omega = Twist::from_array([0.3, -2.0, 1e-9, 10.0, 0.0, 1.0]);
/// assert!((se3::log(&se3::exp(&omega)) - omega).to_vector().norm() < 1e-13);
/// ```
pub fn log<D: Scalar>(pose: &Pose<D>) -> Twist<D> {
    let omega = so3::log(&pose.rotation);
    Twist::new(omega, so3::dexp_inv(&omega) * pose.position)
}

/// The derivative of exp, written to the left of the pose.
///
/// ```math
/// \delta(\exp\hat\Omega)\,\exp(-\hat\Omega) = (\mathrm{dexp}_\Omega\,\delta\Omega)^\wedge, \qquad
/// \mathrm{dexp}_\Omega = \sum_k \frac{\mathrm{ad}_\Omega^k}{(k+1)!} = \begin{bmatrix} A & 0 \\ B & A \end{bmatrix}, \qquad
/// A = \mathrm{dexp}_\omega, \quad B = \frac{\partial A}{\partial\omega}[\nu]
/// ```
///
/// To the right, in body frame, `exp(Ω)⁻¹ δexp(Ω)` is `dexp(-Ω) δΩ`. B is the Q of Barfoot (2017), Eq. (7.86), written so that
/// it and its derivatives hold at ω = 0.
///
/// ```
/// use hyperrod::lie::{Twist, se3};
/// use nalgebra::Matrix6;
///
/// let omega = Twist::from_array([0.3, -2.0, 1.0, 1.0, 0.0, 1.0]);
/// let product = (se3::dexp(&omega) * se3::dexp_inv(&omega)).to_matrix();
/// assert!((product - Matrix6::identity()).norm() < 1e-14);
/// ```
#[inline]
pub fn dexp<D: Scalar>(twist: &Twist<D>) -> TwistMap<D> {
    function_of_ad(&dexp_coefficients(twist.angular.dot(&twist.angular)), twist)
}

/// The inverse of [`dexp`], for |ω| < 2π, where it is singular.
///
/// ```math
/// \mathrm{dexp}_\Omega^{-1} = \sum_k \frac{B_k}{k!}\,\mathrm{ad}_\Omega^k = \begin{bmatrix} A & 0 \\ B & A \end{bmatrix}, \qquad
/// A = \mathrm{dexp}_\omega^{-1}, \quad B = \frac{\partial A}{\partial\omega}[\nu]
/// ```
///
/// Source: Iserles et al. (2000), §2.
#[inline]
pub fn dexp_inv<D: Scalar>(twist: &Twist<D>) -> TwistMap<D> {
    function_of_ad(&dexp_inv_coefficients(twist.angular.dot(&twist.angular)), twist)
}

/// [[A, 0], [B, A]] from the coefficients of A and their derivatives.
#[inline]
fn function_of_ad<D: Scalar>(coefficients: &[[D; 3]; 2], twist: &Twist<D>) -> TwistMap<D> {
    TwistMap {
        diagonal: isotropic(&coefficients[0], &twist.angular),
        lower: isotropic_derivative(coefficients, &twist.angular, &twist.linear),
    }
}
