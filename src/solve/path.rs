use super::continuation::{End, Event, EventKind, PathPoint, Stride, Traced, trace, trace_branch};
use super::describe::describe;
use super::equilibrium::Configuration;
use super::failure::{Failure, Reason};
use super::globalise::{NEUTRAL, RodFamily, stability};
use super::linear::{Buffers, Increment};
use super::mesh::Mesh;
use super::report::Report;
use super::solution::StaticSolution;
use super::unknowns::Unknowns;
use crate::body::Elastic;
use crate::error::Error;
use crate::lie::Twist;
use crate::rod::Rod;

/// How a path of equilibria is walked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathOptions {
    /// The walk ends where the load factor leaves this range, with a last point on its bound. 1 is the load of the rod.
    pub factors: [f64; 2],
    /// The first step, in arc length: ∫√(|dx|² + dλ²), x being strains in units of 1/L and 1.
    pub first_step: f64,
    /// The longest step.
    pub longest_step: f64,
    /// The most points.
    pub max_points: usize,
}

impl Default for PathOptions {
    /// From rest to the full load, in steps of 0.05 to 0.5.
    fn default() -> Self {
        Self { factors: [-1.0, 1.0], first_step: 0.05, longest_step: 0.5, max_points: 1000 }
    }
}

/// An equilibrium on a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathState {
    /// λ: all loads are multiplied by it, and supports have come this part of the way from rest to what they hold.
    pub load_factor: f64,
    /// dλ/ds: 0 at a limit point.
    pub slope: f64,
    /// Arc length of the path from its start.
    pub arc_length: f64,
    /// The rod; its report tells the [stability](Report::stability) at this load.
    pub solution: StaticSolution,
}

/// What happens on a path.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathEventKind {
    /// The load factor has an extremum: beyond it the rod snaps, under a load that cannot give way.
    LimitPoint,
    /// The number of unstable modes changes while the load goes on: the rod buckles, other paths leave here.
    Bifurcation,
}

/// A place of note on a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathEvent {
    /// What it is.
    pub kind: PathEventKind,
    /// It lies between this point of the path and the next.
    pub after: usize,
    /// The rod there.
    pub state: PathState,
}

/// Why a walk ended.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub enum PathEnd {
    /// At a bound of the load factor.
    LoadFactor,
    /// At the event that was asked for.
    Event,
    /// After the most points that were allowed.
    MaxPoints,
    /// No step, however short, led to an equilibrium.
    Stuck(Error),
}

/// Equilibria of a rod, followed from one to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumPath {
    /// From the start.
    pub points: Vec<PathState>,
    /// Limit points and bifurcations.
    pub events: Vec<PathEvent>,
    /// Why it ends.
    pub end: PathEnd,
}

/// The load under which a rod buckles.
#[derive(Clone, Debug, PartialEq)]
pub struct Buckling {
    /// A bifurcation, or the limit point at which the rod snaps.
    pub kind: PathEventKind,
    /// The rod at the critical load, and its load factor.
    pub critical: PathState,
    /// Displacements ζ = (rotation, displacement) in body frame of the nodes of the rod, from base to tip, the largest of rotations and displacements / L being 1: one
    /// entry for each mode that becomes unstable (two for a round rod).
    pub modes: Vec<Vec<Twist>>,
}

/// What costs nothing at an event of a path.
const NEUTRAL_AT_EVENT: f64 = 1e-5;

/// What a walk needs of a rod.
pub(super) struct Walker<'m, 'r, B, const S: usize> {
    mesh: Mesh<'r, B, S>,
    buffers: &'m mut Buffers<S>,
    options: &'m PathOptions,
}

impl<'m, 'r, B: Elastic, const S: usize> Walker<'m, 'r, B, S> {
    pub(super) fn new(
        rod: &'r Rod<B>,
        elements: usize,
        buffers: &'m mut Buffers<S>,
        options: &'m PathOptions,
    ) -> Self {
        Self { mesh: Mesh::uniform(rod, elements), buffers, options }
    }

    fn stride(&self) -> Stride {
        Stride {
            first: self.options.first_step,
            longest: self.options.longest_step,
            points: self.options.max_points,
            factors: self.options.factors,
            ..Stride::default()
        }
    }

    /// From rest, to where `enough` says.
    fn walk(
        &mut self,
        mut enough: impl FnMut(&PathPoint<Unknowns<S>>) -> bool,
    ) -> Result<Traced<Unknowns<S>>, Box<Failure>> {
        let stride = self.stride();
        let start = Unknowns::at_rest(&self.mesh);
        let mut family = RodFamily { mesh: &mut self.mesh, buffers: self.buffers };
        let traced = trace(&mut family, start, 0.0, &stride, &mut enough);
        traced.map_err(|error| Failure::stateless(Reason::Start(error), Report::default()))
    }

    pub(super) fn path(&mut self) -> Result<EquilibriumPath, Box<Failure>> {
        let traced = self.walk(|_| false)?;
        Ok(self.described(&traced))
    }

    /// The path that leaves the first bifurcation along its first mode; `None` where there is none.
    pub(super) fn buckled_path(&mut self) -> Result<Option<EquilibriumPath>, Box<Failure>> {
        let traced = self.walk(|point| point.index.is_some_and(|index| index > 0))?;
        let found = traced.events.iter().find(|event| event.kind == EventKind::Bifurcation);
        let Some(event) = found else { return Ok(None) };
        let Some(mode) = self.increment(&event.point) else { return Ok(None) };
        let stride = self.stride();
        let mut family = RodFamily { mesh: &mut self.mesh, buffers: self.buffers };
        let branch = trace_branch(&mut family, &event.point, &mode, &stride, |_| false)
            .map_err(|error| Failure::stateless(Reason::Start(error), Report::default()))?;
        Ok(Some(self.described(&branch)))
    }

    /// The first event that costs the rod its stability.
    pub(super) fn buckling(&mut self) -> Result<Option<Buckling>, Box<Failure>> {
        let mut first = None;
        let traced = self.walk(|point| {
            let before = *first.get_or_insert(point.index);
            matches!((before, point.index), (Some(before), Some(now)) if now > before)
        })?;
        let Some(event) = traced.events.first() else { return Ok(None) };
        let before = traced.points[event.after].index.unwrap_or(0);
        let after = traced.points.get(event.after + 1).and_then(|point| point.index).unwrap_or(before + 1);
        let modes = self.modes(&event.point, before..after.max(before + 1));
        Ok(Some(Buckling { kind: kind(event.kind), critical: self.state(&event.point), modes }))
    }

    /// Displacements in the modes of these numbers.
    fn modes(&mut self, point: &PathPoint<Unknowns<S>>, numbers: std::ops::Range<usize>) -> Vec<Vec<Twist>> {
        let mut family = RodFamily { mesh: &mut self.mesh, buffers: self.buffers };
        let Some((chain, scale)) = family.chain(&point.state, point.factor) else { return Vec::new() };
        let units = scale.displacement();
        let mut modes = chain.neutral_modes(NEUTRAL_AT_EVENT);
        if modes.len() < numbers.len() {
            // an event that was found only roughly
            modes = numbers.filter_map(|number| chain.mode(number)).collect();
        }
        let twist =
            |zeta: &nalgebra::Vector6<f64>| Twist::from_array(std::array::from_fn(|r| zeta[r] * units[r]));
        modes.iter().map(|mode| mode.iter().map(|(zeta, _)| twist(zeta)).collect()).collect()
    }

    /// The first mode at a bifurcation as a step.
    fn increment(&mut self, point: &PathPoint<Unknowns<S>>) -> Option<Increment<S>> {
        let mut family = RodFamily { mesh: &mut self.mesh, buffers: self.buffers };
        family.neutral_modes(&point.state, point.factor, NEUTRAL_AT_EVENT).into_iter().next()
    }

    fn described(&mut self, traced: &Traced<Unknowns<S>>) -> EquilibriumPath {
        let points = traced.points.iter().map(|point| self.state(point)).collect();
        let event = |this: &mut Self, event: &Event<Unknowns<S>>| PathEvent {
            kind: kind(event.kind),
            after: event.after,
            state: this.state(&event.point),
        };
        let events = traced.events.iter().map(|found| event(self, found)).collect();
        let end = match &traced.end {
            End::Factor => PathEnd::LoadFactor,
            End::Stopped => PathEnd::Event,
            End::Points => PathEnd::MaxPoints,
            End::Stuck(error) => PathEnd::Stuck(error.clone()),
        };
        EquilibriumPath { points, events, end }
    }

    fn state(&mut self, point: &PathPoint<Unknowns<S>>) -> PathState {
        self.mesh.load_factor = point.factor;
        let mut configuration = Configuration::default();
        let mut report = Report::default();
        // the state was converged: it can be evaluated
        if self.mesh.configure(&point.state, &mut configuration).is_ok() {
            report.stability = stability(&self.mesh, &point.state, &configuration, self.buffers, NEUTRAL);
        }
        let solution = describe(&self.mesh, &point.state.strains, &configuration, None, report);
        let (load_factor, slope, arc_length) = (point.factor, point.slope, point.arc_length);
        PathState { load_factor, slope, arc_length, solution }
    }
}

fn kind(kind: EventKind) -> PathEventKind {
    match kind {
        EventKind::LimitPoint => PathEventKind::LimitPoint,
        EventKind::Bifurcation => PathEventKind::Bifurcation,
    }
}
