use super::compiled_here::compiled_here;
use super::kinematics::{Invariants, Point};
use super::law::Isotropic;
use crate::error::{Result, positive};
use crate::scalar::Scalar;

/// Mooney–Rivlin as the source text writes it, u = C₁(I₁−3) + C₂(I₂−3).
///
/// In the strains of a rigid section, s = a² + b² and e = J − 1,
///
/// ```math
/// u = (C_1 + C_2)\, s + (C_1 + 2C_2)\, e^2 + (2C_1 + 4C_2)\, e .
/// ```
///
/// **The last term is a stress at rest**, Ψ(0) = (0, 0, 0, 0, 0, (2C₁+4C₂)A): wrap the law in
/// [`ReferencePressure`](super::ReferencePressure), which subtracts it exactly, and
///
/// ```math
/// \Psi = K\,\Delta\xi, \quad K = \operatorname{diag}(EI_x, EI_y, GJ, GA, GA, EA), \quad E = 2C_1 + 4C_2, \quad G = 2C_1 + 2C_2
/// ```
///
/// holds for every strain, with I_x = ∫y² dA. E and G are the moduli of a section that cannot contract: a real
/// incompressible rubber has E = 6(C₁ + C₂) and G = 2(C₁ + C₂).
///
/// Source: Mooney (1940), J. Appl. Phys. 11, 582; Rivlin (1948), Phil. Trans. R. Soc. A 241, 379.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MooneyRivlin {
    c1: f64,
    c2: f64,
}

impl MooneyRivlin {
    /// From the two constants, Pa.
    ///
    /// # Errors
    /// If one is not finite, or if the axial modulus 2C₁ + 4C₂ or the shear modulus 2C₁ + 2C₂ is not positive.
    pub fn new(c1: f64, c2: f64) -> Result<Self> {
        let law = Self { c1, c2 };
        for (quantity, value) in [
            ("Mooney-Rivlin axial modulus 2 C1 + 4 C2", law.axial_modulus()),
            ("Mooney-Rivlin shear modulus 2 C1 + 2 C2", law.shear_modulus()),
        ] {
            positive(quantity, value)?;
        }
        Ok(law)
    }

    /// E = 2C₁ + 4C₂, Pa: the modulus of a section that cannot contract.
    pub fn axial_modulus(&self) -> f64 {
        2.0 * self.c1 + 4.0 * self.c2
    }

    /// G = 2C₁ + 2C₂, Pa.
    pub fn shear_modulus(&self) -> f64 {
        2.0 * (self.c1 + self.c2)
    }
}

impl Isotropic for MooneyRivlin {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        i.i1() * self.c1 + i.i2() * self.c2
    }

    fn degree(&self) -> Option<usize> {
        Some(2)
    }

    fn is_homogeneous(&self) -> bool {
        true
    }

    fn is_uniform(&self) -> bool {
        true
    }

    #[inline(always)]
    fn stress_free_energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> Option<D> {
        Some(i.i1_excess() * self.c1 + i.i2_excess() * self.c2)
    }

    compiled_here!(perform);
    compiled_here!(perform_stress_free);
}
