use nalgebra::Matrix6;

use crate::lie::{Pose, Wrench};
use crate::rod::condense::Transfer;
use crate::rod::element::frame_change;

/// Units in which displacements and momenta of a rod are comparable: its length, and a force its bending stiffness makes of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    pub(crate) length: f64,
    pub(crate) force: f64,
}

impl Units {
    pub(super) fn zeta(&self) -> [f64; 6] {
        [1.0, 1.0, 1.0, self.length, self.length, self.length]
    }

    pub(super) fn momentum(&self) -> [f64; 6] {
        let moment = self.force * self.length;
        [moment, moment, moment, self.force, self.force, self.force]
    }
}

fn scaled(m: &Matrix6<f64>, rows: [f64; 6], columns: [f64; 6]) -> Matrix6<f64> {
    Matrix6::from_fn(|r, c| m[(r, c)] * columns[c] / rows[r])
}

/// One element between conjugate pairs, ζ and μ = δΛ − ½ L(Λ) ζ, in units of the rod.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub(super) zeta_zeta: Matrix6<f64>,
    pub(super) zeta_momentum: Matrix6<f64>,
    pub(super) momentum_zeta: Matrix6<f64>,
    pub(super) momentum_momentum: Matrix6<f64>,
}

impl Link {
    /// From the transfer of an element and the wrenches at its ends.
    pub(crate) fn new(transfer: &Transfer, start: &Wrench, end: &Wrench, units: &Units) -> Self {
        let (half_start, half_end) = (frame_change(start) * 0.5, frame_change(end) * 0.5);
        let zeta_zeta = transfer.zeta_from_zeta + transfer.zeta_from_wrench * half_start;
        let wrench_zeta = transfer.wrench_from_zeta + transfer.wrench_from_wrench * half_start;
        let momentum_momentum = transfer.wrench_from_wrench - half_end * transfer.zeta_from_wrench;
        let (zeta, momentum) = (units.zeta(), units.momentum());
        Self {
            zeta_zeta: scaled(&zeta_zeta, zeta, zeta),
            zeta_momentum: scaled(&transfer.zeta_from_wrench, zeta, momentum),
            momentum_zeta: scaled(&(wrench_zeta - half_end * zeta_zeta), momentum, zeta),
            momentum_momentum: scaled(&momentum_momentum, momentum, momentum),
        }
    }
}

impl Link {
    /// A corner: ζ⁺ = Ad_C⁻¹ ζ⁻, μ⁺ = Ad_Cᵀ μ⁻.
    pub(crate) fn corner(corner: &Pose, units: &Units) -> Self {
        let (zeta, momentum) = (units.zeta(), units.momentum());
        Self {
            zeta_zeta: scaled(&corner.adjoint_inverse().to_matrix(), zeta, zeta),
            zeta_momentum: Matrix6::zeros(),
            momentum_zeta: Matrix6::zeros(),
            momentum_momentum: scaled(&corner.adjoint().to_matrix().transpose(), momentum, momentum),
        }
    }
}
