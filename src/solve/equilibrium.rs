//! The residual of a rod on a mesh, and its linearisation, for a given set of stage strains.

use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::chain::{EndRows, Transfer};
use super::mesh::{Mesh, StageStrains};
use crate::body::{Constraint, Elastic};
use crate::error::{Error, Result};
use crate::lie::{Pose, Wrench};
use crate::load::LoadWrench;
use crate::material::{Request, Response};
use crate::rod::condense;
use crate::rod::element::{ElementState, Kinematics};

/// Everything that follows from the stage strains.
#[derive(Clone, Debug)]
pub(crate) struct Configuration<const S: usize> {
    pub(crate) node_pose: Vec<Pose>,
    pub(crate) node_wrench: Vec<Wrench>,
    pub(crate) stage_wrench: Vec<[Wrench; S]>,
    pub(crate) response: Vec<[Response; S]>,
    pub(crate) kinematics: Vec<Kinematics<f64, S>>,
    /// One entry an element, or none at all for a rod without distributed loads.
    loads: Vec<[LoadWrench; S]>,
    pub(crate) tip_load: LoadWrench,
}

impl<B: Elastic, const S: usize> Mesh<'_, B, S> {
    /// Poses forward, section responses, loads, and wrenches backward, into buffers of whatever size.
    pub(crate) fn configure(&self, strains: &StageStrains<S>, into: &mut Configuration<S>) -> Result<()> {
        let (n, body) = (self.elements(), self.rod.body());
        into.clear();
        let mut pose = *self.rod.base();
        into.node_pose.push(pose);
        // as in the configuration before, which is then overwritten: no need to clear
        into.response.resize(n, [Response::zero(); S]);
        for (i, element) in strains.iter().enumerate() {
            for k in 0..S {
                into.response[i][k] = body.respond(self.stage_s(i, k), &element[k], Request::Tangent)?;
            }
            let motion =
                Kinematics::constrained(&self.table, &self.twists(i, element), self.h(i), &body.constraint());
            if !self.rod.loads().is_empty() {
                into.loads.push(self.stage_loads(i, &pose, &motion)?);
            }
            pose = pose * motion.end;
            into.node_pose.push(pose);
            into.kinematics.push(motion);
        }
        into.tip_load = self.tip_load(&pose)?;
        into.node_wrench.resize(n + 1, into.tip_load.wrench);
        into.stage_wrench.resize(n, [Wrench::zero(); S]);
        for i in (0..n).rev() {
            let (motion, h) = (&into.kinematics[i], self.h(i));
            let at_end = into.node_wrench[i + 1];
            (into.node_wrench[i], into.stage_wrench[i]) = match into.loads.get(i) {
                Some(loads) => motion.wrenches(&self.table, &at_end, &loads.map(|l| l.wrench), h),
                None => motion.wrenches_without_load(&at_end),
            };
        }
        into.take_reactions(&body.constraint());
        Ok(())
    }

    fn stage_loads(&self, i: usize, node: &Pose, motion: &Kinematics<f64, S>) -> Result<[LoadWrench; S]> {
        let mut stage = [no_load(); S];
        for k in 0..S {
            let (s, pose) = (self.stage_s(i, k), *node * motion.stage[k]);
            for load in self.rod.loads() {
                add_load(&mut stage[k], load.at(self.rod.body(), s, &pose)?);
            }
            check_load(&stage[k], "distributed load", s)?;
        }
        Ok(stage)
    }

    fn tip_load(&self, pose: &Pose) -> Result<LoadWrench> {
        let mut total = no_load();
        for load in self.rod.tip_loads() {
            add_load(&mut total, load.at(pose)?);
        }
        check_load(&total, "tip load", self.rod.body().length())?;
        Ok(total)
    }

    /// The state of element i, to linearise about.
    pub(crate) fn element<'c>(
        &self,
        i: usize,
        strains: &StageStrains<S>,
        state: &'c Configuration<S>,
    ) -> ElementState<'c, S> {
        ElementState {
            h: self.h(i),
            xi: self.twists(i, &strains[i]),
            kinematics: &state.kinematics[i],
            response: &state.response[i],
            stage_wrench: &state.stage_wrench[i],
            wrench_at_end: &state.node_wrench[i + 1],
            load: state.loads.get(i),
            constraint: self.rod.body().constraint(),
        }
    }

    /// Strain energy Σ h b U and the potential of the loads, `None` where one has none.
    pub(crate) fn energies(&self, state: &Configuration<S>) -> (f64, Option<f64>) {
        let weights = |i: usize| self.table.b.map(|b| self.h(i) * b);
        let mut elastic = 0.0;
        for (i, stage) in state.response.iter().enumerate() {
            elastic += weights(i).iter().zip(stage).map(|(w, r)| w * r.energy).sum::<f64>();
        }
        let mut potential = state.tip_load.potential;
        for (i, stage) in state.loads.iter().enumerate() {
            let weights = weights(i);
            for k in 0..S {
                potential = potential.zip(stage[k].potential).map(|(sum, p)| sum + weights[k] * p);
            }
        }
        (elastic, potential)
    }
}

fn no_load() -> LoadWrench {
    LoadWrench { wrench: Wrench::zero(), tangent: Matrix6::zeros(), potential: Some(0.0) }
}

fn add_load(total: &mut LoadWrench, load: LoadWrench) {
    total.wrench += load.wrench;
    total.tangent += load.tangent;
    total.potential = total.potential.zip(load.potential).map(|(a, b)| a + b);
}

fn check_load(load: &LoadWrench, quantity: &'static str, s: f64) -> Result<()> {
    let size = load.wrench.to_vector().norm() + load.tangent.norm();
    if size.is_finite() {
        return Ok(());
    }
    Err(Error::InvalidAt { quantity, value: size, requirement: "finite", s })
}

impl<const S: usize> Default for Configuration<S> {
    fn default() -> Self {
        Self {
            node_pose: Vec::new(),
            node_wrench: Vec::new(),
            stage_wrench: Vec::new(),
            response: Vec::new(),
            kinematics: Vec::new(),
            loads: Vec::new(),
            tip_load: no_load(),
        }
    }
}

impl<const S: usize> Configuration<S> {
    /// Empty, with all memory kept.
    fn clear(&mut self) {
        self.node_pose.clear();
        self.node_wrench.clear();
        self.stage_wrench.clear();
        self.kinematics.clear();
        self.loads.clear();
    }

    /// The law says nothing about strains that are fixed: the wrench that goes with them is what the balance asks for.
    fn take_reactions(&mut self, constraint: &Constraint) {
        if constraint.is_none() {
            return;
        }
        let fixed = constraint.fixed();
        for (responses, balances) in self.response.iter_mut().zip(&self.stage_wrench) {
            for (response, balance) in responses.iter_mut().zip(balances) {
                for i in 0..3 {
                    if fixed[i] {
                        response.wrench.moment[i] = balance.moment[i];
                    }
                    if fixed[3 + i] {
                        response.wrench.force[i] = balance.force[i];
                    }
                }
            }
        }
    }

    /// r_k = Ψ(Δξ_k) − Λ_k of element i.
    pub(crate) fn residual(&self, i: usize) -> [Wrench; S] {
        std::array::from_fn(|k| self.response[i][k].wrench - self.stage_wrench[i][k])
    }

    /// The six equations at the tip: δΛ_N = D ζ_N.
    pub(crate) fn tip_rows(&self, scale: &Scale) -> EndRows {
        let mut matrix = SMatrix::<f64, 6, 12>::zeros();
        let d = scale.wrench_of_displacement(&self.tip_load.tangent);
        matrix.fixed_view_mut::<6, 6>(0, 0).copy_from(&-d);
        matrix.fixed_view_mut::<6, 6>(0, 6).fill_with_identity();
        EndRows { matrix, rhs: SVector::zeros() }
    }
}

/// Units that make the chain's unknowns comparable: a length for displacements, a force for wrenches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    pub(crate) length: f64,
    pub(crate) force: f64,
}

impl Scale {
    pub(crate) fn displacement(&self) -> [f64; 6] {
        [1.0, 1.0, 1.0, self.length, self.length, self.length]
    }

    pub(crate) fn wrench(&self) -> [f64; 6] {
        let moment = self.force * self.length;
        [moment, moment, moment, self.force, self.force, self.force]
    }

    fn rescale(matrix: &Matrix6<f64>, rows: [f64; 6], columns: [f64; 6]) -> Matrix6<f64> {
        Matrix6::from_fn(|r, c| matrix[(r, c)] * columns[c] / rows[r])
    }

    fn wrench_of_displacement(&self, m: &Matrix6<f64>) -> Matrix6<f64> {
        Self::rescale(m, self.wrench(), self.displacement())
    }

    /// The size of a wrench in these units.
    pub(crate) fn wrench_size(&self, wrench: &Wrench) -> f64 {
        let unit = self.wrench();
        wrench.to_array().iter().zip(unit).fold(0.0, |size, (w, u)| f64::max(size, (w / u).abs()))
    }

    /// The physical displacement and wrench of a node's scaled unknowns.
    pub(crate) fn unscale(&self, y: &SVector<f64, 12>) -> (Vector6<f64>, Vector6<f64>) {
        let (d, w) = (self.displacement(), self.wrench());
        (Vector6::from_fn(|i, _| y[i] * d[i]), Vector6::from_fn(|i, _| y[6 + i] * w[i]))
    }

    /// The transfer of an element in scaled unknowns, from the one in physical units.
    pub(crate) fn transfer(&self, element: &condense::Transfer) -> Transfer {
        let t = [
            [&element.zeta_from_zeta, &element.zeta_from_wrench],
            [&element.wrench_from_zeta, &element.wrench_from_wrench],
        ];
        let c = [&element.zeta, &element.wrench];
        let units = [self.displacement(), self.wrench()];
        let mut transfer = Transfer { matrix: SMatrix::zeros(), rhs: SVector::zeros() };
        for i in 0..2 {
            for j in 0..2 {
                let block = Self::rescale(t[i][j], units[i], units[j]);
                transfer.matrix.fixed_view_mut::<6, 6>(6 * i, 6 * j).copy_from(&block);
            }
            for r in 0..6 {
                transfer.rhs[6 * i + r] = c[i][r] / units[i][r];
            }
        }
        transfer
    }
}

#[cfg(test)]
mod tests;
