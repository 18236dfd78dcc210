use nalgebra::{Matrix3, Matrix6, SVector, Vector3, Vector6};
use num_dual::{DualSVec64, jacobian};

use crate::error::{Error, Result};
use crate::lie::{Pose, Twist, Wrench, se3, so3};
use crate::load::LoadWrench;
use crate::scalar::Scalar;

/// One of the six ways a section can move against the frame of its [`Support`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Rotation about the x axis of the frame: first component of the rotation vector.
    RotationX,
    /// Rotation about the y axis of the frame.
    RotationY,
    /// Rotation about the z axis of the frame: twist, for a rod along it.
    RotationZ,
    /// Displacement along the x axis of the frame.
    X,
    /// Displacement along the y axis of the frame.
    Y,
    /// Displacement along the z axis of the frame: along the rod, where the frame is that of a section.
    Z,
}

impl Freedom {
    /// All six, in the order (angular, linear).
    pub const ALL: [Self; 6] = [Self::RotationX, Self::RotationY, Self::RotationZ, Self::X, Self::Y, Self::Z];

    fn is_rotation(self) -> bool {
        (self as usize) < 3
    }
}

/// What a support does to one freedom.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition {
    /// Nothing.
    Free,
    /// Holds it at a value, rad or m.
    Fixed(f64),
    /// Pushes it back to a value: −stiffness × (χ − rest), N m/rad or N/m.
    Spring {
        /// Stiffness, N m/rad or N/m; positive.
        stiffness: f64,
        /// Where it pushes to, rad or m.
        rest: f64,
    },
}

/// A rotation of less than this, rad, is not looked at from the other side: near a full turn rotation vectors are singular.
const TURNED: f64 = 1.0;

/// What holds a section of the rod: at its base, at its tip, or between.
///
/// Against the frame G of the support a section at g has the coordinates
///
/// ```math
/// \chi = \bigl(\log(R_G^{\mathsf T} R),\; R_G^{\mathsf T}(p - p_G)\bigr)
/// ```
///
/// and each of the six is free, held at a value, or on a spring. The rod finds the forces that do it. Of the rotation vectors of one rotation, which differ by
/// full turns, the one closest to the values held is meant.
///
/// ```
/// use hyperrod::rod::{Freedom, Support};
/// use hyperrod::{Body, Pose, Rod, Statics, section::Stiffness};
/// use nalgebra::{Matrix3, vector};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // a strip between two clamps 10 % closer than it is long: it buckles
/// let body = Body::new(1.0, Stiffness::diagonal([1.0, 4.0, 1.0, 1e4, 1e4, 3e4])?)?;
/// let far = Pose::new(Matrix3::identity(), vector![0.0, 0.0, 0.9]);
/// let rod = Rod::between(body, Support::clamped(Pose::identity()), Support::clamped(far));
/// # let _ = rod;
/// // a tip on a slide along x of its frame
/// let slide = Support::clamped(far).releasing([Freedom::X]);
/// # let _ = slide; Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    frame: Pose,
    conditions: [Condition; 6],
}

impl Support {
    /// None: the section is free.
    pub fn free() -> Self {
        Self { frame: Pose::identity(), conditions: [Condition::Free; 6] }
    }

    /// The section has the pose of the frame.
    pub fn clamped(frame: Pose) -> Self {
        Self { frame, conditions: [Condition::Fixed(0.0); 6] }
    }

    /// The point of the axis is held, the section turns freely: a ball joint. The orientation of the frame says where a solve starts.
    ///
    /// A straight rod between two ball joints can turn about itself: hold [`Freedom::RotationZ`] at one of them.
    pub fn pinned(frame: Pose) -> Self {
        Self::clamped(frame).releasing(&Freedom::ALL[..3])
    }

    /// The same with some freedoms released.
    pub fn releasing<F: std::borrow::Borrow<Freedom>>(
        mut self,
        freedoms: impl IntoIterator<Item = F>,
    ) -> Self {
        for freedom in freedoms {
            self.conditions[*freedom.borrow() as usize] = Condition::Free;
        }
        self
    }

    /// The same with one freedom held at a value, rad or m from the frame.
    ///
    /// # Errors
    /// If the value is not finite, or a rotation is π or more.
    pub fn holding(self, freedom: Freedom, value: f64) -> Result<Self> {
        let limit = if freedom.is_rotation() { std::f64::consts::PI } else { f64::INFINITY };
        if !(value.abs() < limit) {
            let requirement = if freedom.is_rotation() { "below half a turn" } else { "finite" };
            return Err(Error::Invalid { quantity: "value that a support holds", value, requirement });
        }
        Ok(self.with(freedom, Condition::Fixed(value)))
    }

    /// The same with a spring on one freedom: stiffness in N m/rad or N/m, at rest at the frame.
    ///
    /// # Errors
    /// If the stiffness is not positive and finite.
    pub fn with_spring(self, freedom: Freedom, stiffness: f64) -> Result<Self> {
        if !(stiffness > 0.0 && stiffness.is_finite()) {
            let quantity = "stiffness of a support's spring";
            return Err(Error::Invalid { quantity, value: stiffness, requirement: "positive and finite" });
        }
        Ok(self.with(freedom, Condition::Spring { stiffness, rest: 0.0 }))
    }

    fn with(mut self, freedom: Freedom, condition: Condition) -> Self {
        self.conditions[freedom as usize] = condition;
        self
    }

    /// The same in another frame.
    pub fn with_frame(self, frame: Pose) -> Self {
        Self { frame, ..self }
    }

    /// The frame.
    pub fn frame(&self) -> &Pose {
        &self.frame
    }

    /// What is done to a freedom.
    pub fn condition(&self, freedom: Freedom) -> Condition {
        self.conditions[freedom as usize]
    }

    pub(crate) fn conditions(&self) -> &[Condition; 6] {
        &self.conditions
    }

    pub(crate) fn is_free(&self) -> bool {
        self.conditions.iter().all(|c| *c == Condition::Free)
    }

    /// Whether all six freedoms are held.
    pub(crate) fn is_clamped(&self) -> bool {
        self.conditions.iter().all(|c| matches!(c, Condition::Fixed(_)))
    }

    /// The pose with the coordinates χ.
    pub(crate) fn pose_at(&self, chi: &[f64; 6]) -> Pose {
        let [a, b, c, x, y, z] = *chi;
        self.frame * Pose::new(so3::exp(&Vector3::new(a, b, c)), Vector3::new(x, y, z))
    }

    /// The coordinates χ of a pose.
    pub(crate) fn coordinates(&self, pose: &Pose) -> [f64; 6] {
        let relative = self.frame.inverse() * *pose;
        let (turn, place) = (self.turn(&relative.rotation, &self.held()), relative.position);
        [turn.x, turn.y, turn.z, place.x, place.y, place.z]
    }

    /// The rotation vector of a rotation against the frame. Those that differ by a full turn are the same rotation: the one closer to what is held is
    /// meant, and of two that are as close the shorter, so that a hinge goes on through half a turn.
    fn turn<D: Scalar>(&self, rotation: &Matrix3<D>, target: &[f64; 6]) -> Vector3<D> {
        let turn = so3::log(rotation);
        let size = turn.map(|t| t.re()).norm();
        if size < TURNED {
            return turn;
        }
        let norm = (turn.x * turn.x + turn.y * turn.y + turn.z * turn.z).sqrt();
        let other = turn * (D::one() - norm.recip() * std::f64::consts::TAU);
        let misfit = |turn: &Vector3<D>| -> f64 {
            let fixed = (0..3).filter(|&j| matches!(self.conditions[j], Condition::Fixed(_)));
            fixed.map(|j| (turn[j].re() - target[j]).powi(2)).sum()
        };
        if misfit(&other) < misfit(&turn) * (1.0 - 1e-9) { other } else { turn }
    }

    /// The values that the held freedoms have, 0 for the others.
    pub(crate) fn held(&self) -> [f64; 6] {
        self.conditions.map(|c| if let Condition::Fixed(value) = c { value } else { 0.0 })
    }

    /// Where it holds the axis of the rod; `None` where that can move.
    pub(crate) fn place_held(&self) -> Option<Vector3<f64>> {
        let held = self.conditions[3..].iter().all(|c| matches!(c, Condition::Fixed(_)));
        held.then(|| self.pose_at(&self.held()).position)
    }

    /// Potential energy of the springs, J.
    pub(crate) fn potential(&self, pose: &Pose) -> f64 {
        let chi = self.coordinates(pose);
        let energy = |(c, x): (&Condition, f64)| match c {
            Condition::Spring { stiffness, rest } => 0.5 * stiffness * (x - rest) * (x - rest),
            _ => 0.0,
        };
        self.conditions.iter().zip(chi).map(energy).sum()
    }

    /// The six equations of the support on a section at `pose` to which the support and the load together apply the wrench `applied`:
    /// χ_j − target_j where it holds, Q_j where it is free, Q_j + k (χ_j − rest) on a spring, with Q = (∂ζ/∂χ)ᵀ (applied − load).
    fn equations<D: Scalar>(&self, pose: &Pose<D>, reaction: &Wrench<D>, target: &[f64; 6]) -> SVector<D, 6> {
        let relative = self.frame.inverse().cast::<D>() * *pose;
        let (turn, place) = (self.turn(&relative.rotation, target), relative.position);
        // w = dexp₋φ φ̇, v = R_relᵀ ẋ; free about every axis, the moment itself vanishes, wherever the section has turned
        let released = self.conditions[..3].iter().all(|c| *c == Condition::Free);
        let moment = if released { reaction.moment } else { so3::dexp(&turn) * reaction.moment };
        let force = relative.rotation * reaction.force;
        let chi = [turn.x, turn.y, turn.z, place.x, place.y, place.z];
        let q = [moment.x, moment.y, moment.z, force.x, force.y, force.z];
        SVector::from_fn(|j, _| match self.conditions[j] {
            Condition::Free => q[j],
            Condition::Fixed(_) => chi[j] - target[j],
            Condition::Spring { stiffness, rest } => q[j] + (chi[j] - rest) * stiffness,
        })
    }

    /// The equations of the support and their derivatives in the displacement ζ of the section and in the applied wrench.
    pub(crate) fn linearised(
        &self,
        pose: &Pose,
        applied: &Wrench,
        load: &LoadWrench,
        target: &[f64; 6],
    ) -> Equations {
        let equations = |y: SVector<DualSVec64<12>, 12>| {
            let (zeta, d_wrench) = (y.fixed_rows::<6>(0).into_owned(), y.fixed_rows::<6>(6));
            let reaction = d_wrench - load.tangent.map(DualSVec64::from) * zeta;
            let reaction = reaction + (*applied - load.wrench).to_vector().map(DualSVec64::from);
            let moved = pose.cast() * se3::exp(&Twist::from_vector(&zeta));
            self.equations(&moved, &Wrench::from_vector(&reaction), target)
        };
        let (residual, slope) = jacobian(equations, &SVector::zeros());
        Equations {
            residual,
            from_zeta: slope.fixed_columns::<6>(0).into(),
            from_wrench: slope.fixed_columns::<6>(6).into(),
        }
    }
}

/// Six equations of a support and their derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Equations {
    pub(crate) residual: Vector6<f64>,
    /// ∂/∂ζ of the section.
    pub(crate) from_zeta: Matrix6<f64>,
    /// ∂/∂(applied wrench).
    pub(crate) from_wrench: Matrix6<f64>,
}
