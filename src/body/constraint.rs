use nalgebra::Matrix6;

use crate::lie::Strain;
use crate::material::Active;

/// The strains that a rod cannot have: they keep their reference value, Δξ_k = 0, whatever the wrench.
///
/// The components of the wrench that go with them are reactions: the balance gives them, not the law, whose answer to these strains is not asked for.
/// That is the limit of a stiffness without bound, taken exactly; there is no penalty. A solve has fewer unknowns for it.
///
/// | constraint | Δξ that are zero |
/// |---|---|
/// | [`inextensible`](Self::inextensible) | Δν_z |
/// | [`unshearable`](Self::unshearable) | Δν_x, Δν_y |
/// | [`kirchhoff`](Self::kirchhoff) | Δν: both |
/// | [`twist_free`](Self::twist_free) | Δω_z |
/// | [`planar`](Self::planar) | Δω_x, Δω_z, Δν_y: bending about y, in the plane of x and z |
/// | [`fixing`](Self::fixing) | any |
///
/// ```
/// use hyperrod::body::Constraint;
/// use hyperrod::{Body, section::Stiffness};
/// # fn main() -> hyperrod::Result<()> {
/// let section = Stiffness::diagonal([1.0; 6])?; // the last three are of no consequence
/// let wire = Body::new(1.0, section)?.with_constraint(Constraint::kirchhoff());
/// let elastica = Constraint::kirchhoff().and(Constraint::planar());
/// assert_eq!(elastica.fixed(), [true, false, true, true, true, true]);
/// # let _ = wire; Ok(()) }
/// ```
///
/// Source: Antman (2005), *Nonlinear Problems of Elasticity*, ch. 8, for constrained rods and their reactions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Constraint {
    fixed: [bool; 6],
}

impl Constraint {
    /// All strains free.
    pub const fn none() -> Self {
        Self { fixed: [false; 6] }
    }

    /// Any set, in the order (ω_x, ω_y, ω_z, ν_x, ν_y, ν_z): `true` fixes.
    pub const fn fixing(strains: [bool; 6]) -> Self {
        Self { fixed: strains }
    }

    /// The axis keeps its length.
    pub const fn inextensible() -> Self {
        Self::fixing([false, false, false, false, false, true])
    }

    /// Sections stay as they stand to the axis at rest.
    pub const fn unshearable() -> Self {
        Self::fixing([false, false, false, true, true, false])
    }

    /// Inextensible and unshearable.
    pub const fn kirchhoff() -> Self {
        Self::fixing([false, false, false, true, true, true])
    }

    /// Keeps its twist.
    pub const fn twist_free() -> Self {
        Self::fixing([false, false, true, false, false, false])
    }

    /// Stays in the plane of its directors x and z, and bends about y. The reference must lie in that plane for the rod to do so.
    ///
    /// What places the plane is the first support, or the first few, along the rod: those after it take nothing across it, since nothing would tell how much.
    /// Between two [`pinned`](crate::rod::Support::pinned) ends the plane itself can turn: one of them must hold [`RotationZ`](crate::rod::Freedom::RotationZ).
    ///
    /// Where the loads lie in it too, a solve has three components where one in space has six. Its [stability](crate::solve::Stability) is that in the
    /// plane: whether it would rather leave it is not asked of a rod that cannot.
    pub const fn planar() -> Self {
        Self::fixing([true, false, true, false, true, false])
    }

    /// Both constraints together.
    pub fn and(self, other: Self) -> Self {
        Self { fixed: std::array::from_fn(|i| self.fixed[i] || other.fixed[i]) }
    }

    /// Which strains are fixed.
    pub const fn fixed(&self) -> [bool; 6] {
        self.fixed
    }

    /// A strain without the part that is fixed.
    pub(crate) fn free_part(&self, strain: Strain) -> Strain {
        let mut free = strain.to_array();
        free.iter_mut().zip(self.fixed).filter(|(_, fixed)| *fixed).for_each(|(strain, _)| *strain = 0.0);
        Strain::from_array(free)
    }

    /// Those that are not.
    pub fn active(&self) -> Active {
        Active::of(self.fixed.map(|fixed| !fixed))
    }

    /// A tangent with a number on the diagonal for the strains that are fixed, and nothing else of theirs.
    pub(crate) fn of_free(&self, tangent: &Matrix6<f64>, diagonal: f64) -> Matrix6<f64> {
        let mut free = *tangent;
        for i in (0..6).filter(|&i| self.fixed[i]) {
            free.row_mut(i).fill(0.0);
            free.column_mut(i).fill(0.0);
            free[(i, i)] = diagonal;
        }
        free
    }

    /// The diagonal of a tangent, with a number in place of what it has for the strains that are fixed.
    pub(crate) fn diagonal_of_free(&self, tangent: &Matrix6<f64>, fixed: f64) -> [f64; 6] {
        std::array::from_fn(|i| if self.fixed[i] { fixed } else { tangent[(i, i)] })
    }

    /// Whether all strains are free.
    pub fn is_none(&self) -> bool {
        *self == Self::none()
    }
}
