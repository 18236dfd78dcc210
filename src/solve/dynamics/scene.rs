use num_dual::Dual2_64;

use crate::body::{Dissipative, Elastic, HasMass};
use crate::error::{Error, Result};
use crate::lie::{Pose, Strain, Twist};
use crate::load::{Load, LoadWrench, TipLoad};
use crate::material::{Request, Response, Station};
use crate::rod::Rod;
use crate::section::{Actuated, Actuator, CrossSection};

/// A body that can move: elastic, with a mass, and damped or not.
///
/// It is not to be implemented: what has the three capabilities has it.
pub trait Movable: Elastic + HasMass + Dissipative {}

impl<B: Elastic + HasMass + Dissipative> Movable for B {}

type Amplitude = Box<dyn Fn(f64) -> f64 + Send + Sync>;
type Motion = Box<dyn Fn(Dual2_64) -> Pose<Dual2_64> + Send + Sync>;

/// How the first section of the rod moves.
enum Base {
    /// As the rod's clamp says: not at all.
    Clamped,
    /// As a function of time.
    Driven(Motion),
    /// Freely: no wrench acts on it but its load.
    Free,
}

/// A rod in motion: what the rod itself states, constant in time, and what depends on time.
///
/// ```
/// use hyperrod::load::{DeadWrench, Gravity};
/// use hyperrod::material::LinearElastic;
/// use hyperrod::section::{Circle, Section};
/// use hyperrod::solve::dynamics::{Dynamics, Scene, Start};
/// use hyperrod::{Body, Pose, Rod};
/// use nalgebra::vector;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let section = Section::new(Circle::new(0.01), LinearElastic::new(5e5, 1.7e5)?)?;
/// let body = Body::new(0.4, section)?.with_density(1000.0)?;
/// let rod = Rod::clamped(body, Pose::identity()).with_load(Gravity::standard());
/// // pulled sideways, harder and harder for a tenth of a second
/// let scene = Scene::new(&rod).with_tip_load(DeadWrench::force(vector![0.02, 0.0, 0.0])?, |t| (t / 0.1).min(1.0));
/// let end = Dynamics::default().run(&scene, &Start::at_rest(), 0.2, |_| ())?;
/// assert!(end.tip().pose.position.x > 0.005);
/// # Ok(()) }
/// ```
pub struct Scene<'r, B> {
    rod: &'r Rod<B>,
    base: Base,
    loads: Vec<(Box<dyn Load<B> + 'r>, Amplitude)>,
    tip_loads: Vec<(Box<dyn TipLoad + 'r>, Amplitude)>,
    actuators: Vec<(Actuated<Nothing>, Amplitude)>,
}

/// A section without any stiffness, for actuators to be added to.
struct Nothing;

impl CrossSection for Nothing {
    fn respond(&self, _at: &Station, _strain: &Strain, _request: Request) -> Result<Response> {
        Ok(Response::zero())
    }
}

impl<'r, B: Movable> Scene<'r, B> {
    /// The rod with its loads, clamped as it says.
    pub fn new(rod: &'r Rod<B>) -> Self {
        Self { rod, base: Base::Clamped, loads: Vec::new(), tip_loads: Vec::new(), actuators: Vec::new() }
    }

    /// The same with a load per length, multiplied by a function of time in s.
    pub fn with_load(
        mut self,
        load: impl Load<B> + 'r,
        amplitude: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.loads.push((Box::new(load), Box::new(amplitude)));
        self
    }

    /// The same with a load on the tip, multiplied by a function of time in s.
    pub fn with_tip_load(
        mut self,
        load: impl TipLoad + 'r,
        amplitude: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.tip_loads.push((Box::new(load), Box::new(amplitude)));
        self
    }

    /// The same with an actuator whose energy is multiplied by a function of time in s: a tendon of tension 1 N and its tension in N, a chamber
    /// and its pressure.
    ///
    /// An actuator that ends before the tip wants a node of the mesh there. Its energy counts as elastic.
    ///
    /// ```
    /// use hyperrod::load::Gravity;
    /// use hyperrod::section::{Stiffness, Tendon};
    /// use hyperrod::solve::dynamics::{Dynamics, Scene, Start};
    /// use hyperrod::{Body, Pose, Rod};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let body = Body::new(0.3, Stiffness::diagonal([4e-3, 4e-3, 3e-3, 50.0, 50.0, 150.0])?)?.with_mass_per_length(0.3)?;
    /// let rod = Rod::clamped(body, Pose::identity());
    /// let scene = Scene::new(&rod).with_actuator(Tendon::new([8e-3, 0.0], 1.0)?, |t| 2.0 * (t / 0.1).min(1.0));
    /// let frame = Dynamics::default().run(&scene, &Start::at_rest(), 0.1, |_| ())?;
    /// assert!(frame.tip().pose.position.x > 0.01); // pulled to the side of the tendon
    /// # Ok(()) }
    /// ```
    pub fn with_actuator(
        mut self,
        actuator: impl Actuator + 'static,
        amplitude: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.actuators.push((Actuated::new(Nothing).with_actuator(actuator), Box::new(amplitude)));
        self
    }

    /// The same with a clamp that moves: its pose in space as a function of time, over a number that brings the derivatives along.
    ///
    /// ```
    /// use hyperrod::num_dual::{Dual2_64, DualNum};
    /// use hyperrod::Pose;
    /// // shaken along X at 2 Hz
    /// let motion = |t: Dual2_64| {
    ///     let mut pose = Pose::identity();
    ///     pose.position.x = (t * (4.0 * std::f64::consts::PI)).sin() * 0.01;
    ///     pose
    /// };
    /// # let _ = motion(Dual2_64::from_re(0.0));
    /// ```
    pub fn with_base_motion(
        mut self,
        motion: impl Fn(Dual2_64) -> Pose<Dual2_64> + Send + Sync + 'static,
    ) -> Self {
        self.base = Base::Driven(Box::new(motion));
        self
    }

    /// The same without a clamp: a rod that flies. Its base starts where the clamp was.
    pub fn with_free_base(mut self) -> Self {
        self.base = Base::Free;
        self
    }

    /// The rod.
    pub fn rod(&self) -> &'r Rod<B> {
        self.rod
    }

    /// Refuses what rods at rest may declare and rods in motion may not.
    pub(super) fn check(&self) -> Result<()> {
        let refused = |what| Err(Error::NotModelled { what, solver: "dynamics" });
        let held = self.rod.base_support();
        if !held.is_clamped() || held.held() != [0.0; 6] {
            return refused("a base that is not clamped in the frame of its support");
        }
        if !self.rod.tip_support().is_free() {
            return refused("a support at the tip");
        }
        if !self.rod.joints().is_empty() {
            return refused("joints between the ends");
        }
        if !self.rod.body().constraint().is_none() {
            return refused("a body with fixed strains");
        }
        if self.is_free() && !self.rod.base_fixture().loads.is_empty() {
            return refused("a load on a free base");
        }
        Ok(())
    }

    pub(super) fn is_free(&self) -> bool {
        matches!(self.base, Base::Free)
    }

    /// Whether nothing acts on the rod, and nothing in it takes energy.
    pub(super) fn is_alone(&self) -> bool {
        let tip = self.tip_loads.is_empty() && self.rod.tip_fixture().loads.is_empty();
        let damped = self.rod.body().viscosity(0.0).is_ok_and(|viscosity| viscosity.is_some());
        self.is_free() && tip && self.actuators.is_empty() && !self.has_loads() && !damped
    }

    /// Pose, body velocity and body acceleration of the base.
    pub(super) fn base(&self, t: f64) -> Result<(Pose, Twist, Twist)> {
        let Base::Driven(motion) = &self.base else {
            return Ok((*self.rod.base(), Twist::zero(), Twist::zero()));
        };
        let (pose, velocity, acceleration) = motion(Dual2_64::from_re(t).derivative()).motion();
        let size = acceleration.to_vector().norm() + velocity.to_vector().norm() + pose.position.norm();
        let rotation = &pose.rotation;
        if size.is_finite() && (rotation.tr_mul(rotation) - nalgebra::Matrix3::identity()).norm() < 1e-9 {
            Ok((pose, velocity, acceleration))
        } else {
            let quantity = "motion of the base";
            Err(Error::Invalid { quantity, value: size, requirement: "finite, with a rotation matrix" })
        }
    }

    /// The amplitudes of the timed loads, per length and on the tip.
    pub(super) fn amplitudes(&self, t: f64, into: &mut Amplitudes) -> Result<()> {
        into.loads.clear();
        into.tip_loads.clear();
        into.loads.extend(self.loads.iter().map(|(_, amplitude)| amplitude(t)));
        into.tip_loads.extend(self.tip_loads.iter().map(|(_, amplitude)| amplitude(t)));
        into.actuators.clear();
        into.actuators.extend(self.actuators.iter().map(|(_, amplitude)| amplitude(t)));
        match into.loads.iter().chain(&into.tip_loads).chain(&into.actuators).find(|a| !a.is_finite()) {
            None => Ok(()),
            Some(&value) => Err(Error::Invalid {
                quantity: "amplitude of a load or actuator",
                value,
                requirement: "finite",
            }),
        }
    }

    pub(super) fn has_loads(&self) -> bool {
        !(self.loads.is_empty() && self.rod.loads().is_empty())
    }

    /// The response of the body and of the timed actuators.
    #[inline]
    pub(super) fn respond(
        &self,
        amplitudes: &Amplitudes,
        s: f64,
        strain: &Strain,
        request: Request,
    ) -> Result<Response> {
        let body = self.rod.body();
        let mut total = body.respond(s, strain, request)?;
        for ((actuator, _), &amplitude) in self.actuators.iter().zip(&amplitudes.actuators) {
            let station = Station { s, reference: body.reference(s) };
            let response = actuator.respond(&station, strain, request)?;
            total.energy += response.energy * amplitude;
            total.wrench += response.wrench * amplitude;
            total.tangent += response.tangent * amplitude;
        }
        Ok(total)
    }

    /// The load per length.
    pub(super) fn load(&self, amplitudes: &Amplitudes, s: f64, pose: &Pose) -> Result<LoadWrench> {
        let (body, mut total) = (self.rod.body(), none());
        for load in self.rod.loads() {
            add(&mut total, &load.at(body, s, pose)?, 1.0);
        }
        for ((load, _), &amplitude) in self.loads.iter().zip(&amplitudes.loads) {
            add(&mut total, &load.at(body, s, pose)?, amplitude);
        }
        checked(total, "distributed load", s)
    }

    /// The load on the tip.
    pub(super) fn tip_load(&self, amplitudes: &Amplitudes, pose: &Pose) -> Result<LoadWrench> {
        let mut total = none();
        for load in &self.rod.tip_fixture().loads {
            add(&mut total, &load.at(pose)?, 1.0);
        }
        for ((load, _), &amplitude) in self.tip_loads.iter().zip(&amplitudes.tip_loads) {
            add(&mut total, &load.at(pose)?, amplitude);
        }
        checked(total, "tip load", self.rod.body().length())
    }
}

impl<B> std::fmt::Debug for Scene<'_, B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (loads, tip_loads) = (self.loads.len(), self.tip_loads.len());
        f.debug_struct("Scene").field("loads", &loads).field("tip_loads", &tip_loads).finish_non_exhaustive()
    }
}

/// The amplitudes of the timed loads at one time.
#[derive(Clone, Debug, Default)]
pub(super) struct Amplitudes {
    loads: Vec<f64>,
    tip_loads: Vec<f64>,
    actuators: Vec<f64>,
}

pub(super) fn none() -> LoadWrench {
    use crate::lie::Wrench;
    LoadWrench { wrench: Wrench::zero(), tangent: nalgebra::Matrix6::zeros(), potential: Some(0.0) }
}

fn add(total: &mut LoadWrench, load: &LoadWrench, factor: f64) {
    total.wrench += load.wrench * factor;
    total.tangent += load.tangent * factor;
    total.potential = total.potential.zip(load.potential).map(|(a, b)| a + b * factor);
}

fn checked(load: LoadWrench, quantity: &'static str, s: f64) -> Result<LoadWrench> {
    let size = load.wrench.to_vector().norm() + load.tangent.norm();
    if size.is_finite() {
        return Ok(load);
    }
    Err(Error::InvalidAt { quantity, value: size, requirement: "finite", s })
}
