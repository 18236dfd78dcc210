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

use crate::lie::{Twist, TwistMap};
use crate::scalar::Scalar;

/// α_{j+1} = h Σ_l t_jl ξ_l.
#[inline]
pub(crate) fn taylor_data<D: Scalar, const S: usize>(
    t: &[[f64; S]; S],
    xi: &[Twist<D>; S],
    h: f64,
) -> [Twist<D>; S] {
    std::array::from_fn(|j| {
        let mut alpha = Twist::zero();
        for l in 0..S {
            alpha += xi[l] * D::from(h * t[j][l]);
        }
        alpha
    })
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
#[inline]
pub(crate) fn exponent_derivative<const S: usize>(alpha: &[Twist; S]) -> [TwistMap; S] {
    let one = TwistMap::identity();
    match S {
        1 => [one; S],
        2 => {
            let maps = [one - alpha[1].ad().scale(1.0 / 12.0), alpha[0].ad().scale(1.0 / 12.0)];
            std::array::from_fn(|j| maps[j])
        }
        _ => {
            let (p, q) = factors(alpha);
            let (ad1, ad2) = (alpha[0].ad(), alpha[1].ad());
            let c1 = alpha[1].bracket(&alpha[0]);
            let inner = (alpha[2] * 2.0 + c1).ad();
            // derivatives of C₁, P = α₂ + C₂ and Q in α₁, α₂, α₃
            let (c1_1, c1_2) = (ad2, ad1.scale(-1.0));
            let d_p = [
                (ad1 * c1_1 - inner).scale(1.0 / 60.0),
                one + (ad1 * c1_2).scale(1.0 / 60.0),
                ad1.scale(1.0 / 30.0),
            ];
            let d_q = [c1_1 - one.scale(20.0), c1_2, one.scale(-1.0)];
            let linear = [one, one.scale(0.0), one.scale(1.0 / 12.0)];
            let (ad_p, ad_q) = (p.ad(), q.ad());
            std::array::from_fn(|j| linear[j] + (ad_p * d_q[j] - ad_q * d_p[j]).scale(1.0 / 240.0))
        }
    }
}
