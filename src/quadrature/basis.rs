use super::householder::{Columns, axpy, dot};
use super::rule::Rule;

/// Number of monomials of total degree up to d.
pub(super) fn dimension(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// A box along the principal axes of a rule's points, in which coordinates are at most 1.
pub(super) struct Frame {
    centre: [f64; 2],
    axis: [f64; 2],
    half: [f64; 2],
}

impl Frame {
    /// The frame of a rule: centroid, principal axes, and the extents of its points.
    pub(super) fn new(rule: &Rule) -> Self {
        let area = rule.area();
        let mean = |f: &dyn Fn(f64, f64) -> f64| rule.iter().map(|(x, y, w)| w * f(x, y)).sum::<f64>() / area;
        let centre = [mean(&|x, _| x), mean(&|_, y| y)];
        let (dx, dy) = (|x: f64| x - centre[0], |y: f64| y - centre[1]);
        let xx = mean(&|x, _| dx(x) * dx(x));
        let yy = mean(&|_, y| dy(y) * dy(y));
        let xy = mean(&|x, y| dx(x) * dy(y));
        // A shape with equal principal moments has no axes of its own: keep the given ones rather than rounding's.
        let isotropic = (xx - yy).hypot(2.0 * xy) < 1e-10 * (xx + yy);
        let angle = if isotropic { 0.0 } else { 0.5 * (2.0 * xy).atan2(xx - yy) };
        let mut frame = Self { centre, axis: [angle.cos(), angle.sin()], half: [1.0; 2] };
        let places: Vec<_> = rule.iter().map(|(x, y, _)| frame.local(x, y)).collect();
        frame.half = [0, 1].map(|i| {
            let extent = places.iter().fold(0.0f64, |m, p| m.max(p[i].abs()));
            if extent > 0.0 { extent } else { 1.0 }
        });
        frame
    }

    /// Coordinates along the axes, at most 1 in size for the points of the rule.
    pub(super) fn local(&self, x: f64, y: f64) -> [f64; 2] {
        let (dx, dy) = (x - self.centre[0], y - self.centre[1]);
        let [c, s] = self.axis;
        [(c * dx + s * dy) / self.half[0], (c * dy - s * dx) / self.half[1]]
    }

    /// The inverse of [`Frame::local`].
    pub(super) fn global(&self, [u, v]: [f64; 2]) -> (f64, f64) {
        let (p, q) = (u * self.half[0], v * self.half[1]);
        let [c, s] = self.axis;
        (self.centre[0] + c * p - s * q, self.centre[1] + s * p + c * q)
    }
}

/// One basis polynomial from earlier ones: scale · (coordinate · p_parent − Σ c_i p_(first+i)).
struct Recurrence {
    parent: usize,
    /// 0 for u, 1 for v.
    coordinate: usize,
    first: usize,
    coefficients: Vec<f64>,
    /// Zero for a polynomial that vanishes on all points.
    scale: f64,
}

/// Polynomials in u and v up to a degree, orthonormal on the points of a rule, p_0 = 1.
///
/// Multiply an earlier polynomial by a coordinate, orthogonalise: the Arnoldi process of Brubeck, Nakatsukasa & Trefethen
/// (2021), "Vandermonde with Arnoldi", in two variables. A polynomial of size 1 on the shape has coefficients of size
/// 1, which products of Legendre polynomials on a box around the shape do not give.
pub(super) struct Basis {
    pub(super) frame: Frame,
    recurrences: Vec<Recurrence>,
}

impl Basis {
    /// The basis of a rule.
    pub(super) fn new(rule: &Rule, degree: usize) -> Self {
        let (frame, area) = (Frame::new(rule), rule.area());
        let places: Vec<[f64; 2]> = rule.iter().map(|(x, y, _)| frame.local(x, y)).collect();
        let shares: Vec<f64> = rule.weights().iter().map(|w| w / area).collect();
        let mut columns: Columns = vec![vec![1.0; places.len()]];
        let mut recurrences = Vec::with_capacity(dimension(degree) - 1);
        for n in 1..=degree {
            // A coordinate times a polynomial of degree n − 1 is orthogonal to all of degree below n − 2.
            let first = if n > 2 { dimension(n - 3) } else { 0 };
            let mut candidates = Candidates::new(n, first, &columns, &places, &shares);
            for _ in 0..=n {
                let (parent, coordinate) = candidates.pick(&shares);
                let mut column = multiply(&columns[parent], &places, coordinate);
                let (coefficients, scale) = orthonormalise(&mut column, &columns[first..], &shares);
                candidates.deflate(&column, &shares);
                columns.push(column);
                recurrences.push(Recurrence { parent, coordinate, first, coefficients, scale });
            }
        }
        Self { frame, recurrences }
    }

    /// Number of polynomials.
    pub(super) fn len(&self) -> usize {
        self.recurrences.len() + 1
    }

    /// The polynomials at a place in the frame.
    pub(super) fn values(&self, place: [f64; 2]) -> Vec<f64> {
        let mut p = Vec::with_capacity(self.len());
        p.push(1.0);
        for r in &self.recurrences {
            let taken = dot(&r.coefficients, &p[r.first..]);
            p.push(r.scale * (place[r.coordinate] * p[r.parent] - taken));
        }
        p
    }

    /// The derivatives of `values` by u and by v.
    pub(super) fn gradients(&self, place: [f64; 2], values: &[f64]) -> [Vec<f64>; 2] {
        [0, 1].map(|k| {
            let mut slope = Vec::with_capacity(self.len());
            slope.push(0.0);
            for r in &self.recurrences {
                let product = if r.coordinate == k { values[r.parent] } else { 0.0 };
                let taken = dot(&r.coefficients, &slope[r.first..]);
                slope.push(r.scale * (product + place[r.coordinate] * slope[r.parent] - taken));
            }
            slope
        })
    }
}

/// The products of both coordinates with all polynomials of one degree, less their part in the basis so far.
///
/// There are twice as many as needed, and their order matters: taken as they come, the last remainders of a degree are
/// small and mostly rounding, worse by a factor each degree (1e-11 lost at degree 20 on an L). So the largest goes next.
struct Candidates {
    origins: Vec<(usize, usize)>,
    remainders: Columns,
}

impl Candidates {
    fn new(n: usize, first: usize, columns: &[Vec<f64>], places: &[[f64; 2]], shares: &[f64]) -> Self {
        let parents = columns.len() - n..columns.len();
        let origins: Vec<(usize, usize)> = parents.flat_map(|parent| [(parent, 0), (parent, 1)]).collect();
        let remainder = |&(parent, coordinate): &(usize, usize)| {
            let mut column = multiply(&columns[parent], places, coordinate);
            project_out(&mut column, &columns[first..], shares);
            column
        };
        Self { remainders: origins.iter().map(remainder).collect(), origins }
    }

    /// Takes out the (parent, coordinate) of the largest remainder, the first among equals.
    fn pick(&mut self, shares: &[f64]) -> (usize, usize) {
        let mut best = (0, -1.0);
        for (k, remainder) in self.remainders.iter().enumerate() {
            let size = dot(&weighted(remainder, shares), remainder);
            if size > best.1 * (1.0 + 1e-10) {
                best = (k, size);
            }
        }
        self.remainders.remove(best.0);
        self.origins.remove(best.0)
    }

    fn deflate(&mut self, column: &[f64], shares: &[f64]) {
        let weighted = weighted(column, shares);
        for remainder in &mut self.remainders {
            let part = dot(&weighted, remainder);
            axpy(-part, column, remainder);
        }
    }
}

fn multiply(column: &[f64], places: &[[f64; 2]], coordinate: usize) -> Vec<f64> {
    column.iter().zip(places).map(|(p, place)| p * place[coordinate]).collect()
}

fn weighted(column: &[f64], shares: &[f64]) -> Vec<f64> {
    column.iter().zip(shares).map(|(p, w)| p * w).collect()
}

/// Takes off the part of the column in the span of orthonormal earlier ones, and returns its coefficients.
fn project_out(column: &mut [f64], earlier: &[Vec<f64>], shares: &[f64]) -> Vec<f64> {
    let projected = weighted(column, shares);
    let part = |q: &Vec<f64>| dot(&projected, q);
    let coefficients: Vec<f64> = earlier.iter().map(part).collect();
    for (c, q) in coefficients.iter().zip(earlier) {
        axpy(-c, q, column);
    }
    coefficients
}

/// Gram–Schmidt, twice, which is enough; returns what was taken off and the scale to length 1.
fn orthonormalise(column: &mut [f64], earlier: &[Vec<f64>], shares: &[f64]) -> (Vec<f64>, f64) {
    let before = dot(&weighted(column, shares), column).sqrt();
    let mut coefficients = project_out(column, earlier, shares);
    let again = project_out(column, earlier, shares);
    axpy(1.0, &again, &mut coefficients);
    let length = dot(&weighted(column, shares), column).sqrt();
    // below a few hundred roundings there is nothing but rounding left
    let scale = if length > 1e-13 * before { 1.0 / length } else { 0.0 };
    column.iter_mut().for_each(|p| *p *= scale);
    (coefficients, scale)
}

/// Σ w f per basis function, with the rounding of the additions carried along (Neumaier 1974).
pub(super) fn moments<'a>(columns: impl Iterator<Item = (f64, &'a [f64])>, dimension: usize) -> Vec<f64> {
    let (mut sum, mut lost) = (vec![0.0; dimension], vec![0.0; dimension]);
    for (w, column) in columns {
        for ((s, l), f) in sum.iter_mut().zip(&mut lost).zip(column) {
            let term = w * f;
            let total: f64 = *s + term;
            *l += if s.abs() >= term.abs() { (*s - total) + term } else { (term - total) + *s };
            *s = total;
        }
    }
    sum.iter().zip(&lost).map(|(s, l)| s + l).collect()
}
