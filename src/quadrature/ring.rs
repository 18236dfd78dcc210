use crate::error::PolygonError;

/// A place in the plane.
pub(super) type Place = [f64; 2];

/// A checked closed ring of a polygon: it is simple, has an area, and runs the way it was asked to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ring {
    vertices: Vec<Place>,
    /// Whether the vertices were reversed, for errors in the caller's numbering.
    reversed: bool,
}

impl Ring {
    /// Checks the vertices of ring number `ring` and turns it counter-clockwise.
    pub(super) fn new(mut vertices: Vec<Place>, ring: usize) -> Result<Self, PolygonError> {
        for (vertex, &[x, y]) in vertices.iter().enumerate() {
            if !(x.is_finite() && y.is_finite()) {
                return Err(PolygonError::NotFinite { ring, vertex, x, y });
            }
        }
        let count = vertices.len();
        if count < 3 {
            return Err(PolygonError::TooFewVertices { ring, count });
        }
        repeated_vertex(&vertices, ring)?;
        if all_on_one_line(&vertices) {
            return Err(PolygonError::ZeroArea { ring });
        }
        self_intersection(&vertices, ring)?;
        let reversed = signed_area(&vertices) < 0.0;
        if reversed {
            vertices.reverse();
        }
        Ok(Self { vertices, reversed })
    }

    /// The vertices, counter-clockwise.
    pub(super) fn vertices(&self) -> &[Place] {
        &self.vertices
    }

    /// The enclosed area, positive.
    pub(super) fn area(&self) -> f64 {
        signed_area(&self.vertices)
    }

    /// The edges with their numbers in the caller's order.
    pub(super) fn edges(&self) -> impl Iterator<Item = (usize, Place, Place)> + '_ {
        let n = self.vertices.len();
        (0..n).map(move |i| {
            let number = if self.reversed { (2 * n - 2 - i) % n } else { i };
            (number, self.vertices[i], self.vertices[(i + 1) % n])
        })
    }

    /// Whether (x, y) is inside, by the parity of the edges to its right.
    pub(super) fn contains(&self, [x, y]: Place) -> bool {
        self.edges().fold(false, |inside, (_, a, b)| {
            let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
            let crosses = (low[1] <= y) && (y < high[1]) && orientation(low, high, [x, y]) > 0.0;
            inside ^ crosses
        })
    }

    /// The first pair of edges (own, other's) that cross or touch.
    pub(super) fn meets(&self, other: &Self) -> Option<(usize, usize)> {
        self.edges().find_map(|(i, a, b)| {
            other.edges().find_map(|(j, p, q)| segments_meet(a, b, p, q).then_some((i, j)))
        })
    }
}

/// Twice the area of a, b, c, positive counter-clockwise; zero when rounding hides its sign.
///
/// Shewchuk (1997), "Adaptive precision floating-point arithmetic and fast robust geometric predicates": the error of
/// the determinant is at most (3 + 16ε)ε times the sum of its products' sizes, with ε half of [`f64::EPSILON`].
fn orientation(a: Place, b: Place, c: Place) -> f64 {
    let left = (a[0] - c[0]) * (b[1] - c[1]);
    let right = (a[1] - c[1]) * (b[0] - c[0]);
    let det = left - right;
    if det.abs() <= 2.0 * f64::EPSILON * (left.abs() + right.abs()) { 0.0 } else { det }
}

/// Whether the closed segments ab and pq share a point.
fn segments_meet(a: Place, b: Place, p: Place, q: Place) -> bool {
    let within =
        |a: Place, b: Place, c: Place| (0..2).all(|i| a[i].min(b[i]) <= c[i] && c[i] <= a[i].max(b[i]));
    let sides = [orientation(a, b, p), orientation(a, b, q), orientation(p, q, a), orientation(p, q, b)];
    let opposite = |u: f64, v: f64| (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0);
    (opposite(sides[0], sides[1]) && opposite(sides[2], sides[3]))
        || (sides[0] == 0.0 && within(a, b, p))
        || (sides[1] == 0.0 && within(a, b, q))
        || (sides[2] == 0.0 && within(p, q, a))
        || (sides[3] == 0.0 && within(p, q, b))
}

fn repeated_vertex(vertices: &[Place], ring: usize) -> Result<(), PolygonError> {
    for (second, b) in vertices.iter().enumerate() {
        if let Some(first) = vertices[..second].iter().position(|a| a == b) {
            return Err(PolygonError::RepeatedVertex { ring, first, second });
        }
    }
    Ok(())
}

/// Whether every vertex lies on the line from the first vertex to the one farthest from it.
fn all_on_one_line(vertices: &[Place]) -> bool {
    let a = vertices[0];
    let distance = |p: &Place| (p[0] - a[0]).hypot(p[1] - a[1]);
    let far = vertices.iter().fold(a, |far, p| if distance(p) > distance(&far) { *p } else { far });
    vertices.iter().all(|&c| orientation(a, far, c) == 0.0)
}

fn self_intersection(vertices: &[Place], ring: usize) -> Result<(), PolygonError> {
    let n = vertices.len();
    let edge = |i: usize| (vertices[i], vertices[(i + 1) % n]);
    for second in 1..n {
        for first in 0..second {
            let ((a, b), (p, q)) = (edge(first), edge(second));
            let clash = if first + 1 == second {
                folds_back(a, b, q)
            } else if second + 1 == n && first == 0 {
                folds_back(p, q, b)
            } else {
                segments_meet(a, b, p, q)
            };
            if clash {
                return Err(PolygonError::SelfIntersection { ring, first, second });
            }
        }
    }
    Ok(())
}

/// Whether the path a, b, c returns along itself at b.
fn folds_back(a: Place, b: Place, c: Place) -> bool {
    let forward = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    forward < 0.0 && orientation(a, b, c) == 0.0
}

/// The shoelace formula, about the first vertex so that a far-away polygon keeps its digits.
fn signed_area(vertices: &[Place]) -> f64 {
    let [x, y] = vertices[0];
    let cross = |a: Place, b: Place| (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
    0.5 * vertices.windows(2).map(|pair| cross(pair[0], pair[1])).sum::<f64>()
}
