//! The equilibria of a rod as a family in its load factor.

use nalgebra::Vector6;

use crate::body::Elastic;
use crate::error::Result;
use crate::lie::Wrench;
use crate::rod::element::frame_change;
use crate::solve::continuation::{Family, Tangents};
use crate::solve::linear::{Buffers, Increment, NodeStep};
use crate::solve::mesh::Mesh;
use crate::solve::newton::scale;
use crate::solve::report::Stability;
use crate::solve::scale::Scale;
use crate::solve::stability::{Chain, chain};
use crate::solve::unknowns::Unknowns;

use super::verdict::stability;

/// On a path an index changes where an eigenvalue changes its sign.
const NEUTRAL_PATH: f64 = 1e-11;

/// By how much the factor is changed to find the step per factor: residuals are linear in it, and a tangent that moves with it is off by this at most.
const PROBE: f64 = 1e-6;

/// The equilibria of a rod on a mesh.
pub(crate) struct RodFamily<'m, 'r, B, const S: usize> {
    pub(crate) mesh: &'m mut Mesh<'r, B, S>,
    pub(crate) buffers: &'m mut Buffers<S>,
}

impl<B: Elastic, const S: usize> RodFamily<'_, '_, B, S> {
    fn newton_step(&mut self, unknowns: &Unknowns<S>, factor: f64) -> Result<Increment<S>> {
        self.mesh.load_factor = factor;
        let mut state = self.buffers.configuration();
        let done = self.mesh.configure(unknowns, &mut state).and_then(|()| {
            let scale = scale(self.mesh, &state);
            self.buffers.newton_step(self.mesh, unknowns, &state, &scale)
        });
        self.buffers.recycle(state);
        done.map(|_| self.buffers.step.clone())
    }
}

impl<B: Elastic, const S: usize> RodFamily<'_, '_, B, S> {
    /// The chain of a state, and its units.
    pub(crate) fn chain(&mut self, state: &Unknowns<S>, factor: f64) -> Option<(Chain, Scale)> {
        self.mesh.load_factor = factor;
        let mut configuration = self.buffers.configuration();
        let found = self.mesh.configure(state, &mut configuration).ok().and_then(|()| {
            let scale = scale(self.mesh, &configuration);
            self.buffers.condense(self.mesh, state, &configuration).ok()?;
            Some((chain(self.mesh, &configuration, &self.buffers.condensed, &scale)?, scale))
        });
        self.buffers.recycle(configuration);
        found
    }

    /// The modes that cost nothing, to within `tolerance`, as steps from a state: strains, displacements and changes of the wrenches.
    pub(crate) fn neutral_modes(
        &mut self,
        state: &Unknowns<S>,
        factor: f64,
        tolerance: f64,
    ) -> Vec<Increment<S>> {
        let Some((chain, scale)) = self.chain(state, factor) else { return Vec::new() };
        let mut configuration = self.buffers.configuration();
        if self.mesh.configure(state, &mut configuration).is_err() {
            return Vec::new();
        }
        let (displacement, wrench) = (scale.displacement(), scale.wrench());
        let at_node = |((zeta, momentum), at): (&NodeStep, &Wrench)| {
            let zeta = Vector6::from_fn(|r, _| zeta[r] * displacement[r]);
            let momentum = Vector6::from_fn(|r, _| momentum[r] * wrench[r]);
            (zeta, momentum + frame_change(at) * zeta * 0.5)
        };
        let step = |mode: Vec<NodeStep>| {
            let nodes: Vec<NodeStep> = mode.iter().zip(&configuration.node_wrench).map(at_node).collect();
            let (elements, starts) = (&self.buffers.condensed, nodes.iter().take(self.mesh.elements()));
            let strains = starts.enumerate();
            let strains =
                strains.map(|(i, (zeta, wrench))| elements.strain_of_node(i, zeta, wrench)).collect();
            let reactions = vec![Vector6::zeros(); self.mesh.rod.joints().len()];
            Increment { strains, nodes, reactions }
        };
        let steps = chain.neutral_modes(tolerance).into_iter().map(step).collect();
        self.buffers.recycle(configuration);
        steps
    }
}

impl<B: Elastic, const S: usize> Family for RodFamily<'_, '_, B, S> {
    type State = Unknowns<S>;
    type Step = Increment<S>;

    fn tangents(&mut self, state: &Unknowns<S>, factor: f64) -> Result<Tangents<Increment<S>>> {
        let correction = self.newton_step(state, factor)?;
        let ahead = self.newton_step(state, factor + PROBE)?;
        let per_factor = self.combined(1.0 / PROBE, &ahead, -1.0 / PROBE, &correction);
        Ok(Tangents { correction, per_factor })
    }

    fn moved(&self, state: &Unknowns<S>, step: &Increment<S>) -> Unknowns<S> {
        let mut moved = Unknowns::default();
        state.moved(step, 1.0, &mut moved);
        moved
    }

    fn combined(&self, a: f64, x: &Increment<S>, b: f64, y: &Increment<S>) -> Increment<S> {
        let strains = x.strains.iter().zip(&y.strains);
        let strains = strains.map(|(x, y)| std::array::from_fn(|k| x[k] * a + y[k] * b)).collect();
        let nodes =
            x.nodes.iter().zip(&y.nodes).map(|(x, y)| (x.0 * a + y.0 * b, x.1 * a + y.1 * b)).collect();
        let reactions = x.reactions.iter().zip(&y.reactions).map(|(x, y)| x * a + y * b).collect();
        Increment { strains, nodes, reactions }
    }

    /// The mean over the rod of δω·δω L² + δν·δν, and the displacement of the base.
    fn product(&self, x: &Increment<S>, y: &Increment<S>) -> f64 {
        let length = self.mesh.rod.body().length();
        let mut sum = 0.0;
        for (i, (x, y)) in x.strains.iter().zip(&y.strains).enumerate() {
            for k in 0..S {
                let weight = self.mesh.h(i) / length * self.mesh.table.b[k];
                let angular = x[k].angular.dot(&y[k].angular) * length * length;
                sum += weight * (angular + x[k].linear.dot(&y[k].linear));
            }
        }
        let (x, y) = (&x.nodes[0].0, &y.nodes[0].0);
        let turn = x.fixed_rows::<3>(0).dot(&y.fixed_rows::<3>(0));
        sum + turn + x.fixed_rows::<3>(3).dot(&y.fixed_rows::<3>(3)) / (length * length)
    }

    fn index(&mut self, state: &Unknowns<S>, factor: f64) -> Option<usize> {
        self.mesh.load_factor = factor;
        let mut configuration = self.buffers.configuration();
        let found = match self.mesh.configure(state, &mut configuration) {
            Ok(()) => stability(self.mesh, state, &configuration, self.buffers, NEUTRAL_PATH),
            Err(_) => Stability::Unknown,
        };
        self.buffers.recycle(configuration);
        match found {
            Stability::Index { unstable, .. } => Some(unstable),
            _ => None,
        }
    }

    fn margin(&mut self, state: &Unknowns<S>, factor: f64, mode: usize) -> Option<f64> {
        self.chain(state, factor)?.0.margin(mode)
    }
}
