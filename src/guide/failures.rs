//! When a solve fails: what it says, and what to do.
//!
//! A solve that finds no answer returns a [`Failure`](crate::solve::Failure): a [`Reason`](crate::solve::Reason), the report up to there, and the last
//! admissible state, which is *not* an equilibrium but shows where things went. Print the failure first; it names the quantity, the
//! value and the place.
//!
//! | reason | what it means | what to do |
//! |---|---|---|
//! | `Options` | the options make no sense | mend them |
//! | `Supports` | the rod can move freely | hold the freedom it names |
//! | `Start` | the rod cannot be evaluated at rest | a size or law that is not admissible, at the s it names |
//! | `NoAdmissibleStep` | every step turns the material inside out (J ≤ 0) or leaves the law's domain | load in steps; look at the place; another law in compression |
//! | `Singular` | the tangent has no inverse | a limit point of the load: nothing stands beyond it; or a section without stiffness |
//! | `IterationLimit` | it did not settle | load in steps; raise the limit if `step` was still falling |
//! | `Accuracy` | the mesh limit or rounding came first | ask for less |
//!
//! # A refusal that names its place
//!
//! ```
//! use hyperrod::material::{NeoHookean, Station};
//! use hyperrod::section::{Circle, CrossSection, Section};
//! use hyperrod::{Error, Strain};
//!
//! # fn main() -> hyperrod::Result<()> {
//! let section = Section::new(Circle::new(0.01), NeoHookean::new(200e3, 200e3)?)?;
//! let mut strain = Strain::zero();
//! strain.angular.y = 150.0; // bent so sharply that its inner side would turn inside out
//! let error = section.wrench(&Station::straight(0.1), &strain).unwrap_err();
//! assert!(matches!(error, Error::Inadmissible { quantity: "J", s: 0.1, .. }));
//! # Ok(()) }
//! ```
//!
//! # The load in steps
//!
//! Newton's method starts from the rest shape. Where the answer is far away, scale the load and watch from which factor on it fails: a
//! scene is a function of a number.
//!
//! ```
//! use hyperrod::load::DeadWrench;
//! use hyperrod::section::Stiffness;
//! use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, solve::Failure};
//! use nalgebra::vector;
//!
//! fn scene(factor: f64) -> hyperrod::Result<Rod<Body<Stiffness>>> {
//!     let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
//!     let push = DeadWrench::force(vector![30.0, 0.0, 0.0] * factor)?;
//!     Ok(Rod::clamped(body, Pose::identity()).with_tip_load(push))
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! for factor in [0.25, 0.5, 1.0] {
//!     let solved: Result<StaticSolution, Box<Failure>> = Statics::default().solve(&scene(factor)?);
//!     match solved {
//!         Ok(solution) => assert!(solution.tip().pose.position.x > 0.5),
//!         Err(failure) => println!("at {factor}: {failure}; {} iterations", failure.report.iterations.len()),
//!     }
//! }
//! # Ok(()) }
//! ```
//!
//! # Where to look
//!
//! 1. [`check`](crate::section::check) the law in its section: is it stress-free at rest, how far can each strain go?
//! 2. Halve the load. If half works, the answer may have no equilibrium at the full one: rods buckle, snap, and rubber tubes kink.
//! 3. Look at `failure.last`: its nodes, as a [table or in ParaView](super::reports).
//! 4. Units: SI throughout. A section of 10 instead of 0.010 is the commonest mistake.
//! 5. A rod that is stiff in extension beyond need (EA L²/EI above 10⁸) loses nothing by a
//!    [`Constraint`](crate::body::Constraint::kirchhoff).
