//! The chain of elements solved by a sweep from the free end: half the price of elimination with pivoting, where it holds.

use nalgebra::{Matrix6, Vector6};

use super::linear::NodeStep;
use super::scale::Scale;
use crate::lie::Wrench;
use crate::rod::condense::{Blocks, Condensed};
use crate::rod::planar::PLACES;

/// How far the solution may miss the equations of the chain, relative to its largest wrench. Newton's method removes what is left.
const MISFIT: f64 = 1e-7;

/// δΛ_i = S_i ζ_i + s_i, what the part of the rod beyond node i answers to a displacement of its end: six components in space, three in the plane.
///
/// It breaks where that part, clamped at node i, is at a critical load: never for a stable state, whose parts are all stable.
/// The answer is therefore checked against the equations of the chain.
#[derive(Default)]
pub(crate) struct Sweep {
    space: Vec<Relation<6>>,
    plane: Vec<Relation<3>>,
}

/// S and s.
type Relation<const N: usize> = ([[f64; N]; N], [f64; N]);

/// The chain that is swept.
struct Swept<'a, const S: usize> {
    elements: &'a Condensed<S>,
    wrenches: &'a [Wrench],
    tip: &'a Matrix6<f64>,
    scale: &'a Scale,
}

/// The components that a sweep has, of six; rotations and moments first.
const SPACE: [usize; 6] = [0, 1, 2, 3, 4, 5];

impl Sweep {
    /// ζ and δΛ of all nodes, for a clamped base and δΛ_N = D ζ_N at the tip. `None` where the sweep breaks.
    ///
    /// `wrenches` are those of the nodes, one more than there are elements.
    pub(crate) fn solve<const S: usize>(
        &mut self,
        elements: &Condensed<S>,
        wrenches: &[Wrench],
        tip: &Matrix6<f64>,
        scale: &Scale,
        nodes: &mut Vec<NodeStep>,
    ) -> Option<()> {
        nodes.clear();
        let chain = Swept { elements, wrenches, tip, scale };
        if elements.is_plane() && stays_in_plane(tip) {
            chain.full::<3, 4>(&mut self.plane, &PLACES, Condensed::blocks_in_plane, nodes)
        } else {
            chain.full::<6, 7>(&mut self.space, &SPACE, Condensed::blocks_in_space, nodes)
        }
    }
}

impl<const S: usize> Swept<'_, S> {
    fn len(&self) -> usize {
        self.wrenches.len() - 1
    }

    /// What one unit of a wrench is the inverse of.
    fn rows<const N: usize>(&self, places: &[usize; N]) -> [f64; N] {
        let units = self.scale.wrench();
        places.map(|place| 1.0 / units[place])
    }

    /// D among some components.
    fn at_tip<const N: usize>(&self, places: &[usize; N]) -> [[f64; N]; N] {
        places.map(|r| places.map(|c| self.tip[(r, c)]))
    }

    /// All components, back and forth; W is N + 1.
    fn full<const N: usize, const W: usize>(
        &self,
        relations: &mut Vec<Relation<N>>,
        places: &[usize; N],
        blocks: impl Fn(&Condensed<S>, usize) -> Blocks<N>,
        nodes: &mut Vec<NodeStep>,
    ) -> Option<()> {
        let (n, units) = (self.len(), self.rows(places));
        relations.clear();
        relations.resize(n + 1, (self.at_tip(places), [0.0; N]));
        for i in (0..n).rev() {
            relations[i] = step_back::<N, W>(&blocks(self.elements, i), &relations[i + 1], &units)?;
        }
        let rows = self.rows(&SPACE);
        let (mut zeta, mut wrench) = (Vector6::zeros(), scatter(places, &relations[0].1));
        let mut misfit = Misfit::default();
        nodes.push((zeta, wrench));
        for (i, (s, c)) in relations[1..].iter().enumerate() {
            let (next, carried) = self.elements.forward(i, &zeta, &wrench);
            zeta = next;
            wrench = scatter(places, &plus(*c, s, &gather(places, &zeta)));
            for r in 0..6 {
                misfit.add(carried[r], wrench[r], rows[r]);
            }
            nodes.push((zeta, wrench));
        }
        misfit.is_small()
    }
}

/// The components that there are, of six.
#[inline(always)]
fn gather<const N: usize>(places: &[usize; N], six: &Vector6<f64>) -> [f64; N] {
    let mut parts = [0.0; N];
    for r in 0..N {
        parts[r] = six[places[r]];
    }
    parts
}

/// In space, from the components that there are.
#[inline(always)]
fn scatter<const N: usize>(places: &[usize; N], parts: &[f64; N]) -> Vector6<f64> {
    let mut six = Vector6::zeros();
    for r in 0..N {
        six[places[r]] = parts[r];
    }
    six
}

/// a + M v.
#[inline(always)]
fn plus<const N: usize>(mut a: [f64; N], m: &[[f64; N]; N], v: &[f64; N]) -> [f64; N] {
    for r in 0..N {
        for c in 0..N {
            a[r] += m[r][c] * v[c];
        }
    }
    a
}

/// A − B C.
#[inline(always)]
pub(super) fn minus_product<const N: usize>(
    mut a: [[f64; N]; N],
    b: &[[f64; N]; N],
    c: &[[f64; N]; N],
) -> [[f64; N]; N] {
    for r in 0..N {
        for j in 0..N {
            for k in 0..N {
                a[r][k] -= b[r][j] * c[j][k];
            }
        }
    }
    a
}

/// How far a sweep misses the balance of the elements.
#[derive(Default)]
pub(super) struct Misfit {
    largest_difference: f64,
    largest: f64,
}

impl Misfit {
    #[inline(always)]
    pub(super) fn add(&mut self, carried: f64, wrench: f64, unit: f64) {
        let difference = (carried - wrench).abs() * unit;
        // not max, which would drop a NaN
        if !(difference <= self.largest_difference) {
            self.largest_difference = difference;
        }
        self.largest = self.largest.max(carried.abs() * unit);
    }

    pub(super) fn is_small(&self) -> Option<()> {
        (self.largest_difference <= MISFIT * self.largest.max(1e-300)).then_some(())
    }
}

/// Whether what a wrench becomes at the tip has no part out of the plane.
fn stays_in_plane(tip: &Matrix6<f64>) -> bool {
    PLACES.iter().all(|&c| [0, 2, 4].iter().all(|&r| tip[(r, c)] == 0.0))
}

#[inline(always)]
fn relation<const N: usize, const W: usize>(right: &[[f64; W]; N]) -> Relation<N> {
    let (mut matrix, mut constant) = ([[0.0; N]; N], [0.0; N]);
    for r in 0..N {
        matrix[r].copy_from_slice(&right[r][..N]);
        constant[r] = right[r][N];
    }
    (matrix, constant)
}

/// (T_ΛΛ − S T_ζΛ) δΛ_i = (S T_ζζ − T_Λζ) ζ_i + (S t_ζ + s − t_Λ), rows in units of the rod.
fn step_back<const N: usize, const W: usize>(
    t: &Blocks<N>,
    (s, c): &Relation<N>,
    rows: &[f64; N],
) -> Option<Relation<N>> {
    let mut left = minus_product(t.wrench_from_wrench, s, &t.zeta_from_wrench);
    let minus_zeta = minus_product(t.wrench_from_zeta, s, &t.zeta_from_zeta);
    let constant = plus(*c, s, &t.zeta);
    let mut right = [[0.0; W]; N];
    for r in 0..N {
        for k in 0..N {
            left[r][k] *= rows[r];
            right[r][k] = -minus_zeta[r][k] * rows[r];
        }
        right[r][N] = (constant[r] - t.wrench[r]) * rows[r];
    }
    eliminate(&mut left, &mut right)?;
    Some(relation(&right))
}

/// Gaussian elimination with row pivoting; the solution is in `right`.
#[inline(always)]
pub(super) fn eliminate<const N: usize, const C: usize>(
    left: &mut [[f64; N]; N],
    right: &mut [[f64; C]; N],
) -> Option<()> {
    for column in 0..N {
        let mut pivot = column;
        for row in column + 1..N {
            if left[row][column].abs() > left[pivot][column].abs() {
                pivot = row;
            }
        }
        let size = left[pivot][column].abs();
        if !(size > f64::MIN_POSITIVE && size.is_finite()) {
            return None;
        }
        left.swap(column, pivot);
        right.swap(column, pivot);
        let (pivot_left, pivot_right) = (left[column], right[column]);
        let inverse = 1.0 / pivot_left[column];
        for row in column + 1..N {
            let factor = left[row][column] * inverse;
            for k in 0..N {
                left[row][k] -= factor * pivot_left[k];
            }
            for k in 0..C {
                right[row][k] -= factor * pivot_right[k];
            }
        }
    }
    for row in (0..N).rev() {
        let inverse = 1.0 / left[row][row];
        let mut value = right[row];
        for k in row + 1..N {
            for j in 0..C {
                value[j] -= left[row][k] * right[k][j];
            }
        }
        right[row] = value.map(|v| v * inverse);
    }
    Some(())
}
