//! The strong form of the rod, solved for the rate of the strain along s.

use nalgebra::{Matrix6, Vector6};

use super::Rod;
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::{Pose, Strain, Twist, Wrench};
use crate::load::RateLoad;
use crate::material::Request;

/// A section of a rod as the strong form sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionState {
    /// Arc length s, m.
    pub s: f64,
    /// Pose g.
    pub pose: Pose,
    /// Strain Δξ.
    pub strain: Strain,
    /// How it moves; `None` at rest.
    pub motion: Option<Motion>,
}

/// How a section moves, and what it weighs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Inertia M per length of the reference, rows and columns (angular, linear).
    pub inertia: Matrix6<f64>,
    /// Velocity η in the body frame.
    pub velocity: Twist,
    /// Acceleration η̇ in the body frame.
    pub acceleration: Twist,
}

impl Motion {
    /// M η̇ − ad_ηᵀ M η.
    fn inertial_wrench(&self) -> Wrench {
        let momentum = Wrench::from_vector(&(self.inertia * self.velocity.to_vector()));
        let change = Wrench::from_vector(&(self.inertia * self.acceleration.to_vector()));
        change - momentum.ad_transpose(&self.velocity)
    }
}

/// What the strong form gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainRate {
    /// ξ′ = ξ*′ + Δξ′.
    pub twist: Twist,
    /// Δξ′.
    pub strain: Strain,
    /// Condition of ∂Ψ/∂Δξ − Ā in the 1-norm, with rows and columns scaled by the roots of its diagonal: rounding is multiplied by it.
    pub condition: f64,
}

/// A matrix of this condition leaves no digit.
const WORST_CONDITION: f64 = 1e15;

impl<B: Elastic> Rod<B> {
    /// The rate of the strain twist along the rod at a section, by the balance of momentum, the law, and the loads per length of this rod.
    ///
    /// ```math
    /// \xi' = \left(\frac{\partial\Psi}{\partial\Delta\xi} - \bar A\right)^{-1}
    /// \Bigl(M\dot\eta - \mathrm{ad}_\eta^{\mathsf T} M\eta + \mathrm{ad}_\xi^{\mathsf T}\Psi - \Psi' + \bar B
    /// + \frac{\partial\Psi}{\partial\Delta\xi}\,(\xi^*)'\Bigr)
    /// ```
    ///
    /// The last term is that of a reference that varies along s. Actuators of the section are in Ψ; the other loads are B̄ = −f̄ with Ā = 0, but for those
    /// that give [both](crate::load::Load::rate); [`strain_rate_with`](Self::strain_rate_with) takes one more. The wrench at the base, marched by this to the tip, is a solution where it
    /// arrives at the load on the tip.
    ///
    /// ```
    /// use hyperrod::rod::SectionState;
    /// use hyperrod::{Body, Pose, Rod, Strain, section::Stiffness};
    /// # fn main() -> hyperrod::Result<()> {
    /// let rod = Rod::clamped(Body::new(1.0, Stiffness::diagonal([2.0, 2.0, 1.0, 1e3, 1e3, 3e3])?)?, Pose::identity());
    /// let mut strain = Strain::zero();
    /// strain.linear.x = 1e-3; // a shear force of 1 N along x
    /// let at = SectionState { s: 0.0, pose: Pose::identity(), strain, motion: None };
    /// assert!((rod.strain_rate(&at)?.strain.angular.y + 0.5).abs() < 1e-2); // m′ = −n_x
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`Elastic::respond`] and [`Load::at`](crate::load::Load::at); [`Error::Singular`] where the matrix is singular or so ill-conditioned that no digit is
    /// left; [`Error::InvalidAt`] for a body with a [constraint](crate::body::Constraint), whose law does not give all of Ψ.
    pub fn strain_rate(&self, at: &SectionState) -> Result<StrainRate> {
        self.strain_rate_with(at, &RateLoad::none())
    }

    /// As [`strain_rate`](Self::strain_rate), with one more load per length, which depends on ξ′.
    ///
    /// # Errors
    /// As [`strain_rate`](Self::strain_rate).
    pub fn strain_rate_with(&self, at: &SectionState, load: &RateLoad) -> Result<StrainRate> {
        let mut loads = self.rate_load(at, 1.0)?;
        loads.add_scaled(load, 1.0);
        self.strain_rate_under(at, &loads, 1.0)
    }

    /// The wrench per length of the loads that depend on ξ′, all loads taken `factor` times.
    pub(crate) fn rate_wrench(&self, at: &SectionState, factor: f64) -> Result<Wrench> {
        let load = self.rate_load(at, factor)?;
        let rate = self.strain_rate_under(at, &load, factor)?;
        Ok(-(Wrench::from_vector(&(load.a_bar * rate.twist.to_vector())) + load.b_bar))
    }

    /// The sum of (Ā, B̄) of the loads.
    fn rate_load(&self, at: &SectionState, factor: f64) -> Result<RateLoad> {
        let (body, mut sum) = (self.body(), RateLoad::none());
        let xi = body.reference(at.s).twist + at.strain;
        for own in self.loads() {
            if let Some(load) = own.rate(body, at.s, &at.pose, &xi)? {
                sum.add_scaled(&load, factor);
            }
        }
        Ok(sum)
    }

    fn strain_rate_under(&self, at: &SectionState, load: &RateLoad, factor: f64) -> Result<StrainRate> {
        let body = self.body();
        let fixed = body.constraint().fixed().iter().filter(|fixed| **fixed).count();
        if fixed > 0 {
            let quantity = "number of strains that are fixed";
            let requirement = "zero for the strong form: the law gives no wrench for them";
            return Err(Error::InvalidAt { quantity, value: fixed as f64, requirement, s: at.s });
        }
        let response = body.respond(at.s, &at.strain, Request::Rate)?;
        let reference = body.reference(at.s);
        let xi = reference.twist + at.strain;
        let mut balance = response.wrench.ad_transpose(&xi) - response.wrench_rate + load.b_bar;
        for own in self.loads() {
            balance -= own.at(body, at.s, &at.pose)?.wrench * factor;
        }
        if let Some(motion) = &at.motion {
            balance += motion.inertial_wrench();
        }
        // (∂Ψ − Ā) Δξ′ = … + Ā ξ*′
        let right = balance.to_vector() + load.a_bar * reference.rate.to_vector();
        let (strain, condition) = solve(&(response.tangent - load.a_bar), &right)
            .ok_or(Error::Singular { matrix: "tangent of the strong form", s: at.s })?;
        let strain = Strain::from_vector(&strain);
        Ok(StrainRate { twist: reference.rate + strain, strain, condition })
    }
}

/// The solution and the condition, in units in which the diagonal is one. `None` where no digit of it is left.
fn solve(matrix: &Matrix6<f64>, right: &Vector6<f64>) -> Option<(Vector6<f64>, f64)> {
    let unit = Vector6::from_fn(|i, _| {
        let size = matrix[(i, i)].abs().sqrt();
        if size > 0.0 { 1.0 / size } else { 1.0 }
    });
    let scaled = Matrix6::from_fn(|r, c| matrix[(r, c)] * unit[r] * unit[c]);
    let inverse = scaled.try_inverse()?;
    let norm = |m: &Matrix6<f64>| m.column_iter().fold(0.0, |norm: f64, c| norm.max(c.lp_norm(1)));
    let condition = norm(&scaled) * norm(&inverse);
    let solution = (inverse * right.component_mul(&unit)).component_mul(&unit);
    let fine = condition < WORST_CONDITION && solution.iter().all(|v| v.is_finite());
    fine.then_some((solution, condition))
}
