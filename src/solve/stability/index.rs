use nalgebra::Matrix6;

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

/// An eigenvalue of the last pivot smaller than this, in units of the rod's bending stiffness, tells nothing.
const NEUTRAL: f64 = 1e-11;

/// The links of a rod from base to tip, and what holds its ends.
#[derive(Clone, Debug)]
pub(crate) struct Chain<'a> {
    pub(crate) links: &'a [Link],
    pub(crate) base: Condition,
    pub(crate) tip: Condition,
}

/// What a sweep from base to tip leaves behind.
#[derive(Clone, Debug)]
pub(super) struct Swept {
    /// Modes that the nodes before the tip added.
    before: usize,
    pub(super) last: Last,
    /// Planes at the nodes before the tip, and the triangles that lead from one to the next.
    pub(super) planes: Vec<Plane>,
    pub(super) triangles: Vec<Matrix6<f64>>,
}

impl Chain<'_> {
    /// The index under the essential conditions of both ends.
    pub(crate) fn verdict(&self) -> Verdict {
        match self.sweep() {
            Ok(swept) => match swept.last.count(NEUTRAL) {
                Some((last, neutral)) => Verdict::Index { unstable: swept.before + last, neutral },
                None => Verdict::Unresolved { element: self.links.len() - 1 },
            },
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

    /// Displacements ζ of all nodes in the mode of number `mode`, in units of the rod, the largest component 1.
    pub(crate) fn mode(&self, mode: usize) -> Option<Vec<nalgebra::Vector6<f64>>> {
        let swept = self.sweep().ok()?;
        mode::shape(&swept, mode.checked_sub(swept.before)?)
    }

    fn sweep(&self) -> Result<Swept, usize> {
        let mut plane = self.base.plane();
        let (mut planes, mut triangles) = (vec![plane], Vec::with_capacity(self.links.len()));
        let mut before = 0;
        let (last_link, links) = self.links.split_last().ok_or(0_usize)?;
        for (element, link) in links.iter().enumerate() {
            let relation = plane.relation().ok_or(element)?;
            before += joining(&relation, link).ok_or(element)?;
            let triangle;
            (plane, triangle) = plane.behind(link);
            planes.push(plane);
            triangles.push(triangle);
        }
        let last = plane.relation().and_then(|relation| Last::new(&relation, last_link, &self.tip));
        Ok(Swept { before, last: last.ok_or(links.len())?, planes, triangles })
    }
}
