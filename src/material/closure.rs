use super::blocks::{Blank, Blocks, Derivatives, Respond, fill_registers};
use super::differentiate::{Fibre, FibreResponse, Rate, unpack};
use super::integrand::Material;
use super::integrate::{Job, Site, integrate_local, sum_by_blocks};
use super::kinematics::{Deformation, Invariants, Point};
use super::response::{Points, Request, Response, Station};
use super::sectional::{EnergyJet, Place, Spans, add_span, integrate_sectional};
use super::span::Span;
use super::sums::Totals;
use crate::error::Result;
use crate::lie::Strain;
use crate::scalar::{Jet, Portable, lanes_disagreed};

/// The dual number a [`local`] or [`isotropic`] closure is written over: variables (a, b, e, s), second order.
pub type LocalJet = Jet<Portable, 4, 10>;

/// The dual number a [`sectional`] closure is written over: variables (Δξ, s), second order.
pub type SectionalJet = Jet<Portable, 7, 28>;

const DOMAIN: &str = "where the energy density is finite";

/// A law made from a closure by [`isotropic`].
#[derive(Clone, Copy)]
pub struct IsotropicClosure<F>(F);

/// A law made from a closure by [`local`].
#[derive(Clone, Copy)]
pub struct LocalClosure<F>(F);

/// A law made from a closure by [`sectional`].
#[derive(Clone, Copy)]
pub struct SectionalClosure<F>(F);

/// A law from a real closure u(I₁−3, I₂−3, J−1; x, y, s): captures anything, types inferred, and can be boxed.
///
/// It always pays for all four variables (a, b, e, s), and is compiled for every machine and not for the widest registers of this one: three to
/// fifty times slower than [`isotropic!`](crate::isotropic!), by how much the compiler inlines; the macro pays for what is asked (`cargo run --release --example engine_speed`). `ln`,
/// `powf` and their like need `use hyperrod::num_dual::DualNum;`, since the number is a concrete one.
///
/// ```
/// use hyperrod::material::isotropic;
///
/// let shear_modulus = 60e3; // Pa
/// let rubber = isotropic(move |i, _| (i.i1_excess() * 0.5 + i.j() * i.j()) * shear_modulus);
/// ```
pub fn isotropic<F>(energy_density: F) -> IsotropicClosure<F>
where
    F: Fn(&Invariants<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    IsotropicClosure(energy_density)
}

/// A law from a real closure u(F; x, y, s). See [`isotropic`].
pub fn local<F>(energy_density: F) -> LocalClosure<F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    LocalClosure(energy_density)
}

/// A law from a real closure u(Δξ; x, y, s). See [`isotropic`].
///
/// ```
/// use hyperrod::material::sectional;
///
/// let young = 1e6; // Pa
/// let bending_and_stretch = sectional(move |strain, at| {
///     let e = strain.linear.z + strain.angular.x * at.y - strain.angular.y * at.x;
///     e * e * (0.5 * young)
/// });
/// ```
pub fn sectional<F>(energy_density: F) -> SectionalClosure<F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet + Send + Sync,
{
    SectionalClosure(energy_density)
}

/// A closure of the deformation, as the engine sees it. Compiled for every machine, as the closure itself is: within the instructions of
/// one machine it would not be inlined.
struct Called<F>(F);

impl<F> Blocks for Called<F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet,
{
    fn fill(&self, _: Request, blank: &mut Blank<'_>) -> bool {
        // these lanes may be fewer than those that read: what they leave out has no weight, and must not be left from a sum that failed
        if let Some(last) = blank.out.last_mut() {
            *last = Derivatives::ZERO;
        }
        fill_registers::<Portable, Rate, _>(self, blank);
        lanes_disagreed()
    }

    fn sum(&self, job: &Job<'_>) -> Result<Response> {
        sum_by_blocks(self, job)
    }

    fn region(&self) -> &'static str {
        DOMAIN
    }
}

impl<F> Respond<Portable, Rate> for Called<F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet,
{
    #[inline(always)]
    fn respond_at(&self, fibre: &Fibre<Portable>) -> FibreResponse<Portable> {
        unpack(&(self.0)(&fibre.gamma(), &fibre.moving_point()))
    }
}

/// A closure of the strain, likewise.
struct CalledWithStrain<F>(F);

impl<F> Spans for CalledWithStrain<F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet,
{
    fn add(&self, request: Request, at: Place<'_>, span: &Span<'_>, totals: &mut Totals) -> bool {
        add_span::<Portable, 7, 28, _>(at, span, request, self, totals);
        lanes_disagreed()
    }

    fn region(&self) -> &'static str {
        DOMAIN
    }
}

impl<F> EnergyJet<SectionalJet> for CalledWithStrain<F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet,
{
    #[inline(always)]
    fn energy_jet(&self, strain: &Strain<SectionalJet>, at: &Point<SectionalJet>) -> SectionalJet {
        (self.0)(strain, at)
    }
}

impl<F> Material for IsotropicClosure<F>
where
    F: Fn(&Invariants<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let law =
            Called(|f: &Deformation<LocalJet>, point: &Point<LocalJet>| (self.0)(&f.invariants(), point));
        integrate_local(&law, &Job::new(Site { points, at, strain }, request))
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }
}

impl<F> Material for LocalClosure<F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet + Send + Sync,
{
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let law = Called(&self.0);
        integrate_local(&law, &Job::new(Site { points, at, strain }, request))
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }
}

impl<F> Material for SectionalClosure<F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet + Send + Sync,
{
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let law = CalledWithStrain(&self.0);
        integrate_sectional(&law, &Job::new(Site { points, at, strain }, request))
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }

    fn is_local(&self) -> bool {
        false
    }
}
