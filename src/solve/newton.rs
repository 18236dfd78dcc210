//! Newton's method on the stage strains of one mesh.

use nalgebra::{SMatrix, SVector};

use super::chain::{self, EndRows};
use super::equilibrium::{Condensed, Configuration, Scale};
use super::failure::Reason;
use super::mesh::{Mesh, StageStrains};
use super::report::Iteration;
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist};

/// The largest rotation of a node in one iteration, rad. A step that turns a node further is shortened: beyond about one radian
/// the linearised rotation says little about the true one.
const ROTATION_CAP: f64 = 1.0;

/// How often a step to an inadmissible state is halved: to a millionth.
const HALVINGS: usize = 20;

/// A step below this that no longer shrinks is rounding; it is accepted as converged.
const ROUNDING_STEP: f64 = 1e-7;

pub(crate) struct Newton<'o> {
    pub(crate) max_iterations: usize,
    pub(crate) tolerance: f64,
    pub(crate) observer: &'o mut dyn FnMut(&Iteration),
}

/// What Newton's method ended with.
pub(crate) struct Outcome<const S: usize> {
    pub(crate) strains: StageStrains<S>,
    pub(crate) state: Option<Configuration<S>>,
    pub(crate) residual: f64,
    pub(crate) iterations: Vec<Iteration>,
    pub(crate) failure: Option<Reason>,
}

/// A Newton step: increments of the stage strains, and its size.
struct Step<const S: usize> {
    strains: Vec<[Strain; S]>,
    size: f64,
    rotation: f64,
}

impl Newton<'_> {
    /// Iterates from the given strains until a full step is below the tolerance.
    pub(crate) fn solve<B: Elastic, const S: usize>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        start: StageStrains<S>,
    ) -> Outcome<S> {
        let mut out = Outcome {
            strains: start,
            state: None,
            residual: f64::INFINITY,
            iterations: Vec::new(),
            failure: None,
        };
        let mut state = match mesh.configure(&out.strains) {
            Ok(state) => state,
            Err(error) => {
                out.failure = Some(Reason::Start(error));
                return out;
            }
        };
        let mut previous = f64::INFINITY;
        for iteration in 0..self.max_iterations {
            let scale = scale(mesh, &state);
            out.residual = relative_residual(&state, &scale);
            let step = match newton_step(mesh, &out.strains, &state, &scale) {
                Ok(step) => step,
                Err(error) => {
                    out.failure = Some(Reason::Singular { iteration, error });
                    break;
                }
            };
            let cap = if step.rotation > ROTATION_CAP { ROTATION_CAP / step.rotation } else { 1.0 };
            let (fraction, next) = match admissible(mesh, &out.strains, &step, cap) {
                Ok(taken) => taken,
                Err((fraction, error)) => {
                    out.failure = Some(Reason::NoAdmissibleStep { iteration, fraction, error });
                    break;
                }
            };
            out.strains = moved(&out.strains, &step, fraction);
            state = next;
            let record = Iteration {
                elements: mesh.elements(),
                residual: out.residual,
                step: fraction * step.size,
                fraction,
            };
            (self.observer)(&record);
            out.iterations.push(record);
            let full = fraction == 1.0;
            let stalled = step.size < ROUNDING_STEP && step.size > 0.5 * previous;
            if full && (step.size <= self.tolerance || stalled) {
                out.residual = relative_residual(&state, &scale);
                out.state = Some(state);
                return out;
            }
            previous = step.size;
        }
        if out.failure.is_none() {
            let step = out.iterations.last().map_or(f64::NAN, |i| i.step);
            let (limit, tolerance) = (self.max_iterations, self.tolerance);
            out.failure = Some(Reason::IterationLimit { limit, step, tolerance });
        }
        out.state = Some(state);
        out
    }
}

/// Units for the chain: the rod's length, and the force its bending stiffness makes of it.
fn scale<B: Elastic, const S: usize>(mesh: &Mesh<'_, B, S>, state: &Configuration<S>) -> Scale {
    let length = mesh.rod.body().length();
    let k = &state.response[0][0].tangent;
    let bending = k[(0, 0)].abs().max(k[(1, 1)].abs()).max(f64::MIN_POSITIVE);
    Scale { length, force: bending / (length * length) }
}

/// The largest residual over the stages, relative to the largest wrench there is.
fn relative_residual<const S: usize>(state: &Configuration<S>, scale: &Scale) -> f64 {
    let mut residual: f64 = 0.0;
    let mut wrench: f64 = 0.0;
    for i in 0..state.response.len() {
        let r = state.residual(i);
        for k in 0..S {
            residual = residual.max(scale.wrench_size(&r[k]));
            wrench = wrench
                .max(scale.wrench_size(&state.stage_wrench[i][k]))
                .max(scale.wrench_size(&state.response[i][k].wrench));
        }
    }
    if wrench > 0.0 { residual / wrench } else { residual }
}

fn newton_step<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    strains: &StageStrains<S>,
    state: &Configuration<S>,
    scale: &Scale,
) -> Result<Step<S>> {
    let elements: Option<Vec<_>> =
        mesh.linearise(strains, state).iter().map(|element| Condensed::new(element, scale)).collect();
    let elements = elements
        .ok_or(Error::Singular { matrix: "tangent of an element", s: 0.5 * mesh.rod.body().length() })?;
    let mut left = EndRows { matrix: SMatrix::zeros(), rhs: SVector::zeros() };
    left.matrix.fixed_view_mut::<6, 6>(0, 0).fill_with_identity();
    let right = state.tip_rows(scale);
    let transfers: Vec<_> = elements.iter().map(|e| e.transfer.clone()).collect();
    let nodes = chain::solve(&left, &transfers, &right, |i| mesh.node_s(i))?;

    let length = scale.length;
    let mut step = Step { strains: Vec::with_capacity(strains.len()), size: 0.0, rotation: 0.0 };
    for (i, y) in nodes.iter().enumerate() {
        let (zeta, wrench): (Twist, _) = scale.unscale(y);
        step.rotation = step.rotation.max(zeta.angular.norm());
        step.size = step.size.max(zeta.angular.norm()).max(zeta.linear.norm() / length);
        if let Some(element) = elements.get(i) {
            let increment = element.strain_step(&zeta, &wrench);
            for strain in &increment {
                step.size = step.size.max(strain.linear.norm()).max(strain.angular.norm() * length);
            }
            step.strains.push(increment);
        }
    }
    if !step.size.is_finite() {
        return Err(Error::Singular { matrix: "tangent of the rod", s: length });
    }
    Ok(step)
}

fn moved<const S: usize>(strains: &StageStrains<S>, step: &Step<S>, fraction: f64) -> StageStrains<S> {
    strains
        .iter()
        .zip(&step.strains)
        .map(|(element, d)| std::array::from_fn(|k| element[k] + d[k] * fraction))
        .collect()
}

/// The longest of cap, cap/2, cap/4, … that leads to an admissible state, with that state.
fn admissible<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    strains: &StageStrains<S>,
    step: &Step<S>,
    cap: f64,
) -> Result<(f64, Configuration<S>), (f64, Error)> {
    let mut fraction = cap;
    for _ in 0..HALVINGS {
        match mesh.configure(&moved(strains, step, fraction)) {
            Ok(state) => return Ok((fraction, state)),
            Err(_) => fraction *= 0.5,
        }
    }
    match mesh.configure(&moved(strains, step, fraction)) {
        Ok(state) => Ok((fraction, state)),
        Err(error) => Err((fraction, error)),
    }
}
