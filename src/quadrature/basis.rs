use super::rule::Rule;

/// Number of monomials of total degree up to d.
pub(super) fn dimension(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// A box along the principal axes of a rule's points; products of Legendre polynomials on it are a basis that stays
/// well conditioned for slender and tilted shapes.
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

/// P_0 … P_d and their derivatives at x.
fn legendre(degree: usize, x: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut p, mut slope) = (vec![1.0; degree + 1], vec![0.0; degree + 1]);
    for k in 1..=degree {
        let n = k as f64;
        p[k] = if k == 1 { x } else { ((2.0 * n - 1.0) * x * p[k - 1] - (n - 1.0) * p[k - 2]) / n };
        slope[k] = n * p[k - 1] + x * slope[k - 1];
    }
    (p, slope)
}

/// P_a(u) P_b(v) for a + b ≤ d.
pub(super) fn values(degree: usize, [u, v]: [f64; 2]) -> Vec<f64> {
    let ((p, _), (q, _)) = (legendre(degree, u), legendre(degree, v));
    (0..=degree)
        .flat_map(|a| q[..=degree - a].iter().map(move |qb| (a, qb)))
        .map(|(a, qb)| p[a] * qb)
        .collect()
}

/// The derivatives of [`values`] by u and by v.
pub(super) fn gradients(degree: usize, [u, v]: [f64; 2]) -> [Vec<f64>; 2] {
    let ((p, dp), (q, dq)) = (legendre(degree, u), legendre(degree, v));
    let pairs = || (0..=degree).flat_map(|a| (0..=degree - a).map(move |b| (a, b)));
    [pairs().map(|(a, b)| dp[a] * q[b]).collect(), pairs().map(|(a, b)| p[a] * dq[b]).collect()]
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
