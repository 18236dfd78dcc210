use nalgebra::{Vector3, Vector6};

use super::core::Core;
use super::present::Present;
use super::scene::{Movable, Scene};
use crate::error::Result;
use crate::lie::{Pose, Strain, Twist, Wrench};
use crate::material::Request;
use crate::rod::adjoint::brought;

/// A node of a rod in motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MovingNode {
    /// Arc length s, m.
    pub s: f64,
    /// Pose g.
    pub pose: Pose,
    /// Body velocity η of the section.
    pub velocity: Twist,
    /// Internal wrench Λ, body frame.
    pub wrench: Wrench,
}

/// A Gauss stage of a rod in motion, where its unknowns are.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MovingStage {
    /// Arc length s, m.
    pub s: f64,
    /// Pose g.
    pub pose: Pose,
    /// Strain Δξ.
    pub strain: Strain,
    /// Rate of strain ξ̇, 1/s.
    pub strain_rate: Strain,
    /// Body velocity η.
    pub velocity: Twist,
    /// Body acceleration η̇.
    pub acceleration: Twist,
    /// Internal wrench Ψ + V ξ̇, body frame.
    pub wrench: Wrench,
}

/// Where the energy of a rod in motion is, J.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energies {
    /// ½ ∫ηᵀ M η ds.
    pub kinetic: f64,
    /// ∫U ds.
    pub elastic: f64,
    /// Of the loads, and of the springs of supports; `None` where one of them has no potential. That of a load that varies in time is its present one.
    pub potential: Option<f64>,
    /// What damping took since the start, ∫∫ξ̇ᵀ V ξ̇ ds dt.
    pub dissipated: f64,
    /// What loads, springs of supports and supports that move gave since the start; followed if [`Dynamics::track_work`](super::Dynamics::track_work) says so,
    /// otherwise zero.
    pub work: f64,
}

impl Energies {
    /// Kinetic, elastic and potential energy together: constant without damping, under loads that have a potential and do not vary.
    pub fn total(&self) -> Option<f64> {
        self.potential.map(|potential| self.kinetic + self.elastic + potential)
    }
}

/// A rod in motion at one instant, described.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Frame {
    /// Time, s.
    pub time: f64,
    /// Nodes from base to tip; where something acts between the ends there are two with the same s, before and after it.
    pub nodes: Vec<MovingNode>,
    /// Gauss stages from base to tip.
    pub stages: Vec<MovingStage>,
    /// Energies.
    pub energies: Energies,
    /// Linear momentum in space, kg m/s.
    #[cfg_attr(feature = "serde", serde(with = "crate::lie::serialize::vector"))]
    pub linear_momentum: Vector3<f64>,
    /// Angular momentum in space about its origin, kg m²/s.
    #[cfg_attr(feature = "serde", serde(with = "crate::lie::serialize::vector"))]
    pub angular_momentum: Vector3<f64>,
}

impl Frame {
    /// The node at the tip.
    pub fn tip(&self) -> &MovingNode {
        &self.nodes[self.nodes.len() - 1]
    }

    /// The node at the base.
    pub fn base(&self) -> &MovingNode {
        &self.nodes[0]
    }
}

impl<const S: usize> Core<S> {
    /// The velocities of the nodes, by the kinematics of the element from the base and the rates of strain.
    pub(super) fn node_velocities(&self, mut each: impl FnMut(Twist)) {
        let mut velocity = self.base_rates().velocity;
        each(velocity);
        for (i, (legs, rate)) in self.legs.iter().zip(&self.strain_rate).enumerate() {
            if let Some(mount) = self.between(i) {
                velocity = mount.turned_on(&velocity);
            }
            let rate: [Twist; S] = std::array::from_fn(|k| rate[k].as_twist());
            (_, velocity) = legs.velocities(&self.grid.table, self.grid.h(i), &velocity, &rate);
            each(velocity);
        }
    }

    /// Linear momentum, and angular momentum about the origin.
    pub(super) fn momentum(&self) -> Vector6<f64> {
        let mut total = Vector6::zeros();
        let mut add = |momentum: Vector6<f64>, pose: &Pose| {
            total += brought(pose, &Wrench::from_vector(&momentum)).to_vector();
        };
        for (i, rates) in self.rates.iter().enumerate() {
            for k in 0..S {
                let momentum = self.grid.mass[i][k] * rates[k].velocity.to_vector();
                add(momentum * self.grid.weight(i, k), &self.pose[i][k]);
            }
        }
        for (mount, mass) in self.mounts.iter().filter_map(|mount| mount.mass.map(|mass| (mount, mass))) {
            add(mass * mount.rates.velocity.to_vector(), &self.node_pose[mount.node]);
        }
        total
    }

    /// Kinetic and elastic energy, and the potential of loads and of the springs of supports.
    pub(super) fn energies(&self) -> (f64, f64, Option<f64>) {
        let (mut kinetic, mut elastic, mut potential) = (0.0, 0.0, Some(0.0));
        for i in 0..self.grid.elements {
            for k in 0..S {
                let weight = self.grid.weight(i, k);
                let eta = self.rates[i][k].velocity.to_vector();
                kinetic += 0.5 * weight * eta.dot(&(self.grid.mass[i][k] * eta));
                elastic += weight * self.energy[i][k];
                potential = potential.zip(self.load[i][k].potential).map(|(sum, p)| sum + weight * p);
            }
        }
        for mount in &self.mounts {
            if let Some(mass) = &mount.mass {
                let eta = mount.rates.velocity.to_vector();
                kinetic += 0.5 * eta.dot(&(mass * eta));
            }
            let springs = if mount.support.is_free() {
                0.0
            } else {
                mount.support.potential(&self.node_pose[mount.node])
            };
            potential = potential.zip(mount.load.potential).map(|(sum, p)| sum + p + springs);
        }
        (kinetic, elastic, potential)
    }
}

impl<const S: usize> Present<S> {
    /// Puts this state into `core`, with all that follows from it.
    pub(super) fn evaluate<B: Movable>(&self, core: &mut Core<S>, scene: &Scene<'_, B>) -> Result<()> {
        core.at_time(scene, self.time)?;
        self.hold(core);
        core.move_to_strains();
        core.respond(scene, Request::Wrench)?;
        core.balance();
        Ok(())
    }

    /// Describes this state.
    pub(super) fn describe<B: Movable>(&self, core: &mut Core<S>, scene: &Scene<'_, B>) -> Result<Frame> {
        self.evaluate(core, scene)?;
        if !core.loose {
            core.rates_from_velocities();
        }
        let mut velocities = Vec::with_capacity(core.grid.elements + 1);
        core.node_velocities(|velocity| velocities.push(velocity));
        let mut nodes = Vec::with_capacity(velocities.len());
        for (i, velocity) in velocities.into_iter().enumerate() {
            let (s, pose, wrench) = (core.grid.node_s(i), core.node_pose[i], core.node_wrench[i]);
            nodes.push(MovingNode { s, pose, velocity, wrench });
            if let Some(mount) = core.between(i) {
                let (pose, velocity) = (mount.after(&pose), mount.turned_on(&velocity));
                nodes.push(MovingNode { s, pose, velocity, wrench: core.start_wrench[i] });
            }
        }
        let stage = |i: usize, k: usize| MovingStage {
            s: core.grid.stage_s(i, k),
            pose: core.pose[i][k],
            strain: core.strain[i][k],
            strain_rate: core.strain_rate[i][k],
            velocity: core.rates[i][k].velocity,
            acceleration: core.rates[i][k].acceleration,
            wrench: core.wrench[i][k],
        };
        let stages = (0..core.grid.elements * S).map(|j| stage(j / S, j % S)).collect();
        let (kinetic, elastic, potential) = core.energies();
        let momentum = core.momentum();
        Ok(Frame {
            time: self.time,
            nodes,
            stages,
            energies: Energies { kinetic, elastic, potential, dissipated: self.dissipated, work: self.work },
            angular_momentum: momentum.fixed_rows::<3>(0).into(),
            linear_momentum: momentum.fixed_rows::<3>(3).into(),
        })
    }
}
