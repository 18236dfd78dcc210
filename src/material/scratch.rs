//! Room for the blocks of a sum, kept by each thread: clearing it at every call would cost as much as a block of points.

use std::cell::RefCell;

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
    static SCRATCH: RefCell<Scratch> = const { RefCell::new(Scratch::ZERO) };
}

/// Calls `f` with this thread's room, or with fresh room where a law asks for a sum within a sum.
#[inline(always)]
pub(super) fn with_scratch<T>(f: impl FnOnce(&mut Scratch) -> T) -> T {
    SCRATCH.with(|scratch| match scratch.try_borrow_mut() {
        Ok(mut scratch) => f(&mut scratch),
        Err(_) => with_fresh(f),
    })
}

/// Out of line: its room would be cleared, or at least reached for, at every call.
#[cold]
#[inline(never)]
fn with_fresh<T>(f: impl FnOnce(&mut Scratch) -> T) -> T {
    let mut fresh = Scratch::ZERO;
    f(&mut fresh)
}
