//! The coefficients C_ij and D_k of the polynomial family, checked, sorted and summed by Horner's rule.

use crate::error::{Error, Result};
use crate::scalar::Scalar;

/// One entry of a table: the powers (i, j) and the coefficient C_ij, Pa.
pub type Coefficient = ((usize, usize), f64);

/// Σ C_ij xⁱ yʲ + Σ D_k eᵏ⁺ᵏ without constant term.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CoefficientTable {
    c10: f64,
    c01: f64,
    /// C_ij of total power two and more: `higher[j][i]`, zero where nothing was given.
    higher: Vec<Vec<f64>>,
    d: Vec<f64>,
}

impl CoefficientTable {
    pub(super) fn new(c: &[Coefficient], d: &[f64]) -> Result<Self> {
        let mut table = Self { c10: 0.0, c01: 0.0, higher: Vec::new(), d: d.to_vec() };
        for (position, &((i, j), value)) in c.iter().enumerate() {
            let require =
                |met, requirement| require_coefficient(met, || format!("C_{i}{j}"), value, requirement);
            require(value.is_finite(), "finite")?;
            require((i, j) != (0, 0), "left out: a constant energy has no effect, so it must be a mistake")?;
            let first = c.iter().position(|&(powers, _)| powers == (i, j));
            require(first == Some(position), "given once")?;
            match (i, j) {
                (1, 0) => table.c10 = value,
                (0, 1) => table.c01 = value,
                _ => table.set_higher(i, j, value),
            }
        }
        for (k, &value) in d.iter().enumerate() {
            require_coefficient(value.is_finite(), || format!("D_{}", k + 1), value, "finite")?;
        }
        let all = c.iter().map(|&(_, value)| value).chain(d.iter().copied());
        let largest = all.fold(0.0, |largest: f64, value| largest.max(value.abs()));
        require_coefficient(largest > 0.0, || "largest in size".into(), largest, "positive: all are zero")?;
        Ok(table)
    }

    /// The multipliers D_k from the divisors of finite-element codes, which write (J−1)²ᵏ/D_k; zero stands for a term left out.
    pub(super) fn multipliers(divisors: &[f64]) -> Vec<f64> {
        divisors.iter().map(|&d| if d == 0.0 { 0.0 } else { 1.0 / d }).collect()
    }

    fn set_higher(&mut self, i: usize, j: usize, value: f64) {
        if self.higher.len() <= j {
            self.higher.resize(j + 1, Vec::new());
        }
        if self.higher[j].len() <= i {
            self.higher[j].resize(i + 1, 0.0);
        }
        self.higher[j][i] = value;
    }

    pub(super) fn c10(&self) -> f64 {
        self.c10
    }

    pub(super) fn c01(&self) -> f64 {
        self.c01
    }

    /// C_ij of second order, (C₂₀, C₁₁, C₀₂), and D₁: what the small-strain moduli ask for.
    pub(super) fn quadratic(&self) -> [f64; 4] {
        let higher =
            |i: usize, j: usize| self.higher.get(j).and_then(|row| row.get(i)).copied().unwrap_or(0.0);
        [higher(2, 0), higher(1, 1), higher(0, 2), self.d.first().copied().unwrap_or(0.0)]
    }

    /// The largest i + j, and the largest k.
    pub(super) fn powers(&self) -> (usize, usize) {
        let linear = usize::from(self.c10 != 0.0 || self.c01 != 0.0);
        let higher = self.higher.iter().enumerate().filter(|(_, row)| !row.is_empty());
        (higher.map(|(j, row)| j + row.len() - 1).max().unwrap_or(0).max(linear), self.d.len())
    }

    /// Σ C_ij xⁱ yʲ over i + j ≥ 2.
    #[inline(always)]
    pub(super) fn higher<D: Scalar>(&self, x: D, y: D) -> D {
        self.higher.iter().rev().fold(D::zero(), |sum, row| {
            let coefficient = row.iter().rev().fold(D::zero(), |sum, &c| sum * x + c);
            sum * y + coefficient
        })
    }

    /// Σ D_k e²ᵏ.
    #[inline(always)]
    pub(super) fn volumetric<D: Scalar>(&self, e: D) -> D {
        let e_squared = e * e;
        self.d.iter().rev().fold(D::zero(), |sum, &d| (sum + d) * e_squared)
    }
}

/// Refuses a coefficient of a table that does not meet its requirement; `name` is called only then.
pub(super) fn require_coefficient(
    met: bool,
    name: impl FnOnce() -> String,
    value: f64,
    requirement: &'static str,
) -> Result<()> {
    if met { Ok(()) } else { Err(Error::Coefficient { name: name(), value, requirement }) }
}
