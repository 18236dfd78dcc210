//! Derivatives of a local law at one point, each with the fewest variables.

use nalgebra::{Const, U1, Vector3};
use num_dual::{Dual2SVec64, DualSVec64};

use super::kinematics::{Deformation, Invariants, Point};
use super::law::{Isotropic, Local};
use super::response::Request;

/// A point of the section and the column γ of F − I there, with how they change along s at fixed Δξ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// The point.
    pub point: Point,
    /// x′ and y′.
    pub point_rate: [f64; 2],
    /// γ = (a, b, e).
    pub gamma: [f64; 3],
    /// ∂γ/∂s at fixed Δξ, 1/m.
    pub gamma_rate: [f64; 3],
}

/// Value and derivatives of a local energy density u(γ) at one point, as far as asked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FibreResponse {
    /// u, J/m³.
    pub energy: f64,
    /// ∂u/∂γ, Pa: the traction on the section.
    pub stress: [f64; 3],
    /// ∂²u/∂γ², Pa, in the order aa, ab, ae, bb, be, ee.
    pub stiffness: [f64; 6],
    /// d(∂u/∂γ)/ds at fixed Δξ, Pa/m.
    pub stress_rate: [f64; 3],
}

/// The point as constants of a dual type that has the arc length as variable number `N − 1`.
fn moving_point<const N: usize>(fibre: &Fibre) -> Point<Dual2SVec64<N>> {
    let ds = Dual2SVec64::<N>::from_re(0.0).derivative(N - 1);
    let Point { x, y, s } = fibre.point;
    Point { x: ds * fibre.point_rate[0] + x, y: ds * fibre.point_rate[1] + y, s: ds + s }
}

fn variable<const N: usize>(value: f64, index: usize) -> Dual2SVec64<N> {
    Dual2SVec64::from_re(value).derivative(index)
}

/// Three variables (a, b, e), and s as a fourth where Ψ′ is wanted.
pub(super) fn local_response<L: Local + ?Sized>(law: &L, fibre: &Fibre, request: Request) -> FibreResponse {
    match request {
        Request::Energy => FibreResponse {
            energy: law.energy_density(
                &Deformation::from_gamma(Vector3::from(fibre.gamma)),
                &fibre.point,
            ),
            ..Default::default()
        },
        Request::Wrench => {
            let gamma =
                [0, 1, 2].map(|i| DualSVec64::<3>::from_re(fibre.gamma[i]).derivative(i));
            let u = law.energy_density(
                &Deformation::from_gamma(Vector3::from(gamma)),
                &fibre.point.cast(),
            );
            let g = u.eps.unwrap_generic(Const::<3>, U1);
            FibreResponse { energy: u.re, stress: [g[0], g[1], g[2]], ..Default::default() }
        }
        Request::Tangent => {
            let gamma = [0, 1, 2].map(|i| variable::<3>(fibre.gamma[i], i));
            let u = law.energy_density(
                &Deformation::from_gamma(Vector3::from(gamma)),
                &fibre.point.cast(),
            );
            unpack(&u)
        }
        Request::Rate => {
            let ds = variable::<4>(0.0, 3);
            let gamma = [0, 1, 2].map(|i| variable::<4>(fibre.gamma[i], i) + ds * fibre.gamma_rate[i]);
            unpack(&law.energy_density(
                &Deformation::from_gamma(Vector3::from(gamma)),
                &moving_point(fibre),
            ))
        }
    }
}

/// Reads value, stress, stiffness and, from a fourth variable, the stress rate.
pub(super) fn unpack<const N: usize>(u: &Dual2SVec64<N>) -> FibreResponse {
    let g = u.v1.clone().unwrap_generic(U1, Const::<N>);
    let h = u.v2.clone().unwrap_generic(Const::<N>, Const::<N>);
    FibreResponse {
        energy: u.re,
        stress: [g[0], g[1], g[2]],
        stiffness: [h[(0, 0)], h[(0, 1)], h[(0, 2)], h[(1, 1)], h[(1, 2)], h[(2, 2)]],
        stress_rate: if N > 3 { [h[(0, 3)], h[(1, 3)], h[(2, 3)]] } else { [0.0; 3] },
    }
}

/// Two variables (s = a² + b², e), and the arc length as a third where Ψ′ is wanted; the chain rule through s by hand:
///
/// ∂u/∂a = 2a u_s, ∂²u/∂a∂b = 4ab u_ss + 2δ_ab u_s, ∂²u/∂a∂e = 2a u_se.
pub(super) fn isotropic_response<L: Isotropic + ?Sized>(
    law: &L,
    fibre: &Fibre,
    request: Request,
) -> FibreResponse {
    let [a, b, e] = fibre.gamma;
    let shear = a * a + b * b;
    match request {
        Request::Energy => FibreResponse {
            energy: law.energy_density(&Invariants::from_shear_and_stretch(shear, e), &fibre.point),
            ..Default::default()
        },
        Request::Wrench => {
            let s = DualSVec64::<2>::from_re(shear).derivative(0);
            let e = DualSVec64::<2>::from_re(e).derivative(1);
            let u = law.energy_density(&Invariants::from_shear_and_stretch(s, e), &fibre.point.cast());
            let g = u.eps.unwrap_generic(Const::<2>, U1);
            FibreResponse {
                energy: u.re,
                stress: [2.0 * a * g[0], 2.0 * b * g[0], g[1]],
                ..Default::default()
            }
        }
        Request::Tangent => {
            let s = variable::<2>(shear, 0);
            let e = variable::<2>(e, 1);
            let u = law.energy_density(&Invariants::from_shear_and_stretch(s, e), &fibre.point.cast());
            chain_through_shear(&u, fibre)
        }
        Request::Rate => {
            let [da, db, de] = fibre.gamma_rate;
            let ds = variable::<3>(0.0, 2);
            let s = variable::<3>(shear, 0) + ds * (2.0 * (a * da + b * db));
            let e = variable::<3>(e, 1) + ds * de;
            let u = law.energy_density(&Invariants::from_shear_and_stretch(s, e), &moving_point(fibre));
            chain_through_shear(&u, fibre)
        }
    }
}

fn chain_through_shear<const N: usize>(u: &Dual2SVec64<N>, fibre: &Fibre) -> FibreResponse {
    let [a, b, _] = fibre.gamma;
    let g = u.v1.clone().unwrap_generic(U1, Const::<N>);
    let h = u.v2.clone().unwrap_generic(Const::<N>, Const::<N>);
    let (u_s, u_e) = (g[0], g[1]);
    let (u_ss, u_se, u_ee) = (h[(0, 0)], h[(0, 1)], h[(1, 1)]);
    let mut response = FibreResponse {
        energy: u.re,
        stress: [2.0 * a * u_s, 2.0 * b * u_s, u_e],
        stiffness: [
            4.0 * a * a * u_ss + 2.0 * u_s,
            4.0 * a * b * u_ss,
            2.0 * a * u_se,
            4.0 * b * b * u_ss + 2.0 * u_s,
            2.0 * b * u_se,
            u_ee,
        ],
        stress_rate: [0.0; 3],
    };
    if N > 2 {
        let [da, db, _] = fibre.gamma_rate;
        let (u_s_rate, u_e_rate) = (h[(0, 2)], h[(1, 2)]);
        response.stress_rate =
            [2.0 * (da * u_s + a * u_s_rate), 2.0 * (db * u_s + b * u_s_rate), u_e_rate];
    }
    response
}
