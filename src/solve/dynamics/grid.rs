//! The mesh of a rod in motion, with what does not change from step to step.

use nalgebra::Matrix6;

use super::scene::Movable;
use crate::error::Result;
use crate::lie::{Strain, Twist};
use crate::rod::collocation::Collocation;

/// Elements of equal length, with the section's inertia and viscosity at every stage.
pub(super) struct Grid<const S: usize> {
    pub(super) table: Collocation<S>,
    pub(super) length: f64,
    pub(super) elements: usize,
    /// ξ* at the stages.
    reference: Vec<[Twist; S]>,
    pub(super) mass: Vec<[Matrix6<f64>; S]>,
    /// Empty without damping.
    pub(super) viscosity: Vec<[Matrix6<f64>; S]>,
}

impl<const S: usize> Grid<S> {
    pub(super) fn new<B: Movable>(body: &B, elements: usize) -> Result<Self> {
        let (table, length) = (Collocation::gauss(), body.length());
        let (reference, mass, viscosity) = Default::default();
        let mut grid = Self { table, length, elements, reference, mass, viscosity };
        for i in 0..elements {
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

    /// Length of an element.
    #[inline]
    pub(super) fn h(&self) -> f64 {
        self.length / self.elements as f64
    }

    pub(super) fn node_s(&self, i: usize) -> f64 {
        self.length * (i as f64 / self.elements as f64)
    }

    #[inline]
    pub(super) fn stage_s(&self, i: usize, k: usize) -> f64 {
        self.h() * (i as f64 + self.table.c[k])
    }

    /// h b_k.
    #[inline]
    pub(super) fn weight(&self, k: usize) -> f64 {
        self.h() * self.table.b[k]
    }

    /// ξ = ξ* + Δξ at the stages of element i.
    #[inline]
    pub(super) fn twists(&self, i: usize, strains: &[Strain; S]) -> [Twist; S] {
        std::array::from_fn(|k| self.reference[i][k] + strains[k])
    }
}
