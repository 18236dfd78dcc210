use crate::cases::{beam, circle, clamped, cylinder, fixed, ramp, sideways};
use hyperrod::load::DeadWrench;
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::{Adaptive, Dynamics, Reason, Scene, Scheme, Start, Step, Stepper};
use hyperrod::{Strain, Twist};
use nalgebra::vector;

fn schemes() -> [Scheme; 2] {
    [Scheme::Esdirk43, Scheme::GeneralisedAlpha { rho: 0.8 }]
}

fn steps(stepper: &mut Stepper<'_>, count: std::ops::Range<usize>) {
    for _ in count {
        stepper.step().unwrap();
    }
}

/// Twenty steps in one go, and ten, a saved state, and ten more by another stepper: the same numbers to the last bit, with fixed and chosen
/// steps, clamped and free.
#[test]
fn a_run_that_goes_on_from_a_saved_state_has_the_same_bits() {
    let rod = clamped(cylinder());
    for scheme in schemes() {
        for step in [Step::Fixed(4e-3), Step::Adaptive(Adaptive { tolerance: 1e-5, ..Adaptive::default() })] {
            for free in [false, true] {
                let dynamics =
                    Dynamics { scheme, step, elements: 4, order: Order::Four, ..Dynamics::default() };
                let scene = Scene::new(&rod).with_load(sideways(), ramp);
                let scene = if free { scene.with_free_base() } else { scene };
                let mut whole = dynamics.start(&scene, &Start::at_rest()).unwrap();
                steps(&mut whole, 0..20);
                let mut first = dynamics.start(&scene, &Start::at_rest()).unwrap();
                steps(&mut first, 0..10);
                let saved = first.state();
                let mut second = dynamics.resume(&scene, &saved).unwrap();
                steps(&mut second, 0..10);
                assert_eq!(second.state(), whole.state(), "{scheme:?} {step:?} free {free}");
                assert!(whole.frame().unwrap().tip().pose.position.x.abs() > 1e-4);
            }
        }
    }
}

/// Through text and back: the feature `serde` with a format that keeps every bit.
#[cfg(feature = "serde")]
#[test]
fn a_saved_state_survives_being_written_and_read() {
    let rod = clamped(cylinder());
    let scene = Scene::new(&rod).with_load(sideways(), ramp);
    let mut stepper = fixed(5e-3).start(&scene, &Start::at_rest()).unwrap();
    steps(&mut stepper, 0..5);
    let text = serde_json::to_string(&stepper.state()).unwrap();
    let read: hyperrod::solve::dynamics::State = serde_json::from_str(&text).unwrap();
    assert_eq!(read, stepper.state());
}

/// A state of another mesh, and one with a number that is none, are refused.
#[test]
fn a_state_of_another_mesh_is_refused() {
    let rod = clamped(cylinder());
    let scene = Scene::new(&rod);
    let state = fixed(1e-3).start(&scene, &Start::at_rest()).unwrap().state();
    let other = Dynamics { elements: 3, ..fixed(1e-3) };
    let failure = other.resume(&scene, &state).unwrap_err();
    assert!(matches!(failure.reason, Reason::Options(_)), "{failure}");
    assert!(failure.to_string().contains("number of Gauss stages"), "{failure}");
}

/// The first step tried is far too long. What is reached after it was rejected is what a run reaches that tried the accepted step at once.
#[test]
fn a_rejected_step_leaves_no_trace() {
    let rod = clamped(cylinder());
    let scene = Scene::new(&rod).with_load(sideways(), |_| 1.0);
    for scheme in schemes() {
        let adaptive = Adaptive { tolerance: 1e-6, first: 0.1, ..Adaptive::default() };
        let dynamics = Dynamics { scheme, step: Step::Adaptive(adaptive), ..Dynamics::default() };
        // accelerations at the start are computed with the first step in mind: begin both from one saved state
        let saved =
            Dynamics { step: Step::Fixed(1e-3), ..dynamics }.start(&scene, &Start::at_rest()).unwrap();
        let mut saved = saved.state();
        saved.forget_steps();
        let mut searching = dynamics.resume(&scene, &saved).unwrap();
        let report = searching.step().unwrap();
        assert!(report.rejected > 0 && report.error <= 1e-6, "{report:?}");
        let direct = Dynamics { step: Step::Fixed(report.step), ..dynamics };
        let mut direct = direct.resume(&scene, &saved).unwrap();
        direct.step().unwrap();
        assert_eq!(searching.frame().unwrap(), direct.frame().unwrap(), "{scheme:?}");
    }
}

/// A tighter tolerance gives a smaller error; the reference is a run with steps so small that its error is far below.
#[test]
fn an_adaptive_run_follows_its_tolerance() {
    let rod = clamped(cylinder());
    let scene = Scene::new(&rod).with_load(sideways(), ramp);
    let tip = |step: Step| {
        let dynamics = Dynamics { step, elements: 4, ..Dynamics::default() };
        dynamics.run(&scene, &Start::at_rest(), 0.3, |_| ()).unwrap().tip().pose.position
    };
    let exact = tip(Step::Fixed(1e-3));
    let error =
        |tolerance: f64| (tip(Step::Adaptive(Adaptive { tolerance, ..Adaptive::default() })) - exact).norm();
    let errors = [1e-4, 1e-5, 1e-6].map(error);
    println!("{errors:?}");
    assert!(errors[1] < 0.5 * errors[0] && errors[2] < 0.5 * errors[1] && errors[2] < 2e-5, "{errors:?}");
}

/// A whip: the soft rod is swung by its handle so hard that a step of 20 ms cannot be made. The failure says when, where and why, and a
/// run goes on from the state it returns with shorter steps.
#[test]
fn a_step_that_cannot_be_made_says_so_and_returns_the_last_state() {
    use hyperrod::num_dual::{Dual2_64, DualNum};
    let rod = clamped(beam(0.4, circle(0.002), [5e4, 2e4, 1000.0]));
    let scene = Scene::new(&rod).with_base_motion(|t: Dual2_64| {
        let angle = (t * 60.0).sin().powi(3) * 1.5;
        let rotation =
            hyperrod::lie::so3::exp(&vector![Dual2_64::from_re(0.0), angle, Dual2_64::from_re(0.0)]);
        hyperrod::Pose::new(rotation, vector![0.0, 0.0, 0.0].map(Dual2_64::from_re))
    });
    let long = Dynamics { max_iterations: 8, ..fixed(0.02) };
    let mut stepper = long.start(&scene, &Start::at_rest()).unwrap();
    let failure = (0..50).find_map(|_| stepper.step().err()).expect("steps of 20 ms are too long");
    println!("{failure}");
    let last = failure.last.as_ref().unwrap();
    assert!(failure.time > last.time() && stepper.time() == last.time());
    assert!(failure.to_string().contains("at t = ") && failure.to_string().contains("s = "), "{failure}");
    let adaptive = Step::Adaptive(Adaptive { tolerance: 1e-4, first: 1e-3, ..Adaptive::default() });
    let end = last.time() + 0.02;
    let mut second = Dynamics { step: adaptive, ..Dynamics::default() }.resume(&scene, &{
        let mut state = (**last).clone();
        state.forget_steps();
        state
    });
    second.as_mut().unwrap().run_to(end).unwrap();
}

/// What makes no sense is refused with its name.
#[test]
fn options_that_make_no_sense_are_refused() {
    let rod = clamped(cylinder());
    let scene =
        Scene::new(&rod).with_tip_load(DeadWrench::force(vector![1.0, 0.0, 0.0]).unwrap(), |t| 1.0 / t);
    let refused = |dynamics: Dynamics, start: &Start| dynamics.start(&scene, start).unwrap_err().to_string();
    assert!(refused(fixed(-1.0), &Start::at_rest()).contains("time step"));
    assert!(refused(Dynamics { elements: 0, ..fixed(1.0) }, &Start::at_rest()).contains("elements"));
    let scheme = Scheme::GeneralisedAlpha { rho: 1.5 };
    assert!(refused(Dynamics { scheme, ..fixed(1.0) }, &Start::at_rest()).contains("rho"));
    assert!(refused(Dynamics { conserve: true, ..fixed(1.0) }, &Start::at_rest()).contains("conservation"));
    assert!(refused(fixed(1.0), &Start::at_rest()).contains("amplitude"));
    let nan = Start::at_rest().at_time(1.0).with_strain(|_| Strain::from_array([f64::NAN; 6]));
    assert!(refused(fixed(1.0), &nan).contains("strain"));
    let fast = Start::at_rest().at_time(1.0).with_base_velocity(Twist::zero());
    let mut stepper = fixed(0.01).start(&scene, &fast).unwrap();
    assert!(stepper.step_toward(0.5).unwrap_err().to_string().contains("later"));
}

/// Oracle: a straight rod whose curvature κ̇ grows alike everywhere turns with κ̇ s and moves with ½ κ̇ s² at s. Exact on any mesh but for rounding.
#[test]
fn a_start_with_rates_of_strain_has_the_velocities_that_follow_from_them() {
    let rod = clamped(cylinder());
    let scene = Scene::new(&rod);
    let start = Start::at_rest().with_strain_rate(|_| Strain::from_array([0.0, 3.0, 0.0, 0.0, 0.0, 0.0]));
    for scheme in schemes() {
        let dynamics = Dynamics { scheme, elements: 3, ..fixed(1e-3) };
        for node in dynamics.start(&scene, &start).unwrap().frame().unwrap().nodes {
            let exact = Twist::from_array([0.0, 3.0 * node.s, 0.0, 1.5 * node.s * node.s, 0.0, 0.0]);
            let error = (node.velocity - exact).to_vector().amax();
            assert!(error < 1e-13, "{scheme:?}, s = {}: {error:.1e}", node.s);
        }
    }
}
