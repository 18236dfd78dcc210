use std::marker::PhantomData;

use super::isotropic::cross;
use super::{GradientResponse, GradientSite, STIFFNESS};
use crate::material::differentiate::{Level, Rate, Tangent};
use crate::material::law::Local;
use crate::material::response::{Points, Request};
use crate::material::walk::Walk;
use crate::scalar::Lane;
use crate::scalar::lane::{Kernel, dispatch};

/// H at the points of a section.
#[derive(Clone, Copy)]
pub(crate) struct GradientBatch<'a> {
    /// The points.
    pub(crate) points: &'a Points,
    /// Arc length.
    pub(crate) s: f64,
    /// H, entry by entry (by rows), for all points each.
    pub(crate) h: &'a [f64],
}

/// What a law answers at the points of a section, entry by entry, for all points each.
#[derive(Clone, Debug, Default)]
pub(crate) struct GradientState {
    /// u.
    pub(crate) energy: Vec<f64>,
    /// P.
    pub(crate) stress: Vec<f64>,
    /// ∂P/∂F.
    pub(crate) stiffness: Vec<f64>,
    /// ∂P/∂s at fixed H.
    pub(crate) stress_rate: Vec<f64>,
}

/// A law as a relaxed section sees it: what it answers to H at many points. An object, so that what is done with the answers is compiled
/// once and not for every law.
pub(crate) trait GradientLaw: Send + Sync {
    /// Writes energy, stress and stiffness, and with [`Request::Rate`] the rate of the stress; the smallest J comes back (what a NaN in
    /// H makes of it is not said).
    fn evaluate(&self, batch: GradientBatch<'_>, request: Request, out: &mut GradientState) -> f64;

    /// Where the law is defined.
    fn domain(&self) -> &'static str;
}

impl<M: Local> GradientLaw for M {
    fn evaluate(&self, batch: GradientBatch<'_>, request: Request, out: &mut GradientState) -> f64 {
        let n = batch.points.len();
        out.energy.resize(n, 0.0);
        out.stress.resize(9 * n, 0.0);
        out.stiffness.resize(STIFFNESS * n, 0.0);
        if request < Request::Rate {
            return dispatch(GradientKernel { law: self, batch, out, level: PhantomData::<Tangent> });
        }
        out.stress_rate.resize(9 * n, 0.0);
        dispatch(GradientKernel { law: self, batch, out, level: PhantomData::<Rate> })
    }

    fn domain(&self) -> &'static str {
        Local::domain(self)
    }
}

impl GradientState {
    /// Writes a block, or one lane of it, where its points are.
    #[inline(always)]
    fn store<L: Lane, O: Level>(&mut self, q: usize, lane: Option<usize>, response: &GradientResponse<L>) {
        let n = self.energy.len();
        write(&mut self.energy[q..], lane, response.energy);
        for c in 0..9 {
            write(&mut self.stress[c * n + q..(c + 1) * n], lane, response.stress[c]);
        }
        for c in 0..STIFFNESS {
            write(&mut self.stiffness[c * n + q..(c + 1) * n], lane, response.stiffness[c]);
        }
        if O::REQUEST >= Request::Rate {
            for c in 0..9 {
                write(&mut self.stress_rate[c * n + q..(c + 1) * n], lane, response.stress_rate[c]);
            }
        }
    }
}

/// A block, or one lane of it, written to the points it belongs to.
#[inline(always)]
fn write<L: Lane>(to: &mut [f64], lane: Option<usize>, value: L) {
    match lane {
        Some(lane) => to[lane] = value.lane(lane),
        None => value.store(to),
    }
}

struct GradientKernel<'a, 'b, M, O> {
    law: &'a M,
    batch: GradientBatch<'a>,
    out: &'b mut GradientState,
    level: PhantomData<O>,
}

impl<M: Local, O: Level> Kernel for GradientKernel<'_, '_, M, O> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lane>(self) -> f64 {
        let Self { law, batch, out, .. } = self;
        let n = batch.points.len();
        let mut walk = Walk::over::<L>(n);
        loop {
            let mut smallest = L::splat(f64::INFINITY);
            while let Some((q, lane)) = walk.place() {
                let mut site = load::<L, O>(&batch, q);
                let trace = site.h[0] + site.h[4] + site.h[8];
                let minors = cross(&site.h, &site.h);
                let det = site.h[0] * minors[0] + site.h[1] * minors[1] + site.h[2] * minors[2];
                let change = (minors[0] + minors[4] + minors[8] + det) * L::splat(0.5) + trace;
                smallest = smallest.min(change + L::splat(1.0));
                if let Some(lane) = lane {
                    site = site.only(lane);
                }
                let response = law.respond_to_gradient::<L, O>(&site);
                if walk.advance() {
                    out.store::<L, O>(q, lane, &response);
                }
            }
            if !walk.again() {
                return smallest.min_lane();
            }
        }
    }
}

/// Points q.. of the section, the last block filled up with copies of its first point.
#[inline(always)]
fn load<L: Lane, O: Level>(batch: &GradientBatch<'_>, q: usize) -> GradientSite<L> {
    let n = batch.points.len();
    let mut position_rate = [L::splat(0.0); 2];
    if let (true, Some(rates)) = (O::REQUEST >= Request::Rate, &batch.points.rates) {
        position_rate = [load_from(&rates.x, q), load_from(&rates.y, q)];
    }
    let mut h = [L::splat(0.0); 9];
    for c in 0..9 {
        h[c] = load_from(&batch.h[c * n..(c + 1) * n], q);
    }
    let position = [load_from(&batch.points.x, q), load_from(&batch.points.y, q)];
    GradientSite { position, position_rate, s: L::splat(batch.s), h }
}

#[inline(always)]
fn load_from<L: Lane>(values: &[f64], q: usize) -> L {
    L::load_or(&values[q..], values[q])
}
