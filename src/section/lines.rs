//! Points of a section that bending in the plane of x and z moves alike.

use crate::lie::Strain;
use crate::material::{Active, Points, Station};

/// ω_y, ν_x and ν_z.
const PLANE: Active = Active::of([false, true, false, true, false, true]);

/// Whether what is active, and the strains and references themselves, deform points of the same x alike: γ = (ν_x, ν_y, ν_z − ω_y x).
pub(super) fn are_alike(active: Active, sites: &[(Station, Strain)]) -> bool {
    let straight_across = |(at, strain): &(Station, Strain)| {
        let twist = &at.reference.twist.angular;
        strain.angular.x == 0.0 && strain.angular.z == 0.0 && twist.x == 0.0
    };
    active.places().all(|i| PLANE.contains(i)) && sites.iter().all(straight_across)
}

/// The points with those of the same x as one; `None` where there are none of the same, or the points move.
pub(super) fn lines(points: &Points) -> Option<Points> {
    /// Of the largest x: roundings of the rules of quadrature.
    const SAME: f64 = 1e-14;
    if points.rates.is_some() {
        return None;
    }
    let size = points.x.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&i, &j| points.x[i].total_cmp(&points.x[j]));
    let mut lines = Points::default();
    for i in order {
        let (x, weight) = (points.x[i], points.weight[i]);
        match (lines.x.last(), lines.weight.last_mut()) {
            (Some(last), Some(sum)) if (x - last).abs() <= SAME * size => *sum += weight,
            _ => {
                lines.x.push(x);
                lines.y.push(0.0);
                lines.weight.push(weight);
            }
        }
    }
    if lines.len() < points.len() { Some(lines) } else { None }
}
