//! What is asked of a law, as one argument.

use super::batch::integrate_many;
use super::blocks::Blocks;
use super::integrate::{Job, Site, integrate_local};
use super::response::{Points, Request, Response, Station};
use super::sectional::{Spans, integrate_sectional};
use super::sums::Totals;
use crate::error::Result;
use crate::lie::Strain;

/// The response to one strain, or to many.
pub struct Task<'a>(Work<'a>);

enum Work<'a> {
    One(Job<'a>),
    Many(&'a Points, &'a [(Station, Strain)], Request, &'a mut [Response]),
}

impl<'a> Task<'a> {
    /// The response to one strain, of a law that performs the task. The sums are made apart and the response written once, where it will be
    /// returned: a copy of one costs as much as a block of points.
    #[inline(always)]
    pub(super) fn respond(
        site: Site<'_>,
        request: Request,
        perform: impl FnOnce(&mut Task<'_>) -> Result<()>,
    ) -> Result<Response> {
        let mut totals = Totals::ZERO;
        perform(&mut Task(Work::One(Job::new(site, request, &mut totals))))?;
        Ok(totals.response(request))
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

    /// By a law of the deformation.
    pub(super) fn perform(&mut self, law: &dyn Blocks) -> Result<()> {
        match &mut self.0 {
            Work::One(job) => integrate_local(law, job),
            Work::Many(points, sites, request, out) => integrate_many(law, points, sites, *request, out),
        }
    }

    /// By a law of the strain.
    pub(super) fn perform_sectional(&mut self, law: &dyn Spans) -> Result<()> {
        match &mut self.0 {
            Work::One(job) => integrate_sectional(law, job),
            Work::Many(points, sites, request, out) => {
                let request = *request;
                one_by_one(sites, request, out, |at, strain, totals| {
                    integrate_sectional(law, &mut Job::new(Site { points, at, strain }, request, totals))
                })
            }
        }
    }
}

/// Fills `out` one strain at a time.
pub(super) fn one_by_one(
    sites: &[(Station, Strain)],
    request: Request,
    out: &mut [Response],
    sum: impl Fn(&Station, &Strain, &mut Totals) -> Result<()>,
) -> Result<()> {
    for ((at, strain), out) in sites.iter().zip(out) {
        let mut totals = Totals::ZERO;
        sum(at, strain, &mut totals)?;
        *out = totals.response(request);
    }
    Ok(())
}
