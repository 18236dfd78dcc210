//! One place on the rod where a support, loads or a rigid body act: the two ends, and those between.

use nalgebra::{Matrix6, Vector3, Vector6};
use num_dual::Dual2_64;

use super::balance::inertia;
use super::place::{Amplitudes, Place};
use super::relation::{Offset, Rates, Relation};
use super::scene::{Movable, Scene};
use crate::error::Result;
use crate::lie::{Pose, Twist, TwistMap, Wrench, so3};
use crate::load::LoadWrench;
use crate::rod::adjoint::brought;
use crate::rod::support::{Condition, Equations};
use crate::rod::{Freedom, Support};

/// What acts on one section, and how the section moves.
pub(super) struct Mount {
    pub(super) place: Place,
    /// The node of the section; before the corner, where there is one.
    pub(super) node: usize,
    /// The pose of the section after the corner in the frame of the one before, with its Ad⁻¹.
    pub(super) corner: Option<(Pose, TwistMap)>,
    /// With its frame at the present time.
    pub(super) support: Support,
    /// Body velocity and acceleration of that frame.
    frame: [Twist; 2],
    pub(super) mass: Option<Matrix6<f64>>,
    pub(super) load: LoadWrench,
    /// What the support applies.
    pub(super) reaction: Wrench,
    /// Whether the scheme integrates the motion of the section.
    pub(super) follows: bool,
    pub(super) pose_before: Pose,
    pub(super) offset: Offset,
    pub(super) rates: Rates,
}

impl Mount {
    pub(super) fn new<B: Movable>(scene: &Scene<'_, B>, place: Place, node: usize) -> Self {
        let (support, mass) = (scene.support(place), scene.inertia(place));
        let free_base = place == Place::Base && !support.is_clamped();
        Self {
            place,
            node,
            corner: scene.corner(place).map(|corner| (corner, corner.adjoint_inverse())),
            support,
            frame: [Twist::zero(); 2],
            mass,
            load: LoadWrench::none(),
            reaction: Wrench::zero(),
            follows: free_base || (place != Place::Base && (mass.is_some() || !support.is_free())),
            pose_before: Pose::identity(),
            offset: Offset::zero(),
            rates: Rates::zero(),
        }
    }

    /// Whether the support has to be found a wrench: not at the base, whose pose is found instead.
    pub(super) fn reacts(&self) -> bool {
        self.place != Place::Base && !self.support.is_free()
    }

    /// Moves the frame of the support to where it is at a time.
    pub(super) fn at_time<B: Movable>(&mut self, scene: &Scene<'_, B>, time: f64) -> Result<()> {
        if let Some((pose, velocity, acceleration)) = scene.motion(self.place, time)? {
            self.support = self.support.with_frame(pose);
            self.frame = [velocity, acceleration];
        }
        Ok(())
    }

    /// The pose that a support gives which holds all six freedoms, and the rates of it.
    pub(super) fn given(&self) -> (Pose, Rates) {
        let pose = self.support.pose_at(&self.support.held());
        let inverse = (self.support.frame().inverse() * pose).adjoint_inverse();
        let [velocity, acceleration] = self.frame.map(|twist| inverse.apply(&twist));
        (pose, Rates { phi: Twist::zero(), slope: velocity, velocity, acceleration })
    }

    /// How fast the frame of the support moves, 1/s.
    pub(super) fn frame_speed(&self, length: f64) -> f64 {
        self.frame[0].angular.norm() + self.frame[0].linear.norm() / length
    }

    /// Velocity and acceleration of the section at a pose, by the scheme.
    #[inline]
    pub(super) fn move_to(&mut self, relation: &Relation, pose: &Pose) {
        if self.follows {
            self.rates = relation.rates(&self.pose_before, pose, &self.offset);
        }
    }

    pub(super) fn load_by<B: Movable>(
        &mut self,
        scene: &Scene<'_, B>,
        amplitudes: &Amplitudes,
        pose: &Pose,
    ) -> Result<()> {
        self.load = scene.point_load(amplitudes, self.place, pose)?;
        Ok(())
    }

    /// Loads less inertia.
    pub(super) fn force(&self, moving: bool) -> Wrench {
        match &self.mass {
            Some(mass) if moving => self.load.wrench - inertia(mass, &self.rates),
            _ => self.load.wrench,
        }
    }

    /// The derivative of that in a displacement of the section.
    pub(super) fn force_tangent(&self, relation: &Relation) -> Matrix6<f64> {
        let own = self.mass.map_or_else(Matrix6::zeros, |mass| relation.inertia_tangent(&mass, &self.rates));
        if relation.is_of_rates() { own } else { own + self.load.tangent }
    }

    /// The wrench before it from that after it.
    #[inline]
    pub(super) fn before(&self, after: &Wrench, moving: bool) -> Wrench {
        self.turned_back(after) + self.force(moving) + self.reaction
    }

    /// A wrench after the corner in the frame before it.
    #[inline]
    pub(super) fn turned_back(&self, after: &Wrench) -> Wrench {
        self.corner.as_ref().map_or(*after, |(corner, _)| brought(corner, after))
    }

    /// A twist before the corner in the frame after it.
    #[inline]
    pub(super) fn turned_on(&self, before: &Twist) -> Twist {
        self.corner.as_ref().map_or(*before, |(_, inverse)| inverse.apply(before))
    }

    /// The pose after the corner.
    #[inline]
    pub(super) fn after(&self, pose: &Pose) -> Pose {
        self.corner.as_ref().map_or(*pose, |(corner, _)| *pose * *corner)
    }

    /// What the support says of the section at a pose and of the wrench it applies. Where rates are sought, the displacement ζ stands for
    /// a change of them, and what is held says that its own rate vanishes.
    pub(super) fn equations(&self, pose: &Pose, reaction: &Wrench, relation: &Relation) -> Equations {
        let (zero, one) = (Matrix6::zeros(), Matrix6::identity());
        if self.support.is_free() {
            return Equations { residual: reaction.to_vector(), from_zeta: zero, from_wrench: one };
        }
        let impulse = *relation == Relation::Impulse;
        // a spring gives no impulse
        let support = if impulse { self.without_springs() } else { self.support };
        let mut rows = support.linearised(pose, reaction, &LoadWrench::none(), &support.held());
        if relation.is_of_rates() {
            let [_, speeds, seconds] = self.departure(pose);
            for (j, condition) in support.conditions().iter().enumerate() {
                match condition {
                    Condition::Fixed(_) => rows.residual[j] = if impulse { speeds[j] } else { seconds[j] },
                    _ => rows.from_zeta.row_mut(j).fill(0.0),
                }
            }
        }
        rows
    }

    fn without_springs(&self) -> Support {
        let sprung = |freedom: &Freedom| matches!(self.support.condition(*freedom), Condition::Spring { .. });
        self.support.releasing(Freedom::ALL.into_iter().filter(sprung))
    }

    /// The coordinates of the section against its support, less what is held, and their first and second derivatives in time.
    pub(super) fn departure(&self, pose: &Pose) -> [Vector6<f64>; 3] {
        let [frame_velocity, frame_acceleration] = self.frame;
        let frame = moving(self.support.frame(), &frame_velocity, &frame_acceleration);
        let section = moving(pose, &self.rates.velocity, &self.rates.acceleration);
        let relative = frame.inverse() * section;
        let (turn, place): (Vector3<Dual2_64>, _) = (so3::log(&relative.rotation), relative.position);
        let chi = Vector6::from([turn.x, turn.y, turn.z, place.x, place.y, place.z]);
        [chi.map(|c| c.re) - Vector6::from(self.support.held()), chi.map(|c| c.v1), chi.map(|c| c.v2)]
    }

    /// ∂χ/∂ζ, the derivative of all six coordinates in a displacement of the section.
    pub(super) fn coordinate_map(&self, pose: &Pose) -> Matrix6<f64> {
        let every = Support::clamped(*self.support.frame());
        every.linearised(pose, &Wrench::zero(), &LoadWrench::none(), &[0.0; 6]).from_zeta
    }
}

/// g exp(t η + t² η̇/2), whose body velocity and acceleration are η and η̇ now.
fn moving(pose: &Pose, velocity: &Twist, acceleration: &Twist) -> Pose<Dual2_64> {
    let (v, a) = (velocity.to_array(), acceleration.to_array());
    let path = Twist::from_array(std::array::from_fn(|c| Dual2_64::new(0.0, v[c], a[c])));
    pose.cast() * path.exp()
}
