//! What is linearised: eight elements, number by number.

use super::rows::{ELEMENTS, MatrixRows, NO_MATRIX, NOTHING, Row};
use super::{STAGES, packed};
use crate::lie::{Twist, Wrench};
use crate::rod::element::ElementState;

/// Lengths and strain twists of the elements of a block.
#[derive(Clone)]
pub(crate) struct Twists {
    pub(super) h: Row,
    pub(super) xi: [[Row; 6]; STAGES],
}

impl Twists {
    pub(crate) fn new() -> Self {
        Self { h: [1.0; ELEMENTS], xi: [[NOTHING; 6]; STAGES] }
    }

    pub(crate) fn set<const S: usize>(&mut self, i: usize, h: f64, xi: &[Twist; S]) {
        self.h[i] = h;
        for (rows, xi) in self.xi.iter_mut().zip(xi) {
            put(rows, i, &xi.to_array());
        }
    }
}

/// An element is done with its twists, its internal wrenches and tangents, the wrench at its start, and its loads.
#[derive(Clone)]
pub(crate) struct Linearised {
    pub(super) twists: Twists,
    pub(super) internal: [[Row; 6]; STAGES],
    pub(super) tangent: [[Row; 21]; STAGES],
    pub(super) wrench_at_start: [Row; 6],
    pub(super) loads: Loads,
    /// Whether there are any.
    pub(super) loaded: bool,
    /// Whether their forces, or moments, change in space with the rotation of the section.
    pub(crate) turning: bool,
    /// The strains that do not vary.
    pub(super) fixed: [bool; 6],
}

/// Distributed loads that do not depend on where they act, and what they make of the wrenches.
#[derive(Clone)]
pub(super) struct Loads {
    /// At the stages, in their frames; of loads that do not turn the force alone, in the frame of the first node.
    pub(super) wrench: [[Row; 6]; STAGES],
    /// Its derivative in the rotation of the section, of loads that turn: moment and force.
    pub(super) slope: [[MatrixRows; 2]; STAGES],
    /// Λ at stages and end.
    pub(super) internal: [[Row; 6]; STAGES + 1],
}

impl Linearised {
    pub(crate) fn new() -> Self {
        Self {
            twists: Twists::new(),
            internal: [[NOTHING; 6]; STAGES],
            tangent: [[NOTHING; 21]; STAGES],
            wrench_at_start: [NOTHING; 6],
            loads: Loads {
                wrench: [[NOTHING; 6]; STAGES],
                slope: [[NO_MATRIX; 2]; STAGES],
                internal: [[NOTHING; 6]; STAGES + 1],
            },
            loaded: false,
            turning: false,
            fixed: [false; 6],
        }
    }

    /// Whether shear and extension are all fixed.
    pub(super) fn is_stiff(&self) -> bool {
        self.fixed[3..] == [true; 3]
    }

    /// Puts an element into place i.
    pub(crate) fn set<const S: usize>(&mut self, i: usize, element: &ElementState<'_, S>, start: &Wrench) {
        self.twists.set(i, element.h, &element.xi);
        self.fixed = element.constraint.fixed();
        let rows = if self.is_stiff() { 3 } else { 6 };
        for (k, response) in element.response.iter().enumerate() {
            put(&mut self.internal[k], i, &response.wrench.to_array());
            let tangent = response.tangent.as_slice();
            for r in 0..rows {
                for c in 0..=r {
                    self.tangent[k][packed(r, c)][i] = tangent[6 * c + r];
                }
            }
        }
        put(&mut self.wrench_at_start, i, &start.to_array());
        self.loaded = !element.load.is_none();
        if self.loaded {
            self.loads.set(i, element, self.turning);
        }
    }
}

impl Loads {
    fn set<const S: usize>(&mut self, i: usize, element: &ElementState<'_, S>, turning: bool) {
        for (rows, wrench) in self.internal.iter_mut().zip(element.stage_wrench) {
            put(rows, i, &wrench.to_array());
        }
        put(&mut self.internal[S], i, &element.wrench_at_end.to_array());
        if turning {
            self.set_turning(i, element);
            return;
        }
        for k in 0..S {
            let force = element.dead_force(k);
            for (row, value) in self.wrench[k][3..].iter_mut().zip(&force) {
                row[i] = *value;
            }
        }
    }

    fn set_turning<const S: usize>(&mut self, i: usize, element: &ElementState<'_, S>) {
        for (k, pose) in element.kinematics.stage.iter().enumerate() {
            let Some(load) = element.load.at_stage(k, pose) else { return };
            put(&mut self.wrench[k], i, &load.wrench.to_array());
            for r in 0..3 {
                for c in 0..3 {
                    self.slope[k][0][r][c][i] = load.tangent[(r, c)];
                    self.slope[k][1][r][c][i] = load.tangent[(3 + r, c)];
                }
            }
        }
    }
}

#[inline(always)]
fn put(rows: &mut [Row; 6], i: usize, six: &[f64; 6]) {
    for (row, value) in rows.iter_mut().zip(six) {
        row[i] = *value;
    }
}
