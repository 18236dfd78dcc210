//! Laws made of laws: sums and multiples.

use super::kinematics::{Deformation, Point};
use super::law::Local;
use crate::error::{Result, require};
use crate::scalar::Scalar;

/// The sum of two laws, u = u₁ + u₂: two constituents that share one deformation. Nest it for more.
///
/// ```
/// use hyperrod::material::{Fibres, NeoHookean, Straight, Sum};
///
/// # fn main() -> hyperrod::Result<()> {
/// let muscle = Sum(NeoHookean::new(20e3, 100e3)?, Fibres::new(Straight::axial(), 50e3, 2.0)?);
/// # let _ = muscle; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum<A, B>(pub A, pub B);

impl<A: Local, B: Local> Local for Sum<A, B> {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        self.0.energy_density(f, at) + self.1.energy_density(f, at)
    }

    fn degree(&self) -> Option<usize> {
        Some(self.0.degree()?.max(self.1.degree()?))
    }

    fn is_uniform(&self) -> bool {
        self.0.is_uniform() && self.1.is_uniform()
    }

    fn is_homogeneous(&self) -> bool {
        self.0.is_homogeneous() && self.1.is_homogeneous()
    }

    fn domain(&self) -> &'static str {
        "finite: the strain leaves the domain of one of the laws added"
    }
}

/// A multiple of a law, for instance its share of the volume of a composite.
///
/// ```
/// use hyperrod::material::{NeoHookean, Scaled};
/// let porous = Scaled::new(0.7, NeoHookean::new(20e3, 100e3)?)?;
/// # Ok::<(), hyperrod::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled<L> {
    factor: f64,
    law: L,
}

impl<L: Local> Scaled<L> {
    /// `factor` times `law`.
    ///
    /// # Errors
    /// If the factor is not finite.
    pub fn new(factor: f64, law: L) -> Result<Self> {
        require(factor.is_finite(), "factor of a scaled law", factor, "finite")?;
        Ok(Self { factor, law })
    }
}

impl<L: Local> Local for Scaled<L> {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        self.law.energy_density(f, at) * self.factor
    }

    fn degree(&self) -> Option<usize> {
        self.law.degree()
    }

    fn is_uniform(&self) -> bool {
        self.law.is_uniform()
    }

    fn is_homogeneous(&self) -> bool {
        self.law.is_homogeneous()
    }

    fn domain(&self) -> &'static str {
        self.law.domain()
    }
}
