//! Sums of a law over the points of a section: U, Ψ, ∂Ψ/∂Δξ and Ψ′.
//!
//! The hot loops work on a block of points at a time and look for trouble (J ≤ 0, a value that is not finite) only in the sums; the place
//! is then searched for point by point.

use std::marker::PhantomData;

use super::differentiate::{Energy, Fibre, FibreResponse, Level, Rate, Tangent, Wrench, along};
use super::kinematics::Point;
use super::law::{Local, Sectional};
use super::response::{Points, Reference, Request, Response, Station, check_strain};
use super::sums::{Block, Sums};
use super::walk::Walk;
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::scalar::lane::{Kernel, dispatch};
use crate::scalar::{Jet, Lane, Scalar};

/// The section and strain of one evaluation.
#[derive(Clone, Copy)]
pub(super) struct Site<'a> {
    pub(super) points: &'a Points,
    pub(super) at: &'a Station,
    pub(super) strain: &'a Strain,
}

/// Sums a local law. With B the constant 3×6 matrix of γ = B Δξ / j and j the volume of the reference per dA ds,
///
/// U = Σ w j u, Ψ = Σ w Bᵀ ∂u/∂γ, ∂Ψ/∂Δξ = Σ (w/j) Bᵀ ∂²u/∂γ² B, Ψ′ = Σ (w′ Bᵀ + w B′ᵀ) ∂u/∂γ + w Bᵀ (∂u/∂γ)′.
///
/// For a reference with initial curvature the deformation gradient is [e₁ e₂ γ_tot][e₁ e₂ γ*]⁻¹ = I + (Bξ − Bξ*) ⊗ e₃ / j, again one column.
pub(super) fn integrate_local<M: Local + ?Sized>(
    law: &M,
    site: Site<'_>,
    request: Request,
) -> Result<Response> {
    let sum = |site: Site<'_>, out: &mut Response| match request {
        Request::Energy => dispatch(LocalKernel { law, site, out, level: PhantomData::<Energy> }),
        Request::Wrench => dispatch(LocalKernel { law, site, out, level: PhantomData::<Wrench> }),
        Request::Tangent => dispatch(LocalKernel { law, site, out, level: PhantomData::<Tangent> }),
        Request::Rate => dispatch(LocalKernel { law, site, out, level: PhantomData::<Rate> }),
    };
    respond(law.domain(), site, true, sum)
}

/// The response of a sum over points, or what made it inadmissible. Summed in place: a copy of a response costs as much as a block of points.
#[inline(always)]
pub(super) fn respond(
    domain: &'static str,
    site: Site<'_>,
    local: bool,
    sum: impl Fn(Site<'_>, &mut Response),
) -> Result<Response> {
    let mut result = Ok(Response::zero());
    if let Ok(response) = &mut result {
        sum(site, response);
        if !response.energy.is_finite() {
            result = Err(diagnose(domain, site, local, sum));
        }
    }
    result
}

struct LocalKernel<'a, M: ?Sized, O> {
    law: &'a M,
    site: Site<'a>,
    out: &'a mut Response,
    level: PhantomData<O>,
}

impl<M: Local + ?Sized, O: Level> Kernel for LocalKernel<'_, M, O> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        sum_local::<L, O, _>(self.site, self.law, self.out)
    }
}

/// The derivatives of a law at a block of points. A trait and not a closure: a closure cannot be marked `#[inline(always)]`, and what
/// is not inlined into the kernel is compiled without the kernel's instruction set.
pub(super) trait Respond<L, O> {
    fn respond_at(&self, fibre: &Fibre<L>) -> FibreResponse<L>;
}

impl<M: Local + ?Sized, L: Lane, O: Level> Respond<L, O> for M {
    #[inline(always)]
    fn respond_at(&self, fibre: &Fibre<L>) -> FibreResponse<L> {
        self.respond::<L, O>(fibre)
    }
}

/// The sum of a local law over blocks of points; its energy is NaN where a point is inadmissible or any sum is not finite.
#[inline(always)]
pub(super) fn sum_local<L: Lane, O: Level, R: Respond<L, O> + ?Sized>(
    site: Site<'_>,
    law: &R,
    out: &mut Response,
) {
    let xi = splat6(&site.strain.to_array());
    let curved = site.at.reference.is_curved();
    let mut walk = Walk::over::<L>(site.points.len());
    loop {
        let mut sums = Sums::of(&xi);
        // the smallest J and reference volume; NaN is caught in the sums
        let mut smallest = L::splat(f64::INFINITY);
        while let Some((q, lane)) = walk.place() {
            let mut block = load_block::<L, O>(site, q, curved);
            let mut fibre = fibre::<L, O>(&xi, L::splat(site.at.s), &site.at.reference, curved, &block);
            let j = L::splat(1.0) + fibre.gamma[2];
            smallest = smallest.min(j);
            if curved {
                smallest = smallest.min(block.volume);
            }
            if let Some(lane) = lane {
                block = block.only(lane);
                fibre = fibre.only(lane);
            }
            let local = law.respond_at(&fibre);
            if walk.advance() {
                sums.add_local::<O>(&block, &local);
            }
        }
        if !walk.again() {
            return sums.finish(O::REQUEST, smallest.min_lane() > 0.0, out);
        }
    }
}

/// Points q.. of the section, the last block filled up with copies of its first point at no weight.
#[inline(always)]
fn load_block<L: Lane, O: Level>(site: Site<'_>, q: usize, curved: bool) -> Block<L> {
    let points = site.points;
    let [x, y, weight] = load_three(&points.x, &points.y, &points.weight, q);
    let mut block = Block::at(x, y, weight);
    if let (true, Some(rates)) = (O::REQUEST >= Request::Rate, &points.rates) {
        [block.x_rate, block.y_rate, block.weight_rate] = load_three(&rates.x, &rates.y, &rates.weight, q);
    }
    if curved {
        block.volume = volume(&splat6(&site.at.reference.twist.to_array()), x, y);
        block.inverse_volume = L::splat(1.0) / block.volume;
    }
    block
}

/// A block of two coordinates and a weight.
#[inline(always)]
fn load_three<L: Lane>(x: &[f64], y: &[f64], w: &[f64], q: usize) -> [L; 3] {
    let (x, y, w) = (&x[q..], &y[q..], &w[q..]);
    if x.len() >= L::LANES && y.len() >= L::LANES && w.len() >= L::LANES {
        return [L::load(x), L::load(y), L::load(w)];
    }
    [L::load_or(x, x[0]), L::load_or(y, y[0]), L::load_or(w, 0.0)]
}

#[inline(always)]
fn splat6<L: Lane>(v: &[f64; 6]) -> [L; 6] {
    [L::splat(v[0]), L::splat(v[1]), L::splat(v[2]), L::splat(v[3]), L::splat(v[4]), L::splat(v[5])]
}

/// j = γ*·e₃ = ν*_z + ω*_x y − ω*_y x.
#[inline(always)]
fn volume<L: Lane>(xi: &[L; 6], x: L, y: L) -> L {
    xi[0].mul_add(y, xi[5] - xi[1] * x)
}

/// B(x, y) Δξ.
#[inline(always)]
fn column<L: Lane>(xi: &[L; 6], x: L, y: L) -> [L; 3] {
    let [o_x, o_y, o_z, n_x, n_y, n_z] = *xi;
    [n_x - o_z * y, o_z.mul_add(x, n_y), o_x.mul_add(y, n_z - o_y * x)]
}

/// γ = B Δξ / j at a block of points, and its derivative in s at fixed Δξ: (B′ Δξ − γ j′) / j.
#[inline(always)]
pub(super) fn fibre<L: Lane, O: Level>(
    xi: &[L; 6],
    s: L,
    reference: &Reference,
    curved: bool,
    p: &Block<L>,
) -> Fibre<L> {
    let zero = L::splat(0.0);
    let mut gamma = column(xi, p.x, p.y);
    if curved {
        let inverse = p.inverse_volume;
        gamma = [gamma[0] * inverse, gamma[1] * inverse, gamma[2] * inverse];
    }
    let mut gamma_rate = [zero; 3];
    if O::REQUEST >= Request::Rate {
        let moving = [xi[0], xi[1], xi[2], zero, zero, zero];
        gamma_rate = column(&moving, p.x_rate, p.y_rate);
        if curved {
            let turned = splat6(&reference.twist.to_array());
            let turned = [turned[0], turned[1], turned[2], zero, zero, zero];
            let d_volume =
                volume(&turned, p.x_rate, p.y_rate) + volume(&splat6(&reference.rate.to_array()), p.x, p.y);
            for i in 0..3 {
                gamma_rate[i] = (gamma_rate[i] - gamma[i] * d_volume) * p.inverse_volume;
            }
        }
    }
    Fibre { position: [p.x, p.y], position_rate: [p.x_rate, p.y_rate], s, gamma, gamma_rate }
}

/// Finds what made a sum inadmissible or not finite, and where: by the same sum over one point at a time.
#[cold]
pub(super) fn diagnose(
    domain: &'static str,
    site: Site<'_>,
    local: bool,
    sum: impl Fn(Site<'_>, &mut Response),
) -> Error {
    let Site { points, at, strain } = site;
    if let Err(error) = check_strain(strain, at.s) {
        return error;
    }
    for q in 0..points.len() {
        let (x, y) = (points.x[q], points.y[q]);
        if local {
            let j = volume(&at.reference.twist.to_array(), x, y);
            if !(j > 0.0) {
                let requirement = "positive: the section reaches the centre of curvature of the reference";
                return inadmissible("volume of the reference", j, requirement, at.s, x, y);
            }
            let stretch = 1.0 + column(&strain.to_array(), x, y)[2] / j;
            if !(stretch > 0.0) {
                return inadmissible("J", stretch, "positive", at.s, x, y);
            }
        }
        let one = Points { x: vec![x], y: vec![y], weight: vec![1.0], rates: None };
        let mut response = Response::zero();
        sum(Site { points: &one, ..site }, &mut response);
        let u = response.energy;
        if !u.is_finite() {
            return inadmissible("energy density", u, domain, at.s, x, y);
        }
    }
    no_derivative(at)
}

/// Every energy density is finite, but a sum of derivatives is not.
fn no_derivative(at: &Station) -> Error {
    Error::InvalidAt {
        quantity: "wrench or tangent of the section",
        value: f64::NAN,
        requirement: "finite: the energy density has no such derivative there",
        s: at.s,
    }
}

fn inadmissible(
    quantity: &'static str,
    value: f64,
    requirement: &'static str,
    s: f64,
    x: f64,
    y: f64,
) -> Error {
    Error::Inadmissible { quantity, value, requirement, s, x, y }
}

/// Sums a section-level law u(Δξ, x, y), differentiated in six variables, and s as a seventh where Ψ′ is wanted.
pub(super) fn integrate_sectional<M: Sectional + ?Sized>(
    law: &M,
    site: Site<'_>,
    request: Request,
) -> Result<Response> {
    let sum = |site: Site<'_>, out: &mut Response| dispatch(SectionalKernel { law, site, request, out });
    respond(law.domain(), site, false, sum)
}

struct SectionalKernel<'a, M: ?Sized> {
    law: &'a M,
    site: Site<'a>,
    request: Request,
    out: &'a mut Response,
}

impl<M: Sectional + ?Sized> Kernel for SectionalKernel<'_, M> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { law, site, request, out } = self;
        match request {
            Request::Energy => sum_sectional::<L, 0, 0, _>(site, request, law, out),
            Request::Wrench => sum_sectional::<L, 6, 0, _>(site, request, law, out),
            Request::Tangent => sum_sectional::<L, 6, 21, _>(site, request, law, out),
            Request::Rate => sum_sectional::<L, 7, 28, _>(site, request, law, out),
        }
    }
}

/// The energy of a section-level law as a jet. A trait for the reason that [`Respond`] is one.
pub(super) trait EnergyJet<J: Scalar> {
    fn energy_jet(&self, strain: &Strain<J>, at: &Point<J>) -> J;
}

impl<M: Sectional + ?Sized, J: Scalar> EnergyJet<J> for M {
    #[inline(always)]
    fn energy_jet(&self, strain: &Strain<J>, at: &Point<J>) -> J {
        self.energy_density(strain, at)
    }
}

/// The sum of a section-level law over blocks of points; its energy is NaN where any sum is not finite.
#[inline(always)]
pub(super) fn sum_sectional<L: Lane, const N: usize, const M: usize, R>(
    site: Site<'_>,
    request: Request,
    law: &R,
    out: &mut Response,
) where
    R: EnergyJet<Jet<L, N, M>> + ?Sized,
{
    let xi = sectional_variables(site.strain);
    let components = splat6(&site.strain.to_array());
    let mut walk = Walk::over::<L>(site.points.len());
    loop {
        let mut sums = Sums::of(&components);
        while let Some((q, lane)) = walk.place() {
            let mut block = load_block::<L, Rate>(site, q, false);
            if let Some(lane) = lane {
                block = block.only(lane);
            }
            let u = law.energy_jet(&xi, &sectional_point(&block, site.at.s));
            if walk.advance() {
                sums.add_sectional(&block, &u);
            }
        }
        if !walk.again() {
            return sums.finish(request, true, out);
        }
    }
}

/// Δξ as the first six of `N` variables, or as constants where `N` is 0.
#[inline(always)]
fn sectional_variables<L: Lane, const N: usize, const M: usize>(strain: &Strain) -> Strain<Jet<L, N, M>> {
    let mut xi = [Jet::constant(L::splat(0.0)); 6];
    for (i, value) in strain.to_array().into_iter().enumerate() {
        let value = L::splat(value);
        xi[i] = if N > 0 { Jet::variable(value, i) } else { Jet::constant(value) };
    }
    Strain::from_array(xi)
}

/// The points of a block, moving with s where that is the seventh variable.
#[inline(always)]
fn sectional_point<L: Lane, const N: usize, const M: usize>(block: &Block<L>, s: f64) -> Point<Jet<L, N, M>> {
    if N > 6 {
        let (x, y) = (along(block.x, block.x_rate), along(block.y, block.y_rate));
        return Point { x, y, s: along(L::splat(s), L::splat(1.0)) };
    }
    Point { x: Jet::constant(block.x), y: Jet::constant(block.y), s: Jet::constant(L::splat(s)) }
}

#[cfg(test)]
mod tests;
