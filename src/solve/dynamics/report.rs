/// How a step went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport {
    /// The time it led to, s.
    pub time: f64,
    /// Its length, s.
    pub step: f64,
    /// Its estimated error: of positions relative to the length of the rod, or of rotations in rad. For ESDIRK it is that of the embedded
    /// formula of order 3, for generalised-α what a linear acceleration would have added.
    pub error: f64,
    /// Newton iterations.
    pub iterations: usize,
    /// How often the rod was linearised and factored.
    pub factorisations: usize,
    /// Shorter and shorter steps that were tried before.
    pub rejected: usize,
}
