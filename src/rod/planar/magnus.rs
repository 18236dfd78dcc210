//! The Magnus vector in the plane, its derivatives, and the poses: [`crate::rod::magnus`] with other numbers.

use super::algebra::{Complex, PlaneMap, PlaneTwist};
use super::rows::{Twists, load_twist};
use crate::rod::lanes::{STAGES, Taylor, stumpff};
use crate::scalar::Lane;

/// Rotation by θ, as e^{iθ}, and position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<L> {
    pub(super) turn: Complex<L>,
    pub(super) position: Complex<L>,
}

/// α_{j+1} = h Σ_l t_jl ξ_l; what is beyond the number of stages is zero.
#[inline(always)]
pub(super) fn taylor_data<L: Lane>(
    t: &Taylor,
    twists: &Twists,
    stages: usize,
    at: usize,
) -> [PlaneTwist<L>; STAGES] {
    let h = L::load(&twists.h[at..]);
    let mut alpha = [PlaneTwist::zero(); STAGES];
    for l in 0..stages {
        let xi = load_twist::<L>(&twists.xi[l], at);
        for j in 0..STAGES {
            alpha[j] = alpha[j].add_scaled(h * L::splat(t[j][l]), &xi);
        }
    }
    alpha
}

/// C₁ + 2α₃, P and Q of order 6.
#[inline(always)]
fn factors<L: Lane>(alpha: &[PlaneTwist<L>; STAGES]) -> [PlaneTwist<L>; 3] {
    let k = L::splat;
    let c1 = alpha[1].bracket(&alpha[0]);
    let inner = c1.add_scaled(k(2.0), &alpha[2]);
    let p = alpha[1].add_scaled(k(-1.0 / 60.0), &inner.bracket(&alpha[0]));
    let q = c1.add_scaled(k(-1.0), &alpha[2]).add_scaled(k(-20.0), &alpha[0]);
    [inner, p, q]
}

/// Ω.
#[inline(always)]
pub(super) fn exponent<L: Lane>(alpha: &[PlaneTwist<L>; STAGES], stages: usize) -> PlaneTwist<L> {
    let k = L::splat;
    match stages {
        1 => alpha[0],
        2 => alpha[0].add_scaled(k(1.0 / 12.0), &alpha[0].bracket(&alpha[1])),
        _ => {
            let [_, p, q] = factors(alpha);
            alpha[0].add_scaled(k(1.0 / 12.0), &alpha[2]).add_scaled(k(1.0 / 240.0), &p.bracket(&q))
        }
    }
}

/// ∂Ω/∂α_j, as many as there are stages.
#[inline(always)]
fn exponent_derivative<L: Lane>(alpha: &[PlaneTwist<L>; STAGES], stages: usize) -> [PlaneMap<L>; STAGES] {
    const SCALE: f64 = 1.0 / 240.0;
    let k = L::splat;
    let one = PlaneMap::identity();
    let mut maps = [one; STAGES];
    if stages == 2 {
        maps[0] = one.add_scaled(k(-1.0 / 12.0), &alpha[1].ad());
        maps[1] = PlaneMap::zero().add_scaled(k(1.0 / 12.0), &alpha[0].ad());
    } else if stages > 2 {
        let [inner, p, q] = factors(alpha);
        let (a1, a2, p, q) = (alpha[0].ad(), alpha[1].ad(), p.ad(), q.ad());
        let q1 = q.times(&a1);
        let zero = PlaneMap::zero();
        maps[0] = one
            .add_scaled(k(SCALE), &p.times(&a2))
            .add_scaled(k(-20.0 * SCALE), &p)
            .add_scaled(k(-SCALE / 60.0), &q1.times(&a2))
            .add_scaled(k(SCALE / 60.0), &q.times(&inner.ad()));
        maps[1] = zero
            .add_scaled(k(SCALE / 60.0), &q1.times(&a1))
            .add_scaled(k(-SCALE), &p.times(&a1))
            .add_scaled(k(-SCALE), &q);
        maps[2] =
            zero.add_scaled(k(1.0 / 12.0), &one).add_scaled(k(-SCALE), &p).add_scaled(k(-SCALE / 30.0), &q1);
    }
    maps
}

/// exp of (θ, ν): the rotation by θ and (e^{iθ} − 1)/(iθ) ν. With c₀ … of θ².
#[inline(always)]
pub(super) fn exp<L: Lane>(omega: &PlaneTwist<L>, c: &[L; 6]) -> Placed<L> {
    let theta = omega.angular;
    Placed {
        turn: Complex::new(c[0], theta * c[1]),
        position: Complex::new(c[1], theta * c[2]) * omega.linear,
    }
}

/// dexp₋Ω = (1, i ν φ₂(−iθ), φ₁(−iθ)), φ₁(z) = (e^z − 1)/z, φ₂(z) = (e^z − 1 − z)/z².
#[inline(always)]
fn dexp_minus<L: Lane>(omega: &PlaneTwist<L>, c: &[L; 6]) -> PlaneMap<L> {
    let back = -omega.angular;
    PlaneMap {
        angular: L::splat(1.0),
        lower: omega.linear.turned() * Complex::new(c[2], back * c[3]),
        diagonal: Complex::new(c[1], back * c[2]),
    }
}

/// The pose at a stage or the end, and its displacements B_l = h Σ_j t_jl dexp₋Ω ∂Ω/∂α_j per change of the stage strains.
#[inline(always)]
pub(super) fn vary<L: Lane>(
    t: &Taylor,
    twists: &Twists,
    stages: usize,
    at: usize,
    suspect: &mut L,
) -> (Placed<L>, [PlaneMap<L>; STAGES]) {
    let alpha = taylor_data::<L>(t, twists, stages, at);
    let omega = exponent(&alpha, stages);
    let c = stumpff(omega.angular * omega.angular, suspect);
    let dexp = dexp_minus(&omega, &c);
    let derivative = exponent_derivative(&alpha, stages);
    let h = L::load(&twists.h[at..]);
    let mut row = [PlaneMap::zero(); STAGES];
    for j in 0..stages {
        let turned = dexp.times(&derivative[j]);
        for l in 0..stages {
            row[l] = row[l].add_scaled(h * L::splat(t[j][l]), &turned);
        }
    }
    (exp(&omega, &c), row)
}
