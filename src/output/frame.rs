use crate::solve::Node;
use crate::solve::dynamics::MovingStage;

/// A stage of a rod in motion as a state to write, without its velocities; the wrench is Ψ + V ξ̇ where the body is damped.
///
/// ```
/// use hyperrod::output::write_csv;
/// use hyperrod::solve::Node;
/// use hyperrod::solve::dynamics::{Dynamics, Scene, Start};
/// # use hyperrod::{Body, Pose, Rod, section::Stiffness};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let body = Body::new(0.3, Stiffness::diagonal([4e-3, 4e-3, 3e-3, 50.0, 50.0, 150.0])?)?.with_mass_per_length(0.3)?;
/// # let rod = Rod::clamped(body, Pose::identity());
/// let frame = Dynamics::default().run(&Scene::new(&rod), &Start::at_rest(), 0.02, |_| ())?;
/// let states: Vec<Node> = frame.stages.iter().map(Node::from).collect();
/// let mut table = Vec::new(); // or a `std::fs::File`
/// write_csv(&mut table, &states)?;
/// assert_eq!(table.iter().filter(|c| **c == b'\n').count(), 1 + frame.stages.len());
/// # Ok(()) }
/// ```
impl From<&MovingStage> for Node {
    fn from(stage: &MovingStage) -> Self {
        Self { s: stage.s, pose: stage.pose, strain: stage.strain, wrench: stage.wrench }
    }
}
