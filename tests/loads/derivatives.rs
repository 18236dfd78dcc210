//! Every load: its tangent is the derivative of its wrench, its wrench minus that of its potential, and a closure is the load it writes.

use hyperrod::body::Density;
use hyperrod::lie::se3;
use hyperrod::load::*;
use hyperrod::material::LinearElastic;
use hyperrod::section::{Circle, Section, Shape, Shifted};
use hyperrod::{Body, Pose, Twist, Wrench};
use nalgebra::{Matrix6, Vector3, vector};
use num_dual::DualNum;

type Bar = Body<Section<Shifted<Circle>, LinearElastic>, Density>;

/// Its centroid is beside the axis.
fn body() -> Bar {
    let section =
        Section::new(Circle::new(0.02).shifted(0.01, -0.004), LinearElastic::new(1e6, 4e5).unwrap()).unwrap();
    Body::new(0.5, section).unwrap().with_density(1100.0).unwrap()
}

const PLACE: f64 = 0.2;

fn pose() -> Pose {
    se3::exp(&Twist::from_array([0.3, -0.7, 1.1, 0.1, 0.2, -0.3]))
}

fn moved(index: usize, step: f64) -> Pose {
    let mut zeta = [0.0; 6];
    zeta[index] = step;
    pose() * se3::exp(&Twist::from_array(zeta))
}

/// The battery for one load, given as a function of the pose.
fn holds(name: &str, conservative: bool, load: impl Fn(&Pose) -> LoadWrench) {
    let at = load(&pose());
    let size = at.wrench.to_vector().norm();
    let step = 1e-5;
    let difference = Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| {
        let (plus, minus) = (load(&moved(k, step)).wrench, load(&moved(k, -step)).wrench);
        (plus - minus).to_vector() / (2.0 * step)
    }));
    // step² = 1e-10 of the size, and rounding 1e-16/step
    let error = (at.tangent - difference).norm() / (size + at.tangent.norm());
    assert!(error < 1e-8, "{name}: tangent {error:.1e}");
    assert_eq!(at.potential.is_some(), conservative, "{name}");
    if let Some(potential) = at.potential {
        for k in 0..6 {
            let energy = |step: f64| load(&moved(k, step)).potential.unwrap();
            let slope = -(energy(step) - energy(-step)) / (2.0 * step);
            let error = (slope - at.wrench.to_array()[k]).abs() / (size + potential.abs());
            assert!(error < 1e-8, "{name}: potential, component {k}: {error:.1e}");
        }
    }
}

fn drag<D: DualNum<Primitive = f64> + Copy>(flow: Vector3<D>) -> Vector3<D> {
    let across = vector![flow.x, flow.y, D::zero()];
    across * (across.x * across.x + across.y * across.y).sqrt() * D::from(3.0)
}

fn current(pose: &Pose<LoadDual>) -> Wrench<LoadDual> {
    let flow = pose.rotation.tr_mul(&vector![0.4, -0.2, 0.1].map(LoadDual::from));
    Wrench::new(Vector3::zeros(), drag(flow))
}

const FORCE: Vector3<f64> = vector![2.0, -1.0, 0.5];
const MOMENT: Vector3<f64> = vector![0.1, 0.3, -0.2];
const SPRINGS: Vector3<f64> = vector![50.0, 20.0, 5.0];

#[test]
fn the_tangent_of_every_load_is_the_derivative_of_its_wrench() {
    let body = body();
    let on = |load: &dyn Load<Bar>, pose: &Pose| load.at(&body, PLACE, pose).unwrap();
    let both = Wrench::new(MOMENT, FORCE);
    let force = Wrench::new(Vector3::zeros(), FORCE);
    let gravity = Gravity::new(vector![1.0, -9.0, 3.0]).unwrap();
    let lift = Buoyancy::new(1000.0, vector![1.0, -9.0, 3.0]).unwrap();
    let springs = ElasticFoundation::new(SPRINGS, |s: f64| Vector3::z() * s).unwrap();
    let bed = potential(|s, pose: &Pose<PotentialDual>| {
        let p = pose.position;
        p.x * p.x * p.z * 3.0 + (p.y + s).sin() + pose.rotation[(0, 1)] * pose.rotation[(2, 2)] * 0.2
    });
    let loads: [(&str, bool, Box<dyn Load<Bar>>); 10] = [
        ("gravity", true, Box::new(gravity)),
        ("buoyancy", true, Box::new(lift)),
        ("dead force", true, Box::new(DeadLoad::new(force).unwrap())),
        ("dead wrench", false, Box::new(DeadLoad::new(both).unwrap())),
        ("dead function", false, Box::new(DeadLoad::varying(move |s: f64| both * (1.0 + s)))),
        ("follower", false, Box::new(FollowerLoad::new(both).unwrap())),
        ("follower function", false, Box::new(FollowerLoad::varying(move |s: f64| both * s))),
        ("foundation", true, Box::new(springs)),
        ("closure", false, Box::new(distributed(|_s, pose: &Pose<LoadDual>| current(pose)))),
        ("potential", true, Box::new(bed)),
    ];
    for (name, conservative, load) in &loads {
        holds(name, *conservative, |pose| on(load.as_ref(), pose));
    }
    let tips: [(&str, bool, Box<dyn TipLoad>); 5] = [
        ("dead tip force", true, Box::new(DeadWrench::force(FORCE).unwrap())),
        ("dead tip moment", false, Box::new(DeadWrench::moment(MOMENT).unwrap())),
        ("follower tip", false, Box::new(FollowerWrench::new(MOMENT, FORCE).unwrap())),
        ("tip closure", false, Box::new(at_tip(current))),
        (
            "tip potential",
            true,
            Box::new(potential_at_tip(|pose: &Pose<PotentialDual>| {
                pose.position.x * pose.position.y + pose.rotation[(1, 2)]
            })),
        ),
    ];
    for (name, conservative, load) in &tips {
        holds(name, *conservative, |pose| load.at(pose).unwrap());
    }
}

fn same(name: &str, a: &LoadWrench, b: &LoadWrench, potential: bool) {
    let size = a.wrench.to_vector().norm();
    // ten roundings or so
    assert!((a.wrench - b.wrench).to_vector().norm() < 1e-14 * size, "{name}");
    assert!((a.tangent - b.tangent).norm() < 1e-14 * (size + a.tangent.norm()), "{name}");
    if potential {
        assert!((a.potential.unwrap() - b.potential.unwrap()).abs() < 1e-14 * size, "{name}");
    }
}

/// Derivatives of closures against those written by hand.
#[test]
fn a_closure_is_the_load_that_it_writes() {
    let (body, pose) = (body(), pose());
    let dead = DeadLoad::new(Wrench::new(MOMENT, FORCE)).unwrap().at(&body, PLACE, &pose).unwrap();
    let closure = distributed(|_s, pose: &Pose<LoadDual>| {
        let turned = |v: Vector3<f64>| pose.rotation.tr_mul(&v.map(LoadDual::from));
        Wrench::new(turned(MOMENT), turned(FORCE))
    });
    same("dead", &dead, &closure.at(&body, PLACE, &pose).unwrap(), false);

    let springs = ElasticFoundation::new(SPRINGS, |s: f64| Vector3::z() * s).unwrap();
    let energy = potential(|s, pose: &Pose<PotentialDual>| {
        let d = pose.position - (Vector3::z() * s).map(PotentialDual::from);
        (d.x * d.x * SPRINGS.x + d.y * d.y * SPRINGS.y + d.z * d.z * SPRINGS.z) * 0.5
    });
    let springs = springs.at(&body, PLACE, &pose).unwrap();
    same("springs", &springs, &energy.at(&body, PLACE, &pose).unwrap(), true);

    use hyperrod::body::HasMass;
    let weight = vector![1.0, -9.0, 3.0];
    let hung = distributed_on(move |body: &Bar, s, pose: &Pose<LoadDual>| {
        let line = body.line_mass(s)?;
        let pull = pose.rotation.tr_mul(&weight.map(LoadDual::from));
        let arm = vector![line.first[0], line.first[1], 0.0].map(LoadDual::from);
        Ok(Wrench::new(arm.cross(&pull), pull * LoadDual::from(line.mass)))
    });
    let gravity = Gravity::new(weight).unwrap().at(&body, PLACE, &pose).unwrap();
    same("gravity", &gravity, &hung.at(&body, PLACE, &pose).unwrap(), false);
}
