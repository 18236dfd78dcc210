//! The condensation itself.

use std::ops::Range;

use super::layout::{Column, Kind, Layout, Loads};
use super::{Condensed, Work};
use crate::lie::Wrench;
use crate::rod::collocation::Collocation;
use crate::rod::element::{ElementState, Linearisation};
use crate::rod::lanes::{self, ELEMENTS, NOTHING, Row};
use crate::rod::planar;
use crate::rod::stages::{ONE, WRENCH, ZETA, solve_general};

impl<const S: usize> Condensed<S> {
    /// Makes room for so many elements of a kind.
    pub(crate) fn begin(&mut self, count: usize, kind: &Kind) {
        self.layout = Layout::of(kind, S);
        self.defect.clear();
        self.passed.clear();
        // what is there is overwritten
        self.rows.resize(self.rows.len().max(count.div_ceil(ELEMENTS) * self.layout.rows), NOTHING);
    }

    /// Condenses a block of elements, eight or what is left of them; here they are those from `place` on. `Err` with the number of one that is
    /// singular.
    pub(crate) fn fill<'e>(
        &mut self,
        table: &Collocation<S>,
        kind: &Kind,
        place: usize,
        block: Range<usize>,
        element: impl Fn(usize) -> ElementState<'e, S>,
        start: &[Wrench],
    ) -> Result<(), usize> {
        if kind.loads == Loads::Placed {
            for i in block.clone() {
                self.fill_alone(table, place + i - block.start, &element(i)).ok_or(i)?;
            }
            return Ok(());
        }
        let mut work = self.work.take().unwrap_or_else(|| Box::new(Work::new()));
        let (first, count) = (block.start, block.len());
        let into = &mut self.rows[place / ELEMENTS * self.layout.rows..][..self.layout.rows];
        let suspect = if kind.plane {
            let (linearised, eliminated) = &mut work.plane;
            linearised.turning = kind.loads > Loads::Dead;
            for i in block.clone() {
                linearised.set(i - first, &element(i), &start[i]);
            }
            planar::condense(table, &kind.constraint, linearised, count, eliminated);
            self.layout.take_plane(eliminated, into);
            eliminated.suspect
        } else {
            let (linearised, eliminated) = &mut work.space;
            linearised.turning = kind.loads > Loads::Dead;
            for i in block.clone() {
                linearised.set(i - first, &element(i), &start[i]);
            }
            lanes::condense(table, linearised, count, eliminated);
            self.layout.take_space(eliminated, into);
            eliminated.suspect
        };
        self.work = Some(work);
        for i in block {
            if suspect[i - first] != 0.0 {
                self.fill_alone(table, place + i - first, &element(i)).ok_or(i)?;
            }
        }
        Ok(())
    }

    /// By elimination of all strains at once, with pivoting. `None` where the stage matrix is singular.
    pub(crate) fn fill_alone(
        &mut self,
        table: &Collocation<S>,
        i: usize,
        state: &ElementState<'_, S>,
    ) -> Option<()> {
        let element = Linearisation::new(table, state);
        let strain = solve_general(&element, &state.constraint.fixed())?;
        let (layout, lane) = (self.layout, i % ELEMENTS);
        let rows = &mut self.rows[i / ELEMENTS * layout.rows..][..layout.rows];
        for c in 0..layout.columns {
            let from = match layout.column(c) {
                Column::Wrench(j) => WRENCH + j,
                Column::One => ONE,
                Column::Zeta(j) => ZETA + j,
            };
            for k in 0..S {
                for (f, &place) in layout.strains.iter().enumerate() {
                    rows[layout.strain(k, f, c)][lane] = strain[k][(place, from)];
                }
            }
            for (r, &place) in layout.places.iter().enumerate() {
                let (mut zeta, mut wrench) = (0.0, 0.0);
                if let Column::Zeta(j) = layout.column(c) {
                    wrench = element.wrench_from_zeta[(place, j)];
                }
                for l in 0..S {
                    for j in 0..6 {
                        zeta += element.end_strain[l][(place, j)] * strain[l][(j, from)];
                        wrench += element.wrench_from_strain[l][(place, j)] * strain[l][(j, from)];
                    }
                }
                rows[layout.zeta(r, c)][lane] = zeta;
                rows[layout.wrench(r, c)][lane] = wrench;
            }
        }
        self.set_end(i, state);
        Some(())
    }

    fn set_end(&mut self, i: usize, state: &ElementState<'_, S>) {
        let (layout, lane, end) = (self.layout, i % ELEMENTS, &state.kinematics.end);
        let (r, p) = (&end.rotation, &end.position);
        let rows = &mut self.rows[i / ELEMENTS * layout.rows..][layout.pose()..layout.rows];
        if layout.plane {
            let pose = [r[(0, 0)], r[(0, 2)], p.z, p.x];
            for (row, value) in rows.iter_mut().zip(pose) {
                row[lane] = value;
            }
        } else {
            for (row, value) in rows.iter_mut().zip(r.transpose().iter().chain(p)) {
                row[lane] = *value;
            }
        }
    }
}

impl Work {
    fn new() -> Self {
        Self {
            space: (lanes::Linearised::new(), lanes::Eliminated::new()),
            plane: (planar::Linearised::new(), planar::Eliminated::new()),
        }
    }
}

impl Layout {
    fn take_space(&self, from: &lanes::Eliminated, into: &mut [Row]) {
        let mut into = into.iter_mut();
        for stage in &from.strain[..self.stages] {
            for rows in stage.as_flattened().iter().take(self.strains.len()) {
                put(&mut into, &rows[..self.columns]);
            }
        }
        for rows in from.end.as_flattened() {
            put(&mut into, &rows[..self.columns]);
        }
        put(&mut into, &from.pose);
    }

    fn take_plane(&self, from: &planar::Eliminated, into: &mut [Row]) {
        let mut into = into.iter_mut();
        for stage in &from.strain[..self.stages] {
            for rows in stage.iter().take(self.strains.len()) {
                put(&mut into, &rows[..self.columns]);
            }
        }
        for rows in from.zeta.iter().chain(&from.wrench) {
            put(&mut into, &rows[..self.columns]);
        }
        put(&mut into, &from.pose);
    }
}

/// Writes some rows after those that are written already.
#[inline(always)]
fn put(into: &mut std::slice::IterMut<'_, Row>, rows: &[Row]) {
    // few and short: a loop is faster than a copy of the whole
    for (row, into) in rows.iter().zip(into) {
        *into = *row;
    }
}
