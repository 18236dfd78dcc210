//! Read a report, and take the results elsewhere.
//!
//! # The solution
//!
//! [`nodes`](crate::StaticSolution::nodes) go from base to tip, each with its arc length, [pose](crate::Pose), strain Δξ and wrench Ψ. The wrench
//! is in the frame of the section: rotate it for what an observer in space sees. [`stages`](crate::StaticSolution::stages) are the points where the
//! strains were solved for, and where an [integral](crate::StaticSolution::integrate) over the rod is taken.
//!
//! ```
//! use hyperrod::load::DeadWrench;
//! use hyperrod::section::Stiffness;
//! use hyperrod::{Body, Pose, Rod, Statics};
//! use nalgebra::vector;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
//! let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(vector![3.0, 0.0, 0.0])?);
//! let solution = Statics::default().solve(&rod)?;
//!
//! let node = solution.base();
//! let reaction = -(node.pose.rotation * node.wrench.force); // what the clamp gives, in space
//! assert!((reaction - vector![-3.0, 0.0, 0.0]).norm() < 1e-9);
//!
//! let report = solution.report();
//! assert_eq!(report.stability.to_string(), "stable"); // it would stay
//! assert!(report.error.position < 1e-5); // m: how far the mesh is from the model's answer
//! assert!(report.residual < 1e-9); // how far the answer is from equilibrium on its mesh
//! for step in report.fine_iterations() {
//!     println!("{:.1e} {:.1e} {:.2}", step.residual, step.step, step.fraction);
//! }
//! # Ok(()) }
//! ```
//!
//! # What the numbers say
//!
//! | field | good | what if not |
//! |---|---|---|
//! | `error`: estimated from two meshes | below what you need | more elements, or [`Statics::to`](crate::Statics::to) an accuracy |
//! | `residual` | 10⁻⁹ and less | rounding, or a law whose derivatives are not smooth |
//! | `iterations`, their `step` | the last ones square | a load with a wrong derivative; a kink in the law |
//! | `stability` | stable | [equilibria that would not stay](super::failures#equilibria-that-would-not-stay) |
//! | `rungs` | Newton alone | it had to do more to get there; that is no fault |
//! | their `fraction` | 1 in the end | below 1 all along: the start is far from the answer |
//!
//! The error is that of the *mesh*. That of the *model* (a rigid section where the real one contracts) is not in it, nor that of a quadrature
//! of a law that is no polynomial: [`Section::with_tolerance`](crate::section::Section::with_tolerance) bounds that one.
//!
//! # How hard the material works
//!
//! [`StaticSolution::extremes`](crate::StaticSolution::extremes) finds the largest stretch and the largest stress over all points of all
//! sections, and says where; [`Deformable::deformed`](crate::section::Deformable::deformed) shows one section point by point. Both know a
//! rigid and a relaxed section.
//!
//! # While it runs
//!
//! [`solve_observed`](crate::Statics::solve_observed) calls you after every iteration: for a progress bar, or to print. The library itself
//! prints nothing.
//!
//! # Out of the crate
//!
//! ```
//! use hyperrod::output::{Polyline, write_csv};
//! # use hyperrod::{Body, Pose, Rod, Statics, load::DeadWrench, section::Stiffness};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
//! # let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(nalgebra::vector![3.0, 0.0, 0.0])?);
//! let solution = Statics::default().solve(&rod)?;
//! # let (mut table, mut line) = (Vec::new(), Vec::new());
//! # /*
//! let mut table = std::fs::File::create("rod.csv")?;
//! let mut line = std::fs::File::create("rod.vtp")?; // for ParaView
//! # */
//! write_csv(&mut table, solution.nodes())?;
//! Polyline::new(solution.nodes()).with_radius(|_s| 0.01).write(&mut line)?;
//! let tip = nalgebra::Isometry3::from(solution.tip().pose);
//! # let _ = tip; Ok(()) }
//! ```
//!
//! With the feature `serde`, `serde_json::to_string(&solution)` writes all of it as JSON: nodes, stages, energies and report.
