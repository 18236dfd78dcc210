//! The element of a rod that stays in the plane of its directors x and z: the same formulas in SE(2), where a rotation is a number.
//!
//! Vectors of the plane are complex, u = u_z + i u_x, so that e_y × u is i u and a rotation by θ is e^{iθ}. A twist is (ω, ν) with real ω and complex ν,
//! [(ω, ν), (w, v)] = (0, i(ω v − w ν)), and every map that occurs is (w, v) → (a w, b w + A v) with a real and b, A complex.

mod condense;
mod loaded;
mod magnus;

pub(super) use loaded::acts_in_plane;
pub(super) use magnus::kinematics;

use std::ops::{Add, Mul, Sub};

use crate::body::Constraint;
use crate::lie::{Twist, Wrench};

pub(super) type Complex = nalgebra::Complex<f64>;

/// u_z + i u_x.
#[inline(always)]
pub(super) fn complex(v: &nalgebra::Vector3<f64>) -> Complex {
    Complex::new(v.z, v.x)
}

/// i u.
#[inline(always)]
fn turned(u: Complex) -> Complex {
    Complex::new(-u.im, u.re)
}

/// (ω, ν).
#[derive(Clone, Copy, Debug)]
struct PlaneTwist {
    angular: f64,
    linear: Complex,
}

/// (w, v) → (a w, b w + A v).
#[derive(Clone, Copy, Debug)]
struct PlaneMap {
    angular: f64,
    lower: Complex,
    diagonal: Complex,
}

/// Where the components in the plane, (y; z, x), are among six.
const PLACES: [usize; 3] = [1, 5, 3];

/// L(Λ) ζ for a displacement in the plane and a wrench that need not lie in it: m × w + n × v, n × w.
#[inline(always)]
fn change_of(wrench: &Wrench, zeta: &[f64; 6]) -> [f64; 6] {
    let (m, n, [_, w, _, x, _, z]) = (&wrench.moment, &wrench.force, *zeta);
    [n.y * z - m.z * w, n.z * x - n.x * z, m.x * w - n.y * x, -n.z * w, 0.0, n.x * w]
}

/// Whether a rod with this constraint is in its plane when its strain twists are these.
#[inline(always)]
pub(super) fn holds<const S: usize>(constraint: &Constraint, xi: &[Twist; S]) -> bool {
    let fixed = constraint.fixed();
    let in_plane = |xi: &Twist| xi.angular.x == 0.0 && xi.angular.z == 0.0 && xi.linear.y == 0.0;
    fixed[0] && !fixed[1] && fixed[2] && fixed[4] && xi.iter().all(in_plane)
}

impl PlaneTwist {
    #[inline(always)]
    fn zero() -> Self {
        Self { angular: 0.0, linear: Complex::new(0.0, 0.0) }
    }

    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        Self { angular: self.angular * factor, linear: self.linear * factor }
    }

    #[inline(always)]
    fn bracket(&self, other: &Self) -> Self {
        let linear = turned(other.linear * self.angular - self.linear * other.angular);
        Self { angular: 0.0, linear }
    }

    #[inline(always)]
    fn ad(&self) -> PlaneMap {
        let diagonal = Complex::new(0.0, self.angular);
        PlaneMap { angular: 0.0, lower: -turned(self.linear), diagonal }
    }
}

impl PlaneMap {
    #[inline(always)]
    fn identity() -> Self {
        Self { angular: 1.0, lower: Complex::new(0.0, 0.0), diagonal: Complex::new(1.0, 0.0) }
    }

    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        let Self { angular, lower, diagonal } = self;
        Self { angular: angular * factor, lower: lower * factor, diagonal: diagonal * factor }
    }
}

impl Add for PlaneTwist {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { angular: self.angular + other.angular, linear: self.linear + other.linear }
    }
}

impl Sub for PlaneTwist {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { angular: self.angular - other.angular, linear: self.linear - other.linear }
    }
}

impl Add for PlaneMap {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            angular: self.angular + other.angular,
            lower: self.lower + other.lower,
            diagonal: self.diagonal + other.diagonal,
        }
    }
}

impl Sub for PlaneMap {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + other.scale(-1.0)
    }
}

impl Mul for PlaneMap {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            angular: self.angular * other.angular,
            lower: self.lower * other.angular + self.diagonal * other.lower,
            diagonal: self.diagonal * other.diagonal,
        }
    }
}
