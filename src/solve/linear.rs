//! One Newton step: the elements condensed, the chain solved, in memory that is kept from step to step.

use nalgebra::Vector6;

use super::chain::Chain;
use super::dead::{DeadSweep, Size, is_dead};
use super::equilibrium::Configuration;
use super::mesh::Mesh;
use super::scale::Scale;
use super::sweep::Sweep;
use super::unknowns::{StageStrains, Unknowns};
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::Pose;
use crate::load::LoadWrench;
use crate::rod::condense::{Condensed, Kind, Loads, Transfer};
use crate::rod::lanes::ELEMENTS;
use crate::rod::planar;

/// By how much a tangent with neutral modes is made stiffer.
const STIFFER: f64 = 1e-7;

/// Elements of more than so many are not kept where they are swept block by block.
const KEPT: usize = 64;

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
    pub(super) condensed: Condensed<S>,
    /// Whether the elements of the last step are all in `condensed`.
    kept: bool,
    /// One block of elements, where no more are kept.
    window: Condensed<S>,
    sweep: Sweep,
    dead: DeadSweep<S>,
    pub(super) chain: Chain,
    /// The last step.
    pub(super) step: Increment<S>,
    /// Modes that cost nothing: no step has a part of them.
    pub(super) neutral: Vec<Increment<S>>,
    /// Unknowns of the state being tried.
    pub(crate) trial: Unknowns<S>,
    spare: Vec<Configuration<S>>,
    /// [`DeadSweep::least_stiffness`] of the last step, 0 where another solved for it.
    pub(super) least_stiffness: f64,
}

impl<const S: usize> Default for Buffers<S> {
    fn default() -> Self {
        Self {
            condensed: Condensed::default(),
            kept: false,
            window: Condensed::default(),
            sweep: Sweep::default(),
            dead: DeadSweep::default(),
            chain: Chain::default(),
            step: Increment { strains: Vec::new(), nodes: Vec::new(), reactions: Vec::new() },
            neutral: Vec::new(),
            trial: Unknowns::default(),
            spare: Vec::new(),
            least_stiffness: 0.0,
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
            if let Some(step) = self.dead_step(mesh, unknowns, state, scale)? {
                return Ok(step);
            }
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
        self.least_stiffness = 0.0;
        let swept = mesh.is_cantilever() && {
            let (tip, nodes) = (&state.tip_load.tangent, &mut self.step.nodes);
            self.sweep.solve(&self.condensed, &state.node_wrench, tip, scale, nodes).is_some()
        };
        if !swept {
            self.solve_with_pivoting(mesh, state, scale)?;
        }
        self.finish(mesh, scale)
    }

    /// The step of a cantilever under dead forces alone, with the elements condensed and swept block by block. `None` for another, and where the
    /// sweep breaks.
    pub(super) fn dead_step<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        unknowns: &Unknowns<S>,
        state: &Configuration<S>,
        scale: &Scale,
    ) -> Result<Option<Step>> {
        let (n, wrenches, tip) = (mesh.elements(), &state.node_wrench, &state.tip_load.tangent);
        let bare = mesh.is_cantilever() && mesh.rod.joints().is_empty() && state.defect.is_empty();
        if !(bare && is_dead(tip, &wrenches[n])) {
            return Ok(None);
        }
        let kind = kind_of_elements(mesh, state);
        if kind.loads > Loads::Dead {
            return Ok(None);
        }
        // what is small is kept, for a verdict
        self.kept = n <= KEPT;
        let elements = if self.kept { &mut self.condensed } else { &mut self.window };
        elements.begin(if self.kept { n } else { 1 }, &kind);
        self.dead.begin(elements, n, tip);
        let element = |i: usize| mesh.element(i, &unknowns.strains, state);
        for first in (0..n).step_by(ELEMENTS).rev() {
            let block = first..n.min(first + ELEMENTS);
            let place = if self.kept { first } else { 0 };
            elements
                .fill(&mesh.table, &kind, place, block.clone(), element, wrenches)
                .map_err(|i| Error::Singular { matrix: "tangent of an element", s: mesh.node_s(i) })?;
            if self.dead.back(elements, place, block, wrenches).is_none() {
                return Ok(None);
            }
        }
        self.least_stiffness = self.dead.least_stiffness();
        self.step.reactions.clear();
        Ok(self.dead.forward(wrenches, kind.plane, scale, &mut self.step))
    }

    /// The elements of the last step, or of the state where they were not kept.
    pub(super) fn condensed_of<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        unknowns: &Unknowns<S>,
        state: &Configuration<S>,
    ) -> Result<&Condensed<S>> {
        if !self.kept {
            self.condense(mesh, unknowns, state)?;
        }
        Ok(&self.condensed)
    }

    /// The transfers of the elements, joints without a support taken into the element before them.
    pub(super) fn condense<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        unknowns: &Unknowns<S>,
        state: &Configuration<S>,
    ) -> Result<()> {
        let n = mesh.elements();
        let kind = kind_of_elements(mesh, state);
        self.kept = true;
        self.condensed.begin(n, &kind);
        let element = |i: usize| mesh.element(i, &unknowns.strains, state);
        for first in (0..n).step_by(ELEMENTS) {
            let block = first..n.min(first + ELEMENTS);
            self.condensed
                .fill(&mesh.table, &kind, first, block, element, &state.node_wrench)
                .map_err(|i| Error::Singular { matrix: "tangent of an element", s: mesh.node_s(i) })?;
        }
        self.condensed.add_defect(state.defect.iter().map(|defect| defect.to_vector()));
        let mut joints = state.joints.iter();
        if mesh.rod.joints().is_empty() {
            return Ok(());
        }
        for i in 0..n {
            let Some(j) = mesh.joint_at(i + 1) else { continue };
            let Some(joint) = joints.next() else { continue };
            let fixed = &mesh.rod.joints()[j];
            if fixed.fixture.support.is_free() {
                self.condensed.pass(i, |transfer| pass(transfer, &fixed.corner, &joint.load));
            }
        }
        Ok(())
    }

    /// The strains from the nodes, and the size of it all.
    fn finish<B: Elastic>(&mut self, mesh: &Mesh<'_, B, S>, scale: &Scale) -> Result<Step> {
        let Increment { strains, nodes, .. } = &mut self.step;
        self.condensed.strain_steps(&nodes[..mesh.elements()], strains);
        self.measured(scale.length)
    }

    /// How large the step is.
    fn measured(&self, length: f64) -> Result<Step> {
        let mut size = Size::default();
        self.step.nodes.iter().for_each(|(zeta, wrench)| size.add_node(zeta, wrench));
        size.add_strains(self.step.strains.as_flattened());
        size.step(length).ok_or(Error::Singular { matrix: "tangent of the rod", s: length })
    }
}

/// What the elements of a state have in common.
pub(super) fn kind_of_elements<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    state: &Configuration<S>,
) -> Kind {
    let (loads, dead) = (state.loads.as_flattened(), state.dead.as_flattened());
    let inside = || planar::carries(&state.node_wrench) && planar::carries(&state.end_wrench);
    let lie_there = || loads.iter().all(planar::has) && dead.iter().all(|force| force.y == 0.0);
    let plane = mesh.is_planar && inside() && lie_there();
    let none = if dead.is_empty() { Loads::None } else { Loads::Dead };
    let kinds = loads.iter().map(Loads::of);
    let none = if state.by_strain.is_empty() { none } else { Loads::Placed };
    let loads = kinds.fold(none, |all, one| if one > all { one } else { all });
    Kind { constraint: mesh.rod.body().constraint(), plane: plane && loads < Loads::Placed, loads }
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
