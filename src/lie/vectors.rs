use approx::{AbsDiffEq, RelativeEq, UlpsEq};
use nalgebra::{Vector3, Vector6};
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use super::{Pose, TwistMap, se3, so3::hat};
use crate::scalar::Scalar;

/// Gives a pair of 3-vectors the operations of a vector space, conversions to and from six numbers, and `approx` traits.
macro_rules! pair_of_vectors {
    ($name:ident, $first:ident, $second:ident) => {
        impl<D: Scalar> $name<D> {
            #[doc = concat!("The pair (", stringify!($first), ", ", stringify!($second), ").")]
            #[inline]
            pub fn new($first: Vector3<D>, $second: Vector3<D>) -> Self {
                Self { $first, $second }
            }

            /// All six components zero.
            #[inline]
            pub fn zero() -> Self {
                Self::new(Vector3::from_element(D::zero()), Vector3::from_element(D::zero()))
            }

            #[doc = concat!("From six numbers, `", stringify!($first), "` first.")]
            #[inline]
            pub fn from_array(v: [D; 6]) -> Self {
                Self::new(Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]))
            }

            #[doc = concat!("As six numbers, `", stringify!($first), "` first.")]
            #[inline]
            pub fn to_array(self) -> [D; 6] {
                let (a, b) = (self.$first, self.$second);
                [a.x, a.y, a.z, b.x, b.y, b.z]
            }

            #[doc = concat!("From a 6-vector, `", stringify!($first), "` first.")]
            #[inline]
            pub fn from_vector(v: &Vector6<D>) -> Self {
                Self::from_array([v[0], v[1], v[2], v[3], v[4], v[5]])
            }

            #[doc = concat!("As a 6-vector, `", stringify!($first), "` first.")]
            #[inline]
            pub fn to_vector(self) -> Vector6<D> {
                Vector6::from(self.to_array())
            }

            /// The same with every number mapped by `f`, for instance from `f64` to a dual number.
            #[inline]
            pub fn map<E: Scalar>(self, f: impl Fn(D) -> E + Copy) -> $name<E> {
                $name { $first: self.$first.map(f), $second: self.$second.map(f) }
            }
        }

        impl $name<f64> {
            /// The same numbers as constants of another scalar type.
            #[inline]
            pub fn cast<E: Scalar>(self) -> $name<E> {
                self.map(E::from)
            }

            /// Whether all six components are finite.
            pub fn is_finite(&self) -> bool {
                self.to_array().iter().all(|v| v.is_finite())
            }
        }

        impl<D: Scalar> Default for $name<D> {
            fn default() -> Self {
                Self::zero()
            }
        }

        impl<D: Scalar> Add for $name<D> {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self::new(self.$first + other.$first, self.$second + other.$second)
            }
        }

        impl<D: Scalar> AddAssign for $name<D> {
            #[inline]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl<D: Scalar> Sub for $name<D> {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self::new(self.$first - other.$first, self.$second - other.$second)
            }
        }

        impl<D: Scalar> SubAssign for $name<D> {
            #[inline]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        impl<D: Scalar> Neg for $name<D> {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                self.map(|v| -v)
            }
        }

        impl<D: Scalar> Mul<D> for $name<D> {
            type Output = Self;
            #[inline]
            fn mul(self, factor: D) -> Self {
                self.map(|v| v * factor)
            }
        }

        impl AbsDiffEq for $name<f64> {
            type Epsilon = f64;
            fn default_epsilon() -> f64 {
                f64::default_epsilon()
            }
            fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
                self.to_array().abs_diff_eq(&other.to_array(), epsilon)
            }
        }

        impl RelativeEq for $name<f64> {
            fn default_max_relative() -> f64 {
                f64::default_max_relative()
            }
            fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
                self.to_array().relative_eq(&other.to_array(), epsilon, max_relative)
            }
        }

        impl UlpsEq for $name<f64> {
            fn default_max_ulps() -> u32 {
                f64::default_max_ulps()
            }
            fn ulps_eq(&self, other: &Self, epsilon: f64, max_ulps: u32) -> bool {
                self.to_array().ulps_eq(&other.to_array(), epsilon, max_ulps)
            }
        }
    };
}

/// An element of se(3) in body frame: the strain twist ξ = (ω, ν) of g′ = g ξ^, a velocity η, or a small displacement.
///
/// As a strain: `angular` in 1/m (curvatures about x and y, twist about z), `linear` without unit; the straight
/// unstretched rod has ξ = (0, 0, 0, 0, 0, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<D = f64> {
    /// Angular part ω.
    pub angular: Vector3<D>,
    /// Linear part ν.
    pub linear: Vector3<D>,
}

/// The change of the strain twist from its reference, Δξ = ξ − ξ*: what an energy is a function of.
///
/// `angular` in 1/m: bending about x and y, twist about z. `linear` without unit: shear along x and y, stretch − 1 along z.
#[doc(alias = "Delta xi")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strain<D = f64> {
    /// Change of curvature and twist Δω, 1/m.
    pub angular: Vector3<D>,
    /// Shear (x, y) and extension (z) Δν.
    pub linear: Vector3<D>,
}

/// A moment and a force in body frame, the dual of a [`Twist`]: Λ·ξ is power (or energy) per length.
#[doc(alias = "Psi")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<D = f64> {
    /// Moment m, N m (about the origin of the section).
    pub moment: Vector3<D>,
    /// Force n, N.
    pub force: Vector3<D>,
}

pair_of_vectors!(Twist, angular, linear);
pair_of_vectors!(Strain, angular, linear);
pair_of_vectors!(Wrench, moment, force);

impl<D: Scalar> Twist<D> {
    /// The strain twist of a straight, unstretched rod along e₃: ξ* = (0, 0, 0, 0, 0, 1).
    #[inline]
    pub fn straight() -> Self {
        let mut xi = Self::zero();
        xi.linear.z = D::one();
        xi
    }

    /// The Lie bracket [ξ, η] = ad_ξ η = (ω×w, ν×w + ω×v) for ξ = (ω, ν), η = (w, v).
    #[inline]
    pub fn bracket(&self, other: &Self) -> Self {
        Self::new(
            self.angular.cross(&other.angular),
            self.linear.cross(&other.angular) + self.angular.cross(&other.linear),
        )
    }

    /// ad_ξ = [[ω^, 0], [ν^, ω^]], so that ad_ξ η = [ξ, η].
    #[inline]
    pub fn ad(&self) -> TwistMap<D> {
        TwistMap { diagonal: hat(&self.angular), lower: hat(&self.linear) }
    }

    /// The pose exp ξ^ reached by moving one unit along this twist: [`se3::exp`].
    #[inline]
    pub fn exp(&self) -> Pose<D> {
        se3::exp(self)
    }

    /// The power Λ·η of a wrench on this twist.
    #[inline]
    pub fn pair(&self, wrench: &Wrench<D>) -> D {
        wrench.moment.dot(&self.angular) + wrench.force.dot(&self.linear)
    }
}

impl<D: Scalar> Wrench<D> {
    /// ad_ξᵀ Λ = −(ω×m + ν×n, ω×n), the wrench seen by a moving frame.
    #[inline]
    pub fn ad_transpose(&self, xi: &Twist<D>) -> Self {
        Self::new(
            self.moment.cross(&xi.angular) + self.force.cross(&xi.linear),
            self.force.cross(&xi.angular),
        )
    }
}

/// ξ = ξ* + Δξ.
impl<D: Scalar> Add<Strain<D>> for Twist<D> {
    type Output = Twist<D>;
    #[inline]
    fn add(self, strain: Strain<D>) -> Twist<D> {
        Twist::new(self.angular + strain.angular, self.linear + strain.linear)
    }
}

impl<D: Scalar> Strain<D> {
    /// Δξ = ξ − ξ*. For small strains keep Δξ itself: this subtraction rounds at the size of ξ.
    #[inline]
    pub fn between(reference: &Twist<D>, xi: &Twist<D>) -> Self {
        Self::new(xi.angular - reference.angular, xi.linear - reference.linear)
    }

    /// The same components as a twist, which a change of ξ is.
    #[inline]
    pub(crate) fn as_twist(&self) -> Twist<D> {
        Twist::new(self.angular, self.linear)
    }

    /// The energy per length (or its rate) Λ·Δξ of a wrench on this strain.
    #[inline]
    pub fn pair(&self, wrench: &Wrench<D>) -> D {
        wrench.moment.dot(&self.angular) + wrench.force.dot(&self.linear)
    }
}
