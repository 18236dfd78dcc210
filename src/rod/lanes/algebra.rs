//! Vectors and 3×3 matrices of lanes, with nothing but what is inlined into a kernel.

use crate::scalar::Lane;

pub(super) type Vector<L> = [L; 3];

/// Rows of columns.
pub(super) type Matrix<L> = [[L; 3]; 3];

/// A twist or a wrench: (angular, linear) or (moment, force).
#[derive(Clone, Copy)]
pub(super) struct Pair<L> {
    pub(super) first: Vector<L>,
    pub(super) second: Vector<L>,
}

/// [[A, 0], [B, A]], as [`TwistMap`](crate::lie::TwistMap).
#[derive(Clone, Copy)]
pub(super) struct Map<L> {
    pub(super) diagonal: Matrix<L>,
    pub(super) lower: Matrix<L>,
}

/// Three linear forms of a twist, (w, v) → X w + Y v.
#[derive(Clone, Copy)]
pub(super) struct Forms<L> {
    pub(super) angular: Matrix<L>,
    pub(super) linear: Matrix<L>,
}

#[inline(always)]
pub(super) fn zeros<L: Lane>() -> Matrix<L> {
    [[L::splat(0.0); 3]; 3]
}

/// a b − c d.
#[inline(always)]
pub(super) fn minor<L: Lane>(a: L, b: L, c: L, d: L) -> L {
    a.mul_add(b, -(c * d))
}

#[inline(always)]
pub(super) fn dot<L: Lane>(a: &Vector<L>, b: &Vector<L>) -> L {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

#[inline(always)]
pub(super) fn cross<L: Lane>(a: &Vector<L>, b: &Vector<L>) -> Vector<L> {
    [minor(a[1], b[2], a[2], b[1]), minor(a[2], b[0], a[0], b[2]), minor(a[0], b[1], a[1], b[0])]
}

#[inline(always)]
pub(super) fn add<L: Lane>(a: &Vector<L>, b: &Vector<L>) -> Vector<L> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a + k b.
#[inline(always)]
pub(super) fn add_scaled<L: Lane>(a: &Vector<L>, k: L, b: &Vector<L>) -> Vector<L> {
    [k.mul_add(b[0], a[0]), k.mul_add(b[1], a[1]), k.mul_add(b[2], a[2])]
}

#[inline(always)]
pub(super) fn scale<L: Lane>(k: L, a: &Vector<L>) -> Vector<L> {
    [k * a[0], k * a[1], k * a[2]]
}

/// Mᵀ v.
#[inline(always)]
pub(super) fn transpose_times<L: Lane>(m: &Matrix<L>, v: &Vector<L>) -> Vector<L> {
    add_scaled(&add_scaled(&scale(v[0], &m[0]), v[1], &m[1]), v[2], &m[2])
}

/// C + A B, column by column of any number.
#[inline(always)]
pub(super) fn add_product<L: Lane, const C: usize>(
    mut c: [[L; C]; 3],
    a: &Matrix<L>,
    b: &[[L; C]; 3],
) -> [[L; C]; 3] {
    for r in 0..3 {
        for j in 0..C {
            c[r][j] = a[r][2].mul_add(b[2][j], a[r][1].mul_add(b[1][j], a[r][0].mul_add(b[0][j], c[r][j])));
        }
    }
    c
}

/// C − A B.
#[inline(always)]
pub(super) fn subtract_product<L: Lane, const C: usize>(
    c: [[L; C]; 3],
    a: &Matrix<L>,
    b: &[[L; C]; 3],
) -> [[L; C]; 3] {
    let mut minus = *a;
    for r in 0..3 {
        for j in 0..3 {
            minus[r][j] = -a[r][j];
        }
    }
    add_product(c, &minus, b)
}

#[inline(always)]
pub(super) fn product<L: Lane, const C: usize>(a: &Matrix<L>, b: &[[L; C]; 3]) -> [[L; C]; 3] {
    let mut c = [[L::splat(0.0); C]; 3];
    for r in 0..3 {
        for j in 0..C {
            c[r][j] = a[r][2].mul_add(b[2][j], a[r][1].mul_add(b[1][j], a[r][0] * b[0][j]));
        }
    }
    c
}

/// Mᵀ B, column by column of any number.
#[inline(always)]
pub(super) fn transpose_product<L: Lane, const C: usize>(a: &Matrix<L>, b: &[[L; C]; 3]) -> [[L; C]; 3] {
    let mut c = [[L::splat(0.0); C]; 3];
    for r in 0..3 {
        for j in 0..C {
            c[r][j] = a[2][r].mul_add(b[2][j], a[1][r].mul_add(b[1][j], a[0][r] * b[0][j]));
        }
    }
    c
}

/// M Bᵀ.
#[inline(always)]
pub(super) fn product_transpose<L: Lane>(a: &Matrix<L>, b: &Matrix<L>) -> Matrix<L> {
    let mut c = zeros();
    for r in 0..3 {
        for j in 0..3 {
            c[r][j] = dot(&a[r], &b[j]);
        }
    }
    c
}

/// M + k v^.
#[inline(always)]
pub(super) fn add_hat<L: Lane>(m: &Matrix<L>, k: L, v: &Vector<L>) -> Matrix<L> {
    let [x, y, z] = scale(k, v);
    let mut sum = *m;
    sum[0][1] = sum[0][1] - z;
    sum[0][2] = sum[0][2] + y;
    sum[1][0] = sum[1][0] + z;
    sum[1][2] = sum[1][2] - x;
    sum[2][0] = sum[2][0] - y;
    sum[2][1] = sum[2][1] + x;
    sum
}

/// M + k N, column by column of any number.
#[inline(always)]
pub(super) fn add_multiple<L: Lane, const C: usize>(
    mut m: [[L; C]; 3],
    k: L,
    n: &[[L; C]; 3],
) -> [[L; C]; 3] {
    for r in 0..3 {
        for j in 0..C {
            m[r][j] = k.mul_add(n[r][j], m[r][j]);
        }
    }
    m
}

/// v × every column.
#[inline(always)]
pub(super) fn cross_columns<L: Lane, const C: usize>(v: &Vector<L>, m: &[[L; C]; 3]) -> [[L; C]; 3] {
    let mut c = *m;
    for j in 0..C {
        let column = cross(v, &[m[0][j], m[1][j], m[2][j]]);
        for r in 0..3 {
            c[r][j] = column[r];
        }
    }
    c
}

/// a I + b ω^ + c ω ωᵀ: diagonal, and symmetric and skew part of what is off it.
#[inline(always)]
pub(super) fn from_parts<L: Lane>(d: &Vector<L>, o: &Vector<L>, s: &Vector<L>) -> Matrix<L> {
    [[d[0], o[2] - s[2], o[1] + s[1]], [o[2] + s[2], d[1], o[0] - s[0]], [o[1] - s[1], o[0] + s[0], d[2]]]
}

impl<L: Lane> Pair<L> {
    /// The Lie bracket of two twists.
    #[inline(always)]
    pub(super) fn bracket(&self, other: &Self) -> Self {
        let (a, b) = (cross(&self.second, &other.first), cross(&self.first, &other.second));
        Self { first: cross(&self.first, &other.first), second: add(&a, &b) }
    }

    /// self + k other.
    #[inline(always)]
    pub(super) fn add_scaled(&self, k: f64, other: &Self) -> Self {
        let k = L::splat(k);
        Self {
            first: add_scaled(&self.first, k, &other.first),
            second: add_scaled(&self.second, k, &other.second),
        }
    }
}

impl<L: Lane> Map<L> {
    /// self other.
    #[inline(always)]
    pub(super) fn times(&self, other: &Self) -> Self {
        let lower = product(&self.lower, &other.diagonal);
        Self {
            diagonal: product(&self.diagonal, &other.diagonal),
            lower: add_product(lower, &self.diagonal, &other.lower),
        }
    }

    /// Adds k other.
    #[inline(always)]
    pub(super) fn add(&mut self, k: L, other: &Self) {
        for r in 0..3 {
            self.diagonal[r] = add_scaled(&self.diagonal[r], k, &other.diagonal[r]);
            self.lower[r] = add_scaled(&self.lower[r], k, &other.lower[r]);
        }
    }

    /// Adds k I.
    #[inline(always)]
    pub(super) fn add_identity(&mut self, k: f64) {
        for r in 0..3 {
            self.diagonal[r][r] = self.diagonal[r][r] + L::splat(k);
        }
    }

    /// Adds k ad_a.
    #[inline(always)]
    pub(super) fn add_ad(&mut self, k: f64, a: &Pair<L>) {
        let k = L::splat(k);
        self.diagonal = add_hat(&self.diagonal, k, &a.first);
        self.lower = add_hat(&self.lower, k, &a.second);
    }

    /// ad_a ad_b.
    #[inline(always)]
    pub(super) fn ad_ad(a: &Pair<L>, b: &Pair<L>) -> Self {
        let zero = zeros();
        let lower = add_hat_hat(&add_hat_hat(&zero, &a.second, &b.first), &a.first, &b.second);
        Self { diagonal: add_hat_hat(&zero, &a.first, &b.first), lower }
    }

    /// self ad_b.
    #[inline(always)]
    pub(super) fn times_ad(&self, b: &Pair<L>) -> Self {
        let mut lower = times_hat(&self.lower, &b.first);
        let other = times_hat(&self.diagonal, &b.second);
        for r in 0..3 {
            lower[r] = add(&lower[r], &other[r]);
        }
        Self { diagonal: times_hat(&self.diagonal, &b.first), lower }
    }
}

impl<L: Lane> Forms<L> {
    /// L(Λ) w = m × w + n × v, the moment that a displacement makes of a wrench.
    #[inline(always)]
    pub(super) fn of_wrench(wrench: &Pair<L>) -> Self {
        let one = L::splat(1.0);
        Self {
            angular: add_hat(&zeros(), one, &wrench.first),
            linear: add_hat(&zeros(), one, &wrench.second),
        }
    }

    /// Forms of M η: (X A + Y B, Y A).
    #[inline(always)]
    pub(super) fn times(&self, map: &Map<L>) -> Self {
        let angular = product(&self.angular, &map.diagonal);
        Self {
            angular: add_product(angular, &self.linear, &map.lower),
            linear: product(&self.linear, &map.diagonal),
        }
    }

    /// Forms of ad_a η.
    #[inline(always)]
    pub(super) fn times_ad(&self, a: &Pair<L>) -> Self {
        Self { angular: self.angular_times_ad(a), linear: times_hat(&self.linear, &a.first) }
    }

    /// X a^ + Y b^: forms of ad_a η for an η that is a rotation alone.
    #[inline(always)]
    pub(super) fn angular_times_ad(&self, a: &Pair<L>) -> Matrix<L> {
        let (mut sum, other) = (times_hat(&self.angular, &a.first), times_hat(&self.linear, &a.second));
        for r in 0..3 {
            sum[r] = add(&sum[r], &other[r]);
        }
        sum
    }

    /// k self + l other.
    #[inline(always)]
    pub(super) fn combined(&self, k: f64, l: f64, other: &Self) -> Self {
        let (k, l) = (L::splat(k), L::splat(l));
        let mut sum = *self;
        for r in 0..3 {
            sum.angular[r] = add_scaled(&scale(k, &self.angular[r]), l, &other.angular[r]);
            sum.linear[r] = add_scaled(&scale(k, &self.linear[r]), l, &other.linear[r]);
        }
        sum
    }
}

/// M + u^ v^ = M + v uᵀ − (u·v) I.
#[inline(always)]
fn add_hat_hat<L: Lane>(m: &Matrix<L>, u: &Vector<L>, v: &Vector<L>) -> Matrix<L> {
    let mut sum = *m;
    let dot = dot(u, v);
    for r in 0..3 {
        sum[r] = add_scaled(&m[r], v[r], u);
        sum[r][r] = sum[r][r] - dot;
    }
    sum
}

/// M v^: row by row, (row) × v.
#[inline(always)]
fn times_hat<L: Lane>(m: &Matrix<L>, v: &Vector<L>) -> Matrix<L> {
    [cross(&m[0], v), cross(&m[1], v), cross(&m[2], v)]
}
