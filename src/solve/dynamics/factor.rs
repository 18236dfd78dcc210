//! The linearised elements of a rod, factored from the tip to the base, and solved for as many residuals as one likes.
//!
//! The part of the rod beyond node i answers to a displacement of it with δΛ_i = R_i ζ_i + s_i. Put into element i − 1 this leaves a
//! system for the strains of that element alone, which is factored. It breaks only where that part, clamped at node i, is at a critical
//! load; with inertia it has none.

use nalgebra::{Matrix6, Vector6};

use crate::lie::{Strain, Twist, TwistMap, Wrench};
use crate::rod::adjoint::AdjointElement;

/// The largest number of strains of an element.
const MAX: usize = 18;

/// One element: its strains from its residual, from the answer s of what is beyond it, and from the displacement of its first node.
pub(super) struct FactoredElement<const S: usize> {
    /// How many strains are free, and which of all 6 S they are.
    count: usize,
    free: [usize; MAX],
    /// L and U of the scaled matrix, rows in the order of elimination.
    lu: [[f64; MAX]; MAX],
    order: [usize; MAX],
    scale: [f64; MAX],
    /// δξ from ζ_i.
    from_node: [Matrix6<f64>; S],
    q: [Matrix6<f64>; S],
    end: [TwistMap; S],
    end_inverse: TwistMap,
}

impl<const S: usize> FactoredElement<S> {
    pub(super) fn empty() -> Self {
        let one = TwistMap::identity();
        Self {
            count: 0,
            free: [0; MAX],
            lu: [[0.0; MAX]; MAX],
            order: [0; MAX],
            scale: [0.0; MAX],
            from_node: [Matrix6::zeros(); S],
            q: [Matrix6::zeros(); S],
            end: [one; S],
            end_inverse: one,
        }
    }

    /// Lists the strains that are free.
    fn choose(&mut self, fixed: &[bool; 6]) {
        self.count = 0;
        for row in (0..6 * S).filter(|row| !fixed[row % 6]) {
            self.free[self.count] = row;
            self.count += 1;
        }
    }

    /// Factors an element that already contains the relation at its end, and returns the one at its start. `None` where it is singular.
    ///
    /// The rows and columns of fixed strains are left out.
    pub(super) fn factor(&mut self, element: &AdjointElement<S>, fixed: &[bool; 6]) -> Option<Matrix6<f64>> {
        self.choose(fixed);
        // the bound is known to the compiler where all strains are free
        if self.count == 6 * S {
            self.load(element, 6 * S);
            self.eliminate(6 * S)?;
        } else {
            self.load(element, self.count);
            self.eliminate(self.count)?;
        }
        (self.q, self.end, self.end_inverse) = (element.q, element.end, element.end_inverse);
        self.from_node = [Matrix6::zeros(); S];
        let mut relation = element.u;
        for c in 0..6 {
            let mut column = [0.0; MAX];
            for k in 0..S {
                for r in 0..6 {
                    column[6 * k + r] = element.p[k][(r, c)];
                }
            }
            self.substitute(&mut column);
            for k in 0..S {
                for r in 0..6 {
                    self.from_node[k][(r, c)] = column[6 * k + r];
                }
            }
        }
        for k in 0..S {
            relation -= element.q[k] * self.from_node[k];
        }
        Some(relation)
    }

    /// Copies A, scaled to a unit diagonal.
    #[inline(always)]
    fn load(&mut self, element: &AdjointElement<S>, n: usize) {
        let whole = n == 6 * S;
        let free = self.free;
        let entry = |i: usize, j: usize| {
            let (r, c) = if whole { (i, j) } else { (free[i], free[j]) };
            element.a[r / 6][c / 6][(r % 6, c % 6)]
        };
        for i in 0..n {
            let diagonal = entry(i, i).abs();
            self.scale[i] = if diagonal > 0.0 { 1.0 / diagonal.sqrt() } else { 1.0 };
        }
        for i in 0..n {
            for j in 0..n {
                self.lu[i][j] = entry(i, j) * self.scale[i] * self.scale[j];
            }
        }
    }

    /// Gaussian elimination with row pivoting.
    #[inline(always)]
    fn eliminate(&mut self, n: usize) -> Option<()> {
        self.order = std::array::from_fn(|r| r);
        for column in 0..n {
            let mut pivot = column;
            for row in column + 1..n {
                if self.lu[row][column].abs() > self.lu[pivot][column].abs() {
                    pivot = row;
                }
            }
            let size = self.lu[pivot][column].abs();
            if !(size > f64::MIN_POSITIVE && size.is_finite()) {
                return None;
            }
            self.lu.swap(column, pivot);
            self.order.swap(column, pivot);
            let pivot_row = self.lu[column];
            let inverse = 1.0 / pivot_row[column];
            for row in &mut self.lu[column + 1..n] {
                let factor = row[column] * inverse;
                row[column] = factor;
                for c in column + 1..n {
                    row[c] -= factor * pivot_row[c];
                }
            }
            // the inverse is what the substitution wants
            self.lu[column][column] = inverse;
        }
        Some(())
    }

    /// A⁻¹ b in place; zero where strains are fixed.
    #[inline(always)]
    fn substitute(&self, b: &mut [f64; MAX]) {
        if self.count == 6 * S {
            self.substitute_all(b, 6 * S, |row| row);
        } else {
            self.substitute_all(b, self.count, |row| self.free[row]);
        }
    }

    #[inline(always)]
    fn substitute_all(&self, b: &mut [f64; MAX], n: usize, place: impl Fn(usize) -> usize) {
        let mut x = [0.0; MAX];
        for row in 0..n {
            let from = self.order[row];
            let mut value = b[place(from)] * self.scale[from];
            for c in 0..row {
                value -= self.lu[row][c] * x[c];
            }
            x[row] = value;
        }
        for row in (0..n).rev() {
            let mut value = x[row];
            for c in row + 1..n {
                value -= self.lu[row][c] * x[c];
            }
            x[row] = value * self.lu[row][row];
        }
        if n < 6 * S {
            *b = [0.0; MAX];
        }
        for c in 0..n {
            b[place(c)] = x[c] * self.scale[c];
        }
    }

    /// δξ for a first node that stays, and s at that node, from the residual and s at the end.
    #[inline]
    pub(super) fn back(&self, residual: &[Wrench; S], s: &Wrench) -> ([Strain; S], Wrench) {
        let mut b = [0.0; MAX];
        for k in 0..S {
            let row = (self.end[k].apply_transpose(s) - residual[k]).to_array();
            b[6 * k..6 * k + 6].copy_from_slice(&row);
        }
        self.substitute(&mut b);
        let mut answer = self.end_inverse.apply_transpose(s).to_vector();
        let mut strain = [Strain::zero(); S];
        for k in 0..S {
            let x = Vector6::from_column_slice(&b[6 * k..6 * k + 6]);
            answer -= self.q[k] * x;
            strain[k] = Strain::from_vector(&x);
        }
        (strain, Wrench::from_vector(&answer))
    }

    /// Adds what the displacement of the first node does to δξ, and returns that of the end.
    #[inline]
    pub(super) fn forth(&self, zeta: &Vector6<f64>, strain: &mut [Strain; S]) -> Vector6<f64> {
        let node = Twist::from_vector(zeta);
        let mut next = self.end_inverse.apply(&node);
        for k in 0..S {
            let moved = if *zeta == Vector6::zeros() {
                Strain::zero()
            } else {
                Strain::from_vector(&(self.from_node[k] * zeta))
            };
            strain[k] += moved;
            next += self.end[k].apply(&strain[k].as_twist());
        }
        next.to_vector()
    }
}

impl<const S: usize> FactoredElement<S> {
    /// Appends all numbers, which make the same element again.
    pub(super) fn save(&self, into: &mut Vec<f64>) {
        let n = self.count;
        for row in &self.lu[..n] {
            into.extend(&row[..n]);
        }
        into.extend(self.order[..n].iter().map(|&row| row as f64));
        into.extend(&self.scale[..n]);
        for k in 0..S {
            into.extend(self.from_node[k].as_slice());
            into.extend(self.q[k].as_slice());
            into.extend(self.end[k].diagonal.as_slice());
            into.extend(self.end[k].lower.as_slice());
        }
        into.extend(self.end_inverse.diagonal.as_slice());
        into.extend(self.end_inverse.lower.as_slice());
    }

    /// The opposite of [`save`](Self::save); `None` where numbers are missing.
    pub(super) fn restore(&mut self, fixed: &[bool; 6], from: &mut impl Iterator<Item = f64>) -> Option<()> {
        self.choose(fixed);
        let n = self.count;
        let mut fill = |entries: &mut [f64]| {
            entries.iter_mut().try_for_each(|entry| from.next().map(|number| *entry = number))
        };
        for row in &mut self.lu[..n] {
            fill(&mut row[..n])?;
        }
        let mut order = [0.0; MAX];
        fill(&mut order[..n])?;
        self.order = order.map(|row| (row as usize).min(MAX - 1));
        fill(&mut self.scale[..n])?;
        for k in 0..S {
            fill(self.from_node[k].as_mut_slice())?;
            fill(self.q[k].as_mut_slice())?;
            fill(self.end[k].diagonal.as_mut_slice())?;
            fill(self.end[k].lower.as_mut_slice())?;
        }
        fill(self.end_inverse.diagonal.as_mut_slice())?;
        fill(self.end_inverse.lower.as_mut_slice())
    }
}
