//! Elements without distributed loads, eight at a time, a lane an element: [`element`](super::element) and [`condense`](super::condense) once more
//! for the registers of the machine.
//!
//! What a lane computes does not depend on what stands in the others, nor on how many are in use: results are the same to the bit however
//! elements are grouped. Where a lane's elimination would have needed pivoting it says so, and the element is done alone.

mod algebra;
mod condense;
mod eliminate;
mod magnus;
mod motion;
mod rows;

use nalgebra::{Matrix3, Vector3};

use super::collocation::Collocation;
use super::element::Kinematics;
use crate::lie::{Pose, Twist, Wrench};
use crate::material::Response;
use crate::scalar::lane::{dispatch, dispatch_few};
use condense::Scratch;
use motion::Motions;
use rows::{BlockRows, COLUMNS, NO_BLOCK, NOTHING, Row};

pub(crate) use rows::ELEMENTS;

/// Stages of the element of the highest order.
const STAGES: usize = 3;

/// So many elements go into registers of half the width.
const FEW: usize = 4;

/// [`Collocation::taylor`], zero beyond the number of stages.
type Taylor = [[f64; STAGES]; STAGES];

/// The number of stages, and the Taylor data of these and, after them, of the end.
///
/// It is not in the type, so that kernels are compiled once, and short enough for the instruction cache.
struct Table {
    stages: usize,
    taylor: [Taylor; STAGES + 1],
}

impl Table {
    fn of<const S: usize>(table: &Collocation<S>) -> Self {
        let mut taylor = [[[0.0; STAGES]; STAGES]; STAGES + 1];
        for (into, from) in taylor.iter_mut().zip(table.stage.iter().chain([&table.end])) {
            for (into, from) in into.iter_mut().zip(from) {
                into[..S].copy_from_slice(from);
            }
        }
        Self { stages: S, taylor }
    }
}

/// Lengths and strain twists of the elements of a block.
#[derive(Clone)]
pub(crate) struct Twists {
    h: Row,
    xi: [[Row; 6]; STAGES],
}

impl Twists {
    pub(crate) fn new() -> Self {
        Self { h: [1.0; ELEMENTS], xi: [[NOTHING; 6]; STAGES] }
    }

    pub(crate) fn set<const S: usize>(&mut self, i: usize, h: f64, xi: &[Twist; S]) {
        self.h[i] = h;
        for (rows, xi) in self.xi.iter_mut().zip(xi) {
            for (row, value) in rows.iter_mut().zip(xi.to_array()) {
                row[i] = value;
            }
        }
    }
}

/// What is linearised: an element is done with its twists, its internal wrenches and tangents, and the wrench at its start.
#[derive(Clone)]
pub(crate) struct Linearised {
    pub(crate) twists: Twists,
    internal: [[Row; 6]; STAGES],
    tangent: [[Row; 21]; STAGES],
    wrench_at_start: [Row; 6],
}

impl Linearised {
    pub(crate) fn new() -> Self {
        Self {
            twists: Twists::new(),
            internal: [[NOTHING; 6]; STAGES],
            tangent: [[NOTHING; 21]; STAGES],
            wrench_at_start: [NOTHING; 6],
        }
    }

    /// Puts an element into place i.
    pub(crate) fn set<const S: usize>(
        &mut self,
        i: usize,
        (h, xi): (f64, &[Twist; S]),
        response: &[Response; S],
        wrench_at_start: &Wrench,
    ) {
        self.twists.set(i, h, xi);
        for (k, response) in response.iter().enumerate() {
            for (row, value) in self.internal[k].iter_mut().zip(response.wrench.to_array()) {
                row[i] = value;
            }
            let tangent = response.tangent.as_slice();
            for r in 0..6 {
                for c in 0..=r {
                    self.tangent[k][packed(r, c)][i] = tangent[6 * c + r];
                }
            }
        }
        for (row, value) in self.wrench_at_start.iter_mut().zip(wrench_at_start.to_array()) {
            row[i] = value;
        }
    }
}

/// Where entry (r, c ≤ r) of a symmetric matrix is kept.
#[inline(always)]
const fn packed(r: usize, c: usize) -> usize {
    r * (r + 1) / 2 + c
}

/// Elements with their strains eliminated.
#[derive(Clone)]
pub(crate) struct Eliminated {
    /// (δω, δν) of every stage.
    strain: [[BlockRows; 2]; STAGES],
    /// What of (ζ_{i+1}, δΛ_{i+1}) the strains make.
    end: [BlockRows; 4],
    /// Not 0 where the elimination cannot be trusted.
    suspect: Row,
    scratch: Scratch,
}

impl Eliminated {
    pub(crate) fn new() -> Self {
        Self {
            strain: [[NO_BLOCK; 2]; STAGES],
            end: [NO_BLOCK; 4],
            suspect: NOTHING,
            scratch: Scratch::new(),
        }
    }

    /// Whether the elimination of element i can be trusted.
    pub(super) fn is_sound(&self, i: usize) -> bool {
        self.suspect[i] == 0.0
    }

    /// Copies the columns (δΛ_i, 1) of δξ_k, six rows each.
    pub(super) fn strain(&self, i: usize, k: usize, into: &mut [f64]) {
        for (c, into) in into.chunks_exact_mut(6).enumerate().take(COLUMNS) {
            for r in 0..3 {
                into[r] = self.strain[k][0][r][c][i];
                into[3 + r] = self.strain[k][1][r][c][i];
            }
        }
    }

    /// Column c of (ζ_{i+1}, δΛ_{i+1}), as the strains make it.
    #[inline(always)]
    pub(super) fn end(&self, i: usize, c: usize) -> [f64; 12] {
        let mut column = [0.0; 12];
        for (into, rows) in column.chunks_exact_mut(3).zip(&self.end) {
            for (into, row) in into.iter_mut().zip(rows) {
                *into = row[c][i];
            }
        }
        column
    }
}

/// Poses of stages and end of the first elements of a block.
pub(crate) fn kinematics<const S: usize>(
    table: &Collocation<S>,
    twists: &Twists,
    into: &mut [Kinematics<f64, S>],
) {
    let mut out = Motions { pose: [[NOTHING; 12]; STAGES + 1], suspect: NOTHING };
    move_block(&Table::of(table), twists, into.len(), &mut out);
    for (i, into) in into.iter_mut().enumerate() {
        if out.suspect[i] != 0.0 {
            let xi = std::array::from_fn(|k| Twist::from_array(twists.xi[k].map(|row| row[i])));
            *into = Kinematics::new(table, &xi, twists.h[i]);
            continue;
        }
        for (pose, rows) in into.stage.iter_mut().zip(&out.pose) {
            *pose = pose_of(rows, i);
        }
        into.end = pose_of(&out.pose[S], i);
    }
}

#[inline(always)]
fn pose_of(rows: &[Row; 12], i: usize) -> Pose {
    let v = rows.each_ref().map(|row| row[i]);
    let rotation = Matrix3::new(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]);
    Pose::new(rotation, Vector3::new(v[9], v[10], v[11]))
}

/// Linearises and eliminates the first `count` elements of a block.
pub(crate) fn condense<const S: usize>(
    table: &Collocation<S>,
    state: &Linearised,
    count: usize,
    out: &mut Eliminated,
) {
    condense_block(&Table::of(table), state, count, out);
}

#[inline(never)]
fn move_block(table: &Table, twists: &Twists, count: usize, out: &mut Motions) {
    let kernel = motion::Move { table, twists, count, out };
    if count > FEW { dispatch(kernel) } else { dispatch_few(kernel) }
}

#[inline(never)]
fn condense_block(table: &Table, state: &Linearised, count: usize, out: &mut Eliminated) {
    let Eliminated { strain, end, suspect, scratch } = out;
    let out = condense::Out { strain, end, suspect };
    let kernel = condense::Condense { table, state, count, scratch, out };
    if count > FEW { dispatch(kernel) } else { dispatch_few(kernel) }
}

#[cfg(test)]
mod tests;
