//! Functions of the principal stretches of any deformation, without eigenvalues: smooth where stretches coalesce.
//!
//! C = FᵀF is taken to the identity by square roots, 2⁻ᵏ ln C follows from a series, and no root is taken of anything that vanishes at rest.
//! Every step is arithmetic, so that dual numbers go through it.

use nalgebra::Matrix3;

use crate::scalar::Scalar;

/// Square roots taken: C^(1/16) is within 5 % of the identity for stretches up to 1.5 and within 20 % up to 4.
const ROOTS: usize = 4;

/// Terms of artanh and exp series: a ratio of 0.1 (stretches up to 4) leaves 0.01¹⁰.
const TERMS: usize = 12;

/// Newton steps of a square root, quadratic from a start that is off by a factor 4 at most for stretches up to 4.
const NEWTON: usize = 8;

/// Σ λᵢ^α − 3 − α ln J.
pub(super) fn stretch_powers_excess<D: Scalar>(h: &Matrix3<D>, alpha: f64) -> D {
    // eˣ − 1 − x of the matrix α ln U, whose trace is α ln J: squarings of a small one keep the digits,
    // with e^{2x} − 1 − 2x = (eˣ − 1)² + 2(eˣ − 1 − x)
    let log = log_stretch(h) * D::from(alpha / (1 << ROOTS) as f64);
    let identity = Matrix3::<D>::identity();
    let mut sum = identity;
    for n in (3..TERMS + 3).rev() {
        sum = log * sum * D::from(1.0 / n as f64) + identity;
    }
    let mut excess = log * log * sum * D::from(0.5);
    let mut twice = log;
    for _ in 0..ROOTS {
        let grown = excess + twice;
        excess = grown * grown + excess * D::from(2.0);
        twice *= D::from(2.0);
    }
    excess.trace()
}

/// Σ (ln λᵢ)².
pub(super) fn log_strain_squared<D: Scalar>(h: &Matrix3<D>) -> D {
    let log = log_stretch(h);
    (log * log).trace()
}

/// ln U = ½ ln C.
fn log_stretch<D: Scalar>(h: &Matrix3<D>) -> Matrix3<D> {
    let identity = Matrix3::<D>::identity();
    let mut excess = h + h.transpose() + h.transpose() * h;
    for _ in 0..ROOTS {
        excess = root_excess(&excess);
    }
    // ln A = 2 artanh((A − I)(A + I)⁻¹)
    let ratio = excess * inverse(&(excess + identity * D::from(2.0)));
    let square = ratio * ratio;
    let mut sum = Matrix3::<D>::zeros();
    for n in (0..TERMS).rev() {
        sum = square * sum + identity * D::from(1.0 / (2 * n + 1) as f64);
    }
    ratio * sum * D::from((1 << ROOTS) as f64)
}

/// √(I + E) − I, by Newton's method for X² + 2X = E: X ← X + ½(I + X)⁻¹(E − 2X − X²), which commutes with E throughout.
fn root_excess<D: Scalar>(e: &Matrix3<D>) -> Matrix3<D> {
    let identity = Matrix3::<D>::identity();
    let half = D::from(0.5);
    let mut x = e * half * inverse(&(identity + e * D::from(0.25)));
    for _ in 0..NEWTON {
        let residual = e - x * D::from(2.0) - x * x;
        x += inverse(&(identity + x)) * residual * half;
    }
    x
}

/// The inverse by cofactors.
fn inverse<D: Scalar>(m: &Matrix3<D>) -> Matrix3<D> {
    let minor = |i: usize, k: usize| {
        let ([a, b], [c, d]) = ([(i + 1) % 3, (i + 2) % 3], [(k + 1) % 3, (k + 2) % 3]);
        m[(a, c)] * m[(b, d)] - m[(a, d)] * m[(b, c)]
    };
    let cofactor = Matrix3::from_fn(minor);
    let det = m[(0, 0)] * cofactor[(0, 0)] + m[(0, 1)] * cofactor[(0, 1)] + m[(0, 2)] * cofactor[(0, 2)];
    cofactor.transpose() * (D::one() / det)
}
