//! The time schemes: their coefficients.

/// How time is discretised.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scheme {
    /// ESDIRK4(3)6L\[2\]SA: six stages, the first explicit and the others implicit with the same diagonal; order 4 in poses, velocities, strains
    /// and wrenches; L-stable; an embedded formula of order 3 estimates the error of a step.
    ///
    /// On the group: φ_i = Δt Σ a_ij dexp₋φ_j⁻¹ η_j, g_i = g_n exp φ_i. Source: Kennedy and Carpenter (2003), Appl. Numer. Math. 44, 139, its
    /// implicit half; Munthe-Kaas (1999), Appl. Numer. Math. 29, 115.
    Esdirk43,
    /// Generalised-α on the Lie group: one implicit solve a step, order 2.
    ///
    /// `rho` is ρ∞, the factor by which a step multiplies the highest frequencies: 1 keeps the energy of all, 0.9 takes the noise away, 0 kills
    /// them in a step. Where supports hold more than the base, or strains are fixed, the forces that do it are noise that grows unless ρ∞ < 1: 1 is
    /// refused there (Arnold and Brüls 2007, Multibody Syst. Dyn. 18, 185). Source: Brüls and Cardona (2010), J. Comput. Nonlinear Dyn. 5, 031002; Arnold, Brüls and Cardona (2015).
    GeneralisedAlpha {
        /// ρ∞ in [0, 1].
        rho: f64,
    },
}

/// The coefficients of generalised-α.
#[derive(Clone, Copy, Debug)]
pub(super) struct Alpha {
    pub(super) alpha_m: f64,
    pub(super) alpha_f: f64,
    pub(super) beta: f64,
    pub(super) gamma: f64,
}

impl Alpha {
    pub(super) fn new(rho: f64) -> Self {
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 + alpha_f - alpha_m;
        Self { alpha_m, alpha_f, gamma, beta: 0.25 * (gamma + 0.5) * (gamma + 0.5) }
    }
}

/// Stages of the Runge–Kutta scheme.
pub(super) const STAGES: usize = 6;

/// The diagonal γ.
pub(super) const GAMMA: f64 = 0.25;

/// Nodes c_i.
pub(super) const C: [f64; STAGES] = [0.0, 0.5, 83.0 / 250.0, 31.0 / 50.0, 17.0 / 20.0, 1.0];

/// a_ij below the diagonal; the last row is b.
pub(super) const A: [[f64; STAGES]; STAGES] = [
    [0.0; STAGES],
    [0.25, GAMMA, 0.0, 0.0, 0.0, 0.0],
    [8611.0 / 62500.0, -1743.0 / 31250.0, GAMMA, 0.0, 0.0, 0.0],
    [5012029.0 / 34652500.0, -654441.0 / 2922500.0, 174375.0 / 388108.0, GAMMA, 0.0, 0.0],
    [
        15267082809.0 / 155376265600.0,
        -71443401.0 / 120774400.0,
        730878875.0 / 902184768.0,
        2285395.0 / 8070912.0,
        GAMMA,
        0.0,
    ],
    B,
];

/// Weights b.
pub(super) const B: [f64; STAGES] =
    [82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0, GAMMA];

/// Weights of the embedded formula of order 3.
pub(super) const B_EMBEDDED: [f64; STAGES] = [
    4586570599.0 / 29645900160.0,
    0.0,
    178811875.0 / 945068544.0,
    814220225.0 / 1159782912.0,
    -3700637.0 / 11593932.0,
    61727.0 / 225920.0,
];

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(weights: &[f64; STAGES], f: impl Fn(usize) -> f64) -> f64 {
        (0..STAGES).map(|i| weights[i] * f(i)).sum()
    }

    /// Order conditions of Butcher's trees, to the rounding of six terms of size one.
    #[test]
    fn the_tableau_has_order_four_and_its_companion_order_three() {
        let ac = |i: usize, power: i32| sum(&A[i], |j| C[j].powi(power));
        let aac = |i: usize| sum(&A[i], |j| ac(j, 1));
        let close = |value: f64, exact: f64| assert!((value - exact).abs() < 2e-15, "{value} for {exact}");
        for i in 0..STAGES {
            close(sum(&A[i], |_| 1.0), C[i]);
        }
        // stage order 2, but in the second stage, whose node is its own
        for i in 1..STAGES {
            close(ac(i, 1), 0.5 * C[i] * C[i]);
        }
        for (weights, order) in [(&B, 4), (&B_EMBEDDED, 3)] {
            for q in 1..=order {
                close(sum(weights, |i| C[i].powi(q - 1)), 1.0 / q as f64);
            }
            close(sum(weights, |i| ac(i, 1)), 1.0 / 6.0);
            if order == 4 {
                close(sum(weights, |i| C[i] * ac(i, 1)), 1.0 / 8.0);
                close(sum(weights, |i| ac(i, 2)), 1.0 / 12.0);
                close(sum(weights, aac), 1.0 / 24.0);
            }
        }
        // stiffly accurate, so that the last stage is the end of the step
        assert_eq!(A[STAGES - 1], B);
    }

    #[test]
    fn generalised_alpha_is_second_order_and_unconditionally_stable() {
        for rho in [0.0, 0.5, 0.9, 1.0] {
            let a = Alpha::new(rho);
            assert!((a.gamma - (0.5 - a.alpha_m + a.alpha_f)).abs() < 1e-15);
            assert!(
                a.alpha_m <= a.alpha_f + 1e-15
                    && a.alpha_f <= 0.5
                    && a.beta >= 0.25 + 0.5 * (a.alpha_f - a.alpha_m) - 1e-15
            );
        }
    }
}
