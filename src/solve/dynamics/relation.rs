//! How velocities and accelerations of a section at a new time follow from its pose: the time scheme, seen from one point.

use nalgebra::{Matrix3, Matrix6};

use crate::lie::{Pose, Strain, Twist, TwistMap, se3, so3::hat};

/// The scheme at one of its instants. φ = log(g_n⁻¹ g) is the motion since the step began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Relation {
    /// Nothing moves.
    Static,
    /// Velocity and acceleration are given; what is sought is a correction of the acceleration, in the place of a displacement.
    Held,
    /// Velocity is given; what is sought is a correction of it.
    Impulse,
    /// η = c_v φ + η₀, η̇ = c_a φ + η̇₀, ξ̇ = c_v (ξ − ξ_n) + ξ̇₀.
    Newmark { velocity: f64, acceleration: f64 },
    /// φ̇ = c φ + φ̇₀, η = dexp₋φ φ̇, η̇ = c η + η̇₀, ξ̇ = c (ξ − ξ_n) + ξ̇₀.
    RungeKutta { c: f64 },
}

/// The constants of the relation at one point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset {
    /// η₀ or φ̇₀.
    pub(super) velocity: Twist,
    pub(super) acceleration: Twist,
}

/// What follows from a pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rates {
    pub(super) phi: Twist,
    /// φ̇.
    pub(super) slope: Twist,
    pub(super) velocity: Twist,
    pub(super) acceleration: Twist,
}

impl Offset {
    pub(super) fn zero() -> Self {
        Self { velocity: Twist::zero(), acceleration: Twist::zero() }
    }
}

impl Rates {
    pub(super) fn zero() -> Self {
        let zero = Twist::zero();
        Self { phi: zero, slope: zero, velocity: zero, acceleration: zero }
    }
}

impl Relation {
    /// As a kind and two coefficients.
    pub(super) fn to_numbers(self) -> (u8, f64, f64) {
        match self {
            Self::Static | Self::Held | Self::Impulse => (0, 0.0, 0.0),
            Self::Newmark { velocity, acceleration } => (1, velocity, acceleration),
            Self::RungeKutta { c } => (2, c, 0.0),
        }
    }

    /// The opposite of [`to_numbers`](Self::to_numbers).
    pub(super) fn from_numbers((kind, a, b): (u8, f64, f64)) -> Option<Self> {
        match kind {
            1 => Some(Self::Newmark { velocity: a, acceleration: b }),
            2 => Some(Self::RungeKutta { c: a }),
            _ => None,
        }
    }

    #[inline(always)]
    pub(super) fn rates(&self, before: &Pose, now: &Pose, offset: &Offset) -> Rates {
        match *self {
            Self::Static => Rates::zero(),
            Self::Held | Self::Impulse => Rates {
                phi: Twist::zero(),
                slope: offset.velocity,
                velocity: offset.velocity,
                acceleration: offset.acceleration,
            },
            Self::Newmark { velocity, acceleration } => {
                let phi = se3::log(&(before.inverse() * *now));
                let eta = phi * velocity + offset.velocity;
                Rates {
                    phi,
                    slope: eta,
                    velocity: eta,
                    acceleration: phi * acceleration + offset.acceleration,
                }
            }
            Self::RungeKutta { c } => {
                let phi = se3::log(&(before.inverse() * *now));
                let slope = phi * c + offset.velocity;
                let velocity = se3::dexp(&-phi).apply(&slope);
                Rates { phi, slope, velocity, acceleration: velocity * c + offset.acceleration }
            }
        }
    }

    /// Whether what is sought is a rate, in the place of a displacement: the pose stays.
    pub(super) fn is_of_rates(&self) -> bool {
        matches!(self, Self::Held | Self::Impulse)
    }

    /// The factor of ξ in ξ̇.
    pub(super) fn strain_factor(&self) -> f64 {
        match *self {
            Self::Static | Self::Held | Self::Impulse => 0.0,
            Self::Newmark { velocity, .. } => velocity,
            Self::RungeKutta { c } => c,
        }
    }

    /// ξ̇.
    #[inline(always)]
    pub(super) fn strain_rate(&self, before: &Strain, now: &Strain, offset: &Strain) -> Strain {
        (*now - *before) * self.strain_factor() + *offset
    }

    /// The derivative of the inertia force −(M η̇ − ad_ηᵀ M η) in a displacement of the section:
    ///
    /// −(M ∂η̇ + C ∂η), C = −L(M η) − ad_ηᵀ M, with ∂η = c_v dexp₋φ⁻¹, ∂η̇ = c_a dexp₋φ⁻¹, or ∂η = c + ½ ad_φ̇, ∂η̇ = c ∂η.
    ///
    /// The latter leaves out what is of second order in φ.
    pub(super) fn inertia_tangent(&self, mass: &Matrix6<f64>, rates: &Rates) -> Matrix6<f64> {
        let coriolis = || {
            let momentum = mass * rates.velocity.to_vector();
            let (m, n) = (momentum.fixed_rows::<3>(0).into(), momentum.fixed_rows::<3>(3).into());
            let mut change = blocks(&hat(&m), &hat(&n), &hat(&n), &Matrix3::zeros());
            change += rates.velocity.ad().to_matrix().transpose() * mass;
            -change
        };
        let map = |velocity: f64, acceleration: f64, x: &TwistMap| {
            -(mass * acceleration + coriolis() * velocity) * x.to_matrix()
        };
        match *self {
            Self::Static => Matrix6::zeros(),
            Self::Held | Self::Impulse => -mass,
            Self::Newmark { velocity, acceleration } => {
                map(velocity, acceleration, &se3::dexp_inv(&-rates.phi))
            }
            Self::RungeKutta { c } => {
                let x = TwistMap::identity() + rates.slope.ad().scale(0.5 / c);
                map(c, c * c, &x)
            }
        }
    }
}

fn blocks(aa: &Matrix3<f64>, al: &Matrix3<f64>, la: &Matrix3<f64>, ll: &Matrix3<f64>) -> Matrix6<f64> {
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).copy_from(aa);
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(al);
    m.fixed_view_mut::<3, 3>(3, 0).copy_from(la);
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(ll);
    m
}
