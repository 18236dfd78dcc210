//! Elements eight at a time, a lane an element: [`element`](super::element) once more for the registers of the machine, with whatever strains fixed, and
//! with distributed loads that do not depend on where they act.
//!
//! What a lane computes does not depend on what stands in the others, nor on how many are in use: results are the same to the bit however
//! elements are grouped. Where a lane's elimination would have needed pivoting it says so, and the element is done alone.

mod algebra;
mod answer;
mod condense;
mod dead_terms;
mod eliminate;
mod linearised;
mod loads;
mod magnus;
mod motion;
mod rows;

use nalgebra::{Matrix3, Vector3};

use super::collocation::Collocation;
use super::element::Kinematics;
use crate::lie::{Pose, Twist};
use crate::scalar::Kernel;
use crate::scalar::lane::{dispatch, dispatch_few};
use condense::Scratch;
use motion::Motions;
use rows::{BlockRows, NO_BLOCK};

pub(super) use answer::{DEAD_COLUMNS, END, answer, turn};
pub(crate) use eliminate::LEAST_DETERMINANT;
pub(super) use eliminate::LEAST_STIFFNESS;
pub(crate) use linearised::{Linearised, Twists};
pub(super) use magnus::stumpff;
pub(crate) use rows::{ELEMENTS, NOTHING, Row};

/// Stages of the element of the highest order.
pub(super) const STAGES: usize = 3;

/// So many elements go into registers of half the width.
const FEW: usize = 4;

/// [`Collocation::taylor`], zero beyond the number of stages.
pub(super) type Taylor = [[f64; STAGES]; STAGES];

/// The number of stages, the Taylor data of these and, after them, of the end, and the weights a_kl and b_l.
///
/// It is not in the type, so that kernels are compiled once, and short enough for the instruction cache.
pub(super) struct Table {
    pub(super) stages: usize,
    pub(super) taylor: [Taylor; STAGES + 1],
    pub(super) a: [[f64; STAGES]; STAGES],
    pub(super) b: [f64; STAGES],
}

impl Table {
    pub(super) fn of<const S: usize>(table: &Collocation<S>) -> Self {
        let mut taylor = [[[0.0; STAGES]; STAGES]; STAGES + 1];
        for (into, from) in taylor.iter_mut().zip(table.stage.iter().chain([&table.end])) {
            for (into, from) in into.iter_mut().zip(from) {
                into[..S].copy_from_slice(from);
            }
        }
        let (mut a, mut b) = ([[0.0; STAGES]; STAGES], [0.0; STAGES]);
        b[..S].copy_from_slice(&table.b);
        for (into, from) in a.iter_mut().zip(&table.a) {
            into[..S].copy_from_slice(from);
        }
        Self { stages: S, taylor, a, b }
    }
}

/// Runs a kernel on registers as wide as so many elements have use for.
#[inline(always)]
pub(super) fn run<K: Kernel>(kernel: K, count: usize) -> K::Output {
    if count > FEW { dispatch(kernel) } else { dispatch_few(kernel) }
}

/// Where entry (r, c ≤ r) of a symmetric matrix is kept.
#[inline(always)]
const fn packed(r: usize, c: usize) -> usize {
    r * (r + 1) / 2 + c
}

/// Elements with their strains eliminated.
#[derive(Clone)]
pub(crate) struct Eliminated {
    /// (δω, δν) of every stage; δν is not written where it is fixed.
    pub(super) strain: [[BlockRows; 2]; STAGES],
    /// What strains and loads make of (ζ_{i+1}, δΛ_{i+1}).
    pub(super) end: [BlockRows; 4],
    /// Of the end: rotation by rows, then position.
    pub(super) pose: [Row; 12],
    /// Not 0 where the elimination cannot be trusted.
    pub(super) suspect: Row,
    scratch: Scratch,
}

impl Eliminated {
    pub(crate) fn new() -> Self {
        Self {
            strain: [[NO_BLOCK; 2]; STAGES],
            end: [NO_BLOCK; 4],
            pose: [NOTHING; 12],
            suspect: NOTHING,
            scratch: Scratch::new(),
        }
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
    run(motion::Move { table, twists, count, out }, count);
}

#[inline(never)]
fn condense_block(table: &Table, state: &Linearised, count: usize, out: &mut Eliminated) {
    let Eliminated { strain, end, pose, suspect, scratch } = out;
    let out = condense::Out { strain, end, pose, suspect };
    run(condense::Condense { table, state, count, scratch, out }, count);
}
