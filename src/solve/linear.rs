//! One Newton step: the elements condensed, the chain solved, in memory that is kept from step to step.

use nalgebra::Vector6;

use super::chain::Chain;
use super::equilibrium::Configuration;
use super::mesh::Mesh;
use super::scale::Scale;
use super::sweep::{Sweep, Tip};
use super::unknowns::{StageStrains, Unknowns};
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::Pose;
use crate::load::LoadWrench;
use crate::rod::condense::{Condensed, Transfer};
use crate::rod::lanes::{self, ELEMENTS, Eliminated, Linearised};

/// By how much a tangent with neutral modes is made stiffer.
const STIFFER: f64 = 1e-7;

/// Displacement ζ and change of wrench δΛ of a node.
pub(crate) type NodeStep = (Vector6<f64>, Vector6<f64>);

/// How large a Newton step is.
pub(crate) struct Step {
    /// As [`Iteration::step`](super::Iteration::step) of a full step.
    pub(crate) size: f64,
    /// The largest rotation of a node, rad.
    pub(crate) rotation: f64,
}

/// A change of the [`Unknowns`].
#[derive(Clone, Debug)]
pub(crate) struct Increment<const S: usize> {
    /// δξ.
    pub(crate) strains: StageStrains<S>,
    /// ζ and δΛ at the starts of the elements, and at the tip.
    pub(crate) nodes: Vec<NodeStep>,
    /// Of the reactions at the joints.
    pub(crate) reactions: Vec<Vector6<f64>>,
}

/// Memory of the solves on meshes of one order, kept from iteration to iteration and from solve to solve.
pub(crate) struct Buffers<const S: usize> {
    pub(super) condensed: Vec<Condensed<S>>,
    sweep: Sweep,
    pub(super) chain: Chain,
    /// The last step.
    pub(super) step: Increment<S>,
    /// Modes that cost nothing: no step has a part of them.
    pub(super) neutral: Vec<Increment<S>>,
    /// Unknowns of the state being tried.
    pub(crate) trial: Unknowns<S>,
    spare: Vec<Configuration<S>>,
    /// [`Sweep::least_stiffness`] of the last step.
    pub(super) least_stiffness: f64,
    /// Of the block of elements being condensed.
    linearised: Linearised,
    eliminated: Eliminated,
}

impl<const S: usize> Default for Buffers<S> {
    fn default() -> Self {
        Self {
            condensed: Vec::new(),
            sweep: Sweep::default(),
            chain: Chain::default(),
            step: Increment { strains: Vec::new(), nodes: Vec::new(), reactions: Vec::new() },
            neutral: Vec::new(),
            trial: Unknowns::default(),
            spare: Vec::new(),
            least_stiffness: 0.0,
            linearised: Linearised::new(),
            eliminated: Eliminated::new(),
        }
    }
}

impl<const S: usize> Buffers<S> {
    /// A configuration to write into.
    pub(crate) fn configuration(&mut self) -> Configuration<S> {
        self.spare.pop().unwrap_or_default()
    }

    /// Takes back a configuration that is not needed any more.
    pub(crate) fn recycle(&mut self, configuration: Configuration<S>) {
        self.spare.push(configuration);
    }

    /// Puts `unknowns` + fraction × the last step into `trial`.
    pub(crate) fn move_by(&mut self, unknowns: &Unknowns<S>, fraction: f64) {
        unknowns.moved(&self.step, fraction, &mut self.trial);
    }

    /// The Newton step about a state.
    pub(crate) fn newton_step<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        unknowns: &Unknowns<S>,
        state: &Configuration<S>,
        scale: &Scale,
    ) -> Result<Step> {
        if self.neutral.is_empty() {
            self.condense(mesh, unknowns, state)?;
            return self.solve_condensed(mesh, state, scale);
        }
        // singular but for rounding: a little stiffer, so that what there is of the modes stays small until it is taken out
        let mut stiffer = state.clone();
        stiffer.response.iter_mut().flatten().for_each(|response| response.tangent *= 1.0 + STIFFER);
        self.condense(mesh, unknowns, &stiffer)?;
        self.solve_condensed(mesh, &stiffer, scale)?;
        self.without_neutral_modes(scale.length);
        self.measured(scale.length)
    }

    /// Takes the neutral modes out of the step, in the product Σ δω·δω L² + δν·δν over the stages.
    fn without_neutral_modes(&mut self, length: f64) {
        let product = |a: &StageStrains<S>, b: &StageStrains<S>| -> f64 {
            let pair = |(a, b): (&crate::lie::Strain, &crate::lie::Strain)| {
                a.angular.dot(&b.angular) * length * length + a.linear.dot(&b.linear)
            };
            a.iter().flatten().zip(b.iter().flatten()).map(pair).sum()
        };
        for mode in &self.neutral {
            let part = -product(&self.step.strains, &mode.strains) / product(&mode.strains, &mode.strains);
            if !part.is_finite() || mode.nodes.len() != self.step.nodes.len() {
                continue;
            }
            for (to, from) in self.step.strains.iter_mut().flatten().zip(mode.strains.iter().flatten()) {
                *to += *from * part;
            }
            for (to, from) in self.step.nodes.iter_mut().zip(&mode.nodes) {
                to.0 += from.0 * part;
                to.1 += from.1 * part;
            }
        }
    }

    /// The same about elements that are condensed.
    pub(super) fn solve_condensed<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        state: &Configuration<S>,
        scale: &Scale,
    ) -> Result<Step> {
        self.step.reactions.clear();
        self.step.reactions.resize(mesh.rod.joints().len(), Vector6::zeros());
        let swept = mesh.is_cantilever() && {
            let forces_only = state.defect.is_empty() && mesh.rod.joints().is_empty();
            let alone = mesh.rod.loads().is_empty() && forces_only;
            let tip = Tip { tangent: &state.tip_load.tangent, alone };
            let elements = &self.condensed[..mesh.elements()];
            let nodes = &mut self.step.nodes;
            self.sweep.solve(elements, &state.node_wrench, &tip, scale, nodes).is_some()
        };
        self.least_stiffness = if swept { self.sweep.least_stiffness } else { 0.0 };
        if !swept {
            self.solve_with_pivoting(mesh, state, scale)?;
        }
        self.finish(mesh, scale)
    }

    /// The transfers of the elements, joints without a support taken into the element before them.
    pub(super) fn condense<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        unknowns: &Unknowns<S>,
        state: &Configuration<S>,
    ) -> Result<()> {
        let n = mesh.elements();
        self.condensed.resize_with(n.max(self.condensed.len()), Condensed::empty);
        let in_lanes = state.loads.is_empty() && mesh.rod.body().constraint().is_none();
        let mut joints = state.joints.iter();
        for i in 0..n {
            if in_lanes && i % ELEMENTS == 0 {
                self.condense_block(mesh, unknowns, state, i);
            }
            let element = &mut self.condensed[i];
            let end = &state.kinematics[i].end;
            if !(in_lanes && element.take(&self.eliminated, i % ELEMENTS, end).is_some()) {
                element
                    .fill(&mesh.table, &mesh.element(i, &unknowns.strains, state))
                    .ok_or_else(|| Error::Singular { matrix: "tangent of an element", s: mesh.node_s(i) })?;
            }
            if let Some(defect) = state.defect.get(i) {
                element.transfer.wrench += defect.to_vector();
            }
            let Some(j) = mesh.joint_at(i + 1) else { continue };
            let Some(joint) = joints.next() else { continue };
            let fixed = &mesh.rod.joints()[j];
            if fixed.fixture.support.is_free() {
                pass(&mut element.transfer, &fixed.corner, &joint.load);
            }
        }
        Ok(())
    }

    /// The elements from `first` on, as many as go into a block.
    fn condense_block<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        unknowns: &Unknowns<S>,
        state: &Configuration<S>,
        first: usize,
    ) {
        let last = mesh.elements().min(first + ELEMENTS);
        for i in first..last {
            let twists = mesh.twists(i, &unknowns.strains[i]);
            let place = i - first;
            self.linearised.set(place, (mesh.h(i), &twists), &state.response[i], &state.node_wrench[i]);
        }
        lanes::condense(&mesh.table, &self.linearised, last - first, &mut self.eliminated);
    }

    /// The strains from the nodes, and the size of it all.
    fn finish<B: Elastic>(&mut self, mesh: &Mesh<'_, B, S>, scale: &Scale) -> Result<Step> {
        self.step.strains.clear();
        let nodes = self.step.nodes.iter().take(mesh.elements());
        self.step.strains.extend(
            nodes.zip(&self.condensed).map(|((zeta, wrench), element)| element.strain_step(zeta, wrench)),
        );
        self.measured(scale.length)
    }

    /// How large the step is.
    fn measured(&self, length: f64) -> Result<Step> {
        let mut step = Step { size: 0.0, rotation: 0.0 };
        for (zeta, _) in &self.step.nodes {
            step.rotation = step.rotation.max(zeta.fixed_rows::<3>(0).norm());
            step.size = step.size.max(zeta.fixed_rows::<3>(3).norm() / length);
        }
        for strain in self.step.strains.iter().flatten() {
            step.size = step.size.max(strain.linear.norm()).max(strain.angular.norm() * length);
        }
        step.size = step.size.max(step.rotation);
        let mut nodes = self.step.nodes.iter();
        if !(step.size.is_finite() && nodes.all(|(zeta, wrench)| (zeta + wrench).norm().is_finite())) {
            return Err(Error::Singular { matrix: "tangent of the rod", s: length });
        }
        Ok(step)
    }
}

/// Takes a corner and a point load into the transfer before them: ζ⁺ = Ad_C⁻¹ ζ⁻, δΛ⁺ = Ad_Cᵀ (δΛ⁻ − D ζ⁻).
fn pass(t: &mut Transfer, corner: &Pose, load: &LoadWrench) {
    let (inverse, transpose) =
        (corner.adjoint_inverse().to_matrix(), corner.adjoint().to_matrix().transpose());
    t.wrench_from_zeta = transpose * (t.wrench_from_zeta - load.tangent * t.zeta_from_zeta);
    t.wrench_from_wrench = transpose * (t.wrench_from_wrench - load.tangent * t.zeta_from_wrench);
    t.wrench = transpose * (t.wrench - load.tangent * t.zeta);
    t.zeta_from_zeta = inverse * t.zeta_from_zeta;
    t.zeta_from_wrench = inverse * t.zeta_from_wrench;
    t.zeta = inverse * t.zeta;
}
