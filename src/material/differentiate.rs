//! Derivatives of a local law at a block of points, each with the fewest variables.

use nalgebra::Vector3;

use super::kinematics::{Deformation, Invariants, Point};
use super::law::{Isotropic, Local};
use super::response::Request;
use super::three::Three;
use crate::scalar::{Jet, Lane};

/// A request known at compile time, so that each is compiled for itself.
pub trait Level: Send + Sync {
    /// The request.
    const REQUEST: Request;
}

/// [`Request::Energy`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Energy;
/// [`Request::Wrench`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Wrench;
/// [`Request::Tangent`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Tangent;
/// [`Request::Rate`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Rate;

impl Level for Energy {
    const REQUEST: Request = Request::Energy;
}
impl Level for Wrench {
    const REQUEST: Request = Request::Wrench;
}
impl Level for Tangent {
    const REQUEST: Request = Request::Tangent;
}
impl Level for Rate {
    const REQUEST: Request = Request::Rate;
}

/// Points of the section, one a lane, and the column γ of F − I there, with how they change along s at fixed Δξ.
#[derive(Clone, Copy, Debug)]
pub struct Fibre<L> {
    /// x and y.
    pub position: [L; 2],
    /// x′ and y′.
    pub position_rate: [L; 2],
    /// s.
    pub s: L,
    /// γ = (a, b, e).
    pub gamma: [L; 3],
    /// ∂γ/∂s at fixed Δξ, 1/m.
    pub gamma_rate: [L; 3],
}

impl<L: Lane> Fibre<L> {
    /// The points as constants.
    #[inline(always)]
    fn fixed_point<const N: usize, const M: usize>(&self) -> Point<Jet<L, N, M>> {
        let [x, y] = self.position;
        Point { x: Jet::constant(x), y: Jet::constant(y), s: Jet::constant(self.s) }
    }

    /// The points as functions of s, the last of `N` variables.
    #[inline(always)]
    pub(super) fn moving_point<const N: usize, const M: usize>(&self) -> Point<Jet<L, N, M>> {
        let ([x, y], [dx, dy]) = (self.position, self.position_rate);
        Point { x: along(x, dx), y: along(y, dy), s: along(self.s, L::splat(1.0)) }
    }

    /// γ as the first three of `N` variables, moving with s, the fourth, where there is one.
    #[inline(always)]
    pub(super) fn gamma<const N: usize, const M: usize>(&self) -> Deformation<Jet<L, N, M>> {
        let mut a = Jet::variable(self.gamma[0], 0);
        let mut b = Jet::variable(self.gamma[1], 1);
        let mut e = Jet::variable(self.gamma[2], 2);
        if N > 3 {
            a = a.with_slope(3, self.gamma_rate[0]);
            b = b.with_slope(3, self.gamma_rate[1]);
            e = e.with_slope(3, self.gamma_rate[2]);
        }
        Deformation::from_gamma(Vector3::new(a, b, e))
    }
}

/// A number that moves with the last of `N` variables.
#[inline(always)]
pub(super) fn along<L: Lane, const N: usize, const M: usize>(value: L, rate: L) -> Jet<L, N, M> {
    Jet::constant(value).with_slope(N - 1, rate)
}

/// Value and derivatives of a local energy density u(γ) at a block of points, as far as asked.
#[derive(Clone, Copy, Debug)]
pub struct FibreResponse<L> {
    /// u, J/m³.
    pub energy: L,
    /// ∂u/∂γ, Pa: the traction on the section.
    pub stress: [L; 3],
    /// ∂²u/∂γ², Pa, in the order aa, ab, ae, bb, be, ee.
    pub stiffness: [L; 6],
    /// d(∂u/∂γ)/ds at fixed Δξ, Pa/m.
    pub stress_rate: [L; 3],
}

impl<L: Lane> FibreResponse<L> {
    #[inline(always)]
    fn energy_only(energy: L) -> Self {
        let zero = L::splat(0.0);
        Self { energy, stress: [zero; 3], stiffness: [zero; 6], stress_rate: [zero; 3] }
    }
}

/// Value and derivatives of a local energy density in the two variables ε and η of [`Three`].
#[derive(Clone, Copy, Debug)]
pub struct TwoWays<L> {
    /// u, J/m³.
    pub energy: L,
    /// ∂u/∂ε and ∂u/∂η.
    pub stress: [L; 2],
    /// Second derivatives εε, εη, ηη.
    pub stiffness: [L; 3],
}

/// Two variables, ε and η.
#[inline(always)]
pub(super) fn local_two_ways<M: Local + ?Sized, L: Lane, T: Three>(law: &M, fibre: &Fibre<L>) -> TwoWays<L> {
    let [a, b, e] = T::gamma(fibre);
    let gamma = Deformation::from_gamma(Vector3::new(a, b, e));
    let u = law.energy_density(&gamma, &fibre.fixed_point());
    TwoWays { energy: u.value, stress: u.gradient, stiffness: u.hessian }
}

/// Two variables (s = a² + b², e), and the chain rule by hand: ∂u/∂ε = s′ u_s, ∂²u/∂ε² = s′² u_ss + s″ u_s.
#[inline(always)]
pub(super) fn isotropic_two_ways<M: Isotropic + ?Sized, L: Lane, T: Three>(
    law: &M,
    fibre: &Fibre<L>,
) -> TwoWays<L> {
    let [a, b, e] = fibre.gamma;
    let (s, e) = (Jet::<L, 2, 3>::variable(a.mul_add(a, b * b), 0), Jet::variable(e, 1));
    let u = law.evaluate(&Invariants::from_shear_and_stretch(s, e), &fibre.fixed_point());
    let ([u_s, u_e], [ss, se, ee]) = (u.gradient, u.hessian);
    let [slope, second] = T::shear(fibre);
    let along = slope.mul_add(slope * ss, second * u_s);
    TwoWays { energy: u.value, stress: [slope * u_s, u_e], stiffness: [along, slope * se, ee] }
}

/// Three variables (a, b, e), and s as a fourth where Ψ′ is wanted.
#[inline(always)]
pub(super) fn local_response<M: Local + ?Sized, L: Lane, O: Level>(
    law: &M,
    fibre: &Fibre<L>,
) -> FibreResponse<L> {
    match O::REQUEST {
        Request::Energy => {
            let [a, b, e] = fibre.gamma;
            let gamma = Vector3::new(Jet::<L, 0, 0>::constant(a), Jet::constant(b), Jet::constant(e));
            let u = law.energy_density(&Deformation::from_gamma(gamma), &fibre.fixed_point());
            FibreResponse::energy_only(u.value)
        }
        Request::Wrench => {
            let u = law.energy_density(&fibre.gamma::<3, 0>(), &fibre.fixed_point());
            FibreResponse { stress: u.gradient, ..FibreResponse::energy_only(u.value) }
        }
        Request::Tangent => {
            let u = law.energy_density(&fibre.gamma::<3, 6>(), &fibre.fixed_point());
            FibreResponse { stress: u.gradient, stiffness: u.hessian, ..FibreResponse::energy_only(u.value) }
        }
        Request::Rate => unpack(&law.energy_density(&fibre.gamma::<4, 10>(), &fibre.moving_point())),
    }
}

/// Reads value, stress, stiffness and stress rate off a jet in (a, b, e, s).
#[inline(always)]
pub(super) fn unpack<L: Lane>(u: &Jet<L, 4, 10>) -> FibreResponse<L> {
    let ([g_a, g_b, g_e, _], h) = (u.gradient, u.hessian);
    FibreResponse {
        energy: u.value,
        stress: [g_a, g_b, g_e],
        stiffness: [h[0], h[1], h[2], h[4], h[5], h[7]],
        stress_rate: [h[3], h[6], h[8]],
    }
}

/// Two variables (s = a² + b², e), and the arc length as a third where Ψ′ is wanted; the chain rule through s by hand:
///
/// ∂u/∂a = 2a u_s, ∂²u/∂a∂b = 4ab u_ss + 2δ_ab u_s, ∂²u/∂a∂e = 2a u_se.
#[inline(always)]
pub(super) fn isotropic_response<M: Isotropic + ?Sized, L: Lane, O: Level>(
    law: &M,
    fibre: &Fibre<L>,
) -> FibreResponse<L> {
    let [a, b, e] = fibre.gamma;
    let shear = a.mul_add(a, b * b);
    let (two_a, two_b) = (a + a, b + b);
    match O::REQUEST {
        Request::Energy => {
            let i = Invariants::from_shear_and_stretch(Jet::<L, 0, 0>::constant(shear), Jet::constant(e));
            FibreResponse::energy_only(law.evaluate(&i, &fibre.fixed_point()).value)
        }
        Request::Wrench => {
            let (s, e) = (Jet::<L, 2, 0>::variable(shear, 0), Jet::variable(e, 1));
            let u = law.evaluate(&Invariants::from_shear_and_stretch(s, e), &fibre.fixed_point());
            let [u_s, u_e] = u.gradient;
            FibreResponse { stress: [two_a * u_s, two_b * u_s, u_e], ..FibreResponse::energy_only(u.value) }
        }
        Request::Tangent => {
            let (s, e) = (Jet::<L, 2, 3>::variable(shear, 0), Jet::variable(e, 1));
            let u = law.evaluate(&Invariants::from_shear_and_stretch(s, e), &fibre.fixed_point());
            chain_through_shear(u.value, u.gradient, u.hessian, [two_a, two_b])
        }
        Request::Rate => {
            let [da, db, de] = fibre.gamma_rate;
            let s = Jet::<L, 3, 6>::variable(shear, 0).with_slope(2, two_a.mul_add(da, two_b * db));
            let e = Jet::variable(e, 1).with_slope(2, de);
            let u = law.evaluate(&Invariants::from_shear_and_stretch(s, e), &fibre.moving_point());
            let ([u_s, u_e, _], [ss, se, s_rate, ee, e_rate, _]) = (u.gradient, u.hessian);
            let mut out = chain_through_shear(u.value, [u_s, u_e], [ss, se, ee], [two_a, two_b]);
            out.stress_rate =
                [two_a.mul_add(s_rate, (da + da) * u_s), two_b.mul_add(s_rate, (db + db) * u_s), e_rate];
            out
        }
    }
}

#[inline(always)]
fn chain_through_shear<L: Lane>(
    energy: L,
    [u_s, u_e]: [L; 2],
    [u_ss, u_se, u_ee]: [L; 3],
    [two_a, two_b]: [L; 2],
) -> FibreResponse<L> {
    let (a_ss, b_ss, two_u_s) = (two_a * u_ss, two_b * u_ss, u_s + u_s);
    FibreResponse {
        stress: [two_a * u_s, two_b * u_s, u_e],
        stiffness: [
            two_a.mul_add(a_ss, two_u_s),
            two_b * a_ss,
            two_a * u_se,
            two_b.mul_add(b_ss, two_u_s),
            two_b * u_se,
            u_ee,
        ],
        ..FibreResponse::energy_only(energy)
    }
}
