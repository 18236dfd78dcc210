//! The last rungs: the path from rest, and other starts.

use super::elsewhere::elsewhere;
use super::family::RodFamily;
use crate::body::Elastic;
use crate::solve::cascade::Cascade;
use crate::solve::continuation::{End, EventKind, Stride, trace};
use crate::solve::describe::describe;
use crate::solve::mesh::Mesh;
use crate::solve::newton::Outcome;
use crate::solve::unknowns::Unknowns;

/// Points of the path that may be walked, on the first mesh alone, for each iteration that Newton's method is allowed.
const POINTS: usize = 10;

/// Shapes from which Newton's method is tried at last.
const SHAPES: u64 = 40;

/// Tolerance of a point on it.
const CLOSE: f64 = 1e-7;

impl<'r, B: Elastic, const S: usize> Cascade<'r, '_, B, S> {
    /// The first state of the full load on the path from rest. Where the path turns back, the state of the largest load is kept.
    pub(super) fn along_the_path(&mut self, mesh: &mut Mesh<'r, B, S>) -> Option<Unknowns<S>> {
        let stride = Stride {
            points: POINTS * self.newton.max_iterations,
            factors: [-1.0, 1.0],
            iterations: Stride::default().iterations.min(self.newton.max_iterations),
            tolerance: CLOSE,
            indices: false,
            ..Stride::default()
        };
        let start = Unknowns::at_rest(mesh);
        let mut family = RodFamily { mesh, buffers: self.buffers };
        let traced = trace(&mut family, start, 0.0, &stride, |_| false);
        mesh.load_factor = 1.0;
        let traced = traced.ok()?;
        let last = traced.points.last()?;
        if traced.end == End::Factor && last.factor == 1.0 {
            return Some(last.state.clone());
        }
        let limits = traced.events.iter().filter(|event| event.kind == EventKind::LimitPoint);
        let limit = limits.map(|event| &event.point).max_by(|a, b| a.factor.total_cmp(&b.factor))?;
        if traced.points.iter().any(|point| point.factor > limit.factor + 1e-6) {
            return None; // it went on
        }
        mesh.load_factor = limit.factor;
        let mut state = self.buffers.configuration();
        if mesh.configure(&limit.state, &mut state).is_ok() {
            let last = describe(mesh, &limit.state.strains, &state, None, self.report.clone());
            self.turned = Some((limit.factor, last));
        }
        self.buffers.recycle(state);
        mesh.load_factor = 1.0;
        // a little more than the largest load, and the rod leaves for another state
        self.descend(mesh, &limit.state)
    }

    /// An equilibrium that may be the answer, from the first shape that leads to one.
    pub(super) fn other_starts(&mut self, mesh: &Mesh<'r, B, S>) -> Option<Outcome<S>> {
        (0..SHAPES).find_map(|number| self.stable(mesh, elsewhere(mesh, number)))
    }
}
