use nalgebra::{Const, U1, Vector3};
use num_dual::Dual2SVec64;

use super::differentiate::{Fibre, unpack};
use super::integrate::{add_sectional, finite, inadmissible, integrate_local, moving, variables};
use super::kinematics::{Deformation, Invariants, Point};
use super::law::Material;
use super::response::{Points, Request, Response, Station, check_strain};
use crate::error::Result;
use crate::lie::{Strain, Wrench};

/// The dual number a [`local`] or [`isotropic`] closure is written over: variables (a, b, e, s), second order.
pub type LocalJet = Dual2SVec64<4>;

/// The dual number a [`sectional`] closure is written over: variables (Δξ, s), second order.
pub type SectionalJet = Dual2SVec64<7>;

const DOMAIN: &str = "where the energy density is finite";

/// A law made from a closure by [`isotropic`].
#[derive(Clone, Copy)]
pub struct IsotropicClosure<F>(F);

/// A law made from a closure by [`local`].
#[derive(Clone, Copy)]
pub struct LocalClosure<F>(F);

/// A law made from a closure by [`sectional`].
#[derive(Clone, Copy)]
pub struct SectionalClosure<F>(F);

/// A law from a real closure u(I₁−3, I₂−3, J−1; x, y, s): captures anything, types inferred, and can be boxed.
///
/// It always pays for all four variables (a, b, e, s); [`isotropic!`](crate::isotropic!) pays for what is asked.
///
/// ```
/// use hyperrod::material::isotropic;
///
/// let shear_modulus = 60e3; // Pa
/// let rubber = isotropic(move |i, _| (i.i1_excess() * 0.5 + i.j() * i.j()) * shear_modulus);
/// ```
pub fn isotropic<F>(energy_density: F) -> IsotropicClosure<F>
where
    F: Fn(&Invariants<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    IsotropicClosure(energy_density)
}

/// A law from a real closure u(F; x, y, s). See [`isotropic`].
pub fn local<F>(energy_density: F) -> LocalClosure<F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    LocalClosure(energy_density)
}

/// A law from a real closure u(Δξ; x, y, s). See [`isotropic`].
///
/// ```
/// use hyperrod::material::sectional;
///
/// let young = 1e6; // Pa
/// let bending_and_stretch = sectional(move |strain, at| {
///     let e = strain.linear.z + strain.angular.x * at.y - strain.angular.y * at.x;
///     e * e * (0.5 * young)
/// });
/// ```
pub fn sectional<F>(energy_density: F) -> SectionalClosure<F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet + Send + Sync,
{
    SectionalClosure(energy_density)
}

/// γ and the point as functions of the four variables (a, b, e, s).
fn local_variables(fibre: &Fibre) -> (Vector3<LocalJet>, Point<LocalJet>) {
    let ds = LocalJet::from_re(0.0).derivative(3);
    let gamma = [0, 1, 2]
        .map(|i| LocalJet::from_re(fibre.gamma[i]).derivative(i) + ds * fibre.gamma_rate[i]);
    (Vector3::from(gamma), moving(&fibre.point, fibre.point_rate[0], fibre.point_rate[1]))
}

impl<F> Material for IsotropicClosure<F>
where
    F: Fn(&Invariants<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let respond = |fibre: &Fibre, _| {
            let (gamma, point) = local_variables(fibre);
            unpack(&(self.0)(&Deformation::from_gamma(gamma).invariants(), &point))
        };
        integrate_local(respond, DOMAIN, points, at, strain, request)
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }
}

impl<F> Material for LocalClosure<F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let respond = |fibre: &Fibre, _| {
            let (gamma, point) = local_variables(fibre);
            unpack(&(self.0)(&Deformation::from_gamma(gamma), &point))
        };
        integrate_local(respond, DOMAIN, points, at, strain, request)
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }
}

impl<F> Material for SectionalClosure<F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet + Send + Sync,
{
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        _request: Request,
    ) -> Result<Response> {
        check_strain(strain, at.s)?;
        let mut total = Response::zero();
        for q in 0..points.len() {
            let (x, y, w) = (points.x[q], points.y[q], points.weight[q]);
            let [dx, dy, dw] = points.rate(q);
            let u = (self.0)(&variables::<7>(strain), &moving(&Point { x, y, s: at.s }, dx, dy));
            if !u.re.is_finite() {
                return Err(inadmissible("energy density", u.re, DOMAIN, at.s, x, y));
            }
            add_sectional(&mut total, &u, w);
            let g = u.v1.unwrap_generic(U1, Const::<7>);
            let h = u.v2.unwrap_generic(Const::<7>, Const::<7>);
            total.wrench_rate += Wrench::from_array(std::array::from_fn(|i| w * h[(i, 6)] + dw * g[i]));
        }
        finite(total, at)
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }
}
