use crate::lie::Pose;
use crate::load::TipLoad;
use crate::rod::Support;

/// What holds and loads one section of the rod: an end, or a place between.
pub(crate) struct Fixture {
    pub(crate) support: Support,
    pub(crate) loads: Vec<Box<dyn TipLoad>>,
}

impl Fixture {
    pub(crate) fn new(support: Support) -> Self {
        Self { support, loads: Vec::new() }
    }
}

/// A place between the ends where something acts, or the rod has a corner.
pub(crate) struct Joint {
    /// Arc length, inside (0, L).
    pub(crate) s: f64,
    /// What acts there, on the section before the corner.
    pub(crate) fixture: Fixture,
    /// The pose of the section after the corner, in the frame of the one before.
    pub(crate) corner: Pose,
}

impl Joint {
    pub(crate) fn new(s: f64) -> Self {
        Self { s, fixture: Fixture::new(Support::free()), corner: Pose::identity() }
    }
}
