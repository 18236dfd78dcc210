//! Many strains on the same points, a lane a strain.

use std::marker::PhantomData;

use super::differentiate::{Energy, Level, Rate, Tangent, Wrench};
use super::integrate::{Respond, Site, fibre, integrate_local};
use super::law::{Local, one_by_one};
use super::response::{Points, Request, Response, Station};
use super::sums::{Block, Sums};
use crate::error::Result;
use crate::lie::Strain;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};
use crate::scalar::{Lane, lanes_disagreed};

/// Sums a local law for many strains. Sections that move along s and curved references are done strain by strain, as are the
/// strains of a block whose lanes disagree on a comparison, or one of which is inadmissible.
pub(super) fn integrate_many<M: Local + ?Sized>(
    law: &M,
    points: &Points,
    sites: &[(Station, Strain)],
    request: Request,
    out: &mut [Response],
) -> Result<()> {
    let alone = |at: &Station, strain: &Strain| integrate_local(law, Site { points, at, strain }, request);
    if points.rates.is_some() || sites.iter().any(|(at, _)| at.reference.is_curved()) {
        return one_by_one(sites, out, alone);
    }
    let count = sites.len().min(out.len());
    let mut done = 0;
    while done < count {
        let batch = Batch { points, sites: &sites[done..count], out: &mut out[done..count] };
        let taken = match request {
            Request::Energy => dispatch(BatchKernel { law, batch, level: PhantomData::<Energy> }),
            Request::Wrench => dispatch(BatchKernel { law, batch, level: PhantomData::<Wrench> }),
            Request::Tangent => dispatch(BatchKernel { law, batch, level: PhantomData::<Tangent> }),
            Request::Rate => dispatch(BatchKernel { law, batch, level: PhantomData::<Rate> }),
        };
        done += taken;
        let rest = MAX_LANES.min(count - done);
        one_by_one(&sites[done..done + rest], &mut out[done..done + rest], alone)?;
        done += rest;
    }
    Ok(())
}

struct Batch<'a> {
    points: &'a Points,
    sites: &'a [(Station, Strain)],
    out: &'a mut [Response],
}

struct BatchKernel<'a, M: ?Sized, O> {
    law: &'a M,
    batch: Batch<'a>,
    level: PhantomData<O>,
}

impl<M: Local + ?Sized, O: Level> Kernel for BatchKernel<'_, M, O> {
    /// How many strains were done before the end, or before a block that has to be taken apart.
    type Output = usize;

    #[inline(always)]
    fn run<L: Lane>(self) -> usize {
        let Batch { points, sites, out } = self.batch;
        let mut done = 0;
        while done + L::LANES <= sites.len() {
            let block = &sites[done..done + L::LANES];
            let (xi, s) = gather::<L>(block);
            let mut sums = Sums::of(&xi);
            let mut smallest = L::splat(f64::INFINITY);
            for q in 0..points.len() {
                let point = Block::fixed(points.x[q], points.y[q], points.weight[q]);
                let fibre = fibre::<L, O>(&xi, s, &block[0].0.reference, false, &point);
                let j = L::splat(1.0) + fibre.gamma[2];
                smallest = smallest.min(j);
                let local = Respond::<L, O>::respond_at(self.law, &fibre);
                sums.add_local::<O>(&point, &local);
            }
            if lanes_disagreed() || !(smallest.min_lane() > 0.0 && sums.is_finite(O::REQUEST)) {
                break;
            }
            for (i, response) in out[done..done + L::LANES].iter_mut().enumerate() {
                sums.read_lane(i, O::REQUEST, response);
            }
            done += L::LANES;
        }
        done
    }
}

/// Strains and arc lengths, a lane each.
#[inline(always)]
fn gather<L: Lane>(sites: &[(Station, Strain)]) -> ([L; 6], L) {
    let mut xi = [[0.0; MAX_LANES]; 6];
    let mut s = [0.0; MAX_LANES];
    for (i, (at, strain)) in sites.iter().enumerate() {
        s[i] = at.s;
        for (component, value) in xi.iter_mut().zip(strain.to_array()) {
            component[i] = value;
        }
    }
    let [a, b, c, d, e, f] = &xi;
    ([L::load(a), L::load(b), L::load(c), L::load(d), L::load(e), L::load(f)], L::load(&s))
}
