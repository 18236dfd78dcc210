//! Sums of a law written in Δξ itself, differentiated in six variables, and s as a seventh where Ψ′ is wanted.

use super::diagnose::{diagnose, not_finite};
use super::differentiate::{Rate, along};
use super::integrate::{Job, Site};
use super::kinematics::Point;
use super::law::Sectional;
use super::response::{Request, Response, Station};
use super::span::Span;
use super::sums::{Block, Sums, Totals};
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};
use crate::scalar::{Jet, Lane, Scalar, lanes_disagreed};

/// A section-level law as the sum over a section sees it.
pub trait Spans {
    /// Adds some points to the totals, as far as asked; whether lanes disagreed on a comparison, so that what was added is wrong.
    fn add(&self, request: Request, at: Place<'_>, span: &Span<'_>, totals: &mut Totals) -> bool;

    /// Where the law is defined.
    fn region(&self) -> &'static str;
}

/// A station and the strain there.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    at: &'a Station,
    strain: &'a Strain,
}

impl<M: Sectional> Spans for M {
    fn add(&self, request: Request, at: Place<'_>, span: &Span<'_>, totals: &mut Totals) -> bool {
        dispatch(Add { law: self, request, at, span, totals });
        lanes_disagreed()
    }

    fn region(&self) -> &'static str {
        self.domain()
    }
}

struct Add<'a, M> {
    law: &'a M,
    request: Request,
    at: Place<'a>,
    span: &'a Span<'a>,
    totals: &'a mut Totals,
}

impl<M: Sectional> Kernel for Add<'_, M> {
    type Output = ();
    const ALIGNED: bool = true;

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { law, request, at, span, totals } = self;
        match request {
            Request::Energy => add_span::<L, 0, 0, _>(at, span, request, law, totals),
            Request::Wrench => add_span::<L, 6, 0, _>(at, span, request, law, totals),
            Request::Tangent => add_span::<L, 6, 21, _>(at, span, request, law, totals),
            Request::Rate => add_span::<L, 7, 28, _>(at, span, request, law, totals),
        }
    }
}

/// The energy of a section-level law as a jet. A trait and not a closure: a closure cannot be marked `#[inline(always)]`, and what is not
/// inlined into the kernel is compiled without the kernel's instruction set.
pub(super) trait EnergyJet<J: Scalar> {
    fn energy_jet(&self, strain: &Strain<J>, at: &Point<J>) -> J;
}

impl<M: Sectional, J: Scalar> EnergyJet<J> for M {
    #[inline(always)]
    fn energy_jet(&self, strain: &Strain<J>, at: &Point<J>) -> J {
        self.energy_density(strain, at)
    }
}

/// Adds some points of a section-level law.
#[inline(always)]
pub(super) fn add_span<L: Lane, const N: usize, const M: usize, R: EnergyJet<Jet<L, N, M>>>(
    at: Place<'_>,
    span: &Span<'_>,
    request: Request,
    law: &R,
    totals: &mut Totals,
) {
    let xi = variables(at.strain);
    let mut sums = Sums::zero();
    let mut q = 0;
    while q < span.len() {
        let block = span.block::<L, Rate>(q, &at.at.reference, false);
        sums.add_sectional(&block, &law.energy_jet(&xi, &point(&block, at.at.s)));
        q += L::LANES;
    }
    sums.add_to(request, totals);
}

/// Δξ as the first six of `N` variables, or as constants where `N` is 0.
#[inline(always)]
fn variables<L: Lane, const N: usize, const M: usize>(strain: &Strain) -> Strain<Jet<L, N, M>> {
    let mut xi = [Jet::constant(L::splat(0.0)); 6];
    for (i, value) in strain.to_array().into_iter().enumerate() {
        let value = L::splat(value);
        xi[i] = if N > 0 { Jet::variable(value, i) } else { Jet::constant(value) };
    }
    Strain::from_array(xi)
}

/// The points of a block, moving with s where that is the seventh variable.
#[inline(always)]
fn point<L: Lane, const N: usize, const M: usize>(block: &Block<L>, s: f64) -> Point<Jet<L, N, M>> {
    if N > 6 {
        let (x, y) = (along(block.x, block.x_rate), along(block.y, block.y_rate));
        return Point { x, y, s: along(L::splat(s), L::splat(1.0)) };
    }
    Point { x: Jet::constant(block.x), y: Jet::constant(block.y), s: Jet::constant(L::splat(s)) }
}

/// Sums a section-level law u(Δξ, x, y).
pub(super) fn integrate_sectional(law: &dyn Spans, job: &Job<'_>) -> Result<Response> {
    let (site, request) = (job.site, job.request);
    let fail = |site: &Site<'_>, energy| not_finite(law.region(), site, energy);
    sum(law, &site, request, &|site, _| diagnose(site, false, &|site| sum(law, site, request, &fail)))
}

/// The sums; they fail where one is not finite, or a component of the strain: a law need not look at every one.
#[inline]
fn sum(
    law: &dyn Spans,
    site: &Site<'_>,
    request: Request,
    fail: &dyn Fn(&Site<'_>, f64) -> Error,
) -> Result<Response> {
    let at = Place { at: site.at, strain: site.strain };
    let mut totals = Totals::ZERO;
    if law.add(request, at, &Span::of(site.points, 0, site.points.len()), &mut totals) {
        totals = one_by_one(law, site, request, at);
    }
    let finite = site.strain.to_array().iter().all(|x| x.is_finite());
    let energy = totals.judged::<f64>(request, finite);
    if energy.is_finite() { Ok(totals.response(request)) } else { Err(fail(site, energy)) }
}

/// Block by block, and point by point in the blocks whose lanes disagree.
#[cold]
fn one_by_one(law: &dyn Spans, site: &Site<'_>, request: Request, at: Place<'_>) -> Totals {
    let mut totals = Totals::ZERO;
    for first in (0..site.points.len()).step_by(MAX_LANES) {
        let mut block = Totals::ZERO;
        let span = Span::of(site.points, first, MAX_LANES);
        if law.add(request, at, &span, &mut block) {
            block = Totals::ZERO;
            for i in 0..span.len() {
                law.add(request, at, &Span::of(site.points, first + i, 1), &mut block);
            }
        }
        totals.add_all(&block);
    }
    totals
}
