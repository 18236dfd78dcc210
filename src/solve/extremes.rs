use super::{Node, StaticSolution};
use crate::body::Body;
use crate::error::Result;
use crate::section::{Deformable, SectionPoint};

/// The points of a rod with the largest stretch and the largest stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodExtremes {
    /// Where the largest principal stretch is.
    pub stretch: RodPoint,
    /// Where von Mises' stress is largest.
    pub stress: RodPoint,
}

/// A point of a rod: a point of one of its sections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodPoint {
    /// Arc length s, m.
    pub s: f64,
    /// The point of the section there.
    pub point: SectionPoint,
}

impl StaticSolution {
    /// The largest stretch and stress along the rod, over the quadrature points of the sections at all nodes and stages.
    ///
    /// Between those points both may be larger, by what the strain changes from one to the next; the rim of a section is a little
    /// beyond its outermost points, and [`Deformable::deformed`] shows it.
    ///
    /// ```
    /// use hyperrod::load::DeadWrench;
    /// use hyperrod::material::NeoHookean;
    /// use hyperrod::section::{Rectangle, Relaxed, Warping};
    /// use hyperrod::{Body, Pose, Rod, Statics};
    /// use nalgebra::vector;
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let square = Relaxed::new(Rectangle::new(0.01, 0.01), NeoHookean::from_young(1e6, 0.3)?)?;
    /// let body = Body::new(0.2, square.with_warping(Warping::SHEAR)?)?;
    /// let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(vector![0.0, -0.02, 0.0])?);
    /// let largest = Statics::to(1e-6).solve(&rod)?.extremes(rod.body())?;
    /// assert_eq!(largest.stress.s, 0.0); // at the clamp
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`Deformable::deformed`]: for a body other than that of the solution, where it cannot be strained so.
    pub fn extremes<C: Deformable, M: Send + Sync>(&self, body: &Body<C, M>) -> Result<RodExtremes> {
        let at = |node: &Node| -> Result<RodExtremes> {
            let found = body.section().deformed(&body.station(node.s), &node.strain)?.extremes()?;
            let place = |point| RodPoint { s: node.s, point };
            Ok(RodExtremes { stretch: place(found.stretch), stress: place(found.stress) })
        };
        let mut largest = at(self.base())?;
        for node in self.nodes.iter().chain(&self.stages) {
            let here = at(node)?;
            if here.stretch.point.largest_stretch() > largest.stretch.point.largest_stretch() {
                largest.stretch = here.stretch;
            }
            if here.stress.point.von_mises() > largest.stress.point.von_mises() {
                largest.stress = here.stress;
            }
        }
        Ok(largest)
    }
}
