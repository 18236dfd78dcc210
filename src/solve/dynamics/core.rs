//! One implicit solve: from guessed strains at a new time to those that satisfy the balance with inertia.

use nalgebra::{Matrix6, Vector6};

use super::border::Border;
use super::factor::FactoredElement;
use super::grid::Grid;
use super::mount::Mount;
use super::place::{Amplitudes, Place};
use super::relation::{Offset, Rates, Relation};
use super::scene::{Movable, Scene};
use crate::error::Result;
use crate::lie::{Pose, Strain, Twist, Wrench};
use crate::load::LoadWrench;
use crate::material::Request;
use crate::rod::adjoint::{AdjointElement, AdjointState, Legs};

/// The constants of the time scheme for one solve.
pub(super) struct Problem<const S: usize> {
    pub(super) time: f64,
    pub(super) relation: Relation,
    /// At the beginning of the step.
    pub(super) pose_before: Vec<[Pose; S]>,
    pub(super) strain_before: Vec<[Strain; S]>,
    pub(super) offset: Vec<[Offset; S]>,
    pub(super) strain_offset: Vec<[Strain; S]>,
    /// K counts this much: 1, but next to nothing where accelerations are sought.
    pub(super) stiffness: f64,
}

/// All that follows from strains, in memory that is kept.
pub(super) struct Core<const S: usize> {
    pub(super) grid: Grid<S>,
    pub(super) problem: Problem<S>,
    amplitudes: Amplitudes,
    pub(super) strain: Vec<[Strain; S]>,
    pub(super) base: Pose,
    /// Whether the pose of the base is to be found.
    pub(super) loose: bool,
    /// The base, every place between where something acts, and the tip.
    pub(super) mounts: Vec<Mount>,
    /// The mount at every node that has one.
    pub(super) mount_at: Vec<Option<usize>>,
    pub(super) legs: Vec<Legs<S>>,
    pub(super) node_pose: Vec<Pose>,
    pub(super) pose: Vec<[Pose; S]>,
    pub(super) rates: Vec<[Rates; S]>,
    pub(super) strain_rate: Vec<[Strain; S]>,
    pub(super) energy: Vec<[f64; S]>,
    /// Ψ + V ξ̇.
    pub(super) wrench: Vec<[Wrench; S]>,
    tangent: Vec<[Matrix6<f64>; S]>,
    pub(super) load: Vec<[LoadWrench; S]>,
    /// h b (f̄ − inertia).
    pub(super) force: Vec<[Wrench; S]>,
    /// At the end of the element before, and at the base.
    pub(super) node_wrench: Vec<Wrench>,
    /// Of the velocity that a body on the base misses.
    pub(super) base_impulse: Wrench,
    /// At the start of every element; after the corner, where there is one.
    pub(super) start_wrench: Vec<Wrench>,
    pub(super) residual: Vec<[Wrench; S]>,
    pub(super) factors: Vec<FactoredElement<S>>,
    pub(super) border: Border<S>,
    other_factors: (Vec<FactoredElement<S>>, Border<S>),
    pub(super) step: Vec<[Strain; S]>,
    pub(super) base_step: Vector6<f64>,
    pub(super) reaction_step: Vec<Wrench>,
}

impl<const S: usize> Core<S> {
    pub(super) fn new<B: Movable>(grid: Grid<S>, scene: &Scene<'_, B>) -> Self {
        let n = grid.elements;
        let one = Pose::identity();
        let mount = |place: Place| {
            let node = match place {
                Place::Base => 0,
                Place::Between(s) => grid.node_at(s),
                Place::Tip => n,
            };
            Mount::new(scene, place, node)
        };
        let mounts: Vec<Mount> = scene.places().into_iter().map(mount).collect();
        let mut mount_at = vec![None; n + 1];
        for (m, mount) in mounts.iter().enumerate() {
            mount_at[mount.node] = Some(m);
        }
        let start = grid.start;
        let reactions = vec![Wrench::zero(); mounts.len()];
        let loose = !scene.support(Place::Base).is_clamped();
        let problem = Problem {
            time: 0.0,
            relation: Relation::Static,
            pose_before: vec![[one; S]; n],
            strain_before: vec![[Strain::zero(); S]; n],
            offset: vec![[Offset::zero(); S]; n],
            strain_offset: vec![[Strain::zero(); S]; n],
            stiffness: 1.0,
        };
        Self {
            grid,
            problem,
            amplitudes: Amplitudes::default(),
            strain: vec![[Strain::zero(); S]; n],
            base: start,
            loose,
            mounts,
            mount_at,
            legs: vec![Legs::still(); n],
            node_pose: vec![one; n + 1],
            pose: vec![[one; S]; n],
            rates: vec![[Rates::zero(); S]; n],
            strain_rate: vec![[Strain::zero(); S]; n],
            energy: vec![[0.0; S]; n],
            wrench: vec![[Wrench::zero(); S]; n],
            tangent: vec![[Matrix6::zeros(); S]; n],
            load: vec![[LoadWrench::none(); S]; n],
            force: vec![[Wrench::zero(); S]; n],
            node_wrench: vec![Wrench::zero(); n + 1],
            base_impulse: Wrench::zero(),
            start_wrench: vec![Wrench::zero(); n],
            residual: vec![[Wrench::zero(); S]; n],
            factors: (0..n).map(|_| FactoredElement::empty()).collect(),
            border: Border::empty(),
            other_factors: (Vec::new(), Border::empty()),
            step: vec![[Strain::zero(); S]; n],
            base_step: Vector6::zeros(),
            reaction_step: reactions,
        }
    }

    /// Sets the time, and with it what depends on it alone: amplitudes, the frames of supports, and the base where it is given.
    pub(super) fn at_time<B: Movable>(&mut self, scene: &Scene<'_, B>, time: f64) -> Result<()> {
        self.problem.time = time;
        scene.amplitudes(time, &mut self.amplitudes)?;
        for mount in &mut self.mounts {
            mount.at_time(scene, time)?;
        }
        if self.mounts[0].support.is_clamped() {
            (self.base, self.mounts[0].rates) = self.mounts[0].given();
        }
        Ok(())
    }

    /// The mount at a node between two elements.
    #[inline]
    pub(super) fn between(&self, node: usize) -> Option<&Mount> {
        self.mount_at[node].map(|m| &self.mounts[m]).filter(|mount| matches!(mount.place, Place::Between(_)))
    }

    pub(super) fn base_rates(&self) -> &Rates {
        &self.mounts[0].rates
    }

    /// Poses and rates from the strains.
    #[inline(always)]
    pub(super) fn move_to_strains(&mut self) {
        let (grid, p) = (&self.grid, &self.problem);
        let mut node = self.base;
        self.node_pose[0] = node;
        self.mounts[0].move_to(&p.relation, &node);
        for i in 0..grid.elements {
            let xi = grid.twists(i, &self.strain[i]);
            self.legs[i].fill(&grid.table, &xi, grid.h(i));
            for k in 0..S {
                let pose = node * self.legs[i].stage[k].pose;
                self.pose[i][k] = pose;
                self.rates[i][k] = p.relation.rates(&p.pose_before[i][k], &pose, &p.offset[i][k]);
                let offset = &p.strain_offset[i][k];
                self.strain_rate[i][k] =
                    p.relation.strain_rate(&p.strain_before[i][k], &self.strain[i][k], offset);
            }
            node = node * self.legs[i].end.pose;
            self.node_pose[i + 1] = node;
            if let Some(m) = self.mount_at[i + 1] {
                self.mounts[m].move_to(&p.relation, &node);
                node = self.mounts[m].after(&node);
            }
        }
    }

    /// Internal wrenches, with tangents if `request` says so, and loads.
    pub(super) fn respond<B: Movable>(&mut self, scene: &Scene<'_, B>, request: Request) -> Result<()> {
        let loaded = scene.has_loads();
        for i in 0..self.grid.elements {
            for k in 0..S {
                let s = self.grid.stage_s(i, k);
                let response = scene.respond(&self.amplitudes, s, &self.strain[i][k], request)?;
                self.energy[i][k] = response.energy;
                self.wrench[i][k] = response.wrench;
                if request >= Request::Tangent {
                    self.tangent[i][k] = response.tangent;
                }
                if loaded {
                    self.load[i][k] = scene.load(&self.amplitudes, s, &self.pose[i][k])?;
                }
            }
        }
        if !self.grid.viscosity.is_empty() && !self.loose && self.problem.relation != Relation::Static {
            self.rates_from_velocities();
        }
        for (i, viscosity) in self.grid.viscosity.iter().enumerate() {
            for k in 0..S {
                let damping = viscosity[k] * self.strain_rate[i][k].to_vector();
                self.wrench[i][k] += Wrench::from_vector(&damping);
            }
        }
        // of what acts on a base whose pose is given the rod feels nothing
        for mount in &mut self.mounts[usize::from(!self.loose)..] {
            mount.load_by(scene, &self.amplitudes, &self.node_pose[mount.node])?;
        }
        Ok(())
    }

    /// Puts the factors for rates in the place of those for steps, or back.
    pub(super) fn swap_factors(&mut self) {
        if self.other_factors.0.is_empty() {
            self.other_factors.0 = (0..self.grid.elements).map(|_| FactoredElement::empty()).collect();
        }
        std::mem::swap(&mut self.factors, &mut self.other_factors.0);
        std::mem::swap(&mut self.border, &mut self.other_factors.1);
    }

    /// The linearised element i about the state that was balanced.
    pub(super) fn element(&self, i: usize, relation: &Matrix6<f64>) -> AdjointElement<S> {
        let (grid, p) = (&self.grid, &self.problem);
        let held = p.relation.is_of_rates();
        let mut stiffness = self.tangent[i];
        let mut force_tangent = [Matrix6::zeros(); S];
        for k in 0..S {
            if p.stiffness != 1.0 {
                stiffness[k] *= p.stiffness;
            } else if let Some(viscosity) = grid.viscosity.get(i) {
                stiffness[k] += viscosity[k] * p.relation.strain_factor();
            }
            force_tangent[k] = p.relation.inertia_tangent(&grid.mass[i][k], &self.rates[i][k]);
            if !held {
                force_tangent[k] += self.load[i][k].tangent;
            }
            force_tangent[k] *= grid.weight(i, k);
        }
        let state = AdjointState {
            h: grid.h(i),
            xi: grid.twists(i, &self.strain[i]),
            legs: &self.legs[i],
            stiffness: &stiffness,
            wrench: &self.wrench[i],
            wrench_at_end: &self.node_wrench[i + 1],
            force: &self.force[i],
            force_tangent: &force_tangent,
            geometric: !held,
        };
        AdjointElement::new(&grid.table, &state, relation)
    }

    /// Adds a fraction of the step.
    pub(super) fn advance(&mut self, fraction: f64) {
        for (strain, step) in self.strain.iter_mut().zip(&self.step) {
            for k in 0..S {
                strain[k] += step[k] * fraction;
            }
        }
        if self.base_step != Vector6::zeros() {
            self.base = self.base * Twist::from_vector(&(self.base_step * fraction)).exp();
        }
        for (mount, step) in self.mounts.iter_mut().zip(&self.reaction_step) {
            mount.reaction += *step * fraction;
        }
    }
}
