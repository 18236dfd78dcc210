//! The ladder itself.

use super::descend::{descend, turned_aside};
use super::family::RodFamily;
use super::load_steps::load_steps;
use super::verdict::{
    NEUTRAL, NEUTRAL_START, SAFE, is_conservative, is_stable_by_pivots, is_surely_stable, needed_parts,
    stability,
};
use crate::body::Elastic;
use crate::solve::cascade::Cascade;
use crate::solve::describe::describe;
use crate::solve::failure::{Failure, Reason};
use crate::solve::mesh::Mesh;
use crate::solve::newton::{Outcome, scale};
use crate::solve::report::{Rung, Stability};
use crate::solve::unknowns::Unknowns;

/// Elements of the meshes on which a stable state is looked for, one after the other, at the least.
const ELEMENTS: [usize; 3] = [8, 32, 96];

/// And at the most, if the first mesh is not finer already.
const MOST_ELEMENTS: usize = 200;

/// On more elements the loads are not brought on in steps again, and no other start tried: that takes seconds there, and hardly depends on the mesh.
const MOST_ON_A_PATH: usize = 64;

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
            if let Some(failure) = self.failed.take() {
                // the answer on this mesh was of no use
                return self.climb_on(&mesh, None).ok_or_else(|| self.with_report(failure));
            }
            match self.solve_first(&mesh) {
                Ok(outcome) => return self.stay(mesh, outcome),
                Err(failure) => {
                    failed.get_or_insert((mesh, failure));
                }
            }
        }
        let Some((mesh, failure)) = failed else {
            let reason = Reason::IterationLimit { limit: 0, step: f64::NAN, tolerance: f64::NAN };
            return Err(Failure::stateless(reason, self.report.clone()));
        };
        self.climb_on(&mesh, None).ok_or_else(|| self.with_report(failure))
    }

    /// From the shape of the earlier solution where there is one, otherwise or failing that from rest.
    fn solve_first(&mut self, mesh: &Mesh<'r, B, S>) -> Result<Outcome<S>, Box<Failure>> {
        if let Some(earlier) = self.earlier
            && let Ok(outcome) = self.solve(mesh, Unknowns::of_earlier(mesh, earlier))
        {
            return Ok(outcome);
        }
        self.solve(mesh, Unknowns::at_rest(mesh))
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
        self.climb_on(&mesh, Some(&outcome)).ok_or_else(|| self.with_report(failure))
    }

    /// A failure after all rungs.
    fn with_report(&mut self, mut failure: Box<Failure>) -> Box<Failure> {
        self.exhausted = true;
        failure.report = self.report.clone();
        if let (Some((load_factor, last)), false) =
            (self.turned.take(), matches!(failure.reason, Reason::Unstable { .. }))
        {
            failure.reason = Reason::LimitPoint { load_factor };
            failure.last = Some(last);
        }
        failure
    }

    /// The rungs after the first, on ever finer meshes: what a coarse one cannot tell a finer one may.
    fn climb_on(
        &mut self,
        mesh: &Mesh<'r, B, S>,
        unstable: Option<&Outcome<S>>,
    ) -> Option<(Mesh<'r, B, S>, Outcome<S>)> {
        let mut before = 0;
        for tier in self.tier..ELEMENTS.len() {
            self.tier = tier;
            let (mut mesh, from) = self.cut(mesh, unstable, ELEMENTS[tier]);
            if mesh.elements() <= before {
                continue;
            }
            let again = before > 0;
            before = mesh.elements();
            for rung in [Rung::Regularised, Rung::LoadSteps, Rung::ArcLength, Rung::OtherStarts] {
                let found = match rung {
                    Rung::Regularised => self.descend(&mesh, &from),
                    Rung::ArcLength if again => continue,
                    Rung::LoadSteps if self.turned.is_some() => continue,
                    Rung::LoadSteps if again && mesh.elements() > MOST_ON_A_PATH => continue,
                    Rung::LoadSteps => self.load_steps(&mut mesh),
                    Rung::OtherStarts if again || mesh.elements() > MOST_ON_A_PATH => continue,
                    Rung::OtherStarts => {
                        self.report.reach(rung);
                        if let Some(outcome) = self.other_starts(&mesh) {
                            return Some((mesh, outcome));
                        }
                        continue;
                    }
                    _ => self.along_the_path(&mut mesh),
                };
                self.report.reach(rung);
                if let Some(outcome) = found.and_then(|found| self.stable(&mesh, found)) {
                    return Some((mesh, outcome));
                }
            }
        }
        None
    }

    /// Whether there is another way to try, where an answer on the mesh asked for is not found from the one on the first mesh: first a stable one
    /// there, then finer first meshes.
    pub(in crate::solve) fn next_try(&mut self, failure: &Failure) -> bool {
        if self.exhausted {
            return false;
        }
        if !self.careful {
            self.careful = true;
            return true;
        }
        if matches!(failure.reason, Reason::Accuracy { .. }) {
            return false;
        }
        self.tier += 1;
        self.failed = Some(Box::new(failure.clone()));
        self.tier < ELEMENTS.len()
    }

    fn load_steps(&mut self, mesh: &mut Mesh<'r, B, S>) -> Option<Unknowns<S>> {
        let most = self.newton.max_iterations;
        self.observed(|this| load_steps(mesh, most, this.buffers, &mut this.report.iterations))
    }

    pub(in crate::solve) fn descend(
        &mut self,
        mesh: &Mesh<'r, B, S>,
        from: &Unknowns<S>,
    ) -> Option<Unknowns<S>> {
        let most = self.newton.max_iterations;
        self.observed(|this| descend(mesh, from, most, this.buffers, &mut this.report.iterations))
    }

    /// Shows the observer the iterations that a search adds to the report.
    fn observed<T>(&mut self, search: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.report.iterations.len();
        let found = search(self);
        self.report.iterations[before..].iter().for_each(|iteration| (self.newton.observer)(iteration));
        found
    }

    /// A mesh fine enough to tell what is stable, and where to start on it.
    fn cut(
        &mut self,
        mesh: &Mesh<'r, B, S>,
        unstable: Option<&Outcome<S>>,
        least: usize,
    ) -> (Mesh<'r, B, S>, Unknowns<S>) {
        let mut parts = vec![least.div_ceil(mesh.elements()); mesh.elements()];
        let from = match unstable {
            Some(outcome) => outcome.unknowns.clone(),
            None => Unknowns::at_rest(mesh),
        };
        let mut state = self.buffers.configuration();
        if mesh.configure(&from, &mut state).is_ok() {
            let needed = needed_parts(mesh, &state, SAFE);
            parts.iter_mut().zip(needed).for_each(|(count, needed)| *count = (*count).max(needed.min(64)));
        }
        self.buffers.recycle(state);
        let total: usize = parts.iter().sum();
        if total > MOST_ELEMENTS {
            parts.iter_mut().for_each(|count| *count = (*count * MOST_ELEMENTS / total).max(1));
        }
        let from = from.prolonged(mesh, &parts, None);
        let mesh = mesh.refined(&parts);
        let from = turned_aside(&mesh, &from);
        (mesh, from)
    }

    /// The equilibrium next to a state, if it is a stable one, or may be any.
    pub(super) fn stable(&mut self, mesh: &Mesh<'r, B, S>, from: Unknowns<S>) -> Option<Outcome<S>> {
        let outcome = self.solve(mesh, from).ok()?;
        let stability = self.stability_of(mesh, &outcome, NEUTRAL_START);
        if !stability.is_unstable() || self.accept_unstable {
            return Some(outcome);
        }
        // a stable state may be close by
        let aside = turned_aside(mesh, &outcome.unknowns);
        let found = self.descend(mesh, &aside)?;
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

    /// What is neutral in an answer: a mode that costs nothing costs what the error of the wrenches makes of it.
    pub(in crate::solve) fn neutral_in(&self, mesh: &Mesh<'_, B, S>, outcome: &Outcome<S>) -> f64 {
        let Some(state) = &outcome.state else { return NEUTRAL };
        let scale = scale(mesh, state);
        let largest = state.node_wrench.iter().fold(0.0_f64, |most, w| most.max(scale.wrench_size(w)));
        let error = self.report.error.relative(mesh.rod.body().length());
        (10.0 * error * largest).clamp(NEUTRAL, NEUTRAL_START)
    }

    /// Finds the neutral modes of a start, as the turning of a buckled round column about its axis, so that Newton's method leaves them alone.
    pub(in crate::solve) fn hold_neutral_modes(&mut self, mesh: &mut Mesh<'r, B, S>, start: &Unknowns<S>) {
        self.buffers.neutral.clear();
        if self.neutral > 0 || self.careful {
            let mut family = RodFamily { mesh, buffers: self.buffers };
            self.buffers.neutral = family.neutral_modes(start, 1.0, NEUTRAL_START);
        }
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
