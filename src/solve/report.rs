use std::time::Duration;

/// One Newton iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Iteration {
    /// Elements of the mesh it was taken on.
    pub elements: usize,
    /// Largest wrench residual ‖Ψ(Δξ) − Λ‖ over the stages before the step, relative to the largest wrench (moments in units of the length).
    pub residual: f64,
    /// Size of the step taken: the largest of node rotation, node displacement / L, stretch change and curvature change × L.
    pub step: f64,
    /// The fraction of the Newton step that was taken: 1 unless it was too large or led to an inadmissible state.
    pub fraction: f64,
}

/// How far the answer may be from the exact solution of the model, estimated from two meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ErrorEstimate {
    /// Of the positions of the nodes, m.
    pub position: f64,
    /// Of their rotations, rad.
    pub rotation: f64,
    /// Of their wrenches, relative to the largest of the rod (moments in units of its length).
    pub wrench: f64,
}

impl ErrorEstimate {
    /// The largest of position / L, rotation and wrench.
    pub fn relative(&self, length: f64) -> f64 {
        (self.position / length).max(self.rotation).max(self.wrench)
    }

    /// Nothing smaller than `floor`, as [`relative`](Self::relative) has it.
    pub(super) fn at_least(&self, floor: f64, length: f64) -> Self {
        Self {
            position: self.position.max(floor * length),
            rotation: self.rotation.max(floor),
            wrench: self.wrench.max(floor),
        }
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self {
            position: self.position * factor,
            rotation: self.rotation * factor,
            wrench: self.wrench * factor,
        }
    }
}

/// What a solve had to do to find its answer, in the order in which it is tried.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Rung {
    /// Newton's method from rest, with steps that turn no node by more than a radian.
    Newton,
    /// A Newton method on a model of the energy that is kept convex: stiffer sections, until no mode of the model is unstable.
    Regularised,
    /// The loads, and the displacements that supports hold, brought on in steps.
    LoadSteps,
    /// The path of equilibria from rest, followed by its arc length.
    ArcLength,
    /// Newton's method from other shapes than the reference: bent, twisted and turned by some radians, always the same ones.
    OtherStarts,
}

impl std::fmt::Display for Rung {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Newton => "Newton's method",
            Self::Regularised => "a regularised Newton's method",
            Self::LoadSteps => "load steps",
            Self::ArcLength => "arc length",
            Self::OtherStarts => "other starts",
        })
    }
}

/// Whether an equilibrium would stay.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Stability {
    /// The second variation of the energy under the conditions of the supports.
    Index {
        /// How many independent displacements lower the energy: the number of unstable modes. 0 is stable.
        unstable: usize,
        /// How many more leave it as it is, to second order.
        neutral: usize,
    },
    /// The tangent of the section at s is not positive definite: the law has lost its convexity there.
    Softening {
        /// Arc length, m.
        s: f64,
    },
    /// There is none to tell: a load has no potential, or no mesh was fine enough.
    #[default]
    Unknown,
}

impl Stability {
    /// Whether it is known that the equilibrium would not stay.
    pub fn is_unstable(&self) -> bool {
        match self {
            Self::Index { unstable, .. } => *unstable > 0,
            Self::Softening { .. } => true,
            Self::Unknown => false,
        }
    }
}

impl std::fmt::Display for Stability {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Index { unstable: 0, .. } => write!(f, "stable"),
            Self::Index { unstable, .. } => write!(f, "unstable in {unstable} modes"),
            Self::Softening { s } => {
                write!(f, "the tangent of the section at s = {s} m is not positive definite")
            }
            Self::Unknown => write!(f, "stability unknown"),
        }
    }
}

/// How a solve went.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Every Newton iteration, coarse mesh first.
    pub iterations: Vec<Iteration>,
    /// The estimated discretisation error.
    pub error: ErrorEstimate,
    /// The residual of the answer, as in [`Iteration::residual`].
    pub residual: f64,
    /// What had to be done to find the answer.
    pub rungs: Vec<Rung>,
    /// Whether the answer would stay.
    pub stability: Stability,
    /// Wall time.
    pub elapsed: Duration,
}

impl Report {
    pub(super) fn reach(&mut self, rung: Rung) {
        if !self.rungs.contains(&rung) {
            self.rungs.push(rung);
        }
    }

    /// The iterations on the mesh of the answer.
    pub fn fine_iterations(&self) -> impl Iterator<Item = &Iteration> {
        let finest = self.iterations.iter().map(|i| i.elements).max();
        self.iterations.iter().filter(move |i| Some(i.elements) == finest)
    }
}
