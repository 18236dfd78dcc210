//! Write a load: as a closure, as a type, and one that asks something new of the body.
//!
//! [`load`](crate::load) lists the loads at hand. Loads are given in the frame of the section they act on, per length of the reference.
//!
//! # As a closure
//!
//! Over a dual pose, from which the derivative follows. A potential if there is one, else the wrench:
//!
//! ```
//! use hyperrod::load::{LoadDual, PotentialDual, distributed, potential};
//! use hyperrod::{Pose, Wrench};
//! use nalgebra::{Vector3, vector};
//!
//! // a bed of springs at Z = 0, 2 kN/m²: energy per length
//! let bed = potential(|_s, pose: &Pose<PotentialDual>| pose.position.z * pose.position.z * (0.5 * 2e3));
//! // a wind along X, 3 N/m, that keeps its direction in space
//! let wind = distributed(|_s, pose: &Pose<LoadDual>| {
//!     let force = pose.rotation.tr_mul(&vector![3.0, 0.0, 0.0].map(LoadDual::from)); // into the body frame
//!     Wrench::new(Vector3::zeros(), force)
//! });
//! # let _ = (bed, wind);
//! ```
//!
//! # A load with a new need
//!
//! Gravity needs a mass, buoyancy an area. Neither is known to every body, and a scene that asks for one of them must not compile without
//! it. The pattern is a **capability**: a trait that says what is needed, and a load on bodies that have it. It can be done outside
//! the crate. Here, a magnetic field that turns a rod with a magnetisation:
//!
//! ```
//! use hyperrod::body::{Constraint, Elastic};
//! use hyperrod::load::{Load, LoadDual, LoadWrench, distributed};
//! use hyperrod::material::{Reference, Request, Response};
//! use hyperrod::section::Stiffness;
//! use hyperrod::{Body, Pose, Rod, Statics, Strain, Wrench};
//! use nalgebra::{Vector3, vector};
//!
//! /// A body that is magnetised along its axis: what the field asks for.
//! #[diagnostic::on_unimplemented(
//!     message = "`{Self}` is not magnetised, and this load needs that",
//!     note = "wrap the body: `Magnetised { body, moment_per_length }`"
//! )]
//! trait HasMagnetisation {
//!     fn moment_per_length(&self, s: f64) -> f64; // A m
//! }
//!
//! /// Any body, with a magnetic moment per length.
//! struct Magnetised<B> { body: B, moment_per_length: f64 }
//!
//! impl<B: Send + Sync> HasMagnetisation for Magnetised<B> {
//!     fn moment_per_length(&self, _s: f64) -> f64 { self.moment_per_length }
//! }
//!
//! /// It is as elastic as the body inside.
//! impl<B: Elastic> Elastic for Magnetised<B> {
//!     fn length(&self) -> f64 { self.body.length() }
//!     fn reference(&self, s: f64) -> Reference { self.body.reference(s) }
//!     fn respond(&self, s: f64, strain: &Strain, request: Request) -> hyperrod::Result<Response> {
//!         self.body.respond(s, strain, request)
//!     }
//!     fn constraint(&self) -> Constraint { self.body.constraint() }
//!     fn breakpoints(&self) -> Vec<f64> { self.body.breakpoints() }
//! }
//!
//! /// A uniform field: the couple m × B on every length of the rod.
//! struct Field(Vector3<f64>); // T
//!
//! impl<B: HasMagnetisation> Load<B> for Field {
//!     fn at(&self, body: &B, s: f64, pose: &Pose) -> hyperrod::Result<LoadWrench> {
//!         let (field, moment) = (self.0, body.moment_per_length(s));
//!         let couple = distributed(move |_s, pose: &Pose<LoadDual>| {
//!             let in_body = pose.rotation.tr_mul(&field.map(LoadDual::from));
//!             let along = vector![0.0, 0.0, moment].map(LoadDual::from);
//!             Wrench::new(along.cross(&in_body), Vector3::zeros())
//!         });
//!         Load::<B>::at(&couple, body, s, pose) // the closure differentiates itself
//!     }
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let body = Body::new(0.02, Stiffness::diagonal([1e-8, 1e-8, 1e-8, 1.0, 1.0, 3.0])?)?;
//! let needle = Magnetised { body, moment_per_length: 0.05 };
//! let rod = Rod::clamped(needle, Pose::identity()).with_load(Field(vector![5e-3, 0.0, 0.0]));
//! let tip = Statics::default().solve(&rod)?.tip().pose;
//! assert!(tip.position.x > 0.005); // turns towards the field
//! # Ok(()) }
//! ```
//!
//! Why a type and not a number with a default: `docs/decisions/003-mass-is-a-type.md` in the repository.
//!
//! # By hand
//!
//! A load of your own may as well give its derivative itself: [`LoadWrench`](crate::load::LoadWrench) is a wrench, its 6×6 derivative in a
//! displacement ζ of the section (g → g exp ζ^), and its potential energy if it has one. A wrong derivative shows as slow convergence:
//! the last steps of Newton's method must square.
//!
//! Next: [supports and actuators](super::supports).
