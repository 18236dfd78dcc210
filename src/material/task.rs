//! What is asked of a law, as one argument.

use super::active::Active;
use super::batch::integrate_many;
use super::blocks::Blocks;
use super::few::in_lanes;
use super::few_kernels::{BlocksOfFew, SpansOfFew};
use super::integrate::{Job, Site, integrate_local};
use super::response::{Points, Request, Response, Station};
use super::sectional::{Spans, integrate_sectional};
use super::three::Set;
use crate::error::Result;
use crate::lie::Strain;

/// The response to one strain, or to many.
pub struct Task<'a>(Work<'a>);

enum Work<'a> {
    One(Job<'a>),
    Many(Many<'a>),
}

/// Many strains on the same points.
pub(super) struct Many<'a> {
    pub(super) points: &'a Points,
    pub(super) sites: &'a [(Station, Strain)],
    pub(super) active: Active,
    pub(super) request: Request,
    pub(super) out: &'a mut [Response],
}

impl<'a> Task<'a> {
    /// One strain.
    #[inline(always)]
    pub(super) fn one(site: Site<'a>, request: Request) -> Self {
        Self(Work::One(Job::new(site, request)))
    }

    /// Many strains and responses.
    pub(super) fn many(many: Many<'a>) -> Self {
        Self(Work::Many(many))
    }

    /// By a law of the deformation. The response to one strain is returned: what sums it up writes it where the caller will find it, since a
    /// copy of one costs as much as a block of points. Those to many strains are where the task wants them, and none is returned.
    pub(super) fn perform(&mut self, law: &dyn BlocksOfFew) -> Result<Response> {
        match &mut self.0 {
            Work::One(job) => integrate_local(law, job),
            Work::Many(many) => {
                integrate_local_many(law, many)?;
                Ok(Response::ZERO)
            }
        }
    }

    /// As by [`perform`](Self::perform), in all strains whatever is active: for a law that is not to have kernels for few of them compiled.
    #[doc(hidden)]
    pub fn perform_in_all(&mut self, law: &dyn Blocks) -> Result<Response> {
        match &mut self.0 {
            Work::One(job) => integrate_local(law, job),
            Work::Many(Many { points, sites, request, out, .. }) => {
                integrate_many(law, points, sites, *request, out)?;
                Ok(Response::ZERO)
            }
        }
    }

    /// The same by a law of the strain.
    #[doc(hidden)]
    pub fn perform_sectional_in_all(&mut self, law: &dyn Spans) -> Result<Response> {
        match &mut self.0 {
            Work::One(job) => integrate_sectional(law, job),
            Work::Many(Many { points, sites, request, out, .. }) => {
                one_by_one(sites, out, |at, strain| {
                    integrate_sectional(law, &Job::new(Site { points, at, strain }, *request))
                })?;
                Ok(Response::ZERO)
            }
        }
    }

    /// By a law of the strain, likewise.
    pub(super) fn perform_sectional(&mut self, law: &dyn SpansOfFew) -> Result<Response> {
        match &mut self.0 {
            Work::One(job) => integrate_sectional(law, job),
            Work::Many(many) => {
                integrate_sectional_many(law, many)?;
                Ok(Response::ZERO)
            }
        }
    }
}

impl Many<'_> {
    /// Three strains that contain all that are active; only a tangent is worth the trouble.
    fn set(&self) -> Option<Set> {
        if self.request == Request::Tangent { Set::of(self.active) } else { None }
    }
}

/// Out of line, so that what is done with one strain is as it would be alone; in few components a lane a strain, where that can be.
#[inline(never)]
fn integrate_local_many(law: &dyn BlocksOfFew, many: &mut Many<'_>) -> Result<()> {
    let plain = many.points.rates.is_none() && !many.sites.iter().any(|(at, _)| at.reference.is_curved());
    let (points, request) = (many.points, many.request);
    let Some(set) = many.set().filter(|_| plain) else {
        return integrate_many(law, points, many.sites, request, many.out);
    };
    in_lanes(set, many, &|few, entries| law.sum_few(few, entries), &|at, strain| {
        integrate_local(law, &Job::new(Site { points, at, strain }, request))
    })
}

/// A lane a strain in few of their components, else one by one.
#[inline(never)]
fn integrate_sectional_many(law: &dyn SpansOfFew, many: &mut Many<'_>) -> Result<()> {
    let (points, request) = (many.points, many.request);
    let alone = |at: &Station, strain: &Strain| {
        integrate_sectional(law, &Job::new(Site { points, at, strain }, request))
    };
    match many.set() {
        Some(set) => in_lanes(set, many, &|few, entries| law.sum_few(few, entries), &alone),
        None => one_by_one(many.sites, many.out, alone),
    }
}

/// Fills `out` one strain at a time.
pub(super) fn one_by_one(
    sites: &[(Station, Strain)],
    out: &mut [Response],
    sum: impl Fn(&Station, &Strain) -> Result<Response>,
) -> Result<()> {
    for ((at, strain), out) in sites.iter().zip(out) {
        *out = sum(at, strain)?;
    }
    Ok(())
}
