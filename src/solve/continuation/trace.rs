use super::correct::{Corrector, Place, place, start};
use super::family::Family;
use super::locate::{index_change, zero};
use crate::error::Result;

/// How a path is walked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stride {
    /// The first step, in arc length (∫√(|dx|² + dλ²)).
    pub(crate) first: f64,
    pub(crate) shortest: f64,
    pub(crate) longest: f64,
    /// The most points of a path.
    pub(crate) points: usize,
    /// The walk ends where the factor leaves this range.
    pub(crate) factors: [f64; 2],
    /// Newton's method in a point: iterations, and the step that is its last.
    pub(crate) iterations: usize,
    pub(crate) tolerance: f64,
    /// Whether the index of every point is told.
    pub(crate) indices: bool,
}

impl Default for Stride {
    fn default() -> Self {
        Self {
            first: 0.05,
            shortest: 1e-8,
            longest: 0.5,
            points: 2000,
            factors: [f64::NEG_INFINITY, f64::INFINITY],
            iterations: 10,
            tolerance: 1e-10,
            indices: true,
        }
    }
}

/// An equilibrium on a path.
#[derive(Clone, Debug)]
pub(crate) struct PathPoint<S> {
    pub(crate) factor: f64,
    pub(crate) state: S,
    /// dλ/ds.
    pub(crate) slope: f64,
    /// Arc length from the start.
    pub(crate) arc_length: f64,
    /// Unstable modes at fixed λ; `None` where there is none to tell.
    pub(crate) index: Option<usize>,
}

/// What happens to an index or a factor between two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EventKind {
    /// λ has an extremum.
    LimitPoint,
    /// The index changes while λ goes on: other branches cross.
    Bifurcation,
}

/// A place of note on a path.
#[derive(Clone, Debug)]
pub(crate) struct Event<S> {
    pub(crate) kind: EventKind,
    /// The number of the point before it.
    pub(crate) after: usize,
    pub(crate) point: PathPoint<S>,
}

/// Why a walk ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum End {
    /// The factor left its range; the last point is on its bound.
    Factor,
    /// The caller had enough.
    Stopped,
    /// So many points were walked.
    Points,
    /// No step, however short, could be corrected.
    Stuck(crate::error::Error),
}

/// A path as far as it was walked.
#[derive(Clone, Debug)]
pub(crate) struct Traced<S> {
    pub(crate) points: Vec<PathPoint<S>>,
    pub(crate) events: Vec<Event<S>>,
    pub(crate) end: End,
}

/// Iterations a corrector should take; steps are lengthened or shortened for it.
const WANTED: f64 = 4.0;

/// The cosine of the angle between the tangents of neighbouring points, at the least: beyond, the path may have been left for another.
const LEAST_COSINE: f64 = 0.9;

/// A slope this small is a limit point.
const LEVEL: f64 = 1e-7;

/// Walks the path through an equilibrium, the way of growing λ. `enough` sees every point.
///
/// # Errors
/// If the linear system of the first point has no answer.
pub(crate) fn trace<F: Family>(
    family: &mut F,
    state: F::State,
    factor: f64,
    stride: &Stride,
    enough: impl FnMut(&PathPoint<F::State>) -> bool,
) -> Result<Traced<F::State>> {
    let first = start(family, state, factor)?;
    Ok(Walk::new(family, stride, enough).from(first))
}

/// Walks the branch that leaves a bifurcation in the direction of a null vector.
///
/// # Errors
/// If no point of the branch is found near the bifurcation.
pub(crate) fn trace_branch<F: Family>(
    family: &mut F,
    bifurcation: &PathPoint<F::State>,
    mode: &F::Step,
    stride: &Stride,
    enough: impl FnMut(&PathPoint<F::State>) -> bool,
) -> Result<Traced<F::State>> {
    let norm = family.product(mode, mode).sqrt();
    let direction = family.combined(1.0 / norm, mode, 0.0, mode);
    let from = Place { state: bifurcation.state.clone(), factor: bifurcation.factor, direction, slope: 0.0 };
    let corrector = Corrector { iterations: 3 * stride.iterations, tolerance: stride.tolerance };
    let mut length = stride.first;
    let first = loop {
        match corrector.step(family, &from, length) {
            Ok((first, _)) => break first,
            Err(error) if length < 2.0 * stride.shortest => return Err(error),
            Err(_) => length *= 0.5,
        }
    };
    Ok(Walk::new(family, stride, enough).from(first))
}

struct Walk<'a, F: Family, E> {
    family: &'a mut F,
    stride: &'a Stride,
    enough: E,
    corrector: Corrector,
    traced: Traced<F::State>,
}

impl<'a, F: Family, E: FnMut(&PathPoint<F::State>) -> bool> Walk<'a, F, E> {
    fn new(family: &'a mut F, stride: &'a Stride, enough: E) -> Self {
        let corrector = Corrector { iterations: stride.iterations, tolerance: stride.tolerance };
        let traced = Traced { points: Vec::new(), events: Vec::new(), end: End::Points };
        Self { family, stride, enough, corrector, traced }
    }

    fn from(mut self, first: Place<F>) -> Traced<F::State> {
        let mut here = first;
        let (mut length, mut arc_length) = (self.stride.first, 0.0);
        let point = self.point(&here, arc_length);
        if self.visit(point) {
            return self.ended(End::Stopped);
        }
        while self.traced.points.len() < self.stride.points {
            let (next, travelled) = match self.next(&here, &mut length) {
                Ok(found) => found,
                Err(error) => return self.ended(End::Stuck(error)),
            };
            let [least, most] = self.stride.factors;
            let bound = if next.factor > most { Some(most) } else { (next.factor < least).then_some(least) };
            if let Some(bound) = bound {
                return self.end_at(&here, next, travelled, arc_length, bound);
            }
            let point = self.point(&next, arc_length + travelled);
            self.find_events(&here, &next, &point, travelled, arc_length);
            arc_length += travelled;
            here = next;
            if self.visit(point) {
                return self.ended(End::Stopped);
            }
        }
        self.ended(End::Points)
    }

    /// The next point, with steps halved until one is corrected and turns the tangent little, and the length for the one after.
    fn next(&mut self, here: &Place<F>, length: &mut f64) -> Result<(Place<F>, f64)> {
        loop {
            let tried = *length;
            match self.corrector.step(self.family, here, tried) {
                Ok((next, iterations)) => {
                    let cosine =
                        self.family.product(&here.direction, &next.direction) + here.slope * next.slope;
                    if cosine >= LEAST_COSINE || tried <= 2.0 * self.stride.shortest {
                        let ratio = (WANTED / iterations as f64).sqrt().clamp(0.5, 2.0);
                        *length = (tried * ratio).clamp(self.stride.shortest, self.stride.longest);
                        return Ok((next, tried));
                    }
                }
                Err(error) if tried <= 2.0 * self.stride.shortest => return Err(error),
                Err(_) => {}
            }
            *length = 0.5 * tried;
        }
    }

    /// The last point, on the bound of the factor.
    fn end_at(
        mut self,
        here: &Place<F>,
        beyond: Place<F>,
        travelled: f64,
        arc_length: f64,
        bound: f64,
    ) -> Traced<F::State> {
        let ends = [here.factor - bound, beyond.factor - bound];
        let close = 1e-6 * travelled;
        let found = zero(self.family, &self.corrector, here, travelled, ends, close, |p| p.factor - bound)
            .and_then(|(near, s)| {
                let state = self.corrector.at(self.family, near.state, bound).ok()?;
                Some((place(self.family, state, bound, here).ok()?, s))
            });
        let (last, s) = found.unwrap_or((beyond, travelled));
        let point = self.point(&last, arc_length + s);
        self.find_events(here, &last, &point, s, arc_length);
        self.visit(point);
        self.ended(End::Factor)
    }

    fn point(&mut self, place: &Place<F>, arc_length: f64) -> PathPoint<F::State> {
        let index = self.stride.indices.then(|| self.family.index(&place.state, place.factor)).flatten();
        let (factor, slope) = (place.factor, place.slope);
        PathPoint { factor, state: place.state.clone(), slope, arc_length, index }
    }

    fn visit(&mut self, point: PathPoint<F::State>) -> bool {
        let enough = (self.enough)(&point);
        self.traced.points.push(point);
        enough
    }

    fn ended(mut self, end: End) -> Traced<F::State> {
        self.traced.end = end;
        self.traced
    }

    /// A slope that changes its sign is a limit point, which changes the index by one; what is left of a change of index is a bifurcation.
    fn find_events(
        &mut self,
        here: &Place<F>,
        next: &Place<F>,
        point: &PathPoint<F::State>,
        travelled: f64,
        arc_length: f64,
    ) {
        let mut indices = [self.traced.points.last().and_then(|p| p.index), point.index];
        let after = self.traced.points.len() - 1;
        let add = |walk: &mut Self, kind, found: Option<(Place<F>, f64)>| {
            if let Some((place, s)) = found {
                let point = walk.point(&place, arc_length + s);
                walk.traced.events.push(Event { kind, after, point });
            }
        };
        if here.slope * next.slope < 0.0 {
            let ends = [here.slope, next.slope];
            let found = zero(self.family, &self.corrector, here, travelled, ends, LEVEL, |p| p.slope);
            add(self, EventKind::LimitPoint, found);
            if let [Some(before), Some(behind)] = &mut indices
                && before.abs_diff(*behind) == 1
            {
                *behind = *before;
            }
        }
        if let [Some(before), Some(behind)] = indices
            && before != behind
        {
            let found = index_change(self.family, &self.corrector, here, travelled, [before, behind]);
            add(self, EventKind::Bifurcation, found);
        }
    }
}
