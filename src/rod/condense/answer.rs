//! Elements of a rod under dead forces, once it is known what the rod beyond each answers to a rotation: everything by three numbers, in the plane by one.
//!
//! δm_i = S_i w_i + s_i and δn_i = n_i × w_i put into the columns of δΛ_i leave those of w_i and of 1.

use super::{Condensed, DeadBlocks, Layout};
use crate::lie::{Strain, Wrench};
use crate::rod::lanes::{self, ELEMENTS, NOTHING, Row};
use crate::rod::planar;

/// S_i, or s_i as the last column; rows and columns beyond the first in the plane are of no effect.
pub(crate) type Relation = [[f64; 4]; 3];

/// What is kept of all elements, in blocks: strains, displacement of the end, moment there, each by (w_i, 1), and the rotation of the end.
pub(crate) struct Answers<const S: usize> {
    plane: bool,
    strains: &'static [usize],
    /// Of a block.
    size: usize,
    rows: Vec<Row>,
    /// Of one block in space, by (δm_i, 1, w_i).
    turned: Vec<Row>,
}

impl<const S: usize> Default for Answers<S> {
    fn default() -> Self {
        Self { plane: false, strains: &[], size: 0, rows: Vec::new(), turned: Vec::new() }
    }
}

/// What an element answers: rotation and displacement of its end, and the moment there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Answer {
    pub(crate) turn: [f64; 3],
    pub(crate) shift: [f64; 3],
    pub(crate) moment: [f64; 3],
}

impl<const S: usize> Answers<S> {
    /// Makes room for the elements of a mesh.
    pub(crate) fn begin(&mut self, elements: &Condensed<S>, count: usize) {
        let Layout { plane, strains, .. } = elements.layout;
        (self.plane, self.strains) = (plane, strains);
        self.size = if plane { (strains.len() * S + 4) * 2 + 2 } else { (strains.len() * S + 9) * 4 + 9 };
        // what is there is overwritten
        self.rows.resize(self.rows.len().max(count.div_ceil(ELEMENTS) * self.size), NOTHING);
        let turned = (strains.len() * S + lanes::END) * lanes::DEAD_COLUMNS + 9;
        self.turned.resize(self.turned.len().max(turned), NOTHING);
    }

    /// Looks at a block in space: its elements are in `elements` from `place` on, and have these wrenches at their starts.
    pub(crate) fn turn(&mut self, elements: &Condensed<S>, place: usize, start: &[Wrench]) {
        let layout = &elements.layout;
        let mut force = [NOTHING; 3];
        for (lane, wrench) in start.iter().enumerate() {
            for i in 0..3 {
                force[i][lane] = wrench.force[i];
            }
        }
        let strains = S * layout.strains.len();
        lanes::turn(elements.block(place), layout.columns, strains, &force, start.len(), &mut self.turned);
    }

    /// Element number `lane` of the block that was last looked at.
    #[inline(always)]
    pub(crate) fn turned(&self, lane: usize) -> DeadBlocks<3> {
        const W: usize = lanes::DEAD_COLUMNS;
        let from = S * self.strains.len() * W;
        let rows = &self.turned[from..from + lanes::END * W];
        let mut t = DeadBlocks::zero();
        for r in 0..3 {
            let (turn, moment) = (&rows[r * W..][..W], &rows[(6 + r) * W..][..W]);
            for c in 0..3 {
                t.turn_from_moment[r][c] = turn[c][lane];
                t.turn_from_turn[r][c] = turn[4 + c][lane];
                t.moment_from_moment[r][c] = moment[c][lane];
                t.moment_from_turn[r][c] = moment[4 + c][lane];
            }
            (t.turn[r], t.moment[r]) = (turn[3][lane], moment[3][lane]);
        }
        t
    }

    /// Takes over a block: its elements are in `elements` from `place` on, and from `first` on here. In space it is the one last
    /// [looked at](Self::turn).
    pub(crate) fn take(
        &mut self,
        first: usize,
        elements: &Condensed<S>,
        place: usize,
        relations: &[Relation],
        start: &[Wrench],
    ) {
        let layout = &elements.layout;
        let into = &mut self.rows[first / ELEMENTS * self.size..][..self.size];
        let (mut relation, mut force) = ([[NOTHING; 4]; 3], [NOTHING; 3]);
        for (lane, (r, wrench)) in relations.iter().zip(start).enumerate() {
            for i in 0..3 {
                for j in 0..4 {
                    relation[i][j][lane] = r[i][j];
                }
                force[i][lane] = wrench.force[i];
            }
        }
        let count = relations.len();
        let from = elements.block(place);
        let strains = S * layout.strains.len();
        if self.plane {
            planar::answer(from, layout.columns, strains, &relation, &force, count, into);
        } else {
            lanes::answer(&self.turned, strains + lanes::END, &relation, count, into);
        }
    }

    /// What element i answers when its first node turns and moves.
    #[inline(always)]
    pub(crate) fn of(&self, i: usize, turn: &[f64; 3], shift: &[f64; 3]) -> Answer {
        let (block, lane) = (&self.rows[i / ELEMENTS * self.size..][..self.size], i % ELEMENTS);
        let at = |row: usize| block[row][lane];
        if self.plane {
            let rows = 2 * S * self.strains.len();
            let by = |r: usize| at(rows + 2 * r) * turn[1] + at(rows + 2 * r + 1);
            let (cos, sin) = (at(rows + 8), at(rows + 9));
            let (z, x) = (cos * shift[2] + sin * shift[0], cos * shift[0] - sin * shift[2]);
            return Answer {
                turn: [0.0, by(0), 0.0],
                shift: [by(2) + x, 0.0, by(1) + z],
                moment: [0.0, by(3), 0.0],
            };
        }
        let rows = 4 * S * self.strains.len();
        let mut all = [0.0; 9];
        for (r, value) in all.iter_mut().enumerate() {
            let row = rows + 4 * r;
            *value = at(row) * turn[0] + at(row + 1) * turn[1] + at(row + 2) * turn[2] + at(row + 3);
        }
        let [a, b, c, mut x, mut y, mut z, l, m, n] = all;
        let rotation = rows + 36;
        for j in 0..3 {
            // Rᵀ of the displacement
            x += at(rotation + 3 * j) * shift[j];
            y += at(rotation + 3 * j + 1) * shift[j];
            z += at(rotation + 3 * j + 2) * shift[j];
        }
        Answer { turn: [a, b, c], shift: [x, y, z], moment: [l, m, n] }
    }

    /// δξ at the stages of a block of elements whose first nodes turn so.
    pub(crate) fn strains(&self, first: usize, turns: &[[f64; 3]], into: &mut Vec<[Strain; S]>) {
        let block = &self.rows[first / ELEMENTS * self.size..][..self.size];
        let mut turn = [NOTHING; 3];
        for (lane, w) in turns.iter().enumerate() {
            for (row, w) in turn.iter_mut().zip(w) {
                row[lane] = *w;
            }
        }
        let mut strains = [[NOTHING; 6]; S];
        let width = if self.plane { 2 } else { 4 };
        let mut rows = block.chunks_exact(width);
        for stage in &mut strains {
            for &place in self.strains {
                let Some(row) = rows.next() else { break };
                let sum = &mut stage[place];
                if self.plane {
                    for lane in 0..ELEMENTS {
                        sum[lane] = row[0][lane] * turn[1][lane] + row[1][lane];
                    }
                } else {
                    for lane in 0..ELEMENTS {
                        sum[lane] = row[0][lane] * turn[0][lane]
                            + row[1][lane] * turn[1][lane]
                            + row[2][lane] * turn[2][lane]
                            + row[3][lane];
                    }
                }
            }
        }
        for lane in 0..turns.len() {
            let mut element = [Strain::zero(); S];
            for (strain, rows) in element.iter_mut().zip(&strains) {
                let [a, b, c, x, y, z] = rows.each_ref().map(|row| row[lane]);
                *strain = Strain::from_array([a, b, c, x, y, z]);
            }
            into.push(element);
        }
    }
}
