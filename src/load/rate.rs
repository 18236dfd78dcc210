use nalgebra::Matrix6;

use crate::lie::Wrench;

/// A load per length that depends on the rate of the strain twist along the rod, f̄ = −(Ā ξ′ + B̄), in the body frame.
///
/// In the strong form of the balance Ā stands beside the tangent ∂Ψ/∂Δξ, and B̄ on the other side. A [`Load`](super::Load) gives one in
/// [`rate`](super::Load::rate); with Ā = 0 it is a load that depends on the strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateLoad {
    /// Ā, rows and columns (angular, linear).
    #[doc(alias = "A_bar")]
    pub a_bar: Matrix6<f64>,
    /// B̄: moment per length, N, and force per length, N/m.
    #[doc(alias = "B_bar")]
    pub b_bar: Wrench,
}

impl RateLoad {
    /// No load.
    pub fn none() -> Self {
        Self { a_bar: Matrix6::zeros(), b_bar: Wrench::zero() }
    }

    /// Adds another, taken `factor` times.
    pub(crate) fn add_scaled(&mut self, load: &Self, factor: f64) {
        self.a_bar += load.a_bar * factor;
        self.b_bar += load.b_bar * factor;
    }
}
