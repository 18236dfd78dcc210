//! The residual of a rod on a mesh, and its linearisation, for a given set of stage strains.

use nalgebra::{Matrix6, Vector3};

use super::mesh::Mesh;
use super::unknowns::{StageStrains, Unknowns};
use crate::body::{Constraint, Elastic};
use crate::error::Result;
use crate::lie::{Pose, Wrench};
use crate::load::LoadWrench;
use crate::material::{Request, Response};
use crate::rod::element::{ElementState, Kinematics};
use crate::rod::joint::Fixture;
use crate::rod::lanes::{self, ELEMENTS, Twists};
use crate::rod::planar;
use crate::rod::stage_loads::StageLoads;

/// Everything that follows from the unknowns.
#[derive(Clone, Debug)]
pub(crate) struct Configuration<const S: usize> {
    /// Poses of the nodes; of the section after the corner where there is one.
    pub(crate) node_pose: Vec<Pose>,
    /// Λ at the start of every element, and at the tip.
    pub(crate) node_wrench: Vec<Wrench>,
    pub(crate) stage_wrench: Vec<[Wrench; S]>,
    /// Λ at the end of every element, as its own balance gives it.
    pub(crate) end_wrench: Vec<Wrench>,
    /// By how much that differs from what the next node has: nothing where the wrenches are no unknowns. Empty then.
    pub(crate) defect: Vec<Wrench>,
    pub(crate) response: Vec<[Response; S]>,
    pub(crate) kinematics: Vec<Kinematics<f64, S>>,
    /// One entry an element, or none at all for a rod without distributed loads, or with dead ones alone.
    pub(crate) loads: Vec<[LoadWrench; S]>,
    /// Their derivatives in the strains of the stages, where there is one that depends on these.
    pub(crate) by_strain: Vec<[Matrix6<f64>; S]>,
    /// Where all distributed loads are dead, their forces in the frames of the first nodes of the elements.
    pub(crate) dead: Vec<[Vector3<f64>; S]>,
    pub(crate) base_load: LoadWrench,
    pub(crate) tip_load: LoadWrench,
    /// In the order along the rod.
    pub(crate) joints: Vec<JointState>,
}

/// A joint: the section before its corner, and what acts there.
#[derive(Clone, Debug)]
pub(crate) struct JointState {
    pub(crate) pose: Pose,
    /// Λ before the joint: Ad_C⁻ᵀ Λ⁺ + the load + the reaction of the support.
    pub(crate) wrench: Wrench,
    pub(crate) load: LoadWrench,
    /// What the load and the support apply together.
    pub(crate) applied: Wrench,
}

impl<B: Elastic, const S: usize> Mesh<'_, B, S> {
    /// Poses forward, section responses, loads, and wrenches backward, into buffers of whatever size.
    pub(crate) fn configure(&self, unknowns: &Unknowns<S>, into: &mut Configuration<S>) -> Result<()> {
        into.clear();
        self.move_forward(unknowns, into)?;
        into.base_load = self.load_on(self.rod.base_fixture(), "base load", &unknowns.base, 0.0)?;
        let tip_pose = into.node_pose[self.elements()];
        let tip = self.rod.tip_fixture();
        into.tip_load = self.load_on(tip, "tip load", &tip_pose, self.rod.body().length())?;
        let at_tip = if tip.support.is_free() { into.tip_load.wrench } else { unknowns.tip };
        self.balance(unknowns, at_tip, into);
        Ok(())
    }

    /// Poses, responses and loads.
    fn move_forward(&self, unknowns: &Unknowns<S>, into: &mut Configuration<S>) -> Result<()> {
        let (n, body) = (self.elements(), self.rod.body());
        into.kinematics.resize(n, Kinematics { stage: [Pose::identity(); S], end: Pose::identity() });
        // as in the configuration before, which is then overwritten: no need to clear
        into.node_pose.resize(n + 1, unknowns.base);
        into.node_pose[0] = unknowns.base;
        into.response.resize(n, [Response::zero(); S]);
        let (loaded, dead) = (!self.rod.loads().is_empty(), !self.dead.is_empty());
        into.loads.resize(if loaded && !dead { n } else { 0 }, [LoadWrench::none(); S]);
        into.by_strain.resize(if self.is_rated { n } else { 0 }, [Matrix6::zeros(); S]);
        into.dead.resize(self.dead.len(), [Vector3::zeros(); S]);
        for i in 0..n {
            if i % ELEMENTS == 0 {
                let block = i..n.min(i + ELEMENTS);
                let (strains, out) = (&unknowns.strains[block.clone()], &mut into.response[block.clone()]);
                let places = self.stage_places(block).as_flattened();
                body.respond_many(places, strains.as_flattened(), Request::Tangent, out.as_flattened_mut())?;
                self.move_block(&unknowns.strains, i, &mut into.kinematics);
            }
            let motion = &into.kinematics[i];
            if dead {
                let back = &into.node_pose[i].rotation;
                for (force, in_space) in into.dead[i].iter_mut().zip(&self.dead[i]) {
                    *force = back.tr_mul(in_space) * self.load_factor;
                }
            } else if loaded {
                self.stage_loads(i, &into.node_pose[i], motion, &mut into.loads[i])?;
                if let Some(by_strain) = into.by_strain.get_mut(i) {
                    let (strains, loads) = (&unknowns.strains[i], &mut into.loads[i]);
                    self.rate_loads(i, strains, &into.node_pose[i], motion, (loads, by_strain))?;
                }
            }
            into.node_pose[i + 1] = into.node_pose[i] * motion.end;
            if let Some(j) = self.joint_at(i + 1) {
                let (joint, pose) = (&self.rod.joints()[j], into.node_pose[i + 1]);
                let load = self.load_on(&joint.fixture, "point load", &pose, joint.s)?;
                into.joints.push(JointState { pose, wrench: Wrench::zero(), load, applied: Wrench::zero() });
                into.node_pose[i + 1] = pose * joint.corner;
            }
        }
        Ok(())
    }

    /// The kinematics of the elements from `first` on, as many as go into a block.
    fn move_block(&self, strains: &StageStrains<S>, first: usize, into: &mut [Kinematics<f64, S>]) {
        let last = self.elements().min(first + ELEMENTS);
        if self.is_planar {
            let element = |i: usize| (self.h(first + i), self.twists(first + i, &strains[first + i]));
            planar::kinematics(&self.table, element, &mut into[first..last]);
            return;
        }
        let mut twists = Twists::new();
        for i in first..last {
            twists.set(i - first, self.h(i), &self.twists(i, &strains[i]));
        }
        lanes::kinematics(&self.table, &twists, &mut into[first..last]);
    }

    /// Wrenches: backward from the tip by the balance of the elements, or as the unknowns have them.
    fn balance(&self, unknowns: &Unknowns<S>, at_tip: Wrench, into: &mut Configuration<S>) {
        let n = self.elements();
        let independent = !unknowns.wrenches.is_empty();
        // these are overwritten, so that they need no clearing
        into.node_wrench.resize(n + 1, at_tip);
        into.node_wrench[n] = at_tip;
        into.stage_wrench.resize(n, [Wrench::zero(); S]);
        into.end_wrench.resize(n, at_tip);
        if independent {
            into.node_wrench[..n].copy_from_slice(&unknowns.wrenches);
        }
        let plane = self.is_planar && planar::carries(&[at_tip]) && self.rod.joints().is_empty();
        let mut joint = into.joints.len();
        for i in (0..n).rev() {
            let mut before = into.node_wrench[i + 1];
            if let Some(j) = self.joint_at(i + 1) {
                joint -= 1;
                let state = &mut into.joints[joint];
                state.applied = state.load.wrench + unknowns.reactions[j];
                let carried = self.rod.joints()[j].corner.adjoint_inverse().apply_transpose(&before);
                state.wrench = carried + state.applied;
                before = state.wrench;
            }
            let (motion, h, loads) =
                (&into.kinematics[i], self.h(i), stage_loads(&into.dead, &into.loads, &into.by_strain, i));
            if independent {
                let start = &into.node_wrench[i];
                let (stage, end) = motion.wrenches_from_start(&self.table, start, loads.at_node(motion), h);
                (into.stage_wrench[i], into.end_wrench[i]) = (stage, end);
                into.defect.push(end - before);
                continue;
            }
            into.end_wrench[i] = before;
            let stage = &mut into.stage_wrench[i];
            into.node_wrench[i] = match loads {
                StageLoads::None if plane => planar::wrenches(&self.table, motion, &before, None, stage),
                StageLoads::Dead(forces) if plane => {
                    planar::wrenches(&self.table, motion, &before, Some((h, forces)), stage)
                }
                StageLoads::Dead(forces) => motion.wrenches_of_dead(&self.table, &before, forces, h, stage),
                _ => match loads.at_node(motion) {
                    None => motion.wrenches_without_load(&before, stage),
                    Some(loads) => {
                        let start = motion.wrench_at_start(&self.table, &before, &loads, h);
                        *stage = motion.stage_wrenches(&self.table, &start, &loads, h);
                        start
                    }
                },
            };
        }
        into.defect.reverse();
        into.take_reactions(&self.rod.body().constraint());
    }

    fn stage_loads(
        &self,
        i: usize,
        node: &Pose,
        motion: &Kinematics<f64, S>,
        stage: &mut [LoadWrench; S],
    ) -> Result<()> {
        for k in 0..S {
            let pose = *node * motion.stage[k];
            let (s, body, total) = (self.stage_s(i, k), self.rod.body(), &mut stage[k]);
            *total = LoadWrench::none();
            for load in self.rod.loads() {
                total.add_scaled(&load.at(body, s, &pose)?, self.load_factor);
            }
            stage[k].check("distributed load", s)?;
        }
        Ok(())
    }

    fn load_on(&self, fixture: &Fixture, name: &'static str, pose: &Pose, s: f64) -> Result<LoadWrench> {
        let mut total = LoadWrench::none();
        for load in &fixture.loads {
            total.add_scaled(&load.at(pose)?, self.load_factor);
        }
        total.check(name, s)?;
        Ok(total)
    }

    /// The state of element i, to linearise about.
    #[inline(always)]
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
            wrench_at_end: &state.end_wrench[i],
            load: state.stage_loads(i),
            constraint: self.rod.body().constraint(),
        }
    }

    /// Strain energy Σ h b U and the potential of loads and springs, `None` where a load has none.
    pub(crate) fn energies(&self, state: &Configuration<S>) -> (f64, Option<f64>) {
        let weights = |i: usize| self.table.b.map(|b| self.h(i) * b);
        let mut elastic = 0.0;
        for (i, stage) in state.response.iter().enumerate() {
            elastic += weights(i).iter().zip(stage).map(|(w, r)| w * r.energy).sum::<f64>();
        }
        let mut potential = sum(state.base_load.potential, state.tip_load.potential);
        for joint in &state.joints {
            potential = sum(potential, joint.load.potential);
        }
        for (i, stage) in state.loads.iter().enumerate() {
            let weights = weights(i);
            for k in 0..S {
                potential = sum(potential, stage[k].potential.map(|p| weights[k] * p));
            }
        }
        for (i, forces) in state.dead.iter().enumerate() {
            let (weights, node) = (weights(i), &state.node_pose[i]);
            for (k, force) in forces.iter().enumerate() {
                // −f·p, with f in the frame of the node
                let position = node.rotation.tr_mul(&node.position) + state.kinematics[i].stage[k].position;
                potential = potential.map(|p| p - weights[k] * force.dot(&position));
            }
        }
        (elastic, potential.map(|p| p + self.springs(state)))
    }

    /// Potential energy of the springs of the supports.
    fn springs(&self, state: &Configuration<S>) -> f64 {
        let ends = [
            (self.rod.base_fixture(), &state.node_pose[0]),
            (self.rod.tip_fixture(), &state.node_pose[self.elements()]),
        ];
        let joints = self.rod.joints().iter().map(|joint| &joint.fixture);
        let joints = joints.zip(state.joints.iter().map(|joint| &joint.pose));
        ends.into_iter().chain(joints).map(|(fixture, pose)| fixture.support.potential(pose)).sum()
    }
}

/// Of element i, from those of all.
#[inline(always)]
fn stage_loads<'a, const S: usize>(
    dead: &'a [[Vector3<f64>; S]],
    any: &'a [[LoadWrench; S]],
    by_strain: &'a [[Matrix6<f64>; S]],
    i: usize,
) -> StageLoads<'a, S> {
    match (dead.get(i), any.get(i), by_strain.get(i)) {
        (Some(dead), ..) => StageLoads::Dead(dead),
        (None, Some(loads), None) => StageLoads::Any(loads),
        (None, Some(loads), Some(by_strain)) => StageLoads::Strained(loads, by_strain),
        (None, None, _) => StageLoads::None,
    }
}

fn sum(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.zip(b).map(|(a, b)| a + b)
}

impl<const S: usize> Default for Configuration<S> {
    fn default() -> Self {
        Self {
            node_pose: Vec::new(),
            node_wrench: Vec::new(),
            stage_wrench: Vec::new(),
            end_wrench: Vec::new(),
            defect: Vec::new(),
            response: Vec::new(),
            kinematics: Vec::new(),
            loads: Vec::new(),
            by_strain: Vec::new(),
            dead: Vec::new(),
            base_load: LoadWrench::none(),
            tip_load: LoadWrench::none(),
            joints: Vec::new(),
        }
    }
}

impl<const S: usize> Configuration<S> {
    /// Without what is pushed; the rest is overwritten.
    fn clear(&mut self) {
        self.defect.clear();
        self.joints.clear();
    }

    /// The distributed loads of element i.
    #[inline(always)]
    pub(crate) fn stage_loads(&self, i: usize) -> StageLoads<'_, S> {
        stage_loads(&self.dead, &self.loads, &self.by_strain, i)
    }

    /// The law says nothing about strains that are fixed: the wrench that goes with them is what the balance asks for.
    fn take_reactions(&mut self, constraint: &Constraint) {
        if constraint.is_none() {
            return;
        }
        let (responses, balances) = (self.response.as_flattened_mut(), self.stage_wrench.as_flattened());
        let mut each = |take: &dyn Fn(&mut Wrench, &Wrench)| {
            responses
                .iter_mut()
                .zip(balances)
                .for_each(|(response, balance)| take(&mut response.wrench, balance));
        };
        match constraint.fixed() {
            [false, false, false, true, true, true] => each(&|law, balance| law.force = balance.force),
            fixed => each(&|law, balance| {
                for i in 0..3 {
                    law.moment[i] = if fixed[i] { balance.moment[i] } else { law.moment[i] };
                    law.force[i] = if fixed[3 + i] { balance.force[i] } else { law.force[i] };
                }
            }),
        }
    }
}

#[cfg(test)]
mod tests;
