use nalgebra::Matrix6;

use super::{Body, Constraint, Elastic, HasArea, HasMass, LineMass};
use crate::error::{Error, Result, not_negative};
use crate::lie::Strain;
use crate::material::{Reference, Request, Response};
use crate::section::{AreaMoments, CrossSection, Geometry};

/// What dynamics asks of a body about damping: a wrench V ξ̇ that adds to Ψ (Kelvin–Voigt), or none.
pub trait Dissipative {
    /// The viscosity matrix V at s, rows and columns (angular, linear), in N m² s, N m s and N s; `None` without damping.
    ///
    /// # Errors
    /// Where a size of the section is not what it must be.
    fn viscosity(&self, s: f64) -> Result<Option<Matrix6<f64>>>;
}

impl<C, M> Dissipative for Body<C, M> {
    fn viscosity(&self, _s: f64) -> Result<Option<Matrix6<f64>>> {
        Ok(None)
    }
}

/// How a viscosity matrix follows from a body.
pub trait ViscosityModel<B>: Send + Sync {
    /// V at s.
    ///
    /// # Errors
    /// As [`Dissipative::viscosity`].
    fn matrix(&self, body: &B, s: f64) -> Result<Matrix6<f64>>;
}

/// The viscosity of an incompressible Newtonian fluid filling the section, Pa s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsotropicViscosity(f64);

/// A viscosity matrix given as it is, the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscosityMatrix(Matrix6<f64>);

impl<C: CrossSection + Geometry, M: Send + Sync> ViscosityModel<Body<C, M>> for IsotropicViscosity {
    /// ```math
    /// V = \mu \int B^{\mathsf T}\, \mathrm{diag}(1, 1, 3)\, B\,dA, \qquad \dot\gamma = B\dot\xi = \dot\nu + \dot\omega \times (x, y, 0)
    /// ```
    ///
    /// About principal axes through the centroid this is μ diag(3I_x, 3I_y, J, A, A, 3A): shear with μ, extension with the Trouton
    /// viscosity 3μ. Source: Linn, Lang and Tuganov (2013), Mech. Sci. 4, 79.
    fn matrix(&self, body: &Body<C, M>, s: f64) -> Result<Matrix6<f64>> {
        let m = body.section().moments(s)?;
        let [x, y] = m.first;
        let mut v = Matrix6::zeros();
        (v[(0, 0)], v[(1, 1)], v[(2, 2)]) = (3.0 * m.i_x, 3.0 * m.i_y, m.polar());
        (v[(3, 3)], v[(4, 4)], v[(5, 5)]) = (m.area, m.area, 3.0 * m.area);
        let off = [(0, 1, -3.0 * m.i_xy), (0, 5, 3.0 * y), (1, 5, -3.0 * x), (2, 3, -y), (2, 4, x)];
        for (row, column, value) in off {
            (v[(row, column)], v[(column, row)]) = (value, value);
        }
        Ok(v * self.0)
    }
}

impl<B> ViscosityModel<B> for ViscosityMatrix {
    fn matrix(&self, _body: &B, _s: f64) -> Result<Matrix6<f64>> {
        Ok(self.0)
    }
}

/// V(s) as a function of the arc length.
impl<B, F: Fn(f64) -> Matrix6<f64> + Send + Sync> ViscosityModel<B> for F {
    fn matrix(&self, _body: &B, s: f64) -> Result<Matrix6<f64>> {
        check(self(s), Some(s))
    }
}

/// Refuses a matrix that is not finite or would create energy.
fn check(matrix: Matrix6<f64>, s: Option<f64>) -> Result<Matrix6<f64>> {
    let symmetric = (matrix + matrix.transpose()) * 0.5;
    let quantity = "smallest eigenvalue of the viscosity matrix";
    let requirement = "finite and not negative";
    let (least, size) = if matrix.iter().all(|v| v.is_finite()) {
        (symmetric.symmetric_eigenvalues().min(), symmetric.norm())
    } else {
        (f64::NAN, 0.0)
    };
    // rounding of an eigenvalue that is zero
    if least >= -1e-12 * size {
        return Ok(matrix);
    }
    Err(match s {
        Some(s) => Error::InvalidAt { quantity, value: least, requirement, s },
        None => Error::Invalid { quantity, value: least, requirement },
    })
}

/// A body with Kelvin–Voigt damping: its internal wrench is Ψ(Δξ) + V ξ̇.
///
/// ```
/// use hyperrod::Body;
/// use hyperrod::body::Dissipative;
/// use hyperrod::material::LinearElastic;
/// use hyperrod::section::{Circle, Section};
///
/// # fn main() -> hyperrod::Result<()> {
/// let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 1.7e5)?)?;
/// let body = Body::new(0.4, section)?.with_density(1000.0)?.with_viscosity(200.0)?; // Pa s
/// let area = std::f64::consts::PI * 1e-4;
/// assert!((body.viscosity(0.1)?.unwrap()[(5, 5)] - 3.0 * 200.0 * area).abs() < 1e-12);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Viscous<B, V> {
    body: B,
    viscosity: V,
}

impl<B, V> Viscous<B, V> {
    /// The body without its damping.
    pub fn inner(&self) -> &B {
        &self.body
    }
}

impl<C: CrossSection, M: Send + Sync> Body<C, M> {
    /// The same with the isotropic damping μ diag(3I, 3I, J, A, A, 3A), μ in Pa s; see [`IsotropicViscosity`].
    ///
    /// # Errors
    /// If the viscosity is negative or not finite.
    pub fn with_viscosity(self, mu: f64) -> Result<Viscous<Self, IsotropicViscosity>>
    where
        C: Geometry,
    {
        not_negative("viscosity", mu)?;
        Ok(Viscous { body: self, viscosity: IsotropicViscosity(mu) })
    }

    /// The same with a viscosity matrix V.
    ///
    /// # Errors
    /// If it is not finite, or its symmetric part not positive semi-definite.
    pub fn with_viscosity_matrix(self, matrix: Matrix6<f64>) -> Result<Viscous<Self, ViscosityMatrix>> {
        Ok(Viscous { body: self, viscosity: ViscosityMatrix(check(matrix, None)?) })
    }

    /// The same with a viscosity matrix V(s) that varies along the rod; it is checked where it is used.
    pub fn with_varying_viscosity<V: Fn(f64) -> Matrix6<f64> + Send + Sync>(
        self,
        viscosity: V,
    ) -> Viscous<Self, V> {
        Viscous { body: self, viscosity }
    }
}

impl<B, V: ViscosityModel<B>> Dissipative for Viscous<B, V> {
    fn viscosity(&self, s: f64) -> Result<Option<Matrix6<f64>>> {
        self.viscosity.matrix(&self.body, s).map(Some)
    }
}

impl<B: Elastic, V: Send + Sync> Elastic for Viscous<B, V> {
    fn length(&self) -> f64 {
        self.body.length()
    }

    fn reference(&self, s: f64) -> Reference {
        self.body.reference(s)
    }

    fn respond(&self, s: f64, strain: &Strain, request: Request) -> Result<Response> {
        self.body.respond(s, strain, request)
    }

    fn respond_many(
        &self,
        places: &[f64],
        strains: &[Strain],
        request: Request,
        out: &mut [Response],
    ) -> Result<()> {
        self.body.respond_many(places, strains, request, out)
    }

    fn constraint(&self) -> Constraint {
        self.body.constraint()
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.body.breakpoints()
    }
}

impl<B: HasMass, V> HasMass for Viscous<B, V> {
    fn line_mass(&self, s: f64) -> Result<LineMass> {
        self.body.line_mass(s)
    }

    fn inertia(&self, s: f64) -> Result<Matrix6<f64>> {
        self.body.inertia(s)
    }
}

impl<B: HasArea, V> HasArea for Viscous<B, V> {
    fn area_moments(&self, s: f64) -> Result<AreaMoments> {
        self.body.area_moments(s)
    }
}
