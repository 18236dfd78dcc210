use num_dual::Dual2_64;

use super::place::Place;
use crate::body::{Dissipative, Elastic, HasMass};
use crate::error::{Error, Result};
use crate::lie::{Pose, Strain};
use crate::load::{Load, TipLoad};
use crate::material::{Request, Response, Station};
use crate::rod::Rod;
use crate::section::{Actuated, Actuator, CrossSection};

/// A body that can move: elastic, with a mass, and damped or not.
///
/// It is not to be implemented: what has the three capabilities has it.
pub trait Movable: Elastic + HasMass + Dissipative {}

impl<B: Elastic + HasMass + Dissipative> Movable for B {}

pub(super) type Amplitude = Box<dyn Fn(f64) -> f64 + Send + Sync>;
pub(super) type Motion = Box<dyn Fn(Dual2_64) -> Pose<Dual2_64> + Send + Sync>;

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
    pub(super) rod: &'r Rod<B>,
    /// Whether the base is free, whatever the rod says.
    pub(super) let_go: bool,
    /// Of the frames of supports.
    pub(super) motions: Vec<(Place, Motion)>,
    pub(super) loads: Vec<(Box<dyn Load<B> + 'r>, Amplitude)>,
    pub(super) point_loads: Vec<(Place, Box<dyn TipLoad + 'r>, Amplitude)>,
    pub(super) actuators: Vec<(Actuated<Nothing>, Amplitude)>,
}

/// A section without any stiffness, for actuators to be added to.
pub(super) struct Nothing;

impl CrossSection for Nothing {
    fn respond(&self, _at: &Station, _strain: &Strain, _request: Request) -> Result<Response> {
        Ok(Response::zero())
    }
}

impl<'r, B: Movable> Scene<'r, B> {
    /// The rod with its loads, held as it says.
    pub fn new(rod: &'r Rod<B>) -> Self {
        let (motions, loads, point_loads, actuators) = Default::default();
        Self { rod, let_go: false, motions, loads, point_loads, actuators }
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
    ///
    /// The inertia that a load [brings along](TipLoad::inertia) is not multiplied: it is there all the time.
    pub fn with_tip_load(
        mut self,
        load: impl TipLoad + 'r,
        amplitude: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.point_loads.push((Place::Tip, Box::new(load), Box::new(amplitude)));
        self
    }

    /// The same with a load on the base, multiplied by a function of time in s. It acts on the freedoms that the support leaves free.
    pub fn with_base_load(
        mut self,
        load: impl TipLoad + 'r,
        amplitude: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.point_loads.push((Place::Base, Box::new(load), Box::new(amplitude)));
        self
    }

    /// The same with a load at s, multiplied by a function of time in s: there the mesh has a node, and the internal wrench jumps.
    ///
    /// # Errors
    /// If s does not lie inside (0, L).
    pub fn with_point_load(
        mut self,
        s: f64,
        load: impl TipLoad + 'r,
        amplitude: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Result<Self> {
        self.point_loads.push((self.between(s)?, Box::new(load), Box::new(amplitude)));
        Ok(self)
    }

    /// The same with an actuator whose energy is multiplied by a function of time in s: a tendon of tension 1 N and its tension in N, a chamber
    /// and its pressure.
    ///
    /// Where an actuator ends before the tip the mesh has a node. Its energy counts as elastic.
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

    /// The same with a support of the base, a clamp for instance, that moves: the pose of its frame in space as a function of time, over a number
    /// that brings the derivatives along.
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
        self,
        motion: impl Fn(Dual2_64) -> Pose<Dual2_64> + Send + Sync + 'static,
    ) -> Self {
        self.moving(Place::Base, Box::new(motion))
    }

    /// The same with a support of the tip that moves, as [`with_base_motion`](Self::with_base_motion): what it holds it holds in the moving frame.
    pub fn with_tip_motion(
        self,
        motion: impl Fn(Dual2_64) -> Pose<Dual2_64> + Send + Sync + 'static,
    ) -> Self {
        self.moving(Place::Tip, Box::new(motion))
    }

    /// The same with a support at s that moves, as [`with_base_motion`](Self::with_base_motion).
    ///
    /// # Errors
    /// If the rod has no support at s.
    pub fn with_support_motion(
        self,
        s: f64,
        motion: impl Fn(Dual2_64) -> Pose<Dual2_64> + Send + Sync + 'static,
    ) -> Result<Self> {
        if !self.rod.joints().iter().any(|joint| joint.s == s && !joint.fixture.support.is_free()) {
            let requirement = "a place where the rod has a support";
            return Err(Error::Invalid { quantity: "arc length of a moving support", value: s, requirement });
        }
        Ok(self.moving(Place::Between(s), Box::new(motion)))
    }

    /// The same without what holds the base: a rod that flies. Its base starts where the support was.
    pub fn with_free_base(mut self) -> Self {
        self.let_go = true;
        self
    }

    /// The rod.
    pub fn rod(&self) -> &'r Rod<B> {
        self.rod
    }

    fn moving(mut self, place: Place, motion: Motion) -> Self {
        self.motions.retain(|(other, _)| *other != place);
        self.motions.push((place, motion));
        self
    }

    fn between(&self, s: f64) -> Result<Place> {
        if s > 0.0 && s < self.rod.body().length() {
            return Ok(Place::Between(s));
        }
        let requirement = "inside (0, L), between the ends of the rod";
        Err(Error::Invalid { quantity: "arc length of a load", value: s, requirement })
    }
}

impl<B> std::fmt::Debug for Scene<'_, B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (loads, point_loads) = (self.loads.len(), self.point_loads.len());
        f.debug_struct("Scene")
            .field("loads", &loads)
            .field("point_loads", &point_loads)
            .finish_non_exhaustive()
    }
}
