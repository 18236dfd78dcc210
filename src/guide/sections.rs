//! Choose a section: rigid, relaxed, given by resultants, constrained.
//!
//! | what you know or want | section |
//! |---|---|
//! | six stiffnesses, measured or computed | [`Stiffness`](crate::section::Stiffness) |
//! | an energy per length: a ribbon, a cable, a measured curve | [`Resultants`](crate::section::Resultants), [`Ribbon`](crate::section::Ribbon) |
//! | an energy density; the section keeps its shape | [`Section`](crate::section::Section) |
//! | an energy density; the section contracts, ovalises and warps | [`Relaxed`](crate::section::Relaxed) |
//! | several materials side by side | [`Composite`](crate::section::Composite) |
//!
//! # Rigid or relaxed
//!
//! A rigid section is the cheapest. It cannot contract sideways, so a law with the constants of a datasheet is too stiff in it:
//!
//! ```
//! use hyperrod::Strain;
//! use hyperrod::material::{NeoHookean, Station};
//! use hyperrod::section::{Circle, EffectiveStiffness, Relaxed, Section, Warping};
//!
//! # fn main() -> hyperrod::Result<()> {
//! let (young, poisson) = (1e6, 0.49); // Pa, 1
//! let rubber = NeoHookean::from_young(young, poisson)?;
//! let area = std::f64::consts::PI * 0.01_f64.powi(2);
//! let (at, rest) = (Station::straight(0.0), Strain::zero());
//!
//! let rigid = Section::new(Circle::new(0.01), rubber)?;
//! assert!(EffectiveStiffness::of(&rigid, &at, &rest)?.axial > 17.0 * young * area); // λ + 2μ, not E
//!
//! let relaxed = Relaxed::new(Circle::new(0.01), rubber)?;
//! let relaxed = relaxed.with_warping(Warping::ANTICLASTIC)?;
//! let axial = EffectiveStiffness::of(&relaxed, &at, &rest)?.axial;
//! assert!((axial / (young * area) - 1.0).abs() < 1e-9);
//! # Ok(()) }
//! ```
//!
//! It costs: a section that relaxes solves a small problem of its own at every quadrature point of the rod, and a solve takes hundreds of
//! times as long as with a rigid section, up to a thousand on the highest rungs. Begin with the lowest rung that is true of the rod and a coarse mesh; `report().elapsed` tells.
//!
//! Two honest ways out: keep the rigid section and choose the constants for the moduli that the rod shall have (λ = μ gives E = 3G, as of
//! an incompressible rubber), or relax it. How far to relax is the rung of [`Warping`](crate::section::Warping):
//!
//! | the rod is mostly | rung | modes |
//! |---|---|---|
//! | stretched, or a round one twisted | `CONTRACTION` | 3 |
//! | bent a little | `ANTICLASTIC` | 9 |
//! | bent to 20 % strain at its surface | `BENDING` | 27 |
//! | short, so that shear counts | `SHEAR` | 34 |
//! | twisted, with corners | `TORSION`, the default | 51 |
//!
//! With [`Relaxed::incompressible`](crate::section::Relaxed::incompressible) a law of I₁ and I₂ alone is enough. What a section does by
//! itself, such as torque against twist with its free change of length, is a [`WrenchPath`](crate::section::WrenchPath).
//!
//! # Shapes that vary
//!
//! A size is a number, a [`Linear`](crate::section::Linear) taper, or a closure of s over a dual number, from which the slope follows:
//!
//! ```
//! use hyperrod::num_dual::{Dual64, DualNum};
//! use hyperrod::section::{Ellipse, Shape};
//! let bulge = |s: Dual64| (s * 30.0).sin() * 0.002 + 0.010;
//! let shape = Ellipse::new(bulge, 0.004).rotated(|s: Dual64| s * 2.0); // turns by 2 rad/m along the rod
//! # let _ = shape;
//! ```
//!
//! # Strains that a rod cannot have
//!
//! A wire hardly stretches or shears. [`Constraint`](crate::body::Constraint) takes such strains out of the problem instead of making
//! them stiff; the forces that go with them are still reported, as reactions.
//!
//! ```
//! use hyperrod::body::Constraint;
//! use hyperrod::load::DeadWrench;
//! use hyperrod::{Body, Pose, Rod, Statics, section::Stiffness};
//! use nalgebra::vector;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let section = Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?;
//! let elastica = Constraint::kirchhoff().and(Constraint::planar()); // one unknown a stage instead of six
//! let body = Body::new(1.0, section)?.with_constraint(elastica);
//! let push = DeadWrench::force(vector![1.0, 0.0, 0.0])?;
//! let solution = Statics::default().solve(&Rod::clamped(body, Pose::identity()).with_tip_load(push))?;
//! assert_eq!(solution.tip().strain.linear.norm(), 0.0);
//! assert!((solution.base().wrench.force.x - 1.0).abs() < 1e-9); // the reaction
//! # Ok(()) }
//! ```
//!
//! # Sections chosen at run time
//!
//! `Box<dyn CrossSection>` is a section too: one type for all of them, for a program that reads its scene from a file.
//!
//! # Curved at rest
//!
//! [`Body::with_reference_strain`](crate::Body::with_reference_strain) takes ξ* of an arc or a helix,
//! [`with_varying_reference`](crate::Body::with_varying_reference) a function of s.
//!
//! Next: [which model is enough](super::models), [loads](super::loads), [supports and actuators](super::supports).
