//! Hold a rod: supports, joints and corners; and move it: tendons and pressure.
//!
//! # Ends
//!
//! [`Rod::clamped`](crate::Rod::clamped) holds the base and leaves the tip free. [`Rod::between`](crate::Rod::between) takes any two
//! [`Support`](crate::rod::Support)s: each of the six freedoms of a section is free, held at a value, or on a spring, in the frame of the
//! support.
//!
//! ```
//! use hyperrod::load::DeadWrench;
//! use hyperrod::rod::{Freedom, Support};
//! use hyperrod::section::Stiffness;
//! use hyperrod::{Body, Pose, Rod, Statics};
//! use nalgebra::{Matrix3, vector};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
//! let far = Pose::new(Matrix3::identity(), vector![0.0, 0.0, 1.0]);
//! let rod = Rod::between(
//!     body,
//!     Support::pinned(Pose::identity()).holding(Freedom::RotationZ, 0.0)?, // or it could turn about itself
//!     Support::pinned(far).releasing([Freedom::Z]),                        // slides along Z
//! )
//! .with_point_load(0.5, DeadWrench::force(vector![1.0, 0.0, 0.0])?)?;
//! let solution = Statics::default().solve(&rod)?;
//! let middle = solution.nodes().iter().find(|node| node.s == 0.5).unwrap();
//! assert!((middle.pose.position.x - 1.0 / 48.0).abs() < 2e-4); // F L³ / 48 EI, nearly
//! # Ok(()) }
//! ```
//!
//! A rod that its supports leave free is refused by name, with the direction in which it can move.
//!
//! # Between the ends
//!
//! | | |
//! |---|---|
//! | a force or moment at s | [`with_point_load`](crate::Rod::with_point_load) |
//! | a support at s | [`with_support`](crate::Rod::with_support) |
//! | a corner at s, for good | [`with_corner`](crate::Rod::with_corner) |
//!
//! There the wrench jumps, the mesh has a node on either side, and `nodes()` has two entries with the same s.
//!
//! # Tendons and pressure
//!
//! They are energies of the strain and belong to the section: put on it with
//! [`with_actuator`](crate::section::CrossSection::with_actuator), several if need be. The pull at the end, the load where it bends, and
//! the stiffness that a tension brings all follow.
//!
//! ```
//! use hyperrod::section::{CrossSection, Stiffness, Tendon};
//! use hyperrod::{Body, Pose, Rod, Statics};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let section = Stiffness::diagonal([4e-3, 4e-3, 3e-3, 50.0, 50.0, 150.0])?
//!     .with_actuator(Tendon::new([8e-3, 0.0], 0.5)?); // parallel to the axis, 8 mm along x; 0.5 N
//! let finger = Body::new(0.2, section)?;
//! let solution = Statics::default().solve(&Rod::clamped(finger, Pose::identity()))?;
//! assert!(solution.tip().pose.position.x > 0.01); // bends towards the tendon
//! # Ok(()) }
//! ```
//!
//! [`PressureChamber`](crate::section::PressureChamber) pushes the other way: the rod bends away from it. An
//! [`Actuator`](crate::section::Actuator) of your own is one generic function, as a law is. Actuators act from s = 0; one that
//! [ends](crate::section::Tendon::ending_at) before the tip gives the mesh a node there.
//!
//! The strain energy that a solution reports contains the energy of its actuators: tension times length, less pressure times volume.
//!
//! In motion a tension or a pressure is a function of time; see [`motion`](super::motion).
//!
//! Next: [read a report](super::reports).
