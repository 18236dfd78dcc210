//! Negative eigenvalues of a sum of two stiffnesses, either of which may be infinite or nothing in some directions.

use nalgebra::{Matrix6, Vector6};

use super::condition::Condition;
use super::eigen::{Eigen, Symmetric};
use super::plane::Relation;

/// A compliance below this, in units of the rod, holds as a clamp does.
const HELD: f64 = 1e-13;

/// What is added to a compliance where it meets a free direction of the tip.
const SOFTENED: f64 = 1e-10;

/// Eigenvalues of Q, the compliance of the stiff directions, that are surely negative.
fn negative_compliances(relation: &Relation) -> usize {
    let q = Symmetric::part_of(relation.stiff, |r, c| relation.matrix[(r, c)]);
    q.eigen().below(-HELD)
}

/// How many eigenvalues of P + C⁻¹ are negative, for the plane μ = P ζ and the compliance C ≥ 0 of the next element; `None` where C is not.
///
/// The sum is the Schur complement of the symmetric matrix of (λ, ζ_soft), λ the reaction of the element,
///
/// [[−C − Q, E], [Eᵀ, P_soft]]
///
/// whose other blocks have known signs (Haynsworth's additivity of the inertia).
pub(super) fn joining(relation: &Relation, compliance: &Matrix6<f64>) -> Option<usize> {
    let (g, m) = (relation.stiff, &relation.matrix);
    let c = relation.basis.tr_mul(compliance) * relation.basis;
    let own = Symmetric::part_of(6, |i, j| c[(i, j)]).eigen();
    // one that is longer than its own critical length has negative ones
    if !own.is_finite() || own.below(-1e-6 * own.value[5].abs()) > 0 {
        return None;
    }
    let entry = |i: usize, j: usize| match (i < 6, j < 6) {
        (true, true) if i < g && j < g => -c[(i, j)] - m[(i, j)],
        (true, true) => -c[(i, j)],
        (true, false) if i < g => m[(i, g + j - 6)],
        (true, false) => f64::from(u8::from(i == g + j - 6)),
        (false, true) if j < g => m[(j, g + i - 6)],
        (false, true) => f64::from(u8::from(j == g + i - 6)),
        (false, false) => m[(g + i - 6, g + j - 6)],
    };
    let whole = Symmetric::part_of(12 - g, entry).eigen();
    (negative_compliances(relation) + whole.below(HELD)).checked_sub(6)
}

/// The last pivot: the stiffness of the whole rod at its tip, over what can move there and what holds the stiff directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Last {
    pub(super) eigen: Eigen,
    stiff: usize,
    inverse: Matrix6<f64>,
    /// Displacement directions at the tip that can move, as columns, in the basis of the relation.
    free: Matrix6<f64>,
    movable: usize,
    /// Eigenvalues that are negative without being an unstable mode.
    constraints: usize,
}

impl Last {
    /// P + K over the directions of the tip that can move, with the reactions ν of the stiff directions as further unknowns:
    ///
    /// [[Zᵀ K Z + Z_softᵀ P Z_soft, (Z_stiff − M Z_soft)ᵀ], [·, −Q]]
    pub(super) fn new(relation: &Relation, tip: &Condition) -> Option<Self> {
        let (g, m) = (relation.stiff, &relation.matrix);
        let mut free = Matrix6::zeros();
        let mut movable = 0;
        for c in (0..6).filter(|&c| !tip.fixed[c]) {
            free.set_column(movable, &tip.directions.column(c));
            movable += 1;
        }
        let k = free.tr_mul(&tip.stiffness) * free;
        let z = relation.basis.tr_mul(&free);
        let p = |i: usize, j: usize| -> f64 {
            (g..6)
                .flat_map(|a| (g..6).map(move |b| (a, b)))
                .map(|(a, b)| z[(a, i)] * m[(a, b)] * z[(b, j)])
                .sum()
        };
        let coupling = |a: usize, i: usize| z[(a, i)] - (g..6).map(|b| m[(a, b)] * z[(b, i)]).sum::<f64>();
        let entry = |i: usize, j: usize| match (i < movable, j < movable) {
            (true, true) => k[(i, j)] + p(i, j),
            (true, false) => coupling(j - movable, i),
            (false, true) => coupling(i - movable, j),
            (false, false) => -m[(i - movable, j - movable)] - if i == j { SOFTENED } else { 0.0 },
        };
        let eigen = Symmetric::part_of(movable + g, entry).eigen();
        let constraints = g - negative_compliances(relation);
        let (stiff, inverse) = (g, relation.inverse);
        eigen.is_finite().then_some(Self { eigen, stiff, inverse, free: z, movable, constraints })
    }

    /// Unstable modes that the tip adds, and those that are neither stable nor unstable to within `tolerance`.
    pub(super) fn count(&self, tolerance: f64) -> (usize, usize) {
        let negative = self.eigen.below(-tolerance);
        let neutral = self.eigen.below(tolerance) - negative;
        (negative.saturating_sub(self.constraints), neutral)
    }

    /// The eigenvalue that vanishes when the k-th mode of the tip becomes unstable.
    pub(super) fn eigenvalue(&self, k: usize) -> Option<f64> {
        let place = self.constraints + k;
        (place < self.eigen.size).then(|| self.eigen.value[place])
    }

    /// The tip in that mode: its coefficients in the basis of the plane.
    pub(super) fn coefficients(&self, k: usize) -> Option<Vector6<f64>> {
        let place = self.constraints + k;
        if place >= self.eigen.size {
            return None;
        }
        let part = |c: usize| self.eigen.vector[c][place];
        let soft = (0..self.movable).fold(Vector6::zeros(), |sum, c| sum + self.free.column(c) * part(c));
        let given = Vector6::from_fn(|r, _| if r < self.stiff { part(self.movable + r) } else { soft[r] });
        Some(self.inverse * given)
    }
}
