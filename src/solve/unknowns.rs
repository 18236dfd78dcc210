//! What Newton's method moves: strains at the stages, the pose of the base, and the wrenches that no balance gives.

use super::linear::Increment;
use super::mesh::Mesh;
use super::solution::StaticSolution;
use crate::body::Elastic;
use crate::lie::{Pose, Strain, Twist, Wrench, se3};

/// Strains Δξ at the Gauss stages of every element.
pub(crate) type StageStrains<const S: usize> = Vec<[Strain; S]>;

/// The unknowns of a mesh; everything else follows from them.
#[derive(Clone, Debug)]
pub(crate) struct Unknowns<const S: usize> {
    pub(crate) strains: StageStrains<S>,
    /// g at s = 0.
    pub(crate) base: Pose,
    /// Λ at s = L; where the tip is free, its loads say it and this is of no effect.
    pub(crate) tip: Wrench,
    /// What the supports of the joints apply, in the frame before the corner; zero for a joint without one.
    pub(crate) reactions: Vec<Wrench>,
    /// Λ at the start of every element, where these are unknowns of their own: the balance of an element may then have a defect.
    /// Empty where the balance gives them.
    pub(crate) wrenches: Vec<Wrench>,
}

impl<const S: usize> Default for Unknowns<S> {
    fn default() -> Self {
        Self {
            strains: Vec::new(),
            base: Pose::identity(),
            tip: Wrench::zero(),
            reactions: Vec::new(),
            wrenches: Vec::new(),
        }
    }
}

impl<const S: usize> Unknowns<S> {
    /// The reference shape, without forces.
    pub(crate) fn at_rest<B: Elastic>(mesh: &Mesh<'_, B, S>) -> Self {
        Self {
            strains: vec![[Strain::zero(); S]; mesh.elements()],
            base: mesh.start.base,
            reactions: vec![Wrench::zero(); mesh.rod.joints().len()],
            ..Self::default()
        }
    }

    /// The shape of an earlier solution: its strains, but for those that are fixed now, and its ends where they may move. Reactions, which are found in one
    /// step, are left to Newton's method.
    pub(crate) fn of_earlier<B: Elastic>(mesh: &Mesh<'_, B, S>, earlier: &StaticSolution) -> Self {
        let at_rest = Self::at_rest(mesh);
        let constraint = mesh.rod.body().constraint();
        let strain = |s| constraint.free_part(earlier.strain_near(s));
        let place = |i| std::array::from_fn(|k| strain(mesh.stage_s(i, k)));
        let is_clamped = mesh.rod.base_fixture().support.is_clamped();
        Self {
            strains: (0..mesh.elements()).map(place).collect(),
            base: if is_clamped { at_rest.base } else { earlier.base().pose },
            tip: earlier.tip().wrench,
            ..at_rest
        }
    }

    /// These of a mesh on its [refinement](Mesh::refined) with the same parts; see [`Mesh::prolong`].
    pub(crate) fn prolonged<B: Elastic>(
        &self,
        mesh: &Mesh<'_, B, S>,
        parts: &[usize],
        ends: Option<&[[Strain; 2]]>,
    ) -> Self {
        Self {
            strains: mesh.prolong(&self.strains, parts, ends),
            reactions: self.reactions.clone(),
            wrenches: Vec::new(),
            ..*self
        }
    }

    /// Puts these plus fraction × the increment into `into`.
    pub(crate) fn moved(&self, step: &Increment<S>, fraction: f64, into: &mut Self) {
        into.strains.resize(self.strains.len(), [Strain::zero(); S]);
        let pairs = self.strains.as_flattened().iter().zip(step.strains.as_flattened());
        for (into, (strain, d)) in into.strains.as_flattened_mut().iter_mut().zip(pairs) {
            *into = *strain + *d * fraction;
        }
        let (zeta, _) = step.nodes[0];
        into.base = if zeta == nalgebra::Vector6::zeros() {
            self.base
        } else {
            self.base * se3::exp(&Twist::from_vector(&(zeta * fraction)))
        };
        let plus =
            |wrench: &Wrench, d: &nalgebra::Vector6<f64>| *wrench + Wrench::from_vector(&(d * fraction));
        into.tip = plus(&self.tip, &step.nodes[step.nodes.len() - 1].1);
        into.reactions.clear();
        into.reactions.extend(self.reactions.iter().zip(&step.reactions).map(|(r, d)| plus(r, d)));
        into.wrenches.clear();
        into.wrenches.extend(self.wrenches.iter().zip(&step.nodes).map(|(w, (_, d))| plus(w, d)));
    }
}
