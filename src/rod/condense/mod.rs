//! Linearised elements with their stage strains eliminated: what the chain of elements is made of.
//!
//! Eight elements at a time, in [lanes](super::lanes) or in the [plane](super::planar); one alone, [with pivoting](fill), where that cannot be trusted or its
//! loads depend on where they act. What is kept of an element is no more than its kind needs, number by number for eight elements.

mod answer;
mod fill;
mod layout;
mod links;

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::lanes::{self, ELEMENTS, NOTHING, Row};
use super::planar;
use super::stages::COLUMNS;
use crate::lie::{Pose, Strain};
use layout::{Column, Layout};

pub(crate) use answer::{Answers, Relation};
pub(crate) use layout::{Kind, Loads};
pub(crate) use links::{Blocks, DeadBlocks};

/// ζ_{i+1} and δΛ_{i+1} from ζ_i and δΛ_i.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transfer {
    pub(crate) zeta_from_zeta: Matrix6<f64>,
    pub(crate) zeta_from_wrench: Matrix6<f64>,
    pub(crate) wrench_from_zeta: Matrix6<f64>,
    pub(crate) wrench_from_wrench: Matrix6<f64>,
    pub(crate) zeta: Vector6<f64>,
    pub(crate) wrench: Vector6<f64>,
}

/// Memory of one block of elements.
struct Work {
    space: (lanes::Linearised, lanes::Eliminated),
    plane: (planar::Linearised, planar::Eliminated),
}

/// The elements of a mesh: the transfer of each, and δξ_k = X_k (δΛ_i, 1, ζ_i).
pub(crate) struct Condensed<const S: usize> {
    layout: Layout,
    /// Blocks one after the other, [`Layout::rows`] each.
    rows: Vec<Row>,
    /// What is to be added to δΛ_{i+1}; empty where nothing is.
    defect: Vec<Vector6<f64>>,
    /// Elements whose transfer goes on behind their end, in ascending order.
    passed: Vec<(usize, Transfer)>,
    work: Option<Box<Work>>,
}

impl<const S: usize> Default for Condensed<S> {
    fn default() -> Self {
        let (rows, defect, passed) = (Vec::new(), Vec::new(), Vec::new());
        Self { layout: Layout::of(&Kind::default(), S), rows, defect, passed, work: None }
    }
}

impl<const S: usize> Condensed<S> {
    /// Whether the elements, and the chain of them, lie in the plane.
    pub(crate) fn is_plane(&self) -> bool {
        self.layout.plane && self.passed.is_empty()
    }

    /// Adds to δΛ at the end of every element.
    pub(crate) fn add_defect(&mut self, defect: impl Iterator<Item = Vector6<f64>>) {
        self.defect.clear();
        self.defect.extend(defect);
    }

    /// Lets the transfer of an element, the last that was so changed or one after it, go on to what is behind its end.
    pub(crate) fn pass(&mut self, i: usize, behind: impl FnOnce(&mut Transfer)) {
        let mut transfer = self.transfer(i);
        behind(&mut transfer);
        self.passed.push((i, transfer));
    }

    /// The rows of the block of element i.
    #[inline(always)]
    fn block(&self, i: usize) -> &[Row] {
        let rows = self.layout.rows;
        &self.rows[i / ELEMENTS * rows..][..rows]
    }

    /// The pose of the end of element i in the frame of its start.
    pub(crate) fn end_pose(&self, i: usize) -> Pose {
        let (rows, lane) = (&self.block(i)[self.layout.pose()..], i % ELEMENTS);
        if self.layout.plane {
            let four = [rows[0], rows[1], rows[2], rows[3]];
            return planar::pose_of(&four, lane);
        }
        let v: [f64; 12] = std::array::from_fn(|r| rows[r][lane]);
        let rotation = Matrix3::new(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]);
        Pose::new(rotation, Vector3::new(v[9], v[10], v[11]))
    }

    /// The transfer of element i in space.
    pub(crate) fn transfer(&self, i: usize) -> Transfer {
        if !self.passed.is_empty()
            && let Ok(found) = self.passed.binary_search_by_key(&i, |(at, _)| *at)
        {
            return self.passed[found].1;
        }
        let end = self.end_pose(i);
        let inverse = end.adjoint_inverse().to_matrix();
        let mut t = Transfer {
            zeta_from_zeta: inverse,
            zeta_from_wrench: Matrix6::zeros(),
            wrench_from_zeta: Matrix6::zeros(),
            // Ad_eᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]: Ad_e⁻¹ with its blocks the other way
            wrench_from_wrench: Matrix6::from_fn(|r, c| inverse[((r + 3) % 6, (c + 3) % 6)]),
            zeta: Vector6::zeros(),
            wrench: Vector6::zeros(),
        };
        for c in 0..self.layout.columns {
            let (zeta, wrench) = self.column(i, c);
            match self.layout.column(c) {
                Column::Wrench(j) => {
                    add(&mut t.zeta_from_wrench, &mut t.wrench_from_wrench, j, &zeta, &wrench)
                }
                Column::Zeta(j) => add(&mut t.zeta_from_zeta, &mut t.wrench_from_zeta, j, &zeta, &wrench),
                Column::One => (t.zeta, t.wrench) = (zeta, wrench),
            }
        }
        if let Some(defect) = self.defect.get(i) {
            t.wrench += defect;
        }
        t
    }

    /// What strains and loads make of ζ_{i+1} and δΛ_{i+1}, by one column.
    #[inline(always)]
    fn column(&self, i: usize, c: usize) -> (Vector6<f64>, Vector6<f64>) {
        let (layout, block, lane) = (&self.layout, self.block(i), i % ELEMENTS);
        let (mut zeta, mut wrench) = (Vector6::zeros(), Vector6::zeros());
        for (r, &place) in layout.places.iter().enumerate() {
            zeta[place] = block[layout.zeta(r, c)][lane];
            wrench[place] = block[layout.wrench(r, c)][lane];
        }
        (zeta, wrench)
    }

    /// δξ at the stages of all elements from the solution at their first nodes.
    pub(crate) fn strain_steps(&self, nodes: &[(Vector6<f64>, Vector6<f64>)], into: &mut Vec<[Strain; S]>) {
        into.clear();
        let layout = &self.layout;
        for (b, nodes) in nodes.chunks(ELEMENTS).enumerate() {
            let block = self.block(b * ELEMENTS);
            let mut columns = [NOTHING; COLUMNS];
            for (lane, (zeta, wrench)) in nodes.iter().enumerate() {
                for (c, row) in columns.iter_mut().enumerate().take(layout.columns) {
                    row[lane] = layout.column(c).of(zeta, wrench, 1.0);
                }
            }
            let mut strains = [[NOTHING; 6]; S];
            for k in 0..S {
                for (f, &place) in layout.strains.iter().enumerate() {
                    let sum = &mut strains[k][place];
                    let from = layout.strain(k, f, 0);
                    for (row, column) in block[from..from + layout.columns].iter().zip(&columns) {
                        for lane in 0..ELEMENTS {
                            sum[lane] += row[lane] * column[lane];
                        }
                    }
                }
            }
            for lane in 0..nodes.len() {
                into.push(strains.map(|rows| Strain::from_array(rows.map(|row| row[lane]))));
            }
        }
    }

    /// δξ at the stages of element i by a displacement and a change of wrench at its first node alone.
    pub(crate) fn strain_of_node(&self, i: usize, zeta: &Vector6<f64>, wrench: &Vector6<f64>) -> [Strain; S] {
        let (layout, block, lane) = (&self.layout, self.block(i), i % ELEMENTS);
        std::array::from_fn(|k| {
            let mut strain = [0.0; 6];
            for (f, &place) in layout.strains.iter().enumerate() {
                for c in 0..layout.columns {
                    strain[place] +=
                        block[layout.strain(k, f, c)][lane] * layout.column(c).of(zeta, wrench, 0.0);
                }
            }
            Strain::from_array(strain)
        })
    }
}

/// Adds a column to ζ and one to δΛ.
#[inline(always)]
fn add(zeta: &mut Matrix6<f64>, wrench: &mut Matrix6<f64>, j: usize, z: &Vector6<f64>, w: &Vector6<f64>) {
    for r in 0..6 {
        zeta[(r, j)] += z[r];
        wrench[(r, j)] += w[r];
    }
}

#[cfg(test)]
mod tests;
