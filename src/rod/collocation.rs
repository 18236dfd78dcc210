/// Gauss collocation with S stages on [0, 1]: order 2S.
///
/// Source: Hairer, Lubich and Wanner (2006), *Geometric Numerical Integration*, II.1.3.
#[derive(Clone, Debug)]
pub(crate) struct Collocation<const S: usize> {
    /// Nodes c_k.
    pub(crate) c: [f64; S],
    /// Weights b_k.
    pub(crate) b: [f64; S],
    /// a_kl = ∫₀^{c_k} L_l, L the Lagrange polynomials on the nodes.
    pub(crate) a: [[f64; S]; S],
    /// [`taylor`](Self::taylor) at the stages.
    pub(crate) stage: [[[f64; S]; S]; S],
    /// [`taylor`](Self::taylor) at the end of the element.
    pub(crate) end: [[f64; S]; S],
    /// Coefficients of the Lagrange polynomials, constant term first.
    lagrange: [[f64; S]; S],
}

impl<const S: usize> Collocation<S> {
    pub(crate) fn gauss() -> Self {
        let (c, b) = nodes_and_weights();
        let mut table = Self {
            c,
            b,
            a: [[0.0; S]; S],
            stage: [[[0.0; S]; S]; S],
            end: [[0.0; S]; S],
            lagrange: lagrange_coefficients(&c),
        };
        for k in 0..S {
            for l in 0..S {
                table.a[k][l] =
                    (0..S).rev().fold(0.0, |sum, j| (sum + table.lagrange[l][j] / (j + 1) as f64) * c[k]);
            }
            table.stage[k] = table.taylor(c[k]);
        }
        table.end = table.taylor(1.0);
        table
    }

    /// t_jl such that, for ξ(τ) = Σ L_l(τ) ξ_l, the Taylor coefficients about the middle of [0, c], times the length to the power,
    /// are α_{j+1} = h Σ_l t_jl ξ_l, t_jl = c^{j+1} L_l^{(j)}(c/2) / j!.
    pub(crate) fn taylor(&self, c: f64) -> [[f64; S]; S] {
        let middle = 0.5 * c;
        std::array::from_fn(|j| {
            std::array::from_fn(|l| {
                // the j-th Taylor coefficient of a polynomial: Σ_i binom(i, j) p_i middle^{i-j}
                let shifted =
                    (j..S).rev().fold(0.0, |sum, i| sum * middle + binomial(i, j) * self.lagrange[l][i]);
                shifted * c.powi(j as i32 + 1)
            })
        })
    }

    /// The Lagrange polynomials at τ: weights of the stage values in an interpolation.
    pub(crate) fn interpolation(&self, tau: f64) -> [f64; S] {
        std::array::from_fn(|l| self.lagrange[l].iter().rev().fold(0.0, |sum, p| sum * tau + p))
    }
}

fn nodes_and_weights<const S: usize>() -> ([f64; S], [f64; S]) {
    let (third, fifth) = (3.0_f64.sqrt() / 6.0, 15.0_f64.sqrt() / 10.0);
    let (c, b): (&[f64], &[f64]) = match S {
        1 => (&[0.5], &[1.0]),
        2 => (&[0.5 - third, 0.5 + third], &[0.5, 0.5]),
        3 => (&[0.5 - fifth, 0.5, 0.5 + fifth], &[5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0]),
        _ => panic!("Gauss collocation is tabled for 1, 2 or 3 stages, not {S}"),
    };
    (std::array::from_fn(|k| c[k]), std::array::from_fn(|k| b[k]))
}

fn lagrange_coefficients<const S: usize>(c: &[f64; S]) -> [[f64; S]; S] {
    std::array::from_fn(|l| {
        let mut p = [0.0; S];
        p[0] = 1.0;
        for (degree, m) in (0..S).filter(|&m| m != l).enumerate() {
            let scale = 1.0 / (c[l] - c[m]);
            for j in (0..=degree + 1).rev() {
                let lower = if j > 0 { p[j - 1] } else { 0.0 };
                p[j] = (lower - c[m] * p[j]) * scale;
            }
        }
        p
    })
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds_for<const S: usize>() {
        let table = Collocation::<S>::gauss();
        // order conditions B(2S): Σ b c^{q-1} = 1/q; C(S): Σ_l a_kl c_l^{q-1} = c_k^q / q. Rounding of S terms of size one.
        for q in 1..=2 * S {
            let sum: f64 = (0..S).map(|k| table.b[k] * table.c[k].powi(q as i32 - 1)).sum();
            assert!((sum - 1.0 / q as f64).abs() < 4e-16, "B({q}) with {S} stages");
        }
        for q in 1..=S {
            for k in 0..S {
                let sum: f64 = (0..S).map(|l| table.a[k][l] * table.c[l].powi(q as i32 - 1)).sum();
                assert!((sum - table.c[k].powi(q as i32) / q as f64).abs() < 4e-16);
            }
        }
        // Taylor data of τ^i about the middle of [0, c]: binom(i, j) (c/2)^{i-j} c^{j+1}
        for i in 0..S {
            for c in [0.3, 1.0] {
                let taylor = table.taylor(c);
                for (j, row) in taylor.iter().enumerate() {
                    let sum: f64 = (0..S).map(|l| row[l] * table.c[l].powi(i as i32)).sum();
                    let exact = if j > i {
                        0.0
                    } else {
                        binomial(i, j) * (0.5 * c).powi((i - j) as i32) * c.powi(j as i32 + 1)
                    };
                    assert!((sum - exact).abs() < 1e-14, "τ^{i}, coefficient {j} on [0, {c}]");
                }
            }
        }
    }

    #[test]
    fn gauss_tables_satisfy_their_order_conditions() {
        holds_for::<1>();
        holds_for::<2>();
        holds_for::<3>();
    }
}
