use super::Report;
use crate::lie::{Pose, Strain, Wrench};

/// The state of the rod at one arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Node {
    /// Arc length s, m.
    pub s: f64,
    /// Pose g.
    pub pose: Pose,
    /// Strain Δξ from the reference.
    pub strain: Strain,
    /// Internal wrench Ψ = Λ in body frame.
    pub wrench: Wrench,
}

/// A rod in static equilibrium.
///
/// With the feature `serde` it can be written, as JSON for instance; its nodes, stages and report can be read back.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StaticSolution {
    pub(super) nodes: Vec<Node>,
    pub(super) stages: Vec<Node>,
    pub(super) strain_energy: f64,
    pub(super) load_potential: Option<f64>,
    pub(super) report: Report,
}

impl StaticSolution {
    /// The nodes, from base to tip: poses and wrenches of the full order of the element, and the strain that carries the wrench.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The Gauss stages, from base to tip, where the strains are the unknowns of the solve.
    pub fn stages(&self) -> &[Node] {
        &self.stages
    }

    /// The node at the tip, s = L.
    pub fn tip(&self) -> &Node {
        &self.nodes[self.nodes.len() - 1]
    }

    /// The node at the base, s = 0.
    pub fn base(&self) -> &Node {
        &self.nodes[0]
    }

    /// ∫f ds over the rod by the Gauss rule of the elements, whose points are the [`stages`](Self::stages): as exact as the solution.
    pub fn integrate(&self, f: impl Fn(&Node) -> f64) -> f64 {
        // a joint has two nodes at one place, with no element between
        let lengths: Vec<f64> =
            self.nodes.windows(2).map(|ends| ends[1].s - ends[0].s).filter(|h| *h > 0.0).collect();
        let weights: &[f64] = match self.stages.len() / lengths.len().max(1) {
            1 => &[1.0],
            2 => &[0.5, 0.5],
            _ => &[5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0],
        };
        let stages = self.stages.chunks(weights.len());
        let element = |(h, stages): (f64, &[Node])| -> f64 {
            h * weights.iter().zip(stages).map(|(w, stage)| w * f(stage)).sum::<f64>()
        };
        lengths.into_iter().zip(stages).map(element).sum()
    }

    /// The strain at s, straight between the stages.
    pub(super) fn strain_near(&self, s: f64) -> Strain {
        let after = self.stages.partition_point(|stage| stage.s < s);
        let last = self.stages.len() - 1;
        let (a, b) = (&self.stages[after.saturating_sub(1).min(last)], &self.stages[after.min(last)]);
        if b.s > a.s { a.strain + (b.strain - a.strain) * ((s - a.s) / (b.s - a.s)) } else { a.strain }
    }

    /// Strain energy ∫U ds, J.
    pub fn strain_energy(&self) -> f64 {
        self.strain_energy
    }

    /// Potential energy of the loads, J (zero at the origin of space); `None` where one of them has none.
    pub fn load_potential(&self) -> Option<f64> {
        self.load_potential
    }

    /// How the solve went.
    pub fn report(&self) -> &Report {
        &self.report
    }
}
