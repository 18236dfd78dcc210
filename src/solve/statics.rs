use std::time::Instant;

use super::equilibrium::{Configuration, Mesh, StageStrains};
use super::failure::{Failure, Reason};
use super::newton::{Newton, Outcome};
use super::report::{ErrorEstimate, Iteration, Report};
use super::solution::{Node, StaticSolution};
use crate::body::Elastic;
use crate::error::Error;
use crate::lie::{Strain, Wrench};
use crate::material::Request;
use crate::rod::Rod;

/// The order of the element: the error falls with this power of the element length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// One Gauss stage an element.
    Two,
    /// Two Gauss stages an element.
    #[default]
    Four,
    /// Three Gauss stages an element.
    Six,
}

/// Solves static equilibrium on a uniform mesh by Newton's method with the exact tangent.
///
/// It solves a mesh of half as many elements first: that gives the start for the mesh asked for, and the difference of both,
/// divided by 2^order − 1, the error estimate.
///
/// ```
/// use hyperrod::{Body, Pose, Rod, Statics, load::DeadWrench, section::Stiffness};
/// use nalgebra::vector;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
/// let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(vector![1.0, 0.0, 0.0])?);
///
/// let solution = Statics::default().solve(&rod)?;
/// let tip = solution.tip().pose.position; // bends towards +x
/// assert!((tip.x - 0.3018).abs() < 1e-4 && solution.report().error.position < 1e-6);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statics {
    /// How many elements; rounded up to an even number.
    pub elements: usize,
    /// The order of the element.
    pub order: Order,
    /// Newton's method stops after a full step smaller than this (the error left is then of the size of its square). See
    /// [`Iteration::step`] for how a step is measured.
    pub tolerance: f64,
    /// The largest number of Newton iterations on a mesh.
    pub max_iterations: usize,
}

impl Default for Statics {
    /// 16 elements of order 4, tolerance 1e-9, at most 50 iterations.
    fn default() -> Self {
        Self { elements: 16, order: Order::Four, tolerance: 1e-9, max_iterations: 50 }
    }
}

/// The most elements a mesh may have.
const MAX_ELEMENTS: usize = 1_000_000;

impl Statics {
    /// Solves the rod from its reference shape.
    ///
    /// # Errors
    /// A [`Failure`]: why, the history, and the last admissible state.
    pub fn solve<B: Elastic>(&self, rod: &Rod<B>) -> Result<StaticSolution, Box<Failure>> {
        self.solve_observed(rod, |_| ())
    }

    /// As [`solve`](Self::solve), calling `observer` after every Newton iteration.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    pub fn solve_observed<B: Elastic>(
        &self,
        rod: &Rod<B>,
        mut observer: impl FnMut(&Iteration),
    ) -> Result<StaticSolution, Box<Failure>> {
        if let Err(error) = self.check() {
            let reason = Reason::Options(error);
            return Err(Box::new(Failure { reason, report: Report::default(), last: None }));
        }
        match self.order {
            Order::Two => self.solve_with::<B, 1>(rod, &mut observer),
            Order::Four => self.solve_with::<B, 2>(rod, &mut observer),
            Order::Six => self.solve_with::<B, 3>(rod, &mut observer),
        }
    }

    fn check(&self) -> Result<(), Error> {
        let invalid = |quantity, value, requirement| Err(Error::Invalid { quantity, value, requirement });
        if self.elements == 0 || self.elements > MAX_ELEMENTS {
            return invalid("number of elements", self.elements as f64, "from 1 to a million");
        }
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            return invalid("tolerance of the Newton step", self.tolerance, "positive and finite");
        }
        if self.max_iterations == 0 {
            return invalid("iteration limit", 0.0, "at least 1");
        }
        Ok(())
    }

    fn solve_with<B: Elastic, const S: usize>(
        &self,
        rod: &Rod<B>,
        observer: &mut dyn FnMut(&Iteration),
    ) -> Result<StaticSolution, Box<Failure>> {
        let start = Instant::now();
        let mut newton = Newton { max_iterations: self.max_iterations, tolerance: self.tolerance, observer };
        let coarse_mesh = Mesh::<B, S>::new(rod, self.elements.div_ceil(2));
        let at_rest = vec![[Strain::zero(); S]; coarse_mesh.elements];
        let coarse = newton.solve(&coarse_mesh, at_rest);
        let mut report =
            Report { iterations: coarse.iterations.clone(), residual: coarse.residual, ..Report::default() };
        if coarse.failure.is_some() {
            report.elapsed = start.elapsed();
            return Err(failed(&coarse_mesh, coarse, report));
        }
        let mesh = Mesh::<B, S>::new(rod, 2 * coarse_mesh.elements);
        let fine = newton.solve(&mesh, coarse_mesh.prolong(&coarse.strains, 2));
        report.iterations.extend(&fine.iterations);
        report.residual = fine.residual;
        if fine.failure.is_some() {
            report.elapsed = start.elapsed();
            return Err(failed(&mesh, fine, report));
        }
        if let (Some(coarse), Some(fine)) = (&coarse.state, &fine.state) {
            report.error = difference(coarse, fine, 2 * S as i32);
        }
        let Some(state) = &fine.state else {
            let reason = Reason::Singular {
                iteration: fine.iterations.len(),
                error: Error::Singular { matrix: "tangent of the rod", s: 0.0 },
            };
            return Err(Box::new(Failure { reason, report, last: None }));
        };
        let mut solution = describe(&mesh, &fine.strains, state, report);
        solution.report.elapsed = start.elapsed();
        Ok(solution)
    }
}

fn failed<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    outcome: Outcome<S>,
    report: Report,
) -> Box<Failure> {
    let last = outcome.state.as_ref().map(|state| describe(mesh, &outcome.strains, state, report.clone()));
    let reason = outcome.failure.unwrap_or(Reason::IterationLimit {
        limit: outcome.iterations.len(),
        step: f64::NAN,
        tolerance: f64::NAN,
    });
    Box::new(Failure { reason, report, last })
}

/// Richardson's estimate from the nodes both meshes have: a difference of (2^p − 1) errors of the finer one.
fn difference<const S: usize>(
    coarse: &Configuration<S>,
    fine: &Configuration<S>,
    order: i32,
) -> ErrorEstimate {
    let factor = 1.0 / (2.0_f64.powi(order) - 1.0);
    let mut error = ErrorEstimate::default();
    for (a, b) in coarse.node_pose.iter().zip(fine.node_pose.iter().step_by(2)) {
        let between = (a.inverse() * *b).log();
        error.position = error.position.max(factor * (a.position - b.position).norm());
        error.rotation = error.rotation.max(factor * between.angular.norm());
    }
    error
}

fn describe<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    strains: &StageStrains<S>,
    state: &Configuration<S>,
    report: Report,
) -> StaticSolution {
    let mut stages = Vec::with_capacity(S * mesh.elements);
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
    let nodes = (0..=mesh.elements)
        .map(|i| {
            let (element, tau) = if i < mesh.elements { (i, 0.0) } else { (i - 1, 1.0) };
            let weights = mesh.table.interpolation(tau);
            let mut guess = Strain::zero();
            for k in 0..S {
                guess += strains[element][k] * weights[k];
            }
            let (s, wrench) = (mesh.node_s(i), state.node_wrench[i]);
            let strain = strain_of_wrench(mesh.rod.body(), s, &wrench, guess);
            Node { s, pose: state.node_pose[i], strain, wrench }
        })
        .collect();
    let (strain_energy, load_potential) = mesh.energies(state);
    StaticSolution { nodes, stages, strain_energy, load_potential, report }
}

/// Solves Ψ(Δξ) = Λ at a node by Newton's method. Where that fails (a law without a unique inverse), the strain interpolated from
/// the stages stands.
fn strain_of_wrench<B: Elastic>(body: &B, s: f64, wrench: &Wrench, guess: Strain) -> Strain {
    let mut strain = guess;
    let mut previous = f64::INFINITY;
    for _ in 0..20 {
        let Ok(response) = body.respond(s, &strain, Request::Tangent) else { return guess };
        let residual = (*wrench - response.wrench).to_vector();
        let Some(step) = response.tangent.lu().solve(&residual) else { return guess };
        // a step relative to the strains of the rod: curvatures in units of 1/L
        let step = Strain::from_vector(&step);
        let size = step.linear.norm() + step.angular.norm() * body.length();
        strain += step;
        if size < 1e-14 || (size < 1e-9 && size > 0.5 * previous) {
            return strain;
        }
        previous = size;
    }
    guess
}
