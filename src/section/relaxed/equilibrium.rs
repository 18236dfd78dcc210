//! The displacement that makes the energy of a section smallest at a given strain, by Newton's method.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::assembly::{Curvatures, Displaced, Frame, Slopes};
use super::modes::Modes;
use super::pressure;
use super::system::{System, augmented};
use crate::error::{Error, Result};
use crate::lie::Strain;
use crate::material::{GradientLaw, GradientState, Request, Station};

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
    /// The modes' amplitudes, and the pressures if there are any.
    pub(super) q: DVector<f64>,
    /// The last correction, already part of `q`.
    pub(super) correction: DVector<f64>,
    /// What the last correction does to the energy, ½ U_q·δq.
    pub(super) lowered: f64,
    pub(super) slopes: Slopes,
    pub(super) curvatures: Curvatures,
    /// Of U_qq, or with pressures that of the Lagrangian; `None` without modes.
    pub(super) system: Option<System>,
    /// Unknowns × strain: U_qξ.
    pub(super) mixed: DMatrix<f64>,
    pub(super) iterations: usize,
    /// The amplitudes that slopes and curvatures belong to.
    pub(super) evaluated_at: DVector<f64>,
}

impl Equilibrium {
    /// ∂q/∂Δξ = −U_qq⁻¹ U_qξ.
    pub(super) fn sensitivity(&self) -> DMatrix<f64> {
        match &self.system {
            Some(system) => -system.solve(&self.mixed),
            None => self.mixed.clone(),
        }
    }
}

/// All derivatives at one state of the search.
struct Derivatives {
    slopes: Slopes,
    curvatures: Curvatures,
    gradient: DVector<f64>,
    hessian: DMatrix<f64>,
    mixed: DMatrix<f64>,
    /// ∂(conditions on the volume)/∂(amplitudes).
    volume: Option<DMatrix<f64>>,
}

impl Derivatives {
    fn into_equilibrium(
        self,
        evaluated_at: DVector<f64>,
        correction: DVector<f64>,
        system: Option<System>,
        iterations: usize,
    ) -> Equilibrium {
        let Self { slopes, curvatures, gradient, mixed, .. } = self;
        let q = &evaluated_at + &correction;
        let lowered = 0.5 * gradient.dot(&correction);
        Equilibrium { q, correction, lowered, slopes, curvatures, system, mixed, iterations, evaluated_at }
    }
}

/// What equilibrium is sought for.
pub(super) struct Problem<'a> {
    pub(super) modes: &'a Modes,
    pub(super) law: &'a dyn GradientLaw,
    pub(super) at: &'a Station,
    /// How many pressures keep the volume; 0 for a compressible law.
    pub(super) pressures: usize,
}

/// Where one strain's search ended, if not in an equilibrium.
enum Miss {
    /// No admissible start, or no convergence: smaller steps may help.
    Step(Error),
    /// An equilibrium that is no minimum.
    Unstable(Error),
    /// A reference that no strain changes.
    Reference(Error),
}

impl Problem<'_> {
    /// From a start, or from rest: at once, or else along the straight way from rest, with the tangent as predictor.
    ///
    /// # Errors
    /// If a point is inadmissible whatever the step, Newton's method does not converge, or the equilibrium is unstable.
    pub(super) fn solve(&self, strain: &Strain, start: &DVector<f64>) -> Result<Equilibrium> {
        match self.newton(strain, start) {
            Ok(found) => Ok(found),
            Err(Miss::Reference(error)) => Err(error),
            // a saddle met by one leap may not be on the way from rest
            Err(Miss::Step(_) | Miss::Unstable(_)) => self.along(strain),
        }
    }

    /// Amplitudes and pressures.
    pub(super) fn unknowns(&self) -> usize {
        self.modes.len() + self.pressures
    }

    fn along(&self, strain: &Strain) -> Result<Equilibrium> {
        let rest = DVector::zeros(self.unknowns());
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
        let frame = Frame::new(self.modes, self.at, strain).map_err(Miss::Reference)?;
        let mut state = GradientState::default();
        let (mut q, mut displaced) = self.begin(&frame, start, &mut state).map_err(Miss::Step)?;
        let mut step = DVector::from_element(q.len(), f64::INFINITY);
        for iteration in 0..ITERATIONS {
            let derivatives = self.derivatives(&displaced, &q, &state);
            if q.is_empty() {
                return Ok(derivatives.into_equilibrium(q.clone(), q, None, 0));
            }
            let singular = Error::Singular { matrix: "Hessian of the section's displacement", s: self.at.s };
            let system = System::new(&derivatives.hessian, derivatives.volume.as_ref());
            let system = system.ok_or(Miss::Step(singular))?;
            step = -system.solve_one(&derivatives.gradient);
            let n = self.modes.len();
            let size = q.rows(0, n).norm() + self.size(strain);
            if step.rows(0, n).norm() <= LAST * size {
                if system.shifted {
                    return Err(Miss::Unstable(self.unstable(&derivatives)));
                }
                return Ok(derivatives.into_equilibrium(q, step, Some(system), iteration + 1));
            }
            (q, displaced) = self.search(&frame, &q, &step, &derivatives, &mut state).map_err(Miss::Step)?;
        }
        let what = "relaxation of a section";
        Err(Miss::Step(Error::NoConvergence { what, iterations: ITERATIONS, residual: step.norm() }))
    }

    /// The start, or as much of it as is admissible.
    fn begin<'f>(
        &'f self,
        frame: &'f Frame,
        start: &DVector<f64>,
        state: &mut GradientState,
    ) -> Result<(DVector<f64>, Displaced<'f>)> {
        let mut refused = None;
        for fraction in [1.0, 0.75, 0.5, 0.25, 0.0] {
            let q = start * fraction;
            let displaced = Displaced::new(self.modes, frame, &self.modes.expand(&q));
            match self.evaluate(&displaced, &q, Request::Tangent, state) {
                Ok(()) => return Ok((q, displaced)),
                Err(error) => refused = Some(error),
            }
        }
        let what = "start of a section's relaxation";
        Err(refused.unwrap_or(Error::NoConvergence { what, iterations: 0, residual: 0.0 }))
    }

    fn derivatives(&self, displaced: &Displaced<'_>, q: &DVector<f64>, state: &GradientState) -> Derivatives {
        let mut slopes = displaced.slopes(state);
        let curvatures = displaced.curvatures(state);
        let (n, m) = (self.modes.len(), self.pressures);
        let mut gradient = DVector::zeros(n + m);
        gradient.rows_mut(0, n).copy_from(&self.column(&slopes.coefficients));
        let mut mixed = DMatrix::zeros(n + m, 6);
        mixed.rows_mut(0, n).copy_from(&self.modes.reduce(&curvatures.mixed));
        let hessian = self.square(&curvatures.coefficients);
        let mut volume = None;
        if m > 0 {
            let conditions = pressure::conditions(displaced, m);
            gradient.rows_mut(n, m).copy_from(&-&conditions.values);
            mixed.rows_mut(n, m).copy_from(&-&conditions.strain);
            slopes.energy -= q.rows(n, m).dot(&conditions.values);
            volume = Some(self.modes.reduce(&conditions.coefficients.transpose()).transpose());
        }
        Derivatives { slopes, curvatures, gradient, hessian, mixed, volume }
    }

    /// The longest of the step, half of it, … that lowers the energy (with pressures, that is admissible); the law is
    /// evaluated there.
    fn search<'f>(
        &'f self,
        frame: &'f Frame,
        q: &DVector<f64>,
        step: &DVector<f64>,
        derivatives: &Derivatives,
        state: &mut GradientState,
    ) -> Result<(DVector<f64>, Displaced<'f>)> {
        /// The part of the decrease promised by the slope that must come true.
        const ARMIJO: f64 = 1e-4;
        let energy = derivatives.slopes.energy;
        let slope = derivatives.gradient.dot(step);
        let rounding = 64.0 * f64::EPSILON * energy.abs();
        let mut fraction = 1.0;
        let mut refused = None;
        for _ in 0..HALVINGS {
            let trial = q + step * fraction;
            let displaced = Displaced::new(self.modes, frame, &self.modes.expand(&trial));
            match self.evaluate(&displaced, &trial, Request::Tangent, state) {
                // a saddle has no energy to lower: full steps, and smaller strain steps where they do not converge
                Ok(()) if self.pressures > 0 => return Ok((trial, displaced)),
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
        let residual = step.norm() * fraction;
        Err(refused.unwrap_or(Error::NoConvergence { what, iterations: HALVINGS, residual }))
    }

    /// Evaluates the law, or says where it cannot be.
    pub(super) fn evaluate(
        &self,
        displaced: &Displaced<'_>,
        q: &DVector<f64>,
        request: Request,
        state: &mut GradientState,
    ) -> Result<()> {
        let smallest = displaced.evaluate(self.law, self.at.s, request, state);
        if smallest > 0.0 && displaced.energy(state).is_finite() && displaced.h.iter().all(|h| h.is_finite())
        {
            if self.pressures > 0 {
                let pressures = &q.as_slice()[self.modes.len()..];
                pressure::press(displaced, pressures, request, state);
            }
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
    fn unstable(&self, derivatives: &Derivatives) -> Error {
        let hessian = match &derivatives.volume {
            Some(b) => augmented(&derivatives.hessian, b).0,
            None => derivatives.hessian.clone(),
        };
        let eigen = SymmetricEigen::new(hessian);
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
            Self::Step(error) | Self::Unstable(error) | Self::Reference(error) => error,
        }
    }
}
