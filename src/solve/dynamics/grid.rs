//! The mesh of a rod in motion, with what does not change from step to step.

use nalgebra::Matrix6;

use super::scene::{Movable, Scene};
use crate::error::Result;
use crate::lie::{Pose, Strain, Twist};
use crate::rod::collocation::Collocation;
use crate::solve::mesh::Mesh;

/// Elements of equal length but where something acts between the ends, with the section's inertia and viscosity at every stage.
pub(super) struct Grid<const S: usize> {
    pub(super) table: Collocation<S>,
    pub(super) length: f64,
    pub(super) elements: usize,
    /// Arc lengths of the nodes.
    nodes: Vec<f64>,
    /// ξ* at the stages.
    reference: Vec<[Twist; S]>,
    pub(super) mass: Vec<[Matrix6<f64>; S]>,
    /// Empty without damping.
    pub(super) viscosity: Vec<[Matrix6<f64>; S]>,
    /// Which strains are fixed.
    pub(super) fixed: [bool; 6],
    /// Where the reference shape lies: the pose of its first section, as the statics start from it.
    pub(super) start: Pose,
}

impl<const S: usize> Grid<S> {
    pub(super) fn new<B: Movable>(scene: &Scene<'_, B>, elements: usize) -> Result<Self> {
        let (body, mesh) =
            (scene.rod().body(), Mesh::<B, S>::with_stops(scene.rod(), elements, &scene.stops()));
        let mut grid = Self {
            table: Collocation::gauss(),
            length: body.length(),
            elements: mesh.elements(),
            nodes: (0..=mesh.elements()).map(|i| mesh.node_s(i)).collect(),
            reference: Vec::new(),
            mass: Vec::new(),
            viscosity: Vec::new(),
            fixed: body.constraint().fixed(),
            start: mesh.start.base,
        };
        for i in 0..grid.elements {
            let mut mass = [Matrix6::zeros(); S];
            let mut viscosity = [None; S];
            for k in 0..S {
                mass[k] = body.inertia(grid.stage_s(i, k))?;
                viscosity[k] = body.viscosity(grid.stage_s(i, k))?;
            }
            grid.reference.push(std::array::from_fn(|k| body.reference(grid.stage_s(i, k)).twist));
            grid.mass.push(mass);
            if viscosity.iter().any(Option::is_some) {
                grid.viscosity.push(viscosity.map(Option::unwrap_or_default));
            }
        }
        Ok(grid)
    }

    /// Length of element i.
    #[inline]
    pub(super) fn h(&self, i: usize) -> f64 {
        self.nodes[i + 1] - self.nodes[i]
    }

    pub(super) fn node_s(&self, i: usize) -> f64 {
        self.nodes[i]
    }

    /// The node at an arc length that is one.
    pub(super) fn node_at(&self, s: f64) -> usize {
        self.nodes.partition_point(|node| *node < s).min(self.elements)
    }

    #[inline]
    pub(super) fn stage_s(&self, i: usize, k: usize) -> f64 {
        self.nodes[i] + self.table.c[k] * self.h(i)
    }

    /// h b_k in element i.
    #[inline]
    pub(super) fn weight(&self, i: usize, k: usize) -> f64 {
        self.h(i) * self.table.b[k]
    }

    /// ξ = ξ* + Δξ at the stages of element i.
    #[inline]
    pub(super) fn twists(&self, i: usize, strains: &[Strain; S]) -> [Twist; S] {
        std::array::from_fn(|k| self.reference[i][k] + strains[k])
    }

    pub(super) fn has_fixed_strains(&self) -> bool {
        self.fixed != [false; 6]
    }
}
