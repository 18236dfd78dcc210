//! Energy densities: what a law is, at which level it is written, and how it is summed over the points of a section.
//!
//! A law is written once, over any [`Scalar`](crate::Scalar), at the level that fits it:
//!
//! | level | trait | the user writes | variables differentiated |
//! |---|---|---|---|
//! | isotropic | [`Isotropic`] | u(I₁−3, I₂−3, J−1) | 2 |
//! | local | [`Local`] | u(F) | 3 |
//! | section | [`Sectional`] | u(Δξ, x, y) | 6 |
//!
//! and in one of three ways: as an implementation of the trait; with the macro of the same name in closure syntax
//! ([`isotropic!`](crate::isotropic!), [`local!`](crate::local!), [`sectional!`](crate::sectional!)), which expands to the
//! trait; or as a real closure over one concrete dual number ([`isotropic`], [`local`], [`sectional`]), quickest to write and
//! slower to run. All of them are a [`Material`], which is all that a section asks for.
//!
//! What lives here knows strains, points and weights; it knows no shape, no body and no rod.

mod closure;
mod differentiate;
mod integrate;
mod kinematics;
mod law;
mod linear_elastic;
mod macros;
mod mooney_rivlin;
mod neo_hookean;
mod response;
mod stress_free;
mod sums;

#[doc(hidden)]
pub use crate::lie::Strain as __Strain;
pub use closure::{
    IsotropicClosure, LocalClosure, LocalJet, SectionalClosure, SectionalJet, isotropic, local, sectional,
};
#[doc(hidden)]
pub use differentiate::{Fibre, FibreResponse, Level};
pub use kinematics::{Deformation, Invariants, Point};
pub use law::{Isotropic, Local, Material, Sectional};
pub use linear_elastic::LinearElastic;
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::NeoHookean;
pub(crate) use response::check_strain;
pub use response::{PointRates, Points, Reference, Request, Response, Station};
pub use stress_free::{ReferencePressure, StressFree};
