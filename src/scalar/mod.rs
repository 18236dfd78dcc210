//! The one number a law is written over.
//!
//! [`Scalar`] is the bound every generic function of this crate uses: an [`f64`], or any (hyper-)dual number of
//! [`num_dual`] over `f64`. What lives here knows about differentiation and nothing about mechanics: no strain,
//! no section, no rod.

mod primitives;

use num_dual::DualNum;

pub(crate) use primitives::from_taylor;
pub use primitives::{arsinh_sqrt_squared, cosh_multiple_m1, exp_m1_minus_x, pow, pow_1p_m1, x_minus_ln_1p};

/// A real number or any dual number over `f64`, passed by value.
///
/// Implemented for every `DualNum<Primitive = f64> + Copy`, so one generic function gives its value (`f64`), gradient
/// (`DualSVec64`), Hessian (`Dual2SVec64`) or mixed derivatives (`HyperDualSVec64`).
///
/// ```
/// use hyperrod::Scalar;
/// use num_dual::Dual2_64;
///
/// fn energy<D: Scalar>(strain: D) -> D {
///     strain * strain * 0.5 // numbers go on the right: `0.5 * strain` does not compile for a generic `D`
/// }
///
/// let u = energy(Dual2_64::from_re(3.0).derivative());
/// assert_eq!((u.re, u.v1, u.v2), (4.5, 3.0, 1.0));
/// ```
pub trait Scalar: DualNum<Primitive = f64> + Copy {}

impl<D: DualNum<Primitive = f64> + Copy> Scalar for D {}
