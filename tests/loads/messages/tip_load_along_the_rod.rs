// A wrench for the tip given as a load per length.
use hyperrod::{Body, Pose, Rod, load::DeadWrench, section::Stiffness};

fn pulled(wrench: DeadWrench) {
    let body = Body::new(1.0, Stiffness::diagonal([1.0; 6]).unwrap()).unwrap();
    let _ = Rod::clamped(body, Pose::identity()).with_load(wrench);
}

fn main() {
    let _ = pulled;
}
