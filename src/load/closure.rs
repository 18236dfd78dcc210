//! Loads from a closure over dual numbers: the derivatives follow from it.

use nalgebra::{Const, Matrix6, U1};
use num_dual::{Dual2SVec64, DualSVec64};

use super::{Load, LoadWrench, TipLoad};
use crate::error::Result;
use crate::lie::{Pose, Twist, Wrench, se3};

/// The dual number a load of the pose is written over: a value, and its derivatives in the displacement ζ of the section.
pub type LoadDual = DualSVec64<6>;

/// The dual number a potential of the pose is written over: a value with first and second derivatives.
pub type PotentialDual = Dual2SVec64<6>;

/// A load per length, or on the tip, from a closure of the pose.
#[derive(Clone, Copy, Debug)]
pub struct LoadClosure<F>(F);

/// A load per length from a closure of the body and the pose.
#[derive(Clone, Copy, Debug)]
pub struct BodyLoadClosure<F>(F);

/// A load per length, or on the tip, from a closure that gives its potential energy.
#[derive(Clone, Copy, Debug)]
pub struct PotentialClosure<F>(F);

/// A load per length of the reference as a closure of s and the pose, in the body frame: N and N/m.
///
/// ```
/// use hyperrod::load::{LoadDual, distributed};
/// use hyperrod::{Pose, Wrench};
/// use nalgebra::{Vector3, vector};
///
/// // a steady current along X on a rod 10 mm thick: drag of the flow across the axis, ½ ρ c d |u| u
/// let drag = distributed(|_s, pose: &Pose<LoadDual>| {
///     let flow = pose.rotation.tr_mul(&vector![0.4, 0.0, 0.0].map(LoadDual::from));
///     let across = vector![flow.x, flow.y, LoadDual::from(0.0)];
///     let speed = (across.dot(&across) + 1e-12).sqrt();
///     Wrench::new(Vector3::zeros(), across * (speed * (0.5 * 1000.0 * 1.1 * 0.01)))
/// });
/// # use num_dual::DualNum;
/// # let rod = hyperrod::Rod::clamped(
/// #     hyperrod::Body::new(1.0, hyperrod::section::Stiffness::diagonal([1.0; 6]).unwrap()).unwrap(), Pose::identity());
/// # let _ = rod.with_load(drag);
/// ```
pub fn distributed<F>(load: F) -> LoadClosure<F>
where
    F: Fn(f64, &Pose<LoadDual>) -> Wrench<LoadDual> + Send + Sync,
{
    LoadClosure(load)
}

/// As [`distributed`], for a load that asks something of the body; it may fail.
///
/// ```
/// use hyperrod::body::HasArea;
/// use hyperrod::load::{LoadDual, distributed_on};
/// use hyperrod::{Body, Pose, Rod, Wrench};
/// use hyperrod::{material::LinearElastic, section::{Circle, Section}};
/// use nalgebra::{Vector3, vector};
/// # fn main() -> hyperrod::Result<()> {
/// # let body = Body::new(1.0, Section::new(Circle::new(0.01), LinearElastic::new(1e7, 3e6)?)?)?;
/// // a lift in proportion to the area of the section
/// fn lift<B: HasArea>(body: &B, s: f64, pose: &Pose<LoadDual>) -> hyperrod::Result<Wrench<LoadDual>> {
///     let force = vector![0.0, 0.0, 9e3 * body.area_moments(s)?.area].map(LoadDual::from);
///     Ok(Wrench::new(Vector3::zeros(), pose.rotation.tr_mul(&force)))
/// }
/// let rod = Rod::clamped(body, Pose::identity()).with_load(distributed_on(lift));
/// # let _ = rod; Ok(()) }
/// ```
pub fn distributed_on<B: ?Sized, F>(load: F) -> BodyLoadClosure<F>
where
    F: Fn(&B, f64, &Pose<LoadDual>) -> Result<Wrench<LoadDual>> + Send + Sync,
{
    BodyLoadClosure(load)
}

/// A wrench on the tip as a closure of its pose, in the body frame: N m and N.
pub fn at_tip<F>(load: F) -> LoadClosure<F>
where
    F: Fn(&Pose<LoadDual>) -> Wrench<LoadDual> + Send + Sync,
{
    LoadClosure(load)
}

/// A conservative load per length as a closure that gives its potential energy per length, J/m, at s and a pose.
///
/// ```math
/// \bar f = -\frac{\partial V}{\partial \zeta}, \qquad g \to g \exp\hat\zeta
/// ```
///
/// ```
/// use hyperrod::load::{PotentialDual, potential};
/// use hyperrod::Pose;
///
/// // an elastic bed at Z = 0 that also holds what leaves it upwards
/// let bed = potential(|_s, pose: &Pose<PotentialDual>| pose.position.z * pose.position.z * (0.5 * 2e3));
/// # let _ = bed;
/// ```
pub fn potential<F>(energy: F) -> PotentialClosure<F>
where
    F: Fn(f64, &Pose<PotentialDual>) -> PotentialDual + Send + Sync,
{
    PotentialClosure(energy)
}

/// A conservative load on the tip as a closure that gives its potential energy, J, at a pose.
pub fn potential_at_tip<F>(energy: F) -> PotentialClosure<F>
where
    F: Fn(&Pose<PotentialDual>) -> PotentialDual + Send + Sync,
{
    PotentialClosure(energy)
}

/// g exp ζ^ to first order in ζ: R(1 + w^), p + R v.
fn displaced(pose: &Pose) -> Pose<LoadDual> {
    let zeta: [LoadDual; 6] = std::array::from_fn(|i| LoadDual::from_re(0.0).derivative(i));
    let zeta = Twist::from_array(zeta);
    let pose: Pose<LoadDual> = pose.cast();
    let rotation = pose.rotation + pose.rotation * crate::lie::so3::hat(&zeta.angular);
    Pose::new(rotation, pose.position + pose.rotation * zeta.linear)
}

/// Value and derivatives of a wrench.
fn unpack(wrench: Wrench<LoadDual>) -> LoadWrench {
    let entries = wrench.to_array();
    let mut tangent = Matrix6::zeros();
    for (r, entry) in entries.iter().enumerate() {
        tangent.set_row(r, &entry.eps.unwrap_generic(Const::<6>, U1).transpose());
    }
    LoadWrench { wrench: Wrench::from_array(entries.map(|v| v.re)), tangent, potential: None }
}

/// From V(g exp ζ^): with H = ∂²V/∂ζ², and exp ζ exp ζ′ = exp(ζ + ζ′ + ½[ζ, ζ′] + …),
///
/// W_i = −V_i, ∂W_i/∂ζ_k = −H_ik − ½ Σ_j V_j [e_k, e_i]_j.
fn from_potential(energy: PotentialDual) -> LoadWrench {
    let gradient = energy.v1.unwrap_generic(U1, Const::<6>);
    let hessian = energy.v2.unwrap_generic(Const::<6>, Const::<6>);
    let slope = Wrench::from_array(std::array::from_fn(|i| gradient[i]));
    let unit = |i: usize| Twist::from_array(std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let tangent = Matrix6::from_fn(|i, k| -hessian[(i, k)] - 0.5 * unit(k).bracket(&unit(i)).pair(&slope));
    LoadWrench { wrench: -slope, tangent, potential: Some(energy.re) }
}

fn displaced_twice(pose: &Pose) -> Pose<PotentialDual> {
    let zeta = std::array::from_fn(|i| PotentialDual::from_re(0.0).derivative(i));
    pose.cast() * se3::exp(&Twist::from_array(zeta))
}

impl<B: ?Sized, F> Load<B> for LoadClosure<F>
where
    F: Fn(f64, &Pose<LoadDual>) -> Wrench<LoadDual> + Send + Sync,
{
    fn at(&self, _body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        Ok(unpack((self.0)(s, &displaced(pose))))
    }
}

impl<B: ?Sized, F> Load<B> for BodyLoadClosure<F>
where
    F: Fn(&B, f64, &Pose<LoadDual>) -> Result<Wrench<LoadDual>> + Send + Sync,
{
    fn at(&self, body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        Ok(unpack((self.0)(body, s, &displaced(pose))?))
    }
}

impl<F> TipLoad for LoadClosure<F>
where
    F: Fn(&Pose<LoadDual>) -> Wrench<LoadDual> + Send + Sync,
{
    fn at(&self, pose: &Pose) -> Result<LoadWrench> {
        Ok(unpack((self.0)(&displaced(pose))))
    }
}

impl<B: ?Sized, F> Load<B> for PotentialClosure<F>
where
    F: Fn(f64, &Pose<PotentialDual>) -> PotentialDual + Send + Sync,
{
    fn at(&self, _body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        Ok(from_potential((self.0)(s, &displaced_twice(pose))))
    }
}

impl<F> TipLoad for PotentialClosure<F>
where
    F: Fn(&Pose<PotentialDual>) -> PotentialDual + Send + Sync,
{
    fn at(&self, pose: &Pose) -> Result<LoadWrench> {
        Ok(from_potential((self.0)(&displaced_twice(pose))))
    }
}
