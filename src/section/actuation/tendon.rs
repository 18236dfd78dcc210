use nalgebra::Vector3;

use super::Actuator;
use super::routing::{Routing, path};
use crate::error::{Result, not_negative, positive};
use crate::lie::{Strain, Twist};
use crate::material::Station;
use crate::scalar::Scalar;

/// A frictionless tendon under constant tension T through the section at r(s): energy T per length of its own path.
///
/// ```math
/// U = T\,|\gamma|, \qquad \gamma = \nu + \omega \times r + r' , \qquad
/// \Psi = T\,(r \times t,\; t), \qquad t = \gamma/|\gamma|
/// ```
///
/// The whole of a tendon is in this energy: the pull on its end, and the force f = T(t′ + ω × t) with which it presses on the rod where it bends. As a
/// load on the rod without it, f̄ = (r × f, f) = −(Ā ξ′ + B̄).
///
/// A tendon that [ends before the tip](Self::ending_at) is fixed there; the strain jumps at its end, where the mesh must have a node.
///
/// The strain energy that a solution reports contains T times the length of the tendon.
///
/// Nothing compares r(s) with the shape of the section: on an arm that tapers, a tendon at a constant distance from the axis may run outside
/// the arm towards the tip, as one does that is led by discs. [`Converging`](super::Converging) keeps it inside.
///
/// ```
/// use hyperrod::section::{Converging, Helical, Tendon};
/// # fn main() -> hyperrod::Result<()> {
/// let straight = Tendon::new([8e-3, 0.0], 1.0)?;
/// let to_the_axis = Tendon::new(Converging { from: [8e-3, 0.0], to: [0.0, 0.0], length: 0.4 }, 1.0)?;
/// let helix = Tendon::new(Helical { radius: 8e-3, pitch: 0.4, start: 0.0 }, 1.0)?.ending_at(0.3)?;
/// # let _ = (straight, to_the_axis, helix); Ok(()) }
/// ```
///
/// Source: Rucker and Webster (2011), IEEE Trans. Robot. 27, 1033, for the load; here as an energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tendon<R> {
    routing: R,
    tension: f64,
    end: Option<f64>,
}

impl<R: Routing> Tendon<R> {
    /// A tendon from the base to the tip, under a tension in N.
    ///
    /// # Errors
    /// If the tension is negative or not finite.
    pub fn new(routing: R, tension: f64) -> Result<Self> {
        not_negative("tension of a tendon", tension)?;
        Ok(Self { routing, tension, end: None })
    }

    /// The same, fixed to the rod at s instead of its tip.
    ///
    /// # Errors
    /// If s is not positive and finite.
    pub fn ending_at(self, s: f64) -> Result<Self> {
        positive("arc length at which a tendon ends", s)?;
        Ok(Self { end: Some(s), ..self })
    }

    /// The same under another tension, N.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_tension(self, tension: f64) -> Result<Self> {
        Ok(Self { end: self.end, ..Self::new(self.routing, tension)? })
    }

    /// Tension T, N.
    pub fn tension(&self) -> f64 {
        self.tension
    }

    /// The length of tendon per length of the reference of the rod, |γ|; zero beyond its end.
    pub fn stretch(&self, at: &Station, strain: &Strain) -> f64 {
        self.length_rate(&(at.reference.twist + *strain), at.s)
    }

    fn length_rate<D: Scalar>(&self, xi: &Twist<D>, s: D) -> D {
        if self.end.is_some_and(|end| s.re() > end) {
            return D::zero();
        }
        let ([x, y], [dx, dy]) = path(&self.routing, s);
        let along = Vector3::new(dx, dy, D::zero());
        let gamma = xi.linear + xi.angular.cross(&Vector3::new(x, y, D::zero())) + along;
        gamma.dot(&gamma).sqrt()
    }
}

impl<R: Routing> Actuator for Tendon<R> {
    fn energy<D: Scalar>(&self, xi: &Twist<D>, s: D) -> D {
        self.length_rate(xi, s) * self.tension
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.end.into_iter().collect()
    }

    fn domain(&self) -> &'static str {
        "finite: a tendon must have a length, and a finite place with finite slopes"
    }
}
