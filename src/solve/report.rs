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

    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self {
            position: self.position * factor,
            rotation: self.rotation * factor,
            wrench: self.wrench * factor,
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
    /// Wall time.
    pub elapsed: Duration,
}

impl Report {
    /// The iterations on the mesh of the answer.
    pub fn fine_iterations(&self) -> impl Iterator<Item = &Iteration> {
        let finest = self.iterations.iter().map(|i| i.elements).max();
        self.iterations.iter().filter(move |i| Some(i.elements) == finest)
    }
}
