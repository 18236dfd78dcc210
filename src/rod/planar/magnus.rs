//! The Magnus vector in the plane, its derivatives, and the poses: [`crate::rod::magnus`] with other numbers.

use nalgebra::{Matrix3, Vector3};

use super::{Complex, PlaneMap, PlaneTwist, complex, turned};
use crate::lie::{Pose, Twist, stumpff};
use crate::rod::collocation::Collocation;
use crate::rod::element::Kinematics;

/// α_{j+1} = h Σ_l t_jl ξ_l.
#[inline(always)]
fn taylor_data<const S: usize>(t: &[[f64; S]; S], xi: &[PlaneTwist; S], h: f64) -> [PlaneTwist; S] {
    let mut alpha = [PlaneTwist::zero(); S];
    for j in 0..S {
        for l in 0..S {
            alpha[j] = alpha[j] + xi[l].scale(h * t[j][l]);
        }
    }
    alpha
}

/// C₁, P and Q of order 6.
#[inline(always)]
fn factors(alpha: &[PlaneTwist]) -> [PlaneTwist; 3] {
    let c1 = alpha[1].bracket(&alpha[0]);
    let c2 = (alpha[2].scale(2.0) + c1).bracket(&alpha[0]).scale(-1.0 / 60.0);
    [c1, alpha[1] + c2, c1 - alpha[2] - alpha[0].scale(20.0)]
}

/// Ω.
#[inline(always)]
fn exponent<const S: usize>(alpha: &[PlaneTwist; S]) -> PlaneTwist {
    match S {
        1 => alpha[0],
        2 => alpha[0] + alpha[0].bracket(&alpha[1]).scale(1.0 / 12.0),
        _ => {
            let [_, p, q] = factors(alpha);
            alpha[0] + alpha[2].scale(1.0 / 12.0) + p.bracket(&q).scale(1.0 / 240.0)
        }
    }
}

/// ∂Ω/∂α_j.
#[inline(always)]
fn exponent_derivative<const S: usize>(alpha: &[PlaneTwist; S]) -> [PlaneMap; S] {
    let one = PlaneMap::identity();
    let mut all = [one; S];
    match S {
        1 => {}
        2 => {
            all[0] = one - alpha[1].ad().scale(1.0 / 12.0);
            all[1] = alpha[0].ad().scale(1.0 / 12.0);
        }
        _ => {
            const SCALE: f64 = 1.0 / 240.0;
            let [c1, p, q] = factors(alpha);
            let inner = (alpha[2].scale(2.0) + c1).ad();
            let (a1, a2, p, q) = (alpha[0].ad(), alpha[1].ad(), p.ad(), q.ad());
            let q1 = q * a1;
            all[0] = one + (p * a2 - p.scale(20.0)).scale(SCALE) - (q1 * a2 - q * inner).scale(SCALE / 60.0);
            all[1] = (q1 * a1).scale(SCALE / 60.0) - (p * a1 + q).scale(SCALE);
            all[2] = one.scale(1.0 / 12.0) - (p + q1.scale(1.0 / 30.0)).scale(SCALE);
        }
    }
    all
}

/// exp of (θ, ν): the rotation by θ and (e^{iθ} − 1)/(iθ) ν.
#[inline(always)]
fn exp(omega: &PlaneTwist) -> Pose {
    let theta = omega.angular;
    let [c0, c1, c2, ..] = stumpff(theta * theta);
    let position = Complex::new(c1, theta * c2) * omega.linear;
    let (cos, sin) = (c0, theta * c1);
    let rotation = Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos);
    Pose::new(rotation, Vector3::new(position.im, 0.0, position.re))
}

/// dexp₋Ω = (1, i ν φ₂(−iθ), φ₁(−iθ)), φ₁(z) = (e^z − 1)/z, φ₂(z) = (e^z − 1 − z)/z².
#[inline(always)]
fn dexp_of_minus(omega: &PlaneTwist) -> PlaneMap {
    let theta = omega.angular;
    let [_, c1, c2, c3, ..] = stumpff(theta * theta);
    PlaneMap {
        angular: 1.0,
        lower: turned(omega.linear) * Complex::new(c2, -theta * c3),
        diagonal: Complex::new(c1, -theta * c2),
    }
}

#[inline(always)]
fn in_plane<const S: usize>(xi: &[Twist; S]) -> [PlaneTwist; S] {
    xi.map(|xi| PlaneTwist { angular: xi.angular.y, linear: complex(&xi.linear) })
}

/// As [`Kinematics::new`].
pub(in crate::rod) fn kinematics<const S: usize>(
    table: &Collocation<S>,
    xi: &[Twist; S],
    h: f64,
) -> Kinematics<f64, S> {
    let xi = in_plane(xi);
    let pose = |t: &[[f64; S]; S]| exp(&exponent(&taylor_data(t, &xi, h)));
    let mut motion = Kinematics { stage: [Pose::identity(); S], end: pose(&table.end) };
    for k in 0..S {
        motion.stage[k] = pose(&table.stage[k]);
    }
    motion
}

/// B_kl at the stages, and B_el.
pub(super) struct Variations<const S: usize> {
    pub(super) stage: [[PlaneMap; S]; S],
    pub(super) end: [PlaneMap; S],
}

impl<const S: usize> Variations<S> {
    #[inline(always)]
    pub(super) fn new(table: &Collocation<S>, xi: &[Twist; S], h: f64) -> Self {
        let xi = in_plane(xi);
        let row = |t: &[[f64; S]; S]| {
            let alpha = taylor_data(t, &xi, h);
            let dexp = dexp_of_minus(&exponent(&alpha));
            let moved = exponent_derivative(&alpha).map(|map| dexp * map);
            let mut row = [moved[0]; S];
            for l in 0..S {
                row[l] = moved[0].scale(h * t[0][l]);
                for j in 1..S {
                    row[l] = row[l] + moved[j].scale(h * t[j][l]);
                }
            }
            row
        };
        let mut all = Self { stage: [[PlaneMap::identity(); S]; S], end: row(&table.end) };
        for k in 0..S {
            all.stage[k] = row(&table.stage[k]);
        }
        all
    }
}
