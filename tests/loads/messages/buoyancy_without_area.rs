// Lift on a section that is known by its stiffness alone.
use hyperrod::{Body, Pose, Rod, load::Buoyancy, section::Stiffness};

fn submerged(lift: Buoyancy) {
    let section = Stiffness::diagonal([1.0; 6]).unwrap();
    let body = Body::new(1.0, section).unwrap();
    let _ = Rod::clamped(body, Pose::identity()).with_load(lift);
}

fn main() {
    let _ = submerged;
}
