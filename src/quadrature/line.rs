use std::f64::consts::PI;

use crate::error::{Error, Result};

use super::rule::invalid;

/// The largest number of nodes of a [`LineRule`].
pub const MAX_NODES: usize = 1000;

/// Newton steps allowed per node; the asymptotic starts need at most five.
const MAX_NEWTON: usize = 20;

/// A quadrature rule on an interval: increasing nodes and positive weights.
///
/// ```
/// let rule = hyperrod::quadrature::gauss_legendre(3)?.on(0.0, 2.0)?;
/// let integral: f64 = rule.iter().map(|(x, w)| w * x.powi(5)).sum();
/// assert!((integral - 64.0 / 6.0).abs() < 1e-14);
/// # Ok::<(), hyperrod::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LineRule {
    nodes: Vec<f64>,
    weights: Vec<f64>,
    degree: usize,
}

impl LineRule {
    /// Nodes in increasing order.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Weights, all positive.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The degree of the polynomials the rule integrates exactly.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of nodes, at least one.
    #[allow(clippy::len_without_is_empty)] // a rule is never empty
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The nodes and weights (x, w) in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        self.nodes.iter().copied().zip(self.weights.iter().copied())
    }

    /// This rule, taken as one on [−1, 1], carried to [a, b].
    ///
    /// # Errors
    /// [`Error::Invalid`] when b − a is not positive and finite.
    pub fn on(&self, a: f64, b: f64) -> Result<Self> {
        let half = 0.5 * (b - a);
        if !(half > 0.0 && half.is_finite()) {
            return Err(invalid("length of a quadrature interval", b - a, "positive and finite"));
        }
        // Measured from the nearer end, so that nodes keep their distance to it to the last digit.
        let place = |x: f64| if x < 0.0 { a + half * (1.0 + x) } else { b - half * (1.0 - x) };
        Ok(Self {
            nodes: self.nodes.iter().map(|&x| place(x)).collect(),
            weights: self.weights.iter().map(|w| half * w).collect(),
            degree: self.degree,
        })
    }
}

/// The Gauss–Legendre rule of `n` nodes on [−1, 1], exact to degree 2n − 1.
///
/// ```math
/// P_n(x_i) = 0, \qquad w_i = \frac{2}{(1 - x_i^2) \, P_n'(x_i)^2}
/// ```
///
/// Newton's method on the three-term recurrence from Tricomi's asymptotic roots; nodes good to an ulp of 1 and weights
/// to some 10⁻¹⁵ of themselves. Abramowitz & Stegun (1964), 25.4.29 and 22.16.6.
///
/// ```
/// let rule = hyperrod::quadrature::gauss_legendre(2)?;
/// assert_eq!(rule.degree(), 3);
/// assert!((rule.nodes()[1] - 1.0 / 3f64.sqrt()).abs() < 2e-16);
/// # Ok::<(), hyperrod::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] when `n` is 0 or above [`MAX_NODES`].
pub fn gauss_legendre(n: usize) -> Result<LineRule> {
    check_nodes(n)?;
    let (mut nodes, mut weights) = (vec![0.0; n], vec![0.0; n]);
    let nf = n as f64;
    let tricomi = 1.0 - (nf - 1.0) / (8.0 * nf.powi(3));
    for k in 0..n.div_ceil(2) {
        let middle = 2 * k + 1 == n;
        let theta = PI * (k as f64 + 0.75) / (nf + 0.5);
        let start = if middle { 0.0 } else { tricomi * theta.cos() };
        let slope = |x: f64, before: f64, p: f64| nf * (before - x * p) / one_minus_square(x);
        let root = newton("Gauss–Legendre node", start, |x| {
            let (before, p) = legendre(n, x);
            (p, slope(x, before, p))
        })?;
        let x = if middle { 0.0 } else { root };
        // The weight belongs to the root x − δ, not to the rounded node x: d ln w/dx = 2x/(1 − x²) there would
        // otherwise magnify the rounding of x near the ends. With P_n(x) = δ P′ and the differential equation,
        // (1 − x²) P′² at the root is the value at x times 1 − 2xδ/(1 − x²).
        let (before, p) = legendre(n, x);
        let d = slope(x, before, p);
        let delta = if middle { 0.0 } else { p / d };
        let s = one_minus_square(x);
        let w = 2.0 / (s * d * d) * (1.0 + 2.0 * x * delta / s);
        (nodes[k], nodes[n - 1 - k]) = (-x, x);
        (weights[k], weights[n - 1 - k]) = (w, w);
    }
    Ok(LineRule { nodes, weights, degree: 2 * n - 1 })
}

/// The left Gauss–Radau rule of `n` nodes on [−1, 1], the first at −1, exact to degree 2n − 2.
///
/// The other nodes are the roots of P_{n−1} + P_n, which are those of the Jacobi polynomial P_{n−1}^{(0,1)}, with
/// w_i = (1 − x_i)/(n P_{n−1}(x_i))² and w_0 = 2/n²: Abramowitz & Stegun (1964), 25.4.31. Hence w_i (1 + x_i) are the
/// weights of the Gauss rule for the weight function 1 + x: see [`gauss_jacobi`].
pub(super) fn gauss_radau(n: usize) -> Result<LineRule> {
    check_nodes(n)?;
    let nf = n as f64;
    let (mut nodes, mut weights) = (vec![-1.0; n], vec![2.0 / (nf * nf); n]);
    // With D = P_{n−1} + P_n: (1 − x²) P_n′ = n (P_{n−1} − x P_n) and (1 − x²) P_{n−1}′ = n (x P_{n−1} − P_n).
    let evaluate = |x: f64| {
        let (before, p) = legendre(n, x);
        (before + p, nf * (before - p) / (1.0 - x), before)
    };
    for k in 1..n {
        let start = (PI * (k as f64 - 0.25) / nf).cos();
        let x = newton("Gauss–Radau node", start, |x| {
            let (value, slope, _) = evaluate(x);
            (value, slope)
        })?;
        let (value, slope, before) = evaluate(x);
        let delta = value / slope;
        // (1 − x)/P_{n−1}² at the root x − δ, where P_{n−1}′ = n P_{n−1}/(1 − x): the value at x times 1 + δ(2n + 1)/(1 − x).
        let w = (1.0 - x) / (nf * before).powi(2) * (1.0 + delta * (2.0 * nf + 1.0) / (1.0 - x));
        (nodes[n - k], weights[n - k]) = (x, w);
    }
    Ok(LineRule { nodes, weights, degree: 2 * n - 2 })
}

/// The `n`-node Gauss rule on [0, 1] for the weight function t: ∫ t f(t) dt, exact to degree 2n − 1 in f.
pub(super) fn gauss_jacobi(n: usize) -> Result<LineRule> {
    let radau = gauss_radau(n + 1)?;
    let t: Vec<f64> = radau.nodes[1..].iter().map(|x| 0.5 * (1.0 + x)).collect();
    let weights = radau.weights[1..].iter().zip(&t).map(|(w, t)| 0.5 * w * t).collect();
    Ok(LineRule { nodes: t, weights, degree: 2 * n - 1 })
}

fn check_nodes(n: usize) -> Result<()> {
    if n == 0 || n > MAX_NODES {
        return Err(invalid("number of quadrature nodes", n as f64, "from 1 to 1000"));
    }
    Ok(())
}

/// (P_{n−1}, P_n) at x, for n ≥ 1.
///
/// The recurrence is run on the differences d_k = P_k − P_{k−1} (Reinsch's device for the ends of the interval), which
/// takes the exact x − 1 and adds small numbers to P_k near x = 1; negative x by parity.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let z = x.abs();
    let (mut p, mut d) = (1.0, 0.0);
    for k in 0..n {
        let k = k as f64;
        d = ((2.0 * k + 1.0) * (z - 1.0) * p + k * d) / (k + 1.0);
        p += d;
    }
    let (before, p) = (p - d, p);
    match (x < 0.0, n % 2) {
        (false, _) => (before, p),
        (true, 0) => (-before, p),
        (true, _) => (before, -p),
    }
}

/// 1 − x² without cancellation near |x| = 1.
fn one_minus_square(x: f64) -> f64 {
    (1.0 - x) * (1.0 + x)
}

/// Newton's method from a start in the basin; the step after one below 10⁻¹⁰ is below rounding.
fn newton(what: &'static str, start: f64, f: impl Fn(f64) -> (f64, f64)) -> Result<f64> {
    let mut x = start;
    let mut residual = f64::INFINITY;
    for _ in 0..MAX_NEWTON {
        let (value, slope) = f(x);
        let step = value / slope;
        x -= step;
        residual = step.abs();
        if residual < 1e-10 {
            return Ok(x);
        }
    }
    Err(Error::NoConvergence { what, iterations: MAX_NEWTON, residual })
}
