//! `suggest` against the models themselves: every rung of a scene is solved as well, and its distance from the scene is the oracle.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use hyperrod::body::{Constraint, LineDensity};
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::{LinearElastic, NeoHookean, Station};
use hyperrod::rod::{Freedom, Support};
use hyperrod::section::{Circle, CrossSection, Relaxed, Section, Stiffness, Warping};
use hyperrod::solve::{ModelLadder, ModelRung, Order, Reason, Suggestion, suggest};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Strain};
use nalgebra::vector;

type Beam = Body<Box<dyn CrossSection>, LineDensity>;

/// A scene with the sections that its rungs may have: `own section`, and maybe `rigid`.
struct Scene {
    length: f64,
    own: fn() -> Box<dyn CrossSection>,
    rigid: Option<fn() -> Box<dyn CrossSection>>,
    mass_per_length: f64,
    dress: fn(Beam) -> Rod<Beam>,
}

const CIRCLE: f64 = 0.025; // m, of the thick arm

fn rubber() -> NeoHookean {
    NeoHookean::from_young(600e3, 0.4).unwrap()
}

/// L/r = 8, relaxed, under its weight and a force across that with a small torque.
fn thick_arm() -> Scene {
    Scene {
        length: 0.2,
        own: || {
            Box::new(
                Relaxed::new(Circle::new(CIRCLE), rubber()).unwrap().with_warping(Warping::SHEAR).unwrap(),
            )
        },
        rigid: Some(|| Box::new(Section::new(Circle::new(CIRCLE), rubber()).unwrap())),
        mass_per_length: 2.1,
        dress: |body| {
            let tip = DeadWrench::new(vector![0.0, 0.0, 0.02], vector![0.0, 1.0, 0.3]).unwrap();
            Rod::clamped(body, Pose::identity())
                .with_load(Gravity::new(vector![-9.81, 0.0, 0.0]).unwrap())
                .with_tip_load(tip)
        },
    }
}

/// L/r = 1000, bent far out of a plane: PL²/EI = 6.
fn catheter() -> Scene {
    Scene {
        length: 1.0,
        own: || Box::new(Section::new(Circle::new(1e-3), LinearElastic::new(100e6, 35e6).unwrap()).unwrap()),
        rigid: None,
        mass_per_length: 2e-5, // in a fluid that carries most of it
        dress: |body| {
            let bending = 100e6 * std::f64::consts::PI * 1e-12 / 4.0;
            let tip =
                DeadWrench::new(vector![0.0, 0.0, 2.0 * bending], vector![6.0, 2.0, -1.0] * bending).unwrap();
            Rod::clamped(body, Pose::identity())
                .with_load(Gravity::new(vector![0.0, -9.81, 0.0]).unwrap())
                .with_tip_load(tip)
        },
    }
}

/// L/r = 167, deflected by some percent in the xz plane.
fn steel_rod() -> Scene {
    Scene {
        length: 0.5,
        own: || {
            let steel = NeoHookean::new(80e9, 40e9).unwrap();
            Box::new(Section::new(Circle::new(3e-3), steel).unwrap())
        },
        rigid: None,
        mass_per_length: 0.22,
        dress: |body| {
            Rod::clamped(body, Pose::identity())
                .with_load(Gravity::new(vector![-9.81, 0.0, 0.0]).unwrap())
                .with_tip_load(DeadWrench::force(vector![10.0, 0.0, 5.0]).unwrap())
        },
    }
}

/// Clamped, on a ball joint that slides at its other end, through a ring between, with a point load: wrenches that no balance gives.
fn propped() -> Scene {
    Scene {
        length: 0.2,
        own: || Box::new(Section::new(Circle::new(0.015), LinearElastic::new(1e6, 0.35e6).unwrap()).unwrap()),
        rigid: None,
        mass_per_length: 0.5,
        dress: |body| {
            let end = Pose::new(nalgebra::Matrix3::identity(), vector![0.01, 0.0, 0.198]);
            let middle = Pose::new(nalgebra::Matrix3::identity(), vector![0.002, 0.003, 0.08]);
            let slide = Support::clamped(middle).releasing(&Freedom::ALL[..3]).releasing([Freedom::Z]);
            Rod::between(
                body,
                Support::clamped(Pose::identity()),
                Support::pinned(end).releasing([Freedom::Z]),
            )
            .with_support(0.08, slide)
            .unwrap()
            .with_point_load(0.14, DeadWrench::force(vector![2.0, 3.0, 0.0]).unwrap())
            .unwrap()
        },
    }
}

impl Scene {
    fn rod(&self, section: Box<dyn CrossSection>, constraint: Constraint) -> Rod<Beam> {
        let body = Body::new(self.length, section).unwrap().with_constraint(constraint);
        (self.dress)(body.with_mass_per_length(self.mass_per_length).unwrap())
    }

    fn whole(&self) -> Rod<Beam> {
        self.rod((self.own)(), Constraint::none())
    }

    fn suggestion(&self, rod: &Rod<Beam>, tolerance: f64) -> Suggestion {
        let ladder = ModelLadder::of(rod);
        let ladder = match self.rigid {
            Some(rigid) => ladder.with_section("rigid", rigid()).unwrap(),
            None => ladder,
        };
        ladder.suggest(tolerance).unwrap()
    }

    /// The rung itself, solved.
    fn solve(&self, rung: &ModelRung) -> Option<StaticSolution> {
        let section: Box<dyn CrossSection> = match rung.section.as_str() {
            "own section" => (self.own)(),
            "rigid" => self.rigid.unwrap()(),
            _ => {
                let tangent = (self.own)().tangent(&Station::straight(0.0), &Strain::zero()).unwrap();
                let symmetric = 0.5 * (tangent + tangent.transpose());
                Box::new(Stiffness::new(symmetric).unwrap())
            }
        };
        solve(&self.rod(section, rung.constraint))
    }
}

fn solve(rod: &Rod<Beam>) -> Option<StaticSolution> {
    Statics { elements: 16, order: Order::Six, ..Statics::default() }.solve(rod).ok()
}

/// The largest displacement / L or rotation between the nodes of two answers on one mesh.
fn distance(a: &StaticSolution, b: &StaticSolution, length: f64) -> f64 {
    a.nodes().iter().zip(b.nodes()).fold(0.0, |worst, (a, b)| {
        let turn = (a.pose.inverse() * b.pose).log().angular.norm();
        worst.max((a.pose.position - b.pose.position).norm() / length).max(turn)
    })
}

/// Rungs with their true errors.
fn measured(scene: &Scene, suggestion: &Suggestion) -> Vec<(ModelRung, f64)> {
    let whole = solve(&scene.whole()).unwrap();
    // a rod that has no such answer at all, as one held out of the only plane it may bend in, is as far as can be
    let far = f64::INFINITY;
    let truth =
        |rung: &ModelRung| scene.solve(rung).map_or(far, |found| distance(&found, &whole, scene.length));
    suggestion.rungs().iter().map(|rung| (rung.clone(), truth(rung))).collect()
}

/// Every estimate against the truth, and every choice: its true error is below the tolerance.
///
/// The estimate is of first order: a displacement of x makes it wrong by x relatively, and between supports by what the forces there change with the
/// compliance that is left out, which `apart` bounds; 2 % are for the meshes, whose nodes differ. Below 1e-9 the truth is a difference of two answers' rounding; beyond 0.2 the
/// estimate is only asked to be large.
fn check(scene: &Scene, apart: f64) {
    let rod = scene.whole();
    let suggestion = scene.suggestion(&rod, 1e-7);
    let measured = measured(scene, &suggestion);
    let mut compared = 0;
    for (rung, truth) in &measured {
        let estimate = rung.error.size(scene.length);
        if *truth > 1e-9 && *truth < 0.2 {
            assert!((estimate / truth - 1.0).abs() < apart + truth, "{rung:?}: truth {truth:.1e}");
            compared += 1;
        }
        if *truth >= 0.2 {
            assert!(estimate > 0.02, "{rung:?}: truth {truth:.1e}");
        }
        if *truth <= 1e-9 {
            assert!(estimate < 1e-8, "{rung:?}: truth {truth:.1e}");
        }
    }
    assert!(compared >= 3);
    for tolerance in [1e-2, 1e-3, 1e-5] {
        let suggestion = scene.suggestion(&rod, tolerance);
        let chosen = suggestion.chosen();
        let (_, truth) = measured
            .iter()
            .find(|(rung, _)| (&rung.section, rung.constraint) == (&chosen.section, chosen.constraint))
            .unwrap();
        assert!(*truth <= tolerance, "{tolerance}: {chosen:?} is off by {truth:.1e}");
    }
}

#[test]
fn estimates_of_a_thick_relaxed_arm_are_its_true_errors() {
    check(&thick_arm(), 0.02);
}

#[test]
fn estimates_of_a_catheter_are_its_true_errors() {
    check(&catheter(), 0.02);
}

#[test]
fn estimates_of_a_steel_rod_are_its_true_errors() {
    check(&steel_rod(), 0.02);
}

#[test]
fn estimates_of_a_propped_rod_are_its_true_errors() {
    // up to a fifth of the work between the supports, spans of 4 to 8 radii, is shear
    check(&propped(), 0.2);
}

/// GA and EA of a thick arm are not those of a line without thickness: shear alone moves its tip by more than 1e-4 of its length.
#[test]
fn a_thick_soft_arm_is_not_given_kirchhoff_at_1e_4() {
    let scene = thick_arm();
    let rod = scene.whole();
    let suggestion = scene.suggestion(&rod, 1e-4);
    let fixed = suggestion.chosen().constraint.fixed();
    assert!(!fixed[3] && !fixed[4] && !fixed[5], "{suggestion}");
    assert!(suggestion.chosen().section == "own section", "{suggestion}");
}

#[test]
fn a_tolerance_that_is_none_is_refused_by_name() {
    let rod = steel_rod().whole();
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let failure = suggest(&rod, tolerance).unwrap_err();
        assert!(matches!(failure.reason, Reason::Options(_)));
        assert!(failure.to_string().contains("tolerance of a model"), "{failure}");
    }
}

/// By construction: a rung is the scene's own constraint and more.
#[test]
fn what_a_scene_leaves_out_is_left_out_of_every_rung_and_offered_once() {
    let scene = steel_rod();
    let rod = scene.rod((scene.own)(), Constraint::kirchhoff());
    let suggestion = scene.suggestion(&rod, 1e-4);
    let rungs = suggestion.rungs();
    for (i, rung) in rungs.iter().enumerate() {
        assert_eq!(rung.constraint.and(Constraint::kirchhoff()), rung.constraint);
        let same = |other: &ModelRung| (&other.section, other.constraint) == (&rung.section, rung.constraint);
        assert!(!rungs[..i].iter().any(same), "{rung:?} twice");
    }
    let whole = rungs.last().unwrap();
    assert_eq!((whole.constraint, whole.error.size(scene.length)), (Constraint::kirchhoff(), 0.0));
}

/// Nothing is strained, so that nothing can be left out.
#[test]
fn a_rod_without_loads_may_be_as_simple_as_can_be() {
    let scene = Scene { dress: |body| Rod::clamped(body, Pose::identity()), ..steel_rod() };
    let rod = scene.whole();
    let suggestion = scene.suggestion(&rod, 1e-6);
    assert_eq!(suggestion.chosen(), &suggestion.rungs()[0]);
    assert!(suggestion.rungs().iter().all(|rung| rung.left_out.is_none() && rung.error.size(1.0) == 0.0));
    assert_eq!(suggestion.to_string().matches("leaves nothing out").count(), suggestion.rungs().len());
}
