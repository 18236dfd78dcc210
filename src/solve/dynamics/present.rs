//! The state of a rod in motion at one instant, as the solver has it.

use super::state::State;
use crate::error::{Error, Result};
use crate::lie::{Pose, Strain, Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// Everything a step starts from.
#[derive(Clone)]
pub(super) struct Present<const S: usize> {
    pub(super) time: f64,
    /// The section of the base, those where something acts, and that of the tip.
    pub(super) mounts: Vec<NodeMotion>,
    pub(super) points: Vec<[Moving; S]>,
    /// Work done by damping and by loads since the start, J.
    pub(super) dissipated: f64,
    pub(super) work: f64,
    /// Their rates, W.
    pub(super) power: [f64; 2],
}

/// What moves at one Gauss stage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving {
    pub(super) pose: Pose,
    pub(super) strain: Strain,
    pub(super) strain_rate: Strain,
    /// The algorithmic second derivative of the strain, as generalised-α has it.
    pub(super) strain_second: Strain,
    pub(super) velocity: Twist,
    pub(super) acceleration: Twist,
    /// The algorithmic acceleration of generalised-α.
    pub(super) algorithmic: Twist,
}

/// The same of a section where something acts, whose strain is no unknown.
#[derive(Clone, Copy, Debug)]
pub(super) struct NodeMotion {
    pub(super) pose: Pose,
    pub(super) velocity: Twist,
    pub(super) acceleration: Twist,
    pub(super) algorithmic: Twist,
    /// What its support applies.
    pub(super) reaction: Wrench,
}

impl Moving {
    pub(super) fn still() -> Self {
        let (twist, strain) = (Twist::zero(), Strain::zero());
        Self {
            pose: Pose::identity(),
            strain,
            strain_rate: strain,
            strain_second: strain,
            velocity: twist,
            acceleration: twist,
            algorithmic: twist,
        }
    }
}

impl NodeMotion {
    pub(super) fn still(pose: Pose) -> Self {
        let zero = Twist::zero();
        Self { pose, velocity: zero, acceleration: zero, algorithmic: zero, reaction: Wrench::zero() }
    }
}

impl<const S: usize> Present<S> {
    pub(super) fn base(&self) -> &NodeMotion {
        &self.mounts[0]
    }

    /// All points, base to tip.
    pub(super) fn points(&self) -> impl Iterator<Item = &Moving> {
        self.points.iter().flatten()
    }

    /// The numbers a run can go on from; poses follow from the strains.
    pub(super) fn save(&self) -> State {
        let mut pose = [0.0; 12];
        let base = self.base();
        pose[..9].copy_from_slice(base.pose.rotation.as_slice());
        pose[9..].copy_from_slice(base.pose.position.as_slice());
        let motion = |m: &NodeMotion| {
            let reaction = m.reaction.to_array();
            [m.velocity.to_array(), m.acceleration.to_array(), m.algorithmic.to_array(), reaction]
        };
        State {
            time: self.time,
            stages: S,
            base_pose: pose,
            mounts: self.mounts.iter().map(motion).collect(),
            strain: self.points().map(|p| p.strain.to_array()).collect(),
            strain_rate: self.points().map(|p| p.strain_rate.to_array()).collect(),
            strain_second: self.points().map(|p| p.strain_second.to_array()).collect(),
            velocity: self.points().map(|p| p.velocity.to_array()).collect(),
            acceleration: self.points().map(|p| p.acceleration.to_array()).collect(),
            algorithmic: self.points().map(|p| p.algorithmic.to_array()).collect(),
            dissipated: self.dissipated,
            work: self.work,
            power: self.power,
            kept: None,
            memory: None,
        }
    }

    /// Refuses a state of another mesh, or with a number that is not finite.
    fn check(state: &State, n: usize, mounts: usize) -> Result<()> {
        let parts = [
            &state.strain,
            &state.strain_rate,
            &state.strain_second,
            &state.velocity,
            &state.acceleration,
            &state.algorithmic,
        ];
        if state.mounts.len() != mounts {
            let quantity = "number of places in the saved state where something acts on the rod";
            let requirement = "that of the scene";
            return Err(Error::Invalid { quantity, value: state.mounts.len() as f64, requirement });
        }
        if state.stages != S || parts.iter().any(|part| part.len() != n) {
            let quantity = "number of Gauss stages in the saved state";
            let requirement = "that of the mesh and order of the solver";
            return Err(Error::Invalid { quantity, value: state.strain.len() as f64, requirement });
        }
        let numbers = parts.iter().flat_map(|part| part.iter().flatten()).chain(&state.base_pose);
        if let Some(&value) = numbers.chain(state.mounts.iter().flatten().flatten()).find(|v| !v.is_finite())
        {
            return Err(Error::Invalid {
                quantity: "number of the saved state",
                value,
                requirement: "finite",
            });
        }
        Ok(())
    }

    /// From saved numbers. Poses but that of the base are left to be found.
    pub(super) fn restore(state: &State, elements: usize, mounts: usize) -> Result<Self> {
        Self::check(state, S * elements, mounts)?;
        let point = |j: usize| Moving {
            pose: Pose::identity(),
            strain: Strain::from_array(state.strain[j]),
            strain_rate: Strain::from_array(state.strain_rate[j]),
            strain_second: Strain::from_array(state.strain_second[j]),
            velocity: Twist::from_array(state.velocity[j]),
            acceleration: Twist::from_array(state.acceleration[j]),
            algorithmic: Twist::from_array(state.algorithmic[j]),
        };
        let motion = |[velocity, acceleration, algorithmic, reaction]: &[[f64; 6]; 4], pose| NodeMotion {
            pose,
            velocity: Twist::from_array(*velocity),
            acceleration: Twist::from_array(*acceleration),
            algorithmic: Twist::from_array(*algorithmic),
            reaction: Wrench::from_array(*reaction),
        };
        let pose = Pose::new(
            Matrix3::from_column_slice(&state.base_pose[..9]),
            Vector3::from_column_slice(&state.base_pose[9..]),
        );
        Ok(Self {
            time: state.time,
            mounts: state.mounts.iter().map(|numbers| motion(numbers, pose)).collect(),
            points: (0..elements).map(|i| std::array::from_fn(|k| point(S * i + k))).collect(),
            dissipated: state.dissipated,
            work: state.work,
            power: state.power,
        })
    }
}
