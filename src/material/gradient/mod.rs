//! A law at a full deformation gradient F = I + H, differentiated in the nine entries of H: what a section that relaxes asks for.
//!
//! An isotropic law is differentiated in its three invariants, and the chain to H is written out with the tensor cross product
//! (X × Y)ᵢₐ = εᵢⱼₖ εₐᵦ꜀ Xⱼᵦ Yₖ꜀, in which cof F = ½ F × F and d(cof F) = F × dF (Bonet, Gil and Ortigosa 2015, Comput. Methods Appl.
//! Mech. Eng. 283, 1061). Any other local law is differentiated in all nine.

mod batch;
mod isotropic;
mod local;

use super::kinematics::Point;
use crate::scalar::{Jet, Lane};

pub(crate) use batch::{GradientBatch, GradientLaw, GradientState};
pub(super) use isotropic::isotropic_gradient_response;
pub(super) use local::local_gradient_response;

/// Entries of the symmetric 9×9 stiffness, upper triangle by rows.
pub(crate) const STIFFNESS: usize = 45;

/// Points of the section, one a lane, and H there.
#[derive(Clone, Copy, Debug)]
pub struct GradientSite<L> {
    /// x and y.
    pub position: [L; 2],
    /// x′ and y′.
    pub position_rate: [L; 2],
    /// s.
    pub s: L,
    /// H, by rows.
    pub h: [L; 9],
}

/// Value and derivatives of an energy density u(H).
#[derive(Clone, Copy, Debug)]
pub struct GradientResponse<L> {
    /// u, J/m³.
    pub energy: L,
    /// P = ∂u/∂F by rows, the first Piola stress, Pa.
    pub stress: [L; 9],
    /// ∂²u/∂F², Pa, upper triangle by rows.
    pub stiffness: [L; STIFFNESS],
    /// ∂P/∂s at fixed H, Pa/m.
    pub stress_rate: [L; 9],
}

impl<L: Lane> GradientSite<L> {
    #[inline(always)]
    fn only(&self, i: usize) -> Self {
        let ([x, y], [dx, dy]) = (self.position, self.position_rate);
        let mut h = self.h;
        for c in 0..9 {
            h[c] = h[c].spread(i);
        }
        Self {
            position: [x.spread(i), y.spread(i)],
            position_rate: [dx.spread(i), dy.spread(i)],
            s: self.s.spread(i),
            h,
        }
    }

    #[inline(always)]
    fn fixed_point<const N: usize, const M: usize>(&self) -> Point<Jet<L, N, M>> {
        let [x, y] = self.position;
        Point { x: Jet::constant(x), y: Jet::constant(y), s: Jet::constant(self.s) }
    }

    #[inline(always)]
    fn moving_point(&self) -> Point<Jet<L, 4, 10>> {
        let ([x, y], [dx, dy]) = (self.position, self.position_rate);
        Point {
            x: Jet::constant(x).with_slope(3, dx),
            y: Jet::constant(y).with_slope(3, dy),
            s: Jet::constant(self.s).with_slope(3, L::splat(1.0)),
        }
    }
}

impl<L: Lane> GradientResponse<L> {
    #[inline(always)]
    fn energy_only(energy: L) -> Self {
        let zero = L::splat(0.0);
        Self { energy, stress: [zero; 9], stiffness: [zero; STIFFNESS], stress_rate: [zero; 9] }
    }
}

/// Where entry (i, j), i ≤ j, of a symmetric 9×9 matrix is stored.
#[inline(always)]
pub(crate) const fn packed(i: usize, j: usize) -> usize {
    i * 9 + j - i * (i + 1) / 2
}
