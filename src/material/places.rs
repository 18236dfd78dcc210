//! Where the points of some blocks are.

use super::blocks::{Strands, parts};
use super::differentiate::{Fibre, Level};
use super::response::Request;
use crate::scalar::Lane;
use crate::scalar::lane::MAX_LANES;

/// A coordinate of the points: numbers, and what stands for those that are not there.
#[derive(Clone, Copy, Debug)]
pub struct Coordinate<'a> {
    pub(super) values: &'a [f64],
    pub(super) rest: f64,
}

impl<'a> Coordinate<'a> {
    /// The same at every point.
    #[inline(always)]
    pub(super) fn constant(value: f64) -> Self {
        Self { values: &[], rest: value }
    }

    /// A number each; the first of a block again for those that it is short of.
    #[inline(always)]
    pub(super) fn of(values: &'a [f64]) -> Self {
        Self { values, rest: 0.0 }
    }

    /// Those from q on.
    fn from(self, q: usize) -> Self {
        Self { values: self.values.get(q..).unwrap_or(&[]), rest: self.rest }
    }

    #[inline(always)]
    fn part<L: Lane>(self, q: usize) -> L {
        match self.values.get(q..) {
            Some(values @ [first, ..]) => L::load_or(values, *first),
            _ => L::splat(self.rest),
        }
    }

    fn at(self, i: usize) -> f64 {
        self.values.get(i).or(self.values.first()).copied().unwrap_or(self.rest)
    }
}

/// Where the points of some blocks are, and how they move along s.
#[derive(Clone, Copy, Debug)]
pub struct Places<'a> {
    /// How many points.
    pub(super) len: usize,
    pub(super) position: [Coordinate<'a>; 2],
    pub(super) position_rate: [Coordinate<'a>; 2],
    pub(super) s: Coordinate<'a>,
}

impl<'a> Places<'a> {
    /// Those of block number `block`.
    pub(super) fn block(&self, block: usize) -> Self {
        let first = block * MAX_LANES;
        let from = |c: Coordinate<'a>| c.from(first);
        Places {
            len: self.len.saturating_sub(first).min(MAX_LANES),
            position: self.position.map(from),
            position_rate: self.position_rate.map(from),
            s: self.s.from(first),
        }
    }

    /// Point `i` as a block.
    pub(super) fn only(&self, i: usize) -> Places<'static> {
        let at = |c: Coordinate<'_>| Coordinate::constant(c.at(i));
        Places {
            len: MAX_LANES,
            position: self.position.map(at),
            position_rate: self.position_rate.map(at),
            s: at(self.s),
        }
    }

    #[inline(always)]
    pub(super) fn fibre<L: Lane, O: Level>(&self, strands: &Strands, block: usize, part: usize) -> Fibre<L> {
        let q = block * MAX_LANES + part * L::LANES;
        let zero = L::splat(0.0);
        let [x, y] = self.position;
        let mut fibre = Fibre {
            position: [x.part(q), y.part(q)],
            position_rate: [zero; 2],
            s: self.s.part(q),
            gamma: parts(&strands.gamma, part),
            gamma_rate: [zero; 3],
        };
        if O::REQUEST >= Request::Rate {
            let [dx, dy] = self.position_rate;
            fibre.position_rate = [dx.part(q), dy.part(q)];
            fibre.gamma_rate = parts(&strands.gamma_rate, part);
        }
        fibre
    }
}
