use crate::error::{PolygonError, Result};

use super::basis::Basis;
use super::compress::{MAX_COMPRESSED_DEGREE, compress_on};
use super::eliminate::{MAX_ELIMINATED_DEGREE, eliminate};
use super::ring::{Place, Ring};
use super::rule::{Rule, check_degree};
use super::slabs::composite_rule;

/// Starts of the search for few points.
const STARTS: usize = 4;

/// A simple polygon, convex or not, with any number of holes.
///
/// ```
/// use hyperrod::quadrature::Polygon;
///
/// let square = |a: f64| vec![[-a, -a], [a, -a], [a, a], [-a, a]];
/// let tube = Polygon::new(square(1.0))?.with_hole(square(0.8))?;
/// let rule = tube.rule(2)?;
/// let inertia: f64 = rule.iter().map(|(x, _, w)| w * x * x).sum();
/// assert!((inertia - 4.0 / 3.0 * (1.0 - 0.8f64.powi(4))).abs() < 1e-14);
/// assert!(rule.len() <= 6);
/// # Ok::<(), hyperrod::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// The outer boundary, then the holes.
    rings: Vec<Ring>,
}

impl Polygon {
    /// The polygon with these vertices in order, either way round, the first not repeated at the end.
    ///
    /// # Errors
    /// [`Error::Polygon`](crate::Error::Polygon) naming the vertices or edges, when a coordinate is not finite, there
    /// are fewer than 3 vertices, a vertex is visited twice, all lie on a line, or edges cross or touch.
    pub fn new(outer: Vec<[f64; 2]>) -> Result<Self> {
        Ok(Self { rings: vec![Ring::new(outer, 0)?] })
    }

    /// This polygon less another one strictly inside it, either way round.
    ///
    /// # Errors
    /// As [`Polygon::new`] for the hole itself, and when it crosses or touches another ring, lies outside the outer
    /// boundary, or contains or lies in another hole.
    pub fn with_hole(mut self, hole: Vec<[f64; 2]>) -> Result<Self> {
        let ring = self.rings.len();
        let hole = Ring::new(hole, ring)?;
        for (other, existing) in self.rings.iter().enumerate() {
            if let Some((edge, other_edge)) = hole.meets(existing) {
                return Err(PolygonError::RingsCross { ring, edge, other, other_edge }.into());
            }
        }
        let [x, y] = hole.vertices()[0];
        if !self.rings[0].contains([x, y]) {
            return Err(PolygonError::HoleOutside { ring, x, y }.into());
        }
        for (other, existing) in self.rings.iter().enumerate().skip(1) {
            if existing.contains([x, y]) || hole.contains(existing.vertices()[0]) {
                return Err(PolygonError::HolesNested { ring, other }.into());
            }
        }
        self.rings.push(hole);
        Ok(self)
    }

    /// The area, holes taken off.
    pub fn area(&self) -> f64 {
        let holes: f64 = self.rings[1..].iter().map(Ring::area).sum();
        self.rings[0].area() - holes
    }

    /// Whether (x, y) is inside the outer boundary and in no hole; either answer on an edge.
    pub fn contains(&self, x: f64, y: f64) -> bool {
        self.rings.iter().fold(false, |inside, ring| inside ^ ring.contains([x, y]))
    }

    /// A rule exact to a total degree, with positive weights and points inside.
    ///
    /// The polygon is cut into trapezoids by lines through its vertices, each with a product rule; the whole is
    /// [compressed](Rule::compressed) to at most (d+1)(d+2)/2 points, and up to degree 8 moved to fewer, a bit above a third
    /// as many (node elimination, Xiao & Gimbutas 2010). Above
    /// [`MAX_COMPRESSED_DEGREE`](super::MAX_COMPRESSED_DEGREE) the trapezoids' rules are returned as they are.
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) when the degree is above [`MAX_DEGREE`](super::MAX_DEGREE).
    pub fn rule(&self, degree: usize) -> Result<Rule> {
        check_degree(degree)?;
        let edges: Vec<(Place, Place)> =
            self.rings.iter().flat_map(Ring::edges).map(|(_, a, b)| (a, b)).collect();
        if degree > MAX_COMPRESSED_DEGREE {
            return composite_rule(&edges, degree);
        }
        // Products of two polynomials are to be integrated exactly: only then is a basis orthonormal on the points one
        // on the polygon.
        let composite = composite_rule(&edges, 2 * degree)?;
        let basis = Basis::new(&composite, degree);
        let mut best = compress_on(&composite, degree, &basis)?;
        if degree > MAX_ELIMINATED_DEGREE {
            return Ok(best);
        }
        // Where the search ends depends on where it starts; finer composite rules give other starts.
        let fewest = basis.len().div_ceil(3);
        for finer in 0..STARTS {
            let start = compress_on(&composite_rule(&edges, 2 * (degree + finer))?, degree, &basis)?;
            let found = eliminate(&start, &basis, |x, y| self.contains(x, y))?;
            if found.len() < best.len() {
                best = found;
            }
            if best.len() <= fewest {
                break;
            }
        }
        Ok(best)
    }
}
