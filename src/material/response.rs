use nalgebra::Matrix6;

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
    /// No response.
    pub fn zero() -> Self {
        Self {
            energy: 0.0,
            wrench: Wrench::zero(),
            tangent: Matrix6::zeros(),
            wrench_rate: Wrench::zero(),
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.energy.is_finite()
            && self.wrench.is_finite()
            && self.wrench_rate.is_finite()
            && self.tangent.iter().all(|k| k.is_finite())
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

    /// The volume of the reference body per dA ds at (x, y), j = γ*·e₃ = ν*_z + ω*_x y − ω*_y x, and its
    /// derivative when (x, y) moves at the given rate.
    #[inline]
    pub(crate) fn volume(&self, x: f64, y: f64, rate: [f64; 2]) -> (f64, f64) {
        let (xi, d_xi) = (&self.twist, &self.rate);
        let j = xi.linear.z + xi.angular.x * y - xi.angular.y * x;
        let d_j = d_xi.linear.z + d_xi.angular.x * y - d_xi.angular.y * x + xi.angular.x * rate[1]
            - xi.angular.y * rate[0];
        (j, d_j)
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

    /// (x′, y′, w′) of point `q`, zero where nothing moves.
    #[inline]
    pub(crate) fn rate(&self, q: usize) -> [f64; 3] {
        self.rates.as_ref().map_or([0.0; 3], |r| [r.x[q], r.y[q], r.weight[q]])
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
