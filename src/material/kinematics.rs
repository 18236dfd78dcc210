use nalgebra::{Matrix3, Vector3};

use super::spectral;
use crate::lie::Strain;
use crate::scalar::{Scalar, arsinh_sqrt_squared, cosh_multiple_m1, exp_m1_minus_x, pow_1p_m1};

/// A point of the rod: section coordinates (x, y) and arc length s, all in m.
///
/// All three are [`Scalar`]s, so that a law may be graded over the section and along the rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<D = f64> {
    /// First section coordinate, m.
    pub x: D,
    /// Second section coordinate, m.
    pub y: D,
    /// Arc length, m.
    pub s: D,
}

impl Point {
    /// The same numbers as constants of another scalar type.
    #[inline(always)]
    pub fn cast<E: Scalar>(&self) -> Point<E> {
        Point { x: E::from(self.x), y: E::from(self.y), s: E::from(self.s) }
    }
}

/// The deformation of a point, F = I + H in the frame of the section; H = γ ⊗ e₃ on a rigid section.
///
/// ```math
/// \gamma = \Delta\nu + \Delta\omega \times (x, y, 0) = (a, b, e), \qquad J - 1 = e \quad\text{(rigid section)}.
/// ```
///
/// On a section that [relaxes](crate::section::Relaxed) the other two columns of H are there as well: a law that shall serve both asks
/// for [`j`](Self::j) rather than e. It carries H, never F: forming F = I + H first would lose the digits of a small strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deformation<D = f64> {
    gamma: Vector3<D>,
    /// The first two columns of H; `None` on a rigid section, where they vanish.
    sides: Option<[Vector3<D>; 2]>,
}

impl<D: Scalar> Deformation<D> {
    /// From the third column γ of F − I.
    #[inline(always)]
    pub fn from_gamma(gamma: Vector3<D>) -> Self {
        Self { gamma, sides: None }
    }

    /// From all of H = F − I.
    #[inline(always)]
    pub fn from_gradient(h: &Matrix3<D>) -> Self {
        let column = |k: usize| Vector3::new(h[(0, k)], h[(1, k)], h[(2, k)]);
        Self { gamma: column(2), sides: Some([column(0), column(1)]) }
    }

    /// Of the point (x, y) of a rigid section with strain Δξ about a straight reference.
    #[inline(always)]
    pub fn of(strain: &Strain<D>, at: &Point<D>) -> Self {
        let (omega, nu) = (strain.angular, strain.linear);
        Self {
            gamma: Vector3::new(
                nu.x - omega.z * at.y,
                nu.y + omega.z * at.x,
                nu.z + omega.x * at.y - omega.y * at.x,
            ),
            sides: None,
        }
    }

    /// γ = (a, b, e): shear along x and y, stretch − 1 along the rod.
    #[inline(always)]
    pub fn gamma(&self) -> Vector3<D> {
        self.gamma
    }

    /// H = F − I: γ ⊗ e₃ on a rigid section.
    pub fn gradient(&self) -> Matrix3<D> {
        let zero = Vector3::from_element(D::zero());
        let [first, second] = self.sides.unwrap_or([zero, zero]);
        Matrix3::from_columns(&[first, second, self.gamma])
    }

    /// J − 1 = det F − 1: e on a rigid section.
    #[inline(always)]
    pub fn j(&self) -> D {
        match self.sides {
            None => self.gamma.z,
            Some(_) => self.invariants().j(),
        }
    }

    /// The invariants of C = FᵀF, as deviations from rest.
    #[inline(always)]
    pub fn invariants(&self) -> Invariants<D> {
        let [a, b, e] = [self.gamma.x, self.gamma.y, self.gamma.z];
        match self.sides {
            None => Invariants::from_shear_and_stretch(a * a + b * b, e),
            Some(_) => Invariants::of_gradient(&self.gradient()),
        }
    }

    /// Σ λᵢ^α − 3 − α ln J of the principal stretches, of second order in the strain and smooth where stretches coalesce.
    ///
    /// A rigid section has the stretches 1 and λ± = √J e^{±θ}, with sinh²θ = (a² + b² + e²)/4J, so that
    ///
    /// ```math
    /// \sum_i \lambda_i^\alpha - 3 - \alpha \ln J
    ///   = 2\Bigl(J^{\alpha/2} - 1 - \tfrac{\alpha}{2}\ln J\Bigr) + 2 J^{\alpha/2} (\cosh \alpha\theta - 1) .
    /// ```
    ///
    /// No root is taken of anything that vanishes at rest: the limit of equal stretches is exact, with its derivatives.
    #[inline(always)]
    pub fn stretch_powers_excess(&self, alpha: f64) -> D {
        if self.sides.is_some() {
            return spectral::stretch_powers_excess(&self.gradient(), alpha);
        }
        let half_power_log = self.gamma.z.ln_1p() * (0.5 * alpha);
        let split = cosh_multiple_m1(self.sinh_squared(), alpha);
        (exp_m1_minus_x(half_power_log) + half_power_log.exp() * split) * 2.0
    }

    /// Σ (ln λᵢ)² of the principal stretches, |ln U|², smooth where stretches coalesce: (ln J)²/2 + 2θ².
    ///
    /// See [`stretch_powers_excess`](Self::stretch_powers_excess).
    #[inline(always)]
    pub fn log_strain_squared(&self) -> D {
        if self.sides.is_some() {
            return spectral::log_strain_squared(&self.gradient());
        }
        let ln_j = self.gamma.z.ln_1p();
        ln_j * ln_j * 0.5 + arsinh_sqrt_squared(self.sinh_squared()) * 2.0
    }

    /// sinh²θ = (λ₊ − λ₋)²/4J.
    fn sinh_squared(&self) -> D {
        self.gamma.dot(&self.gamma) / ((self.gamma.z + 1.0) * 4.0)
    }

    /// |F d|² − |d|² for a direction d (a unit vector for a fibre): twice its Green strain, I₄ − 1.
    ///
    /// ```math
    /// |F d|^2 - |d|^2 = 2\, d\cdot H d + H d\cdot H d = d_z\,(2\, d\cdot\gamma + d_z\, \gamma\cdot\gamma)
    /// ```
    ///
    /// where the second form is that of a rigid section.
    #[inline(always)]
    pub fn stretch_squared_minus_one(&self, direction: &Vector3<D>) -> D {
        if self.sides.is_some() {
            let moved = self.gradient() * direction;
            return direction.dot(&moved) * 2.0 + moved.dot(&moved);
        }
        direction.z * (direction.dot(&self.gamma) * 2.0 + direction.z * self.gamma.dot(&self.gamma))
    }
}

/// The invariants of C = FᵀF as deviations from rest, so that a small strain keeps its digits.
///
/// With s = a² + b² and e = J − 1 of a rigid section (see [`Deformation`]):
///
/// ```math
/// I_1 - 3 = s + e(2 + e), \qquad I_2 - 3 = s + 2e(2 + e), \qquad J - 1 = e .
/// ```
///
/// Both I₁ − 3 and I₂ − 3 start with a term linear in J − 1. A law free of stress at rest subtracts it, and does so without
/// cancellation through [`i1_excess`](Self::i1_excess) and [`i2_excess`](Self::i2_excess).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants<D = f64> {
    i1_excess: D,
    i2_excess: D,
    j: D,
}

impl<D: Scalar> Invariants<D> {
    /// Of a rigid section, from s = a² + b² and e = J − 1.
    #[inline(always)]
    pub fn from_shear_and_stretch(s: D, e: D) -> Self {
        let e_squared = e * e;
        Self { i1_excess: s + e_squared, i2_excess: s + e_squared * 2.0, j: e }
    }

    /// From I₁ − 3 − 2(J − 1), I₂ − 3 − 4(J − 1) and J − 1, each computed without cancellation.
    #[inline(always)]
    pub fn from_excess(i1_excess: D, i2_excess: D, j: D) -> Self {
        Self { i1_excess, i2_excess, j }
    }

    /// Of any deformation, from H = F − I, without cancellation: with K = cof F − I = (tr H) I − Hᵀ + cof H,
    ///
    /// ```math
    /// J - 1 = \operatorname{tr} H + \operatorname{tr} \operatorname{cof} H + \det H, \quad
    /// I_1 - 3 - 2(J-1) = H:H - 2 \operatorname{tr}\operatorname{cof} H - 2 \det H, \quad
    /// I_2 - 3 - 4(J-1) = K:K - 2 \operatorname{tr}\operatorname{cof} H - 4 \det H .
    /// ```
    pub fn of_gradient(h: &Matrix3<D>) -> Self {
        let trace = h[(0, 0)] + h[(1, 1)] + h[(2, 2)];
        let minor = |i: usize, k: usize| {
            let ([a, b], [c, d]) = ([(i + 1) % 3, (i + 2) % 3], [(k + 1) % 3, (k + 2) % 3]);
            h[(a, c)] * h[(b, d)] - h[(a, d)] * h[(b, c)]
        };
        let cofactor = Matrix3::from_fn(minor);
        let second = cofactor[(0, 0)] + cofactor[(1, 1)] + cofactor[(2, 2)];
        let det = (0..3).fold(D::zero(), |sum, k| sum + h[(0, k)] * cofactor[(0, k)]);
        let (mut h_squared, mut k_squared) = (D::zero(), D::zero());
        for i in 0..3 {
            for k in 0..3 {
                let identity = if i == k { trace } else { D::zero() };
                let change = identity - h[(k, i)] + cofactor[(i, k)];
                h_squared += h[(i, k)] * h[(i, k)];
                k_squared += change * change;
            }
        }
        let twice = (second + det) * 2.0;
        Self {
            i1_excess: h_squared - twice,
            i2_excess: k_squared - twice - det * 2.0,
            j: trace + second + det,
        }
    }

    /// I₁ − 3.
    #[inline(always)]
    pub fn i1(&self) -> D {
        self.i1_excess + self.j * 2.0
    }

    /// I₂ − 3.
    #[inline(always)]
    pub fn i2(&self) -> D {
        self.i2_excess + self.j * 4.0
    }

    /// J − 1.
    #[inline(always)]
    pub fn j(&self) -> D {
        self.j
    }

    /// I₁ − 3 − 2(J − 1), of second order in the strain: s + e².
    #[inline(always)]
    pub fn i1_excess(&self) -> D {
        self.i1_excess
    }

    /// I₂ − 3 − 4(J − 1), of second order in the strain: s + 2e².
    #[inline(always)]
    pub fn i2_excess(&self) -> D {
        self.i2_excess
    }

    /// Ī₁ − 3 = J^(−2/3) I₁ − 3, of second order in the strain: with t = J^(1/3), and no difference of large numbers,
    ///
    /// ```math
    /// \bar I_1 - 3 = \frac{(I_1 - 3 - 2(J-1)) + (t-1)^2 (2t+1)}{t^2} .
    /// ```
    #[inline(always)]
    pub fn i1_isochoric(&self) -> D {
        let growth = pow_1p_m1(self.j, 1.0 / 3.0);
        let t = growth + 1.0;
        (self.i1_excess + growth * growth * (t * 2.0 + 1.0)) / (t * t)
    }

    /// Ī₂ − 3 = J^(−4/3) I₂ − 3, of second order in the strain: with t = J^(1/3),
    ///
    /// ```math
    /// \bar I_2 - 3 = \frac{(I_2 - 3 - 4(J-1)) - (t-1)^2 (3t^2+2t+1)}{t^4} .
    /// ```
    #[inline(always)]
    pub fn i2_isochoric(&self) -> D {
        let growth = pow_1p_m1(self.j, 1.0 / 3.0);
        let t = growth + 1.0;
        let t_squared = t * t;
        (self.i2_excess - growth * growth * (t_squared * 3.0 + t * 2.0 + 1.0)) / (t_squared * t_squared)
    }
}
