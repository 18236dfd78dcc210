//! From the unknowns of a mesh to what a user reads.

use nalgebra::{Matrix6, Vector6};

use super::equilibrium::Configuration;
use super::failure::{Failure, Reason};
use super::mesh::Mesh;
use super::newton::Outcome;
use super::report::Report;
use super::solution::{Node, StaticSolution};
use super::unknowns::StageStrains;
use crate::body::Elastic;
use crate::lie::{Pose, Strain, Wrench};
use crate::material::Request;

/// The failure that Newton's method ended with.
pub(super) fn failed<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    outcome: Outcome<S>,
    report: Report,
) -> Box<Failure> {
    let last = outcome
        .state
        .as_ref()
        .map(|state| describe(mesh, &outcome.unknowns.strains, state, None, report.clone()));
    let reason = outcome.failure.unwrap_or(Reason::IterationLimit {
        limit: outcome.iterations,
        step: f64::NAN,
        tolerance: f64::NAN,
    });
    Box::new(Failure { reason, report, last })
}

/// The solution that a configuration describes; `ends` says by how much the strains at the ends of elements differ from the polynomials,
/// where that is known.
pub(super) fn describe<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    strains: &StageStrains<S>,
    state: &Configuration<S>,
    ends: Option<&[[Strain; 2]]>,
    report: Report,
) -> StaticSolution {
    let mut stages = Vec::with_capacity(S * mesh.elements());
    for (i, element) in strains.iter().enumerate() {
        for k in 0..S {
            stages.push(Node {
                s: mesh.stage_s(i, k),
                pose: state.node_pose[i] * state.kinematics[i].stage[k],
                strain: element[k],
                wrench: state.response[i][k].wrench,
            });
        }
    }
    let node = |at: usize, element: usize, end: usize, pose: Pose, wrench: Wrench| {
        let guess = mesh.interpolate(&strains[element], end as f64);
        let guess = ends.map_or(guess, |ends| guess + ends[element][end]);
        let s = mesh.node_s(at);
        let strain = strain_of_wrench(mesh.rod.body(), s, &wrench, guess);
        Node { s, pose, strain, wrench }
    };
    let mut nodes = Vec::with_capacity(mesh.elements() + 1 + state.joints.len());
    let mut joints = state.joints.iter();
    for i in 0..mesh.elements() {
        nodes.push(node(i, i, 0, state.node_pose[i], state.node_wrench[i]));
        // a joint has a node on either side
        if let Some(joint) = mesh.joint_at(i + 1).and_then(|_| joints.next()) {
            nodes.push(node(i + 1, i, 1, joint.pose, joint.wrench));
        }
    }
    let last = mesh.elements();
    nodes.push(node(last, last - 1, 1, state.node_pose[last], state.node_wrench[last]));
    let (strain_energy, load_potential) = mesh.energies(state);
    StaticSolution { nodes, stages, strain_energy, load_potential, report }
}

/// The strain of Ψ(Δξ) = Λ at a node by Newton's method. Where that fails (a law without a unique inverse), the strain interpolated from
/// the stages stands.
fn strain_of_wrench<B: Elastic>(body: &B, s: f64, wrench: &Wrench, guess: Strain) -> Strain {
    let mut strain = guess;
    let mut previous = f64::INFINITY;
    for _ in 0..20 {
        let Some(step) = strain_correction(body, s, wrench, &strain) else { return guess };
        // a step relative to the strains of the rod: curvatures in units of 1/L
        let size = step.linear.norm() + step.angular.norm() * body.length();
        strain += step;
        // its square is below rounding, or it no longer falls
        if size < 1e-9 || (size < 1e-7 && size > 0.5 * previous) {
            return strain;
        }
        previous = size;
    }
    guess
}

/// (∂Ψ/∂Δξ)⁻¹ (Λ − Ψ(Δξ)); `None` for an inadmissible strain or a singular tangent.
pub(super) fn strain_correction<B: Elastic>(
    body: &B,
    s: f64,
    wrench: &Wrench,
    strain: &Strain,
) -> Option<Strain> {
    let response = body.respond(s, strain, Request::Tangent).ok()?;
    let (mut tangent, mut residual) = (response.tangent, (*wrench - response.wrench).to_vector());
    for (i, _) in body.constraint().fixed().iter().enumerate().filter(|(_, fixed)| **fixed) {
        // Δξ_i = 0
        tangent.row_mut(i).fill(0.0);
        tangent.column_mut(i).fill(0.0);
        (tangent[(i, i)], residual[i]) = (1.0, -strain.to_array()[i]);
    }
    let step = match solve_definite(&tangent, &residual) {
        Some(step) => step,
        None => tangent.lu().solve(&residual)?,
    };
    Some(Strain::from_vector(&step))
}

/// Solves K x = b by L D Lᵀ, of the lower triangle; `None` if K is not positive definite.
fn solve_definite(k: &Matrix6<f64>, b: &Vector6<f64>) -> Option<Vector6<f64>> {
    let mut l = *k;
    let mut x = *b;
    let mut inverse = [0.0; 6];
    for c in 0..6 {
        let pivot = l[(c, c)];
        if !(pivot > f64::MIN_POSITIVE && pivot.is_finite()) {
            return None;
        }
        inverse[c] = 1.0 / pivot;
        for r in c + 1..6 {
            let factor = l[(r, c)] * inverse[c];
            for m in r..6 {
                l[(m, r)] -= factor * l[(m, c)];
            }
            x[r] -= factor * x[c];
        }
    }
    for c in (0..6).rev() {
        x[c] *= inverse[c];
        for r in c + 1..6 {
            x[c] -= l[(r, c)] * inverse[c] * x[r];
        }
    }
    Some(x)
}
