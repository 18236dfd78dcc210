//! What cannot be is refused with an error that names the quantity, its value and its place; a solve that ends without an answer says why and
//! hands back how far it got.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use std::f64::consts::PI;

use hyperrod::load::{DeadWrench, Gravity, LoadWrench, TipLoad};
use hyperrod::material::{Invariants, Isotropic, LinearElastic, MooneyRivlin, NeoHookean, Point, Station};
use hyperrod::section::{Circle, CrossSection, Linear, Rectangle, Section, Stiffness};
use hyperrod::solve::{Failure, Reason, Rung};
use hyperrod::{Body, Error, Pose, Result, Rod, Scalar, Statics, Strain, Twist};
use nalgebra::{Matrix6, vector};

const MU: f64 = 2e5;
const LAMBDA: f64 = 3e5;

fn neo_hookean() -> NeoHookean {
    NeoHookean::new(MU, LAMBDA).unwrap()
}

fn stiffness() -> Stiffness {
    Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4]).unwrap()
}

/// The error's text must have every one of the parts: quantity, value, place.
fn says(error: &dyn std::fmt::Display, parts: &[&str]) {
    let text = error.to_string();
    for part in parts {
        assert!(text.contains(part), "no `{part}` in `{text}`");
    }
}

fn refused<T>(result: Result<T>, parts: &[&str]) -> Error {
    let error = result.err().unwrap_or_else(|| panic!("accepted, but should have said {parts:?}"));
    says(&error, parts);
    error
}

#[test]
fn a_size_that_is_not_positive_is_refused() {
    for (value, text) in [(0.0, "is 0 "), (-0.01, "-0.01"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        refused(Section::new(Circle::new(value), neo_hookean()), &["radius of the circle", text, "positive"]);
        refused(Section::new(Rectangle::new(value, 0.01), neo_hookean()), &["width of the rectangle", text]);
        refused(Section::new(Rectangle::new(0.01, value), neo_hookean()), &["height of the rectangle", text]);
    }
}

#[test]
fn moduli_that_are_not_positive_are_refused() {
    refused(LinearElastic::new(-1.0, 1.0), &["Young's modulus", "-1"]);
    refused(LinearElastic::new(1.0, f64::NAN), &["shear modulus", "NaN"]);
    refused(LinearElastic::from_poisson(1.0, 0.6), &["Poisson's ratio", "0.6"]);
    refused(NeoHookean::new(0.0, 1.0), &["mu", "0"]);
    refused(NeoHookean::new(3.0, -2.5), &["bulk modulus", "-0.5"]);
    refused(NeoHookean::from_young(1e6, 0.5), &["Poisson's ratio", "0.5"]);
    refused(MooneyRivlin::new(1.0, -0.75), &["axial modulus", "-1"]);
    refused(MooneyRivlin::new(-1.0, 0.75), &["shear modulus", "-0.5"]);
}

#[test]
fn a_strain_that_is_not_a_number_is_refused() {
    let at = Station::straight(0.25);
    let mut strain = Strain::zero();
    strain.angular.y = f64::NAN;
    let section = Section::new(Circle::new(0.01), neo_hookean()).unwrap();
    refused(section.wrench(&at, &strain), &["omega_y", "NaN", "s = 0.25 m"]);
    refused(stiffness().wrench(&at, &strain), &["omega_y", "NaN", "s = 0.25 m"]);
    let linear = Section::new(Circle::new(0.01), LinearElastic::new(1e6, 4e5).unwrap()).unwrap();
    refused(linear.tangent(&at, &strain), &["omega_y", "NaN", "s = 0.25 m"]);
}

#[test]
fn a_point_turned_inside_out_is_refused_with_its_place() {
    let section = Section::new(Circle::new(0.01), neo_hookean()).unwrap();
    let mut strain = Strain::zero();
    strain.linear.z = -1.5;
    let error =
        refused(section.energy(&Station::straight(0.1), &strain), &["J = -0.5", "s = 0.1 m", "(x, y) ="]);
    assert!(matches!(error, Error::Inadmissible { quantity: "J", value, s: 0.1, .. } if value == -0.5));
    // bent so that only the inner side is
    let mut strain = Strain::zero();
    strain.angular.x = 120.0;
    let error = refused(section.energy(&Station::straight(0.1), &strain), &["J = -"]);
    assert!(matches!(error, Error::Inadmissible { y, .. } if y < -1.0 / 120.0));
}

#[test]
fn a_length_or_density_that_is_not_positive_is_refused() {
    for (value, text) in [(0.0, "is 0,"), (-2.0, "is -2"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        refused(Body::new(value, stiffness()), &["length of the body", text]);
        let section = Section::new(Circle::new(0.01), neo_hookean()).unwrap();
        refused(Body::new(1.0, section).unwrap().with_density(value), &["density", text]);
        refused(Body::new(1.0, stiffness()).unwrap().with_mass_per_length(value), &["mass per length", text]);
    }
}

#[test]
fn a_reference_that_does_not_go_forward_is_refused() {
    let mut xi = Twist::straight();
    xi.linear.z = -1.0;
    refused(Body::new(1.0, stiffness()).unwrap().with_reference_strain(xi), &["reference strain", "-1"]);
    let mut xi = Twist::straight();
    xi.angular.x = f64::NAN;
    refused(Body::new(1.0, stiffness()).unwrap().with_reference_strain(xi), &["reference strain", "finite"]);
}

/// A reference given as a function of s is examined at places spread over the rod, and wherever the solve evaluates it.
#[test]
fn a_varying_reference_that_is_not_defined_is_refused_where_it_is_not() {
    let body = |fault: f64, from: f64, to: f64| {
        Body::new(2.0, stiffness()).unwrap().with_varying_reference(move |s| {
            let mut xi = Twist::straight();
            if s.re > from && s.re < to {
                xi.angular.x = s * if fault.is_nan() { fault } else { 1.0 };
                xi.linear.z *= if fault.is_nan() { 1.0 } else { fault };
            }
            xi
        })
    };
    for (fault, parts) in [(f64::NAN, ["omega_x", "NaN"]), (-1.0, ["nu_z", "-1"])] {
        let error = refused(body(fault, 1.0, 2.0), &parts);
        says(&error, &["reference strain", "s = 1.125 m"]);
        // between the places examined, but not between the stages of the solve
        let narrow = body(fault, 1.01, 1.12).unwrap();
        let failure = Statics::default().solve(&Rod::clamped(narrow, Pose::identity())).unwrap_err();
        let Reason::Start(Error::InvalidAt { s, .. }) = failure.reason else { panic!("{failure}") };
        assert!(s > 1.01 && s < 1.12, "{failure}");
        says(&failure, &parts);
    }
}

#[test]
fn a_stiffness_that_is_not_symmetric_positive_definite_is_refused() {
    refused(Stiffness::diagonal([1.0, 1.0, -0.8, 1.0, 1.0, 1.0]), &["GJ", "-0.8"]);
    refused(Stiffness::diagonal([1.0, 1.0, 1.0, 1.0, 1.0, f64::NAN]), &["EA", "NaN"]);
    let mut k = Matrix6::identity();
    (k[(0, 1)], k[(1, 0)]) = (2.0, 2.0);
    refused(Stiffness::new(k), &["smallest eigenvalue of K", "is -1"]);
    k[(1, 0)] = 1.5;
    refused(Stiffness::new(k), &["asymmetry of K", "0.5"]);
    refused(Stiffness::new(Matrix6::from_diagonal_element(f64::NAN)), &["entry of K", "NaN"]);
    refused(Stiffness::new(Matrix6::from_diagonal_element(f64::INFINITY)), &["entry of K", "inf"]);
}

#[test]
fn a_load_that_is_not_finite_is_refused() {
    refused(DeadWrench::force(vector![0.0, f64::NAN, 0.0]), &["dead wrench", "NaN"]);
    refused(DeadWrench::moment(vector![f64::INFINITY, 0.0, 0.0]), &["dead wrench", "inf"]);
    refused(Gravity::new(vector![0.0, 0.0, f64::NEG_INFINITY]), &["gravity", "-inf"]);

    struct Broken;
    impl TipLoad for Broken {
        fn at(&self, _pose: &Pose) -> Result<LoadWrench> {
            let mut load = DeadWrench::force(vector![1.0, 0.0, 0.0])?.at(&Pose::identity())?;
            load.wrench.force.x = f64::NAN;
            Ok(load)
        }
    }
    let rod = Rod::clamped(Body::new(0.7, stiffness()).unwrap(), Pose::identity()).with_tip_load(Broken);
    let failure = Statics::default().solve(&rod).unwrap_err();
    says(&failure, &["tip load", "NaN", "s = 0.7 m"]);
    assert!(matches!(failure.reason, Reason::Start(Error::InvalidAt { .. })) && failure.last.is_none());
}

#[test]
fn a_taper_to_a_negative_radius_fails_where_the_radius_does() {
    let taper = Linear { from: 0.01, to: -0.01, length: 1.0 };
    let body = Body::new(1.0, Section::new(Circle::new(taper), neo_hookean()).unwrap()).unwrap();
    let failure = Statics::default().solve(&Rod::clamped(body, Pose::identity())).unwrap_err();
    let Reason::Start(Error::InvalidAt { quantity, value, s, .. }) = failure.reason else {
        panic!("{failure}");
    };
    assert_eq!(quantity, "radius of the circle");
    // the first stage beyond s = 1/2, where the radius is 0.01 − 0.02 s
    assert!(s > 0.5 && s < 0.6 && (value - (0.01 - 0.02 * s)).abs() < 1e-16);
    says(&failure, &["radius of the circle", &value.to_string(), &format!("s = {s} m"), "reference shape"]);
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let rod = Rod::clamped(Body::new(1.0, stiffness()).unwrap(), Pose::identity());
    for (options, parts) in [
        (Statics { elements: 0, ..Default::default() }, ["number of elements", "is 0"]),
        (Statics { elements: 2_000_000, ..Default::default() }, ["number of elements", "2000000"]),
        (Statics { tolerance: 0.0, ..Default::default() }, ["tolerance", "is 0"]),
        (Statics { tolerance: f64::NAN, ..Default::default() }, ["tolerance", "NaN"]),
        (Statics { max_iterations: 0, ..Default::default() }, ["iteration limit", "is 0"]),
    ] {
        let failure = options.solve(&rod).unwrap_err();
        assert!(matches!(failure.reason, Reason::Options(_)));
        says(&failure, &parts);
    }
}

/// A stub pressed along its axis by `pressure` times its area.
fn pressed(law: impl hyperrod::material::Material, pressure: f64) -> Rod<impl hyperrod::body::Elastic> {
    let radius: f64 = 0.02;
    let body = Body::new(0.05, Section::new(Circle::new(radius), law).unwrap()).unwrap();
    let force = DeadWrench::force(vector![0.0, 0.0, -pressure * PI * radius * radius]).unwrap();
    Rod::clamped(body, Pose::identity()).with_tip_load(force)
}

/// Pressed with 1.5(λ + 2μ) the first Newton step asks for a stretch of −0.5; the answer solves μ(c − 1/c) + λ ln c / c = −p.
#[test]
fn a_step_that_turns_the_material_inside_out_is_shortened_and_the_solve_goes_on() {
    let pressure = 1.5 * (LAMBDA + 2.0 * MU);
    // far beyond its critical load: the stable answer hangs the other way
    let straight = Statics { elements: 4, accept_unstable: true, ..Default::default() };
    let solution = straight.solve(&pressed(neo_hookean(), pressure)).unwrap();
    let first = solution.report().iterations[0];
    assert!(first.fraction == 0.5, "the first step was not shortened: {first:?}");
    let (mut low, mut high) = (0.01, 1.0_f64);
    for _ in 0..100 {
        let c: f64 = 0.5 * (low + high);
        let excess = MU * (c - 1.0 / c) + LAMBDA * c.ln() / c + pressure;
        (low, high) = if excess > 0.0 { (low, c) } else { (c, high) };
    }
    let stretch = 1.0 + solution.tip().strain.linear.z;
    // bisection and Newton's method to rounding
    assert!((stretch - low).abs() < 1e-14, "stretch {stretch}, exactly {low}");
    assert!((solution.tip().pose.position.z - 0.05 * low).abs() < 1e-15);
}

/// Hooke's law that breaks at 30 % compression.
struct Brittle;

impl Isotropic for Brittle {
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let broken = if i.j().re() < -0.3 { f64::NAN } else { 0.0 };
        (i.i1_excess() + broken) * MU
    }

    fn domain(&self) -> &'static str {
        "finite, which needs a compression below 30 %"
    }
}

/// Pressed to 40 %, it creeps to the limit by ever shorter steps and then says so.
#[test]
fn a_solve_that_cannot_go_on_says_why_and_hands_back_its_last_state() {
    let failure: Box<Failure> =
        Statics { elements: 4, ..Default::default() }.solve(&pressed(Brittle, 0.4 * 2.0 * MU)).unwrap_err();
    let Reason::NoAdmissibleStep { iteration, fraction, ref error } = failure.reason else {
        panic!("{failure}");
    };
    assert!(matches!(error, Error::Inadmissible { .. }) && fraction < 1e-5);
    says(
        &failure,
        &[
            "no admissible step",
            &format!("iteration {iteration}"),
            "energy density = NaN",
            "(x, y) =",
            "30 %",
        ],
    );
    // then the rungs after the first, none of which gets further
    let first = failure.report.iterations.iter().take_while(|i| i.elements == 2).count();
    assert_eq!(first, iteration);
    assert!(failure.report.iterations[0].fraction == 0.5 && failure.report.residual > 0.1);
    // steps of a millionth of the way that is left, 0.1
    let last = failure.last.unwrap();
    let stretch = last.tip().strain.linear.z;
    let stage = last.stages()[0].strain.linear.z;
    assert!((stage + 0.3).abs() < 1e-6 && stage >= -0.3, "{stage}, {stretch}");
}

#[test]
fn a_solve_out_of_iterations_hands_back_its_last_state() {
    let rod = Rod::clamped(Body::new(1.0, stiffness()).unwrap(), Pose::identity())
        .with_tip_load(DeadWrench::force(vector![10.0, 0.0, 0.0]).unwrap());
    let mut seen = Vec::new();
    // three on a mesh are enough where the load comes in steps, two are too few for every rung
    let options = Statics { elements: 8, max_iterations: 3, ..Default::default() };
    let solution = options.solve_observed(&rod, |iteration| seen.push(*iteration)).unwrap();
    assert!(solution.report().rungs.contains(&Rung::LoadSteps));
    assert_eq!(solution.report().iterations, seen);
    seen.clear();
    let options = Statics { max_iterations: 2, ..options };
    let failure = options.solve_observed(&rod, |iteration| seen.push(*iteration)).unwrap_err();
    let Reason::IterationLimit { limit: 2, step, tolerance } = failure.reason else { panic!("{failure}") };
    assert_eq!(tolerance, options.tolerance);
    // regularised ones and those of load steps among them
    assert_eq!(failure.report.iterations, seen);
    assert!(seen.len() > 2 && seen.iter().all(|iteration| iteration.residual.is_finite()));
    assert_eq!(seen[1].step, step);
    says(&failure, &["2 iterations", &format!("{step:.3e}"), &format!("{tolerance:.1e}")]);
    assert!(failure.report.rungs.len() > 1);
    for rung in &failure.report.rungs {
        says(&failure, &[&rung.to_string()]);
    }
    let last = failure.last.unwrap();
    assert!(last.tip().pose.position.x > 0.1, "it had begun to bend");
    assert_eq!(last.nodes().len(), 5, "the coarse mesh");
}

/// A law whose pressure was forgotten: of itself its section closes up, J → 0, and every step is cut short on the way there.
#[test]
fn a_section_that_closes_up_of_itself_is_named_with_what_stopped_the_steps() {
    let bare = MooneyRivlin::new(120e3, 40e3).unwrap();
    let body = Body::new(0.3, Section::new(Circle::new(0.01), bare).unwrap()).unwrap();
    let rod = Rod::clamped(body, Pose::identity())
        .with_tip_load(DeadWrench::force(vector![0.5, 0.0, 0.0]).unwrap());
    for statics in [Statics::default(), Statics::to(1e-6)] {
        let failure = statics.solve(&rod).unwrap_err();
        says(&failure, &["stress at rest", "ReferencePressure", "J = ", "positive"]);
        let Reason::StressAtRest { force, strain, then } = failure.reason else { panic!("{failure}") };
        // Ψ(0) = (2 C₁ + 4 C₂) A, of which the tangent, the same number, makes −1; to the rounding of sums of a few points
        assert!((force / (400e3 * PI * 1e-4) - 1.0).abs() < 1e-13 && (strain + 1.0).abs() < 1e-13);
        let Reason::ShortSteps { limit: 50, fraction, step, error } = *then else { panic!("{then}") };
        assert!(fraction < 1.0 && step > 0.0, "{fraction} {step}");
        let Error::Inadmissible { quantity: "J", value, .. } = error else { panic!("{error}") };
        assert!(value <= 0.0, "{value}");
    }
}
