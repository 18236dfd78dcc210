use std::time::Instant;

use super::cascade::Cascade;
use super::failure::Failure;
use super::linear::Buffers;
use super::newton::{Newton, Stop};
use super::path::{Buckling, EquilibriumPath, PathOptions, Walker};
use super::report::Iteration;
use super::solution::StaticSolution;
use super::workspace::Workspace;
use crate::body::Elastic;
use crate::error::Error;
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

/// Solves static equilibrium by Newton's method with the exact tangent: to an accuracy, or on a mesh.
///
/// [`Statics::to`] is given an error. It starts from a coarse mesh and cuts elements where the defect of the strong form is large, until
/// the estimated error is below the one asked for. On a mesh of a given number of elements, the default, it solves half as many first:
/// that gives the start for the mesh asked for, and the difference of both, divided by 2^order − 1, the error estimate.
///
/// ```
/// use hyperrod::{Body, Pose, Rod, Statics, load::DeadWrench, section::Stiffness};
/// use nalgebra::vector;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
/// let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(vector![1.0, 0.0, 0.0])?);
///
/// let solution = Statics::to(1e-8).solve(&rod)?;
/// let tip = solution.tip().pose.position; // bends towards +x
/// assert!((tip.x - 0.3018).abs() < 1e-4 && solution.report().error.position < 1e-8);
///
/// let on_a_mesh = Statics { elements: 32, ..Statics::default() }.solve(&rod)?;
/// assert!((on_a_mesh.tip().pose.position - tip).norm() < 1e-6);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statics {
    /// The largest error allowed of positions / L, of rotations, and of wrenches relative to the largest
    /// ([`ErrorEstimate::relative`](super::ErrorEstimate::relative)); the solver then chooses mesh and Newton's tolerance. `None` for the mesh below.
    pub accuracy: Option<f64>,
    /// How many elements of equal length; rounded up to an even number. Of no effect where an accuracy is asked for.
    pub elements: usize,
    /// The order of the element.
    pub order: Order,
    /// Newton's method stops after a full step smaller than this (the error left is then of the size of its square). See
    /// [`Iteration::step`] for how a step is measured. Of no effect where an accuracy is asked for.
    pub tolerance: f64,
    /// The largest number of Newton iterations on a mesh.
    pub max_iterations: usize,
    /// Whether an equilibrium that would not stay, as a column straight beyond its critical load, is an answer. If not, the solver goes on to a stable
    /// one; [`Report::stability`](super::Report::stability) says what the answer is.
    pub accept_unstable: bool,
}

impl Default for Statics {
    /// 16 elements of order 4, tolerance 1e-9, at most 50 iterations.
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The most elements a mesh may have.
const MAX_ELEMENTS: usize = 1_000_000;

/// What a walk along a path of equilibria finds by one of its methods, with elements of the order asked for.
macro_rules! walk {
    ($statics:ident, $rod:ident, $options:ident, $method:ident) => {{
        $statics.options_are_sound()?;
        let mut workspace = Workspace::default();
        match $statics.order {
            Order::Two => Walker::new($rod, $statics.elements, workspace.one(), $options).$method(),
            Order::Four => Walker::new($rod, $statics.elements, workspace.two(), $options).$method(),
            Order::Six => Walker::new($rod, $statics.elements, workspace.three(), $options).$method(),
        }
    }};
}

impl Statics {
    /// The [default](Self::default) options, for constants.
    pub const DEFAULT: Self = Self {
        accuracy: None,
        elements: 16,
        order: Order::Four,
        tolerance: 1e-9,
        max_iterations: 50,
        accept_unstable: false,
    };

    /// To an accuracy, on a mesh of the solver's choice, with elements of order 6: they are the fastest at every accuracy from 1e-4 on.
    ///
    /// The error is that of the discretisation: a section whose quadrature is not exact adds its own (see
    /// [`Section::with_tolerance`](crate::section::Section::with_tolerance)).
    pub fn to(accuracy: f64) -> Self {
        Self { accuracy: Some(accuracy), order: Order::Six, ..Self::default() }
    }

    /// Solves the rod from its reference shape.
    ///
    /// # Errors
    /// A [`Failure`]: why, the history, and the last admissible state.
    pub fn solve<B: Elastic>(&self, rod: &Rod<B>) -> Result<StaticSolution, Box<Failure>> {
        self.solve_observed(rod, |_| ())
    }

    /// As [`solve`](Self::solve), from the shape of an earlier solution of a rod of the same length: a sweep of a tension, a pressure or a load stays on
    /// its branch as far as that goes. Where Newton's method fails from there, the solve goes on from the reference shape.
    ///
    /// A strut held 5 % too close buckles to the side it is pushed to, and stays there when the push is gone:
    ///
    /// ```
    /// use hyperrod::rod::Support;
    /// use hyperrod::{Body, Pose, Rod, Statics, load::DeadLoad, section::Stiffness, Wrench};
    /// use nalgebra::{Isometry3, Vector3, vector};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let strut = |push: f64| -> hyperrod::Result<_> {
    ///     let body = Body::new(1.0, Stiffness::diagonal([4.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
    ///     let nearer = Pose::from(Isometry3::translation(0.0, 0.0, 0.95));
    ///     let push = DeadLoad::new(Wrench::new(Vector3::zeros(), vector![push, 0.0, 0.0]))?;
    ///     Ok(Rod::between(body, Support::clamped(Pose::identity()), Support::clamped(nearer)).with_load(push))
    /// };
    /// for side in [1.0, -1.0] {
    ///     let pushed = Statics::default().solve(&strut(50.0 * side)?)?;
    ///     let left = Statics::default().solve_from(&strut(0.0)?, &pushed)?;
    ///     assert!(side * left.nodes()[left.nodes().len() / 2].pose.position.x > 0.1);
    /// }
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`solve`](Self::solve), and if the earlier rod had another length.
    pub fn solve_from<B: Elastic>(
        &self,
        rod: &Rod<B>,
        earlier: &StaticSolution,
    ) -> Result<StaticSolution, Box<Failure>> {
        let (before, length) = (earlier.tip().s, rod.body().length());
        if (before - length).abs() > 1e-9 * length {
            let quantity = "length of the rod of the earlier solution";
            let error = Error::Invalid { quantity, value: before, requirement: "that of the rod" };
            return Err(Failure::of_options(error));
        }
        self.run(&mut Workspace::default(), rod, Some(earlier), &mut |_| ())
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
        self.run(&mut Workspace::default(), rod, None, &mut observer)
    }

    /// As [`solve`](Self::solve), in memory that is kept from one solve to the next.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    pub fn solve_in<B: Elastic>(
        &self,
        workspace: &mut Workspace,
        rod: &Rod<B>,
    ) -> Result<StaticSolution, Box<Failure>> {
        self.run(workspace, rod, None, &mut |_| ())
    }

    /// Follows the equilibria of the rod from rest as its loads, and the displacements that its supports hold, grow with the load factor: by arc length,
    /// through limit points and past bifurcations, on a mesh of [`elements`](Self::elements).
    ///
    /// # Errors
    /// A [`Failure`] where the walk cannot begin. A walk that gets stuck later is an answer: see [`EquilibriumPath::end`].
    pub fn trace<B: Elastic>(
        &self,
        rod: &Rod<B>,
        options: &PathOptions,
    ) -> Result<EquilibriumPath, Box<Failure>> {
        walk!(self, rod, options, path)
    }

    /// The path that leaves the first bifurcation, along the mode that becomes unstable there; `None` where there is none up to the largest
    /// factor of the options. Options as for [`trace`](Self::trace).
    ///
    /// # Errors
    /// As [`trace`](Self::trace), and where no point of the branch is found.
    pub fn trace_buckled<B: Elastic>(
        &self,
        rod: &Rod<B>,
        options: &PathOptions,
    ) -> Result<Option<EquilibriumPath>, Box<Failure>> {
        walk!(self, rod, options, buckled_path)
    }

    /// The first load at which the rod loses its stability, on the path from rest, with the modes; `None` where it keeps it up to the largest factor
    /// of the options.
    ///
    /// ```
    /// use hyperrod::load::DeadWrench;
    /// use hyperrod::solve::PathOptions;
    /// use hyperrod::{Body, Pose, Rod, Statics, section::Stiffness};
    /// use nalgebra::vector;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let body = Body::new(1.0, Stiffness::diagonal([1.0, 4.0, 0.8, 1e6, 1e6, 1e6])?)?;
    /// let push = DeadWrench::force(vector![0.0, 0.0, -1.0])?;
    /// let column = Rod::clamped(body, Pose::identity()).with_tip_load(push);
    /// let up_to = PathOptions { factors: [0.0, 10.0], ..PathOptions::default() };
    /// let buckling = Statics::default().buckling(&column, &up_to)?.ok_or("it does not buckle")?;
    /// let euler = std::f64::consts::PI.powi(2) / 4.0;
    /// assert!((buckling.critical.load_factor / euler - 1.0).abs() < 1e-5);
    /// assert!(buckling.modes[0].last().unwrap().linear.y.abs() > 0.5); // about x, the soft axis
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`trace`](Self::trace).
    pub fn buckling<B: Elastic>(
        &self,
        rod: &Rod<B>,
        options: &PathOptions,
    ) -> Result<Option<Buckling>, Box<Failure>> {
        walk!(self, rod, options, buckling)
    }

    fn options_are_sound(&self) -> Result<(), Box<Failure>> {
        self.check().map_err(Failure::of_options)
    }

    fn run<B: Elastic>(
        &self,
        workspace: &mut Workspace,
        rod: &Rod<B>,
        earlier: Option<&StaticSolution>,
        observer: &mut dyn FnMut(&Iteration),
    ) -> Result<StaticSolution, Box<Failure>> {
        self.options_are_sound()?;
        match self.order {
            Order::Two => self.solve_on(workspace.one(), rod, earlier, observer),
            Order::Four => self.solve_on(workspace.two(), rod, earlier, observer),
            Order::Six => self.solve_on(workspace.three(), rod, earlier, observer),
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
        if let Some(accuracy) = self.accuracy.filter(|&a| !(a > 0.0 && a.is_finite())) {
            return invalid("accuracy asked for", accuracy, "positive and finite");
        }
        if self.max_iterations == 0 {
            return invalid("iteration limit", 0.0, "at least 1");
        }
        Ok(())
    }

    fn solve_on<B: Elastic, const S: usize>(
        &self,
        buffers: &mut Buffers<S>,
        rod: &Rod<B>,
        earlier: Option<&StaticSolution>,
        observer: &mut dyn FnMut(&Iteration),
    ) -> Result<StaticSolution, Box<Failure>> {
        let start = Instant::now();
        let stop = Stop::Step(self.tolerance);
        let newton = Newton { max_iterations: self.max_iterations, stop, observer, amplification: 1.0 };
        let mut cascade = Cascade::<B, S>::new(rod, newton, buffers, self.accept_unstable);
        cascade.earlier = earlier;
        let solved = match self.accuracy {
            None => cascade.on_mesh(self.elements.div_ceil(2)),
            Some(accuracy) => cascade.to(accuracy),
        };
        let elapsed = start.elapsed();
        match solved {
            Ok(mut solution) => {
                solution.report.elapsed = elapsed;
                Ok(solution)
            }
            Err(mut failure) => {
                failure.report.elapsed = elapsed;
                Err(failure)
            }
        }
    }
}
