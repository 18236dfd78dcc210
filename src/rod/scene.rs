use nalgebra::UnitQuaternion;

use super::Support;
use super::joint::{Fixture, Joint};
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::Pose;
use crate::load::{Load, TipLoad};

/// A rod: a body with what holds it at its two ends, what acts on it, and what it meets on the way.
///
/// A body at rest clamped at [`Pose::identity`] lies along +Z.
///
/// ```
/// use hyperrod::load::{DeadWrench, Gravity};
/// use hyperrod::material::LinearElastic;
/// use hyperrod::section::{Circle, Section};
/// use hyperrod::{Body, Pose, Rod};
/// use nalgebra::vector;
///
/// # fn main() -> hyperrod::Result<()> {
/// let section = Section::new(Circle::new(0.01), LinearElastic::new(1e7, 3e6)?)?;
/// let body = Body::new(1.0, section)?.with_density(1000.0)?;
/// let rod = Rod::clamped(body, Pose::identity())
///     .with_load(Gravity::standard())
///     .with_tip_load(DeadWrench::force(vector![0.1, 0.0, 0.0])?)
///     .with_point_load(0.4, DeadWrench::force(vector![0.0, 0.2, 0.0])?)?;
/// # let _ = rod; Ok(()) }
/// ```
pub struct Rod<B> {
    body: B,
    base: Fixture,
    tip: Fixture,
    loads: Vec<Box<dyn Load<B>>>,
    /// In the order of s.
    joints: Vec<Joint>,
}

impl<B: Elastic> Rod<B> {
    /// A rod clamped at s = 0 in the given pose, free at s = L, without loads.
    pub fn clamped(body: B, base: Pose) -> Self {
        Self::between(body, Support::clamped(base), Support::free())
    }

    /// A rod with a support at either end, without loads.
    ///
    /// A solve starts from the reference shape, placed by the first support that holds it: the frame of the base where it holds anything,
    /// else that of the tip. The frame of a ball joint thus says in which direction the rod leaves it at the start.
    pub fn between(body: B, base: Support, tip: Support) -> Self {
        Self { body, base: Fixture::new(base), tip: Fixture::new(tip), loads: Vec::new(), joints: Vec::new() }
    }

    /// The same with a load per length on it.
    pub fn with_load(mut self, load: impl Load<B> + 'static) -> Self {
        self.loads.push(Box::new(load));
        self
    }

    /// The same with a load on its tip, s = L.
    pub fn with_tip_load(mut self, load: impl TipLoad + 'static) -> Self {
        self.tip.loads.push(Box::new(load));
        self
    }

    /// The same with a load on its base, s = 0. It acts on the freedoms that the support leaves free.
    pub fn with_base_load(mut self, load: impl TipLoad + 'static) -> Self {
        self.base.loads.push(Box::new(load));
        self
    }

    /// The same with a load at s: the internal wrench jumps by it.
    ///
    /// # Errors
    /// If s does not lie inside (0, L).
    pub fn with_point_load(mut self, s: f64, load: impl TipLoad + 'static) -> Result<Self> {
        self.joint(s)?.fixture.loads.push(Box::new(load));
        Ok(self)
    }

    /// The same with a support at s: interior conditions on the pose. The internal wrench jumps by what the support gives.
    ///
    /// # Errors
    /// If s does not lie inside (0, L), or there is a support at s.
    pub fn with_support(mut self, s: f64, support: Support) -> Result<Self> {
        let held = &mut self.joint(s)?.fixture.support;
        if !held.is_free() {
            let requirement = "the place of one support only";
            return Err(Error::Invalid { quantity: "arc length of a support", value: s, requirement });
        }
        *held = support;
        Ok(self)
    }

    /// The same with a corner at s: the section after it is turned by `turn` in the frame of the section before it, for good.
    ///
    /// # Errors
    /// If s does not lie inside (0, L).
    pub fn with_corner(mut self, s: f64, turn: UnitQuaternion<f64>) -> Result<Self> {
        let corner = &mut self.joint(s)?.corner;
        corner.rotation *= turn.to_rotation_matrix().into_inner();
        Ok(self)
    }

    /// The joint at s.
    fn joint(&mut self, s: f64) -> Result<&mut Joint> {
        if !(s > 0.0 && s < self.body.length()) {
            let requirement = "inside (0, L), between the ends: those have `with_tip_load`, `with_base_load` and `Rod::between`";
            return Err(Error::Invalid { quantity: "arc length of a joint", value: s, requirement });
        }
        let place = self.joints.partition_point(|joint| joint.s < s);
        if self.joints.get(place).is_none_or(|joint| joint.s != s) {
            self.joints.insert(place, Joint::new(s));
        }
        Ok(&mut self.joints[place])
    }

    /// The body.
    pub fn body(&self) -> &B {
        &self.body
    }

    /// The frame of the support at the base: the pose of a clamp.
    pub fn base(&self) -> &Pose {
        self.base.support.frame()
    }

    /// The support at the base.
    pub fn base_support(&self) -> &Support {
        &self.base.support
    }

    /// The support at the tip.
    pub fn tip_support(&self) -> &Support {
        &self.tip.support
    }

    /// Whether a load depends on the strain and its rate; one that fails to say so fails again in a solve.
    pub(crate) fn has_rate_loads(&self) -> bool {
        let xi = self.body.reference(0.0).twist;
        self.loads.iter().any(|load| !matches!(load.rate(&self.body, 0.0, self.base(), &xi), Ok(None)))
    }

    pub(crate) fn loads(&self) -> &[Box<dyn Load<B>>] {
        &self.loads
    }

    pub(crate) fn base_fixture(&self) -> &Fixture {
        &self.base
    }

    pub(crate) fn tip_fixture(&self) -> &Fixture {
        &self.tip
    }

    pub(crate) fn joints(&self) -> &[Joint] {
        &self.joints
    }
}

impl<B: std::fmt::Debug> std::fmt::Debug for Rod<B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Rod")
            .field("body", &self.body)
            .field("base", &self.base.support)
            .field("tip", &self.tip.support)
            .field("loads", &self.loads.len())
            .field("joints", &self.joints.iter().map(|joint| joint.s).collect::<Vec<_>>())
            .finish()
    }
}
