//! One Newton step: the elements condensed, the chain solved, in memory that is kept from step to step.

use nalgebra::{SMatrix, SVector, Vector6};

use super::chain::{self, EndRows};
use super::equilibrium::{Configuration, Scale};
use super::mesh::{Mesh, StageStrains};
use super::sweep::{Sweep, Tip};
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::rod::condense::Condensed;

/// Displacement ζ and change of wrench δΛ of a node.
pub(crate) type NodeStep = (Vector6<f64>, Vector6<f64>);

/// How large a Newton step is.
pub(crate) struct Step {
    /// As [`Iteration::step`](super::Iteration::step) of a full step.
    pub(crate) size: f64,
    /// The largest rotation of a node, rad.
    pub(crate) rotation: f64,
}

/// Memory of the solves on meshes of one order, kept from iteration to iteration and from solve to solve.
pub(crate) struct Buffers<const S: usize> {
    condensed: Vec<Condensed<S>>,
    sweep: Sweep,
    nodes: Vec<NodeStep>,
    /// δξ of the last step.
    step: StageStrains<S>,
    /// Strains of the state being tried.
    pub(crate) trial: StageStrains<S>,
    spare: Vec<Configuration<S>>,
}

impl<const S: usize> Default for Buffers<S> {
    fn default() -> Self {
        Self {
            condensed: Vec::new(),
            sweep: Sweep::default(),
            nodes: Vec::new(),
            step: Vec::new(),
            trial: Vec::new(),
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

    /// Puts `strains` + fraction × the last step into `trial`.
    pub(crate) fn move_by(&mut self, strains: &StageStrains<S>, fraction: f64) {
        self.trial.clear();
        let pairs = strains.iter().zip(&self.step);
        self.trial.extend(
            pairs.map(|(element, d)| -> [_; S] { std::array::from_fn(|k| element[k] + d[k] * fraction) }),
        );
    }

    /// The Newton step about a state.
    pub(crate) fn newton_step<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        strains: &StageStrains<S>,
        state: &Configuration<S>,
        scale: &Scale,
    ) -> Result<Step> {
        let n = mesh.elements();
        self.condensed.resize_with(n.max(self.condensed.len()), Condensed::empty);
        for i in 0..n {
            self.condensed[i]
                .fill(&mesh.table, &mesh.element(i, strains, state))
                .ok_or_else(|| Error::Singular { matrix: "tangent of an element", s: mesh.node_s(i) })?;
        }
        let elements = &self.condensed[..n];
        let tip = Tip { tangent: &state.tip_load.tangent, alone: mesh.rod.loads().is_empty() };
        if self.sweep.solve(elements, &state.node_wrench, &tip, scale, &mut self.nodes).is_none() {
            self.solve_with_pivoting(mesh, state, scale)?;
        }
        self.increments(mesh, scale)
    }

    /// By elimination with pivoting inside a window of one element, for what the sweep cannot do.
    fn solve_with_pivoting<B: Elastic>(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        state: &Configuration<S>,
        scale: &Scale,
    ) -> Result<()> {
        let mut left = EndRows { matrix: SMatrix::zeros(), rhs: SVector::zeros() };
        left.matrix.fixed_view_mut::<6, 6>(0, 0).fill_with_identity();
        let right = state.tip_rows(scale);
        let transfers: Vec<_> =
            self.condensed[..mesh.elements()].iter().map(|e| scale.transfer(&e.transfer)).collect();
        let nodes = chain::solve(&left, &transfers, &right, |i| mesh.node_s(i))?;
        self.nodes.clear();
        self.nodes.extend(nodes.iter().map(|y| scale.unscale(y)));
        Ok(())
    }

    /// The strains from the nodes, and the size of it all.
    fn increments<B: Elastic>(&mut self, mesh: &Mesh<'_, B, S>, scale: &Scale) -> Result<Step> {
        let length = scale.length;
        let mut step = Step { size: 0.0, rotation: 0.0 };
        self.step.clear();
        for (i, (zeta, wrench)) in self.nodes.iter().enumerate() {
            step.rotation = step.rotation.max(zeta.fixed_rows::<3>(0).norm());
            step.size = step.size.max(zeta.fixed_rows::<3>(3).norm() / length);
            if i < mesh.elements() {
                let increment = self.condensed[i].strain_step(zeta, wrench);
                for strain in &increment {
                    step.size = step.size.max(strain.linear.norm()).max(strain.angular.norm() * length);
                }
                self.step.push(increment);
            }
        }
        step.size = step.size.max(step.rotation);
        if !(step.size.is_finite() && self.nodes.iter().all(|(zeta, _)| zeta.norm().is_finite())) {
            return Err(Error::Singular { matrix: "tangent of the rod", s: length });
        }
        Ok(step)
    }
}
