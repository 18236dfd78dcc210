//! Negative eigenvalues of a sum of two stiffnesses, either of which may be infinite or nothing in some directions.

use nalgebra::{Matrix6, Vector6};

use super::condition::Condition;
use super::eigen::{Eigen, Symmetric};
use super::link::Link;
use super::plane::Relation;

/// A compliance below this, in units of the rod, holds as a clamp does.
const HELD: f64 = 1e-13;

/// Eigenvalues of Q, the compliance of the stiff directions, that are surely negative.
fn negative_compliances(relation: &Relation) -> usize {
    let q = Symmetric::part_of(relation.stiff, |r, c| relation.matrix[(r, c)]);
    q.eigen().below(-HELD)
}

/// An element held at its far end.
struct Held {
    /// A⁻¹.
    inverse: Matrix6<f64>,
    /// A⁻¹ B.
    compliance: Matrix6<f64>,
    /// How many of its eigenvalues are positive or nothing. A momentum of nothing at the free end is a load that turns half way with it, so
    /// that an element may be unstable in this state which is not when held at both ends.
    positive: usize,
}

impl Held {
    fn new(link: &Link) -> Option<Self> {
        let inverse = link.zeta_zeta.try_inverse()?;
        let compliance = inverse * link.zeta_momentum;
        let eigen = Symmetric::part_of(6, |i, j| compliance[(i, j)]).eigen();
        eigen.is_finite().then(|| Self { inverse, compliance, positive: 6 - eigen.below(-HELD) })
    }
}

/// The symmetric matrix of (λ, ζ_soft), λ the reaction of the element in the directions of the relation:
///
/// [[−C − Q, E], [Eᵀ, P_soft]]
fn joined(relation: &Relation, compliance: &Matrix6<f64>, i: usize, j: usize) -> f64 {
    let (g, m) = (relation.stiff, &relation.matrix);
    let coupling = |a: usize, soft: usize| if a < g { m[(a, soft)] } else { f64::from(u8::from(a == soft)) };
    match (i < 6, j < 6) {
        (true, true) => {
            let stiff = if i < g && j < g { m[(i, j)] } else { 0.0 };
            let held = if i == j { HELD } else { 0.0 };
            -compliance[(i, j)] - stiff - held
        }
        (true, false) => coupling(i, g + j - 6),
        (false, true) => coupling(j, g + i - 6),
        (false, false) => m[(g + i - 6, g + j - 6)],
    }
}

/// How many eigenvalues of P + C⁻¹ are negative, for the plane μ = P ζ and the compliance C of the next element, held at its far end.
///
/// The sum is a Schur complement of the matrix of [`joined`], whose other complements have known signs (Haynsworth's additivity of the
/// inertia).
pub(super) fn joining(relation: &Relation, link: &Link) -> Option<usize> {
    let held = Held::new(link)?;
    let c = relation.basis.tr_mul(&held.compliance) * relation.basis;
    let whole = Symmetric::part_of(12 - relation.stiff, |i, j| joined(relation, &c, i, j)).eigen();
    // a tangent that is symmetric only to the order of the element may be short of one
    let negative = negative_compliances(relation) + whole.below(0.0);
    whole.is_finite().then(|| negative.saturating_sub(held.positive))
}

/// The last pivot: the node before the tip and the tip together, under what holds the tip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Last {
    matrix: Symmetric,
    eigen: Eigen,
    stiff: usize,
    /// Coefficients in the basis of the plane before the last element, from (μ_stiff, ζ_soft).
    inverse: Matrix6<f64>,
    /// Displacements at the tip that can move, as columns.
    free: Matrix6<f64>,
    movable: usize,
    /// Eigenvalues that are negative without being an unstable mode.
    constraints: usize,
}

impl Last {
    /// With Z what can move at the tip, K its stiffness, and A, B, C the blocks of the last element, the matrix of (λ, ζ_soft, z):
    ///
    /// [[−A⁻¹B − Q, E, −A⁻¹Z], [·, P_soft, 0], [·, ·, Zᵀ(C A⁻¹ + K) Z]]
    pub(super) fn new(relation: &Relation, link: &Link, tip: &Condition) -> Option<Self> {
        let held = Held::new(link)?;
        let mut free = Matrix6::zeros();
        let mut movable = 0;
        for c in (0..6).filter(|&c| !tip.fixed[c]) {
            free.set_column(movable, &tip.directions.column(c));
            movable += 1;
        }
        let k = free.tr_mul(&(link.momentum_zeta * held.inverse + tip.stiffness)) * free;
        let c = relation.basis.tr_mul(&held.compliance) * relation.basis;
        let carried = -(relation.basis.tr_mul(&held.inverse) * free);
        let inner = 12 - relation.stiff;
        let entry = |i: usize, j: usize| match (i < inner, j < inner) {
            (true, true) => joined(relation, &c, i, j),
            (true, false) if i < 6 => carried[(i, j - inner)],
            (false, true) if j < 6 => carried[(j, i - inner)],
            (false, false) => k[(i - inner, j - inner)],
            _ => 0.0,
        };
        let matrix = Symmetric::part_of(inner + movable, entry);
        let eigen = matrix.eigen();
        let constraints = held.positive.saturating_sub(negative_compliances(relation));
        let (stiff, inverse) = (relation.stiff, relation.inverse);
        eigen.is_finite().then_some(Self { matrix, eigen, stiff, inverse, free, movable, constraints })
    }

    /// Unstable modes that the last two nodes add, and those that are neither stable nor unstable to within `tolerance`.
    pub(super) fn count(&self, tolerance: f64) -> (usize, usize) {
        let neutral = self.neutral(tolerance);
        let negative = neutral.iter().filter(|&&place| self.eigen.value[place] < 0.0).count();
        let unstable = self.eigen.below(0.0).saturating_sub(self.constraints);
        (unstable.saturating_sub(negative), neutral.len())
    }

    /// Eigenvalues that vanish by cancellation: |vᵀ M v| is below the part `tolerance` of Σ |v_i M_ij v_j|. A constraint may have a small one of its
    /// own, the compliance of a stiff direction, which is none.
    pub(super) fn neutral(&self, tolerance: f64) -> Vec<usize> {
        (0..self.eigen.size)
            .filter(|&place| self.eigen.value[place].abs() < tolerance * self.size_of(place))
            .collect()
    }

    fn size_of(&self, place: usize) -> f64 {
        let v = |i: usize| self.eigen.vector[i][place];
        let n = self.eigen.size;
        (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| (v(i) * self.matrix.entry[i][j] * v(j)).abs())
            .sum()
    }

    /// The eigenvalue that vanishes when the k-th of these modes becomes unstable.
    pub(super) fn eigenvalue(&self, k: usize) -> Option<f64> {
        let place = self.constraints + k;
        (place < self.eigen.size).then(|| self.eigen.value[place])
    }

    /// The place of the k-th mode among the eigenvalues.
    pub(super) fn place(&self, k: usize) -> usize {
        self.constraints + k
    }

    /// The mode of a place: the coefficients of the node before the tip in the basis of its plane, and the displacement of the tip.
    pub(super) fn mode(&self, place: usize) -> Option<(Vector6<f64>, Vector6<f64>)> {
        if place >= self.eigen.size {
            return None;
        }
        let part = |i: usize| self.eigen.vector[i][place];
        let given = Vector6::from_fn(|r, _| if r < self.stiff { -part(r) } else { part(6 + r - self.stiff) });
        let first = self.eigen.size - self.movable;
        let tip =
            (0..self.movable).fold(Vector6::zeros(), |sum, c| sum + self.free.column(c) * part(first + c));
        Some((self.inverse * given, tip))
    }
}
