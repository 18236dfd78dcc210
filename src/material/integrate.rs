//! Sums of a law over the points of a section: U, Ψ, ∂Ψ/∂Δξ and Ψ′.
//!
//! The hot loops work on a block of points at a time and look for trouble (J ≤ 0, a value that is not finite) only in the sums; the place
//! is then searched for point by point.

use std::marker::PhantomData;

use super::blocks::{Blank, Blocks, Respond, fill_one_by_one, set_parts};
use super::diagnose::diagnose;
use super::differentiate::{FibreResponse, Level, Rate, Tangent};
use super::response::{Points, Request, Station};
use super::scratch::{BLOCKS, Scratch, with_scratch};
use super::span::{Span, fibre, splat6};
use super::sums::{Block, Sums, Totals};
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::scalar::Lane;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};

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
    /// What is summed; the energy is NaN where a point is inadmissible or a sum not finite.
    pub(super) totals: &'a mut Totals,
}

impl<'a> Job<'a> {
    /// Into totals that are zero.
    #[inline(always)]
    pub(super) fn new(site: Site<'a>, request: Request, totals: &'a mut Totals) -> Self {
        Self { site, request, curved: site.at.reference.is_curved(), totals }
    }
}

/// Sums a local law. With B the constant 3×6 matrix of γ = B Δξ / j and j the volume of the reference per dA ds,
///
/// U = Σ w j u, Ψ = Σ w Bᵀ ∂u/∂γ, ∂Ψ/∂Δξ = Σ (w/j) Bᵀ ∂²u/∂γ² B, Ψ′ = Σ (w′ Bᵀ + w B′ᵀ) ∂u/∂γ + w Bᵀ (∂u/∂γ)′.
///
/// For a reference with initial curvature the deformation gradient is [e₁ e₂ γ_tot][e₁ e₂ γ*]⁻¹ = I + (Bξ − Bξ*) ⊗ e₃ / j, again one column.
#[inline(always)]
pub(super) fn integrate_local(law: &dyn Blocks, job: &mut Job<'_>) -> Result<()> {
    sum_local(law, job);
    if job.totals.energy().is_finite() { Ok(()) } else { Err(diagnose_local(law, job)) }
}

#[cold]
#[inline(never)]
fn diagnose_local(law: &dyn Blocks, job: &Job<'_>) -> Error {
    diagnose(law.region(), &job.site, true, &|site, totals| {
        sum_local(law, &mut Job::new(*site, job.request, totals));
    })
}

#[inline(always)]
fn sum_local(law: &dyn Blocks, job: &mut Job<'_>) {
    if job.request <= Request::Wrench {
        if law.sum(job.request, job) {
            return;
        }
        *job.totals = Totals::ZERO;
    }
    with_scratch(|scratch| match job.request {
        Request::Rate => dispatch(Sum { law, job, scratch, level: PhantomData::<Rate> }),
        _ => dispatch(Sum { law, job, scratch, level: PhantomData::<Tangent> }),
    });
}

/// The sums of a law that is evaluated in their midst.
#[inline(always)]
pub(super) fn sum_in_one_pass<L: Lane, O: Level, R: Respond<L, O>>(law: &R, job: &mut Job<'_>) {
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
        sums.add_wrench::<O>(&block, &law.respond_at(&fibre));
        q += L::LANES;
    }
    sums.add_to(O::REQUEST, job.totals);
    job.totals.judge::<L>(job.request, smallest.min_lane() > 0.0);
}

struct Sum<'a, 'b, O> {
    law: &'a dyn Blocks,
    job: &'a mut Job<'b>,
    scratch: &'a mut Scratch,
    level: PhantomData<O>,
}

impl<O: Level> Kernel for Sum<'_, '_, O> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { law, job, scratch, .. } = self;
        let (Site { points, at, strain }, curved) = (job.site, job.curved);
        let xi = splat6(&strain.to_array());
        let mut smallest = L::splat(f64::INFINITY);
        let mut first = 0;
        loop {
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
            sums.add_to(O::REQUEST, job.totals);
            first += BLOCKS * MAX_LANES;
            if first >= points.len() {
                break;
            }
        }
        job.totals.judge::<L>(job.request, smallest.min_lane() > 0.0);
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
