use nalgebra::{Matrix6, Vector6};

use super::condition::Condition;
use super::link::Link;
use super::mode;
use super::pivot::{Last, joining};
use super::plane::Plane;

/// How stable an equilibrium is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// So many independent displacements lower the energy; so many more leave it as it is, to second order.
    Index { unstable: usize, neutral: usize },
    /// The element of this number is unstable by itself even with both ends held, or too long to tell: the mesh is too coarse.
    Unresolved { element: usize },
}

/// A support at the node behind an element, and the corner there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    /// The node, counted from 0 at the base.
    pub(crate) node: usize,
    pub(crate) condition: Condition,
    pub(crate) corner: Link,
}

/// The links of a rod from base to tip, and what holds it.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// One an element.
    pub(crate) links: Vec<Link>,
    /// Supports between the ends, along the rod.
    pub(crate) stops: Vec<Stop>,
    pub(crate) base: Condition,
    pub(crate) tip: Condition,
}

/// What a sweep from base to tip leaves behind.
#[derive(Clone, Debug)]
pub(super) struct Swept {
    /// Modes that the nodes before the last two added.
    before: usize,
    pub(super) last: Last,
    /// Planes at the starts of the elements.
    pub(super) planes: Vec<Plane>,
    /// Coefficients in each of these from those in the next.
    pub(super) back: Vec<Matrix6<f64>>,
}

impl Chain {
    /// The index under the essential conditions of both ends; an eigenvalue of the last pivot below `neutral` is nothing.
    pub(crate) fn verdict(&self, neutral: f64) -> Verdict {
        if self.is_surely_stable(1e-5_f64.max(10.0 * neutral)) {
            return Verdict::Index { unstable: 0, neutral: 0 };
        }
        match self.sweep() {
            Ok(swept) => {
                let (last, neutral) = swept.last.count(neutral);
                Verdict::Index { unstable: swept.before + last, neutral }
            }
            Err(element) => Verdict::Unresolved { element },
        }
    }

    /// A number that passes through zero, falling, when the mode of number `mode` (from 0, in the order in which they become unstable) does so;
    /// far behind that −1.
    pub(crate) fn margin(&self, mode: usize) -> Option<f64> {
        let swept = self.sweep().ok()?;
        match mode.checked_sub(swept.before) {
            Some(mode) => swept.last.eigenvalue(mode),
            None => Some(-1.0),
        }
    }

    /// (ζ, μ) at the starts of the elements and at the tip in the mode of number `mode`, in units of the rod, the largest displacement 1.
    pub(crate) fn mode(&self, mode: usize) -> Option<Vec<(Vector6<f64>, Vector6<f64>)>> {
        let swept = self.sweep().ok()?;
        let place = swept.last.place(mode.checked_sub(swept.before)?);
        mode::shape(&swept, self.links.last()?, place)
    }

    /// The same of the modes that cost nothing, to within `tolerance`.
    pub(crate) fn neutral_modes(&self, tolerance: f64) -> Vec<Vec<(Vector6<f64>, Vector6<f64>)>> {
        let (Ok(swept), Some(last)) = (self.sweep(), self.links.last()) else { return Vec::new() };
        let places = swept.last.neutral(tolerance);
        places.into_iter().filter_map(|place| mode::shape(&swept, last, place)).collect()
    }

    fn sweep(&self) -> Result<Swept, usize> {
        let mut plane = self.base.plane();
        let (mut planes, mut back) = (vec![plane], Vec::with_capacity(self.links.len()));
        let mut before = 0;
        let mut stops = self.stops.iter().peekable();
        let (last_link, links) = self.links.split_last().ok_or(0_usize)?;
        for (element, link) in links.iter().enumerate() {
            let relation = plane.relation().ok_or(element)?;
            before += joining(&relation, link).ok_or(element)?;
            let triangle;
            (plane, triangle) = plane.behind(link);
            let mut to_before = triangle.try_inverse().ok_or(element)?;
            if let Some(stop) = stops.next_if(|stop| stop.node == element + 1) {
                let (held, from_held) = plane.supported(&stop.condition).ok_or(element)?;
                let (turned, triangle) = held.behind(&stop.corner);
                to_before *= from_held * triangle.try_inverse().ok_or(element)?;
                plane = turned;
            }
            planes.push(plane);
            back.push(to_before);
        }
        let last = plane.relation().and_then(|relation| Last::new(&relation, last_link, &self.tip));
        Ok(Swept { before, last: last.ok_or(links.len())?, planes, back })
    }
}
