//! Write a law: one function, at the level that fits it.
//!
//! | the energy depends on | trait | macro | variables differentiated |
//! |---|---|---|---|
//! | the invariants | [`Isotropic`](crate::material::Isotropic) | [`isotropic!`](crate::isotropic!) | 2 |
//! | the deformation gradient, as of fibres | [`Local`](crate::material::Local) | [`local!`](crate::local!) | 3 |
//! | the strain of the rod and the place | [`Sectional`](crate::material::Sectional) | [`sectional!`](crate::sectional!) | 6 |
//! | the strain of the rod, given per length | [`Resultant`](crate::section::Resultant) | | 6 |
//!
//! Take the first that your law fits in. Stress and stiffness are derivatives and nobody writes them.
//!
//! # As a trait
//!
//! A law with a name, its constants, and where it is defined. One generic method runs on `f64` and on any dual number
//! ([`Scalar`](crate::Scalar)):
//!
//! ```
//! use hyperrod::Scalar;
//! use hyperrod::material::{Invariants, Isotropic, Point, ReferencePressure};
//! use hyperrod::section::{CheckOptions, Circle, check};
//!
//! /// Stiffens exponentially, as tissue does: u = (μ / 2b) (exp(b (I₁ − 3)) − 1) + ½ κ (J − 1)².
//! struct Tissue { mu: f64, b: f64, kappa: f64 } // Pa, 1, Pa
//!
//! impl Isotropic for Tissue {
//!     #[inline(always)] // or it runs more than ten times slower: see the trait
//!     fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
//!         (i.i1() * self.b).exp_m1() * (self.mu / (2.0 * self.b)) + i.j() * i.j() * (0.5 * self.kappa)
//!     }
//! }
//!
//! # fn main() -> hyperrod::Result<()> {
//! let law = ReferencePressure(Tissue { mu: 20e3, b: 1.5, kappa: 40e3 });
//! let report = check(&Circle::new(0.005), &law, &CheckOptions::default())?; // print it: it is meant to be read
//! assert!(report.rest.force.norm() < 1e-12);
//! assert!((report.moduli.shear_modulus / 20e3 - 1.0).abs() < 1e-12);
//! # Ok(()) }
//! ```
//!
//! [`check`](crate::section::check) tells whether the law is free of stress at rest, its moduli, how far each strain can go before the
//! section loses its stiffness, and what quadrature it needs.
//!
//! # Free of stress at rest
//!
//! The first invariants begin with a term linear in J − 1, so most energies pull at rest. [`ReferencePressure`](crate::material::ReferencePressure)
//! takes the pressure off any isotropic law, [`StressFree`](crate::material::StressFree) the wrench off any other.
//!
//! # Graded laws
//!
//! `at` is the point: x and y in the section and s along the rod, with their derivatives.
//!
//! ```
//! use hyperrod::isotropic;
//! let (base, tip, length) = (400e3, 100e3, 0.2); // shear moduli, Pa; m
//! let graded = isotropic!([base: f64, tip: f64, length: f64] degree 2; |i, at| {
//!     let shear = at.s * ((tip - base) / length) + base;
//!     (i.i1_excess() * 0.5 + i.j() * i.j()) * shear
//! });
//! # let _ = graded;
//! ```
//!
//! # Fibres
//!
//! A [`Deformation`](crate::material::Deformation) has what a law of directions needs. Branches are allowed: they see the value, point by point.
//!
//! ```
//! use hyperrod::local;
//! use hyperrod::num_dual::DualNum;
//! use nalgebra::Vector3;
//! let stiffness = 2e6; // Pa
//! let cords = local!([stiffness: f64] |f, _at| {
//!     let stretch = f.stretch_squared_minus_one(&Vector3::z()); // λ² − 1 along the rod
//!     if stretch.re() > 0.0 { stretch * stretch * (0.125 * stiffness) } else { stretch * 0.0 }
//! });
//! # let _ = cords;
//! ```
//!
//! # Laws of laws
//!
//! [`Sum`](crate::material::Sum) and [`Scaled`](crate::material::Scaled) combine laws of one level. A real closure
//! ([`isotropic`](crate::material::isotropic), lower case, a function) captures whatever it likes and is several times slower.
//!
//! # Traps of dual numbers
//!
//! * `x * 2.0`, not `2.0 * x`.
//! * `powf` at 0 gives NaN: (I₁ − 3)^1.5 sits there at rest. [`scalar`](crate::scalar) has primitives that do not.
//! * `==` and `<` compare values, not derivatives. Take `x.re()` and mean it.
//! * Write with deviations, `i.j()` and `ln_1p`, never 1 + J − 1: at small strains that is all the digits there are.
//!
//! Next: [choose a section](super::sections).
