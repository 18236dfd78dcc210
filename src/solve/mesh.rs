//! Where the elements of a rod lie, and what is known about it there before anything is solved.

use std::sync::Arc;

use nalgebra::Vector3;

use super::redundant::Redundant;
use super::unknowns::StageStrains;
use crate::body::Elastic;
use crate::lie::{Pose, Strain, Twist};
use crate::rod::Rod;
use crate::rod::collocation::Collocation;
use crate::rod::element::Kinematics;
use crate::rod::planar;
use crate::rod::support::Support;

/// A mesh of collocation elements on a rod, of lengths that may differ.
pub(crate) struct Mesh<'a, B, const S: usize> {
    pub(crate) rod: &'a Rod<B>,
    pub(crate) table: Collocation<S>,
    /// Arc lengths of the nodes, from 0 to L; every joint and every [breakpoint](Elastic::breakpoints) of the body is one of them.
    nodes: Vec<f64>,
    /// Node and number of every joint, along the rod.
    joints: Vec<(usize, usize)>,
    /// s of the stages.
    places: Vec<[f64; S]>,
    /// ξ* at the stages.
    reference: Vec<[Twist; S]>,
    /// Whether the rod lies in its plane at rest, and its constraint keeps its strains there.
    pub(crate) is_planar: bool,
    /// The sum of all loads at the stages where each of them is [dead](crate::load::Load::dead_force), in space; else none, as without loads.
    pub(crate) dead: Vec<[Vector3<f64>; S]>,
    /// Whether there is a load that depends on the strain [and its rate](crate::load::Load::rate).
    pub(crate) is_rated: bool,
    /// Where a solve starts.
    pub(crate) start: Start,
    /// What supports need not hold.
    redundant: Option<Arc<Redundant>>,
    /// The loads are multiplied by this, and the supports have come this part of the way from the start to what they hold.
    pub(crate) load_factor: f64,
}

/// The reference shape, placed where a solve starts.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub(crate) base: Pose,
    /// χ of the tip against its support.
    pub(crate) tip: [f64; 6],
    /// χ of the joints against theirs.
    pub(crate) joints: Vec<[f64; 6]>,
}

impl<'a, B: Elastic, const S: usize> Mesh<'a, B, S> {
    /// So many elements, of equal length but for joints and breakpoints; more where those ask for more.
    pub(crate) fn uniform(rod: &'a Rod<B>, elements: usize) -> Self {
        Self::with_stops(rod, elements, &[])
    }

    /// As [`uniform`](Self::uniform), with nodes at more places.
    pub(crate) fn with_stops(rod: &'a Rod<B>, elements: usize, places: &[f64]) -> Self {
        let length = rod.body().length();
        let mut stops: Vec<f64> = rod.joints().iter().map(|joint| joint.s).collect();
        let breaks = rod.body().breakpoints();
        stops.extend(breaks.iter().chain(places).filter(|s| **s > 0.0 && **s < length));
        stops.push(length);
        stops.sort_by(f64::total_cmp);
        stops.dedup();
        let mut nodes = vec![0.0];
        let mut from = 0.0;
        for to in stops {
            let share = (elements as f64 * (to - from) / length).round().max(1.0) as usize;
            nodes.extend((1..share).map(|i| from + (to - from) * (i as f64 / share as f64)));
            nodes.push(to);
            from = to;
        }
        let mut mesh = Self::at(rod, nodes, Collocation::gauss());
        if !mesh.is_cantilever() {
            mesh.redundant = Redundant::of(rod, &mesh.start.base).map(Arc::new);
        }
        mesh
    }

    /// With these nodes, from 0 to L, the joints and breakpoints among them.
    pub(crate) fn at(rod: &'a Rod<B>, nodes: Vec<f64>, table: Collocation<S>) -> Self {
        let joints = rod.joints().iter().enumerate();
        let joints = joints.map(|(j, joint)| (nodes.partition_point(|s| *s < joint.s), j)).collect();
        let base = &rod.base_fixture().support;
        let start = Start { base: base.pose_at(&base.held()), tip: [0.0; 6], joints: Vec::new() };
        let mut mesh = Self {
            rod,
            table,
            nodes,
            joints,
            places: Vec::new(),
            reference: Vec::new(),
            is_planar: false,
            dead: Vec::new(),
            is_rated: false,
            start,
            redundant: None,
            load_factor: 1.0,
        };
        mesh.places = (0..mesh.elements()).map(|i| std::array::from_fn(|k| mesh.stage_s(i, k))).collect();
        let twists = |places: &[f64; S]| places.map(|s| rod.body().reference(s).twist);
        mesh.reference = mesh.places.iter().map(twists).collect();
        mesh.is_planar =
            planar::keeps(&rod.body().constraint()) && planar::contains(mesh.reference.as_flattened());
        mesh.is_rated = rod.has_rate_loads();
        mesh.dead = mesh.dead_forces().unwrap_or_default();
        if !mesh.is_cantilever() {
            mesh.start = mesh.placed();
        }
        mesh
    }

    /// See [`dead`](Self::dead). A load that fails does so again, with its error, when it is asked in full.
    fn dead_forces(&self) -> Option<Vec<[Vector3<f64>; S]>> {
        if self.rod.loads().is_empty() || self.is_rated {
            return None;
        }
        let mut all = vec![[Vector3::zeros(); S]; self.elements()];
        for (sum, s) in all.as_flattened_mut().iter_mut().zip(self.places.as_flattened()) {
            for load in self.rod.loads() {
                *sum += load.dead_force(self.rod.body(), *s).ok()??;
            }
            if !sum.iter().all(|v| v.is_finite()) {
                return None;
            }
        }
        Some(all)
    }

    /// The mesh with element i cut into `parts[i]` equal pieces.
    pub(crate) fn refined(&self, parts: &[usize]) -> Self {
        let mut nodes = vec![self.nodes[0]];
        for (i, &count) in parts.iter().enumerate() {
            for part in 1..count {
                nodes.push(self.nodes[i] + self.h(i) * (part as f64 / count as f64));
            }
            nodes.push(self.nodes[i + 1]);
        }
        let (load_factor, redundant) = (self.load_factor, self.redundant.clone());
        Self { load_factor, redundant, ..Self::at(self.rod, nodes, self.table.clone()) }
    }

    /// Whether the base is clamped in the frame of its support and nothing else holds the rod.
    pub(crate) fn is_cantilever(&self) -> bool {
        let base = &self.rod.base_fixture().support;
        base.is_clamped() && self.rod.tip_fixture().support.is_free() && !self.has_interior_supports()
    }

    pub(crate) fn has_interior_supports(&self) -> bool {
        self.rod.joints().iter().any(|joint| !joint.fixture.support.is_free())
    }

    /// The reference shape, placed by the first support that holds it.
    fn placed(&self) -> Start {
        let (base, tip) = (&self.rod.base_fixture().support, &self.rod.tip_fixture().support);
        let (to_joint, to_tip) = self.reference_poses();
        let held = |support: &Support| support.pose_at(&support.held());
        let joints = self.rod.joints().iter().zip(&to_joint);
        let first = if !base.is_free() {
            held(base)
        } else if !tip.is_free() {
            held(tip) * to_tip.inverse()
        } else {
            let mut held_joints = joints.clone().filter(|(joint, _)| !joint.fixture.support.is_free());
            held_joints
                .next()
                .map_or_else(Pose::identity, |(joint, to)| held(&joint.fixture.support) * to.inverse())
        };
        Start {
            base: first,
            tip: tip.coordinates(&(first * to_tip)),
            joints: joints.map(|(joint, to)| joint.fixture.support.coordinates(&(first * *to))).collect(),
        }
    }

    /// Poses of the joints (before their corners) and of the tip in the frame of the base, at rest.
    fn reference_poses(&self) -> (Vec<Pose>, Pose) {
        let mut pose = Pose::identity();
        let mut at_joints = Vec::new();
        for i in 0..self.elements() {
            pose = pose * Kinematics::new(&self.table, &self.reference[i], self.h(i)).end;
            if let Some(j) = self.joint_at(i + 1) {
                at_joints.push(pose);
                pose = pose * self.rod.joints()[j].corner;
            }
        }
        (at_joints, pose)
    }

    /// The joint at a node.
    pub(crate) fn joint_at(&self, node: usize) -> Option<usize> {
        if self.joints.is_empty() {
            return None;
        }
        let found = self.joints.binary_search_by_key(&node, |(at, _)| *at);
        found.ok().map(|k| self.joints[k].1)
    }

    /// What the supports hold at the load factor, from where the start has it.
    pub(crate) fn target(&self, support: &Support, start: &[f64; 6]) -> [f64; 6] {
        let held = support.held();
        if self.load_factor == 1.0 {
            return held;
        }
        std::array::from_fn(|j| start[j] + self.load_factor * (held[j] - start[j]))
    }

    /// What supports need not hold.
    pub(crate) fn redundant(&self) -> Option<&Redundant> {
        self.redundant.as_deref()
    }

    /// The support of the tip, as far as it holds something that fixed strains do not.
    pub(crate) fn tip_support(&self) -> Support {
        let support = &self.rod.tip_fixture().support;
        self.redundant.as_ref().map_or(*support, |redundant| redundant.at_tip(support))
    }

    /// The same of a joint.
    pub(crate) fn joint_support(&self, j: usize) -> Support {
        let support = &self.rod.joints()[j].fixture.support;
        self.redundant.as_ref().map_or(*support, |redundant| redundant.at_joint(j, support))
    }

    pub(crate) fn elements(&self) -> usize {
        self.nodes.len() - 1
    }

    /// Length of an element.
    pub(crate) fn h(&self, i: usize) -> f64 {
        self.nodes[i + 1] - self.nodes[i]
    }

    pub(crate) fn node_s(&self, i: usize) -> f64 {
        self.nodes[i]
    }

    pub(crate) fn stage_s(&self, i: usize, k: usize) -> f64 {
        self.nodes[i] + self.table.c[k] * self.h(i)
    }

    /// [`stage_s`](Self::stage_s) of some elements.
    pub(crate) fn stage_places(&self, elements: std::ops::Range<usize>) -> &[[f64; S]] {
        &self.places[elements]
    }

    /// ξ = ξ* + Δξ at the stages of element i.
    #[inline(always)]
    pub(crate) fn twists(&self, i: usize, strains: &[Strain; S]) -> [Twist; S] {
        // one by one: more at a time would be a call that copies
        let mut twists = [Twist::zero(); S];
        for (twist, (reference, strain)) in twists.iter_mut().zip(self.reference[i].iter().zip(strains)) {
            *twist = *reference + *strain;
        }
        twists
    }

    /// The strain polynomial of an element at τ ∈ [0, 1].
    pub(crate) fn interpolate(&self, element: &[Strain; S], tau: f64) -> Strain {
        let weights = self.table.interpolation(tau);
        element.iter().zip(weights).fold(Strain::zero(), |sum, (strain, weight)| sum + *strain * weight)
    }

    /// The strains of this mesh interpolated onto [`refined`](Self::refined) with the same parts: from the stages, and from the ends of the
    /// elements where it is known by how much the strains there differ.
    ///
    /// The term that puts the ends right vanishes at the stages: Π(τ − c_k) times a linear function.
    pub(crate) fn prolong(
        &self,
        strains: &StageStrains<S>,
        parts: &[usize],
        ends: Option<&[[Strain; 2]]>,
    ) -> StageStrains<S> {
        let vanishing = |tau: f64| self.table.c.iter().fold(1.0, |product, c| product * (tau - c));
        let at_ends = [vanishing(0.0), vanishing(1.0)];
        let mut fine = Vec::with_capacity(parts.iter().sum());
        for (i, (element, &count)) in strains.iter().zip(parts).enumerate() {
            for part in 0..count {
                fine.push(std::array::from_fn(|k| {
                    let tau = (part as f64 + self.table.c[k]) / count as f64;
                    let inside = self.interpolate(element, tau);
                    let Some([first, last]) = ends.map(|ends| ends[i]) else { return inside };
                    let weight = vanishing(tau);
                    let [a, b] = [weight * (1.0 - tau) / at_ends[0], weight * tau / at_ends[1]];
                    inside + first * a + last * b
                }));
            }
        }
        fine
    }
}
