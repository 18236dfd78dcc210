//! The loads, and what the supports hold, brought on in steps.

use crate::body::Elastic;
use crate::solve::linear::Buffers;
use crate::solve::mesh::Mesh;
use crate::solve::newton::{Newton, Stop};
use crate::solve::report::Iteration;
use crate::solve::unknowns::Unknowns;

/// The first step of the load factor, and the largest.
const FIRST: f64 = 0.25;

/// The smallest.
const LEAST: f64 = 1e-3;

/// Steps at the most, for each iteration that Newton's method is allowed.
const STEPS: usize = 3;

/// Iterations of a step, at the most.
const ITERATIONS: usize = 20;

/// From rest to the full load; every step starts on the secant of the two before. `None` where a step of 1e-3 fails.
pub(super) fn load_steps<B: Elastic, const S: usize>(
    mesh: &mut Mesh<'_, B, S>,
    max_iterations: usize,
    buffers: &mut Buffers<S>,
    history: &mut Vec<Iteration>,
) -> Option<Unknowns<S>> {
    let found = steps(mesh, max_iterations, buffers, history);
    mesh.load_factor = 1.0;
    found
}

fn steps<B: Elastic, const S: usize>(
    mesh: &mut Mesh<'_, B, S>,
    max_iterations: usize,
    buffers: &mut Buffers<S>,
    history: &mut Vec<Iteration>,
) -> Option<Unknowns<S>> {
    let mut here = (0.0, Unknowns::at_rest(mesh));
    let mut before: Option<(f64, Unknowns<S>)> = None;
    let mut step = FIRST;
    for _ in 0..STEPS * max_iterations {
        let factor = (here.0 + step).min(1.0);
        mesh.load_factor = factor;
        let start = match &before {
            Some((at, unknowns)) => secant(unknowns, &here.1, (factor - here.0) / (here.0 - at)),
            None => here.1.clone(),
        };
        let mut newton = Newton {
            max_iterations: ITERATIONS.min(max_iterations),
            stop: Stop::Step(1e-6),
            observer: &mut |_| (),
            amplification: 1.0,
        };
        let outcome = newton.solve(mesh, start, buffers, history);
        if outcome.failure.is_none() {
            if factor == 1.0 {
                return Some(outcome.unknowns);
            }
            before = Some(std::mem::replace(&mut here, (factor, outcome.unknowns)));
            step = (1.5 * step).min(FIRST);
        } else {
            step *= 0.5;
            if step < LEAST {
                return None;
            }
        }
        outcome.state.into_iter().for_each(|state| buffers.recycle(state));
    }
    None
}

/// b + t (b − a) in the strains and the wrenches, which are linear; the base stays where it is.
fn secant<const S: usize>(a: &Unknowns<S>, b: &Unknowns<S>, t: f64) -> Unknowns<S> {
    let mut ahead = b.clone();
    for (to, from) in ahead.strains.iter_mut().flatten().zip(a.strains.iter().flatten()) {
        *to = *to + (*to - *from) * t;
    }
    ahead.tip = b.tip + (b.tip - a.tip) * t;
    for (to, from) in ahead.reactions.iter_mut().zip(&a.reactions) {
        *to = *to + (*to - *from) * t;
    }
    ahead
}
