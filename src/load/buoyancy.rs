use nalgebra::Vector3;

use super::dead_wrench::dead;
use super::{Load, LoadWrench};
use crate::body::HasArea;
use crate::error::{Result, finite, not_negative};
use crate::lie::{Pose, so3::hat};

/// Lift of a fluid at rest around the rod: per length of the reference, the weight of the fluid in the volume of the reference, upwards.
///
/// ```math
/// n = -\rho_f A\,R^{\mathsf T} g, \qquad m = -\rho_f\,A r_c \times R^{\mathsf T} g
/// ```
///
/// through the centroid r_c of the section. It is the lift of a rod wetted all round, both end faces included; that a stretched rod displaces another volume
/// is not in it.
///
/// It acts on bodies [whose area is known](HasArea), with or without mass; on another, a scene does not compile.
///
/// ```
/// use hyperrod::load::{Buoyancy, Gravity};
/// use hyperrod::{Body, Pose, Rod, material::LinearElastic, section::{Circle, Section}};
/// use nalgebra::vector;
/// # fn main() -> hyperrod::Result<()> {
/// let section = Section::new(Circle::new(0.01), LinearElastic::new(1e7, 3e6)?)?;
/// let body = Body::new(1.0, section)?.with_density(1100.0)?;
/// let rod = Rod::clamped(body, Pose::identity())
///     .with_load(Gravity::standard())
///     .with_load(Buoyancy::new(1000.0, vector![0.0, 0.0, -9.80665])?);
/// # let _ = rod; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Buoyancy {
    fluid_weight: Vector3<f64>,
}

impl Buoyancy {
    /// From the density of the fluid, kg/m³, and the acceleration of gravity in space, m/s².
    ///
    /// # Errors
    /// If the density is negative, or one of the numbers not finite.
    pub fn new(fluid_density: f64, acceleration: Vector3<f64>) -> Result<Self> {
        not_negative("density of the fluid", fluid_density)?;
        finite("component of the acceleration of gravity", &acceleration)?;
        Ok(Self { fluid_weight: acceleration * fluid_density })
    }
}

impl<B: HasArea> Load<B> for Buoyancy {
    fn at(&self, body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        let moments = body.area_moments(s)?;
        let lift = -self.fluid_weight;
        let (mut wrench, mut tangent) = dead(pose, &Vector3::zeros(), &(lift * moments.area));
        let first = Vector3::new(moments.first[0], moments.first[1], 0.0);
        let in_body = pose.rotation.tr_mul(&lift);
        wrench.moment += first.cross(&in_body);
        // δ(Rᵀ v) = (Rᵀ v) × w
        let moment_tangent = hat(&first) * hat(&in_body);
        tangent.fixed_view_mut::<3, 3>(0, 0).copy_from(&moment_tangent);
        let potential = -lift.dot(&pose.position) * moments.area - first.dot(&in_body);
        Ok(LoadWrench { wrench, tangent, potential: Some(potential) })
    }

    fn dead_force(&self, body: &B, s: f64) -> Result<Option<Vector3<f64>>> {
        let moments = body.area_moments(s)?;
        Ok((moments.first == [0.0; 2]).then(|| self.fluid_weight * -moments.area))
    }
}
