use crate::cases::{beam, cases, circle, fixed, number};
use hyperrod::body::{Constraint, Dissipative, Elastic, HasArea, HasMass, ViscosityMatrix, Viscous};
use hyperrod::material::{LinearElastic, Request, Response};
use hyperrod::section::{CrossSection, Section, Tendon};
use hyperrod::solve::dynamics::{Dynamics, Scene, Scheme, Start};
use hyperrod::{Body, Pose, Rod, Strain};
use nalgebra::{Matrix6, Vector6};
use serde_json::Value;

type Damped = Viscous<crate::cases::Beam, ViscosityMatrix>;

fn damped(case: &Value) -> Rod<Damped> {
    let k = Vector6::from_fn(|i, _| case["K_diag"][i].as_f64().unwrap());
    let viscosity = Matrix6::from_diagonal(&(k * number(case, "tau_E")));
    let area = std::f64::consts::PI * 1e-4;
    let body = beam(number(case, "L"), circle(0.01), [k[5] / area, k[3] / area, number(case, "rho")]);
    Rod::clamped(body.with_viscosity_matrix(viscosity).unwrap(), Pose::identity())
}

/// The first bending mode, with a tip displacement of so many metres.
fn plucked(scene: &Scene<'_, Damped>, dynamics: &Dynamics, size: f64) -> Start {
    let mode = dynamics.modes(scene, &Start::at_rest(), 1).unwrap().remove(0);
    let tip = mode.nodes[mode.nodes.len() - 1].linear.norm();
    Start::at_rest().with_strain(move |s| {
        let nearest = mode.stages.iter().min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()));
        nearest.unwrap().strain * (size / tip)
    })
}

/// Oracle: D3, the complex root of the frequency equation. With V = τK the mode keeps its shape; after whole periods 2π/ω_d its tip has
/// fallen to e^{−δt}, where an error of the frequency counts in second order.
#[test]
fn an_oscillation_decays_as_linear_theory_says() {
    for case in cases("D3_kelvin_voigt.json") {
        let rod = damped(&case);
        let scene = Scene::new(&rod);
        let period = std::f64::consts::TAU / number(&case, "damped_omega");
        let decay = number(&case, "decay_rate");
        for (scheme, steps) in [(Scheme::Esdirk43, 40), (Scheme::GeneralisedAlpha { rho: 1.0 }, 800)] {
            let dynamics = Dynamics { scheme, ..fixed(period / f64::from(steps)) };
            let mut stepper = dynamics.start(&scene, &plucked(&scene, &dynamics, 1e-6)).unwrap();
            let begin = stepper.frame().unwrap();
            let end = 3.0 * period;
            stepper.run_to(end).unwrap();
            let frame = stepper.frame().unwrap();
            let (a, b) = (begin.tip().pose.position, frame.tip().pose.position);
            let amplitude = |p: nalgebra::Vector3<f64>| p.x.hypot(p.y);
            let found = (amplitude(a) / amplitude(b)).ln() / end;
            println!("{} {scheme:?}: {found} for {decay}", case["id"]);
            assert!((found / decay - 1.0).abs() < 1e-3, "{scheme:?}: {found} for {decay}");
            // energy lost is energy dissipated; to the error of the quadrature in time
            let lost = begin.energies.total().unwrap() - frame.energies.total().unwrap();
            assert!((frame.energies.dissipated / lost - 1.0).abs() < 1e-2, "{:?} {lost}", frame.energies);
        }
    }
}

/// Steps from far below to far above every period and every relaxation time.
#[test]
fn a_damped_rod_is_stable_at_any_step() {
    let rod = damped(&cases("D3_kelvin_voigt.json")[1]);
    let scene = Scene::new(&rod);
    for scheme in [Scheme::Esdirk43, Scheme::GeneralisedAlpha { rho: 0.9 }] {
        for dt in [1e-5, 1e-3, 0.1, 10.0] {
            let dynamics = Dynamics { scheme, elements: 3, ..fixed(dt) };
            let mut stepper = dynamics.start(&scene, &plucked(&scene, &dynamics, 1e-3)).unwrap();
            let begin = stepper.frame().unwrap().energies.total().unwrap();
            let mut last = begin;
            for _ in 0..300 {
                stepper.step().unwrap();
                last = stepper.frame().unwrap().energies.total().unwrap();
                // generalised-α keeps another energy: the true one may sway by a few parts in a hundred while it falls
                assert!(last < begin * 1.05, "{scheme:?} dt {dt}: {last} J of {begin} J");
            }
            assert!(last < begin * (1.0 + 1e-8), "{scheme:?} dt {dt}: {last} J of {begin} J");
        }
    }
}

/// Fixed strains, places where a tendon ends, response, mass and area are those of the body inside, to the bit.
#[test]
fn damping_takes_nothing_away_from_a_body() {
    let body = || {
        let section = Section::new(circle(0.01), LinearElastic::new(5e5, 2e5).unwrap()).unwrap();
        let tendon = Tendon::new([0.005, 0.0], 1.0).unwrap().ending_at(0.3).unwrap();
        let body = Body::new(0.4, section.with_actuator(tendon)).unwrap().with_density(1000.0).unwrap();
        body.with_constraint(Constraint::kirchhoff())
    };
    let (bare, damped) = (body(), body().with_varying_viscosity(|s| Matrix6::identity() * s));
    assert_eq!(damped.viscosity(0.1).unwrap(), Some(Matrix6::identity() * 0.1));
    assert_eq!(damped.constraint(), Constraint::kirchhoff());
    assert_eq!(damped.breakpoints(), [0.3]);
    assert_eq!(damped.area_moments(0.1).unwrap(), bare.area_moments(0.1).unwrap());
    assert_eq!(damped.inertia(0.1).unwrap(), bare.inertia(0.1).unwrap());
    let (places, strains) = ([0.1, 0.35], [Strain::from_array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3]); 2]);
    let [mut of_bare, mut of_damped] = [[Response::zero(); 2]; 2];
    bare.respond_many(&places, &strains, Request::Tangent, &mut of_bare).unwrap();
    damped.respond_many(&places, &strains, Request::Tangent, &mut of_damped).unwrap();
    assert_eq!(of_damped, of_bare);
}
