//! Places on a rod where something else than its length acts, and what acts there in a scene at a time.

use nalgebra::{Matrix3, Matrix6};
use num_dual::Dual2_64;

use super::scene::{Movable, Scene};
use crate::error::{Error, Result};
use crate::lie::{Pose, Strain, Twist};
use crate::load::LoadWrench;
use crate::material::{Request, Response, Station};
use crate::rod::Support;
use crate::rod::joint::{Fixture, Joint};
use crate::rod::support::Condition;
use crate::section::CrossSection;
use crate::solve::redundant::Redundant;

/// Where on the rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    Base,
    Between(f64),
    Tip,
}

/// The amplitudes of the timed loads at one time.
#[derive(Clone, Debug, Default)]
pub(super) struct Amplitudes {
    loads: Vec<f64>,
    point_loads: Vec<f64>,
    actuators: Vec<f64>,
}

/// The frame of a support with its body velocity and acceleration.
pub(super) type FrameMotion = (Pose, Twist, Twist);

impl<B: Movable> Scene<'_, B> {
    /// Refuses what makes no sense.
    pub(super) fn check(&self) -> Result<()> {
        for (place, _) in &self.motions {
            if self.support(*place).is_free() {
                let what = "the motion of a support where there is none";
                return Err(Error::NotModelled { what, solver: "dynamics" });
            }
        }
        let (body, base) = (self.rod.body(), self.rod.base());
        let xi = body.reference(0.0).twist;
        let mut timed = self.loads.iter().map(|(load, _)| load.rate(body, 0.0, base, &xi));
        if self.rod.has_rate_loads() || timed.any(|rate| !matches!(rate, Ok(None))) {
            let what = "a load that depends on the rate of the strain";
            return Err(Error::NotModelled { what, solver: "dynamics" });
        }
        Ok(())
    }

    /// The base, every place between where something acts, and the tip.
    pub(super) fn places(&self) -> Vec<Place> {
        let mut between: Vec<f64> = self.rod.joints().iter().map(|joint| joint.s).collect();
        between.extend(self.point_loads.iter().filter_map(|(place, ..)| match place {
            Place::Between(s) => Some(*s),
            _ => None,
        }));
        between.sort_by(f64::total_cmp);
        between.dedup();
        let between = between.into_iter().map(Place::Between);
        [Place::Base].into_iter().chain(between).chain([Place::Tip]).collect()
    }

    /// Where the mesh needs nodes that the rod does not ask for.
    pub(super) fn stops(&self) -> Vec<f64> {
        let mut stops: Vec<f64> =
            self.actuators.iter().flat_map(|(actuator, _)| actuator.breakpoints()).collect();
        stops.extend(self.places().iter().filter_map(|place| match place {
            Place::Between(s) => Some(*s),
            _ => None,
        }));
        stops
    }

    fn joint(&self, place: Place) -> Option<&Joint> {
        self.rod.joints().iter().find(|joint| place == Place::Between(joint.s))
    }

    fn fixture(&self, place: Place) -> Option<&Fixture> {
        match place {
            Place::Base => Some(self.rod.base_fixture()),
            Place::Between(_) => self.joint(place).map(|joint| &joint.fixture),
            Place::Tip => Some(self.rod.tip_fixture()),
        }
    }

    /// What holds the rod there, with its frame as the rod has it, as far as it holds something that fixed strains do not.
    pub(super) fn support(&self, place: Place) -> Support {
        if place == Place::Base && self.let_go {
            return Support::free();
        }
        let Some(support) = self.fixture(place).map(|fixture| fixture.support) else {
            return Support::free();
        };
        let base = self.rod.base_support();
        let redundant = Redundant::of(self.rod, &base.pose_at(&base.held())).filter(|_| !self.let_go);
        let joint = |s: f64| self.rod.joints().iter().position(|joint| joint.s == s);
        match (redundant, place) {
            (Some(redundant), Place::Tip) => redundant.at_tip(&support),
            (Some(redundant), Place::Between(s)) => {
                joint(s).map_or(support, |j| redundant.at_joint(j, &support))
            }
            _ => support,
        }
    }

    pub(super) fn corner(&self, place: Place) -> Option<Pose> {
        self.joint(place).map(|joint| joint.corner).filter(|corner| corner.rotation != Matrix3::identity())
    }

    /// The inertia of the rigid bodies there.
    pub(super) fn inertia(&self, place: Place) -> Option<Matrix6<f64>> {
        let own = self.fixture(place).into_iter().flat_map(|f| &f.loads).filter_map(|load| load.inertia());
        let timed = self.point_loads.iter().filter(|(at, ..)| *at == place);
        own.chain(timed.filter_map(|(_, load, _)| load.inertia())).reduce(|a, b| a + b)
    }

    /// The motion of the frame of the support there; `None` where it stands still.
    pub(super) fn motion(&self, place: Place, t: f64) -> Result<Option<FrameMotion>> {
        let Some((_, motion)) = self.motions.iter().find(|(at, _)| *at == place) else { return Ok(None) };
        let (pose, velocity, acceleration) = motion(Dual2_64::from_re(t).derivative()).motion();
        let size = acceleration.to_vector().norm() + velocity.to_vector().norm() + pose.position.norm();
        let rotation = &pose.rotation;
        if size.is_finite() && (rotation.tr_mul(rotation) - Matrix3::identity()).norm() < 1e-9 {
            Ok(Some((pose, velocity, acceleration)))
        } else {
            let quantity = "motion of a support";
            Err(Error::Invalid { quantity, value: size, requirement: "finite, with a rotation matrix" })
        }
    }

    /// Whether nothing acts on the rod, and nothing in it takes energy.
    pub(super) fn is_alone(&self) -> bool {
        let damped = self.rod.body().viscosity(0.0).is_ok_and(|viscosity| viscosity.is_some());
        let places = self.places();
        let touched = places.iter().any(|place| !self.support(*place).is_free() || self.is_loaded(*place));
        self.actuators.is_empty() && !touched && !self.has_loads() && !damped
    }

    /// Whether supports beyond the base or fixed strains take freedoms of motion away from the sections.
    pub(super) fn is_constrained(&self) -> bool {
        let holds = |place: &Place| {
            self.support(*place).conditions().iter().any(|c| matches!(c, Condition::Fixed(_)))
        };
        !self.rod.body().constraint().is_none() || self.places().iter().skip(1).any(holds)
    }

    fn is_loaded(&self, place: Place) -> bool {
        let own = self.fixture(place).is_some_and(|fixture| !fixture.loads.is_empty());
        own || self.point_loads.iter().any(|(at, ..)| *at == place)
    }

    /// The amplitudes of what varies in time.
    pub(super) fn amplitudes(&self, t: f64, into: &mut Amplitudes) -> Result<()> {
        into.loads.clear();
        into.point_loads.clear();
        into.actuators.clear();
        into.loads.extend(self.loads.iter().map(|(_, amplitude)| amplitude(t)));
        into.point_loads.extend(self.point_loads.iter().map(|(.., amplitude)| amplitude(t)));
        into.actuators.extend(self.actuators.iter().map(|(_, amplitude)| amplitude(t)));
        match into.loads.iter().chain(&into.point_loads).chain(&into.actuators).find(|a| !a.is_finite()) {
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
        let (body, mut total) = (self.rod.body(), LoadWrench::none());
        for load in self.rod.loads() {
            total.add_scaled(&load.at(body, s, pose)?, 1.0);
        }
        for ((load, _), &amplitude) in self.loads.iter().zip(&amplitudes.loads) {
            total.add_scaled(&load.at(body, s, pose)?, amplitude);
        }
        total.check("distributed load", s)?;
        Ok(total)
    }

    /// The load on one section.
    pub(super) fn point_load(
        &self,
        amplitudes: &Amplitudes,
        place: Place,
        pose: &Pose,
    ) -> Result<LoadWrench> {
        let mut total = LoadWrench::none();
        for load in self.fixture(place).into_iter().flat_map(|fixture| &fixture.loads) {
            total.add_scaled(&load.at(pose)?, 1.0);
        }
        for ((at, load, _), &amplitude) in self.point_loads.iter().zip(&amplitudes.point_loads) {
            if *at == place {
                total.add_scaled(&load.at(pose)?, amplitude);
            }
        }
        let s = match place {
            Place::Base => 0.0,
            Place::Between(s) => s,
            Place::Tip => self.rod.body().length(),
        };
        total.check("load on a section", s)?;
        Ok(total)
    }
}
