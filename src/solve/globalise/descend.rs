//! Newton's method on a model of the energy that is kept convex.

use nalgebra::{Matrix6, Vector6};

use super::verdict::{is_conservative, softening};
use crate::body::Elastic;
use crate::lie::Strain;
use crate::solve::equilibrium::Configuration;
use crate::solve::linear::{Buffers, Step};
use crate::solve::mesh::Mesh;
use crate::solve::newton::{relative_residual, scale};
use crate::solve::report::Iteration;
use crate::solve::scale::Scale;
use crate::solve::stability::{Verdict, chain};
use crate::solve::unknowns::Unknowns;

/// Models of the energy that are looked at, at the most, for each iteration that Newton's method is allowed: an iteration looks at one or more.
const MODELS: usize = 3;

/// μ where it is raised from nothing.
const FIRST: f64 = 0.05;

/// Below this μ is nothing.
const LEAST: f64 = 1e-3;

/// A model whose step would turn a node further than this, rad, is too soft.
const SOFT: f64 = 1.0;

/// The largest rotation of a node in one iteration, rad.
const CAP: f64 = 0.5;

/// A full step of the unregularised model smaller than this ends the descent.
const TOLERANCE: f64 = 1e-6;

/// As [`TOLERANCE`], with a residual no larger, where loads without a potential leave an equilibrium whose model is not convex.
const SETTLED: f64 = 1e-9;

/// How far the curvatures of a state that would not stay are turned aside, in units of 1/L.
const ASIDE: f64 = 0.05;

/// From a state to a stable one near it: K → (1 + μ) K at the stages, with the wrenches of the nodes as unknowns of their own, and μ raised until the
/// model has no unstable mode and turns no node by more than a radian.
///
/// A stationary point of an energy with the second variation kept positive is left downhill. Loads without a potential have the symmetric part of
/// theirs, which still keeps steps short. `None` where no state is reached.
pub(super) fn descend<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    from: &Unknowns<S>,
    max_iterations: usize,
    buffers: &mut Buffers<S>,
    history: &mut Vec<Iteration>,
) -> Option<Unknowns<S>> {
    let mut unknowns = from.clone();
    let mut state = buffers.configuration();
    mesh.configure(&unknowns, &mut state).ok()?;
    unknowns.wrenches = state.node_wrench[..mesh.elements()].to_vec();
    mesh.configure(&unknowns, &mut state).ok()?;
    let mut trial = buffers.configuration();
    let mut mu = 0.0;
    let mut models = MODELS * max_iterations;
    while models > 0 {
        let residual = relative_residual(&state, &scale(mesh, &state));
        let step = convex_step(mesh, &unknowns, &state, buffers, &mut mu, &mut models)?;
        let mut fraction = if step.rotation > CAP { CAP / step.rotation } else { 1.0 };
        loop {
            buffers.move_by(&unknowns, fraction);
            if mesh.configure(&buffers.trial, &mut trial).is_ok() {
                break;
            }
            fraction *= 0.5;
            if fraction < 1e-6 {
                return None;
            }
        }
        std::mem::swap(&mut unknowns, &mut buffers.trial);
        std::mem::swap(&mut state, &mut trial);
        let step_taken = fraction * step.size;
        history.push(Iteration { elements: mesh.elements(), residual, step: step_taken, fraction });
        let settled = step.size < SETTLED && residual < SETTLED && !is_conservative(mesh, &state);
        if fraction == 1.0 && (mu == 0.0 && step.size < TOLERANCE || settled) {
            unknowns.wrenches.clear();
            return Some(unknowns);
        }
        mu = if mu > LEAST { 0.2 * mu } else { 0.0 };
    }
    None
}

/// The step of the first model, with growing μ, that is convex and not too soft.
fn convex_step<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    unknowns: &Unknowns<S>,
    state: &Configuration<S>,
    buffers: &mut Buffers<S>,
    mu: &mut f64,
    models: &mut usize,
) -> Option<Step> {
    let scale = scale(mesh, state);
    let soft = softening(mesh, state).is_some();
    let constraint = mesh.rod.body().constraint();
    let mut model = state.clone();
    while *models > 0 {
        *models -= 1;
        // the model in units of its own stiffness
        let units = Scale { force: scale.force * (1.0 + *mu), ..scale };
        for (modelled, response) in model.response.iter_mut().flatten().zip(state.response.iter().flatten()) {
            let tangent = constraint.of_free(&response.tangent, 1.0);
            let stiff = if soft { convex(&tangent) } else { tangent };
            modelled.tangent = tangent + stiff * *mu;
        }
        // a base that may move is held back as well: supports alone need not keep the rod from swinging
        let held_back = Matrix6::from_diagonal(&hold_back(&scale)) * *mu;
        model.base_load.tangent = state.base_load.tangent - held_back;
        let done = buffers.condense(mesh, unknowns, &model).is_ok() && {
            let verdict = chain(mesh, &model, &buffers.condensed, &units).map(|chain| chain.verdict(1e-11));
            matches!(verdict, Some(Verdict::Index { unstable: 0, .. }))
        };
        if done
            && let Ok(step) = buffers.solve_condensed(mesh, &model, &units)
            && (step.rotation <= SOFT || *mu > 1e4)
        {
            return Some(step);
        }
        *mu = if *mu == 0.0 { FIRST } else { 3.0 * *mu };
    }
    None
}

/// The stiffness of springs EI/L against rotation and EI/L³ against displacement.
fn hold_back(scale: &Scale) -> Vector6<f64> {
    let (moment, force) = (scale.force * scale.length, scale.force / scale.length);
    Vector6::new(moment, moment, moment, force, force, force)
}

/// The absolute value of a symmetric stiffness, by its eigenvalues.
fn convex(tangent: &Matrix6<f64>) -> Matrix6<f64> {
    // in units that make the diagonal one
    let scale = tangent.diagonal().map(|d| 1.0 / d.abs().sqrt().max(1e-150));
    let scaled = Matrix6::from_fn(|r, c| scale[r] * tangent[(r, c)] * scale[c]);
    let eigen = scaled.symmetric_eigen();
    let positive = eigen.eigenvectors * Matrix6::from_diagonal(&eigen.eigenvalues.map(|v| v.abs().max(0.1)));
    let positive = positive * eigen.eigenvectors.transpose();
    Matrix6::from_fn(|r, c| positive[(r, c)] / (scale[r] * scale[c]))
}

/// The same state with its curvatures, but for those that are fixed, changed a little, in a way that no symmetry of a rod has.
pub(super) fn turned_aside<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    from: &Unknowns<S>,
) -> Unknowns<S> {
    let (length, constraint) = (mesh.rod.body().length(), mesh.rod.body().constraint());
    let mut unknowns = from.clone();
    for (i, element) in unknowns.strains.iter_mut().enumerate() {
        for (k, strain) in element.iter_mut().enumerate() {
            let phase = mesh.stage_s(i, k) / length;
            let bend = ASIDE / length;
            let aside =
                [bend * (5.3 * phase + 0.3).cos(), bend * (7.2 * phase + 0.5).sin(), 0.0, 0.0, 0.0, 0.0];
            *strain += constraint.free_part(Strain::from_array(aside));
        }
    }
    unknowns
}
