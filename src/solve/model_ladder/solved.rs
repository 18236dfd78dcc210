use super::model::{AtRest, Model};
use super::suggestion::{LeftOut, ModelError};
use crate::body::Elastic;
use crate::lie::Wrench;
use crate::rod::Rod;
use crate::rod::collocation::Collocation;
use crate::solve::equilibrium::Configuration;
use crate::solve::failure::{Failure, Reason};
use crate::solve::linear::Buffers;
use crate::solve::mesh::Mesh;
use crate::solve::newton;
use crate::solve::report::Report;
use crate::solve::solution::StaticSolution;
use crate::solve::statics::{Order, Statics};
use crate::solve::unknowns::Unknowns;

/// Gauss stages of an element of order 6.
const STAGES: usize = 3;

/// Elements of the first mesh; the error is looked for at its nodes.
const ELEMENTS: usize = 16;

/// Meshes tried, each twice as fine.
const MESHES: u32 = 4;

/// Of the tolerance, what the mesh may take.
const MESH_SHARE: f64 = 0.1;

/// The answer of the scene as it is, with all that a linear solve about it needs.
pub(super) struct Solved<'r, B> {
    mesh: Mesh<'r, B, STAGES>,
    unknowns: Unknowns<STAGES>,
    state: Configuration<STAGES>,
    buffers: Buffers<STAGES>,
    mesh_error: f64,
}

impl<'r, B: Elastic> Solved<'r, B> {
    /// On a mesh whose error is well below the tolerance.
    pub(super) fn to(rod: &'r Rod<B>, tolerance: f64) -> Result<Self, Box<Failure>> {
        let (asked, length) = (MESH_SHARE * tolerance, rod.body().length());
        let mut elements = ELEMENTS;
        let mut solution = Self::solution(rod, elements)?;
        for _ in 1..MESHES {
            if position_error(&solution, length) <= asked {
                break;
            }
            elements *= 2;
            solution = Self::solution(rod, elements)?;
        }
        let estimated = position_error(&solution, length);
        if estimated <= asked {
            return Self::about(rod, &solution);
        }
        let reason = Reason::Accuracy { asked, estimated, elements };
        Err(Box::new(Failure { reason, report: solution.report().clone(), last: Some(solution) }))
    }

    fn solution(rod: &Rod<B>, elements: usize) -> Result<StaticSolution, Box<Failure>> {
        Statics { elements, order: Order::Six, ..Statics::default() }.solve(rod)
    }

    /// Mesh and unknowns of the solver, read back from its answer.
    fn about(rod: &'r Rod<B>, solution: &StaticSolution) -> Result<Self, Box<Failure>> {
        let mut nodes: Vec<f64> = solution.nodes().iter().map(|node| node.s).collect();
        nodes.dedup(); // a joint has a node on either side
        let mesh = Mesh::at(rod, nodes, Collocation::gauss());
        let (stages, _) = solution.stages().as_chunks::<STAGES>();
        let mut unknowns = Unknowns::at_rest(&mesh);
        unknowns.strains = stages.iter().map(|stages| std::array::from_fn(|k| stages[k].strain)).collect();
        unknowns.base = solution.base().pose;
        unknowns.tip = solution.tip().wrench;
        let mut state = Configuration::default();
        let unsolved = |error| {
            let report = solution.report().clone();
            Box::new(Failure { reason: Reason::Start(error), report, last: Some(solution.clone()) })
        };
        mesh.configure(&unknowns, &mut state).map_err(unsolved)?;
        if !state.joints.is_empty() {
            // what the supports give is what the wrenches on both sides of a joint leave
            let pairs = solution.nodes().windows(2).filter(|pair| pair[0].s == pair[1].s);
            for (j, (pair, joint)) in pairs.zip(&state.joints).enumerate() {
                let corner = rod.joints()[j].corner.adjoint_inverse();
                let after = corner.apply_transpose(&pair[1].wrench);
                unknowns.reactions[j] = pair[0].wrench - after - joint.load.wrench;
            }
            mesh.configure(&unknowns, &mut state).map_err(unsolved)?;
        }
        let mesh_error = position_error(solution, rod.body().length());
        Ok(Self { mesh, unknowns, state, buffers: Buffers::default(), mesh_error })
    }

    /// Of positions / L and of rotations.
    pub(super) fn mesh_error(&self) -> f64 {
        self.mesh_error
    }

    /// The sections at their reference strain, at the stages.
    pub(super) fn at_rest(&self) -> Result<AtRest, Box<Failure>> {
        let places = self.mesh.stage_places(0..self.mesh.elements()).as_flattened().to_vec();
        AtRest::of(self.mesh.rod.body(), places)
            .map_err(|error| Failure::stateless(Reason::Start(error), Report::default()))
    }

    /// What a simpler model does to the answer, to first order, and the work it leaves out.
    pub(super) fn error_of(&mut self, model: &Model<'_>) -> (ModelError, Option<LeftOut>) {
        let mut state = self.state.clone();
        let (mut work, mut total) = ([0.0; 6], 0.0);
        for i in 0..self.mesh.elements() {
            for k in 0..STAGES {
                let (s, strain) = (self.mesh.stage_s(i, k), self.unknowns.strains[i][k]);
                let response = &mut state.response[i][k];
                let Some(simple) = model.strain_of(s, &response.wrench, &strain) else {
                    return (ModelError::unknown(s), None);
                };
                let missing = strain - simple;
                let weight = self.mesh.h(i) * self.mesh.table.b[k];
                total += weight * strain.pair(&response.wrench).abs();
                let (wrench, change) = (response.wrench.to_array(), missing.to_array());
                (0..6).for_each(|c| work[c] += weight * wrench[c] * change[c]);
                response.wrench += Wrench::from_vector(&(response.tangent * missing.to_vector()));
            }
        }
        let error = self.displacement(&state);
        (error, LeftOut::of(&work, total))
    }

    /// The largest displacement and rotation of a node in a Newton step about the answer with that state.
    fn displacement(&mut self, state: &Configuration<STAGES>) -> ModelError {
        let scale = newton::scale(&self.mesh, &self.state);
        if self.buffers.newton_step(&self.mesh, &self.unknowns, state, &scale).is_err() {
            return ModelError::unknown(0.0);
        }
        let mut error = ModelError::default();
        for (node, (zeta, _)) in self.buffers.step.nodes.iter().enumerate() {
            let position = zeta.fixed_rows::<3>(3).norm();
            if position > error.position {
                (error.position, error.s) = (position, self.mesh.node_s(node));
            }
            error.rotation = error.rotation.max(zeta.fixed_rows::<3>(0).norm());
        }
        error
    }
}

fn position_error(solution: &StaticSolution, length: f64) -> f64 {
    let error = &solution.report().error;
    (error.position / length).max(error.rotation)
}
