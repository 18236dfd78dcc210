//! The order in which blocks of points are summed.

use crate::scalar::{Lane, lanes_disagreed};

/// Goes through the points block by block; once more, and lane by lane through the blocks whose lanes disagree, if any did.
///
/// It leaves the loops with a single place where the law is evaluated, which is what makes compilers inline it there, and without a call
/// in the first pass, which would spill every register.
pub(super) struct Walk {
    points: usize,
    lanes: usize,
    careful: bool,
    block: usize,
    lane: Option<usize>,
}

impl Walk {
    #[inline(always)]
    pub(super) fn over<L: Lane>(points: usize) -> Self {
        Self { points, lanes: L::LANES, careful: false, block: 0, lane: None }
    }

    /// The first point of the block to evaluate, and the one lane of it to use where it is taken apart; `None` at the end of the pass.
    #[inline(always)]
    pub(super) fn place(&self) -> Option<(usize, Option<usize>)> {
        if self.block < self.points { Some((self.block, self.lane)) } else { None }
    }

    /// Goes on; whether the block just evaluated counts. Lanes that disagree are all to be evaluated again, each on its own.
    #[inline(always)]
    pub(super) fn advance(&mut self) -> bool {
        if !self.careful {
            self.block += self.lanes;
            return true;
        }
        match self.lane {
            None if lanes_disagreed() => {
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

    /// At the end of a pass: whether another, careful one is needed, because lanes disagreed somewhere.
    #[inline(always)]
    pub(super) fn again(&mut self) -> bool {
        if self.careful || !lanes_disagreed() {
            return false;
        }
        *self = Self { careful: true, block: 0, lane: None, ..*self };
        true
    }
}
