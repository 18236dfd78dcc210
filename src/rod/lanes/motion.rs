//! The kernel of the kinematics: poses of stages and end of eight elements from their strain twists.

use super::algebra::dot;
use super::magnus::{exp, exponent, stumpff, taylor_data};
use super::rows::Row;
use super::{STAGES, Table, Twists};
use crate::scalar::{Kernel, Lane};

/// Poses of stages and end of the elements of a block: rotation by rows, then position.
pub(super) struct Motions {
    pub(super) pose: [[Row; 12]; STAGES + 1],
    /// Not 0 where the angle of an element is beyond the series.
    pub(super) suspect: Row,
}

pub(super) struct Move<'a> {
    pub(super) table: &'a Table,
    pub(super) twists: &'a Twists,
    /// Elements in use.
    pub(super) count: usize,
    pub(super) out: &'a mut Motions,
}

impl Kernel for Move<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { table, twists, count, out } = self;
        for at in (0..count).step_by(L::LANES) {
            let mut suspect = L::splat(0.0);
            for k in 0..=table.stages {
                let alpha = taylor_data::<L>(&table.taylor[k], twists, table.stages, at);
                let omega = exponent(&alpha, table.stages);
                let c = stumpff(dot(&omega.first, &omega.first), &mut suspect);
                exp(&omega, &c).store(&mut out.pose[k], at);
            }
            suspect.store(&mut out.suspect[at..]);
        }
    }
}
