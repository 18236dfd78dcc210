use super::differentiate::{Fibre, FibreResponse, Rate, unpack};
use super::integrate::{EnergyJet, Respond, Site, respond, sum_local, sum_sectional};
use super::kinematics::{Deformation, Invariants, Point};
use super::law::Material;
use super::response::{Points, Request, Response, Station};
use crate::error::Result;
use crate::lie::Strain;
use crate::scalar::lane::{Kernel, dispatch};
use crate::scalar::{Jet, Lane, Portable};

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
/// It always pays for all four variables (a, b, e, s), and the compiler is not bound to inline it into the engine's loop: it is many
/// times slower than [`isotropic!`](crate::isotropic!), which pays for what is asked (`cargo run --release --example engine_speed`). `ln`,
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

/// Runs a closure on blocks of points inside the best instruction set of the machine.
struct ClosureKernel<'a, F>(&'a ClosureLaw<F>, Site<'a>, &'a mut Response);

struct ClosureLaw<F>(F);

impl<F> Respond<Portable, Rate> for ClosureLaw<F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet,
{
    #[inline(always)]
    fn respond_at(&self, fibre: &Fibre<Portable>) -> FibreResponse<Portable> {
        unpack(&(self.0)(&fibre.gamma(), &fibre.moving_point()))
    }
}

impl<F> EnergyJet<SectionalJet> for ClosureLaw<F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet,
{
    #[inline(always)]
    fn energy_jet(&self, strain: &Strain<SectionalJet>, at: &Point<SectionalJet>) -> SectionalJet {
        (self.0)(strain, at)
    }
}

impl<F> Kernel for ClosureKernel<'_, F>
where
    F: Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        sum_local::<Portable, Rate, _>(self.1, self.0, self.2);
    }
}

/// Integrates a closure of the deformation and the point.
fn integrate_closure(
    energy_density: impl Fn(&Deformation<LocalJet>, &Point<LocalJet>) -> LocalJet,
    site: Site<'_>,
) -> Result<Response> {
    let law = ClosureLaw(energy_density);
    respond(DOMAIN, site, true, |site, out| dispatch(ClosureKernel(&law, site, out)))
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
        _request: Request,
    ) -> Result<Response> {
        integrate_closure(|f, point| (self.0)(&f.invariants(), point), Site { points, at, strain })
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
        _request: Request,
    ) -> Result<Response> {
        integrate_closure(&self.0, Site { points, at, strain })
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }
}

/// As [`ClosureKernel`], for a section-level closure.
struct SectionalKernel<'a, F>(&'a ClosureLaw<F>, Site<'a>, &'a mut Response);

impl<F> Kernel for SectionalKernel<'_, F>
where
    F: Fn(&Strain<SectionalJet>, &Point<SectionalJet>) -> SectionalJet,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        sum_sectional(self.1, Request::Rate, self.0, self.2);
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
        _request: Request,
    ) -> Result<Response> {
        let site = Site { points, at, strain };
        let law = ClosureLaw(&self.0);
        respond(DOMAIN, site, false, |site, out| dispatch(SectionalKernel(&law, site, out)))
    }

    fn polynomial_degree(&self) -> Option<usize> {
        None
    }

    fn is_local(&self) -> bool {
        false
    }
}
