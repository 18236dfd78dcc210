use crate::error::Result;

/// What the linear system of a state answers: −K⁻¹ r and −K⁻¹ ∂r/∂λ.
#[derive(Clone, Debug)]
pub(crate) struct Tangents<T> {
    pub(crate) correction: T,
    pub(crate) per_factor: T,
}

/// Equilibria r(x, λ) = 0 that depend on one factor λ.
pub(crate) trait Family {
    /// x.
    type State: Clone;
    /// A displacement of x, an element of a linear space.
    type Step: Clone;

    /// Solves the linearised problem.
    ///
    /// # Errors
    /// If the state is not admissible, or K has no inverse.
    fn tangents(&mut self, state: &Self::State, factor: f64) -> Result<Tangents<Self::Step>>;

    /// The state displaced by a step.
    fn moved(&self, state: &Self::State, step: &Self::Step) -> Self::State;

    /// a x + b y.
    fn combined(&self, a: f64, x: &Self::Step, b: f64, y: &Self::Step) -> Self::Step;

    /// A scalar product of steps, without unit and comparable to λ².
    fn product(&self, x: &Self::Step, y: &Self::Step) -> f64;

    /// The number of unstable modes at fixed λ; `None` where there is none to tell.
    fn index(&mut self, state: &Self::State, factor: f64) -> Option<usize>;

    /// A number that falls through zero where mode `mode` becomes unstable; `None` where none is known.
    fn margin(&mut self, _state: &Self::State, _factor: f64, _mode: usize) -> Option<f64> {
        None
    }
}
