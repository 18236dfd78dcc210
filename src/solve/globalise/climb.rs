//! The ladder itself.

use super::descend::{descend, turned_aside};
use super::family::RodFamily;
use super::load_steps::load_steps;
use super::verdict::{
    NEUTRAL_START, SAFE, is_conservative, is_stable_by_pivots, is_surely_stable, needed_parts, stability,
};
use crate::body::Elastic;
use crate::solve::cascade::Cascade;
use crate::solve::continuation::{End, Stride, trace};
use crate::solve::describe::describe;
use crate::solve::failure::{Failure, Reason};
use crate::solve::mesh::Mesh;
use crate::solve::newton::Outcome;
use crate::solve::report::{Rung, Stability};
use crate::solve::unknowns::Unknowns;

/// Elements of the mesh on which a stable state is looked for, at the least.
const ELEMENTS: usize = 8;

/// And at the most, if the first mesh is not finer already.
const MOST_ELEMENTS: usize = 200;

/// Points of the path that the last rung may walk.
const POINTS: usize = 400;

type Climbed<'r, B, const S: usize> = Result<(Mesh<'r, B, S>, Outcome<S>), Box<Failure>>;

impl<'r, B: Elastic, const S: usize> Cascade<'r, '_, B, S> {
    /// An equilibrium on the first of some meshes on which Newton's method finds one from rest; a stable one, by the further rungs, unless it is
    /// said that any will do. The mesh of the answer may be a finer one.
    pub(in crate::solve) fn climb(
        &mut self,
        meshes: impl Iterator<Item = Mesh<'r, B, S>>,
    ) -> Climbed<'r, B, S> {
        self.report.reach(Rung::Newton);
        let mut failed = None;
        for mesh in meshes {
            match self.solve(&mesh, Unknowns::at_rest(&mesh)) {
                Ok(outcome) => return self.stay(mesh, outcome),
                Err(failure) => {
                    failed.get_or_insert((mesh, failure));
                }
            }
        }
        let Some((mesh, failure)) = failed else {
            let reason = Reason::IterationLimit { limit: 0, step: f64::NAN, tolerance: f64::NAN };
            return Err(Box::new(Failure { reason, report: self.report.clone(), last: None }));
        };
        self.climb_on(mesh, None).ok_or_else(|| self.with_report(failure))
    }

    /// An equilibrium if it stays, or a stable one.
    fn stay(&mut self, mesh: Mesh<'r, B, S>, outcome: Outcome<S>) -> Climbed<'r, B, S> {
        if !self.careful {
            // the answer will be looked at
            return Ok((mesh, outcome));
        }
        let stability = self.stability_of(&mesh, &outcome, NEUTRAL_START);
        // what cannot be told of a rod with an energy is looked into
        let told = stability != Stability::Unknown
            || outcome.state.as_ref().is_none_or(|state| !is_conservative(&mesh, state));
        if self.accept_unstable || (told && !stability.is_unstable()) {
            return Ok((mesh, outcome));
        }
        let failure = unstable(&mesh, &outcome, stability, self);
        self.climb_on(mesh, Some(outcome)).ok_or_else(|| self.with_report(failure))
    }

    /// A failure after all rungs.
    fn with_report(&self, mut failure: Box<Failure>) -> Box<Failure> {
        failure.report = self.report.clone();
        failure
    }

    /// The rungs after the first.
    fn climb_on(
        &mut self,
        mesh: Mesh<'r, B, S>,
        unstable: Option<Outcome<S>>,
    ) -> Option<(Mesh<'r, B, S>, Outcome<S>)> {
        let (mut mesh, from) = self.cut(mesh, unstable.as_ref());
        for rung in [Rung::Regularised, Rung::LoadSteps, Rung::ArcLength] {
            self.report.reach(rung);
            let found = match rung {
                Rung::LoadSteps => load_steps(&mut mesh, self.buffers, &mut self.report.iterations),
                Rung::ArcLength => self.along_the_path(&mut mesh),
                _ => descend(&mesh, &from, self.buffers, &mut self.report.iterations),
            };
            if let Some(outcome) = found.and_then(|found| self.stable(&mesh, found)) {
                return Some((mesh, outcome));
            }
        }
        None
    }

    /// A mesh fine enough to tell what is stable, and where to start on it.
    fn cut(&mut self, mesh: Mesh<'r, B, S>, unstable: Option<&Outcome<S>>) -> (Mesh<'r, B, S>, Unknowns<S>) {
        let least = ELEMENTS.div_ceil(mesh.elements());
        let mut parts = vec![least; mesh.elements()];
        let from = match unstable {
            Some(outcome) => outcome.unknowns.clone(),
            None => Unknowns::at_rest(&mesh),
        };
        let mut state = self.buffers.configuration();
        if mesh.configure(&from, &mut state).is_ok() {
            let needed = needed_parts(&mesh, &state, SAFE);
            parts.iter_mut().zip(needed).for_each(|(count, needed)| *count = (*count).max(needed.min(64)));
        }
        self.buffers.recycle(state);
        let total: usize = parts.iter().sum();
        if total > MOST_ELEMENTS {
            parts.iter_mut().for_each(|count| *count = (*count * MOST_ELEMENTS / total).max(1));
        }
        let from = from.prolonged(&mesh, &parts, None);
        let mesh = mesh.refined(&parts);
        let from = turned_aside(&mesh, &from);
        (mesh, from)
    }

    /// The equilibrium next to a state, if it is a stable one, or may be any.
    fn stable(&mut self, mesh: &Mesh<'r, B, S>, from: Unknowns<S>) -> Option<Outcome<S>> {
        let outcome = self.solve(mesh, from).ok()?;
        let stability = self.stability_of(mesh, &outcome, NEUTRAL_START);
        if !stability.is_unstable() || self.accept_unstable {
            return Some(outcome);
        }
        // a stable state may be close by
        let aside = turned_aside(mesh, &outcome.unknowns);
        let found = descend(mesh, &aside, self.buffers, &mut self.report.iterations)?;
        let outcome = self.solve(mesh, found).ok()?;
        (!self.stability_of(mesh, &outcome, NEUTRAL_START).is_unstable()).then_some(outcome)
    }

    pub(in crate::solve) fn stability_of(
        &mut self,
        mesh: &Mesh<'_, B, S>,
        outcome: &Outcome<S>,
        neutral: f64,
    ) -> Stability {
        let stability = match &outcome.state {
            Some(state) if is_stable_by_pivots(mesh, outcome, state) => {
                Stability::Index { unstable: 0, neutral: 0 }
            }
            Some(state) if is_surely_stable(mesh, &outcome.unknowns, state, self.buffers, neutral) => {
                Stability::Index { unstable: 0, neutral: 0 }
            }
            Some(state) => stability(mesh, &outcome.unknowns, state, self.buffers, neutral),
            None => Stability::Unknown,
        };
        self.neutral = match stability {
            Stability::Index { unstable: 0, neutral } => neutral,
            _ => 0,
        };
        stability
    }

    /// Finds the neutral modes of a start, as the turning of a buckled round column about its axis, so that Newton's method leaves them alone.
    pub(in crate::solve) fn hold_neutral_modes(&mut self, mesh: &mut Mesh<'r, B, S>, start: &Unknowns<S>) {
        self.buffers.neutral.clear();
        if self.neutral > 0 {
            let mut family = RodFamily { mesh, buffers: self.buffers };
            self.buffers.neutral = family.neutral_modes(start, 1.0, NEUTRAL_START);
        }
    }

    /// The first state of the full load on the path from rest.
    fn along_the_path(&mut self, mesh: &mut Mesh<'r, B, S>) -> Option<Unknowns<S>> {
        let stride = Stride { points: POINTS, factors: [-1.0, 1.0], ..Stride::default() };
        let start = Unknowns::at_rest(mesh);
        let mut family = RodFamily { mesh, buffers: self.buffers };
        let traced = trace(&mut family, start, 0.0, &stride, |_| false);
        mesh.load_factor = 1.0;
        let traced = traced.ok()?;
        let last = traced.points.into_iter().last()?;
        (traced.end == End::Factor && last.factor == 1.0).then_some(last.state)
    }
}

/// The failure that an unstable equilibrium is, where none other is found.
pub(in crate::solve) fn unstable<B: Elastic, const S: usize>(
    mesh: &Mesh<'_, B, S>,
    outcome: &Outcome<S>,
    stability: Stability,
    cascade: &mut Cascade<'_, '_, B, S>,
) -> Box<Failure> {
    cascade.report.stability = stability;
    let report = cascade.report.clone();
    let last = outcome
        .state
        .as_ref()
        .map(|state| describe(mesh, &outcome.unknowns.strains, state, None, report.clone()));
    Box::new(Failure { reason: Reason::Unstable { stability }, report, last })
}
