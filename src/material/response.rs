use nalgebra::{ArrayStorage, Matrix6, Vector3};

use crate::error::{Error, Result};
use crate::lie::{Strain, Twist, Wrench};

/// How much of the response is asked for; each costs only its own derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Request {
    /// The energy per length U.
    Energy,
    /// U and the wrench Ψ = ∂U/∂Δξ.
    Wrench,
    /// U, Ψ and the tangent ∂Ψ/∂Δξ.
    Tangent,
    /// U, Ψ, ∂Ψ/∂Δξ and Ψ′ = ∂Ψ/∂s at fixed Δξ.
    Rate,
}

/// What a section answers to a strain. Entries that were not asked for are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Energy per length U, J/m.
    pub energy: f64,
    /// Wrench Ψ = ∂U/∂Δξ: moment in N m, force in N.
    #[doc(alias = "Psi")]
    pub wrench: Wrench,
    /// Tangent ∂Ψ/∂Δξ, symmetric; rows and columns (angular, linear).
    pub tangent: Matrix6<f64>,
    /// Ψ′ = ∂Ψ/∂s at fixed Δξ: moment in N, force in N/m.
    #[doc(alias = "Psi_prime")]
    pub wrench_rate: Wrench,
}

impl Response {
    pub(super) const ZERO: Self = {
        let wrench = Wrench { moment: Vector3::new(0.0, 0.0, 0.0), force: Vector3::new(0.0, 0.0, 0.0) };
        let tangent = Matrix6::from_array_storage(ArrayStorage([[0.0; 6]; 6]));
        Self { energy: 0.0, wrench, tangent, wrench_rate: wrench }
    };

    /// No response.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::ZERO
    }

    /// Whether every number is finite.
    #[inline(always)]
    pub fn is_finite(&self) -> bool {
        // 0 x is 0 for a finite x and NaN otherwise: one sum tells of all
        let mut sum = 0.0 * self.energy;
        for v in self.tangent.as_slice() {
            sum += 0.0 * v;
        }
        for v in self.wrench.to_array().into_iter().chain(self.wrench_rate.to_array()) {
            sum += 0.0 * v;
        }
        sum == 0.0
    }
}

impl std::ops::AddAssign for Response {
    fn add_assign(&mut self, other: Self) {
        self.energy += other.energy;
        self.wrench += other.wrench;
        self.tangent += other.tangent;
        self.wrench_rate += other.wrench_rate;
    }
}

/// The reference strain twist ξ*(s) of a rod and its derivative in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// ξ*.
    pub twist: Twist,
    /// ξ*′.
    pub rate: Twist,
}

impl Reference {
    /// Straight and unstretched along e₃.
    pub fn straight() -> Self {
        Self { twist: Twist::straight(), rate: Twist::zero() }
    }

    /// Whether the volume of the reference per dA ds, γ*·e₃ = ν*_z + ω*_x y − ω*_y x, is anything but 1.
    #[inline(always)]
    pub(crate) fn is_curved(&self) -> bool {
        let (xi, rate) = (&self.twist, &self.rate);
        !(xi.angular.x == 0.0
            && xi.angular.y == 0.0
            && xi.linear.z == 1.0
            && rate.angular.x == 0.0
            && rate.angular.y == 0.0
            && rate.linear.z == 0.0)
    }
}

/// A place along the rod: arc length and reference strain there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Arc length s, m.
    pub s: f64,
    /// The reference strain at s.
    pub reference: Reference,
}

impl Station {
    /// At s on a rod whose reference is straight.
    pub fn straight(s: f64) -> Self {
        Self { s, reference: Reference::straight() }
    }
}

/// Points and weights of a section at one arc length: ∫ f dA ≈ Σ w f(x, y).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// First coordinates, m.
    pub x: Vec<f64>,
    /// Second coordinates, m.
    pub y: Vec<f64>,
    /// Weights, m².
    pub weight: Vec<f64>,
    /// How they move with s; `None` where they do not.
    pub rates: Option<PointRates>,
}

/// Derivatives in s of the points and weights of a section that varies along the rod.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointRates {
    /// x′.
    pub x: Vec<f64>,
    /// y′.
    pub y: Vec<f64>,
    /// w′, m.
    pub weight: Vec<f64>,
}

impl Points {
    /// How many points.
    pub fn len(&self) -> usize {
        self.weight.len()
    }

    /// Whether there is no point at all.
    pub fn is_empty(&self) -> bool {
        self.weight.is_empty()
    }
}

/// Refuses a strain with a component that is not a number.
pub(crate) fn check_strain(strain: &Strain, s: f64) -> Result<()> {
    const NAMES: [&str; 6] = [
        "strain component omega_x",
        "strain component omega_y",
        "strain component omega_z",
        "strain component nu_x",
        "strain component nu_y",
        "strain component nu_z",
    ];
    for (value, quantity) in strain.to_array().into_iter().zip(NAMES) {
        if !value.is_finite() {
            return Err(Error::InvalidAt { quantity, value, requirement: "finite", s });
        }
    }
    Ok(())
}
