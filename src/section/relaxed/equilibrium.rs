//! The displacement that makes the energy of a section smallest at a given strain, by Newton's method.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SymmetricEigen};

use super::assembly::{Curvatures, Displaced, Frame, Slopes};
use super::modes::Modes;
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::material::{GradientState, Local, Request, Station};

/// Newton iterations at one strain; an energy that has a minimum within reach takes three to ten.
const ITERATIONS: usize = 40;

/// Halvings of a Newton step, to 1e-9 of it.
const HALVINGS: usize = 30;

/// The size of a correction, relative to displacement gradients and strains, below which it is the last: what it leaves out of the tangent
/// is as large, what it leaves out of energy and wrench the square of it.
const LAST: f64 = 1e-9;

/// Strain steps on the way to a strain that cannot be reached at once, and the smallest of them.
const STEPS: usize = 400;
const SMALLEST_STEP: f64 = 1.0 / 1024.0;

/// A section in equilibrium at a strain.
pub(super) struct Equilibrium {
    /// The modes' amplitudes.
    pub(super) q: DVector<f64>,
    /// The last correction, already part of `q`.
    pub(super) correction: DVector<f64>,
    pub(super) slopes: Slopes,
    pub(super) curvatures: Curvatures,
    /// Of U_qq.
    pub(super) factor: Option<Cholesky<f64, Dyn>>,
    /// Modes × strain: U_qξ.
    pub(super) mixed: DMatrix<f64>,
    pub(super) iterations: usize,
    /// The amplitudes that slopes and curvatures belong to.
    pub(super) evaluated_at: DVector<f64>,
}

impl Equilibrium {
    /// ∂q/∂Δξ = −U_qq⁻¹ U_qξ.
    pub(super) fn sensitivity(&self) -> DMatrix<f64> {
        match &self.factor {
            Some(factor) => -factor.solve(&self.mixed),
            None => self.mixed.clone(),
        }
    }
}

/// What equilibrium is sought for.
pub(super) struct Problem<'a, M> {
    pub(super) modes: &'a Modes,
    pub(super) law: &'a M,
    pub(super) at: &'a Station,
}

/// Where one strain's search ended, if not in an equilibrium.
enum Miss {
    /// No admissible start, or no convergence: smaller steps may help.
    Step(Error),
    /// An equilibrium that is no minimum.
    Unstable(Error),
}

impl<M: Local> Problem<'_, M> {
    /// From a start, or from rest: at once, or else along the straight way from rest, with the tangent as predictor.
    ///
    /// # Errors
    /// If a point is inadmissible whatever the step, Newton's method does not converge, or the equilibrium is unstable.
    pub(super) fn solve(&self, strain: &Strain, start: &DVector<f64>) -> Result<Equilibrium> {
        match self.newton(strain, start) {
            Ok(found) => Ok(found),
            Err(Miss::Unstable(error)) => Err(error),
            Err(Miss::Step(_)) => self.along(strain),
        }
    }

    fn along(&self, strain: &Strain) -> Result<Equilibrium> {
        let rest = DVector::zeros(self.modes.len());
        let mut state = self.newton(&Strain::zero(), &rest).map_err(Miss::error)?;
        let whole = DVector::from_column_slice(&strain.to_array());
        let (mut reached, mut step) = (0.0_f64, 0.5_f64);
        let mut iterations = state.iterations;
        let mut last = None;
        for _ in 0..STEPS {
            let next: f64 = (reached + step).min(1.0);
            let start = &state.q + state.sensitivity() * &whole * (next - reached);
            match self.newton(&(*strain * next), &start) {
                Ok(found) => {
                    iterations += found.iterations;
                    state = Equilibrium { iterations, ..found };
                    if next == 1.0 {
                        return Ok(state);
                    }
                    (reached, step) = (next, (2.0 * step).min(0.5));
                }
                Err(miss) if step > SMALLEST_STEP => {
                    last = Some(miss);
                    step *= 0.5;
                }
                Err(miss) => return Err(miss.error()),
            }
        }
        let what = "relaxation of a section, going to the strain by small steps";
        let fallen = Error::NoConvergence { what, iterations: STEPS, residual: step };
        Err(last.map_or(fallen, Miss::error))
    }

    fn newton(&self, strain: &Strain, start: &DVector<f64>) -> Result<Equilibrium, Miss> {
        let frame = Frame::new(self.modes, self.at, strain);
        let mut state = GradientState::default();
        let mut q = start.clone();
        let full = self.modes.expand(&q);
        let mut displaced = Displaced::new(self.modes, &frame, &full);
        self.evaluate(&displaced, Request::Tangent, &mut state).map_err(Miss::Step)?;
        let mut correction = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            let slopes = displaced.slopes(&state);
            let curvatures = displaced.curvatures(&state);
            let gradient = self.column(&slopes.coefficients);
            let hessian = self.square(&curvatures.coefficients);
            let mixed = self.modes.reduce(&curvatures.mixed);
            if q.is_empty() {
                let (correction, evaluated_at) = (q.clone(), q.clone());
                let factor = None;
                return Ok(Equilibrium {
                    q,
                    correction,
                    slopes,
                    curvatures,
                    factor,
                    mixed,
                    iterations: 0,
                    evaluated_at,
                });
            }
            let (factor, shifted) = factorise(&hessian).ok_or_else(|| {
                Miss::Step(Error::Singular { matrix: "Hessian of the section's displacement", s: self.at.s })
            })?;
            let step = -factor.solve(&gradient);
            let size = q.norm() + self.size(strain);
            correction = step.norm();
            if correction <= LAST * size {
                if shifted {
                    return Err(Miss::Unstable(self.unstable(&hessian)));
                }
                let evaluated_at = q.clone();
                q += &step;
                return Ok(Equilibrium {
                    q,
                    correction: step,
                    slopes,
                    curvatures,
                    factor: Some(factor),
                    mixed,
                    iterations: iteration + 1,
                    evaluated_at,
                });
            }
            let slope = gradient.dot(&step);
            let energy = slopes.energy;
            (q, displaced) =
                self.search(&frame, &q, &step, (energy, slope), &mut state).map_err(Miss::Step)?;
        }
        let what = "relaxation of a section";
        Err(Miss::Step(Error::NoConvergence { what, iterations: ITERATIONS, residual: correction }))
    }

    /// The longest of the step, half of it, … that lowers the energy; the law is evaluated there.
    fn search<'f>(
        &'f self,
        frame: &'f Frame,
        q: &DVector<f64>,
        step: &DVector<f64>,
        (energy, slope): (f64, f64),
        state: &mut GradientState,
    ) -> Result<(DVector<f64>, Displaced<'f>)> {
        /// The part of the decrease promised by the slope that must come true.
        const ARMIJO: f64 = 1e-4;
        let rounding = 64.0 * f64::EPSILON * energy.abs();
        let mut fraction = 1.0;
        let mut refused = None;
        for _ in 0..HALVINGS {
            let trial = q + step * fraction;
            let displaced = Displaced::new(self.modes, frame, &self.modes.expand(&trial));
            match self.evaluate(&displaced, Request::Tangent, state) {
                Ok(()) => {
                    let lower = energy + ARMIJO * fraction * slope + rounding;
                    if displaced.energy(state) <= lower {
                        return Ok((trial, displaced));
                    }
                }
                Err(error) => refused = Some(error),
            }
            fraction *= 0.5;
        }
        let what = "line search of a section's relaxation";
        Err(refused.unwrap_or(Error::NoConvergence {
            what,
            iterations: HALVINGS,
            residual: step.norm() * fraction,
        }))
    }

    /// Evaluates the law, or says where it cannot be.
    pub(super) fn evaluate(
        &self,
        displaced: &Displaced<'_>,
        request: Request,
        state: &mut GradientState,
    ) -> Result<()> {
        let smallest = displaced.evaluate(self.law, self.at.s, request, state);
        if smallest > 0.0 && displaced.energy(state).is_finite() && displaced.h.iter().all(|h| h.is_finite())
        {
            return Ok(());
        }
        Err(self.inadmissible(displaced, state))
    }

    #[cold]
    fn inadmissible(&self, displaced: &Displaced<'_>, state: &GradientState) -> Error {
        let points = &self.modes.points;
        let n = points.len();
        let s = self.at.s;
        for q in 0..n {
            let (x, y) = (points.x[q], points.y[q]);
            let f = nalgebra::Matrix3::from_fn(|i, k| {
                displaced.h[(3 * i + k) * n + q] + if i == k { 1.0 } else { 0.0 }
            });
            let j = f.determinant();
            if !(j > 0.0) {
                return Error::Inadmissible { quantity: "J", value: j, requirement: "positive", s, x, y };
            }
            if !state.energy[q].is_finite() {
                let (quantity, requirement) = ("energy density", self.law.domain());
                return Error::Inadmissible { quantity, value: state.energy[q], requirement, s, x, y };
            }
        }
        let requirement = "finite: the displacement of the section is out of range";
        Error::InvalidAt { quantity: "energy of the section", value: f64::NAN, requirement, s }
    }

    /// The size of a strain as a number: curvatures times the radius of gyration.
    fn size(&self, strain: &Strain) -> f64 {
        let points = &self.modes.points;
        let (mut area, mut inertia) = (0.0, 0.0);
        for q in 0..points.len() {
            area += points.weight[q];
            inertia += points.weight[q] * (points.x[q].powi(2) + points.y[q].powi(2));
        }
        strain.angular.norm() * (inertia / area).sqrt() + strain.linear.norm()
    }

    fn column(&self, full: &DVector<f64>) -> DVector<f64> {
        let full = DMatrix::from_column_slice(full.len(), 1, full.as_slice());
        self.modes.reduce(&full).column(0).into_owned()
    }

    /// A symmetric matrix over the coefficients made one over the modes.
    fn square(&self, full: &DMatrix<f64>) -> DMatrix<f64> {
        let rows = self.modes.reduce(full);
        self.modes.reduce(&rows.transpose())
    }

    /// Names the direction in which the energy has no minimum.
    #[cold]
    fn unstable(&self, hessian: &DMatrix<f64>) -> Error {
        let eigen = SymmetricEigen::new(hessian.clone());
        let smallest = eigen.eigenvalues.imin();
        let largest = eigen.eigenvalues.amax();
        let direction = eigen.eigenvectors.column(smallest).into_owned();
        Error::SectionUnstable {
            mode: self.modes.describe(&direction),
            eigenvalue: eigen.eigenvalues[smallest] / largest,
            s: self.at.s,
        }
    }
}

impl Miss {
    fn error(self) -> Error {
        match self {
            Self::Step(error) | Self::Unstable(error) => error,
        }
    }
}

/// The Cholesky factor of a Hessian, shifted by as much as makes it positive definite, and whether it had to be.
fn factorise(hessian: &DMatrix<f64>) -> Option<(Cholesky<f64, Dyn>, bool)> {
    /// Shifts tried, from 1e-4 of the largest diagonal entry, each four times the one before.
    const SHIFTS: usize = 20;
    if let Some(factor) = hessian.clone().cholesky() {
        return Some((factor, false));
    }
    let mut shift = 1e-4 * hessian.diagonal().amax();
    for _ in 0..SHIFTS {
        let mut moved = hessian.clone();
        for i in 0..moved.nrows() {
            moved[(i, i)] += shift;
        }
        if let Some(factor) = moved.cholesky() {
            return Some((factor, true));
        }
        shift *= 4.0;
    }
    None
}
