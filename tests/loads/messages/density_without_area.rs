// A density for a section that is known by its stiffness alone.
use hyperrod::{Body, Pose, Rod, load::Gravity, section::Stiffness};

fn main() {
    let section = Stiffness::diagonal([1.0; 6]).unwrap();
    let body = Body::new(1.0, section).unwrap().with_density(1000.0).unwrap();
    let _ = Rod::clamped(body, Pose::identity()).with_load(Gravity::standard());
}
