//! The one number a law is written over, and the jet the engine evaluates it with.
//!
//! [`Scalar`] is the bound every generic function of this crate uses: an [`f64`], any (hyper-)dual number of [`num_dual`] over `f64`, or the
//! packed multi-lane [`Jet`]. What lives here knows about differentiation and vector registers, and nothing about mechanics: no
//! strain, no section, no rod.

mod jet;
pub(crate) mod lane;
mod primitives;

use nalgebra::Const;
use num_dual::{
    Dual, Dual2, Dual2SVec, Dual3, DualNum, DualSVec, HyperDual, HyperDualVec, HyperHyperDual, Real,
};

pub use jet::Jet;
pub(crate) use jet::lanes_disagreed;
pub use lane::{Kernel, Lane, Portable, dispatch};
pub use primitives::{
    Univariate, arsinh_sqrt_squared, cosh_multiple_m1, exp_m1_minus_x, pow, pow_1p_m1, x_minus_ln_1p,
};

/// A real number or any dual number over `f64`, passed by value.
///
/// One generic function gives its value (`f64`), gradient (`DualSVec64`), Hessian (`Dual2SVec64`) or mixed derivatives
/// (`HyperDualSVec64`), and runs on the engine's own [`Jet`].
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
///
/// A dual number of your own joins with an empty `impl Scalar for MyDual {}`.
pub trait Scalar: DualNum<Primitive = f64> + Copy {
    /// f(self) for a function given by its Taylor coefficients: the way to add a primitive whose derivatives must not cancel.
    #[inline]
    fn apply(self, f: &impl Univariate) -> Self {
        primitives::from_taylor(self, f)
    }
}

impl Scalar for f64 {}
impl<T: Scalar> Scalar for Real<T> {}
impl<T: Scalar> Scalar for Dual<T> {}
impl<T: Scalar> Scalar for Dual2<T> {}
impl<T: Scalar> Scalar for Dual3<T> {}
impl<T: Scalar> Scalar for HyperDual<T> {}
impl<T: Scalar> Scalar for HyperHyperDual<T> {}
impl<T: Scalar, const N: usize> Scalar for DualSVec<T, N> {}
impl<T: Scalar, const N: usize> Scalar for Dual2SVec<T, N> {}
impl<T: Scalar, const M: usize, const N: usize> Scalar for HyperDualVec<T, Const<M>, Const<N>> {}

impl<L: Lane, const N: usize, const M: usize> Scalar for Jet<L, N, M> {
    #[inline(always)]
    fn apply(self, f: &impl Univariate) -> Self {
        let x = self.value;
        self.chain(f.taylor(x, 0), f.taylor(x, 1), f.taylor(x, 2) * L::splat(2.0))
    }
}
