//! Functions of the principal stretches of any deformation, smooth where stretches coalesce.
//!
//! tr g(C) of C = FᵀF = C₀ + δ with its real part C₀ = Q diag(xᵢ) Qᵀ, and δ nilpotent in a dual number, is to second order
//!
//! Σ g(xᵢ) + Σ g′(xᵢ) δᵢᵢ + ½ Σ g′[xᵢ, xⱼ] δᵢⱼ δⱼᵢ in the basis Q,
//!
//! where the divided difference g′[x, y] has a limit as x → y, and is computed without one.

use nalgebra::{Matrix3, SymmetricEigen};

use crate::scalar::{Scalar, exp_m1_minus_x};

/// A function g of a squared stretch x = 1 + e, and what its second-order expansion needs.
trait Spectral {
    fn value(&self, e: f64) -> f64;
    /// g′(x).
    fn slope(&self, e: f64) -> f64;
    /// (g′(x) − g′(y)) / (x − y).
    fn divided(&self, e: f64, f: f64) -> f64;
}

/// x^β − 1 − β ln x.
struct PowerExcess(f64);

/// (½ ln x)².
struct LogSquared;

/// (ln x − ln y)/(x − y).
fn mean_of_inverse(e: f64, f: f64) -> f64 {
    let t = (e - f) / (1.0 + f);
    if t == 0.0 { 1.0 / (1.0 + f) } else { t.ln_1p() / (e - f) }
}

impl Spectral for PowerExcess {
    fn value(&self, e: f64) -> f64 {
        exp_m1_minus_x(self.0 * e.ln_1p())
    }

    fn slope(&self, e: f64) -> f64 {
        self.0 * (self.0 * e.ln_1p()).exp_m1() / (1.0 + e)
    }

    fn divided(&self, e: f64, f: f64) -> f64 {
        // of β(x^β − 1)/x: β (y (x^β − y^β)/(x − y) − (y^β − 1)) / (x y)
        let (x, y, beta) = (1.0 + e, 1.0 + f, self.0);
        let (power, growth) = (y.powf(beta), beta * ((e - f) / y).ln_1p());
        let difference = if e == f { beta * power / y } else { power * growth.exp_m1() / (e - f) };
        beta * (y * difference - (beta * f.ln_1p()).exp_m1()) / (x * y)
    }
}

impl Spectral for LogSquared {
    fn value(&self, e: f64) -> f64 {
        0.25 * e.ln_1p().powi(2)
    }

    fn slope(&self, e: f64) -> f64 {
        0.5 * e.ln_1p() / (1.0 + e)
    }

    fn divided(&self, e: f64, f: f64) -> f64 {
        let (x, y) = (1.0 + e, 1.0 + f);
        0.5 * (y * mean_of_inverse(e, f) - f.ln_1p()) / (x * y)
    }
}

/// Σ λᵢ^α − 3 − α ln J.
pub(super) fn stretch_powers_excess<D: Scalar>(h: &Matrix3<D>, alpha: f64) -> D {
    trace(h, &PowerExcess(0.5 * alpha))
}

/// Σ (ln λᵢ)².
pub(super) fn log_strain_squared<D: Scalar>(h: &Matrix3<D>) -> D {
    trace(h, &LogSquared)
}

/// Σ g(λᵢ²), with first and second derivatives; a number that carries third ones gets NaN, not a wrong answer.
fn trace<D: Scalar>(h: &Matrix3<D>, g: &impl Spectral) -> D {
    if D::NDERIV > 2 {
        return D::from(f64::NAN);
    }
    let strain = h + h.transpose() + h.transpose() * h;
    let real = strain.map(|v| v.re());
    if real.iter().any(|v| !v.is_finite()) {
        return D::from(f64::NAN);
    }
    let eigen = SymmetricEigen::new(real);
    let (x, basis) = (eigen.eigenvalues, eigen.eigenvectors.map(D::from));
    let change = basis.transpose() * (strain - real.map(D::from)) * basis;
    let mut sum = D::from((0..3).map(|i| g.value(x[i])).sum::<f64>());
    for i in 0..3 {
        sum += change[(i, i)] * g.slope(x[i]);
        for k in 0..3 {
            sum += change[(i, k)] * change[(k, i)] * (0.5 * g.divided(x[i], x[k]));
        }
    }
    sum
}
