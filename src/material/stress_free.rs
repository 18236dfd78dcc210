use num_dual::Dual;

use super::integrand::Material;
use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use super::response::{Points, Request, Response, Station};
use super::task::Task;
use crate::error::Result;
use crate::lie::Strain;
use crate::scalar::{Jet, Lane, Scalar};

/// Any material with the stress taken off that it has at rest: U − Ψ(0)·Δξ.
///
/// ```math
/// \tilde U(\Delta\xi) = U(\Delta\xi) - \Psi(0)\cdot\Delta\xi, \qquad \tilde\Psi = \Psi(\Delta\xi) - \Psi(0),
/// \qquad \partial\tilde\Psi = \partial\Psi .
/// ```
///
/// The subtraction rounds at the size of Ψ(0), so a strain of 1e-12 keeps four digits; an isotropic law keeps them all with
/// [`ReferencePressure`], which is also the physical way (a pressure, u − p(J−1)).
#[derive(Clone, Copy, Debug)]
pub struct StressFree<M>(pub M);

impl<M: Material> Material for StressFree<M> {
    fn integrate(
        &self,
        points: &Points,
        at: &Station,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let mut response = self.0.integrate(points, at, strain, request)?;
        let needed = if request == Request::Rate { Request::Rate } else { Request::Wrench };
        let rest = self.0.integrate(points, at, &Strain::zero(), needed)?;
        response.energy -= rest.energy + strain.pair(&rest.wrench);
        if request >= Request::Wrench {
            response.wrench -= rest.wrench;
        }
        response.wrench_rate -= rest.wrench_rate;
        Ok(response)
    }

    fn polynomial_degree(&self) -> Option<usize> {
        self.0.polynomial_degree()
    }

    fn is_uniform(&self) -> bool {
        self.0.is_uniform()
    }

    fn is_local(&self) -> bool {
        self.0.is_local()
    }

    fn is_homogeneous(&self) -> bool {
        self.0.is_homogeneous()
    }
}

/// An isotropic law with its reference pressure: u − p(J−1), p = ∂u/∂J at rest, so that rest is free of stress.
///
/// The source's Mooney–Rivlin energy C₁(I₁−3) + C₂(I₂−3) needs it: at rest it pulls with (2C₁ + 4C₂)A. With the pressure it
/// is Ψ = K Δξ exactly, to the last digit of the smallest strain.
///
/// ```
/// use hyperrod::material::{MooneyRivlin, ReferencePressure};
/// # fn main() -> hyperrod::Result<()> {
/// let rubber = ReferencePressure(MooneyRivlin::new(120e3, 40e3)?);
/// # let _ = rubber; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ReferencePressure<L>(pub L);

impl<I: Isotropic> Isotropic for ReferencePressure<I> {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, at: &Point<D>) -> D {
        WithoutPressure(&self.0).energy_density(i, at)
    }

    #[inline(always)]
    fn evaluate<L: Lane, const N: usize, const M: usize>(
        &self,
        i: &Invariants<Jet<L, N, M>>,
        at: &Point<Jet<L, N, M>>,
    ) -> Jet<L, N, M> {
        WithoutPressure(&self.0).evaluate(i, at)
    }

    fn perform(&self, task: &mut Task<'_>) -> Result<Response> {
        self.0.perform_stress_free(task)
    }

    fn degree(&self) -> Option<usize> {
        self.0.degree()
    }

    fn is_uniform(&self) -> bool {
        self.0.is_uniform()
    }

    fn is_homogeneous(&self) -> bool {
        self.0.is_homogeneous()
    }

    fn domain(&self) -> &'static str {
        self.0.domain()
    }
}

/// [`ReferencePressure`] of a law that is borrowed.
pub(super) struct WithoutPressure<'a, I>(pub(super) &'a I);

impl<I: Isotropic> Isotropic for WithoutPressure<'_, I> {
    /// u − p(J−1), with p = ∂u/∂J at rest by one more dual part.
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, at: &Point<D>) -> D {
        if let Some(free) = self.0.stress_free_energy_density(i, at) {
            return free;
        }
        let zero = Dual::from_re(D::zero());
        let rest = Invariants::from_shear_and_stretch(zero, zero.derivative());
        let place = Point { x: Dual::from_re(at.x), y: Dual::from_re(at.y), s: Dual::from_re(at.s) };
        self.0.energy_density(i, at) - i.j() * self.0.energy_density(&rest, &place).eps
    }

    /// The same, with p by a jet of its own.
    #[inline(always)]
    fn evaluate<L: Lane, const N: usize, const M: usize>(
        &self,
        i: &Invariants<Jet<L, N, M>>,
        at: &Point<Jet<L, N, M>>,
    ) -> Jet<L, N, M> {
        match self.0.stress_free_energy_density(i, at) {
            Some(free) => free,
            None => self.0.evaluate(i, at) - i.j() * pressure(self.0, at),
        }
    }

    fn domain(&self) -> &'static str {
        self.0.domain()
    }
}

/// ∂u/∂J at rest, at points that move with the last variable alone, as those of the engine do.
#[inline(always)]
fn pressure<I: Isotropic, L: Lane, const N: usize, const M: usize>(
    law: &I,
    at: &Point<Jet<L, N, M>>,
) -> Jet<L, N, M> {
    let zero = L::splat(0.0);
    if N > 2 {
        let e = Jet::<L, 2, 3>::variable(zero, 0);
        let place = Point { x: at.x.along_last(), y: at.y.along_last(), s: at.s.along_last() };
        let u = law.evaluate(&Invariants::from_shear_and_stretch(Jet::constant(zero), e), &place);
        return Jet::constant(u.gradient[0]).with_slope(N - 1, u.hessian[1]);
    }
    let e = Jet::<L, 1, 0>::variable(zero, 0);
    let place =
        Point { x: Jet::constant(at.x.value), y: Jet::constant(at.y.value), s: Jet::constant(at.s.value) };
    let u = law.evaluate(&Invariants::from_shear_and_stretch(Jet::constant(zero), e), &place);
    Jet::constant(u.gradient[0])
}
