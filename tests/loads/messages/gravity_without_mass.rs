// A weight on a body that was given no density.
use hyperrod::{Body, Pose, Rod, load::Gravity, section::Stiffness};

fn main() {
    let section = Stiffness::diagonal([1.0; 6]).unwrap();
    let body = Body::new(1.0, section).unwrap();
    let _ = Rod::clamped(body, Pose::identity()).with_load(Gravity::standard());
}
