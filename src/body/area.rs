use super::Body;
use crate::error::Result;
use crate::section::{AreaMoments, CrossSection, Geometry};

/// A body whose section has an area: what buoyancy asks for.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no area, and this load needs one",
    label = "needs a body whose section has a shape",
    note = "give it a section with a shape: `Body::new(length, Section::new(shape, material)?)?`"
)]
pub trait HasArea {
    /// Area and its moments at s.
    ///
    /// # Errors
    /// Where a size of the section is not what it must be.
    fn area_moments(&self, s: f64) -> Result<AreaMoments>;
}

impl<C: CrossSection + Geometry, M: Send + Sync> HasArea for Body<C, M> {
    fn area_moments(&self, s: f64) -> Result<AreaMoments> {
        self.section.moments(s)
    }
}
