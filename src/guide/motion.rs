//! Move a rod: dynamics, damping, a driven clamp, and the modes it swings in.
//!
//! A rod in motion needs a mass, so its body has a density or a mass per length. A [`Scene`](crate::solve::dynamics::Scene) adds what depends on
//! time, [`Dynamics`](crate::solve::dynamics::Dynamics) takes the steps, and every instant is described by a
//! [`Frame`](crate::solve::dynamics::Frame).
//!
//! ```
//! use hyperrod::load::{DeadWrench, Gravity};
//! use hyperrod::material::LinearElastic;
//! use hyperrod::section::{Circle, Section};
//! use hyperrod::solve::dynamics::{Dynamics, Scene, Start, Step};
//! use hyperrod::{Body, Pose, Rod, Statics};
//! use nalgebra::vector;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 5e5 / 3.0)?)?;
//! let arm = Body::new(0.4, section)?.with_density(1000.0)?; // kg/m³
//! let down = vector![-9.81, 0.0, 0.0]; // so the arm, along Z, is clamped horizontally
//! let rod = Rod::clamped(arm, Pose::identity()).with_load(Gravity::new(down)?);
//!
//! // at rest under its weight and a pull to the side, which is let go after a tenth of a second
//! let rest = Statics { elements: 6, ..Statics::default() }.solve(&rod)?;
//! let pull = DeadWrench::force(vector![0.0, 0.02, 0.0])?; // N
//! let scene = Scene::new(&rod).with_tip_load(pull, |t| if t < 0.1 { 1.0 } else { 0.0 });
//! let dynamics = Dynamics { step: Step::Fixed(5e-3), ..Dynamics::default() };
//! let mut track = Vec::new();
//! let start = Start::equilibrium(&rest); // with the loads of the scene at that time
//! dynamics.run(&scene, &start, 0.2, |frame| track.push((frame.time, frame.tip().pose.position.y)))?;
//! assert_eq!(track.len(), 41);
//! assert!(track[20].1 > 1e-4 && track[40].1 < track[20].1); // m, sideways: it swings back
//! # Ok(()) }
//! ```
//!
//! | to | |
//! |---|---|
//! | damp it | [`with_viscosity`](crate::Body::with_viscosity): Kelvin and Voigt's, in Pa s |
//! | move the clamp | [`with_base_motion`](crate::solve::dynamics::Scene::with_base_motion): a pose as a function of time |
//! | move the tip, or a support between | [`with_tip_motion`](crate::solve::dynamics::Scene::with_tip_motion), [`with_support_motion`](crate::solve::dynamics::Scene::with_support_motion) |
//! | hang it on a hinge, hold both ends | [`Rod::between`](crate::Rod::between), as at rest |
//! | push it at s | [`with_point_load`](crate::solve::dynamics::Scene::with_point_load) |
//! | hang a body on it | a [`Payload`](crate::load::Payload): in motion it has inertia |
//! | leave out shear and extension | [`with_constraint`](crate::Body::with_constraint), as at rest |
//! | cut a tendon | the rod without it; on the scene, [`with_actuator`](crate::solve::dynamics::Scene::with_actuator) and the tension as a function of time |
//! | let it fly | [`with_free_base`](crate::solve::dynamics::Scene::with_free_base) |
//! | let the step follow an error | [`Step::Adaptive`](crate::solve::dynamics::Step::Adaptive) |
//! | stop, save and go on later | [`Stepper`](crate::solve::dynamics::Stepper), its `state()` (serde), `resume` |
//! | know its frequencies | [`Dynamics::modes`](crate::solve::dynamics::Dynamics::modes) |
//!
//! A [`Payload`](crate::load::Payload) on the tip has a weight here, and no inertia: a mass at a point is not modelled yet.
//!
//! # Out of the crate
//!
//! A table of what an observer picks is written with `writeln!`. The stages of a frame are [`Node`](crate::solve::Node)s, so
//! [`write_csv`](crate::output::write_csv) and [`Polyline`](crate::output::Polyline) take them: one file a frame makes a film in ParaView.
//!
//! ```
//! use hyperrod::output::Polyline;
//! use hyperrod::solve::{Node, dynamics::Frame};
//!
//! fn save(frame: &Frame, out: impl std::io::Write) -> std::io::Result<()> {
//!     let states: Vec<Node> = frame.stages.iter().map(Node::from).collect();
//!     Polyline::new(&states).with_radius(|_s| 0.01).write(out)
//! }
//! # let _ = |frame: &Frame| save(frame, Vec::new());
//! ```
//!
//! # Is it right?
//!
//! Without damping, and under loads that have a potential and do not vary, `frame.energies.total()` stays as it is: look at it. Halve the step and
//! the mesh and compare; for a step by its error, lower the tolerance. ESDIRK takes energy from waves that its steps are too long for, and the total then falls. A sudden load sends waves along the rod that need small steps; a
//! load that comes on within a few milliseconds needs fewer.
