use nalgebra::Matrix6;

use super::eigen::Symmetric;
use crate::lie::{Pose, Wrench};
use crate::rod::condense::Transfer;
use crate::rod::element::frame_change;
use crate::solve::scale::{Scale, rescale};

/// A negative compliance of less than this part of an element's largest, in units of the element, is the error of one that does not give way:
/// an inextensible element along its axis.
const RIGID: f64 = 1e-3;

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
    pub(crate) fn new(transfer: &Transfer, start: &Wrench, end: &Wrench, scale: &Scale) -> Self {
        let (half_start, half_end) = (frame_change(start) * 0.5, frame_change(end) * 0.5);
        let zeta_zeta = transfer.zeta_from_zeta + transfer.zeta_from_wrench * half_start;
        let wrench_zeta = transfer.wrench_from_zeta + transfer.wrench_from_wrench * half_start;
        let momentum_momentum = transfer.wrench_from_wrench - half_end * transfer.zeta_from_wrench;
        let (zeta, momentum) = (scale.displacement(), scale.wrench());
        Self {
            zeta_zeta: rescale(&zeta_zeta, zeta, zeta),
            zeta_momentum: rescale(&transfer.zeta_from_wrench, zeta, momentum),
            momentum_zeta: rescale(&(wrench_zeta - half_end * zeta_zeta), momentum, zeta),
            momentum_momentum: rescale(&momentum_momentum, momentum, momentum),
        }
        .yielding()
    }

    /// The same behind a small compliance D that makes up for a negative one of the element where it is but an error: ζ → ζ + D μ at its start.
    fn yielding(mut self) -> Self {
        let Some(inverse) = self.zeta_zeta.try_inverse() else { return self };
        let compliance = inverse * self.zeta_momentum;
        // the length of the element: the distance over which a rotation becomes a displacement
        let length = self.zeta_zeta.fixed_view::<3, 3>(3, 0).norm() * std::f64::consts::FRAC_1_SQRT_2;
        let unit = |i: usize| if i < 3 { 1.0 } else { length };
        let own = Symmetric::part_of(6, |i, j| compliance[(i, j)] / (unit(i) * unit(j))).eigen();
        let (least, largest) = (own.value[0], own.value[5]);
        if least < 0.0 && least > -RIGID * largest {
            let added = Matrix6::from_fn(|i, j| if i == j { -2.0 * least * unit(i) * unit(i) } else { 0.0 });
            self.zeta_momentum += self.zeta_zeta * added;
            self.momentum_momentum += self.momentum_zeta * added;
        }
        self
    }
}

impl Link {
    /// A corner: ζ⁺ = Ad_C⁻¹ ζ⁻, μ⁺ = Ad_Cᵀ μ⁻.
    pub(crate) fn corner(corner: &Pose, scale: &Scale) -> Self {
        let (zeta, momentum) = (scale.displacement(), scale.wrench());
        Self {
            zeta_zeta: rescale(&corner.adjoint_inverse().to_matrix(), zeta, zeta),
            zeta_momentum: Matrix6::zeros(),
            momentum_zeta: Matrix6::zeros(),
            momentum_momentum: rescale(&corner.adjoint().to_matrix().transpose(), momentum, momentum),
        }
    }
}
