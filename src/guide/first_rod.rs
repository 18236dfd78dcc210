//! From a closure to a bent rod.
//!
//! Five things make a solved rod, each built from the one before:
//!
//! | thing | made of | type |
//! |---|---|---|
//! | a law | a function: the energy density u, J/m³ | anything that is a [`Material`](crate::material::Material) |
//! | a section | a shape filled with it | [`Section`](crate::section::Section) |
//! | a body | a length and the section; a density where something asks for mass | [`Body`](crate::Body) |
//! | a rod | the body, what holds it, what acts on it | [`Rod`](crate::Rod) |
//! | a solution | the rod in equilibrium | [`StaticSolution`](crate::StaticSolution) |
//!
//! # The law
//!
//! A rubber, as a closure of the invariants of the deformation. The macro writes a type for it; `degree 2` says that it is a polynomial of
//! degree 2 in the strain, so that the section can choose a quadrature that is exact.
//!
//! ```
//! use hyperrod::isotropic;
//!
//! let (c10, d1) = (100e3, 200e3); // Pa
//! let rubber = isotropic!([c10: f64, d1: f64] degree 2, uniform; |i, _at| i.i1_excess() * c10 + i.j() * i.j() * d1);
//! # let _ = rubber;
//! ```
//!
//! `i.i1()` is I₁ − 3 and `i.j()` is J − 1: all invariants are deviations from rest, so that small strains keep their digits. `i.i1_excess()`
//! is I₁ − 3 − 2(J − 1), which has no stress at rest; plain I₁ − 3 pulls the rod together before anything acts on it.
//! Write constants on the right of a product, `x * 2.0`: a dual number times a number compiles, a number times a dual number does not.
//!
//! # Section, body, rod
//!
//! ```
//! # use hyperrod::isotropic;
//! use hyperrod::load::DeadWrench;
//! use hyperrod::section::{Rectangle, Section};
//! use hyperrod::{Body, Pose, Rod, Statics};
//! use nalgebra::vector;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let (c10, d1) = (100e3, 200e3);
//! # let rubber = isotropic!([c10: f64, d1: f64] degree 2, uniform; |i, _at| i.i1_excess() * c10 + i.j() * i.j() * d1);
//! let section = Section::new(Rectangle::new(0.020, 0.005), rubber)?; // width along x, height along y, m
//! let strip = Body::new(0.20, section)?; // 20 cm long
//! let pull = DeadWrench::force(vector![0.0, 0.02, 0.0])?; // N, in space
//! let rod = Rod::clamped(strip, Pose::identity()).with_tip_load(pull);
//! let solution = Statics::default().solve(&rod)?;
//!
//! let tip = solution.tip().pose.position;
//! assert!(tip.y > 0.05 && tip.z < 0.20); // bent towards the pull
//! # Ok(()) }
//! ```
//!
//! A rod clamped at `Pose::identity()` lies along +Z with x and y of its section along X and Y. To lay it along +X, turn the clamp:
//! `Pose::from(Isometry3::rotation(vector![0.0, FRAC_PI_2, 0.0]))`; poses convert to and from nalgebra's `Isometry3`.
//!
//! # Weight
//!
//! Gravity asks the body for its mass. A body without one does not compile with it, and the message says what to call:
//!
//! ```
//! use hyperrod::load::Gravity;
//! use hyperrod::material::LinearElastic;
//! use hyperrod::section::{Circle, Linear, Section};
//! use hyperrod::{Body, Pose, Rod, Statics};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let taper = Linear { from: 0.010, to: 0.005, length: 0.2 }; // radius, m
//! let section = Section::new(Circle::new(taper), LinearElastic::from_poisson(1e6, 0.45)?)?;
//! let arm = Body::new(0.2, section)?.with_density(1100.0)?;
//! let rod = Rod::clamped(arm, Pose::identity()).with_load(Gravity::standard());
//! let solution = Statics::to(1e-6).solve(&rod)?; // to an accuracy instead of on a mesh
//! assert!(solution.tip().pose.position.z < 0.2); // stands, and is pressed shorter
//! # Ok(()) }
//! ```
//!
//! Next: [write a law of your own](super::laws), or [choose a section](super::sections).
