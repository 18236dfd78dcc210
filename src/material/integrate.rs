//! Sums of a law over the points of a section: U, Ψ, ∂Ψ/∂Δξ and Ψ′.
//!
//! The hot loops work on a block of points at a time and look for trouble (J ≤ 0, a value that is not finite) only in the sums; the place
//! is then searched for point by point.

use std::marker::PhantomData;

use super::blocks::{Blank, Blocks, fill_one_by_one, set_parts};
use super::diagnose::{diagnose, not_finite};
use super::differentiate::{FibreResponse, Level, Rate, Tangent};
use super::law::Local;
use super::response::{Points, Request, Response, Station};
use super::scratch::{BLOCKS, Loan, Scratch};
use super::span::{Span, fibre, splat6};
use super::sums::{Block, Sums, Totals};
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};
use crate::scalar::{Lane, lanes_disagreed};

/// The section and strain of one evaluation.
#[derive(Clone, Copy)]
pub struct Site<'a> {
    pub(super) points: &'a Points,
    pub(super) at: &'a Station,
    pub(super) strain: &'a Strain,
}

/// One evaluation: passed by reference throughout, since what is copied on the way waits for what was just stored.
pub struct Job<'a> {
    pub(super) site: Site<'a>,
    pub(super) request: Request,
    /// Whether the reference is.
    curved: bool,
    /// Whether this is the search for the place of a failure.
    searching: bool,
}

impl<'a> Job<'a> {
    #[inline(always)]
    pub(super) fn new(site: Site<'a>, request: Request) -> Self {
        Self { site, request, curved: site.at.reference.is_curved(), searching: false }
    }
}

/// Sums a local law. With B the constant 3×6 matrix of γ = B Δξ / j and j the volume of the reference per dA ds,
///
/// U = Σ w j u, Ψ = Σ w Bᵀ ∂u/∂γ, ∂Ψ/∂Δξ = Σ (w/j) Bᵀ ∂²u/∂γ² B, Ψ′ = Σ (w′ Bᵀ + w B′ᵀ) ∂u/∂γ + w Bᵀ (∂u/∂γ)′.
///
/// For a reference with initial curvature the deformation gradient is [e₁ e₂ γ_tot][e₁ e₂ γ*]⁻¹ = I + (Bξ − Bξ*) ⊗ e₃ / j, again one column.
#[inline(always)]
pub(super) fn integrate_local(law: &dyn Blocks, job: &Job<'_>) -> Result<Response> {
    if job.request <= Request::Wrench { law.sum(job) } else { sum_by_blocks(law, job) }
}

/// The response, from the totals; written where it goes by what knows the machine's registers.
#[inline(always)]
fn answer<L: Lane>(law: &dyn Blocks, job: &Job<'_>, totals: &Totals, admissible: bool) -> Result<Response> {
    let energy = totals.judged::<L>(job.request, admissible);
    if energy.is_finite() { Ok(totals.response(job.request)) } else { Err(refuse(law, job, energy)) }
}

/// Finds what made a sum inadmissible or not finite, and where: by the same sum over one point at a time.
#[cold]
#[inline(never)]
fn refuse(law: &dyn Blocks, job: &Job<'_>, energy: f64) -> Error {
    if job.searching {
        return not_finite(law.region(), &job.site, energy);
    }
    diagnose(&job.site, true, &|site| {
        integrate_local(law, &Job { searching: true, ..Job::new(*site, job.request) })
    })
}

/// The sums of a law that fills in its derivatives at blocks of points.
#[inline(always)]
pub(super) fn sum_by_blocks(law: &dyn Blocks, job: &Job<'_>) -> Result<Response> {
    let mut loan = Loan::take();
    let scratch = loan.scratch();
    match job.request {
        Request::Rate => dispatch(Sum { law, job, scratch, level: PhantomData::<Rate> }),
        _ => dispatch(Sum { law, job, scratch, level: PhantomData::<Tangent> }),
    }
}

/// The sums of a law that is evaluated in their midst.
#[inline(always)]
pub(super) fn sum_in_one_pass<L: Lane, O: Level, M: Local>(law: &M, job: &Job<'_>) -> Result<Response> {
    let Site { points, at, strain } = job.site;
    let span = Span::of(points, 0, points.len());
    let xi = splat6(&strain.to_array());
    // the smallest J and reference volume; NaN is caught in the sums
    let mut smallest = L::splat(f64::INFINITY);
    let mut sums = Sums::of(&xi);
    let mut q = 0;
    while q < span.len() {
        let block = span.block::<L, O>(q, &at.reference, job.curved);
        let fibre = fibre::<L, O>(&xi, L::splat(at.s), &at.reference, job.curved, &block);
        smallest = smallest.min(L::splat(1.0) + fibre.gamma[2]);
        if job.curved {
            smallest = smallest.min(block.volume);
        }
        sums.add_wrench::<O>(&block, &law.respond::<L, O>(&fibre));
        q += L::LANES;
    }
    if lanes_disagreed() {
        return in_blocks(law, job);
    }
    let mut totals = Totals::ZERO;
    sums.add_to(O::REQUEST, &mut totals);
    answer::<L>(law, job, &totals, smallest.min_lane() > 0.0)
}

/// Out of line, since it is rarely wanted.
#[cold]
#[inline(never)]
fn in_blocks(law: &dyn Blocks, job: &Job<'_>) -> Result<Response> {
    sum_by_blocks(law, job)
}

struct Sum<'a, 'b, O> {
    law: &'a dyn Blocks,
    job: &'a Job<'b>,
    scratch: &'a mut Scratch,
    level: PhantomData<O>,
}

impl<O: Level> Kernel for Sum<'_, '_, O> {
    type Output = Result<Response>;
    const ALIGNED: bool = true;

    #[inline(always)]
    fn run<L: Lane>(self) -> Result<Response> {
        let Self { law, job, scratch, .. } = self;
        let (Site { points, at, strain }, curved) = (job.site, job.curved);
        let mut totals = Totals::ZERO;
        let mut smallest = L::splat(f64::INFINITY);
        let mut first = 0;
        loop {
            let xi = splat6(&strain.to_array());
            let span = Span::of(points, first, BLOCKS * MAX_LANES);
            smallest = smallest.min(lay_out::<L, O>(at, &xi, &span, curved, scratch));
            let blocks = span.len().div_ceil(MAX_LANES);
            let (strands, out) = (&scratch.strands[..blocks], &mut scratch.derivatives[..blocks]);
            let mut blank = Blank { places: span.places(at.s), strands, out };
            if law.fill(O::REQUEST, &mut blank) {
                fill_one_by_one(law, O::REQUEST, &mut blank);
            }
            let mut sums = if first == 0 { Sums::of(&xi) } else { Sums::zero() };
            add_up::<L, O>(at, &span, curved, scratch, &mut sums);
            sums.add_to(O::REQUEST, &mut totals);
            first += BLOCKS * MAX_LANES;
            if first >= points.len() {
                break;
            }
        }
        answer::<L>(law, job, &totals, smallest.min_lane() > 0.0)
    }
}

/// Lays γ out in blocks; the smallest J and volume of the reference.
#[inline(always)]
fn lay_out<L: Lane, O: Level>(
    at: &Station,
    xi: &[L; 6],
    span: &Span<'_>,
    curved: bool,
    scratch: &mut Scratch,
) -> L {
    let mut smallest = L::splat(f64::INFINITY);
    let mut q = 0;
    while q < span.len() {
        let block = span.block::<L, O>(q, &at.reference, curved);
        let fibre = fibre::<L, O>(xi, L::splat(at.s), &at.reference, curved, &block);
        smallest = smallest.min(L::splat(1.0) + fibre.gamma[2]);
        if curved {
            smallest = smallest.min(block.volume);
        }
        let strands = &mut scratch.strands[(q / MAX_LANES) % BLOCKS];
        let part = (q % MAX_LANES) / L::LANES;
        set_parts(&mut strands.gamma, part, &fibre.gamma);
        if O::REQUEST >= Request::Rate {
            set_parts(&mut strands.gamma_rate, part, &fibre.gamma_rate);
        }
        q += L::LANES;
    }
    smallest
}

/// Adds up the derivatives of the law in the blocks.
#[inline(always)]
fn add_up<L: Lane, O: Level>(
    at: &Station,
    span: &Span<'_>,
    curved: bool,
    scratch: &Scratch,
    sums: &mut Sums<L>,
) {
    let mut q = 0;
    while q < span.len() {
        let (block, derivatives) = block_of::<L, O>(at, span, curved, scratch, q);
        sums.add_wrench::<O>(&block, &derivatives);
        q += L::LANES;
    }
    q = 0;
    while q < span.len() {
        let (block, derivatives) = block_of::<L, O>(at, span, curved, scratch, q);
        sums.add_tangent::<O>(&block, &derivatives);
        q += L::LANES;
    }
}

#[inline(always)]
fn block_of<L: Lane, O: Level>(
    at: &Station,
    span: &Span<'_>,
    curved: bool,
    scratch: &Scratch,
    q: usize,
) -> (Block<L>, FibreResponse<L>) {
    let derivatives = &scratch.derivatives[(q / MAX_LANES) % BLOCKS];
    let block = span.block::<L, O>(q, &at.reference, curved);
    (block, derivatives.read::<L, O>((q % MAX_LANES) / L::LANES))
}

#[cfg(test)]
mod tests;
