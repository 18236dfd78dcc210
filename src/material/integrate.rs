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
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};
use crate::scalar::{Jet, Lane, Scalar, lanes_disagreed};

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
    let sum = |site: Site<'_>| match request {
        Request::Energy => dispatch(LocalKernel { law, site, level: PhantomData::<Energy> }),
        Request::Wrench => dispatch(LocalKernel { law, site, level: PhantomData::<Wrench> }),
        Request::Tangent => dispatch(LocalKernel { law, site, level: PhantomData::<Tangent> }),
        Request::Rate => dispatch(LocalKernel { law, site, level: PhantomData::<Rate> }),
    };
    let response = sum(site);
    if response.is_finite() { Ok(response) } else { Err(diagnose(law.domain(), site, true, sum)) }
}

struct LocalKernel<'a, M: ?Sized, O> {
    law: &'a M,
    site: Site<'a>,
    level: PhantomData<O>,
}

impl<M: Local + ?Sized, O: Level> Kernel for LocalKernel<'_, M, O> {
    type Output = Response;

    #[inline(always)]
    fn run<L: Lane>(self) -> Response {
        sum_local::<L, O, _>(self.site, self.law)
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

/// Goes through the points block by block, and lane by lane through a block whose lanes disagreed.
///
/// It leaves the loops with a single place where the law is evaluated, which is what makes compilers inline it there.
struct Cursor {
    block: usize,
    lane: Option<usize>,
    lanes: usize,
    points: usize,
}

impl Cursor {
    #[inline(always)]
    fn new<L: Lane>(points: usize) -> Self {
        Self { block: 0, lane: None, lanes: L::LANES, points }
    }

    /// The first point of the block to evaluate, and the one lane of it to use where it is taken apart.
    #[inline(always)]
    fn place(&self) -> Option<(usize, Option<usize>)> {
        if self.block < self.points { Some((self.block, self.lane)) } else { None }
    }

    /// Goes on; whether the block just evaluated counts. Lanes that disagree are all to be evaluated again, each on its own.
    #[inline(always)]
    fn advance(&mut self, disagreed: bool) -> bool {
        match self.lane {
            None if disagreed => {
                self.lane = Some(0);
                return false;
            }
            Some(lane) if lane + 1 < self.lanes.min(self.points - self.block) => self.lane = Some(lane + 1),
            _ => {
                self.lane = None;
                self.block += self.lanes;
            }
        }
        true
    }
}

/// The sum of a local law over blocks of points; its energy is NaN where a point is inadmissible.
#[inline(always)]
pub(super) fn sum_local<L: Lane, O: Level, R: Respond<L, O> + ?Sized>(site: Site<'_>, law: &R) -> Response {
    let xi = splat6(&site.strain.to_array());
    let mut sums = Sums::of(&xi);
    // the smallest J and reference volume; NaN is caught in the sums
    let mut smallest = L::splat(f64::INFINITY);
    let mut cursor = Cursor::new::<L>(site.points.len());
    while let Some((q, lane)) = cursor.place() {
        let mut block = load_block::<L, O>(site, q);
        let mut fibre = fibre::<L, O>(&xi, L::splat(site.at.s), &site.at.reference, &block);
        let j = L::splat(1.0) + fibre.gamma[2];
        smallest = j.select_lt(smallest, j, smallest);
        smallest = block.volume.select_lt(smallest, block.volume, smallest);
        if let Some(lane) = lane {
            block = block.only(lane);
            fibre = fibre.only(lane);
        }
        let local = law.respond_at(&fibre);
        if cursor.advance(lanes_disagreed()) {
            sums.add_local::<O>(&block, &local);
        }
    }
    let mut response = sums.finish(O::REQUEST);
    if !(smallest.min_lane() > 0.0) {
        response.energy = f64::NAN;
    }
    response
}

/// Points q.. of the section, the last block filled up with copies of its first point at no weight.
#[inline(always)]
fn load_block<L: Lane, O: Level>(site: Site<'_>, q: usize) -> Block<L> {
    let points = site.points;
    let (x, y) = (load(&points.x, q, points.x[q]), load(&points.y, q, points.y[q]));
    let mut block = Block::at(x, y, load(&points.weight, q, 0.0));
    if let (true, Some(rates)) = (O::REQUEST >= Request::Rate, &points.rates) {
        block.x_rate = load(&rates.x, q, rates.x[q]);
        block.y_rate = load(&rates.y, q, rates.y[q]);
        block.weight_rate = load(&rates.weight, q, 0.0);
    }
    if site.at.reference.is_curved() {
        block.volume = volume(&splat6(&site.at.reference.twist.to_array()), x, y);
        block.inverse_volume = L::splat(1.0) / block.volume;
    }
    block
}

#[inline(always)]
fn load<L: Lane>(values: &[f64], q: usize, fill: f64) -> L {
    if q + L::LANES <= values.len() {
        return L::load(&values[q..]);
    }
    let mut padded = [fill; MAX_LANES];
    let rest = &values[q..];
    padded[..rest.len()].copy_from_slice(rest);
    L::load(&padded)
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
pub(super) fn fibre<L: Lane, O: Level>(xi: &[L; 6], s: L, reference: &Reference, p: &Block<L>) -> Fibre<L> {
    let zero = L::splat(0.0);
    let mut gamma = column(xi, p.x, p.y);
    if reference.is_curved() {
        let inverse = p.inverse_volume;
        gamma = [gamma[0] * inverse, gamma[1] * inverse, gamma[2] * inverse];
    }
    let mut gamma_rate = [zero; 3];
    if O::REQUEST >= Request::Rate {
        let moving = [xi[0], xi[1], xi[2], zero, zero, zero];
        gamma_rate = column(&moving, p.x_rate, p.y_rate);
        if reference.is_curved() {
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
pub(super) fn diagnose(
    domain: &'static str,
    site: Site<'_>,
    local: bool,
    sum: impl Fn(Site<'_>) -> Response,
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
        let u = sum(Site { points: &one, ..site }).energy;
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
    let sum = |site: Site<'_>| dispatch(SectionalKernel { law, site, request });
    let response = sum(site);
    if response.is_finite() { Ok(response) } else { Err(diagnose(law.domain(), site, false, sum)) }
}

struct SectionalKernel<'a, M: ?Sized> {
    law: &'a M,
    site: Site<'a>,
    request: Request,
}

impl<M: Sectional + ?Sized> Kernel for SectionalKernel<'_, M> {
    type Output = Response;

    #[inline(always)]
    fn run<L: Lane>(self) -> Response {
        let Self { law, site, request } = self;
        match request {
            Request::Energy => sum_sectional::<L, 0, 0, _>(site, request, law),
            Request::Wrench => sum_sectional::<L, 6, 0, _>(site, request, law),
            Request::Tangent => sum_sectional::<L, 6, 21, _>(site, request, law),
            Request::Rate => sum_sectional::<L, 7, 28, _>(site, request, law),
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

/// The sum of a section-level law over blocks of points.
#[inline(always)]
pub(super) fn sum_sectional<L: Lane, const N: usize, const M: usize, R>(
    site: Site<'_>,
    request: Request,
    law: &R,
) -> Response
where
    R: EnergyJet<Jet<L, N, M>> + ?Sized,
{
    let xi = sectional_variables(site.strain);
    let mut sums = Sums::of(&splat6(&site.strain.to_array()));
    let mut cursor = Cursor::new::<L>(site.points.len());
    while let Some((q, lane)) = cursor.place() {
        let mut block = load_block::<L, Rate>(site, q);
        if let Some(lane) = lane {
            block = block.only(lane);
        }
        let u = law.energy_jet(&xi, &sectional_point(&block, site.at.s));
        if cursor.advance(lanes_disagreed()) {
            sums.add_sectional(&block, &u);
        }
    }
    sums.finish(request)
}

/// Δξ as the first six of `N` variables, or as constants where `N` is 0.
#[inline(always)]
fn sectional_variables<L: Lane, const N: usize, const M: usize>(strain: &Strain) -> Strain<Jet<L, N, M>> {
    let mut xi = [Jet::constant(L::splat(0.0)); 6];
    for (i, value) in strain.to_array().into_iter().enumerate() {
        xi[i].value = L::splat(value);
        if N > 0 {
            xi[i].gradient[i] = L::splat(1.0);
        }
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
