//! How wrong a mesh is: the defect of its strain polynomials, and the difference of two meshes.

use super::describe::strain_correction;
use super::equilibrium::Configuration;
use super::mesh::Mesh;
use super::newton::Outcome;
use super::report::ErrorEstimate;
use super::unknowns::StageStrains;
use crate::body::Elastic;
use crate::lie::{Strain, Wrench};

/// The estimate is multiplied by this: the ratio of two defects predicts a gain to a factor of about two.
const SAFETY: f64 = 2.0;

/// As [`SAFETY`], where the coarser mesh is one element.
const SAFETY_OF_ONE: f64 = 16.0;

/// Where the error of a mesh comes from, element by element.
///
/// The strains are a polynomial whose stages satisfy Ψ(Δξ) = Λ; between them the strong form has a defect. δ, the change that would
/// remove it at an end of the element, is the error of the polynomial there, of order h^S. Poses and wrenches at the nodes converge
/// twice as fast: an element adds the defect integrated against the error of the Green's function, which is of the same kind, so about h δ².
/// The sum over elements is no error, but falls like one: its ratio between two meshes tells how much was gained.
pub(super) struct Defect {
    /// h δ² of every element, with δ the largest of stretch change and curvature change × L.
    pub(super) shares: Vec<f64>,
    /// By how much the strain at either end of an element differs from its polynomial there.
    pub(super) ends: Vec<[Strain; 2]>,
}

impl Defect {
    pub(super) fn of<B: Elastic, const S: usize>(
        mesh: &Mesh<'_, B, S>,
        strains: &StageStrains<S>,
        state: &Configuration<S>,
    ) -> Self {
        let (body, length) = (mesh.rod.body(), mesh.rod.body().length());
        let n = mesh.elements();
        let (mut shares, mut corrections) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for i in 0..n {
            let ends = [(i, 0.0, &state.node_wrench[i]), (i + 1, 1.0, &state.end_wrench[i])];
            let ends = ends.map(|(node, tau, wrench)| {
                let guess = mesh.interpolate(&strains[i], tau);
                strain_correction(body, mesh.node_s(node), wrench, &guess)
            });
            let size = |end: &Option<Strain>| match end {
                Some(change) => change.linear.norm().max(change.angular.norm() * length),
                None => 1.0,
            };
            let delta = size(&ends[0]).max(size(&ends[1]));
            shares.push(mesh.h(i) / length * delta * delta);
            corrections.push(ends.map(Option::unwrap_or_default));
        }
        Self { shares, ends: corrections }
    }

    /// What is not known, of so many elements.
    pub(super) fn none(elements: usize) -> Self {
        Self { shares: vec![0.0; elements], ends: vec![[Strain::zero(); 2]; elements] }
    }

    pub(super) fn total(&self) -> f64 {
        self.shares.iter().sum()
    }
}

/// The largest differences of two meshes at the nodes they share; `parts` made the finer out of the coarser.
pub(super) fn difference<const S: usize>(
    coarse: &Configuration<S>,
    fine: &Configuration<S>,
    parts: impl Iterator<Item = usize>,
    length: f64,
) -> ErrorEstimate {
    let mut error = ErrorEstimate::default();
    let mut largest: f64 = 0.0;
    let mut node = 0;
    let size = |w: &Wrench| w.force.norm().max(w.moment.norm() / length);
    for (i, count) in std::iter::once(0).chain(parts).enumerate() {
        node += count;
        let (a, b) = (&coarse.node_pose[i], &fine.node_pose[node]);
        let between = (a.inverse() * *b).log();
        error.position = error.position.max((a.position - b.position).norm());
        error.rotation = error.rotation.max(between.angular.norm());
        let (a, b) = (coarse.node_wrench[i], fine.node_wrench[node]);
        error.wrench = error.wrench.max(size(&(a - b)));
        largest = largest.max(size(&b));
    }
    if largest > 0.0 {
        error.wrench /= largest;
    }
    error
}

/// How many elements the first mesh has: enough that the loads, at the reference shape, turn none of them by much more than a radian.
///
/// A transverse force P makes boundary layers of length √(EI/P), a moment M the curvature M/EI; a reference may be curved itself.
pub(super) fn first_elements<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> usize {
    let length = mesh.rod.body().length();
    let constraint = mesh.rod.body().constraint();
    let diagonals = state.response.iter().flatten();
    let diagonals = diagonals.map(|r| constraint.diagonal_of_free(&r.tangent, f64::INFINITY));
    let bending = diagonals.fold(f64::INFINITY, |least, [x, y, ..]| least.min(x.abs()).min(y.abs()));
    let force = state.node_wrench.iter().fold(0.0, |size: f64, w| size.max(w.force.norm()));
    let moment = state.node_wrench.last().map_or(0.0, |w| w.moment.norm());
    let turn = (0..mesh.elements())
        .flat_map(|i| mesh.twists(i, &[crate::lie::Strain::zero(); S]))
        .fold(0.0, |turn: f64, xi| turn.max(xi.angular.norm() * length));
    let wanted =
        (0.3 * length * (force / bending).sqrt()).max(0.25 * moment * length / bending).max(0.5 * turn);
    // what is not finite is the rod's own trouble, found by the solve
    if wanted.is_finite() { (wanted.ceil() as usize).clamp(1, 32) } else { 2 }
}

/// What a mesh that was solved leaves behind for the next one.
pub(super) struct Level<'a, B, const S: usize> {
    pub(super) mesh: Mesh<'a, B, S>,
    pub(super) outcome: Outcome<S>,
    pub(super) defect: Defect,
}

/// The error of the finer of two meshes: d = E − E′ and E′ ≈ R E, with the gain R read off the defects, or off the order of the element
/// where that promises less.
pub(super) fn estimate<B: Elastic, const S: usize>(
    coarse: &Level<'_, B, S>,
    fine: &Level<'_, B, S>,
    parts: &[usize],
    length: f64,
) -> ErrorEstimate {
    let states: [Option<&Configuration<S>>; 2] = [coarse.outcome.state.as_ref(), fine.outcome.state.as_ref()];
    let [Some(a), Some(b)] = states else { return ErrorEstimate::default() };
    let difference = difference(a, b, parts.iter().copied(), length);
    let before = coarse.defect.total();
    let found = if before > 0.0 { fine.defect.total() / before } else { 0.0 };
    let gain = promised(&coarse.defect.shares, parts, 2 * S).max(found).min(0.5);
    // a single element has no node inside: the difference at its ends says less
    let safety = if coarse.mesh.elements() == 1 { SAFETY_OF_ONE } else { SAFETY };
    difference.scaled(safety * gain / (1.0 - gain))
}

/// By what factor the error falls where the element holds its order: Σ c k⁻ᵖ / Σ c.
pub(super) fn promised(shares: &[f64], parts: &[usize], order: usize) -> f64 {
    let total: f64 = shares.iter().sum();
    if total > 0.0 {
        shares.iter().zip(parts).map(|(share, &k)| share / (k as f64).powi(order as i32)).sum::<f64>() / total
    } else {
        0.0
    }
}

/// Into how many pieces to cut every element, so that the error falls by `factor` with as few elements as can be.
///
/// Minimising Σk under Σ c k⁻ᵖ = factor Σc gives k ∝ c^{1/(p+1)}. Every element is cut: where it is not, the estimate is off.
pub(super) fn cuts(shares: &[f64], factor: f64, order: usize, most: f64) -> Vec<usize> {
    let p = order as f64;
    let total: f64 = shares.iter().sum();
    let density: Vec<f64> = shares.iter().map(|c| c.powf(1.0 / (p + 1.0))).collect();
    let spread: f64 = density.iter().sum();
    // a fifth of what is needed, so that the estimate of the next mesh is met with room
    let scale = (spread.max(f64::MIN_POSITIVE) / (0.2 * factor * total).max(f64::MIN_POSITIVE)).powf(1.0 / p);
    density.iter().map(|d| (scale * d).ceil().clamp(2.0, most) as usize).collect()
}
