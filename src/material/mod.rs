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
//! trait; or as a real closure over one concrete [jet](LocalJet) ([`isotropic`], [`local`], [`sectional`]), quickest to write
//! and three to fifty times slower to run. All of them are a [`Material`], which is all that a section asks for.
//!
//! The laws at hand, with the moduli at rest of a section that cannot contract:
//!
//! | law | G | E |
//! |---|---|---|
//! | [`MooneyRivlin`] with [`ReferencePressure`] | 2C₁+2C₂ | 2C₁+4C₂ |
//! | [`Polynomial`] with or without it | 2(C₁₀+C₀₁) | 2C₁₀+4C₀₁+8C₂₀+16C₁₁+32C₀₂+2D₁ |
//! | [`IsochoricPolynomial`], [`Yeoh`] | 2(C₁₀+C₀₁) | 2D₁+4G/3 |
//! | [`NeoHookean`], [`Gent`], [`Hencky`], [`SaintVenantKirchhoff`] | μ | λ+2μ |
//! | [`IsochoricNeoHookean`], [`Fung`], [`HolzapfelGasserOgden`] | μ | κ+4μ/3 |
//! | [`ArrudaBoyce`] | above μ | κ+4G/3 |
//! | [`Ogden`] | ½Σμα | λ+2G |
//! | [`BlatzKo`] | μ | 2μ(1−ν)/(1−2ν) |
//! | [`Fibres`] in tension, along the rod | – | 4k₁ |
//!
//! [`LinearElastic`], written at section level, takes G and E as they are. [`Sum`] and [`Scaled`] make laws of laws.
//!
//! **Constants from a datasheet** describe a solid that is free to contract; a rigid section is not, and bends with the E of the table.
//! With the bulk modulus of rubber (κ or λ near 1 GPa) a rod comes out a thousand times too stiff. For the E = 3G of an incompressible rubber,
//! take λ = G, or κ = 5G/3; or take the constants as they are on a section that [relaxes](crate::section::Relaxed).
//!
#![doc = include_str!("../../docs/material-table.md")]
//!
//!
//! What lives here knows strains, points and weights; it knows no shape, no body and no rod.

mod active;
mod arruda_boyce;
mod batch;
mod blatz_ko;
mod blocks;
mod closure;
mod coefficient_table;
mod combine;
mod compiled_here;
mod diagnose;
mod differentiate;
mod few;
mod few_kernels;
mod fibre_direction;
mod fibres;
mod fung;
mod gent;
mod gradient;
mod hencky;
mod holzapfel_gasser_ogden;
mod integrand;
mod integrate;
mod isochoric_neo_hookean;
mod kinematics;
mod law;
mod linear_elastic;
mod macros;
mod mooney_rivlin;
mod neo_hookean;
mod ogden;
mod places;
mod polynomial;
mod response;
mod saint_venant_kirchhoff;
mod scratch;
mod sectional;
mod span;
mod spectral;
mod stress_free;
mod sums;
mod task;
mod three;
mod walk;
mod yeoh;

#[doc(hidden)]
pub use crate::lie::Strain as __Strain;
pub use active::Active;
pub use arruda_boyce::ArrudaBoyce;
pub use blatz_ko::BlatzKo;
pub use closure::{
    IsotropicClosure, LocalClosure, LocalJet, SectionalClosure, SectionalJet, isotropic, local, sectional,
};
pub use coefficient_table::Coefficient;
pub use combine::{Scaled, Sum};
#[doc(hidden)]
pub use differentiate::{Fibre, FibreResponse, Level, TwoWays};
pub use fibre_direction::{FibreDirection, Helix, Straight, Twisted};
pub use fibres::Fibres;
pub use fung::Fung;
pub use gent::Gent;
pub(crate) use gradient::{GradientBatch, GradientLaw, GradientState, packed};
#[doc(hidden)]
pub use gradient::{GradientResponse, GradientSite};
pub use hencky::Hencky;
pub use holzapfel_gasser_ogden::HolzapfelGasserOgden;
pub use integrand::Material;
pub use isochoric_neo_hookean::IsochoricNeoHookean;
pub use kinematics::{Deformation, Invariants, Point};
pub use law::{Isotropic, Local, Sectional};
pub use linear_elastic::LinearElastic;
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::NeoHookean;
pub use ogden::Ogden;
pub use polynomial::{IsochoricPolynomial, Polynomial};
pub(crate) use response::check_strain;
pub use response::{PointRates, Points, Reference, Request, Response, Station};
pub use saint_venant_kirchhoff::SaintVenantKirchhoff;
pub use stress_free::{ReferencePressure, StressFree};
#[doc(hidden)]
pub use task::Task;
#[doc(hidden)]
pub use three::Three;
pub use yeoh::Yeoh;
