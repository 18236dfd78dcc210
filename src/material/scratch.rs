//! Room for the blocks of a sum, kept by each thread: clearing it at every call would cost as much as a block of points.

use std::cell::Cell;

use super::blocks::{Derivatives, Strands};
use crate::scalar::lane::MAX_LANES;

/// Blocks laid out before the law is asked.
pub(super) const BLOCKS: usize = 8;

/// See the module.
pub(super) struct Scratch {
    pub(super) strands: [Strands; BLOCKS],
    pub(super) derivatives: [Derivatives; BLOCKS],
    /// x, y and s of each entry, where these are not those of consecutive points.
    pub(super) places: [[f64; BLOCKS * MAX_LANES]; 3],
}

impl Scratch {
    const ZERO: Self = Self {
        strands: [Strands::ZERO; BLOCKS],
        derivatives: [Derivatives::ZERO; BLOCKS],
        places: [[0.0; BLOCKS * MAX_LANES]; 3],
    };
}

thread_local! {
    static KEPT: Cell<Option<Box<Scratch>>> = const { Cell::new(None) };
}

/// A scratch on loan: taken from this thread, or fresh where it is out, as when a law asks for a sum within a sum.
///
/// A loan and not a closure's argument: what a closure returns through the thread's storage is copied, and a response is large.
pub(super) struct Loan(Option<Box<Scratch>>);

impl Loan {
    #[inline(always)]
    pub(super) fn take() -> Self {
        Self(KEPT.try_with(Cell::take).unwrap_or(None))
    }

    #[inline(always)]
    pub(super) fn scratch(&mut self) -> &mut Scratch {
        self.0.get_or_insert_with(fresh)
    }
}

impl Drop for Loan {
    #[inline(always)]
    fn drop(&mut self) {
        let scratch = self.0.take();
        // where the thread is ending, it is simply dropped
        let _ = KEPT.try_with(|kept| kept.set(scratch));
    }
}

/// Out of line: its room would be reached for at every call.
#[cold]
#[inline(never)]
fn fresh() -> Box<Scratch> {
    Box::new(Scratch::ZERO)
}
