use crate::error::Result;

use super::line::{LineRule, gauss_legendre};
use super::ring::Place;
use super::rule::Rule;

/// A horizontal trapezoid: x from left to right, both linear between its two heights.
struct Trapezoid {
    low: f64,
    high: f64,
    left: [f64; 2],
    width: [f64; 2],
}

/// Rules of the trapezoids that lines y = constant through the vertices cut a polygon into.
///
/// Holes need no bridges here, unlike in ear clipping: within a slab without vertices the edges that cross it, sorted
/// by x, bound inside and outside in turn. The integrand times the width is of degree d + 1 in y.
pub(super) fn composite_rule(edges: &[(Place, Place)], degree: usize) -> Result<Rule> {
    let across = gauss_legendre((degree + 1).div_ceil(2))?.on(0.0, 1.0)?;
    let up = gauss_legendre((degree + 2).div_ceil(2))?.on(0.0, 1.0)?;
    let points = trapezoids(edges).iter().flat_map(|t| t.points(&across, &up)).collect::<Vec<_>>();
    Rule::from_points(points, degree)
}

impl Trapezoid {
    fn points(&self, across: &LineRule, up: &LineRule) -> Vec<(f64, f64, f64)> {
        let height = self.high - self.low;
        let mut points = Vec::with_capacity(across.len() * up.len());
        for (v, wv) in up.iter() {
            let left = (1.0 - v) * self.left[0] + v * self.left[1];
            let width = (1.0 - v) * self.width[0] + v * self.width[1];
            let weight = height * width * wv;
            points
                .extend(across.iter().map(|(u, wu)| (left + u * width, self.low + v * height, weight * wu)));
        }
        // a sliver's area can underflow
        points.retain(|p| p.2 > 0.0);
        points
    }
}

fn trapezoids(edges: &[(Place, Place)]) -> Vec<Trapezoid> {
    let heights = distinct_heights(edges);
    let mut pieces = Vec::new();
    for pair in heights.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let mut crossing: Vec<[f64; 2]> = edges
            .iter()
            .filter_map(|&(a, b)| {
                let (a, b) = if a[1] < b[1] { (a, b) } else { (b, a) };
                let (bottom, top) = (snap(&heights, a[1]), snap(&heights, b[1]));
                (bottom <= low && high <= top).then(|| [x_at(a, b, low), x_at(a, b, high)])
            })
            .collect();
        crossing.sort_by(|p, q| (p[0] + p[1]).total_cmp(&(q[0] + q[1])));
        pieces.extend(crossing.chunks_exact(2).map(|sides| Trapezoid {
            low,
            high,
            left: sides[0],
            width: [0, 1].map(|i| (sides[1][i] - sides[0][i]).max(0.0)),
        }));
    }
    pieces
}

/// Where the edge from a up to b has height y, from the nearer end.
fn x_at(a: Place, b: Place, y: f64) -> f64 {
    let slope = (b[0] - a[0]) / (b[1] - a[1]);
    let (below, above) = ((y - a[1]).max(0.0), (b[1] - y).max(0.0));
    if below < above { a[0] + below * slope } else { b[0] - above * slope }
}

/// The heights of the vertices in increasing order, those within a few roundings of each other taken as one.
fn distinct_heights(edges: &[(Place, Place)]) -> Vec<f64> {
    let mut heights: Vec<f64> = edges.iter().map(|(a, _)| a[1]).collect();
    heights.sort_by(f64::total_cmp);
    let largest = heights.iter().fold(0.0f64, |m, y| m.max(y.abs()));
    let mut distinct: Vec<f64> = Vec::new();
    for y in heights {
        if distinct.last().is_none_or(|last| y - last > 4.0 * f64::EPSILON * largest) {
            distinct.push(y);
        }
    }
    distinct
}

/// The representative of a vertex height: the largest distinct height not above it.
fn snap(heights: &[f64], y: f64) -> f64 {
    heights[heights.partition_point(|h| *h <= y).max(1) - 1]
}
