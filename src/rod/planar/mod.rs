//! The element of a rod that stays in the plane of its directors x and z: the same formulas in SE(2), where a rotation is a number, eight elements at a
//! time as in [`lanes`](super::lanes).
//!
//! Vectors of the plane are complex, u = u_z + i u_x, so that e_y × u is i u and a rotation by θ is e^{iθ}. A twist is (ω, ν) with real ω and complex ν,
//! [(ω, ν), (w, v)] = (0, i(ω v − w ν)), and every map that occurs is (w, v) → (a w, b w + A v) with a real and b, A complex.

mod algebra;
mod answer;
mod condense;
mod eliminate;
mod magnus;
mod motion;
mod rows;

pub(super) use answer::answer;
pub(super) use condense::condense;
pub(super) use condense::{Eliminated, columns};
pub(super) use motion::pose_of;
pub(crate) use motion::{kinematics, wrenches};
pub(super) use rows::Linearised;

use crate::body::Constraint;
use crate::lie::{Twist, Wrench};
use crate::load::LoadWrench;

/// Where the components in the plane, (y; z, x), are among six.
pub(crate) const PLACES: [usize; 3] = [1, 5, 3];

/// Where those out of it are.
const OUTSIDE: [usize; 3] = [0, 2, 4];

/// Whether a constraint keeps a rod in its plane that is there at rest.
pub(crate) fn keeps(constraint: &Constraint) -> bool {
    let fixed = constraint.fixed();
    fixed[0] && !fixed[1] && fixed[2] && fixed[4]
}

/// Whether strain twists lie in the plane.
#[inline(always)]
pub(crate) fn contains(xi: &[Twist]) -> bool {
    xi.iter().all(|xi| xi.angular.x == 0.0 && xi.angular.z == 0.0 && xi.linear.y == 0.0)
}

/// Whether wrenches do.
pub(crate) fn carries(wrenches: &[Wrench]) -> bool {
    wrenches.iter().all(|w| w.moment.x == 0.0 && w.moment.z == 0.0 && w.force.y == 0.0)
}

/// Whether a load stays in the plane, and its change too when the section moves in the plane.
pub(crate) fn has(load: &LoadWrench) -> bool {
    let six = load.wrench.to_array();
    let still = |r: usize| PLACES.iter().all(|&c| load.tangent[(r, c)] == 0.0);
    OUTSIDE.iter().all(|&r| six[r] == 0.0 && still(r))
}
