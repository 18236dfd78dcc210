//! What made a sum inadmissible or not finite, and where.

use super::integrate::Site;
use super::response::{Points, Response, Station, check_strain};
use super::span::{column, volume};
use crate::error::{Error, Result};

/// Finds what made a sum inadmissible or not finite, and where: by the same sum over one point at a time, which fails with [`not_finite`].
#[cold]
pub(super) fn diagnose(site: &Site<'_>, local: bool, sum: &dyn Fn(&Site<'_>) -> Result<Response>) -> Error {
    let Site { points, at, strain } = *site;
    if let Err(error) = check_strain(strain, at.s) {
        return error;
    }
    for q in 0..points.len() {
        let (x, y) = (points.x[q], points.y[q]);
        if local {
            let j = volume(&at.reference.twist.to_array(), x, y);
            if !(j > 0.0) {
                let requirement = "positive: the section reaches the centre of curvature of the reference";
                return inadmissible("volume of the reference", j, requirement, at.s, x, y);
            }
            let stretch = 1.0 + column(&strain.to_array(), x, y)[2] / j;
            if !(stretch > 0.0) {
                return inadmissible("J", stretch, "positive", at.s, x, y);
            }
        }
        let one = Points { x: vec![x], y: vec![y], weight: vec![1.0], rates: None };
        if let Err(error) = sum(&Site { points: &one, ..*site }) {
            return error;
        }
    }
    no_derivative(at)
}

/// The energy density of a law is not finite at the one point of a site.
pub(super) fn not_finite(domain: &'static str, site: &Site<'_>, u: f64) -> Error {
    let Site { points, at, .. } = *site;
    let first = |coordinate: &[f64]| coordinate.first().copied().unwrap_or(0.0);
    inadmissible("energy density", u, domain, at.s, first(&points.x), first(&points.y))
}

/// Every energy density is finite, but a sum of derivatives is not.
fn no_derivative(at: &Station) -> Error {
    Error::InvalidAt {
        quantity: "wrench or tangent of the section",
        value: f64::NAN,
        requirement: "finite: the energy density has no such derivative there",
        s: at.s,
    }
}

fn inadmissible(
    quantity: &'static str,
    value: f64,
    requirement: &'static str,
    s: f64,
    x: f64,
    y: f64,
) -> Error {
    Error::Inadmissible { quantity, value, requirement, s, x, y }
}
