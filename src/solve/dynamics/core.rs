//! One implicit solve: from guessed strains at a new time to those that satisfy the balance with inertia.

use nalgebra::{Matrix6, Vector6};

use super::factor::{BaseRows, FactoredElement};
use super::grid::Grid;
use super::relation::{Offset, Rates, Relation};
use super::scene::{Amplitudes, Movable, Scene, none};
use crate::error::{Error, Result};
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
    pub(super) base_before: Pose,
    pub(super) base_offset: Offset,
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
    pub(super) base_rates: Rates,
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
    force: Vec<[Wrench; S]>,
    pub(super) tip_load: LoadWrench,
    pub(super) node_wrench: Vec<Wrench>,
    residual: Vec<[Wrench; S]>,
    factors: Vec<FactoredElement<S>>,
    closing: Matrix6<f64>,
    pub(super) step: Vec<[Strain; S]>,
    pub(super) base_step: Vector6<f64>,
}

/// How large a Newton step is, and where it is largest.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepSize {
    pub(super) size: f64,
    pub(super) rotation: f64,
    pub(super) s: f64,
}

impl<const S: usize> Core<S> {
    pub(super) fn new(grid: Grid<S>) -> Self {
        let n = grid.elements;
        let one = Pose::identity();
        let problem = Problem {
            time: 0.0,
            relation: Relation::Static,
            pose_before: vec![[one; S]; n],
            strain_before: vec![[Strain::zero(); S]; n],
            offset: vec![[Offset::zero(); S]; n],
            strain_offset: vec![[Strain::zero(); S]; n],
            base_before: one,
            base_offset: Offset::zero(),
            stiffness: 1.0,
        };
        Self {
            grid,
            problem,
            amplitudes: Amplitudes::default(),
            strain: vec![[Strain::zero(); S]; n],
            base: one,
            base_rates: Rates::zero(),
            legs: vec![Legs::still(); n],
            node_pose: vec![one; n + 1],
            pose: vec![[one; S]; n],
            rates: vec![[Rates::zero(); S]; n],
            strain_rate: vec![[Strain::zero(); S]; n],
            energy: vec![[0.0; S]; n],
            wrench: vec![[Wrench::zero(); S]; n],
            tangent: vec![[Matrix6::zeros(); S]; n],
            load: vec![[none(); S]; n],
            force: vec![[Wrench::zero(); S]; n],
            tip_load: none(),
            node_wrench: vec![Wrench::zero(); n + 1],
            residual: vec![[Wrench::zero(); S]; n],
            factors: (0..n).map(|_| FactoredElement::empty()).collect(),
            closing: Matrix6::zeros(),
            step: vec![[Strain::zero(); S]; n],
            base_step: Vector6::zeros(),
        }
    }

    /// Sets the time, and with it what depends on it alone: amplitudes, and the base where it is not free.
    pub(super) fn at_time<B: Movable>(&mut self, scene: &Scene<'_, B>, time: f64) -> Result<()> {
        self.problem.time = time;
        scene.amplitudes(time, &mut self.amplitudes)?;
        if !scene.is_free() {
            let (pose, velocity, acceleration) = scene.base(time)?;
            self.base = pose;
            self.base_rates = Rates { phi: Twist::zero(), slope: velocity, velocity, acceleration };
        }
        Ok(())
    }

    /// Poses and rates from the strains.
    #[inline(always)]
    pub(super) fn move_to_strains(&mut self, free: bool) {
        let (grid, p) = (&self.grid, &self.problem);
        if free {
            self.base_rates = p.relation.rates(&p.base_before, &self.base, &p.base_offset);
        }
        let mut node = self.base;
        self.node_pose[0] = node;
        for i in 0..grid.elements {
            let xi = grid.twists(i, &self.strain[i]);
            self.legs[i].fill(&grid.table, &xi, grid.h());
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
        if !self.grid.viscosity.is_empty() && !scene.is_free() && self.problem.relation != Relation::Static {
            self.rates_from_velocities();
        }
        for (i, viscosity) in self.grid.viscosity.iter().enumerate() {
            for k in 0..S {
                let damping = viscosity[k] * self.strain_rate[i][k].to_vector();
                self.wrench[i][k] += Wrench::from_vector(&damping);
            }
        }
        self.tip_load = scene.tip_load(&self.amplitudes, &self.node_pose[self.grid.elements])?;
        Ok(())
    }

    /// Inertia, node wrenches and residuals.
    #[inline(always)]
    pub(super) fn balance(&mut self) {
        let grid = &self.grid;
        self.node_wrench[grid.elements] = self.tip_load.wrench;
        let moving = self.problem.relation != Relation::Static;
        for i in (0..grid.elements).rev() {
            for k in 0..S {
                let mut force = self.load[i][k].wrench;
                if moving {
                    force -= inertia(&grid.mass[i][k], &self.rates[i][k]);
                }
                self.force[i][k] = force * grid.weight(k);
            }
            let at_end = self.node_wrench[i + 1];
            let (at_start, at_stages) = self.legs[i].balance(&grid.table, grid.h(), &at_end, &self.force[i]);
            self.node_wrench[i] = at_start;
            for k in 0..S {
                self.residual[i][k] = self.wrench[i][k] * grid.weight(k) - at_stages[k];
            }
        }
    }

    /// The linearised element i about the state that was balanced.
    pub(super) fn element(&self, i: usize, relation: &Matrix6<f64>) -> AdjointElement<S> {
        let (grid, p) = (&self.grid, &self.problem);
        let held = p.relation == Relation::Held;
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
            force_tangent[k] *= grid.weight(k);
        }
        let state = AdjointState {
            h: grid.h(),
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

    /// ∂Λ_N/∂ζ_N.
    pub(super) fn tip_relation(&self) -> Matrix6<f64> {
        if self.problem.relation == Relation::Held { Matrix6::zeros() } else { self.tip_load.tangent }
    }

    /// Linearises about the state that was balanced, and factors.
    pub(super) fn factor(&mut self, base: &BaseRows) -> Result<()> {
        let mut relation = self.tip_relation();
        for i in (0..self.grid.elements).rev() {
            let element = self.element(i, &relation);
            relation = self.factors[i]
                .factor(&element)
                .ok_or_else(|| Error::Singular { matrix: "tangent of an element", s: self.grid.node_s(i) })?;
        }
        self.closing = base
            .close(&relation, self.grid.length)
            .ok_or(Error::Singular { matrix: "tangent of the base", s: 0.0 })?;
        Ok(())
    }

    /// The factors as numbers.
    pub(super) fn save_factors(&self) -> Vec<f64> {
        let mut numbers = self.closing.as_slice().to_vec();
        self.factors.iter().for_each(|element| element.save(&mut numbers));
        numbers
    }

    /// The opposite of [`save_factors`](Self::save_factors).
    pub(super) fn restore_factors(&mut self, numbers: &[f64]) -> Option<()> {
        let mut numbers = numbers.iter().copied();
        for entry in self.closing.as_mut_slice() {
            *entry = numbers.next()?;
        }
        self.factors.iter_mut().try_for_each(|element| element.restore(&mut numbers))
    }

    /// The Newton step for the present residual, by the factors at hand.
    #[inline(always)]
    pub(super) fn newton_step(&mut self, base: &BaseRows, free: bool) -> Result<StepSize> {
        let mut answer = Wrench::zero();
        for i in (0..self.grid.elements).rev() {
            (self.step[i], answer) = self.factors[i].back(&self.residual[i], &answer);
        }
        self.base_step = if free {
            let missing = -(self.node_wrench[0] + answer).to_vector();
            self.closing * (base.wrench * missing)
        } else {
            Vector6::zeros()
        };
        let length = self.grid.length;
        let mut zeta = self.base_step;
        let mut found = StepSize { size: 0.0, rotation: 0.0, s: 0.0 };
        for i in 0..=self.grid.elements {
            let rotation = zeta.fixed_rows::<3>(0).norm();
            let mut size = rotation.max(zeta.fixed_rows::<3>(3).norm() / length);
            found.rotation = found.rotation.max(rotation);
            if i < self.grid.elements {
                zeta = self.factors[i].forth(&zeta, &mut self.step[i]);
                for strain in &self.step[i] {
                    size = size.max(strain.linear.norm()).max(strain.angular.norm() * length);
                }
            }
            // not max, which would drop a NaN
            if !(size <= found.size) {
                (found.size, found.s) = (size, self.grid.node_s(i));
            }
        }
        if found.size.is_finite() {
            return Ok(found);
        }
        Err(Error::Singular { matrix: "tangent of the rod", s: found.s })
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
    }
}

/// M η̇ − ad_ηᵀ M η.
#[inline(always)]
pub(super) fn inertia(mass: &Matrix6<f64>, rates: &Rates) -> Wrench {
    let momentum = Wrench::from_vector(&(mass * rates.velocity.to_vector()));
    Wrench::from_vector(&(mass * rates.acceleration.to_vector())) - momentum.ad_transpose(&rates.velocity)
}
