//! Three of the strains, known when a law is compiled: those that a rod in a plane has, and those of one without shear and extension.

use super::active::Active;
use super::differentiate::Fibre;
use crate::scalar::{Jet, Lane};

/// A set of three strains.
#[derive(Clone, Copy, Debug)]
pub(super) enum Set {
    Plane,
    Rotations,
}

impl Set {
    /// One that contains all that are active.
    pub(super) fn of(active: Active) -> Option<Self> {
        let contains_all = |set: &Self| active.places().all(|i| set.places().contains(&i));
        [Self::Plane, Self::Rotations].into_iter().find(contains_all)
    }

    pub(super) const fn places(self) -> [usize; 3] {
        match self {
            Self::Plane => Plane::PLACES,
            Self::Rotations => Rotations::PLACES,
        }
    }
}

/// A set as a type: one strain ε that shears and two that stretch, so that a law of the deformation is one of two variables at a point,
///
/// u(γ + ε d, e + η), with η = p₁ ε₁ + p₂ ε₂.
pub trait Three: Send + Sync {
    /// Where they are among the six: that which shears, and the two that stretch.
    const PLACES: [usize; 3];

    /// ∂e/∂ε₁ and ∂e/∂ε₂ at a point.
    fn stretch<L: Lane>(position: [L; 2]) -> [L; 2];

    /// γ as a function of ε and η.
    fn gamma<L: Lane>(fibre: &Fibre<L>) -> [Jet<L, 2, 3>; 3];

    /// ∂s/∂ε and ∂²s/∂ε² of s = a² + b².
    fn shear<L: Lane>(fibre: &Fibre<L>) -> [L; 2];
}

/// ν_x, ω_y and ν_z.
pub struct Plane;
/// ω_z, ω_x and ω_y.
pub struct Rotations;

impl Three for Plane {
    const PLACES: [usize; 3] = [3, 1, 5];

    #[inline(always)]
    fn stretch<L: Lane>([x, _]: [L; 2]) -> [L; 2] {
        [-x, L::splat(1.0)]
    }

    #[inline(always)]
    fn gamma<L: Lane>(fibre: &Fibre<L>) -> [Jet<L, 2, 3>; 3] {
        let [a, b, e] = fibre.gamma;
        [Jet::variable(a, 0), Jet::constant(b), Jet::variable(e, 1)]
    }

    #[inline(always)]
    fn shear<L: Lane>(fibre: &Fibre<L>) -> [L; 2] {
        let [a, ..] = fibre.gamma;
        [a + a, L::splat(2.0)]
    }
}

impl Three for Rotations {
    const PLACES: [usize; 3] = [2, 0, 1];

    #[inline(always)]
    fn stretch<L: Lane>([x, y]: [L; 2]) -> [L; 2] {
        [y, -x]
    }

    /// d = (−y, x).
    #[inline(always)]
    fn gamma<L: Lane>(fibre: &Fibre<L>) -> [Jet<L, 2, 3>; 3] {
        let ([a, b, e], [x, y]) = (fibre.gamma, fibre.position);
        [Jet::constant(a).with_slope(0, -y), Jet::constant(b).with_slope(0, x), Jet::variable(e, 1)]
    }

    #[inline(always)]
    fn shear<L: Lane>(fibre: &Fibre<L>) -> [L; 2] {
        let ([a, b, _], [x, y]) = (fibre.gamma, fibre.position);
        let (slope, square) = (x.mul_add(b, -(y * a)), x.mul_add(x, y * y));
        [slope + slope, square + square]
    }
}
