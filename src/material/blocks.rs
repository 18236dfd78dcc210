//! A law at blocks of points: what the sums over a section ask of it, and the only code that is compiled for every law.
//!
//! A sum first lays γ out in blocks of eight points, then has the law fill in its derivatives there, then adds them up. The law is in between
//! an object, so that the rest is compiled once, with this crate, and not for every law.

use std::marker::PhantomData;

use super::differentiate::{Energy, Fibre, FibreResponse, Level, Rate, Tangent, Wrench};
use super::integrate::{Job, sum_in_one_pass};
use super::law::Local;
use super::places::Places;
use super::response::{Request, Response};
use crate::error::Result;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};
use crate::scalar::{Lane, lanes_disagreed};

/// A number at each point of a block, in one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Eight(pub [f64; MAX_LANES]);

impl Eight {
    pub(super) const ZERO: Self = Self([0.0; MAX_LANES]);

    /// Part number `part` of the block.
    #[inline(always)]
    pub(super) fn part<L: Lane>(&self, part: usize) -> L {
        L::load(&self.0[start::<L>(part)..])
    }

    #[inline(always)]
    pub(super) fn set_part<L: Lane>(&mut self, part: usize, value: L) {
        value.store(&mut self.0[start::<L>(part)..]);
    }
}

/// Where a part begins: within the block for every number, so that no bound is left to check.
#[inline(always)]
fn start<L: Lane>(part: usize) -> usize {
    (part * L::LANES) & (MAX_LANES - L::LANES)
}

/// γ at a block of points, and ∂γ/∂s at fixed Δξ.
#[derive(Clone, Copy, Debug)]
pub struct Strands {
    pub(super) gamma: [Eight; 3],
    pub(super) gamma_rate: [Eight; 3],
}

/// The derivatives of a law at a block of points: see [`FibreResponse`].
#[derive(Clone, Copy, Debug)]
pub struct Derivatives {
    pub(super) energy: Eight,
    pub(super) stress: [Eight; 3],
    pub(super) stiffness: [Eight; 6],
    pub(super) stress_rate: [Eight; 3],
}

impl Strands {
    pub(super) const ZERO: Self = Self { gamma: [Eight::ZERO; 3], gamma_rate: [Eight::ZERO; 3] };

    /// The point of entry `i` at every entry.
    fn only(&self, i: usize) -> Self {
        let spread = |v: &Eight| Eight([v.0[i]; MAX_LANES]);
        Self { gamma: self.gamma.each_ref().map(spread), gamma_rate: self.gamma_rate.each_ref().map(spread) }
    }
}

impl Derivatives {
    pub(super) const ZERO: Self = Self {
        energy: Eight::ZERO,
        stress: [Eight::ZERO; 3],
        stiffness: [Eight::ZERO; 6],
        stress_rate: [Eight::ZERO; 3],
    };

    #[inline(always)]
    fn write<L: Lane, O: Level>(&mut self, part: usize, response: &FibreResponse<L>) {
        self.energy.set_part(part, response.energy);
        if O::REQUEST >= Request::Wrench {
            set_parts(&mut self.stress, part, &response.stress);
        }
        if O::REQUEST >= Request::Tangent {
            set_parts(&mut self.stiffness, part, &response.stiffness);
        }
        if O::REQUEST >= Request::Rate {
            set_parts(&mut self.stress_rate, part, &response.stress_rate);
        }
    }

    #[inline(always)]
    pub(super) fn read<L: Lane, O: Level>(&self, part: usize) -> FibreResponse<L> {
        let zero = L::splat(0.0);
        let mut response = FibreResponse {
            energy: self.energy.part(part),
            stress: [zero; 3],
            stiffness: [zero; 6],
            stress_rate: [zero; 3],
        };
        if O::REQUEST >= Request::Wrench {
            response.stress = parts(&self.stress, part);
        }
        if O::REQUEST >= Request::Tangent {
            response.stiffness = parts(&self.stiffness, part);
        }
        if O::REQUEST >= Request::Rate {
            response.stress_rate = parts(&self.stress_rate, part);
        }
        response
    }

    /// Takes entry `i` from another block.
    fn take(&mut self, i: usize, other: &Self) {
        let pairs = self.stress.iter_mut().zip(&other.stress);
        let pairs = pairs.chain(self.stiffness.iter_mut().zip(&other.stiffness));
        for (mine, theirs) in pairs.chain(self.stress_rate.iter_mut().zip(&other.stress_rate)) {
            mine.0[i] = theirs.0[i];
        }
        self.energy.0[i] = other.energy.0[i];
    }
}

#[inline(always)]
pub(super) fn parts<L: Lane, const N: usize>(numbers: &[Eight; N], part: usize) -> [L; N] {
    let mut out = [L::splat(0.0); N];
    for i in 0..N {
        out[i] = numbers[i].part(part);
    }
    out
}

#[inline(always)]
pub(super) fn set_parts<L: Lane, const N: usize>(numbers: &mut [Eight; N], part: usize, values: &[L; N]) {
    for i in 0..N {
        numbers[i].set_part(part, values[i]);
    }
}

/// What a law is asked to fill in: its derivatives at blocks of points.
pub struct Blank<'a> {
    pub(super) places: Places<'a>,
    pub(super) strands: &'a [Strands],
    pub(super) out: &'a mut [Derivatives],
}

/// A law as the sums over a section see it.
pub trait Blocks {
    /// Fills in energy, stress and stiffness, and the rate of stress if that is requested; whether lanes disagreed on a comparison, so that
    /// they are not all right.
    fn fill(&self, request: Request, blank: &mut Blank<'_>) -> bool;

    /// The sum of energy, or of energy and wrench: in a pass of their own, which needs no room between law and sum, where that can be.
    ///
    /// # Errors
    /// Where a point is inadmissible or a sum not finite.
    fn sum(&self, job: &Job<'_>) -> Result<Response>;

    /// Where the law is defined.
    fn region(&self) -> &'static str;
}

impl<M: Local> Blocks for M {
    fn fill(&self, request: Request, blank: &mut Blank<'_>) -> bool {
        match request {
            Request::Rate => dispatch(Fill { law: self, blank, level: PhantomData::<Rate> }),
            _ => dispatch(Fill { law: self, blank, level: PhantomData::<Tangent> }),
        }
        lanes_disagreed()
    }

    fn sum(&self, job: &Job<'_>) -> Result<Response> {
        match job.request {
            Request::Energy => dispatch(SumInOnePass { law: self, job, level: PhantomData::<Energy> }),
            _ => dispatch(SumInOnePass { law: self, job, level: PhantomData::<Wrench> }),
        }
    }

    fn region(&self) -> &'static str {
        self.domain()
    }
}

struct SumInOnePass<'a, 'b, M, O> {
    law: &'a M,
    job: &'a Job<'b>,
    level: PhantomData<O>,
}

impl<M: Local, O: Level> Kernel for SumInOnePass<'_, '_, M, O> {
    type Output = Result<Response>;
    const ALIGNED: bool = true;

    #[inline(always)]
    fn run<L: Lane>(self) -> Result<Response> {
        sum_in_one_pass::<L, O, M>(self.law, self.job)
    }
}

struct Fill<'a, 'b, M, O> {
    law: &'a M,
    blank: &'a mut Blank<'b>,
    level: PhantomData<O>,
}

impl<M: Local, O: Level> Kernel for Fill<'_, '_, M, O> {
    type Output = ();
    const ALIGNED: bool = true;

    #[inline(always)]
    fn run<L: Lane>(self) {
        fill_registers::<L, O, M>(self.law, self.blank);
    }
}

/// The derivatives of a law at a register of points. A trait and not a closure: a closure cannot be marked `#[inline(always)]`, and what is
/// not inlined into the kernel is compiled without the kernel's instruction set.
pub(super) trait Respond<L, O> {
    fn respond_at(&self, fibre: &Fibre<L>) -> FibreResponse<L>;
}

impl<M: Local, L: Lane, O: Level> Respond<L, O> for M {
    #[inline(always)]
    fn respond_at(&self, fibre: &Fibre<L>) -> FibreResponse<L> {
        self.respond::<L, O>(fibre)
    }
}

/// Fills in the derivatives, a register of points at a time. There is a single place where the law is evaluated: compilers inline a large
/// function once and hesitate twice.
#[inline(always)]
pub(super) fn fill_registers<L: Lane, O: Level, R: Respond<L, O>>(law: &R, blank: &mut Blank<'_>) {
    let Blank { places, strands, out } = blank;
    let (mut block, mut part) = (0, 0);
    while block < strands.len().min(out.len()) && block * MAX_LANES + part * L::LANES < places.len {
        let fibre = places.fibre::<L, O>(&strands[block], block, part);
        out[block].write::<L, O>(part, &law.respond_at(&fibre));
        part += 1;
        if part == MAX_LANES / L::LANES {
            (block, part) = (block + 1, 0);
        }
    }
}

/// Fills in the derivatives of a law whose lanes disagreed: block by block, and point by point in the blocks where they do.
#[cold]
pub(super) fn fill_one_by_one(law: &dyn Blocks, request: Request, blank: &mut Blank<'_>) {
    for (k, (strands, out)) in blank.strands.iter().zip(&mut *blank.out).enumerate() {
        let places = blank.places.block(k);
        let (strands, out) = (std::slice::from_ref(strands), std::slice::from_mut(out));
        if law.fill(request, &mut Blank { places, strands, out }) {
            for i in 0..MAX_LANES {
                let mut alone = [Derivatives::ZERO];
                let strands = &[strands[0].only(i)];
                law.fill(request, &mut Blank { places: places.only(i), strands, out: &mut alone });
                out[0].take(i, &alone[0]);
            }
        }
    }
}
