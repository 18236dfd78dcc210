//! Sums over the points of a section: U, Ψ, ∂Ψ/∂Δξ and Ψ′ from the derivatives at the points.

use nalgebra::{Const, Matrix6, U1, Vector6};
use num_dual::{Dual2SVec64, DualSVec64};

use super::differentiate::{Fibre, FibreResponse};
use super::kinematics::Point;
use super::law::Sectional;
use super::response::{Points, Request, Response, Station, check_strain};
use crate::error::{Error, Result};
use crate::lie::{Strain, Wrench};

/// Sums a local law. With B the constant 3×6 matrix of γ = B Δξ / j and j the volume of the reference per dA ds,
///
/// U = Σ w j u, Ψ = Σ w Bᵀ ∂u/∂γ, ∂Ψ/∂Δξ = Σ (w/j) Bᵀ ∂²u/∂γ² B, Ψ′ = Σ (w′ Bᵀ + w B′ᵀ) ∂u/∂γ + w Bᵀ (∂u/∂γ)′.
///
/// For a reference with initial curvature the deformation gradient is [e₁ e₂ γ_tot][e₁ e₂ γ*]⁻¹ = I + (Bξ − Bξ*) ⊗ e₃ / j, again one column.
pub(super) fn integrate_local(
    respond: impl Fn(&Fibre, Request) -> FibreResponse,
    domain: &'static str,
    points: &Points,
    at: &Station,
    strain: &Strain,
    request: Request,
) -> Result<Response> {
    check_strain(strain, at.s)?;
    let mut total = Response::zero();
    for q in 0..points.len() {
        let (x, y, w) = (points.x[q], points.y[q], points.weight[q]);
        let [dx, dy, dw] = points.rate(q);
        let (j, dj) = at.reference.volume(x, y, [dx, dy]);
        if !(j > 0.0) {
            let requirement = "positive: the section reaches the centre of curvature of the reference";
            return Err(inadmissible("volume of the reference", j, requirement, at.s, x, y));
        }
        let fibre = fibre(strain, at.s, [x, y], [dx, dy], j, dj);
        if !(fibre.gamma[2] > -1.0) {
            return Err(inadmissible("J", 1.0 + fibre.gamma[2], "positive", at.s, x, y));
        }
        let local = respond(&fibre, request);
        if !local.energy.is_finite() {
            return Err(inadmissible("energy density", local.energy, domain, at.s, x, y));
        }
        total.energy += w * j * local.energy;
        if request >= Request::Wrench {
            add_wrench(&mut total.wrench, &local.stress, x, y, w);
        }
        if request >= Request::Tangent {
            add_tangent(&mut total.tangent, &local.stiffness, x, y, w / j);
        }
        if request >= Request::Rate {
            add_wrench(&mut total.wrench_rate, &local.stress, x, y, dw);
            add_wrench(&mut total.wrench_rate, &local.stress_rate, x, y, w);
            let [g_a, g_b, g_e] = local.stress;
            total.wrench_rate.moment.x += w * dy * g_e;
            total.wrench_rate.moment.y -= w * dx * g_e;
            total.wrench_rate.moment.z += w * (dx * g_b - dy * g_a);
        }
    }
    total.tangent.fill_lower_triangle_with_upper_triangle();
    finite(total, at)
}

/// γ = B Δξ / j at a point, and its derivative in s at fixed Δξ.
fn fibre(strain: &Strain, s: f64, [x, y]: [f64; 2], rate: [f64; 2], j: f64, dj: f64) -> Fibre {
    let (omega, nu) = (strain.angular, strain.linear);
    let [dx, dy] = rate;
    let gamma = [nu.x - omega.z * y, nu.y + omega.z * x, nu.z + omega.x * y - omega.y * x].map(|g| g / j);
    let d_b = [-omega.z * dy, omega.z * dx, omega.x * dy - omega.y * dx];
    let gamma_rate = std::array::from_fn(|i| (d_b[i] - gamma[i] * dj) / j);
    Fibre { point: Point { x, y, s }, point_rate: rate, gamma, gamma_rate }
}

/// Ψ += w Bᵀ g.
#[inline]
fn add_wrench(wrench: &mut Wrench, [g_a, g_b, g_e]: &[f64; 3], x: f64, y: f64, w: f64) {
    wrench.moment.x += w * y * g_e;
    wrench.moment.y -= w * x * g_e;
    wrench.moment.z += w * (x * g_b - y * g_a);
    wrench.force.x += w * g_a;
    wrench.force.y += w * g_b;
    wrench.force.z += w * g_e;
}

/// K += w Bᵀ h B, upper triangle.
#[inline]
fn add_tangent(k: &mut Matrix6<f64>, h: &[f64; 6], x: f64, y: f64, w: f64) {
    let [aa, ab, ae, bb, be, ee] = h.map(|v| v * w);
    // rows of h taken to the twist about e₃: x h_b. − y h_a.
    let (za, zb, ze) = (x * ab - y * aa, x * bb - y * ab, x * be - y * ae);
    k[(0, 0)] += y * y * ee;
    k[(0, 1)] -= x * y * ee;
    k[(0, 2)] += y * ze;
    k[(0, 3)] += y * ae;
    k[(0, 4)] += y * be;
    k[(0, 5)] += y * ee;
    k[(1, 1)] += x * x * ee;
    k[(1, 2)] -= x * ze;
    k[(1, 3)] -= x * ae;
    k[(1, 4)] -= x * be;
    k[(1, 5)] -= x * ee;
    k[(2, 2)] += x * zb - y * za;
    k[(2, 3)] += za;
    k[(2, 4)] += zb;
    k[(2, 5)] += ze;
    k[(3, 3)] += aa;
    k[(3, 4)] += ab;
    k[(3, 5)] += ae;
    k[(4, 4)] += bb;
    k[(4, 5)] += be;
    k[(5, 5)] += ee;
}

/// Sums a section-level law u(Δξ, x, y), differentiated in six variables, and s as a seventh where Ψ′ is wanted.
pub(super) fn integrate_sectional<L: Sectional + ?Sized>(
    law: &L,
    points: &Points,
    at: &Station,
    strain: &Strain,
    request: Request,
) -> Result<Response> {
    check_strain(strain, at.s)?;
    let mut total = Response::zero();
    for q in 0..points.len() {
        let w = points.weight[q];
        let point = Point { x: points.x[q], y: points.y[q], s: at.s };
        let energy = match request {
            Request::Energy => {
                let u = law.energy_density(strain, &point);
                total.energy += w * u;
                u
            }
            Request::Wrench => {
                let xi = strain.to_array();
                let xi = std::array::from_fn(|i| DualSVec64::<6>::from_re(xi[i]).derivative(i));
                let u = law.energy_density(&Strain::from_array(xi), &point.cast());
                let g: Vector6<f64> = u.eps.unwrap_generic(Const::<6>, U1);
                total.energy += w * u.re;
                total.wrench += Wrench::from_vector(&(g * w));
                u.re
            }
            Request::Tangent => {
                let u = law.energy_density(&variables::<6>(strain), &point.cast());
                add_sectional(&mut total, &u, w);
                u.re
            }
            Request::Rate => {
                let [dx, dy, dw] = points.rate(q);
                let u = law.energy_density(&variables::<7>(strain), &moving(&point, dx, dy));
                add_sectional(&mut total, &u, w);
                let g = u.v1.unwrap_generic(U1, Const::<7>);
                let h = u.v2.unwrap_generic(Const::<7>, Const::<7>);
                total.wrench_rate +=
                    Wrench::from_array(std::array::from_fn(|i| w * h[(i, 6)] + dw * g[i]));
                u.re
            }
        };
        if !energy.is_finite() {
            return Err(inadmissible("energy density", energy, law.domain(), at.s, point.x, point.y));
        }
    }
    finite(total, at)
}

/// Δξ as the first six of `N` variables.
pub(super) fn variables<const N: usize>(strain: &Strain) -> Strain<Dual2SVec64<N>> {
    let xi = strain.to_array();
    Strain::from_array(std::array::from_fn(|i| Dual2SVec64::from_re(xi[i]).derivative(i)))
}

/// The point with s as the last of `N` variables.
pub(super) fn moving<const N: usize>(point: &Point, dx: f64, dy: f64) -> Point<Dual2SVec64<N>> {
    let ds = Dual2SVec64::<N>::from_re(0.0).derivative(N - 1);
    Point { x: ds * dx + point.x, y: ds * dy + point.y, s: ds + point.s }
}

/// Adds w times value, gradient and Hessian in the first six variables.
pub(super) fn add_sectional<const N: usize>(total: &mut Response, u: &Dual2SVec64<N>, w: f64) {
    let g = u.v1.clone().unwrap_generic(U1, Const::<N>);
    let h = u.v2.clone().unwrap_generic(Const::<N>, Const::<N>);
    total.energy += w * u.re;
    total.wrench += Wrench::from_array(std::array::from_fn(|i| w * g[i]));
    for i in 0..6 {
        for j in 0..6 {
            total.tangent[(i, j)] += w * h[(i, j)];
        }
    }
}

pub(super) fn inadmissible(
    quantity: &'static str,
    value: f64,
    requirement: &'static str,
    s: f64,
    x: f64,
    y: f64,
) -> Error {
    Error::Inadmissible { quantity, value, requirement, s, x, y }
}

/// Passes a response on if it is finite: a law may have a finite energy and an infinite slope.
pub(super) fn finite(response: Response, at: &Station) -> Result<Response> {
    if response.is_finite() {
        return Ok(response);
    }
    let value = response.tangent.norm() + response.wrench.to_vector().norm();
    Err(Error::InvalidAt {
        quantity: "wrench or tangent of the section",
        value,
        requirement: "finite: the energy density has no such derivative there",
        s: at.s,
    })
}
