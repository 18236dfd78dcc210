// A load of another crate with a need of its own, on a body that does not meet it.
use hyperrod::load::{Load, LoadWrench};
use hyperrod::{Body, Pose, Result, Rod, section::Stiffness};

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no charge, and the field has nothing to pull at",
    label = "needs a charged body",
    note = "wrap it: `Charged { body, per_length }`"
)]
trait HasCharge {
    fn charge_per_length(&self, s: f64) -> f64;
}

struct Field;

impl<B: HasCharge> Load<B> for Field {
    fn at(&self, body: &B, s: f64, _pose: &Pose) -> Result<LoadWrench> {
        let _ = body.charge_per_length(s);
        unimplemented!()
    }
}

fn main() {
    let body = Body::new(1.0, Stiffness::diagonal([1.0; 6]).unwrap()).unwrap();
    let _ = Rod::clamped(body, Pose::identity()).with_load(Field);
}
