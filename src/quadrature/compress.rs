use crate::error::Result;

use super::basis::{Basis, dimension, moments};
use super::householder::{Columns, Householder, axpy, dot};
use super::rule::{Rule, invalid};

/// The largest degree a rule can be compressed to: 24, 325 points, about a second from some 10⁴ points.
pub const MAX_COMPRESSED_DEGREE: usize = 24;

/// Rounds of halving allowed: more than any number of points in memory needs.
const MAX_ROUNDS: usize = 64;

/// See [`Rule::compressed`].
///
/// With m = (d+1)(d+2)/2, each round gathers the points into at most 2m clusters, finds m of them that can carry all
/// weight, and drops the points of the others: log₂(n/m) rounds of O(m³).
pub(super) fn compress(rule: &Rule, degree: usize) -> Result<Rule> {
    if degree > MAX_COMPRESSED_DEGREE {
        return Err(invalid("degree of a compressed quadrature rule", degree as f64, "at most 24"));
    }
    if rule.len() <= dimension(degree) {
        return Ok(rule.clone());
    }
    compress_on(rule, degree, &Basis::new(rule, degree))
}

/// As [`compress`], with the rule's basis at hand.
pub(super) fn compress_on(rule: &Rule, degree: usize, basis: &Basis) -> Result<Rule> {
    let m = basis.len();
    if rule.len() <= m {
        return Ok(rule.clone());
    }
    let basis: Columns = rule.iter().map(|(x, y, _)| basis.values(basis.frame.local(x, y))).collect();
    let mut points: Vec<(usize, f64)> = rule.weights().iter().copied().enumerate().collect();
    let target = moments(points.iter().map(|&(i, w)| (w, basis[i].as_slice())), m);
    for _ in 0..MAX_ROUNDS {
        if points.len() <= m {
            break;
        }
        points = halve(&points, &basis, m);
    }
    // A weight below rounding is a zero that rounding hid.
    let negligible = f64::EPSILON * rule.area() / rule.len() as f64;
    points.retain(|&(_, w)| w > negligible);
    for _ in 0..2 {
        polish(&mut points, &basis, &target);
    }
    let kept = points.iter().map(|&(i, w)| (rule.x()[i], rule.y()[i], w));
    Rule::from_points(kept, degree.min(rule.degree()))
}

/// One round: the points of at most m clusters out of 2m, with the same moments.
fn halve(points: &[(usize, f64)], basis: &[Vec<f64>], m: usize) -> Vec<(usize, f64)> {
    let count = points.len().min(2 * m);
    let cluster = |position: usize| position * count / points.len();
    let mut mass = vec![0.0; count];
    let mut rows: Columns = vec![vec![0.0; count]; m];
    for (position, &(i, w)) in points.iter().enumerate() {
        let c = cluster(position);
        mass[c] += w;
        for (row, value) in rows.iter_mut().zip(&basis[i]) {
            row[c] += w * value;
        }
    }
    // Averages rather than sums, so that small clusters do not make large null vectors.
    for row in &mut rows {
        row.iter_mut().zip(&mass).for_each(|(value, mass)| *value /= mass);
    }
    let kept = eliminate(mass.clone(), Householder::new(rows, count).null_space());
    let scale = |position: usize| kept[cluster(position)] / mass[cluster(position)];
    let scaled = points.iter().enumerate().map(|(position, &(i, w))| (i, w * scale(position)));
    scaled.filter(|&(_, w)| w > 0.0).collect()
}

/// Non-negative weights with the same moments, one zero for each null vector (Carathéodory).
///
/// A step along a null vector goes as far as the first weight that reaches zero; a reflection of the remaining null
/// vectors then makes them vanish there and keeps them orthonormal, so nothing grows.
fn eliminate(mut weights: Vec<f64>, mut null_space: Columns) -> Vec<f64> {
    while let Some(v) = null_space.pop() {
        let ratio = |i: usize| if v[i] > 0.0 { weights[i] / v[i] } else { f64::INFINITY };
        let Some(out) = (0..v.len()).min_by(|&i, &j| ratio(i).total_cmp(&ratio(j))) else { break };
        let step = ratio(out);
        if !step.is_finite() {
            continue; // not for a null vector of moments that include the area
        }
        for (w, v) in weights.iter_mut().zip(&v) {
            *w = (*w - step * v).max(0.0);
        }
        weights[out] = 0.0;
        clear_row(&mut null_space, v, out);
    }
    weights
}

/// Reflects the columns, `last` among them, so that all but `last` vanish in one row, and forgets `last`.
fn clear_row(columns: &mut Columns, last: Vec<f64>, row: usize) {
    let mut h: Vec<f64> = columns.iter().map(|c| c[row]).collect();
    let length = (dot(&h, &h) + last[row] * last[row]).sqrt();
    if length == 0.0 {
        return;
    }
    let corner = last[row] + length.copysign(last[row]);
    let square = dot(&h, &h) + corner * corner;
    let mut combined: Vec<f64> = last.iter().map(|x| corner * x).collect();
    for (h, column) in h.iter().zip(columns.iter()) {
        axpy(*h, column, &mut combined);
    }
    h.iter_mut().for_each(|h| *h *= 2.0 / square);
    for (h, column) in h.iter().zip(columns.iter_mut()) {
        axpy(-h, &combined, column);
        column[row] = 0.0;
    }
}

/// One step of iterative refinement of the weights; kept only when it brings the moments closer and all stay positive.
fn polish(points: &mut [(usize, f64)], basis: &[Vec<f64>], target: &[f64]) {
    let residual = |weights: &[f64]| -> Vec<f64> {
        let terms = points.iter().zip(weights).map(|(&(i, _), &w)| (-w, basis[i].as_slice()));
        moments(terms.chain(std::iter::once((1.0, target))), target.len())
    };
    let weights: Vec<f64> = points.iter().map(|p| p.1).collect();
    let before = residual(&weights);
    let columns: Columns = points.iter().map(|&(i, _)| basis[i].clone()).collect();
    let Some(step) = Householder::new(columns, target.len()).solve(before.clone()) else { return };
    let better: Vec<f64> = weights.iter().zip(&step).map(|(w, s)| w + s).collect();
    let after = residual(&better);
    if better.iter().all(|w| *w > 0.0) && dot(&after, &after) < dot(&before, &before) {
        points.iter_mut().zip(better).for_each(|(point, w)| point.1 = w);
    }
}
