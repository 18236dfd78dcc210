//! Numbers of a block of elements of the plane in memory.

use super::PLACES;
use super::algebra::{Complex, PlaneTwist};
use super::magnus::Placed;
use crate::lie::Wrench;
use crate::rod::element::ElementState;
use crate::rod::lanes::{ELEMENTS, NOTHING, Row, STAGES};
use crate::scalar::Lane;

/// Components in the plane, (y; z, x).
pub(super) type Three = [Row; 3];

/// A moment and a force of the plane.
pub(super) type PlaneWrench<L> = (L, Complex<L>);

const NONE: Three = [NOTHING; 3];

/// Lengths and strain twists of the elements of a block.
#[derive(Clone)]
pub(in crate::rod) struct Twists {
    pub(super) h: Row,
    pub(super) xi: [Three; STAGES],
}

impl Twists {
    pub(super) fn new() -> Self {
        Self { h: [1.0; ELEMENTS], xi: [NONE; STAGES] }
    }

    pub(super) fn set<const S: usize>(&mut self, i: usize, h: f64, xi: &[crate::lie::Twist; S]) {
        self.h[i] = h;
        for (rows, xi) in self.xi.iter_mut().zip(xi) {
            put(rows, i, &xi.to_array());
        }
    }
}

/// What is linearised, as [`lanes::Linearised`](crate::rod::lanes::Linearised).
#[derive(Clone)]
pub(in crate::rod) struct Linearised {
    pub(super) twists: Twists,
    pub(super) internal: [Three; STAGES],
    /// K by its rows (y; z, x): yy, yz, yx, zz, zx, xx.
    pub(super) tangent: [[Row; 6]; STAGES],
    pub(super) wrench_at_start: Three,
    /// Where there are distributed loads: Λ at the stages and the end, and the loads at the stages; of loads that do not turn the force alone, in the frame
    /// of the first node.
    pub(super) wrench: [Three; STAGES + 1],
    pub(super) load: [Three; STAGES],
    /// Change of the loads with the rotation of the section, where they turn.
    pub(super) slope: [Three; STAGES],
    pub(super) loaded: bool,
    /// Whether the forces, or moments, of the loads change in space with the rotation of the section.
    pub(in crate::rod) turning: bool,
}

impl Linearised {
    pub(in crate::rod) fn new() -> Self {
        Self {
            twists: Twists::new(),
            internal: [NONE; STAGES],
            tangent: [[NOTHING; 6]; STAGES],
            wrench_at_start: NONE,
            wrench: [NONE; STAGES + 1],
            load: [NONE; STAGES],
            slope: [NONE; STAGES],
            loaded: false,
            turning: false,
        }
    }

    /// Puts an element into place i.
    pub(in crate::rod) fn set<const S: usize>(
        &mut self,
        i: usize,
        element: &ElementState<'_, S>,
        start: &Wrench,
    ) {
        self.twists.set(i, element.h, &element.xi);
        for (k, response) in element.response.iter().enumerate() {
            put(&mut self.internal[k], i, &response.wrench.to_array());
            let k_of = |r: usize, c: usize| response.tangent[(PLACES[r], PLACES[c])];
            let entries = [k_of(0, 0), k_of(1, 0), k_of(2, 0), k_of(1, 1), k_of(2, 1), k_of(2, 2)];
            for (row, value) in self.tangent[k].iter_mut().zip(entries) {
                row[i] = value;
            }
        }
        put(&mut self.wrench_at_start, i, &start.to_array());
        self.loaded = !element.load.is_none();
        if self.loaded {
            self.set_loads(i, element);
        }
    }

    fn set_loads<const S: usize>(&mut self, i: usize, element: &ElementState<'_, S>) {
        for (k, pose) in element.kinematics.stage.iter().enumerate() {
            put(&mut self.wrench[k], i, &element.stage_wrench[k].to_array());
            if !self.turning {
                let force = element.dead_force(k);
                (self.load[k][1][i], self.load[k][2][i]) = (force.z, force.x);
            } else if let Some(load) = element.load.at_stage(k, pose) {
                put(&mut self.load[k], i, &load.wrench.to_array());
                let slope = load.tangent.column(1);
                put(&mut self.slope[k], i, &std::array::from_fn(|r| slope[r]));
            }
        }
        put(&mut self.wrench[S], i, &element.wrench_at_end.to_array());
    }
}

/// Puts the components in the plane of six into place i.
#[inline(always)]
fn put(rows: &mut Three, i: usize, six: &[f64; 6]) {
    for (row, place) in rows.iter_mut().zip(PLACES) {
        row[i] = six[place];
    }
}

#[inline(always)]
pub(super) fn load_twist<L: Lane>(rows: &Three, at: usize) -> PlaneTwist<L> {
    let (angular, linear) = load_wrench(rows, at);
    PlaneTwist { angular, linear }
}

#[inline(always)]
pub(super) fn load_wrench<L: Lane>([y, z, x]: &Three, at: usize) -> PlaneWrench<L> {
    (L::load(&y[at..]), Complex::new(L::load(&z[at..]), L::load(&x[at..])))
}

#[inline(always)]
pub(super) fn store_wrench<L: Lane>((moment, force): &PlaneWrench<L>, [y, z, x]: [&mut Row; 3], at: usize) {
    moment.store(&mut y[at..]);
    force.re.store(&mut z[at..]);
    force.im.store(&mut x[at..]);
}

/// cos θ, sin θ, p_z and p_x.
#[inline(always)]
pub(super) fn store_pose<L: Lane>(pose: &Placed<L>, [cos, sin, z, x]: &mut [Row; 4], at: usize) {
    pose.turn.re.store(&mut cos[at..]);
    pose.turn.im.store(&mut sin[at..]);
    pose.position.re.store(&mut z[at..]);
    pose.position.im.store(&mut x[at..]);
}
