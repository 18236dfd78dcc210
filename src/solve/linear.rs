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
    /// Unknowns of the state being tried.
    pub(crate) trial: Unknowns<S>,
    spare: Vec<Configuration<S>>,
}

impl<const S: usize> Default for Buffers<S> {
    fn default() -> Self {
        Self {
            condensed: Vec::new(),
            sweep: Sweep::default(),
            chain: Chain::default(),
            step: Increment { strains: Vec::new(), nodes: Vec::new(), reactions: Vec::new() },
            trial: Unknowns::default(),
            spare: Vec::new(),
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
        self.condense(mesh, unknowns, state)?;
        self.solve_condensed(mesh, state, scale)
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
        let mut joints = state.joints.iter();
        for i in 0..n {
            let element = &mut self.condensed[i];
            element
                .fill(&mesh.table, &mesh.element(i, &unknowns.strains, state))
                .ok_or_else(|| Error::Singular { matrix: "tangent of an element", s: mesh.node_s(i) })?;
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

    /// The strains from the nodes, and the size of it all.
    fn finish<B: Elastic>(&mut self, mesh: &Mesh<'_, B, S>, scale: &Scale) -> Result<Step> {
        let length = scale.length;
        let mut step = Step { size: 0.0, rotation: 0.0 };
        self.step.strains.clear();
        for (i, (zeta, wrench)) in self.step.nodes.iter().enumerate() {
            step.rotation = step.rotation.max(zeta.fixed_rows::<3>(0).norm());
            step.size = step.size.max(zeta.fixed_rows::<3>(3).norm() / length);
            if i < mesh.elements() {
                let increment = self.condensed[i].strain_step(zeta, wrench);
                for strain in &increment {
                    step.size = step.size.max(strain.linear.norm()).max(strain.angular.norm() * length);
                }
                self.step.strains.push(increment);
            }
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
