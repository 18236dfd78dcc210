//! The Magnus vector of an element: g(end) = g(start) exp(Ω^) for g′ = g ξ^ with polynomial ξ.
//!
//! With the Taylor data α of ξ about the middle ([`Collocation::taylor`](super::collocation::Collocation::taylor)) and brackets reversed with
//! respect to Y′ = A Y,
//!
//! order 2: Ω = α₁;
//! order 4: Ω = α₁ + [α₁, α₂]/12;
//! order 6: C₁ = [α₂, α₁], C₂ = −[2α₃ + C₁, α₁]/60, Ω = α₁ + α₃/12 + [α₂ + C₂, −20α₁ − α₃ + C₁]/240.
//!
//! Source: Blanes, Casas, Oteo and Ros (2009), Phys. Rep. 470, 151, Eqs. (240)–(253).

use nalgebra::{Matrix3, Vector3};

use crate::lie::{Twist, TwistMap, Wrench};
use crate::scalar::Scalar;

/// α_{j+1} = h Σ_l t_jl ξ_l.
#[inline(always)]
pub(crate) fn taylor_data<D: Scalar, const S: usize>(
    t: &[[f64; S]; S],
    xi: &[Twist<D>; S],
    h: f64,
) -> [Twist<D>; S] {
    let mut alpha = [Twist::zero(); S];
    for j in 0..S {
        for l in 0..S {
            alpha[j] += xi[l] * D::from(h * t[j][l]);
        }
    }
    alpha
}

/// Ω.
#[inline]
pub(crate) fn exponent<D: Scalar, const S: usize>(alpha: &[Twist<D>; S]) -> Twist<D> {
    let number = |v: f64| D::from(v);
    match S {
        1 => alpha[0],
        2 => alpha[0] + alpha[0].bracket(&alpha[1]) * number(1.0 / 12.0),
        _ => {
            let (p, q) = factors(alpha);
            alpha[0] + alpha[2] * number(1.0 / 12.0) + p.bracket(&q) * number(1.0 / 240.0)
        }
    }
}

/// P = α₂ + C₂ and Q = −20α₁ − α₃ + C₁ of order 6.
fn factors<D: Scalar>(alpha: &[Twist<D>]) -> (Twist<D>, Twist<D>) {
    let number = |v: f64| D::from(v);
    let c1 = alpha[1].bracket(&alpha[0]);
    let c2 = (alpha[2] * number(2.0) + c1).bracket(&alpha[0]) * number(-1.0 / 60.0);
    (alpha[1] + c2, c1 - alpha[2] - alpha[0] * number(20.0))
}

/// ∂Ω/∂α_j.
///
/// At order 6, with P and Q as in Ω, their derivatives multiplied out and every product of two ad's taken by cross products:
///
/// 240 ∂Ω/∂α₁ = 240 − 20 ad_P + ad_P ad₂ − (ad_Q ad₁ ad₂ − ad_Q ad_{2α₃+C₁})/60,
/// 240 ∂Ω/∂α₂ = −ad_Q − ad_P ad₁ + ad_Q ad₁ ad₁/60, 240 ∂Ω/∂α₃ = 20 − ad_P − ad_Q ad₁/30.
#[inline(always)]
pub(crate) fn exponent_derivative<const S: usize>(alpha: &[Twist; S]) -> [TwistMap; S] {
    let one = TwistMap::identity();
    match S {
        1 => [one; S],
        2 => {
            let maps = [one - alpha[1].ad().scale(1.0 / 12.0), alpha[0].ad().scale(1.0 / 12.0)];
            std::array::from_fn(|j| maps[j])
        }
        _ => {
            const SCALE: f64 = 1.0 / 240.0;
            let (p, q) = factors(alpha);
            let (a1, a2) = (&alpha[0], &alpha[1]);
            let inner = alpha[2] * 2.0 + a2.bracket(a1);
            let (ad_p, q1) = (p.ad(), ad_ad(&q, a1));
            let maps = [
                one + (ad_ad(&p, a2) - ad_p.scale(20.0)).scale(SCALE)
                    - (map_ad(&q1, a2) - ad_ad(&q, &inner)).scale(SCALE / 60.0),
                map_ad(&q1, a1).scale(SCALE / 60.0) - (ad_ad(&p, a1) + q.ad()).scale(SCALE),
                one.scale(1.0 / 12.0) - (ad_p + q1.scale(1.0 / 30.0)).scale(SCALE),
            ];
            let mut all = [one; S];
            all.copy_from_slice(&maps[..S]);
            all
        }
    }
}

/// (∂Ω/∂α_j)ᵀ Λ, by vectors alone: the transposed formulas of [`exponent_derivative`].
#[inline(always)]
pub(crate) fn exponent_derivative_transpose<const S: usize>(
    alpha: &[Twist; S],
    wrench: &Wrench,
) -> [Wrench; S] {
    let mut all = [*wrench; S];
    match S {
        1 => {}
        2 => {
            all[0] = *wrench - wrench.ad_transpose(&alpha[1]) * (1.0 / 12.0);
            all[1] = wrench.ad_transpose(&alpha[0]) * (1.0 / 12.0);
        }
        _ => {
            const SCALE: f64 = 1.0 / 240.0;
            let (p, q) = factors(alpha);
            let (a1, a2) = (&alpha[0], &alpha[1]);
            let inner = alpha[2] * 2.0 + a2.bracket(a1);
            let (by_p, by_q) = (wrench.ad_transpose(&p), wrench.ad_transpose(&q));
            let q1 = by_q.ad_transpose(a1);
            all[0] = *wrench + (by_p.ad_transpose(a2) - by_p * 20.0) * SCALE
                - (q1.ad_transpose(a2) - by_q.ad_transpose(&inner)) * (SCALE / 60.0);
            all[1] = q1.ad_transpose(a1) * (SCALE / 60.0) - (by_p.ad_transpose(a1) + by_q) * SCALE;
            all[2] = *wrench * (1.0 / 12.0) - (by_p + q1 * (1.0 / 30.0)) * SCALE;
        }
    }
    all
}

/// ad_a ad_b.
#[inline(always)]
fn ad_ad(a: &Twist, b: &Twist) -> TwistMap {
    // u^ v^ = v uᵀ − (u·v) I
    let product = |u: &Vector3<f64>, v: &Vector3<f64>| {
        let mut m = v * u.transpose();
        let dot = u.dot(v);
        for i in 0..3 {
            m[(i, i)] -= dot;
        }
        m
    };
    TwistMap {
        diagonal: product(&a.angular, &b.angular),
        lower: product(&a.linear, &b.angular) + product(&a.angular, &b.linear),
    }
}

/// X ad_b.
#[inline(always)]
fn map_ad(x: &TwistMap, b: &Twist) -> TwistMap {
    // column j of M v^ is M (v × e_j)
    let product = |m: &Matrix3<f64>, v: &Vector3<f64>| {
        let [c0, c1, c2] = [m.column(0), m.column(1), m.column(2)];
        Matrix3::from_columns(&[c1 * v.z - c2 * v.y, c2 * v.x - c0 * v.z, c0 * v.y - c1 * v.x])
    };
    TwistMap {
        diagonal: product(&x.diagonal, &b.angular),
        lower: product(&x.lower, &b.angular) + product(&x.diagonal, &b.linear),
    }
}
