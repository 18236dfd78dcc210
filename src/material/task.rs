//! What is asked of a law, as one argument.

use super::batch::integrate_many;
use super::blocks::Blocks;
use super::integrate::{Job, Site, integrate_local};
use super::response::{Points, Request, Response, Station};
use super::sectional::{Spans, integrate_sectional};
use crate::error::Result;
use crate::lie::Strain;

/// The response to one strain, or to many.
pub struct Task<'a>(Work<'a>);

enum Work<'a> {
    One(Job<'a>),
    Many(&'a Points, &'a [(Station, Strain)], Request, &'a mut [Response]),
}

impl<'a> Task<'a> {
    /// One strain.
    #[inline(always)]
    pub(super) fn one(site: Site<'a>, request: Request) -> Self {
        Self(Work::One(Job::new(site, request)))
    }

    /// Many strains and responses.
    pub(super) fn many(
        points: &'a Points,
        sites: &'a [(Station, Strain)],
        request: Request,
        out: &'a mut [Response],
    ) -> Self {
        Self(Work::Many(points, sites, request, out))
    }

    /// By a law of the deformation. The response to one strain is returned: what sums it up writes it where the caller will find it, since a
    /// copy of one costs as much as a block of points. Those to many strains are where the task wants them, and none is returned.
    pub(super) fn perform(&mut self, law: &dyn Blocks) -> Result<Response> {
        match &mut self.0 {
            Work::One(job) => integrate_local(law, job),
            Work::Many(points, sites, request, out) => {
                integrate_many(law, points, sites, *request, out)?;
                Ok(Response::ZERO)
            }
        }
    }

    /// By a law of the strain, likewise.
    pub(super) fn perform_sectional(&mut self, law: &dyn Spans) -> Result<Response> {
        match &mut self.0 {
            Work::One(job) => integrate_sectional(law, job),
            Work::Many(points, sites, request, out) => {
                let request = *request;
                one_by_one(sites, out, |at, strain| {
                    integrate_sectional(law, &Job::new(Site { points, at, strain }, request))
                })?;
                Ok(Response::ZERO)
            }
        }
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
