use super::linear::Buffers;

/// Memory for solves, kept from one to the next: iterations on meshes no larger than before allocate nothing.
///
/// ```
/// use hyperrod::solve::Workspace;
/// use hyperrod::{Body, Pose, Rod, Statics, load::DeadWrench, section::Stiffness};
/// use nalgebra::vector;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut workspace = Workspace::default();
/// for force in [0.5, 1.0, 1.5] {
///     let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
///     let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(vector![force, 0.0, 0.0])?);
///     let solution = Statics::to(1e-6).solve_in(&mut workspace, &rod)?;
///     assert!(solution.tip().pose.position.x > 0.1);
/// }
/// # Ok(()) }
/// ```
#[derive(Default)]
pub struct Workspace {
    one: Buffers<1>,
    two: Buffers<2>,
    three: Buffers<3>,
}

impl Workspace {
    pub(super) fn one(&mut self) -> &mut Buffers<1> {
        &mut self.one
    }

    pub(super) fn two(&mut self) -> &mut Buffers<2> {
        &mut self.two
    }

    pub(super) fn three(&mut self) -> &mut Buffers<3> {
        &mut self.three
    }
}

impl std::fmt::Debug for Workspace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Workspace").finish_non_exhaustive()
    }
}
