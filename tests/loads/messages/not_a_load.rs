// A number where a load should be.
use hyperrod::{Body, Pose, Rod, section::Stiffness};

fn main() {
    let body = Body::new(1.0, Stiffness::diagonal([1.0; 6]).unwrap()).unwrap();
    let _ = Rod::clamped(body, Pose::identity()).with_load(9.81);
}
