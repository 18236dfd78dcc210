//! When a solve fails: what it says, and what to do.
//!
//! A solve that finds no answer returns a [`Failure`](crate::solve::Failure): a [`Reason`](crate::solve::Reason), the report up to there, and the last
//! admissible state, which is *not* an equilibrium but shows where things went. Print the failure first; it names the quantity, the
//! value and the place.
//!
//! | reason | what it means | what to do |
//! |---|---|---|
//! | `Options` | the options make no sense | mend them |
//! | `Supports` | the rod can move freely, or cannot be where it is held | hold the freedom it names, or release it |
//! | `Start` | the rod cannot be evaluated at rest | a size or law that is not admissible, at the s it names |
//! | `NoAdmissibleStep` | every step turns the material inside out (J ≤ 0) or leaves the law's domain | look at the place, and at half the load; another law in compression |
//! | `Singular` | the tangent has no inverse | a limit point of the load: nothing stands beyond it; or a section without stiffness |
//! | `Unstable` | there is an equilibrium, and it would not stay | see [below](#equilibria-that-would-not-stay) |
//! | `LimitPoint` | on the path from rest the load cannot grow to what is asked | look at `last`, the rod at the largest load, and at its load factor |
//! | `IterationLimit` | it did not settle | raise the limit if `step` was still falling; look at half the load |
//! | `ShortSteps` | it did not settle: most of every step turns the material inside out, or leaves the law's domain | as for `NoAdmissibleStep` |
//! | `StressAtRest` | one of the last five, with a section that is strained before anything acts | make the [law free of stress at rest](super::laws#free-of-stress-at-rest), or look at the tensions |
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
//! # Equilibria that would not stay
//!
//! A column beyond its critical load has a straight equilibrium, and buckled ones. The solver looks at the stability of what it finds, goes on
//! to a stable one, and says in its [report](crate::solve::Report) what it had to do (`rungs`) and what the answer is (`stability`). It
//! fails with `Unstable` where it finds none: ask for any equilibrium with `accept_unstable`, or look at the whole path.
//!
//! ```
//! use hyperrod::load::DeadWrench;
//! use hyperrod::solve::{PathOptions, Stability};
//! use hyperrod::section::Stiffness;
//! use hyperrod::{Body, Pose, Rod, Statics};
//! use nalgebra::vector;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let body = Body::new(1.0, Stiffness::diagonal([4.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
//! let push = DeadWrench::force(vector![0.0, 0.0, -3.0])?; // beyond π² EI / 4 L²
//! let column = Rod::clamped(body, Pose::identity()).with_tip_load(push);
//!
//! let buckled = Statics::default().solve(&column)?;
//! assert!(buckled.tip().pose.position.x.abs() > 0.2);
//! let straight = Statics { accept_unstable: true, ..Statics::default() }.solve(&column)?;
//! assert_eq!(straight.report().stability, Stability::Index { unstable: 1, neutral: 0 });
//! // at which part of the load does it buckle?
//! let up_to = PathOptions { factors: [0.0, 1.0], ..PathOptions::default() };
//! let buckling = Statics::default().buckling(&column, &up_to)?.ok_or("it does not buckle")?;
//! assert!((buckling.critical.load_factor * 3.0 - 2.4674).abs() < 1e-2);
//! # Ok(()) }
//! ```
//!
//! [`Statics::trace`](crate::Statics::trace) follows the equilibria from rest through limit points, where a rod snaps;
//! [`trace_buckled`](crate::Statics::trace_buckled) the path that leaves the first bifurcation.
//!
//! # Where to look
//!
//! 1. [`check`](crate::section::check) the law in its section: is it stress-free at rest, how far can each strain go?
//! 2. Halve the load. If half works, the answer may have no equilibrium at the full one: rods buckle, snap, and rubber tubes kink.
//! 3. Look at `failure.last`: its nodes, as a [table or in ParaView](super::reports).
//! 4. Units: SI throughout. A section of 10 instead of 0.010 is the commonest mistake.
//! 5. A rod that is stiff in extension beyond need (EA L²/EI above 10⁸) loses nothing by a
//!    [`Constraint`](crate::body::Constraint::kirchhoff).
