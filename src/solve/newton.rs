//! Newton's method on the unknowns of one mesh.

use super::equilibrium::Configuration;
use super::failure::Reason;
use super::linear::{Buffers, Step};
use super::mesh::Mesh;
use super::report::Iteration;
use super::scale::{Largest, Scale};
use super::unknowns::Unknowns;
use crate::body::Elastic;
use crate::error::Error;

/// The largest rotation of a node in one iteration, rad. A step that turns a node further is shortened: beyond about one radian
/// the linearised rotation says little about the true one.
const ROTATION_CAP: f64 = 1.0;

/// How often a step to an inadmissible state is halved: to a millionth.
const HALVINGS: usize = 20;

/// A step below this that no longer shrinks is rounding; it is accepted as converged.
const ROUNDING_STEP: f64 = 1e-7;

/// When Newton's method stops.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Stop {
    /// After a full step smaller than this.
    Step(f64),
    /// When the error left is below this: C step², with C from how the steps before fell, or what the residual left makes of it.
    Error(f64),
}

/// The next step is taken to be at most this many times the residual left × the largest ratio of step to residual seen so far.
const AMPLIFIED: f64 = 4.0;

/// The constant C of s′ ≈ C s² is at least this: two steps tell it to a factor of a few.
const LEAST_CONSTANT: f64 = 0.3;

/// Where no two steps have told it yet, on the safe side of what is found (0.02 to 0.3 in the reference cases).
const FIRST_CONSTANT: f64 = 1.0;

impl Stop {
    /// `next` is what is expected of the next step.
    fn reached(&self, step: f64, previous: f64, next: f64) -> bool {
        match *self {
            Self::Step(tolerance) => step <= tolerance,
            // the residual tells only where it fell as it does once the steps are small
            Self::Error(tolerance) if step < 0.1 && next < 0.01 * step && next <= tolerance => true,
            Self::Error(tolerance) => {
                let falling = previous.is_finite() && step < 0.5 * previous;
                let constant = if falling {
                    (2.0 * step / (previous * previous)).max(LEAST_CONSTANT)
                } else {
                    FIRST_CONSTANT
                };
                constant * step * step <= tolerance && step < 0.1
            }
        }
    }

    /// The step that is surely small enough.
    fn step(&self) -> f64 {
        match *self {
            Self::Step(tolerance) => tolerance,
            Self::Error(tolerance) => (tolerance / FIRST_CONSTANT).sqrt(),
        }
    }
}

pub(crate) struct Newton<'o> {
    pub(crate) max_iterations: usize,
    pub(crate) stop: Stop,
    pub(crate) observer: &'o mut dyn FnMut(&Iteration),
    /// The largest ratio of a step to the residual before it, on all meshes so far; at least 1.
    pub(crate) amplification: f64,
}

/// What Newton's method ended with.
pub(crate) struct Outcome<const S: usize> {
    pub(crate) unknowns: Unknowns<S>,
    pub(crate) state: Option<Configuration<S>>,
    pub(crate) residual: f64,
    /// How many iterations were made.
    pub(crate) iterations: usize,
    pub(crate) failure: Option<Reason>,
    /// [`DeadSweep::least_stiffness`](super::dead::DeadSweep) of the last step, 0 where it is not known.
    pub(crate) least_stiffness: f64,
    /// Size of that step.
    pub(crate) last_step: f64,
    /// What was wrong with a state that more of that step leads to.
    rejected: Option<Error>,
}

impl<const S: usize> Outcome<S> {
    fn begin(unknowns: Unknowns<S>) -> Self {
        Self {
            unknowns,
            state: None,
            residual: f64::INFINITY,
            iterations: 0,
            failure: None,
            least_stiffness: 0.0,
            last_step: f64::INFINITY,
            rejected: None,
        }
    }

    /// Gives the memory of the state back.
    pub(crate) fn recycle(self, buffers: &mut Buffers<S>) {
        if let Some(state) = self.state {
            buffers.recycle(state);
        }
    }
}

impl Newton<'_> {
    /// Iterates from the given unknowns until a full step is below the tolerance.
    pub(crate) fn solve<B: Elastic, const S: usize>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        start: Unknowns<S>,
        buffers: &mut Buffers<S>,
        history: &mut Vec<Iteration>,
    ) -> Outcome<S> {
        let mut out = Outcome::begin(start);
        let mut state = buffers.configuration();
        if let Err(error) = mesh.configure(&out.unknowns, &mut state) {
            out.failure = Some(Reason::Start(error));
            return out;
        }
        let mut trial = buffers.configuration();
        let mut previous = f64::INFINITY;
        out.residual = relative_residual(&state, &scale(mesh, &state));
        for _ in 0..self.max_iterations {
            let fraction = match self.step(mesh, &mut out, &mut state, &mut trial, buffers, history) {
                Ok(fraction) => fraction,
                Err(reason) => {
                    out.failure = Some(reason);
                    break;
                }
            };
            let (full, size) = (fraction == 1.0, out.last_step);
            let next = AMPLIFIED * self.amplification * out.residual;
            let stalled = size < ROUNDING_STEP && size > 0.5 * previous;
            if full && (self.stop.reached(size, previous, next) || stalled) {
                out.state = Some(state);
                buffers.recycle(trial);
                return out;
            }
            previous = if full { size } else { f64::INFINITY };
        }
        if out.failure.is_none() {
            out.failure = Some(self.limit_reached(&mut out, history));
        }
        out.state = Some(state);
        out
    }

    /// Why there was no convergence: what the last step says of it.
    fn limit_reached<const S: usize>(&self, out: &mut Outcome<S>, history: &[Iteration]) -> Reason {
        let (limit, last) = (self.max_iterations, history.last());
        if let (Some(last), Some(error)) = (last, out.rejected.take()) {
            return Reason::ShortSteps { limit, fraction: last.fraction, step: out.last_step, error };
        }
        let step = last.map_or(f64::NAN, |last| last.step);
        Reason::IterationLimit { limit, step, tolerance: self.stop.step() }
    }

    /// Moves `out` and `state` by the longest admissible part of a Newton step, and returns that part.
    fn step<B: Elastic, const S: usize>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        out: &mut Outcome<S>,
        state: &mut Configuration<S>,
        trial: &mut Configuration<S>,
        buffers: &mut Buffers<S>,
        history: &mut Vec<Iteration>,
    ) -> Result<f64, Reason> {
        let (iteration, scale) = (out.iterations, scale(mesh, state));
        let step = buffers
            .newton_step(mesh, &out.unknowns, state, &scale)
            .map_err(|error| Reason::Singular { iteration, error })?;
        let cap = if step.rotation > ROTATION_CAP { ROTATION_CAP / step.rotation } else { 1.0 };
        let (fraction, rejected) = admissible(mesh, &out.unknowns, buffers, cap, trial)
            .map_err(|(fraction, error)| Reason::NoAdmissibleStep { iteration, fraction, error })?;
        std::mem::swap(&mut out.unknowns, &mut buffers.trial);
        std::mem::swap(state, trial);
        out.iterations += 1;
        (out.least_stiffness, out.last_step, out.rejected) = (buffers.least_stiffness, step.size, rejected);
        self.record(mesh.elements(), out.residual, &step, fraction, history);
        if step.size > ROUNDING_STEP {
            self.amplification = self.amplification.max(step.size / out.residual.max(f64::MIN_POSITIVE));
        }
        out.residual = relative_residual(state, &scale);
        Ok(fraction)
    }

    fn record(
        &mut self,
        elements: usize,
        residual: f64,
        step: &Step,
        fraction: f64,
        history: &mut Vec<Iteration>,
    ) {
        let record = Iteration { elements, residual, step: fraction * step.size, fraction };
        (self.observer)(&record);
        history.push(record);
    }
}

/// Units for the chain: the rod's length, and the force its bending stiffness makes of it.
pub(crate) fn scale<B: Elastic, const S: usize>(mesh: &Mesh<'_, B, S>, state: &Configuration<S>) -> Scale {
    let length = mesh.rod.body().length();
    let [x, y, torsion, shears @ ..] =
        mesh.rod.body().constraint().diagonal_of_free(&state.response[0][0].tangent, 0.0).map(f64::abs);
    // a rod that cannot bend has what else it has
    let of_force = shears.into_iter().fold(0.0, f64::max) * (length * length);
    let bending = [x.max(y), torsion, of_force, f64::MIN_POSITIVE].into_iter().find(|k| *k > 0.0);
    let bending = bending.unwrap_or(f64::MIN_POSITIVE);
    Scale { length, force: bending / (length * length) }
}

/// The largest residual over stages and nodes, relative to the largest wrench there is.
pub(crate) fn relative_residual<const S: usize>(state: &Configuration<S>, scale: &Scale) -> f64 {
    let (mut residual, mut wrench) = (Largest::default(), Largest::default());
    for (response, stage) in state.response.as_flattened().iter().zip(state.stage_wrench.as_flattened()) {
        residual.add(&(response.wrench - *stage));
        wrench.add(stage);
        wrench.add(&response.wrench);
    }
    state.defect.iter().for_each(|defect| residual.add(defect));
    let (residual, wrench) = (scale.largest(&residual), scale.largest(&wrench));
    if wrench > 0.0 { residual / wrench } else { residual }
}

/// The longest of cap, cap/2, cap/4, … that leads to an admissible state, and what was wrong with the one before; that state is in `trial`, its unknowns
/// in `buffers.trial`.
fn admissible<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    unknowns: &Unknowns<S>,
    buffers: &mut Buffers<S>,
    cap: f64,
    trial: &mut Configuration<S>,
) -> Result<(f64, Option<Error>), (f64, Error)> {
    let (mut fraction, mut rejected) = (cap, None);
    for halving in 0..=HALVINGS {
        buffers.move_by(unknowns, fraction);
        match mesh.configure(&buffers.trial, trial) {
            Ok(()) => break,
            Err(error) if halving == HALVINGS => return Err((fraction, error)),
            Err(error) => (fraction, rejected) = (0.5 * fraction, Some(error)),
        }
    }
    Ok((fraction, rejected))
}
