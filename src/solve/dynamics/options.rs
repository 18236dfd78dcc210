use super::engine::{Engine, Run};
use super::failure::{Failure, Reason};
use super::frame::Frame;
use super::report::StepReport;
use super::scene::{Movable, Scene};
use super::scheme::Scheme;
use super::state::{Start, State};
use crate::error::Error;
use crate::solve::Order;

/// How long a step is.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Always the same, s; only the last is cut to end where it shall.
    Fixed(f64),
    /// As long as an error allows.
    Adaptive(Adaptive),
}

/// Choice of the step by its estimated error, and by whether Newton's method converges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive {
    /// The largest estimated error of a step; see [`StepReport::error`].
    pub tolerance: f64,
    /// The first step, s.
    pub first: f64,
    /// The least step, s: below it the run fails.
    pub least: f64,
    /// The largest step, s.
    pub largest: f64,
    /// How often a step may be rejected in a row.
    pub max_rejections: usize,
}

impl Default for Adaptive {
    /// Tolerance 1e-6, first step 1 ms, none below 1 ns, at most 12 rejections.
    fn default() -> Self {
        Self { tolerance: 1e-6, first: 1e-3, least: 1e-9, largest: f64::INFINITY, max_rejections: 12 }
    }
}

/// Moves a rod through time.
///
/// In space, the element of the statics in its variational form: the balance is the adjoint of the kinematics, so that without damping and with
/// loads that have a potential nothing gains energy. In time, a [`Scheme`].
///
/// ```
/// use hyperrod::load::Gravity;
/// use hyperrod::material::LinearElastic;
/// use hyperrod::section::{Circle, Section};
/// use hyperrod::solve::dynamics::{Dynamics, Scene, Start, Step};
/// use hyperrod::{Body, Pose, Rod};
/// use nalgebra::vector;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 5e5 / 3.0)?)?;
/// let body = Body::new(0.4, section)?.with_density(1000.0)?;
/// let rod = Rod::clamped(body, Pose::identity()).with_load(Gravity::new(vector![-9.81, 0.0, 0.0])?);
/// let scene = Scene::new(&rod); // straight at first, then it falls
///
/// let dynamics = Dynamics { step: Step::Fixed(5e-3), ..Dynamics::default() };
/// let mut energies = Vec::new();
/// let frame = dynamics.run(&scene, &Start::at_rest(), 0.1, |frame| energies.push(frame.energies.total()))?;
/// assert!((frame.tip().pose.position.x + 0.04514).abs() < 1e-4);
/// assert!(energies.iter().flatten().all(|e| (e - energies[0].unwrap()).abs() < 1e-5)); // J; nothing is damped
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics {
    /// How many elements of equal length.
    pub elements: usize,
    /// The order of the element.
    pub order: Order,
    /// The time scheme.
    pub scheme: Scheme,
    /// The step.
    pub step: Step,
    /// The error that Newton's method may leave in an instant, estimated: of rotations in rad, of displacements and curvatures in units of
    /// the length, of stretches.
    pub tolerance: f64,
    /// The largest number of Newton iterations for an instant.
    pub max_iterations: usize,
    /// The largest number of steps of a run.
    pub max_steps: usize,
    /// Whether the work of the loads is followed: see [`Energies::work`](super::Energies::work).
    pub track_work: bool,
    /// Whether energy and momenta keep the values they have at the start, by moving the velocities a little after every step: for an undamped
    /// rod with a free base on which nothing acts.
    pub conserve: bool,
}

impl Default for Dynamics {
    /// 6 elements of order 6, ESDIRK4(3) with steps of 10 ms, Newton's method to 1e-11 in at most 30 iterations.
    fn default() -> Self {
        Self {
            elements: 6,
            order: Order::Six,
            scheme: Scheme::Esdirk43,
            step: Step::Fixed(1e-2),
            tolerance: 1e-11,
            max_iterations: 30,
            max_steps: 10_000_000,
            track_work: false,
            conserve: false,
        }
    }
}

/// The most elements a mesh may have.
const MAX_ELEMENTS: usize = 100_000;

impl Dynamics {
    /// Runs from a start to a time, and describes the state there. The observer sees the first state and that after every step.
    ///
    /// # Errors
    /// A [`Failure`]: when, why, and the last good state.
    pub fn run<B: Movable>(
        &self,
        scene: &Scene<'_, B>,
        start: &Start,
        end: f64,
        mut observer: impl FnMut(&Frame),
    ) -> Result<Frame, Box<Failure>> {
        let mut stepper = self.start(scene, start)?;
        let mut frame = stepper.frame()?;
        observer(&frame);
        while !stepper.is_at(end) {
            stepper.step_toward(end)?;
            frame = stepper.frame()?;
            observer(&frame);
        }
        Ok(frame)
    }

    /// A stepper at a start.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn start<'s, B: Movable>(
        &self,
        scene: &'s Scene<'_, B>,
        start: &Start,
    ) -> Result<Stepper<'s>, Box<Failure>> {
        self.check(scene).map_err(|error| Failure::early(start.time, Reason::Options(error)))?;
        let engine: Box<dyn Engine + 's> = match self.order {
            Order::Two => Box::new(Run::<B, 1>::begin(self, scene, start)?),
            Order::Four => Box::new(Run::<B, 2>::begin(self, scene, start)?),
            Order::Six => Box::new(Run::<B, 3>::begin(self, scene, start)?),
        };
        Ok(Stepper { engine, steps: 0, max_steps: self.max_steps })
    }

    /// A stepper at a saved state. With the same options and scene it goes on with the same bits.
    ///
    /// # Errors
    /// As [`run`](Self::run), and for a state of another mesh.
    pub fn resume<'s, B: Movable>(
        &self,
        scene: &'s Scene<'_, B>,
        state: &State,
    ) -> Result<Stepper<'s>, Box<Failure>> {
        self.check(scene).map_err(|error| Failure::early(state.time, Reason::Options(error)))?;
        let engine: Box<dyn Engine + 's> = match self.order {
            Order::Two => Box::new(Run::<B, 1>::resume(self, scene, state)?),
            Order::Four => Box::new(Run::<B, 2>::resume(self, scene, state)?),
            Order::Six => Box::new(Run::<B, 3>::resume(self, scene, state)?),
        };
        Ok(Stepper { engine, steps: 0, max_steps: self.max_steps })
    }

    pub(super) fn first_step(&self) -> f64 {
        match self.step {
            Step::Fixed(dt) => dt,
            Step::Adaptive(options) => options.first,
        }
    }

    fn check<B: Movable>(&self, scene: &Scene<'_, B>) -> Result<(), Error> {
        let invalid = |quantity, value, requirement| Err(Error::Invalid { quantity, value, requirement });
        if self.elements == 0 || self.elements > MAX_ELEMENTS {
            return invalid("number of elements", self.elements as f64, "from 1 to a hundred thousand");
        }
        let mut positive = vec![
            ("tolerance of Newton's method", self.tolerance),
            ("time step", self.first_step()),
            ("iteration limit", self.max_iterations as f64),
            ("step limit", self.max_steps as f64),
        ];
        if let Step::Adaptive(options) = self.step {
            positive.push(("tolerance of a step", options.tolerance));
            positive.push(("limit of rejections", options.max_rejections as f64));
            positive.push(("least time step", options.least));
            positive.push(("largest time step", options.largest.min(f64::MAX)));
        }
        if let Some(&(quantity, value)) = positive.iter().find(|(_, v)| !(*v > 0.0 && v.is_finite())) {
            return invalid(quantity, value, "positive and finite");
        }
        if let Scheme::GeneralisedAlpha { rho } = self.scheme
            && !(0.0..=1.0).contains(&rho)
        {
            return invalid("rho at infinity", rho, "from 0 to 1");
        }
        if let Scheme::GeneralisedAlpha { rho } = self.scheme
            && rho == 1.0
            && scene.is_constrained()
        {
            let requirement = "below 1 where supports hold the tip or a place between, or strains are fixed";
            return invalid("rho at infinity", rho, requirement);
        }
        if self.conserve && !scene.is_alone() {
            return invalid(
                "conservation asked for",
                1.0,
                "of a rod that flies freely, without loads and damping",
            );
        }
        Ok(())
    }
}

/// A rod on its way through time, step by step.
///
/// ```
/// use hyperrod::section::{Circle, Section};
/// use hyperrod::material::LinearElastic;
/// use hyperrod::load::Gravity;
/// use hyperrod::solve::dynamics::{Dynamics, Scene, Start};
/// use hyperrod::{Body, Pose, Rod};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 2e5)?)?;
/// # let rod = Rod::clamped(Body::new(0.4, section)?.with_density(1000.0)?, Pose::identity()).with_load(Gravity::standard());
/// let scene = Scene::new(&rod);
/// let mut stepper = Dynamics::default().start(&scene, &Start::at_rest())?;
/// stepper.step()?;
/// let saved = stepper.state();
/// stepper.step()?;
/// // the same step once more, from the saved state: the same bits
/// let mut again = Dynamics::default().resume(&scene, &saved)?;
/// again.step()?;
/// assert_eq!(again.state(), stepper.state());
/// # Ok(()) }
/// ```
pub struct Stepper<'s> {
    engine: Box<dyn Engine + 's>,
    steps: usize,
    max_steps: usize,
}

impl Stepper<'_> {
    /// Makes a step.
    ///
    /// # Errors
    /// A [`Failure`]; the stepper is then where it was.
    pub fn step(&mut self) -> Result<StepReport, Box<Failure>> {
        self.step_toward(f64::INFINITY)
    }

    /// Makes a step that does not lead past a time.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_toward(&mut self, end: f64) -> Result<StepReport, Box<Failure>> {
        let time = self.time();
        if !(end > time) {
            let quantity = "time to step toward";
            let error = Error::Invalid { quantity, value: end, requirement: "later than the present" };
            return Err(self.failure(Reason::Options(error)));
        }
        if self.steps == self.max_steps {
            return Err(self.failure(Reason::StepLimit { limit: self.max_steps }));
        }
        let report = self.engine.advance(end)?;
        self.steps += 1;
        Ok(report)
    }

    /// Makes steps until a time.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn run_to(&mut self, end: f64) -> Result<(), Box<Failure>> {
        while !self.is_at(end) {
            self.step_toward(end)?;
        }
        Ok(())
    }

    /// The time, s.
    pub fn time(&self) -> f64 {
        self.engine.time()
    }

    /// Whether that time is reached, but for rounding.
    pub fn is_at(&self, end: f64) -> bool {
        !(end - self.time() > 1e-12 * end.abs().max(self.time().abs()))
    }

    /// The present state, described.
    ///
    /// # Errors
    /// Where a load is not defined.
    pub fn frame(&mut self) -> Result<Frame, Box<Failure>> {
        self.engine.frame()
    }

    /// The present state, to save.
    pub fn state(&self) -> State {
        self.engine.save()
    }

    fn failure(&mut self, reason: Reason) -> Box<Failure> {
        let (time, last) = (self.time(), Some(Box::new(self.state())));
        let frame = self.frame().ok().map(Box::new);
        Box::new(Failure { time, reason, last, frame })
    }
}

impl std::fmt::Debug for Stepper<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stepper").field("time", &self.time()).field("steps", &self.steps).finish()
    }
}
