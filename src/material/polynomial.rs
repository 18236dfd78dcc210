use super::coefficient_table::{Coefficient, CoefficientTable};
use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::Result;
use crate::scalar::Scalar;

/// The polynomial family in the raw invariants, u = Σ C_ij (I₁−3)ⁱ (I₂−3)ʲ + Σ D_k (J−1)²ᵏ.
///
/// Any finite table of coefficients, in Pa; C₀₀ is refused. **D_k multiplies** here, as in the source text; finite-element codes divide,
/// (J−1)²ᵏ/D_k: give their numbers to [`with_divisors`](Self::with_divisors).
///
/// Like [`MooneyRivlin`](super::MooneyRivlin), which is the case of C₁₀ and C₀₁ alone, it pulls at rest with the stress
/// 2C₁₀ + 4C₀₁. Wrapped in [`ReferencePressure`](super::ReferencePressure), which subtracts it term by term, the small-strain moduli are
///
/// ```math
/// G = 2 (C_{10} + C_{01}), \qquad E_{\text{rigid}} = 2 C_{10} + 4 C_{01} + 8 C_{20} + 16 C_{11} + 32 C_{02} + 2 D_1 ,
/// ```
///
/// the second one for a section that cannot contract. Defined for J > 0; of degree max(2(i+j), 2k) in the strain, which the
/// quadrature of a section then integrates exactly.
///
/// ```
/// use hyperrod::material::{Polynomial, ReferencePressure};
///
/// # fn main() -> hyperrod::Result<()> {
/// let c = [((1, 0), 100e3), ((0, 1), 30e3), ((2, 0), 20e3)];
/// let rubber = ReferencePressure(Polynomial::new(&c, &[500e3])?);
/// assert!(Polynomial::new(&[((0, 0), 1.0)], &[]).is_err());
/// let three = Polynomial::new(&[((1, 0), 100e3), ((0, 1), 30e3), ((1, 1), 20e3)], &[500e3])?;
/// assert_eq!(Polynomial::mooney_rivlin_3([100e3, 30e3, 20e3], 500e3)?, three);
/// # let _ = rubber; Ok(()) }
/// ```
///
/// Source: Rivlin and Saunders (1951), Phil. Trans. R. Soc. A 243, 251, with volumetric terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial {
    table: CoefficientTable,
}

impl Polynomial {
    /// From C_ij as ((i, j), C_ij) and D_1, D_2, …, Pa.
    ///
    /// # Errors
    /// [`Error::Coefficient`](crate::Error::Coefficient) if one is not finite, C₀₀ is given, one is given twice, or all are zero.
    pub fn new(c: &[Coefficient], d: &[f64]) -> Result<Self> {
        Ok(Self { table: CoefficientTable::new(c, d)? })
    }

    /// As [`new`](Self::new), with volumetric terms (J−1)²ᵏ/D_k, D_k in 1/Pa; zero leaves a term out.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_divisors(c: &[Coefficient], d: &[f64]) -> Result<Self> {
        Self::new(c, &CoefficientTable::multipliers(d))
    }

    /// Mooney–Rivlin with three terms, C₁₀, C₀₁, C₁₁, and D₁.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn mooney_rivlin_3([c10, c01, c11]: [f64; 3], d1: f64) -> Result<Self> {
        Self::new(&[((1, 0), c10), ((0, 1), c01), ((1, 1), c11)], &[d1])
    }

    /// Mooney–Rivlin with five terms, C₁₀, C₀₁, C₂₀, C₁₁, C₀₂, and D₁, D₂.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn mooney_rivlin_5([c10, c01, c20, c11, c02]: [f64; 5], d: [f64; 2]) -> Result<Self> {
        Self::new(&[((1, 0), c10), ((0, 1), c01), ((2, 0), c20), ((1, 1), c11), ((0, 2), c02)], &d)
    }

    /// G = 2(C₁₀ + C₀₁), Pa, once the stress at rest is taken off.
    pub fn shear_modulus(&self) -> f64 {
        2.0 * (self.table.c10() + self.table.c01())
    }

    /// ∂²u/∂J² at rest, Pa: the axial modulus of a section that cannot contract, once the stress at rest is taken off.
    pub fn axial_modulus(&self) -> f64 {
        let [c20, c11, c02, d1] = self.table.quadratic();
        2.0 * self.table.c10() + 4.0 * self.table.c01() + 8.0 * c20 + 16.0 * c11 + 32.0 * c02 + 2.0 * d1
    }
}

impl Isotropic for Polynomial {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let table = &self.table;
        let (i1, i2) = (i.i1(), i.i2());
        i1 * table.c10() + i2 * table.c01() + table.higher(i1, i2) + table.volumetric(i.j())
    }

    fn degree(&self) -> Option<usize> {
        let (deviatoric, volumetric) = self.table.powers();
        Some(2 * deviatoric.max(volumetric))
    }

    fn is_uniform(&self) -> bool {
        true
    }

    #[inline(always)]
    fn stress_free_energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> Option<D> {
        let table = &self.table;
        let linear = i.i1_excess() * table.c10() + i.i2_excess() * table.c01();
        Some(linear + table.higher(i.i1(), i.i2()) + table.volumetric(i.j()))
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite"
    }
}

/// The polynomial family in the isochoric invariants, u = Σ C_ij (Ī₁−3)ⁱ (Ī₂−3)ʲ + Σ D_k (J−1)²ᵏ, as datasheets have it.
///
/// ```math
/// \bar I_1 = J^{-2/3} I_1, \qquad \bar I_2 = J^{-4/3} I_2
/// ```
///
/// Free of stress at rest, with shear modulus G = 2(C₁₀ + C₀₁), bulk modulus κ = 2D₁ and axial modulus κ + 4G/3 of a section that
/// cannot contract. **D_k multiplies**; codes that write (J−1)²ᵏ/D_k: [`with_divisors`](Self::with_divisors). Defined for J > 0. Not a
/// polynomial in the strain, for the powers of J.
///
/// ```
/// use hyperrod::material::IsochoricPolynomial;
///
/// # fn main() -> hyperrod::Result<()> {
/// let rubber = IsochoricPolynomial::with_divisors(&[((1, 0), 100e3), ((0, 1), 30e3)], &[2e-6])?; // D1 = 2e-6 1/Pa
/// assert_eq!(rubber.bulk_modulus(), 1e6);
/// # Ok(()) }
/// ```
///
/// Source: the polynomial form of finite-element codes, e.g. Abaqus Theory Guide, "Hyperelastic material behavior"; Ī after
/// Flory (1961), Trans. Faraday Soc. 57, 829.
#[derive(Clone, Debug, PartialEq)]
pub struct IsochoricPolynomial {
    table: CoefficientTable,
}

impl IsochoricPolynomial {
    /// From C_ij as ((i, j), C_ij) and D_1, D_2, …, Pa.
    ///
    /// # Errors
    /// [`Error::Coefficient`](crate::Error::Coefficient) if one is not finite, C₀₀ is given, one is given twice, or all are zero.
    pub fn new(c: &[Coefficient], d: &[f64]) -> Result<Self> {
        Ok(Self { table: CoefficientTable::new(c, d)? })
    }

    /// As [`new`](Self::new), with volumetric terms (J−1)²ᵏ/D_k, D_k in 1/Pa; zero leaves a term out.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_divisors(c: &[Coefficient], d: &[f64]) -> Result<Self> {
        Self::new(c, &CoefficientTable::multipliers(d))
    }

    /// G = 2(C₁₀ + C₀₁), Pa.
    pub fn shear_modulus(&self) -> f64 {
        2.0 * (self.table.c10() + self.table.c01())
    }

    /// κ = 2D₁, Pa.
    pub fn bulk_modulus(&self) -> f64 {
        let [.., d1] = self.table.quadratic();
        2.0 * d1
    }
}

impl Isotropic for IsochoricPolynomial {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let table = &self.table;
        let (i1, i2) = (i.i1_isochoric(), i.i2_isochoric());
        i1 * table.c10() + i2 * table.c01() + table.higher(i1, i2) + table.volumetric(i.j())
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn domain(&self) -> &'static str {
        "finite, which needs J > 0"
    }
}
