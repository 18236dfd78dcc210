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
//! A rod that its supports leave free is refused by name, with the direction in which it can move. So is one with [strains fixed](crate::body::Constraint)
//! that is to be where it cannot be. What a support holds that the fixed strains hold already, as all that keeps a planar rod in its plane, is no load on
//! the support: the reaction there is zero.
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
//! A rod owns its loads and actuators, so a sweep makes a rod for every tension. A function that takes any section asks for a
//! [`CrossSection`](crate::section::CrossSection), and for its [`Geometry`](crate::section::Geometry) where a density shall become a mass:
//!
//! ```
//! use hyperrod::body::Density;
//! use hyperrod::load::{Gravity, Payload};
//! use hyperrod::material::NeoHookean;
//! use hyperrod::section::{Circle, Converging, CrossSection, Geometry, Linear, Section, Tendon};
//! use hyperrod::{Body, Pose, Rod, Statics};
//! use nalgebra::{Isometry3, vector};
//! use std::f64::consts::PI;
//!
//! const LENGTH: f64 = 0.2; // m
//!
//! fn arm<C: CrossSection + Geometry>(section: C) -> hyperrod::Result<Rod<Body<C, Density>>> {
//!     let body = Body::new(LENGTH, section)?.with_density(1100.0)?;
//!     let hanging = Pose::from(Isometry3::rotation(vector![PI, 0.0, 0.0])); // along −Z
//!     Ok(Rod::clamped(body, hanging).with_load(Gravity::standard()).with_tip_load(Payload::new(0.020)?))
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let taper = Linear { from: 0.006, to: 0.003, length: LENGTH };
//! let section = Section::new(Circle::new(taper), NeoHookean::new(270e3, 270e3)?)?;
//! let inside = Converging { from: [4e-3, 0.0], to: [2e-3, 0.0], length: LENGTH }; // as the arm tapers, so does the tendon
//! for tension in [0.0, 0.5, 1.0] {
//!     let solution = Statics::to(1e-6).solve(&arm(section.clone().with_actuator(Tendon::new(inside, tension)?))?)?;
//!     let (tip, report) = (solution.tip().pose.position, solution.report());
//!     println!("{tension} N: x {:.5} z {:.5} m, error {:.0e} m, {}", tip.x, tip.z, report.error.position, report.stability);
//!     assert!(tip.x > 0.005 * tension - 1e-9 && report.error.position < 1e-6 * LENGTH);
//! }
//! # Ok(()) }
//! ```
//!
//! Every [`solve`](crate::Statics::solve) begins at rest, so it does not matter which tensions came before. Where several equilibria are stable, as when
//! an arm curls up, neighbours in such a sweep may lie on different branches: a jump in the table, or a coordinate that was zero, shows it.
//! [`solve_from`](crate::Statics::solve_from) begins at the shape of an earlier solution, and stays on its branch.
//!
//! The strain energy that a solution reports contains the energy of its actuators: tension times length, less pressure times volume.
//!
//! In motion a tension or a pressure is a function of time; see [`motion`](super::motion).
//!
//! Next: [read a report](super::reports).
