//! Eigenvalues of small symmetric matrices by Jacobi's rotations: as exact for the small ones as for the large.

/// The largest matrix there is.
pub(super) const MAX: usize = 18;

/// Sweeps of rotations; six are usual.
const SWEEPS: usize = 30;

/// A symmetric matrix of up to 18 rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Symmetric {
    pub(super) size: usize,
    pub(super) entry: [[f64; MAX]; MAX],
}

/// Eigenvalues in ascending order, and the eigenvector of each as a column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eigen {
    pub(super) size: usize,
    pub(super) value: [f64; MAX],
    pub(super) vector: [[f64; MAX]; MAX],
}

impl Symmetric {
    /// The symmetric part of a matrix given entry by entry.
    pub(super) fn part_of(size: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut matrix = Self { size, entry: [[0.0; MAX]; MAX] };
        for r in 0..size {
            for c in 0..=r {
                let mean = 0.5 * (entry(r, c) + entry(c, r));
                (matrix.entry[r][c], matrix.entry[c][r]) = (mean, mean);
            }
        }
        matrix
    }

    /// Source: Golub and Van Loan (2013), *Matrix Computations*, 8.5.
    pub(super) fn eigen(&self) -> Eigen {
        let (n, mut a) = (self.size, self.entry);
        let mut v = [[0.0; MAX]; MAX];
        for (i, row) in v.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        for _ in 0..SWEEPS {
            let mut rotated = false;
            for p in 0..n {
                for q in p + 1..n {
                    rotated |= rotate(n, &mut a, &mut v, p, q);
                }
            }
            if !rotated {
                break;
            }
        }
        let mut order: [usize; MAX] = std::array::from_fn(|i| i);
        order[..n].sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
        let mut eigen = Eigen { size: n, value: [0.0; MAX], vector: [[0.0; MAX]; MAX] };
        for (k, &from) in order[..n].iter().enumerate() {
            eigen.value[k] = a[from][from];
            for r in 0..n {
                eigen.vector[r][k] = v[r][from];
            }
        }
        eigen
    }
}

/// The rotation that annihilates a_pq; `false` where it is already nothing beside the diagonal.
fn rotate(n: usize, a: &mut [[f64; MAX]; MAX], v: &mut [[f64; MAX]; MAX], p: usize, q: usize) -> bool {
    let off = a[p][q];
    if !(off.abs() > f64::EPSILON * 0.25 * (a[p][p] * a[q][q]).abs().sqrt()) || !(off.abs() > 1e-300) {
        return false;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * off);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    for k in 0..n {
        let (x, y) = (a[k][p], a[k][q]);
        (a[k][p], a[k][q]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..n {
        let (x, y) = (a[p][k], a[q][k]);
        (a[p][k], a[q][k]) = (c * x - s * y, s * x + c * y);
    }
    (a[p][q], a[q][p]) = (0.0, 0.0);
    for row in v.iter_mut().take(n) {
        let (x, y) = (row[p], row[q]);
        (row[p], row[q]) = (c * x - s * y, s * x + c * y);
    }
    true
}

impl Eigen {
    /// How many eigenvalues lie below a bound.
    pub(super) fn below(&self, bound: f64) -> usize {
        self.value[..self.size].iter().filter(|&&value| value < bound).count()
    }

    /// Whether every eigenvalue is a number.
    pub(super) fn is_finite(&self) -> bool {
        self.value[..self.size].iter().all(|value| value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_of_the_second_difference_are_those_of_its_closed_form() {
        // 2 − 2 cos(kπ/(n+1)); a dozen rotations a row of relative rounding each
        let n = 12;
        let matrix = Symmetric::part_of(n, |r, c| match r.abs_diff(c) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        });
        let eigen = matrix.eigen();
        for k in 0..n {
            let exact = 2.0 - 2.0 * (std::f64::consts::PI * (k + 1) as f64 / (n + 1) as f64).cos();
            assert!((eigen.value[k] - exact).abs() < 1e-14, "{k}: {} {exact}", eigen.value[k]);
            for r in 0..n {
                let product: f64 = (0..n).map(|c| matrix.entry[r][c] * eigen.vector[c][k]).sum();
                assert!((product - exact * eigen.vector[r][k]).abs() < 1e-14);
            }
        }
    }
}
