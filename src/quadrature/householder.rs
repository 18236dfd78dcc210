/// A dense matrix as its columns.
pub(super) type Columns = Vec<Vec<f64>>;

/// Householder's factorisation of a matrix with at least as many rows as columns, Golub & Van Loan (2013), 5.2.
///
/// Backward stable column by column: each column's rounding is relative to its own length, so badly scaled columns do
/// not harm one another.
pub(super) struct Householder {
    /// Reflection vectors, zero above their index; scaled to ‖v‖² = 2, or all zero.
    reflectors: Columns,
    /// Upper triangle by columns.
    triangle: Columns,
    rows: usize,
}

impl Householder {
    /// Factorises the columns, all of length `rows`.
    pub(super) fn new(mut columns: Columns, rows: usize) -> Self {
        let count = columns.len().min(rows);
        let mut reflectors: Columns = Vec::with_capacity(count);
        for k in 0..count {
            let reflector = reflection(&columns[k], k);
            for column in &mut columns[k..] {
                reflect(&reflector[k..], &mut column[k..]);
            }
            reflectors.push(reflector);
        }
        Self { reflectors, triangle: columns, rows }
    }

    /// An orthonormal basis of the vectors orthogonal to all columns.
    pub(super) fn null_space(&self) -> Columns {
        (self.reflectors.len()..self.rows)
            .map(|i| {
                let mut e = vec![0.0; self.rows];
                e[i] = 1.0;
                for (k, r) in self.reflectors.iter().enumerate().rev() {
                    reflect(&r[k..], &mut e[k..]);
                }
                e
            })
            .collect()
    }

    /// The least-squares solution of matrix · x = rhs; `None` when the columns are dependent.
    pub(super) fn solve(&self, mut rhs: Vec<f64>) -> Option<Vec<f64>> {
        for (k, r) in self.reflectors.iter().enumerate() {
            reflect(&r[k..], &mut rhs[k..]);
        }
        let n = self.triangle.len();
        let mut x = rhs;
        x.truncate(n);
        for k in (0..n).rev() {
            let pivot = self.triangle[k][k];
            if pivot == 0.0 {
                return None;
            }
            x[k] /= pivot;
            let xk = x[k];
            axpy(-xk, &self.triangle[k][..k], &mut x[..k]);
        }
        Some(x)
    }
}

/// The vector v, ‖v‖² = 2, whose reflection 1 − v vᵀ takes column[k..] to a multiple of the first axis.
fn reflection(column: &[f64], k: usize) -> Vec<f64> {
    let mut v = column.to_vec();
    v[..k].fill(0.0);
    let norm = dot(&v, &v).sqrt();
    if norm > 0.0 {
        v[k] += norm.copysign(v[k]);
        let scale = (2.0 / dot(&v[k..], &v[k..])).sqrt();
        v[k..].iter_mut().for_each(|x| *x *= scale);
    }
    v
}

/// x ← x − v (v·x).
fn reflect(v: &[f64], x: &mut [f64]) {
    let factor = -dot(v, x);
    axpy(factor, v, x);
}

/// y ← y + a x.
pub(super) fn axpy(a: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
}

/// x·y over the shorter of both, in four partial sums, which the compiler can put in one vector register.
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let length = x.len().min(y.len());
    let (mut sums, whole) = ([0.0; 4], length / 4 * 4);
    for (a, b) in x.chunks_exact(4).zip(y.chunks_exact(4)) {
        for i in 0..4 {
            sums[i] += a[i] * b[i];
        }
    }
    let rest: f64 = x[whole..length].iter().zip(&y[whole..length]).map(|(a, b)| a * b).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
