use crate::error::Result;

use super::basis::{Basis, moments};
use super::householder::{Columns, axpy, dot};
use super::rule::Rule;

/// The largest degree searched: 8 takes some 0.2 s, and each degree more about twice as long.
pub(super) const MAX_ELIMINATED_DEGREE: usize = 8;

/// Gauss–Newton steps allowed for each candidate.
const MAX_STEPS: usize = 30;

/// Halvings of a step that would leave the shape.
const MAX_HALVINGS: usize = 6;

/// A point in the frame of the rule, and its share of the area.
#[derive(Debug, Clone, Copy)]
struct Node {
    place: [f64; 2],
    weight: f64,
}

/// The moment equations Σ w φ(x) = b of one shape.
struct Moments<'a> {
    basis: &'a Basis,
    target: Vec<f64>,
    inside: &'a dyn Fn([f64; 2]) -> bool,
}

/// A rule of the same degree with fewer points, moved inside the shape: drop a point, solve the moment equations for
/// the others, repeat while one of the points can go.
///
/// Xiao & Gimbutas (2010), "A numerical algorithm for the construction of efficient quadrature rules in two and higher
/// dimensions". The points with the least share in the moments are tried first.
pub(super) fn eliminate(rule: &Rule, basis: &Basis, inside: impl Fn(f64, f64) -> bool) -> Result<Rule> {
    let area = rule.area();
    let frame = &basis.frame;
    let mut nodes: Vec<Node> =
        rule.iter().map(|(x, y, w)| Node { place: frame.local(x, y), weight: w / area }).collect();
    let local_inside = |place: [f64; 2]| {
        let (x, y) = frame.global(place);
        inside(x, y)
    };
    let mut problem = Moments { basis, target: Vec::new(), inside: &local_inside };
    problem.target = problem.of(&nodes);
    let all = nodes.len();
    for _ in 0..all {
        let Some(fewer) = problem.drop_one(&nodes) else { break };
        nodes = fewer;
    }
    if nodes.len() == all {
        return Ok(rule.clone());
    }
    let points = nodes.iter().map(|node| {
        let (x, y) = frame.global(node.place);
        (x, y, area * node.weight)
    });
    Rule::from_points(points, rule.degree())
}

impl Moments<'_> {
    fn of(&self, nodes: &[Node]) -> Vec<f64> {
        let columns: Columns = nodes.iter().map(|node| self.basis.values(node.place)).collect();
        moments(nodes.iter().zip(&columns).map(|(n, c)| (n.weight, c.as_slice())), self.basis.len())
    }

    fn residual(&self, nodes: &[Node]) -> Vec<f64> {
        let mut residual = self.of(nodes);
        axpy(-1.0, &self.target, &mut residual);
        residual
    }

    /// A solution with one node less, if any of them can go.
    fn drop_one(&self, nodes: &[Node]) -> Option<Vec<Node>> {
        // three unknowns a node
        if 3 * (nodes.len() - 1) < self.target.len() {
            return None;
        }
        let share = |node: &Node| {
            let column = self.basis.values(node.place);
            node.weight * dot(&column, &column)
        };
        let mut order: Vec<(f64, usize)> = nodes.iter().map(share).zip(0..).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        order.iter().find_map(|&(_, out)| {
            let mut candidate = nodes.to_vec();
            candidate.remove(out);
            self.solve(candidate)
        })
    }

    /// Gauss–Newton steps of least size until the moments hold to rounding.
    fn solve(&self, mut nodes: Vec<Node>) -> Option<Vec<Node>> {
        let mut residual = self.residual(&nodes);
        let mut size = dot(&residual, &residual).sqrt();
        for _ in 0..MAX_STEPS {
            let step = self.step(&nodes, &residual, size)?;
            let next = self.damped(&nodes, &step)?;
            let next_residual = self.residual(&next);
            let next_size = dot(&next_residual, &next_residual).sqrt();
            // Moments are at most 1: this is rounding, and a step no longer improves on it.
            if size < 1e-14 && next_size >= 0.5 * size {
                return Some(nodes);
            }
            (nodes, residual, size) = (next, next_residual, next_size);
        }
        None
    }

    /// −Jᵀ(JJᵀ + λ)⁻¹ r, with λ → 0 along with the residual (Levenberg and Marquardt).
    fn step(&self, nodes: &[Node], residual: &[f64], size: f64) -> Option<Vec<[f64; 3]>> {
        let jacobian: Vec<[Vec<f64>; 3]> = nodes
            .iter()
            .map(|node| {
                let values = self.basis.values(node.place);
                let [by_u, by_v] = self.basis.gradients(node.place, &values);
                let scaled = |g: Vec<f64>| g.iter().map(|x| node.weight * x).collect();
                [scaled(by_u), scaled(by_v), values]
            })
            .collect();
        let m = residual.len();
        let damping = 1e-15 + 1e-3 * size * size;
        let mut normal: Columns =
            (0..m).map(|i| (0..m).map(|j| if i == j { damping } else { 0.0 }).collect()).collect();
        for column in jacobian.iter().flatten() {
            for (row, &c) in normal.iter_mut().zip(column) {
                axpy(c, column, row);
            }
        }
        let multiplier = solve_positive(normal, residual.to_vec())?;
        Some(jacobian.iter().map(|node| [0, 1, 2].map(|k| -dot(&node[k], &multiplier))).collect())
    }

    /// The step, halved until every node is inside with a positive weight.
    fn damped(&self, nodes: &[Node], step: &[[f64; 3]]) -> Option<Vec<Node>> {
        let mut factor = 1.0;
        for _ in 0..MAX_HALVINGS {
            let next: Vec<Node> = nodes
                .iter()
                .zip(step)
                .map(|(n, [du, dv, dw])| Node {
                    place: [n.place[0] + factor * du, n.place[1] + factor * dv],
                    weight: n.weight + factor * dw,
                })
                .collect();
            if next.iter().all(|n| n.weight > 0.0 && (self.inside)(n.place)) {
                return Some(next);
            }
            factor *= 0.5;
        }
        None
    }
}

/// Cholesky's solution of a symmetric positive definite system; `None` when it is not.
fn solve_positive(mut matrix: Columns, mut rhs: Vec<f64>) -> Option<Vec<f64>> {
    let n = rhs.len();
    for k in 0..n {
        let (done, rest) = matrix.split_at_mut(k);
        for i in k..n {
            let product = dot(
                &done.iter().map(|c| c[i]).collect::<Vec<_>>(),
                &done.iter().map(|c| c[k]).collect::<Vec<_>>(),
            );
            rest[0][i] -= product;
        }
        let pivot = rest[0][k].sqrt();
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        rest[0][k..].iter_mut().for_each(|x| *x /= pivot);
    }
    for k in 0..n {
        rhs[k] /= matrix[k][k];
        let value = rhs[k];
        axpy(-value, &matrix[k][k + 1..], &mut rhs[k + 1..]);
    }
    for k in (0..n).rev() {
        rhs[k] = (rhs[k] - dot(&matrix[k][k + 1..], &rhs[k + 1..])) / matrix[k][k];
    }
    Some(rhs)
}
