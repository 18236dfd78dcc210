//! Many strains on the same points, a lane a strain.

use std::marker::PhantomData;

use super::blocks::{Blank, Blocks, Eight, fill_one_by_one, set_parts};
use super::differentiate::{Level, Rate, Tangent};
use super::integrate::{Job, Site, integrate_local};
use super::places::{Coordinate, Places};
use super::response::{Points, Request, Response, Station};
use super::scratch::{BLOCKS, Loan, Scratch};
use super::span::fibre;
use super::sums::{Block, ENTRIES, Sums, Totals};
use super::task::one_by_one;
use crate::error::Result;
use crate::lie::Strain;
use crate::scalar::Lane;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};

/// Sums a local law for many strains, eight at a time. Energies and wrenches alone, sections that move along s and curved references are done strain by
/// strain, as are what is left over, and eight strains one of which is inadmissible.
pub(super) fn integrate_many(
    law: &dyn Blocks,
    points: &Points,
    sites: &[(Station, Strain)],
    request: Request,
    out: &mut [Response],
) -> Result<()> {
    let alone =
        |at: &Station, strain: &Strain| integrate_local(law, &Job::new(Site { points, at, strain }, request));
    if request <= Request::Wrench
        || points.rates.is_some()
        || sites.iter().any(|(at, _)| at.reference.is_curved())
    {
        return one_by_one(sites, out, alone);
    }
    for (sites, out) in sites.chunks(MAX_LANES).zip(out.chunks_mut(MAX_LANES)) {
        let full = sites.len() == MAX_LANES && out.len() == MAX_LANES;
        if !(full && eight_at_once(law, points, sites, request, out)) {
            one_by_one(sites, out, alone)?;
        }
    }
    Ok(())
}

/// The responses to eight strains; whether all of them are admissible.
fn eight_at_once(
    law: &dyn Blocks,
    points: &Points,
    sites: &[(Station, Strain)],
    request: Request,
    out: &mut [Response],
) -> bool {
    let (strains, s) = gather(sites);
    let mut entries = [Eight::ZERO; ENTRIES];
    let batch = Batch { law, points, station: &sites[0].0, strains: &strains, s: &s, entries: &mut entries };
    let mut loan = Loan::take();
    let scratch = loan.scratch();
    let admissible = match request {
        Request::Rate => dispatch(SumMany { batch, scratch, level: PhantomData::<Rate> }),
        _ => dispatch(SumMany { batch, scratch, level: PhantomData::<Tangent> }),
    };
    drop(loan);
    let mut finite = true;
    for (i, out) in out.iter_mut().enumerate() {
        let totals = Totals::of_strain(i, &entries);
        finite = finite && totals.judged::<f64>(request, admissible).is_finite();
        *out = totals.response(request);
    }
    finite
}

struct Batch<'a> {
    law: &'a dyn Blocks,
    points: &'a Points,
    /// A station with the reference of all.
    station: &'a Station,
    strains: &'a [Eight; 6],
    s: &'a Eight,
    /// What is summed, a strain a lane.
    entries: &'a mut [Eight; ENTRIES],
}

struct SumMany<'a, O> {
    batch: Batch<'a>,
    scratch: &'a mut Scratch,
    level: PhantomData<O>,
}

impl<O: Level> Kernel for SumMany<'_, O> {
    /// Whether J > 0 everywhere.
    type Output = bool;
    const ALIGNED: bool = true;

    #[inline(always)]
    fn run<L: Lane>(self) -> bool {
        let Self { batch, scratch, .. } = self;
        let mut smallest = L::splat(f64::INFINITY);
        for first in (0..batch.points.len()).step_by(BLOCKS) {
            let blocks = (batch.points.len() - first).min(BLOCKS);
            for k in 0..blocks {
                smallest = smallest.min(lay_out::<L, O>(&batch, first + k, k, scratch));
            }
            let Scratch { strands, derivatives, places: [x, y, s] } = &mut *scratch;
            let (strands, derivatives) = (&strands[..blocks], &mut derivatives[..blocks]);
            let places = Places {
                len: blocks * MAX_LANES,
                position: [Coordinate::of(x), Coordinate::of(y)],
                position_rate: [Coordinate::constant(0.0); 2],
                s: Coordinate::of(s),
            };
            let mut blank = Blank { places, strands, out: &mut *derivatives };
            if batch.law.fill(O::REQUEST, &mut blank) {
                fill_one_by_one(batch.law, O::REQUEST, &mut blank);
            }
            for part in 0..MAX_LANES / L::LANES {
                let mut sums = if first == 0 { Sums::of(&strains(&batch, part)) } else { Sums::zero() };
                for (k, derivatives) in derivatives.iter().enumerate() {
                    let point = point::<L>(batch.points, first + k);
                    sums.add_wrench::<O>(&point, &derivatives.read::<L, O>(part));
                }
                for (k, derivatives) in derivatives.iter().enumerate() {
                    let point = point::<L>(batch.points, first + k);
                    sums.add_tangent::<O>(&point, &derivatives.read::<L, O>(part));
                }
                sums.add_to_strains(part, O::REQUEST, batch.entries);
            }
        }
        smallest.min_lane() > 0.0
    }
}

/// Lays out γ of the eight strains at a point, as block `k`; the smallest J.
#[inline(always)]
fn lay_out<L: Lane, O: Level>(batch: &Batch<'_>, q: usize, k: usize, scratch: &mut Scratch) -> L {
    let mut smallest = L::splat(f64::INFINITY);
    let point = point::<L>(batch.points, q);
    for part in 0..MAX_LANES / L::LANES {
        let s = batch.s.part(part);
        let xi = strains(batch, part);
        let fibre = fibre::<L, O>(&xi, s, &batch.station.reference, false, &point);
        smallest = smallest.min(L::splat(1.0) + fibre.gamma[2]);
        let strands = &mut scratch.strands[k % BLOCKS];
        set_parts(&mut strands.gamma, part, &fibre.gamma);
        if O::REQUEST >= Request::Rate {
            set_parts(&mut strands.gamma_rate, part, &fibre.gamma_rate);
        }
        let entry = (k % BLOCKS) * MAX_LANES + part * L::LANES;
        for (place, value) in scratch.places.iter_mut().zip([point.x, point.y, s]) {
            value.store(&mut place[entry..]);
        }
    }
    smallest
}

/// The same point in every lane.
#[inline(always)]
fn point<L: Lane>(points: &Points, q: usize) -> Block<L> {
    Block::at(L::splat(points.x[q]), L::splat(points.y[q]), L::splat(points.weight[q]))
}

#[inline(always)]
fn strains<L: Lane>(batch: &Batch<'_>, part: usize) -> [L; 6] {
    super::blocks::parts(batch.strains, part)
}

/// Strains and arc lengths, a lane each.
fn gather(sites: &[(Station, Strain)]) -> ([Eight; 6], Eight) {
    let (mut xi, mut s) = ([Eight::ZERO; 6], Eight::ZERO);
    for (i, (at, strain)) in sites.iter().enumerate().take(MAX_LANES) {
        s.0[i] = at.s;
        for (component, value) in xi.iter_mut().zip(strain.to_array()) {
            component.0[i] = value;
        }
    }
    (xi, s)
}
