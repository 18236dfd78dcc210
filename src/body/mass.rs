use nalgebra::{Matrix3, Matrix6, Vector3};

use super::Body;
use crate::error::{Result, positive};
use crate::lie::so3::hat;
use crate::material::Station;
use crate::section::{CrossSection, Geometry};

/// No mass: what a body has until a scene needs one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Massless;

/// A density of the reference, kg/m³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Density(f64);

/// A mass per length of the reference, kg/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineDensity(f64);

impl Density {
    pub(super) fn new(density: f64) -> Result<Self> {
        positive("density", density)?;
        Ok(Self(density))
    }
}

impl LineDensity {
    pub(super) fn new(mass: f64) -> Result<Self> {
        positive("mass per length", mass)?;
        Ok(Self(mass))
    }
}

/// The mass of a slice of the rod, per length of the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineMass {
    /// Mass per length ∫ρ dV/ds, kg/m.
    pub mass: f64,
    /// First moments (∫ρx dV/ds, ∫ρy dV/ds), kg: mass per length times the place of its centre in the section.
    pub first: [f64; 2],
}

/// How a body's mass per length follows from its section.
#[diagnostic::on_unimplemented(
    message = "this body has no mass",
    label = "a mass is needed here",
    note = "give the body one: `Body::new(length, section)?.with_density(kg_per_m3)?`"
)]
pub trait MassModel<C>: Send + Sync {
    /// Mass and first moments per length of the reference at a station.
    ///
    /// # Errors
    /// As [`Geometry::moments`].
    fn line_mass(&self, section: &C, at: &Station) -> Result<LineMass>;

    /// The inertia matrix per length of the reference at a station: see [`HasMass::inertia`].
    ///
    /// # Errors
    /// As [`Geometry::moments`].
    fn inertia(&self, section: &C, at: &Station) -> Result<Matrix6<f64>>;
}

/// [[I, c^], [−c^, μ 1]] from the mass per length μ, its first moments c and its second moments (∫x², ∫y², ∫xy).
fn inertia_matrix(mass: f64, [x, y]: [f64; 2], [xx, yy, xy]: [f64; 3]) -> Matrix6<f64> {
    let rotary = Matrix3::new(yy, -xy, 0.0, -xy, xx, 0.0, 0.0, 0.0, xx + yy);
    let first = hat(&Vector3::new(x, y, 0.0));
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&rotary);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&first);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&-first);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&(Matrix3::identity() * mass));
    matrix
}

impl<C: Geometry> MassModel<C> for Density {
    /// ```math
    /// \int \rho\,(1, x, y)\, j\,dA, \qquad j = \nu^*_z + \omega^*_x y - \omega^*_y x
    /// ```
    ///
    /// A slice of a curved body is thicker on the outside: j is the volume per dA ds.
    fn line_mass(&self, section: &C, at: &Station) -> Result<LineMass> {
        let m = section.weighted_moments(at.s)?;
        let (xi, density) = (&at.reference.twist, self.0);
        let (nu, x_rate, y_rate) = (xi.linear.z, -xi.angular.y, xi.angular.x);
        let [first_x, first_y] = m.first;
        Ok(LineMass {
            mass: density * (nu * m.area + x_rate * first_x + y_rate * first_y),
            first: [
                density * (nu * first_x + x_rate * m.i_y + y_rate * m.i_xy),
                density * (nu * first_y + x_rate * m.i_xy + y_rate * m.i_x),
            ],
        })
    }

    /// ```math
    /// \int \rho\,(x^2, y^2, xy)\, j\,dA
    /// ```
    ///
    /// with j as above.
    fn inertia(&self, section: &C, at: &Station) -> Result<Matrix6<f64>> {
        let LineMass { mass, first } = self.line_mass(section, at)?;
        let m = section.weighted_moments(at.s)?;
        let xi = &at.reference.twist;
        let mut second = [m.i_y, m.i_x, m.i_xy].map(|moment| moment * xi.linear.z);
        let (x_rate, y_rate) = (-xi.angular.y, xi.angular.x);
        if x_rate != 0.0 || y_rate != 0.0 {
            let [xxx, xxy, xyy, yyy] = section.weighted_third_moments(at.s)?;
            second[0] += x_rate * xxx + y_rate * xxy;
            second[1] += x_rate * xyy + y_rate * yyy;
            second[2] += x_rate * xxy + y_rate * xyy;
        }
        Ok(inertia_matrix(mass, first, second.map(|moment| self.0 * moment)))
    }
}

impl<C> MassModel<C> for LineDensity {
    /// On the axis: a section known by its stiffness has no other place for it.
    fn line_mass(&self, _section: &C, _at: &Station) -> Result<LineMass> {
        Ok(LineMass { mass: self.0, first: [0.0; 2] })
    }

    /// Without rotary inertia: a line of points.
    fn inertia(&self, _section: &C, _at: &Station) -> Result<Matrix6<f64>> {
        Ok(inertia_matrix(self.0, [0.0; 2], [0.0; 3]))
    }
}

/// A body that knows its mass per length: what gravity requires.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no mass, and this load needs one",
    label = "needs a body with mass",
    note = "give the body a density: `Body::new(length, section)?.with_density(kg_per_m3)?`"
)]
pub trait HasMass {
    /// Mass and first moments per length of the reference at s.
    ///
    /// # Errors
    /// Where a size of the section is not what it must be.
    fn line_mass(&self, s: f64) -> Result<LineMass>;

    /// Mass per length of the reference at s, kg/m.
    ///
    /// # Errors
    /// As [`line_mass`](Self::line_mass).
    fn mass_per_length(&self, s: f64) -> Result<f64> {
        Ok(self.line_mass(s)?.mass)
    }

    /// The inertia matrix M per length of the reference at s, so that a slice that moves with the body velocity η has the momentum M η
    /// and the kinetic energy ½ ηᵀ M η per length.
    ///
    /// ```math
    /// M = \int \rho \begin{bmatrix} -\hat r\hat r & \hat r \\ -\hat r & 1 \end{bmatrix} dV/ds, \qquad r = (x, y, 0)
    /// ```
    ///
    /// Rows and columns (angular, linear): kg m, kg and kg/m.
    ///
    /// # Errors
    /// As [`line_mass`](Self::line_mass).
    fn inertia(&self, s: f64) -> Result<Matrix6<f64>>;
}

impl<C: CrossSection, M: MassModel<C>> HasMass for Body<C, M> {
    fn line_mass(&self, s: f64) -> Result<LineMass> {
        self.mass.line_mass(&self.section, &self.station(s))
    }

    fn inertia(&self, s: f64) -> Result<Matrix6<f64>> {
        self.mass.inertia(&self.section, &self.station(s))
    }
}
