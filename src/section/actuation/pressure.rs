use nalgebra::Vector3;
use num_dual::Dual64;

use super::Actuator;
use super::routing::{Routing, path};
use crate::error::{Result, finite, positive};
use crate::lie::Twist;
use crate::scalar::Scalar;
use crate::section::Profile;

/// A chamber along the rod under pressure p: energy −p per volume.
///
/// ```math
/// U = -p\,A_c\; e_3 \cdot (\nu + \omega \times r), \qquad \Psi = -p\,A_c\,(r \times e_3,\; e_3)
/// ```
///
/// with the area A_c and its centroid r(s) in the section, which is rigid: a chamber that widens has another energy. Area and place may vary along the rod.
///
/// A chamber that [ends before the tip](Self::ending_at) pushes on its end wall there; the strain jumps, and the mesh must have a node.
///
/// ```
/// use hyperrod::section::PressureChamber;
/// # fn main() -> hyperrod::Result<()> {
/// let chamber = PressureChamber::new([6e-3, 0.0], 20e-6, 50e3)?; // 20 mm², 6 mm beside the axis, 50 kPa
/// # let _ = chamber; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureChamber<R, A = f64> {
    routing: R,
    area: A,
    pressure: f64,
    end: Option<f64>,
}

impl<R: Routing, A: Profile> PressureChamber<R, A> {
    /// Along the whole rod: where its centroid runs, its area in m², and the pressure above that outside, Pa; negative for a vacuum.
    ///
    /// # Errors
    /// If the pressure is not finite.
    pub fn new(routing: R, area: A, pressure: f64) -> Result<Self> {
        finite("pressure of a chamber", [&pressure])?;
        Ok(Self { routing, area, pressure, end: None })
    }

    /// The same with its end wall at s instead of the tip.
    ///
    /// # Errors
    /// If s is not positive and finite.
    pub fn ending_at(self, s: f64) -> Result<Self> {
        positive("arc length at which a chamber ends", s)?;
        Ok(Self { end: Some(s), ..self })
    }
}

impl<R: Routing, A: Profile> Actuator for PressureChamber<R, A> {
    fn energy<D: Scalar>(&self, xi: &Twist<D>, s: D) -> D {
        if self.end.is_some_and(|end| s.re() > end) {
            return D::zero();
        }
        let ([x, y], _) = path(&self.routing, s);
        let area = self.area.at(Dual64::from_re(s.re()).derivative());
        let area = (s - s.re()) * area.eps + area.re;
        let gamma = xi.linear + xi.angular.cross(&Vector3::new(x, y, D::zero()));
        -(area * gamma.z * self.pressure)
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.end.into_iter().collect()
    }

    fn domain(&self) -> &'static str {
        "finite: a chamber must have a finite area and place with finite slopes"
    }
}
