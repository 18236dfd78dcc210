use nalgebra::Matrix6;

use crate::body::Elastic;
use crate::solve::equilibrium::Configuration;
use crate::solve::linear::Buffers;
use crate::solve::mesh::Mesh;
use crate::solve::newton::{Outcome, scale};
use crate::solve::report::Stability;
use crate::solve::stability::{Verdict, chain};
use crate::solve::unknowns::Unknowns;

/// What is neutral in a state that is solved to the accuracy asked for, and in one that is but a start for finer meshes.
pub(crate) const NEUTRAL: f64 = 1e-6;
pub(crate) const NEUTRAL_START: f64 = 1e-3;

/// With more elements than this a mesh is but safe, not resolved.
const MANY_ELEMENTS: usize = 1500;

/// The most elements on which a verdict is sought.
const MAX_ELEMENTS: usize = 20_000;

/// How often a mesh that cannot tell is cut further.
const CUTS: usize = 3;

/// An element is resolved if its loads are below this part of what it bears with both ends held.
const RESOLVED: f64 = 0.03;

/// The same where it is enough that no element is unstable by itself.
pub(super) const SAFE: f64 = 0.4;

/// Whether every load there is has a potential.
pub(super) fn is_conservative<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> bool {
    mesh.energies(state).1.is_some()
}

/// The first stage whose section has lost its convexity: a law that softens.
pub(super) fn softening<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> Option<f64> {
    let constraint = mesh.rod.body().constraint();
    let is_definite = |tangent| constraint.of_free(tangent, 1.0).cholesky().is_some();
    let mut definite: Option<&Matrix6<f64>> = None;
    for i in 0..mesh.elements() {
        for k in 0..S {
            let tangent = &state.response[i][k].tangent;
            // most laws are linear: what is the same as before needs no second look
            if !definite.is_some_and(|other| is_same(other, tangent)) && !is_definite(tangent) {
                return Some(mesh.stage_s(i, k));
            }
            definite = Some(tangent);
        }
    }
    None
}

/// Whether two matrices are equal, entry by entry without a branch.
#[inline(always)]
fn is_same(a: &Matrix6<f64>, b: &Matrix6<f64>) -> bool {
    a.as_slice().iter().zip(b.as_slice()).fold(true, |same, (a, b)| same & (a == b))
}

/// Whether the pivots of the last Newton step leave no doubt that a state is stable: with room for that step to have changed them, and elements
/// so short that none can buckle with its ends kept from rotating.
///
/// Under a dead force on the tip alone, which is all that the pivots are known for, poses matter by their rotations only.
pub(super) fn is_stable_by_pivots<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    outcome: &Outcome<S>,
    state: &Configuration<S>,
) -> bool {
    let unit = scale(mesh, state).wrench()[0];
    let loads = state.node_wrench.iter().map(|w| scale(mesh, state).wrench_size(w));
    let most = loads.fold(1.0, f64::max);
    let room = 100.0 * outcome.last_step * most + 1e-3;
    outcome.least_stiffness > room * unit
        && (0..mesh.elements()).all(|i| is_resolved(mesh, i, state))
        && is_conservative(mesh, state)
        && softening(mesh, state).is_none()
}

/// An element whose ends may move but not rotate is stable below 1.
const SURELY_RESOLVED: f64 = 0.75;

/// Whether an element is stable whose ends may move but not rotate: (|m| h/2πk)² + n h²/π²k below 1, with the least stiffness k against
/// bending and torsion, and n the force taken as compressive, with what shear adds to it.
///
/// With w = 0 at both ends, ∫k|w′|² − m·(w × w′) − n|w|² is ∫k|w′ − ½ m × w/k|² − (¼|m|²/k + n)|w|² at the least, and its first part at
/// least kπ²/h² ∫|w|².
fn is_resolved<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    i: usize,
    state: &Configuration<S>,
) -> bool {
    let (x, constraint) = (mesh.h(i) / std::f64::consts::PI, mesh.rod.body().constraint());
    state.response[i].iter().zip(&state.stage_wrench[i]).all(|(response, wrench)| {
        let d = constraint.diagonal_of_free(&response.tangent, f64::INFINITY);
        let (bending, soft) = (d[0].min(d[1]).min(d[2]), d[3].min(d[4]).min(d[5]));
        let (moment, force) = (0.5 * x * wrench.moment.norm() / bending, wrench.force.norm());
        moment * moment + (force + force * force / soft) * x * x / bending <= SURELY_RESOLVED
    })
}

/// Whether a cantilever that was just solved is surely stable, by the elements as they were in the last step where these are kept.
pub(crate) fn is_surely_stable<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    unknowns: &Unknowns<S>,
    state: &Configuration<S>,
    buffers: &mut Buffers<S>,
    neutral: f64,
) -> bool {
    mesh.is_cantilever()
        && is_conservative(mesh, state)
        && softening(mesh, state).is_none()
        && needed_parts(mesh, state, SAFE).iter().all(|&count| count == 1)
        && buffers
            .condensed_of(mesh, unknowns, state)
            .ok()
            .and_then(|elements| chain(mesh, state, elements, &scale(mesh, state)))
            .is_some_and(|c| c.is_surely_stable(10.0 * neutral))
}

/// How stable a state is. What of the last pivot is below `neutral`, in units of the rod's bending stiffness, counts as nothing.
pub(crate) fn stability<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    unknowns: &Unknowns<S>,
    state: &Configuration<S>,
    buffers: &mut Buffers<S>,
    neutral: f64,
) -> Stability {
    if !is_conservative(mesh, state) {
        return Stability::Unknown;
    }
    if let Some(s) = softening(mesh, state) {
        return Stability::Softening { s };
    }
    let mut parts = needed_parts(mesh, state, RESOLVED);
    if parts.iter().sum::<usize>() > MANY_ELEMENTS {
        parts = needed_parts(mesh, state, SAFE);
    }
    if parts.iter().all(|&count| count == 1) {
        match index(mesh, unknowns, state, buffers, neutral) {
            Some(verdict) => return verdict,
            None if mesh.elements() > MAX_ELEMENTS => return Stability::Unknown,
            None => {}
        }
    }
    refined(mesh, unknowns, parts, buffers, neutral).unwrap_or(Stability::Unknown)
}

/// The index where every element is resolved.
fn index<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    unknowns: &Unknowns<S>,
    state: &Configuration<S>,
    buffers: &mut Buffers<S>,
    neutral: f64,
) -> Option<Stability> {
    let scale = scale(mesh, state);
    buffers.condense(mesh, unknowns, state).ok()?;
    match chain(mesh, state, &buffers.condensed, &scale)?.verdict(neutral) {
        Verdict::Index { unstable, neutral } => Some(Stability::Index { unstable, neutral }),
        Verdict::Unresolved { .. } => None,
    }
}

/// The index of the interpolated state on a finer mesh.
fn refined<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    unknowns: &Unknowns<S>,
    mut parts: Vec<usize>,
    buffers: &mut Buffers<S>,
    neutral: f64,
) -> Option<Stability> {
    let mut state = buffers.configuration();
    let mut found = None;
    for _ in 0..CUTS {
        if parts.iter().sum::<usize>() > MAX_ELEMENTS {
            break;
        }
        let fine = mesh.refined(&parts);
        let prolonged = unknowns.prolonged(mesh, &parts, None);
        if fine.configure(&prolonged, &mut state).is_err() {
            break;
        }
        found = index(&fine, &prolonged, &state, buffers, neutral);
        if found.is_some() {
            break;
        }
        parts.iter_mut().for_each(|count| *count *= 2);
    }
    buffers.recycle(state);
    found
}

/// Into how many pieces every element is to be cut so that none can buckle with both its ends held.
///
/// With x = h/2π: a moment m and a force of the compressive part ½(|n||ν| − n·ν), and what shear adds to it, are borne if
/// |m| x + n x² is below the least bending or torsional stiffness.
pub(super) fn needed_parts<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
    resolved: f64,
) -> Vec<usize> {
    let constraint = mesh.rod.body().constraint();
    let parts = |i: usize| {
        let x = mesh.h(i) / std::f64::consts::TAU;
        let mut most: f64 = 1.0;
        for k in 0..S {
            let (response, wrench) = (&state.response[i][k], &state.stage_wrench[i][k]);
            let d = constraint.diagonal_of_free(&response.tangent, f64::INFINITY);
            let (bending, shear) = (d[0].min(d[1]).min(d[2]), d[3].min(d[4]));
            let n = wrench.force.norm();
            let along = wrench.force.z;
            let compression = 0.5 * (n - along) + (n * n / shear - along.abs()).max(0.0);
            let (moment, force) = (wrench.moment.norm() * x / bending, compression * x * x / bending);
            // the smallest p with moment/p + force/p² ≤ the part
            let p = (moment + (moment * moment + 4.0 * resolved * force).sqrt()) / (2.0 * resolved);
            most = most.max(p);
        }
        if most.is_finite() { most.ceil().min(1e6) as usize } else { 1 }
    };
    (0..mesh.elements()).map(parts).collect()
}
