//! What the rod sees of a section in equilibrium.

use super::assembly::{Displaced, Frame};
use super::equilibrium::{Equilibrium, Problem};
use super::rate::wrench_rate;
use crate::error::Result;
use crate::lie::{Strain, Wrench};
use crate::material::{GradientState, Request, Response};

/// Energy, wrench and tangent of the section in equilibrium, the last correction accounted for to second order.
pub(super) fn condense(
    problem: &Problem<'_>,
    strain: &Strain,
    equilibrium: &Equilibrium,
    request: Request,
) -> Result<Response> {
    let (slopes, step) = (&equilibrium.slopes, &equilibrium.correction);
    let mut response = Response::zero();
    response.energy = slopes.energy;
    let mut psi = slopes.strain;
    let mut tangent = equilibrium.curvatures.strain;
    if let Some(system) = &equilibrium.system {
        // to second order in the last correction δq = −U_qq⁻¹ U_q
        response.energy += equilibrium.lowered;
        for (k, change) in equilibrium.mixed.tr_mul(step).iter().enumerate() {
            psi[k] += change;
        }
        let solved = system.solve(&equilibrium.mixed);
        for i in 0..6 {
            for k in i..6 {
                tangent[(i, k)] -= equilibrium.mixed.column(i).dot(&solved.column(k));
            }
        }
    }
    for i in 0..6 {
        for k in 0..i {
            tangent[(i, k)] = tangent[(k, i)];
        }
    }
    if request >= Request::Wrench {
        response.wrench = Wrench::from_vector(&psi);
    }
    if request >= Request::Tangent {
        response.tangent = tangent;
    }
    if request >= Request::Rate {
        let frame = Frame::new(problem.modes, problem.at, strain)?;
        let coefficients = problem.modes.expand(&equilibrium.evaluated_at);
        let displaced = Displaced::new(problem.modes, &frame, &coefficients);
        let mut state = GradientState::default();
        problem.evaluate(&displaced, &equilibrium.evaluated_at, Request::Rate, &mut state)?;
        let rate = wrench_rate(&displaced, &state, equilibrium, &coefficients, problem.at);
        response.wrench_rate = Wrench::from_vector(&rate);
    }
    Ok(response)
}
