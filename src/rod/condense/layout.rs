//! Which numbers are kept of an element, and where.

use nalgebra::Vector6;

use crate::body::Constraint;
use crate::load::LoadWrench;
use crate::rod::planar::{self, PLACES};

/// What the condensation of the elements of a mesh has to do with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Kind {
    pub(crate) constraint: Constraint,
    /// Whether the elements lie in the plane, with all their wrenches, and stay there.
    pub(crate) plane: bool,
    pub(crate) loads: Loads,
}

/// How distributed loads follow the rod, from what is simple to what is not.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(crate) enum Loads {
    /// There are none.
    #[default]
    None,
    /// They have no moment, and keep their forces in space.
    Dead,
    /// They do not depend on where they act.
    Turning,
    /// They do.
    Placed,
}

impl Loads {
    /// Of one load.
    pub(crate) fn of(load: &LoadWrench) -> Self {
        let t = load.tangent.as_slice();
        let is_zero = |part: &[f64]| part.iter().fold(true, |zero, v| zero & (*v == 0.0));
        if !is_zero(&t[18..]) {
            return Self::Placed;
        }
        let [l, m, n, x, y, z] = load.wrench.to_array();
        let moments = [l, m, n, t[0], t[1], t[2], t[6], t[7], t[8], t[12], t[13], t[14]];
        // columns of n^, less these
        let forces = [t[3], t[4] - z, t[5] + y, t[9] + z, t[10], t[11] - x, t[15] - y, t[16] + x, t[17]];
        let dead = is_zero(&moments) && is_zero(&forces);
        if dead { Self::Dead } else { Self::Turning }
    }
}

/// What a column stands for: a change of wrench at the first node, 1, or a displacement of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Column {
    Wrench(usize),
    One,
    Zeta(usize),
}

impl Column {
    /// Its factor.
    #[inline(always)]
    pub(super) fn of(self, zeta: &Vector6<f64>, wrench: &Vector6<f64>, one: f64) -> f64 {
        match self {
            Self::Wrench(j) => wrench[j],
            Self::One => one,
            Self::Zeta(j) => zeta[j],
        }
    }
}

/// Components of strains, of what the strains make of the end, and the columns of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layout {
    pub(super) plane: bool,
    /// Strains that are not zero, of six.
    pub(super) strains: &'static [usize],
    /// Components of displacements and wrenches, of six.
    pub(super) places: &'static [usize],
    pub(super) columns: usize,
    pub(super) stages: usize,
    /// In all.
    pub(super) rows: usize,
}

impl Layout {
    pub(super) fn of(kind: &Kind, stages: usize) -> Self {
        const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];
        let stiff = kind.constraint.fixed()[3..] == [true; 3] || (kind.plane && kind.is_stiff_in_plane());
        let (strains, places) = match (kind.plane, stiff) {
            (false, false) => (&ALL[..], &ALL[..]),
            (false, true) => (&ALL[..3], &ALL[..]),
            (true, false) => (&PLACES[..], &PLACES[..]),
            (true, true) => (&PLACES[..1], &PLACES[..]),
        };
        let loaded = kind.loads != Loads::None;
        let columns = match (kind.plane, kind.loads) {
            (true, _) => planar::columns(loaded),
            (false, Loads::None) => 7,
            (false, Loads::Placed) => 13,
            (false, _) => 10,
        };
        let mut layout = Self { plane: kind.plane, strains, places, columns, stages, rows: 0 };
        layout.rows = layout.pose() + if kind.plane { 4 } else { 12 };
        layout
    }

    #[inline(always)]
    pub(super) fn column(&self, c: usize) -> Column {
        let n = self.places.len();
        match c {
            _ if c < n => Column::Wrench(self.places[c]),
            _ if c == n => Column::One,
            _ if self.plane => Column::Zeta(PLACES[c - n - 1]),
            _ => Column::Zeta(c - n - 1),
        }
    }

    /// Component f of the strains of stage k.
    #[inline(always)]
    pub(super) fn strain(&self, k: usize, f: usize, c: usize) -> usize {
        (k * self.strains.len() + f) * self.columns + c
    }

    #[inline(always)]
    pub(super) fn zeta(&self, r: usize, c: usize) -> usize {
        (self.stages * self.strains.len() + r) * self.columns + c
    }

    #[inline(always)]
    pub(super) fn wrench(&self, r: usize, c: usize) -> usize {
        self.zeta(self.places.len() + r, c)
    }

    /// The pose of the end.
    #[inline(always)]
    pub(super) fn pose(&self) -> usize {
        self.wrench(self.places.len(), 0)
    }
}

impl Kind {
    /// Whether the only strain of the plane that is free is its curvature.
    fn is_stiff_in_plane(&self) -> bool {
        let fixed = self.constraint.fixed();
        fixed[3] && fixed[5]
    }
}
