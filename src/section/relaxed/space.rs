//! The scalar functions that displacements are made of, orthonormalised on the section at hand.

use nalgebra::{DMatrix, DVector, SMatrix};
use num_dual::{Derivative, Dual2SVec64};

use crate::error::{Error, Result};
use crate::material::Points;
use crate::scalar::Scalar;

/// What the functions are before they are orthonormalised, about the centroid and in units of the radius of the section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Raw {
    /// Whether they are rᵏ × Fourier, for a round hollow section.
    pub(super) ring: bool,
    centre: [f64; 2],
    /// Half the extent along x and along y; for a ring the radii.
    extent: [f64; 2],
}

/// Scalar functions 1, two of first degree, and higher ones, ordered by degree.
///
/// The first three are orthonormal in L², the others orthogonal to them in L² (so that a displacement made of them holds no rigid
/// motion) and orthonormal in their gradients.
#[derive(Clone, Debug)]
pub(super) struct Space {
    raw: Raw,
    /// Upper triangular: functions = raw functions × coefficients.
    coefficients: DMatrix<f64>,
    /// ∂/∂x, ∂/∂y and value at all points, block by block: 3Q × N.
    pub(super) table: DMatrix<f64>,
    /// Its transpose.
    pub(super) transposed: DMatrix<f64>,
    /// How it changes along s as the points move, the coefficients fixed.
    pub(super) rate: Option<DMatrix<f64>>,
    /// The same of the values squared of the first three functions: ∫φ² dA.
    pub(super) mass: f64,
}

/// The smallest part of a function, relative to the whole, that may be left when what the lower ones span is taken off it.
const INDEPENDENT: f64 = 1e-9;

/// How many functions there are up to a degree; three at least, which the rigid motions are made of.
pub(super) fn count(ring: bool, degree: usize) -> usize {
    match (degree, ring) {
        (0, _) => 3,
        (d, true) => (d + 1) * (2 * d + 1),
        (d, false) => (d + 1) * (d + 2) / 2,
    }
}

impl Raw {
    pub(super) fn new(points: &Points, ring: bool) -> Self {
        let area: f64 = points.weight.iter().sum();
        let mean = |values: &[f64]| values.iter().zip(&points.weight).map(|(v, w)| v * w).sum::<f64>() / area;
        let centre = [mean(&points.x), mean(&points.y)];
        let mut extent = if ring { [f64::INFINITY, 0.0] } else { [0.0; 2] };
        for (x, y) in points.x.iter().zip(&points.y) {
            let (x, y) = (x - centre[0], y - centre[1]);
            if ring {
                extent = [extent[0].min(x.hypot(y)), extent[1].max(x.hypot(y))];
            } else {
                extent = [extent[0].max(x.abs()), extent[1].max(y.abs())];
            }
        }
        Self { ring, centre, extent }
    }

    /// How many functions there are up to a degree.
    pub(super) fn count(&self, degree: usize) -> usize {
        count(self.ring, degree)
    }

    /// The functions up to a degree, the constant and the two linear ones first.
    fn evaluate<D: Scalar>(&self, x: D, y: D, degree: usize) -> Vec<D> {
        let (x, y) = (x - self.centre[0], y - self.centre[1]);
        let degree = degree.max(1);
        if self.ring { self.fourier(x, y, degree) } else { self.legendre(x, y, degree) }
    }

    fn legendre<D: Scalar>(&self, x: D, y: D, degree: usize) -> Vec<D> {
        let [px, py] = [x / self.extent[0], y / self.extent[1]].map(|t| legendre(t, degree));
        let mut out = Vec::with_capacity(self.count(degree));
        for d in 0..=degree {
            for k in 0..=d {
                out.push(px[d - k] * py[k]);
            }
        }
        out
    }

    fn fourier<D: Scalar>(&self, x: D, y: D, degree: usize) -> Vec<D> {
        let [inner, outer] = self.extent;
        let r = (x * x + y * y).sqrt();
        let radial = legendre((r * 2.0 - (inner + outer)) / (outer - inner).max(1e-3 * outer), degree);
        let (cos, sin) = (x / r, y / r);
        let mut angular = vec![(D::one(), D::zero())];
        for m in 0..degree {
            let (c, s) = angular[m];
            angular.push((c * cos - s * sin, s * cos + c * sin));
        }
        // x and y stand for the pair k = 1, m = 1 that they span together with k = 0
        let mut out = vec![D::one(), x / outer, y / outer];
        for d in 1..=degree {
            for k in 0..=d {
                for m in 0..=d {
                    if k.max(m) < d || (k, m) == (1, 1) {
                        continue;
                    }
                    out.push(radial[k] * angular[m].0);
                    if m > 0 {
                        out.push(radial[k] * angular[m].1);
                    }
                }
            }
        }
        out
    }
}

/// P₀ … P_n at t.
fn legendre<D: Scalar>(t: D, n: usize) -> Vec<D> {
    let mut p = vec![D::one(), t];
    for k in 1..n {
        let a = (2 * k + 1) as f64 / (k + 1) as f64;
        let b = k as f64 / (k + 1) as f64;
        p.push(t * p[k] * a - p[k - 1] * b);
    }
    p
}

/// Value, two first and three second derivatives of every raw function at every point: 6 matrices Q × N.
fn tabulate(raw: &Raw, points: &Points, degree: usize) -> [DMatrix<f64>; 6] {
    let (q_count, n) = (points.len(), raw.count(degree.max(1)));
    let mut out: [DMatrix<f64>; 6] = std::array::from_fn(|_| DMatrix::zeros(q_count, n));
    let variable = |value: f64, k: usize| {
        let mut unit = SMatrix::<f64, 1, 2>::zeros();
        unit[k] = 1.0;
        Dual2SVec64::<2>::new(value, Derivative::some(unit), Derivative::none())
    };
    let (one, two) = (nalgebra::Const::<1>, nalgebra::Const::<2>);
    for q in 0..q_count {
        let values = raw.evaluate(variable(points.x[q], 0), variable(points.y[q], 1), degree);
        for (l, value) in values.into_iter().enumerate() {
            let first = value.v1.unwrap_generic(one, two);
            let second = value.v2.unwrap_generic(two, two);
            let six = [value.re, first[0], first[1], second[(0, 0)], second[(0, 1)], second[(1, 1)]];
            for (matrix, v) in out.iter_mut().zip(six) {
                matrix[(q, l)] = v;
            }
        }
    }
    out
}

impl Space {
    /// On the points of a section, with their motion along s where they move.
    ///
    /// # Errors
    /// If the points cannot tell the functions apart.
    pub(super) fn new(raw: Raw, points: &Points, degree: usize) -> Result<Self> {
        let tables = tabulate(&raw, points, degree);
        let area: f64 = points.weight.iter().sum();
        let coefficients = orthonormalise(&tables, &points.weight, area)?;
        let q_count = points.len();
        let n = coefficients.ncols();
        let mut table = DMatrix::zeros(3 * q_count, n);
        for (block, k) in [1, 2, 0].into_iter().enumerate() {
            table.rows_mut(block * q_count, q_count).copy_from(&(&tables[k] * &coefficients));
        }
        let mass = (0..q_count).map(|q| points.weight[q] * table[(2 * q_count + q, 0)].powi(2)).sum();
        let rate = points.rates.as_ref().map(|_| moving(&tables, points, area) * &coefficients);
        Ok(Self { raw, transposed: table.transpose(), coefficients, table, rate, mass })
    }

    /// How many functions there are up to a degree.
    pub(super) fn count(&self, degree: usize) -> usize {
        self.raw.count(degree)
    }

    /// ∂/∂x, ∂/∂y and value of every function at any point.
    pub(super) fn at(&self, x: f64, y: f64, degree: usize) -> DMatrix<f64> {
        let points = Points { x: vec![x], y: vec![y], weight: vec![1.0], rates: None };
        let tables = tabulate(&self.raw, &points, degree);
        let mut out = DMatrix::zeros(3, self.coefficients.ncols());
        for (block, k) in [1, 2, 0].into_iter().enumerate() {
            out.row_mut(block).copy_from(&(&tables[k] * &self.coefficients));
        }
        out
    }
}

/// d/ds of (∂/∂x, ∂/∂y, value) of the raw functions, which move with the centroid, at points that move: 3Q × N.
fn moving(tables: &[DMatrix<f64>; 6], points: &Points, area: f64) -> DMatrix<f64> {
    let (q_count, n) = tables[0].shape();
    let mut out = DMatrix::zeros(3 * q_count, n);
    let Some(rates) = &points.rates else { return out };
    let d_area: f64 = rates.weight.iter().sum();
    let drift = |x: &[f64], dx: &[f64]| {
        let mut sums = [0.0; 2];
        for q in 0..q_count {
            sums[0] += points.weight[q] * x[q];
            sums[1] += rates.weight[q] * x[q] + points.weight[q] * dx[q];
        }
        (sums[1] - sums[0] / area * d_area) / area
    };
    let [cx, cy] = [drift(&points.x, &rates.x), drift(&points.y, &rates.y)];
    for q in 0..q_count {
        let (dx, dy) = (rates.x[q] - cx, rates.y[q] - cy);
        for l in 0..n {
            let [_, x, y, xx, xy, yy] = [0, 1, 2, 3, 4, 5].map(|k| tables[k][(q, l)]);
            out[(q, l)] = xx * dx + xy * dy;
            out[(q_count + q, l)] = xy * dx + yy * dy;
            out[(2 * q_count + q, l)] = x * dx + y * dy;
        }
    }
    out
}

/// Functions weighted by the roots of the weights: value, ∂/∂x and ∂/∂y, a column each.
type Weighted = [DMatrix<f64>; 3];

/// Coefficients of the orthonormal functions, by Gram and Schmidt, twice over.
fn orthonormalise(tables: &[DMatrix<f64>; 6], weight: &[f64], area: f64) -> Result<DMatrix<f64>> {
    let (q_count, n) = tables[0].shape();
    let root = DVector::from_iterator(q_count, weight.iter().map(|w| w.sqrt()));
    let weighted: Weighted = [0, 1, 2].map(|k| {
        let mut m = tables[k].clone();
        for mut column in m.column_iter_mut() {
            column.component_mul_assign(&root);
        }
        m
    });
    let mut c = DMatrix::<f64>::zeros(n, n);
    let mut done: Weighted = std::array::from_fn(|_| DMatrix::zeros(q_count, n));
    // the radius of gyration makes lengths of values and numbers of gradients
    let gyration = gyration(&weighted);
    for l in 0..n {
        let mut f: [DVector<f64>; 3] = [0, 1, 2].map(|k| weighted[k].column(l).into_owned());
        let mut a = DVector::<f64>::zeros(n);
        a[l] = 1.0;
        let whole = norms(&f);
        for _ in 0..2 {
            take_off(&done, &c, l, &mut f, &mut a);
        }
        let [value, gradient] = norms(&f);
        let (left, all) = if l < 3 { (value, whole[0]) } else { (gradient, whole[1]) };
        if !(left > INDEPENDENT * all) {
            let requirement =
                "more: the quadrature has too few points for the degrees asked for, or the section no extent";
            let quantity = "independent functions for the displacement of a section";
            return Err(Error::Invalid { quantity, value: l as f64, requirement });
        }
        let scale = if l < 3 { gyration * area.sqrt() / value } else { area.sqrt() / gradient };
        c.set_column(l, &(a * scale));
        for k in 0..3 {
            done[k].set_column(l, &(&f[k] * scale));
        }
    }
    Ok(c)
}

/// Takes off function l what the ones before span: the first three in L², the others in the gradients.
fn take_off(done: &Weighted, c: &DMatrix<f64>, l: usize, f: &mut [DVector<f64>; 3], a: &mut DVector<f64>) {
    for m in 0..l {
        let kinds: &[usize] = if m < 3 { &[0] } else { &[1, 2] };
        let (mut product, mut norm) = (0.0, 0.0);
        for &k in kinds {
            product += done[k].column(m).dot(&f[k]);
            norm += done[k].column(m).norm_squared();
        }
        let factor = product / norm;
        for k in 0..3 {
            f[k].axpy(-factor, &done[k].column(m), 1.0);
        }
        a.axpy(-factor, &c.column(m), 1.0);
    }
}

/// √∫f² and √∫|∇f|².
fn norms(f: &[DVector<f64>; 3]) -> [f64; 2] {
    [f[0].norm(), (f[1].norm_squared() + f[2].norm_squared()).sqrt()]
}

/// A length of the section: that which gives the two linear functions gradients of about 1.
fn gyration(weighted: &[DMatrix<f64>; 3]) -> f64 {
    let constant = weighted[0].column(0);
    let length = |l: usize| {
        let function = weighted[0].column(l);
        let spread = function - constant * (function.dot(&constant) / constant.norm_squared());
        let slope = (weighted[1].column(l).norm_squared() + weighted[2].column(l).norm_squared()).sqrt();
        spread.norm() / slope
    };
    (length(1) * length(2)).sqrt()
}
