//! The same rod seen otherwise: turned, mirrored, in other units, solved twice.

use hyperrod::lie::se3;
use hyperrod::load::DeadWrench;
use hyperrod::rod::Support;
use hyperrod::section::Stiffness;
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Twist};
use nalgebra::{Matrix3, Vector3, vector};
use proptest::prelude::*;

/// A curved cantilever with a dead load, or the same between two clamps.
#[derive(Clone, Debug)]
struct Scene {
    length: f64,
    stiffness: [f64; 6],
    reference: [f64; 6],
    base: Pose,
    /// Where the tip is held.
    far: Option<Pose>,
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

impl Scene {
    fn solve(&self) -> StaticSolution {
        let section = Stiffness::diagonal(self.stiffness).unwrap();
        let curved = Twist::from_array(self.reference);
        let body = Body::new(self.length, section).unwrap().with_reference_strain(curved).unwrap();
        let tip = self.far.map_or_else(Support::free, Support::clamped);
        let rod = Rod::between(body, Support::clamped(self.base), tip);
        let rod = match self.far {
            None => rod.with_tip_load(DeadWrench::new(self.moment, self.force).unwrap()),
            Some(_) => {
                rod.with_point_load(0.4 * self.length, DeadWrench::force(self.force).unwrap()).unwrap()
            }
        };
        Statics { elements: 16, ..Statics::default() }.solve(&rod).unwrap()
    }

    fn turned(&self, by: &Pose) -> Self {
        let turn = by.rotation;
        let (force, moment) = (turn * self.force, turn * self.moment);
        Self { base: *by * self.base, far: self.far.map(|far| *by * far), force, moment, ..self.clone() }
    }

    /// x → −x in space and in every section.
    fn mirrored(&self) -> Self {
        let mut reference = self.reference;
        (1..4).for_each(|k| reference[k] = -reference[k]);
        let force = MIRROR.component_mul(&self.force);
        let moment = -MIRROR.component_mul(&self.moment);
        let far = self.far.as_ref().map(mirror);
        Self { reference, base: mirror(&self.base), far, force, moment, ..self.clone() }
    }

    /// In mm, g and s: lengths × 1e3, forces × 1e6.
    fn in_millimetres(&self) -> Self {
        let scaled = |pose: &Pose| Pose::new(pose.rotation, pose.position * 1e3);
        let unit = [1e12, 1e12, 1e12, 1e6, 1e6, 1e6];
        let mut reference = self.reference;
        (0..3).for_each(|k| reference[k] *= 1e-3);
        Self {
            length: 1e3 * self.length,
            stiffness: std::array::from_fn(|i| unit[i] * self.stiffness[i]),
            reference,
            base: scaled(&self.base),
            far: self.far.as_ref().map(scaled),
            force: self.force * 1e6,
            moment: self.moment * 1e9,
        }
    }
}

const MIRROR: Vector3<f64> = Vector3::new(-1.0, 1.0, 1.0);

fn mirror(pose: &Pose) -> Pose {
    let m = Matrix3::from_diagonal(&MIRROR);
    Pose::new(m * pose.rotation * m, m * pose.position)
}

/// The largest difference of poses and wrenches, the second mapped onto the first.
fn difference(a: &StaticSolution, b: &StaticSolution, map: impl Fn(&Pose) -> Pose, force: f64) -> f64 {
    assert_eq!(a.nodes().len(), b.nodes().len());
    let length = a.tip().s;
    let size = a
        .nodes()
        .iter()
        .fold(0.0_f64, |m, n| m.max(n.wrench.force.norm()).max(n.wrench.moment.norm() / length));
    let mut worst: f64 = 0.0;
    for (a, b) in a.nodes().iter().zip(b.nodes()) {
        let to = map(&b.pose);
        worst = worst.max((a.pose.position - to.position).norm() / length);
        worst = worst.max((a.pose.rotation - to.rotation).norm());
        worst = worst.max((a.wrench.force.norm() - b.wrench.force.norm() / force).abs() / size);
    }
    worst
}

fn scenes() -> impl Strategy<Value = Scene> {
    let signed = |size: f64| -size..size;
    let vector3 = move |size: f64| [signed(size), signed(size), signed(size)].prop_map(Vector3::from);
    let stiffness = (0.5..2.0, 0.5..2.0, 0.5..2.0, 200.0..2e3, 200.0..2e3, 500.0..5e3);
    let twist = (vector3(1.0), vector3(1.0));
    (stiffness, vector3(0.8), twist, vector3(1.5), vector3(0.5), any::<bool>()).prop_map(
        |(k, curved, (turn, place), force, moment, clamped)| {
            let base = se3::exp(&Twist::new(turn, place));
            let reference = [curved.x, curved.y, curved.z, 0.0, 0.0, 1.0];
            let rest = se3::exp(&(Twist::from_array(reference) * 0.7));
            let shift = Pose::new(Matrix3::identity(), vector![0.02, -0.03, 0.02]);
            let far = clamped.then(|| base * rest * shift);
            Scene { length: 0.7, stiffness: k.into(), reference, base, far, force, moment }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_rod_solved_twice_is_the_same_to_the_bit(scene in scenes()) {
        let (a, b) = (scene.solve(), scene.solve());
        prop_assert_eq!(a.nodes(), b.nodes());
        prop_assert_eq!(a.stages(), b.stages());
    }

    // Newton's last step is below 1e-9, what it leaves of the size of its square: 1e-10 has room for rounding, 1e-16 times a stiffness of 5e3
    #[test]
    fn a_turned_rod_is_the_rod_turned(scene in scenes(), by in scenes()) {
        let turned = scene.turned(&by.base).solve();
        let error = difference(&scene.solve(), &turned, |pose| by.base.inverse() * *pose, 1.0);
        prop_assert!(error < 1e-10, "{:e}", error);
    }

    #[test]
    fn a_mirrored_rod_is_the_rod_mirrored(scene in scenes()) {
        let error = difference(&scene.solve(), &scene.mirrored().solve(), mirror, 1.0);
        prop_assert!(error < 1e-10, "{:e}", error);
    }

    #[test]
    fn a_rod_in_millimetres_and_grams_is_the_rod(scene in scenes()) {
        let metres = |pose: &Pose| Pose::new(pose.rotation, pose.position * 1e-3);
        let error = difference(&scene.solve(), &scene.in_millimetres().solve(), metres, 1e6);
        prop_assert!(error < 1e-10, "{:e}", error);
    }
}
