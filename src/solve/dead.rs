//! The chain of a cantilever on which nothing but dead forces act, and a moment on its tip: condensed, swept and put back block by block.

use std::ops::Range;

use nalgebra::{Matrix6, Vector6};

use super::linear::{Increment, Step};
use super::scale::Scale;
use super::sweep::{Misfit, eliminate, minus_product};
use crate::lie::{Wrench, so3::hat};
use crate::rod::condense::{Answers, Condensed, DeadBlocks, Relation};
use crate::rod::lanes::{ELEMENTS, LEAST_DETERMINANT};
use crate::rod::planar::PLACES;

/// δm_i = S_i w_i + s_i, what the part of the rod beyond node i answers to a rotation of its end. The force is known everywhere, δn = n × w, and where the
/// rod is does not matter: three numbers where a [`Sweep`](super::sweep::Sweep) has six, and in the plane one where it has three.
pub(crate) struct DeadSweep<const S: usize> {
    relations: Vec<Relation>,
    answers: Answers<S>,
    /// No node resists a rotation by less, with the node before it held and the rod beyond it free.
    ///
    /// Elements that are stable by themselves make a stable rod if this is positive at every node: these are the pivots of the second variation.
    least: f64,
}

impl<const S: usize> Default for DeadSweep<S> {
    fn default() -> Self {
        Self { relations: Vec::new(), answers: Answers::default(), least: 0.0 }
    }
}

/// Whether D = [[·, 0], [n^, 0]] with the force at the tip.
pub(crate) fn is_dead(tangent: &Matrix6<f64>, at_tip: &Wrench) -> bool {
    tangent.as_slice()[18..].iter().all(|v| *v == 0.0)
        && tangent.fixed_view::<3, 3>(3, 0) == hat(&at_tip.force)
}

impl<const S: usize> DeadSweep<S> {
    /// Begins at the tip of so many elements, where δm_N = D w_N.
    pub(crate) fn begin(&mut self, elements: &Condensed<S>, count: usize, tip: &Matrix6<f64>) {
        let mut last = [[0.0; 4]; 3];
        if elements.is_plane() {
            last[0][0] = tip[(PLACES[0], PLACES[0])];
        } else {
            for r in 0..3 {
                for c in 0..3 {
                    last[r][c] = tip[(r, c)];
                }
            }
        }
        self.answers.begin(elements, count);
        // what is there is overwritten
        self.relations.resize(count + 1, last);
        self.relations[count] = last;
        self.least = f64::INFINITY;
    }

    /// Goes back over a block, which is in `elements` from `place` on. `None` where the sweep breaks.
    pub(crate) fn back(
        &mut self,
        elements: &Condensed<S>,
        place: usize,
        block: Range<usize>,
        wrenches: &[Wrench],
    ) -> Option<()> {
        let plane = elements.is_plane();
        if !plane {
            self.answers.turn(elements, place, &wrenches[block.clone()]);
        }
        for i in block.clone().rev() {
            let lane = i - block.start;
            let stiffness;
            (self.relations[i], stiffness) = if plane {
                let blocks = elements.dead_in_plane(place + lane, &wrenches[i]);
                step_back_in_plane(&blocks, &self.relations[i + 1])?
            } else {
                step_back(&self.answers.turned(lane), &self.relations[i + 1])?
            };
            // not min, which would drop a NaN
            self.least = if stiffness > self.least { self.least } else { stiffness };
        }
        let first = block.start;
        self.answers.take(first, elements, place, &self.relations[block.clone()], &wrenches[block]);
        Some(())
    }

    /// A lower bound of the stiffness of all nodes; 0 where it is not positive.
    pub(crate) fn least_stiffness(&self) -> f64 {
        if self.least > 0.0 { self.least } else { 0.0 }
    }

    /// And forth: ζ and δΛ of all nodes, the strains, and how large it all is. `None` where the sweep broke.
    pub(crate) fn forward(
        &self,
        wrenches: &[Wrench],
        plane: bool,
        scale: &Scale,
        step: &mut Increment<S>,
    ) -> Option<Step> {
        let moment_at = |i: usize, w: &[f64; 3]| self.moment(i, plane, w);
        let [unit, .., force_unit] = scale.wrench().map(|unit| 1.0 / unit);
        let (mut turn, mut shift) = ([0.0; 3], [0.0; 3]);
        let mut misfit = Misfit::default();
        let mut size = Size::default();
        let count = wrenches.len() - 1;
        step.nodes.clear();
        step.strains.clear();
        let first = moment_at(0, &turn);
        // a single element ends at the tip, where there may be no moment to compare with
        first.iter().for_each(|m| misfit.add(*m, *m, unit));
        step.nodes.push(node(&turn, &shift, &first, &wrenches[0]));
        for first in (0..count).step_by(ELEMENTS) {
            let block = first..count.min(first + ELEMENTS);
            let mut turns = [[0.0; 3]; ELEMENTS];
            for i in block.clone() {
                turns[i - first] = turn;
                let answer = self.answers.of(i, &turn, &shift);
                (turn, shift) = (answer.turn, answer.shift);
                let moment = moment_at(i + 1, &turn);
                for r in 0..3 {
                    misfit.add(answer.moment[r], moment[r], unit);
                }
                let at = node(&turn, &shift, &moment, &wrenches[i + 1]);
                for r in 3..6 {
                    misfit.add(at.1[r], at.1[r], force_unit);
                }
                size.add_node(&at.0, &at.1);
                step.nodes.push(at);
            }
            self.answers.strains(first, &turns[..block.len()], &mut step.strains);
            size.add_strains(step.strains[first..].as_flattened());
        }
        misfit.is_small()?;
        size.step(scale.length)
    }

    /// S_i w + s_i.
    #[inline(always)]
    fn moment(&self, i: usize, plane: bool, w: &[f64; 3]) -> [f64; 3] {
        let s = &self.relations[i];
        if plane {
            return [0.0, s[0][0] * w[1] + s[0][3], 0.0];
        }
        let row = |r: usize| s[r][0] * w[0] + s[r][1] * w[1] + s[r][2] * w[2] + s[r][3];
        [row(0), row(1), row(2)]
    }
}

/// ζ and δΛ, with δn = n × w.
#[inline(always)]
fn node(turn: &[f64; 3], shift: &[f64; 3], moment: &[f64; 3], at: &Wrench) -> (Vector6<f64>, Vector6<f64>) {
    let ([a, b, c], n) = (*turn, &at.force);
    let force = [n.y * c - n.z * b, n.z * a - n.x * c, n.x * b - n.y * a];
    let [x, y, z] = *shift;
    let [l, m, o] = *moment;
    (Vector6::new(a, b, c, x, y, z), Vector6::new(l, m, o, force[0], force[1], force[2]))
}

/// How large a step is, as it is made.
#[derive(Default)]
pub(super) struct Size {
    /// Squares of norms.
    turn: f64,
    shift: f64,
    bend: f64,
    stretch: f64,
    /// 0 x is 0 for a finite x and NaN otherwise.
    nothing: f64,
}

impl Size {
    #[inline(always)]
    pub(super) fn add_node(&mut self, zeta: &Vector6<f64>, wrench: &Vector6<f64>) {
        let square = |v: &[f64]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        self.turn = self.turn.max(square(&zeta.as_slice()[..3]));
        self.shift = self.shift.max(square(&zeta.as_slice()[3..]));
        for r in 0..6 {
            self.nothing += 0.0 * (zeta[r] + wrench[r]);
        }
    }

    #[inline(always)]
    pub(super) fn add_strains(&mut self, strains: &[crate::lie::Strain]) {
        for strain in strains {
            self.bend = self.bend.max(strain.angular.norm_squared());
            self.stretch = self.stretch.max(strain.linear.norm_squared());
        }
    }

    /// `None` where a number is none.
    pub(super) fn step(&self, length: f64) -> Option<Step> {
        let rotation = self.turn.sqrt();
        let strain = f64::max(self.bend.sqrt() * length, self.stretch.sqrt());
        let size = rotation.max(self.shift.sqrt() / length).max(strain);
        (size.is_finite() && self.nothing == 0.0).then_some(Step { size, rotation })
    }
}

/// A lower bound for the eigenvalues of D = M P⁻¹, the stiffness of the node after an element against a rotation; not positive if D is not.
///
/// Pᵀ M = Pᵀ D P is definite as D is. λ₁ ≥ 4 det/tr² for three positive eigenvalues.
#[inline(always)]
fn stiffness_bound(matrix: &[[f64; 3]; 3], p: &[[f64; 3]; 3]) -> f64 {
    let mut product = [[0.0; 3]; 3];
    let mut norm_squared = 0.0;
    for j in 0..3 {
        for r in 0..3 {
            norm_squared += p[j][r] * p[j][r];
            for c in 0..3 {
                product[r][c] += p[j][r] * matrix[j][c];
            }
        }
    }
    let a = |r: usize, c: usize| 0.5 * (product[r][c] + product[c][r]);
    let minor = a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1);
    if !(a(0, 0) > 0.0 && minor > 0.0) {
        return 0.0;
    }
    let determinant = minor * a(2, 2) + a(0, 1) * a(1, 2) * a(0, 2) * 2.0
        - a(0, 0) * a(1, 2) * a(1, 2)
        - a(1, 1) * a(0, 2) * a(0, 2);
    let trace = a(0, 0) + a(1, 1) + a(2, 2);
    4.0 * determinant / (trace * trace * norm_squared)
}

/// The relation of the node before an element, and the [`stiffness_bound`] of that after it.
///
/// (T_mm − S T_wm) δm_i = (S T_ww − T_mw) w_i + S t_w + s − t_m.
#[inline]
fn step_back(t: &DeadBlocks<3>, next: &Relation) -> Option<(Relation, f64)> {
    let s = [0, 1, 2].map(|r| [next[r][0], next[r][1], next[r][2]]);
    let matrix = minus_product(t.moment_from_moment, &s, &t.turn_from_moment);
    let stiffness = stiffness_bound(&matrix, &t.turn_from_moment);
    let minus_turn = minus_product(t.moment_from_turn, &s, &t.turn_from_turn);
    let mut right = [[0.0; 4]; 3];
    for r in 0..3 {
        let mut constant = next[r][3] - t.moment[r];
        for k in 0..3 {
            right[r][k] = -minus_turn[r][k];
            constant += s[r][k] * t.turn[k];
        }
        right[r][3] = constant;
    }
    let relation = match solved(&matrix, &right) {
        Some(relation) => relation,
        None => {
            let mut left = matrix;
            eliminate(&mut left, &mut right)?;
            right
        }
    };
    Some((relation, stiffness))
}

/// A⁻¹ B by cofactors, without waiting for one pivot after the other; `None` where the determinant may have lost its digits.
#[inline(always)]
fn solved([a, b, c]: &[[f64; 3]; 3], right: &Relation) -> Option<Relation> {
    let cross = |u: &[f64; 3], v: &[f64; 3]| {
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    };
    let size = |u: &[f64; 3]| u[0].abs() + u[1].abs() + u[2].abs();
    // columns of the inverse, times the determinant
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = a[0] * columns[0][0] + a[1] * columns[0][1] + a[2] * columns[0][2];
    if !(determinant.abs() > LEAST_DETERMINANT * (size(a) * size(b) * size(c))) {
        return None;
    }
    let inverse = 1.0 / determinant;
    let mut solution = [[0.0; 4]; 3];
    for r in 0..3 {
        for (column, row) in columns.iter().zip(right) {
            let factor = column[r] * inverse;
            for c in 0..4 {
                solution[r][c] += factor * row[c];
            }
        }
    }
    Some(solution)
}

/// The same in the plane, where the stiffness is its own bound.
#[inline]
fn step_back_in_plane(t: &DeadBlocks<1>, next: &Relation) -> Option<(Relation, f64)> {
    let (s, c) = (next[0][0], next[0][3]);
    let p = t.turn_from_moment[0][0];
    let matrix = t.moment_from_moment[0][0] - s * p;
    if !(matrix.abs() > f64::MIN_POSITIVE && matrix.is_finite()) {
        return None;
    }
    let mut relation = [[0.0; 4]; 3];
    relation[0][0] = (s * t.turn_from_turn[0][0] - t.moment_from_turn[0][0]) / matrix;
    relation[0][3] = (s * t.turn[0] + c - t.moment[0]) / matrix;
    Some((relation, matrix / p))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cofactors_solve_as_elimination_does_and_leave_it_what_is_nearly_singular() {
        let matrix = [[0.9, 0.2, -0.3], [-0.1, 1.1, 0.4], [0.3, -0.2, 0.8]];
        let right = [[1.0, 2.0, -1.0, 0.5], [0.0, 1.0, 3.0, -2.0], [4.0, -1.0, 0.0, 1.0]];
        let by_cofactors = solved(&matrix, &right).unwrap();
        let (mut left, mut by_pivots) = (matrix, right);
        eliminate(&mut left, &mut by_pivots).unwrap();
        for (a, b) in by_cofactors.as_flattened().iter().zip(by_pivots.as_flattened()) {
            // condition 2, a dozen roundings of numbers below 5
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
        // a sum of the others but for 1e-7
        let nearly = [matrix[0], matrix[1], [0.8, 1.3, 0.1 + 1e-7]];
        let nothing = [[0.0; 3]; 3];
        let unknown = [matrix[0], matrix[1], [f64::NAN, 0.0, 1.0]];
        for refused in [nearly, nothing, unknown] {
            assert!(solved(&refused, &right).is_none(), "{refused:?}");
        }
    }
}
