use nalgebra::{Const, U1, Vector6};
use num_dual::{Dual2SVec64, DualSVec64};

use super::CrossSection;
use crate::error::{Error, Result};
use crate::lie::{Strain, Wrench};
use crate::material::{Request, Response, Station};
use crate::scalar::Scalar;

/// A section given by its energy per length, written directly in the strain of the rod: U(Δξ, s), J/m.
///
/// For what no energy density over the section describes: ribbons, measured curves, cables. Wrap it in [`Resultants`] to make it a
/// [`CrossSection`]; wrench, tangent and rate follow by differentiation in six variables, or seven with s.
///
/// ```
/// use hyperrod::section::{CrossSection, Resultant, Resultants};
/// use hyperrod::material::Station;
/// use hyperrod::{Scalar, Strain};
///
/// /// A cable that bends the easier the more it is bent.
/// struct Cable;
///
/// impl Resultant for Cable {
///     fn energy<D: Scalar>(&self, strain: &Strain<D>, _s: D) -> D {
///         let bending = strain.angular.x * strain.angular.x + strain.angular.y * strain.angular.y;
///         let twist = strain.angular.z * strain.angular.z;
///         let stretch = strain.linear.dot(&strain.linear);
///         ((bending + 1.0).sqrt() - 1.0) * 0.02 + twist * 0.01 + stretch * 1e4
///     }
/// }
///
/// # fn main() -> hyperrod::Result<()> {
/// let tangent = Resultants(Cable).tangent(&Station::straight(0.0), &Strain::zero())?;
/// assert_eq!((tangent[(0, 0)], tangent[(2, 2)]), (0.02, 0.02));
/// # Ok(()) }
/// ```
pub trait Resultant: Send + Sync {
    /// The strain energy per length, J/m.
    fn energy<D: Scalar>(&self, strain: &Strain<D>, s: D) -> D;

    /// Where the energy is defined, in words for an error message.
    fn domain(&self) -> &'static str {
        "finite"
    }
}

/// A [`Resultant`] as a [`CrossSection`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultants<R>(pub R);

impl<R: Resultant> CrossSection for Resultants<R> {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        crate::material::check_strain(strain, at.s)?;
        let response = match request {
            Request::Energy => Response { energy: self.0.energy(strain, at.s), ..Response::zero() },
            Request::Wrench => {
                let xi = strain.to_array();
                let xi = std::array::from_fn(|i| DualSVec64::<6>::from_re(xi[i]).derivative(i));
                let u = self.0.energy(&Strain::from_array(xi), at.s.into());
                let gradient: Vector6<f64> = u.eps.unwrap_generic(Const::<6>, U1);
                Response { energy: u.re, wrench: Wrench::from_vector(&gradient), ..Response::zero() }
            }
            Request::Tangent => differentiate::<6, _>(&self.0, strain, at.s),
            Request::Rate => differentiate::<7, _>(&self.0, strain, at.s),
        };
        let place =
            |quantity, value| Error::InvalidAt { quantity, value, requirement: self.0.domain(), s: at.s };
        if !response.energy.is_finite() {
            return Err(place("energy per length", response.energy));
        }
        if !response.is_finite() {
            return Err(place("wrench or tangent of the section", f64::NAN));
        }
        Ok(response)
    }
}

/// Value, gradient and Hessian in Δξ; with seven variables also the mixed derivative in s.
fn differentiate<const N: usize, R: Resultant>(law: &R, strain: &Strain, s: f64) -> Response {
    let values = strain.to_array();
    let variable = |value, index| Dual2SVec64::<N>::from_re(value).derivative(index);
    let xi = std::array::from_fn(|i| variable(values[i], i));
    let s = if N == 7 { variable(s, 6) } else { s.into() };
    let u = law.energy(&Strain::from_array(xi), s);
    let gradient = u.v1.unwrap_generic(U1, Const::<N>);
    let hessian = u.v2.unwrap_generic(Const::<N>, Const::<N>);
    let mut response = Response {
        energy: u.re,
        wrench: Wrench::from_array(std::array::from_fn(|i| gradient[i])),
        ..Response::zero()
    };
    response.tangent.copy_from(&hessian.fixed_view::<6, 6>(0, 0));
    if N == 7 {
        response.wrench_rate = Wrench::from_array(std::array::from_fn(|i| hessian[(i, 6)]));
    }
    response
}
