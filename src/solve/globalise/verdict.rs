use crate::body::Elastic;
use crate::solve::equilibrium::Configuration;
use crate::solve::linear::Buffers;
use crate::solve::mesh::Mesh;
use crate::solve::newton::scale;
use crate::solve::report::Stability;
use crate::solve::stability::{Verdict, chain};
use crate::solve::unknowns::Unknowns;

/// What is neutral in a state that is solved to the accuracy asked for, and in one that is but a start for finer meshes.
pub(crate) const NEUTRAL: f64 = 1e-6;
pub(super) const NEUTRAL_START: f64 = 1e-3;

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
    (0..mesh.elements()).find_map(|i| {
        (0..S).find(|&k| state.response[i][k].tangent.cholesky().is_none()).map(|k| mesh.stage_s(i, k))
    })
}

/// Whether a cantilever that was just solved is surely stable, by the elements as they were condensed in the last step.
pub(crate) fn is_surely_stable<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
    buffers: &Buffers<S>,
) -> bool {
    mesh.is_cantilever()
        && is_conservative(mesh, state)
        && softening(mesh, state).is_none()
        && needed_parts(mesh, state, SAFE).iter().all(|&count| count == 1)
        && chain(mesh, state, &buffers.condensed, &scale(mesh, state)).is_some_and(|c| c.is_surely_stable())
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
        let prolonged = unknowns.prolonged(mesh, &parts);
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
    let parts = |i: usize| {
        let x = mesh.h(i) / std::f64::consts::TAU;
        let mut most: f64 = 1.0;
        for k in 0..S {
            let (response, wrench) = (&state.response[i][k], &state.stage_wrench[i][k]);
            let d = response.tangent.diagonal();
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
