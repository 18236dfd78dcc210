//! Where the elements of a rod lie, and what is known about it there before anything is solved.

use crate::body::Elastic;
use crate::lie::{Strain, Twist};
use crate::rod::Rod;
use crate::rod::collocation::Collocation;

/// Strains Δξ at the Gauss stages of every element.
pub(crate) type StageStrains<const S: usize> = Vec<[Strain; S]>;

/// A mesh of collocation elements on a rod, of lengths that may differ.
pub(crate) struct Mesh<'a, B, const S: usize> {
    pub(crate) rod: &'a Rod<B>,
    pub(crate) table: Collocation<S>,
    /// Arc lengths of the nodes, from 0 to L.
    nodes: Vec<f64>,
    /// ξ* at the stages.
    reference: Vec<[Twist; S]>,
}

impl<'a, B: Elastic, const S: usize> Mesh<'a, B, S> {
    /// Elements of equal length.
    pub(crate) fn uniform(rod: &'a Rod<B>, elements: usize) -> Self {
        let length = rod.body().length();
        Self::at(rod, (0..=elements).map(|i| length * (i as f64 / elements as f64)).collect())
    }

    fn at(rod: &'a Rod<B>, nodes: Vec<f64>) -> Self {
        let mut mesh = Self { rod, table: Collocation::gauss(), nodes, reference: Vec::new() };
        mesh.reference = (0..mesh.elements())
            .map(|i| std::array::from_fn(|k| rod.body().reference(mesh.stage_s(i, k)).twist))
            .collect();
        mesh
    }

    /// The mesh with element i cut into `parts[i]` equal pieces.
    pub(crate) fn refined(&self, parts: &[usize]) -> Self {
        let mut nodes = vec![self.nodes[0]];
        for (i, &count) in parts.iter().enumerate() {
            for part in 1..count {
                nodes.push(self.nodes[i] + self.h(i) * (part as f64 / count as f64));
            }
            nodes.push(self.nodes[i + 1]);
        }
        Self::at(self.rod, nodes)
    }

    pub(crate) fn elements(&self) -> usize {
        self.nodes.len() - 1
    }

    /// Length of an element.
    pub(crate) fn h(&self, i: usize) -> f64 {
        self.nodes[i + 1] - self.nodes[i]
    }

    pub(crate) fn node_s(&self, i: usize) -> f64 {
        self.nodes[i]
    }

    pub(crate) fn stage_s(&self, i: usize, k: usize) -> f64 {
        self.nodes[i] + self.table.c[k] * self.h(i)
    }

    /// ξ = ξ* + Δξ at the stages of element i.
    pub(crate) fn twists(&self, i: usize, strains: &[Strain; S]) -> [Twist; S] {
        std::array::from_fn(|k| self.reference[i][k] + strains[k])
    }

    /// The strain polynomial of an element at τ ∈ [0, 1].
    pub(crate) fn interpolate(&self, element: &[Strain; S], tau: f64) -> Strain {
        let weights = self.table.interpolation(tau);
        element.iter().zip(weights).fold(Strain::zero(), |sum, (strain, weight)| sum + *strain * weight)
    }

    /// The strains of this mesh interpolated onto [`refined`](Self::refined) with the same parts.
    pub(crate) fn prolong(&self, strains: &StageStrains<S>, parts: &[usize]) -> StageStrains<S> {
        let mut fine = Vec::with_capacity(parts.iter().sum());
        for (element, &count) in strains.iter().zip(parts) {
            for part in 0..count {
                fine.push(std::array::from_fn(|k| {
                    self.interpolate(element, (part as f64 + self.table.c[k]) / count as f64)
                }));
            }
        }
        fine
    }
}
