use super::{GradientResponse, GradientSite, STIFFNESS, packed};
use crate::material::differentiate::Level;
use crate::material::kinematics::Invariants;
use crate::material::law::Isotropic;
use crate::material::response::Request;
use crate::scalar::{Jet, Lane};

/// X × Y by rows.
#[inline(always)]
pub(super) fn cross<L: Lane>(x: &[L; 9], y: &[L; 9]) -> [L; 9] {
    let mut out = [L::splat(0.0); 9];
    for i in 0..3 {
        let (j, k) = (3 * ((i + 1) % 3), 3 * ((i + 2) % 3));
        for a in 0..3 {
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            let plus = x[j + b].mul_add(y[k + c], x[k + c] * y[j + b]);
            out[3 * i + a] = plus - x[j + c].mul_add(y[k + b], x[k + b] * y[j + c]);
        }
    }
    out
}

/// Adds factor × (the matrix of Y ↦ X × Y) to a symmetric 9×9 matrix.
#[inline(always)]
fn add_cross<L: Lane>(x: &[L; 9], factor: L, out: &mut [L; STIFFNESS]) {
    for i in 0..3 {
        for a in 0..3 {
            for (k, b, sign) in [(1, 1, 1.0), (2, 2, 1.0), (1, 2, -1.0), (2, 1, -1.0)] {
                // entry ((i, a), (i+k, a+b)) is ±X at the third row and column
                let (row, column) = (3 * i + a, 3 * ((i + k) % 3) + (a + b) % 3);
                if row < column {
                    let third = 3 * ((i + 3 - k) % 3) + (a + 3 - b) % 3;
                    let at = packed(row, column);
                    out[at] = out[at] + x[third] * factor * L::splat(sign);
                }
            }
        }
    }
}

/// H, K = cof F − I and the invariants' deviations.
struct Kinematics<L> {
    h: [L; 9],
    change: [L; 9],
    invariants: [L; 3],
}

impl<L: Lane> Kinematics<L> {
    /// See [`Invariants::of_gradient`].
    #[inline(always)]
    fn of(h: &[L; 9]) -> Self {
        let (two, half) = (L::splat(2.0), L::splat(0.5));
        let mut cofactor = cross(h, h);
        for c in 0..9 {
            cofactor[c] = cofactor[c] * half;
        }
        let trace = h[0] + h[4] + h[8];
        let second = cofactor[0] + cofactor[4] + cofactor[8];
        let det = h[0] * cofactor[0] + h[1] * cofactor[1] + h[2] * cofactor[2];
        let mut change = cofactor;
        let (mut h_squared, mut k_squared) = (L::splat(0.0), L::splat(0.0));
        for i in 0..3 {
            change[4 * i] = change[4 * i] + trace;
            for a in 0..3 {
                change[3 * i + a] = change[3 * i + a] - h[3 * a + i];
            }
        }
        for c in 0..9 {
            h_squared = h[c].mul_add(h[c], h_squared);
            k_squared = change[c].mul_add(change[c], k_squared);
        }
        let twice = (second + det) * two;
        let invariants = [h_squared - twice, k_squared - twice - det * two, trace + second + det];
        Self { h: *h, change, invariants }
    }

    /// Derivatives of the three invariants in H, each of the order of H but for that of J.
    #[inline(always)]
    fn slopes(&self) -> [[L; 9]; 3] {
        let two = L::splat(2.0);
        let (h, k) = (&self.h, &self.change);
        let mut identity = [L::splat(0.0); 9];
        for i in 0..3 {
            identity[4 * i] = L::splat(1.0);
        }
        // cof F = I + K;  ½ d(I₁ excess) = H − K;  ½ d(I₂ excess) = F × cof F − 2 cof F = I × (K − H) + H × (K − H)
        let mut difference = *k;
        let mut f = *h;
        for c in 0..9 {
            difference[c] = k[c] - h[c];
            f[c] = h[c] + identity[c];
        }
        let (mut first, mut second, mut third) = (*k, cross(&f, &difference), *k);
        for c in 0..9 {
            first[c] = -(difference[c] * two);
            second[c] = second[c] * two;
            third[c] = k[c] + identity[c];
        }
        [first, second, third]
    }
}

/// Three variables, and the arc length as a fourth where Ψ′ is wanted; then the chain to H.
#[inline(always)]
pub(in crate::material) fn isotropic_gradient_response<M: Isotropic + ?Sized, L: Lane, O: Level>(
    law: &M,
    site: &GradientSite<L>,
) -> GradientResponse<L> {
    let kinematics = Kinematics::of(&site.h);
    let [a, b, j] = kinematics.invariants;
    if O::REQUEST < Request::Rate {
        let i =
            Invariants::from_excess(Jet::<L, 3, 6>::variable(a, 0), Jet::variable(b, 1), Jet::variable(j, 2));
        let u = law.evaluate(&i, &site.fixed_point());
        return chain(&kinematics, u.value, &u.gradient, &u.hessian);
    }
    let i =
        Invariants::from_excess(Jet::<L, 4, 10>::variable(a, 0), Jet::variable(b, 1), Jet::variable(j, 2));
    let u = law.evaluate(&i, &site.moving_point());
    let ([u_a, u_b, u_j, _], h) = (u.gradient, u.hessian);
    let second = [h[0], h[1], h[2], h[4], h[5], h[7]];
    let mut out = chain(&kinematics, u.value, &[u_a, u_b, u_j], &second);
    out.stress_rate = combine(&[h[3], h[6], h[8]], &kinematics.slopes());
    out
}

#[inline(always)]
fn combine<L: Lane>(factors: &[L; 3], terms: &[[L; 9]; 3]) -> [L; 9] {
    let mut out = [L::splat(0.0); 9];
    for c in 0..9 {
        out[c] = factors[0].mul_add(terms[0][c], factors[1].mul_add(terms[1][c], factors[2] * terms[2][c]));
    }
    out
}

/// P = Σ uₙ dIₙ; ∂²u = Σ uₙₘ dIₙ ⊗ dIₘ + 2u₁ 1 + (u₃ − 2u₁ − 4u₂) (F×) + 2u₂ ((cof F)× + (F×)²).
#[inline(always)]
fn chain<L: Lane>(
    kinematics: &Kinematics<L>,
    energy: L,
    first: &[L; 3],
    second: &[L; 6],
) -> GradientResponse<L> {
    let (one, two) = (L::splat(1.0), L::splat(2.0));
    let slopes = kinematics.slopes();
    let mut out = GradientResponse::energy_only(energy);
    out.stress = combine(first, &slopes);
    let [u_1, u_2, u_3] = *first;
    let [s_11, s_12, s_13, s_22, s_23, s_33] = *second;
    let rows = [
        combine(&[s_11, s_12, s_13], &slopes),
        combine(&[s_12, s_22, s_23], &slopes),
        combine(&[s_13, s_23, s_33], &slopes),
    ];
    for i in 0..9 {
        for k in i..9 {
            let sum = slopes[0][i] * rows[0][k] + slopes[1][i] * rows[1][k];
            out.stiffness[packed(i, k)] = slopes[2][i].mul_add(rows[2][k], sum);
        }
        out.stiffness[packed(i, i)] = out.stiffness[packed(i, i)] + two * u_1;
    }
    let mut f = kinematics.h;
    for i in 0..3 {
        f[4 * i] = f[4 * i] + one;
    }
    add_cross(&f, u_3 - two * u_1 - L::splat(4.0) * u_2, &mut out.stiffness);
    let zero = L::splat(0.0);
    // |u₂| as 0 or 1 in each lane: a law that does without I₂ skips the rest
    let used = u_2.select_lt(zero, one, zero.select_lt(u_2, one, zero));
    if used.sum() == 0.0 {
        return out;
    }
    add_cross(&slopes[2], two * u_2, &mut out.stiffness);
    // (F×)² column by column: F × (F × E) for E the unit matrices, of which only the upper triangle is kept
    for k in 0..9 {
        let mut unit = [L::splat(0.0); 9];
        unit[k] = two * u_2;
        let column = cross(&f, &cross(&f, &unit));
        for i in 0..=k {
            out.stiffness[packed(i, k)] = out.stiffness[packed(i, k)] + column[i];
        }
    }
    out
}
