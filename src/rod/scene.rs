use crate::body::Elastic;
use crate::lie::Pose;
use crate::load::{Load, TipLoad};

/// A rod: a body clamped at its base, free at its tip, with what acts on it.
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
///     .with_tip_load(DeadWrench::force(vector![0.1, 0.0, 0.0])?);
/// # let _ = rod; Ok(()) }
/// ```
pub struct Rod<B> {
    body: B,
    base: Pose,
    loads: Vec<Box<dyn Load<B>>>,
    tip_loads: Vec<Box<dyn TipLoad>>,
}

impl<B: Elastic> Rod<B> {
    /// A rod clamped at s = 0 in the given pose, free at s = L, without loads.
    pub fn clamped(body: B, base: Pose) -> Self {
        Self { body, base, loads: Vec::new(), tip_loads: Vec::new() }
    }

    /// The same with a load per length on it.
    pub fn with_load(mut self, load: impl Load<B> + 'static) -> Self {
        self.loads.push(Box::new(load));
        self
    }

    /// The same with a load on its tip.
    pub fn with_tip_load(mut self, load: impl TipLoad + 'static) -> Self {
        self.tip_loads.push(Box::new(load));
        self
    }

    /// The body.
    pub fn body(&self) -> &B {
        &self.body
    }

    /// The pose of the clamp.
    pub fn base(&self) -> &Pose {
        &self.base
    }

    pub(crate) fn loads(&self) -> &[Box<dyn Load<B>>] {
        &self.loads
    }

    pub(crate) fn tip_loads(&self) -> &[Box<dyn TipLoad>] {
        &self.tip_loads
    }
}

impl<B: std::fmt::Debug> std::fmt::Debug for Rod<B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Rod")
            .field("body", &self.body)
            .field("base", &self.base)
            .field("loads", &self.loads.len())
            .field("tip_loads", &self.tip_loads.len())
            .finish()
    }
}
