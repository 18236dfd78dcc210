//! Elimination of the stage strains in the plane, a lane an element.

use super::algebra::Complex;
use super::condense::COLUMNS;
use crate::rod::lanes::{LEAST_DETERMINANT, LEAST_STIFFNESS, Row, STAGES};
use crate::scalar::Lane;

/// Real and complex numbers of all columns.
pub(super) type Angular<L> = [L; COLUMNS];
pub(super) type Linear<L> = [Complex<L>; COLUMNS];

/// a_kl δω_l + Re-linear row b_kl · δν_l = right-hand side, and c_kl δω_l + K_νν δν_k = right-hand side.
pub(super) struct System<L> {
    pub(super) angular: [[L; STAGES]; STAGES],
    /// (b_z, b_x) as a complex number.
    pub(super) from_linear: [[Complex<L>; STAGES]; STAGES],
    pub(super) to_linear: [[Complex<L>; STAGES]; STAGES],
    pub(super) flexibility: [Flexibility<L>; STAGES],
    pub(super) angular_rhs: [Angular<L>; STAGES],
    pub(super) linear_rhs: [Linear<L>; STAGES],
}

/// A symmetric form: zz, zx, xx.
pub(super) type Flexibility<L> = [L; 3];

#[inline(always)]
fn apply<L: Lane>(f: &Flexibility<L>, u: Complex<L>) -> Complex<L> {
    Complex::new(f[0].mul_add(u.re, f[1] * u.im), f[1].mul_add(u.re, f[2] * u.im))
}

/// a · b of two vectors of the plane.
#[inline(always)]
fn dot<L: Lane>(a: Complex<L>, b: Complex<L>) -> L {
    a.re.mul_add(b.re, a.im * b.im)
}

/// K_νν⁻¹ among the strains (ν_z, ν_x) that are free. Suspect where it is not clearly definite.
#[inline(always)]
pub(super) fn flexibility<L: Lane>(
    k: &[Row; 6],
    at: usize,
    fixed: [bool; 2],
    suspect: &mut L,
) -> Flexibility<L> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let (zz, zx, xx) = (L::load(&k[3][at..]), L::load(&k[4][at..]), L::load(&k[5][at..]));
    match fixed {
        [true, true] => [zero; 3],
        [true, false] => {
            *suspect = zero.select_lt(xx, *suspect, one);
            [zero, zero, one / xx]
        }
        [false, true] => {
            *suspect = zero.select_lt(zz, *suspect, one);
            [one / zz, zero, zero]
        }
        [false, false] => {
            // divided by zz and xx apart, so that 1e150 is still fine
            let (by_z, by_x) = (zx / zz, zx / xx);
            let determinant = one - by_z * by_x;
            let least = L::splat(LEAST_STIFFNESS);
            *suspect = least.select_lt(determinant, *suspect, one);
            *suspect = zero.select_lt(zz, *suspect, one);
            *suspect = zero.select_lt(xx, *suspect, one);
            let (z, x) = (one / (zz * determinant), one / (xx * determinant));
            [z, -(z * by_x), x]
        }
    }
}

impl<L: Lane> System<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        let (zero, none) = (L::splat(0.0), Complex::zero());
        Self {
            angular: [[zero; STAGES]; STAGES],
            from_linear: [[none; STAGES]; STAGES],
            to_linear: [[none; STAGES]; STAGES],
            flexibility: [[zero; 3]; STAGES],
            angular_rhs: [[zero; COLUMNS]; STAGES],
            linear_rhs: [[none; COLUMNS]; STAGES],
        }
    }

    /// Puts (δω, δν) of all stages where the right-hand sides are.
    #[inline(always)]
    pub(super) fn solve(&mut self, stages: usize, soft: bool, suspect: &mut L) {
        if soft {
            for k in 0..stages {
                for l in 0..stages {
                    let factor = apply(&self.flexibility[l], self.from_linear[k][l]);
                    for m in 0..stages {
                        self.angular[k][m] = self.angular[k][m] - dot(factor, self.to_linear[l][m]);
                    }
                    for c in 0..COLUMNS {
                        self.angular_rhs[k][c] = self.angular_rhs[k][c] - dot(factor, self.linear_rhs[l][c]);
                    }
                }
            }
        }
        self.eliminate(stages, suspect);
        if !soft {
            self.linear_rhs = [[Complex::zero(); COLUMNS]; STAGES];
            return;
        }
        for k in 0..stages {
            for c in 0..COLUMNS {
                let mut sum = self.linear_rhs[k][c];
                for l in 0..stages {
                    sum = sum.add_scaled(-self.angular_rhs[l][c], self.to_linear[k][l]);
                }
                self.linear_rhs[k][c] = apply(&self.flexibility[k], sum);
            }
        }
    }

    /// Without pivoting; suspect where a pivot lost its digits.
    #[inline(always)]
    fn eliminate(&mut self, stages: usize, suspect: &mut L) {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let mut pivot = [zero; STAGES];
        for k in 0..stages {
            let mut size = self.angular[k][k].abs();
            for above in 0..k {
                let factor = self.angular[k][above] * pivot[above];
                for m in above + 1..stages {
                    self.angular[k][m] = self.angular[k][m] - factor * self.angular[above][m];
                }
                size = size.select_lt(self.angular[k][k].abs(), self.angular[k][k].abs(), size);
                for c in 0..COLUMNS {
                    self.angular_rhs[k][c] = self.angular_rhs[k][c] - factor * self.angular_rhs[above][c];
                }
            }
            let least = size * L::splat(LEAST_DETERMINANT);
            *suspect = least.select_lt(self.angular[k][k].abs(), *suspect, one);
            pivot[k] = one / self.angular[k][k];
        }
        for back in 0..stages {
            let k = stages - 1 - back;
            for c in 0..COLUMNS {
                let mut sum = self.angular_rhs[k][c];
                for l in k + 1..stages {
                    sum = sum - self.angular[k][l] * self.angular_rhs[l][c];
                }
                self.angular_rhs[k][c] = sum * pivot[k];
            }
        }
    }
}
