//! Loads that say they are dead, against the same loads asked in every iteration.

use hyperrod::body::Constraint;
use hyperrod::load::{Buoyancy, DeadLoad, DeadWrench, Gravity, Load, LoadWrench};
use hyperrod::material::LinearElastic;
use hyperrod::rod::Support;
use hyperrod::section::{Circle, Composite, Geometry, Rectangle, Section, Shape};
use hyperrod::solve::{Order, StaticSolution, Statics};
use hyperrod::{Body, Pose, Result, Rod, Wrench};
use nalgebra::{Matrix3, Vector3, vector};

/// A load that keeps to itself that it is dead.
struct Silent<T>(T);

impl<B: ?Sized, T: Load<B>> Load<B> for Silent<T> {
    fn at(&self, body: &B, s: f64, pose: &Pose) -> Result<LoadWrench> {
        self.0.at(body, s, pose)
    }
}

type Bar = Body<Section<Circle, LinearElastic>, hyperrod::body::Density>;

fn bar() -> Bar {
    let section = Section::new(Circle::new(0.01), LinearElastic::new(1e7, 3.4e6).unwrap()).unwrap();
    Body::new(0.5, section).unwrap().with_density(1100.0).unwrap()
}

/// Weight, lift and a load that grows along the rod, told or not.
fn loaded(rod: Rod<Bar>, silent: bool, out_of_plane: f64) -> Rod<Bar> {
    let gravity = Gravity::new(vector![4.0, out_of_plane, -9.0]).unwrap();
    let lift = Buoyancy::new(400.0, vector![0.0, 0.0, -9.0]).unwrap();
    let growing = move |s: f64| Wrench::new(Vector3::zeros(), vector![3.0 * s, out_of_plane * s, 1.0 - s]);
    if silent {
        rod.with_load(Silent(gravity)).with_load(Silent(lift)).with_load(Silent(DeadLoad::varying(growing)))
    } else {
        rod.with_load(gravity).with_load(lift).with_load(DeadLoad::varying(growing))
    }
}

fn statics() -> Statics {
    Statics { elements: 7, order: Order::Six, ..Statics::default() }
}

/// The largest difference of positions, rotations, strains and wrenches, and of the energies against their size.
fn difference(a: &StaticSolution, b: &StaticSolution) -> f64 {
    let energies = (a.strain_energy() - b.strain_energy()).abs() / a.strain_energy()
        + (a.load_potential().unwrap() - b.load_potential().unwrap()).abs() / a.strain_energy();
    a.nodes().iter().zip(b.nodes()).fold(energies, |largest, (a, b)| {
        let pose = (a.pose.position - b.pose.position).norm() + (a.pose.rotation - b.pose.rotation).norm();
        let strain = (a.strain - b.strain).to_vector().norm() * 0.01;
        largest.max(pose).max(strain).max((a.wrench - b.wrench).to_vector().norm())
    })
}

#[test]
fn a_load_that_says_it_is_dead_gives_what_it_gives_when_asked_every_time() {
    let constraints = [
        (Constraint::none(), 1.5),
        (Constraint::kirchhoff(), 1.5),
        (Constraint::inextensible().and(Constraint::twist_free()), 1.5),
        (Constraint::planar(), 0.0),
        (Constraint::planar().and(Constraint::kirchhoff()), 0.0),
        // the reactions carry what is across the plane
        (Constraint::planar(), 1.5),
    ];
    for (constraint, out_of_plane) in constraints {
        for tip in [Support::free(), Support::pinned(Pose::new(Matrix3::identity(), vector![0.1, 0.0, 0.42]))]
        {
            let solve = |silent: bool| {
                let body = bar().with_constraint(constraint);
                let force = DeadWrench::force(vector![0.05, 0.0, 0.0]).unwrap();
                let rod = Rod::between(body, Support::clamped(Pose::identity()), tip);
                let rod = rod.with_point_load(0.3, force).unwrap();
                statics().solve(&loaded(rod, silent, out_of_plane)).unwrap()
            };
            let error = difference(&solve(false), &solve(true));
            // both ends of Newton's method, 1e-9 of the length apart at most, in wrenches of a newton
            assert!(error < 1e-9, "{constraint:?}: {error:.1e}");
        }
    }
}

#[test]
fn the_weight_of_a_symmetric_section_acts_on_its_axis_and_stays_in_its_plane() {
    let law = || LinearElastic::new(1e7, 3.4e6).unwrap();
    let square = || Section::new(Rectangle::new(0.012, 0.012), law()).unwrap();
    let at = |x: f64| Section::new(Circle::new(0.003).shifted(x, 0.0), law()).unwrap();
    let pair = Composite::new(at(0.1)).with(at(-0.1));
    let round = Section::new(Circle::new(0.01), law()).unwrap();
    for (name, moments) in [
        ("circle", round.moments(0.0).unwrap()),
        ("square", square().moments(0.0).unwrap()),
        ("pair", pair.moments(0.0).unwrap()),
    ] {
        assert!(moments.first == [0.0; 2] && moments.i_xy == 0.0, "{name}: {moments:?}");
    }
    // what is beside the axis stays there, however little
    let aside = Section::new(Circle::new(0.01).shifted(1e-12, 0.0), law()).unwrap().moments(0.0).unwrap();
    assert!((aside.centroid()[0] - 1e-12).abs() < 1e-16, "{:?}", aside.centroid());
}
