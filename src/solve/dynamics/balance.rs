//! The balance of a rod in motion, from the tip to the base: of loads and inertia, or of impulses.

use nalgebra::Matrix6;

use super::core::Core;
use super::relation::{Rates, Relation};
use crate::lie::{Twist, Wrench};

impl<const S: usize> Core<S> {
    /// Inertia, node wrenches and residuals. What the balance gives of the wrenches of fixed strains replaces what the law says.
    #[inline(always)]
    pub(super) fn balance(&mut self) {
        let grid = &self.grid;
        let moving = self.problem.relation != Relation::Static;
        self.node_wrench[grid.elements] = self.mounts[self.mounts.len() - 1].before(&Wrench::zero(), moving);
        for i in (0..grid.elements).rev() {
            for k in 0..S {
                let mut force = self.load[i][k].wrench;
                if moving {
                    force -= inertia(&grid.mass[i][k], &self.rates[i][k]);
                }
                self.force[i][k] = force * grid.weight(i, k);
            }
            let at_end = self.node_wrench[i + 1];
            let (at_start, at_stages) = self.legs[i].balance(&grid.table, grid.h(i), &at_end, &self.force[i]);
            self.start_wrench[i] = at_start;
            self.node_wrench[i] = match self.mount_at[i] {
                Some(m) if i > 0 => self.mounts[m].before(&at_start, moving),
                _ => at_start,
            };
            for k in 0..S {
                let weight = grid.weight(i, k);
                if grid.has_fixed_strains() {
                    take(&mut self.wrench[i][k], &(at_stages[k] * (1.0 / weight)), &grid.fixed);
                }
                self.residual[i][k] = self.wrench[i][k] * weight - at_stages[k];
            }
        }
    }

    /// As [`balance`](Self::balance), of the momenta of the velocities that are missing: those of the stages, and of the mounts.
    pub(super) fn balance_impulses(&mut self, missing: &[[Twist; S]], at_mounts: &[Twist]) {
        let grid = &self.grid;
        let momentum = |mass: &Matrix6<f64>, twist: &Twist| Wrench::from_vector(&(mass * twist.to_vector()));
        let impulse = |m: usize| match &self.mounts[m].mass {
            Some(mass) => momentum(mass, &at_mounts[m]),
            None => Wrench::zero(),
        };
        self.base_impulse = impulse(0);
        self.node_wrench[grid.elements] = impulse(self.mounts.len() - 1);
        for i in (0..grid.elements).rev() {
            for k in 0..S {
                self.force[i][k] = momentum(&grid.mass[i][k], &missing[i][k]) * grid.weight(i, k);
            }
            let at_end = self.node_wrench[i + 1];
            let (at_start, at_stages) = self.legs[i].balance(&grid.table, grid.h(i), &at_end, &self.force[i]);
            self.node_wrench[i] = match self.mount_at[i] {
                Some(m) if i > 0 => self.mounts[m].turned_back(&at_start) + impulse(m),
                _ => at_start,
            };
            self.residual[i] = at_stages.map(|wrench| -wrench);
        }
    }
}

/// M η̇ − ad_ηᵀ M η.
#[inline(always)]
pub(super) fn inertia(mass: &Matrix6<f64>, rates: &Rates) -> Wrench {
    let momentum = Wrench::from_vector(&(mass * rates.velocity.to_vector()));
    Wrench::from_vector(&(mass * rates.acceleration.to_vector())) - momentum.ad_transpose(&rates.velocity)
}

/// Takes the components of `from` that go with fixed strains.
fn take(into: &mut Wrench, from: &Wrench, fixed: &[bool; 6]) {
    let (mut all, from) = (into.to_array(), from.to_array());
    for c in (0..6).filter(|&c| fixed[c]) {
        all[c] = from[c];
    }
    *into = Wrench::from_array(all);
}
