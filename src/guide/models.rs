//! Choose a model: what a simpler one costs, how far off it is, and when it is enough.
//!
//! A rod can be simpler in its strains (three dimensions or a plane, sheared or not, stretched or not), in its law (linear or not) and in its
//! section (rigid, or relaxed by one rung of [`Warping`](crate::section::Warping) or another). Each simplification makes a *modelling error*, which no
//! mesh can mend and no [report](super::reports) shows. [`suggest`](crate::solve::suggest) estimates it:
//!
//! ```
//! use hyperrod::load::DeadWrench;
//! use hyperrod::material::NeoHookean;
//! use hyperrod::section::{Circle, Relaxed, Section, Warping};
//! use hyperrod::solve::ModelLadder;
//! use hyperrod::{Body, Pose, Rod};
//! use nalgebra::vector;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // the richest model that there is a reason for: a short rubber arm with the constants of a datasheet
//! let (circle, rubber) = (Circle::new(0.025), NeoHookean::from_young(600e3, 0.45)?);
//! let section = Relaxed::new(circle.clone(), rubber)?.with_warping(Warping::SHEAR)?;
//! let push = DeadWrench::force(vector![5.0, 0.0, 0.0])?; // N
//! let arm = Rod::clamped(Body::new(0.2, section)?, Pose::identity()).with_tip_load(push);
//!
//! let ladder = ModelLadder::of(&arm).with_section("rigid", Section::new(circle, rubber)?)?;
//! let suggestion = ladder.suggest(1e-2)?; // of the length, and in rad
//! println!("{suggestion}");
//! let chosen = suggestion.chosen();
//! assert_eq!((chosen.section.as_str(), chosen.strains), ("linear law", "planar xz"));
//! let body = Body::new(0.2, Section::new(Circle::new(0.025), rubber)?)?.with_constraint(chosen.constraint);
//! # let _ = body; Ok(()) }
//! ```
//!
//! Every rung is printed with its estimated error and the strain in which it leaves most of the work out. The scene is solved once, as it is; each rung
//! then takes one linear solve.
//!
//! # What each choice costs, and how far off it is
//!
//! Three rods, each against itself with a section relaxed by `Warping::SHEAR` and with all strains; largest displacement over L, or rotation. All
//! of it, with pictures, is in `docs/work-precision.md`, section "Which model".
//!
//! | model | soft arm, L/r = 8 | catheter, L/r = 1000, bent in space | steel rod, L/r = 100 |
//! |---|---|---|---|
//! | linear law, in a plane, Kirchhoff | <!-- quote: models.arm.linear_law.planar_kirchhoff.error -->2.4e-2 | <!-- quote: models.catheter.linear_law.planar_kirchhoff.error -->1.4e0 | <!-- quote: models.steel.linear_law.planar_kirchhoff.error -->1.5e-5 |
//! | linear law, Kirchhoff | <!-- quote: models.arm.linear_law.kirchhoff.error -->2.4e-2 | <!-- quote: models.catheter.linear_law.kirchhoff.error -->3.8e-6 | <!-- quote: models.steel.linear_law.kirchhoff.error -->1.5e-5 |
//! | linear law, all strains | <!-- quote: models.arm.linear_law.all.error -->8.2e-3 | <!-- quote: models.catheter.linear_law.all.error -->4.1e-6 | <!-- quote: models.steel.linear_law.all.error -->6.4e-7 |
//! | rigid section, E and G matched, all strains | <!-- quote: models.arm.rigid_E_and_G_matched.all.error -->6.9e-3 | <!-- quote: models.catheter.rigid_E_and_G_matched.all.error -->3.0e-6 | <!-- quote: models.steel.rigid_E_and_G_matched.all.error -->2.3e-6 |
//! | rigid section, constants of a datasheet | <!-- quote: models.arm.rigid_datasheet.all.error -->4.2e-1 | <!-- quote: models.catheter.rigid_datasheet.all.error -->1.6e0 | <!-- quote: models.steel.rigid_datasheet.all.error -->2.4e-2 |
//! | relaxed section, anticlastic | <!-- quote: models.arm.relaxed_anticlastic.all.error -->1.2e-2 | <!-- quote: models.catheter.relaxed_anticlastic.all.error -->1.0e-5 | <!-- quote: models.steel.relaxed_anticlastic.all.error -->2.1e-6 |
//! | relaxed section, shear, Kirchhoff | <!-- quote: models.arm.relaxed_shear.kirchhoff.error -->2.7e-2 | <!-- quote: models.catheter.relaxed_shear.kirchhoff.error -->5.7e-6 | <!-- quote: models.steel.relaxed_shear.kirchhoff.error -->1.5e-5 |
//!
//! A solve of the arm on 16 elements takes <!-- quote: models.arm.linear_law.planar_kirchhoff.ms -->0.050 ms with the simplest of these, with a linear law and
//! all strains <!-- quote: models.arm.linear_law.all.ms -->0.11 ms, with a rigid neo-Hookean section
//! and all strains <!-- quote: models.arm.rigid_E_and_G_matched.all.ms -->0.18 ms, relaxed <!-- quote: models.arm.relaxed_shear.all.ms -->45 ms. So the section
//! decides the cost, the strains little.
//!
//! * **Slender and stiff** (L/r from 100 on, strains of the material below 10⁻³): a linear law and Kirchhoff. Stiffnesses from E, G and the shape
//!   ([`Stiffness`](crate::section::Stiffness)), or from a relaxed section at rest, once
//!   ([`EffectiveStiffness`](crate::section::EffectiveStiffness)). Shear and stretch move such a rod by some (r/L)² of its length.
//! * **Thick and soft**: all strains. Without shear and stretch the arm above is off by <!-- quote: models.arm.relaxed_shear.kirchhoff.error -->2.7e-2 of its
//!   length, with a linear law by <!-- quote: models.arm.linear_law.all.error -->8.2e-3.
//! * **Never a rigid section with the constants of a datasheet**: match λ + 2μ = E and μ = G, or relax it.
//! * **Relaxed** where the strains are large, the section has corners and is twisted, or the material is all that is known.
//! * **In a plane** where loads, supports and reference are: exact then, and the cheapest saving there is.
//!
//! What the estimate does not see: that a simpler rod is unstable where the scene is not, or that the reference answer itself is far from the body that
//! it stands for.
//!
//! Next: [loads](super::loads).
