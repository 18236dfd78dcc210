use nalgebra::{Matrix6, Vector6};

use super::CrossSection;
use crate::error::{Error, Result};
use crate::lie::{Strain, Wrench};
use crate::material::{Active, Request, Response, Station, check_strain};

/// A section given by its resultants alone: Ψ = K Δξ with a constant, symmetric, positive definite K.
///
/// ```math
/// U = \tfrac12\, \Delta\xi^{\mathsf T} K \Delta\xi
/// ```
///
/// For measured stiffnesses, or with torsion constants and shear factors typed in.
///
/// ```
/// use hyperrod::section::Stiffness;
/// # fn main() -> hyperrod::Result<()> {
/// // EI_x, EI_y, GJ in N m²; GA_x, GA_y, EA in N
/// let cable = Stiffness::diagonal([0.8, 0.8, 0.5, 1e5, 1e5, 3e5])?;
/// # let _ = cable; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    k: Matrix6<f64>,
}

impl Stiffness {
    /// From the full matrix, rows and columns (angular, linear).
    ///
    /// # Errors
    /// If K is not finite, not symmetric (to 1e-12 of its diagonal) or not positive definite.
    pub fn new(k: Matrix6<f64>) -> Result<Self> {
        if let Some(&value) = k.iter().find(|v| !v.is_finite()) {
            return Err(Error::Invalid { quantity: "entry of K", value, requirement: "finite" });
        }
        for i in 0..6 {
            for j in 0..i {
                let asymmetry = (k[(i, j)] - k[(j, i)]).abs();
                if asymmetry > 1e-12 * (k[(i, i)] * k[(j, j)]).abs().sqrt() {
                    let requirement = "symmetric";
                    return Err(Error::Invalid { quantity: "asymmetry of K", value: asymmetry, requirement });
                }
            }
        }
        if k.cholesky().is_none() {
            let value = k.symmetric_eigenvalues().min();
            let quantity = "smallest eigenvalue of K";
            return Err(Error::Invalid { quantity, value, requirement: "positive and finite" });
        }
        Ok(Self { k })
    }

    /// K = diag(EI_x, EI_y, GJ, GA_x, GA_y, EA), in N m² and N.
    ///
    /// # Errors
    /// If an entry is not positive and finite.
    pub fn diagonal(entries: [f64; 6]) -> Result<Self> {
        const NAMES: [&str; 6] = ["EI_x", "EI_y", "GJ", "GA_x", "GA_y", "EA"];
        for (value, quantity) in entries.into_iter().zip(NAMES) {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::Invalid { quantity, value, requirement: "positive and finite" });
            }
        }
        Ok(Self { k: Matrix6::from_diagonal(&Vector6::from(entries)) })
    }
}

impl Stiffness {
    /// Writes what is asked for in the strains that are active; the rest of wrench and tangent is left as it is.
    fn answer(
        &self,
        at: &Station,
        strain: &Strain,
        active: Active,
        request: Request,
        out: &mut Response,
    ) -> Result<()> {
        check_strain(strain, at.s)?;
        let wrench = Wrench::from_array(product(&self.k, &strain.to_array()));
        out.energy = 0.5 * strain.pair(&wrench);
        out.wrench_rate = Wrench::zero();
        let wrench = (request >= Request::Wrench).then_some(&wrench);
        active.write(wrench, (request >= Request::Tangent).then_some(&self.k), out);
        Ok(())
    }
}

/// K x, by columns.
#[inline(always)]
fn product(k: &Matrix6<f64>, x: &[f64; 6]) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for (column, x) in k.as_slice().chunks_exact(6).zip(x) {
        // as the strains that a rod cannot have
        if *x == 0.0 {
            continue;
        }
        for (sum, k) in sum.iter_mut().zip(column) {
            *sum += k * x;
        }
    }
    sum
}

impl CrossSection for Stiffness {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        let mut response = Response::zero();
        self.answer(at, strain, Active::all(), request, &mut response)?;
        Ok(response)
    }

    fn respond_many(
        &self,
        sites: &[(Station, Strain)],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        self.respond_active(sites, Active::all(), request, out)
    }

    fn respond_active(
        &self,
        sites: &[(Station, Strain)],
        active: Active,
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        for ((at, strain), out) in sites.iter().zip(out) {
            self.answer(at, strain, active, request, out)?;
        }
        Ok(())
    }
}
