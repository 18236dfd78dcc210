use nalgebra::Matrix6;

use super::link::{Units, momentum_tangent};
use super::plane::Plane;
use crate::lie::Wrench;

/// What holds an end of the rod against small displacements, in the frame of that end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Condition {
    /// Orthonormal directions, as columns; those marked in `fixed` cannot move.
    pub(super) directions: Matrix6<f64>,
    pub(super) fixed: [bool; 6],
    /// ½ ζᵀ K ζ is the energy of springs and loads at the end, in units of the rod.
    pub(super) stiffness: Matrix6<f64>,
}

impl Condition {
    /// Components (angular, linear) of the frame of the end that cannot move, and nothing else.
    pub(crate) fn fixing(fixed: [bool; 6]) -> Self {
        Self { directions: Matrix6::identity(), fixed, stiffness: Matrix6::zeros() }
    }

    /// The same for components of another frame, given by its axes as columns in that of the end.
    pub(crate) fn in_frame(self, axes: &nalgebra::Matrix3<f64>) -> Self {
        let mut directions = Matrix6::zeros();
        directions.fixed_view_mut::<3, 3>(0, 0).copy_from(axes);
        directions.fixed_view_mut::<3, 3>(3, 3).copy_from(axes);
        Self { directions, ..self }
    }

    /// With a load on the end: its wrench and its tangent in a displacement of the end.
    pub(crate) fn with_load(mut self, wrench: &Wrench, tangent: &Matrix6<f64>, units: &Units) -> Self {
        self.stiffness -= units.stiffness(&momentum_tangent(wrench, tangent));
        self
    }

    /// The part before the first node: μ = K ζ for what can move, ζ = 0 for what cannot.
    pub(super) fn plane(&self) -> Plane {
        let (mut zeta, mut momentum) = (Matrix6::zeros(), Matrix6::zeros());
        for (c, &fixed) in self.fixed.iter().enumerate() {
            let direction = self.directions.column(c);
            if fixed {
                momentum.set_column(c, &direction);
            } else {
                zeta.set_column(c, &direction);
                momentum.set_column(c, &(0.5 * (self.stiffness + self.stiffness.transpose()) * direction));
            }
        }
        // fixed directions are orthogonal to the others: their reactions are free, and the plane stays Lagrangian
        Plane { zeta, momentum }.orthonormal().0
    }
}
