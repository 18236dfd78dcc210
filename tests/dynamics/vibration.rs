use crate::cases::{Beam, beam, cases, circle, clamped, cylinder, fixed, number};
use hyperrod::body::HasMass;
use hyperrod::solve::dynamics::{Dynamics, Scene, Start};
use serde_json::Value;

fn beam_of(case: &Value) -> Beam {
    let k = |i: usize| case["K_diag"][i].as_f64().unwrap();
    let (area, length) = (number(case, "A"), number(case, "L"));
    beam(
        length,
        circle((area / std::f64::consts::PI).sqrt()),
        [k(5) / area, k(3) / area, number(case, "rho")],
    )
}

/// Oracle: D1, the roots of the Timoshenko, axial and torsional frequency equations in 50 digits.
#[test]
fn natural_frequencies_are_those_of_a_timoshenko_beam() {
    for case in cases("D1_frequencies.json") {
        let rod = clamped(beam_of(&case));
        let dynamics = Dynamics { elements: 12, ..Dynamics::default() };
        let modes = dynamics.modes(&Scene::new(&rod), &Start::at_rest(), 60).unwrap();
        for (family, references) in case["modes"].as_object().unwrap() {
            let Some(references) = references.as_array() else { continue };
            for reference in references {
                let omega = number(reference, "omega");
                let error = |m: &hyperrod::solve::dynamics::Mode| (m.angular_frequency() / omega - 1.0).abs();
                let nearest = modes.iter().map(error).fold(f64::INFINITY, f64::min);
                println!("{} {family} {omega}: {nearest:.1e}", case["id"]);
                assert!(nearest < 1e-6, "{} {family} {omega}: {nearest:.1e}", case["id"]);
            }
        }
    }
}

/// ∫ζ_aᵀ M ζ_b ds is 1 or 0, to the rounding of an eigenvalue problem whose condition is that of K, some 1e4.
#[test]
fn mode_shapes_are_orthogonal_in_the_mass() {
    let rod = clamped(cylinder());
    let modes = fixed(1.0).modes(&Scene::new(&rod), &Start::at_rest(), 12).unwrap();
    for (a, first) in modes.iter().enumerate() {
        for (b, second) in modes.iter().enumerate() {
            let product: f64 = first
                .stages
                .iter()
                .zip(&second.stages)
                .map(|(x, y)| {
                    let mass = rod.body().inertia(x.s).unwrap();
                    x.weight * x.displacement.to_vector().dot(&(mass * y.displacement.to_vector()))
                })
                .sum();
            let expected = if a == b { 1.0 } else { 0.0 };
            assert!((product - expected).abs() < 1e-9, "modes {a} and {b}: {product}");
        }
    }
}

/// Oracle: the free-free Euler-Bernoulli beam, (βL)² = 22.3733; a slender rod differs by (r/L)² 50, about 2e-4 here.
#[test]
fn a_free_rod_has_six_rigid_modes_and_then_bends() {
    let rod = clamped(beam(1.0, circle(0.002), [1e9, 4e8, 1000.0]));
    let scene = Scene::new(&rod).with_free_base();
    let modes = fixed(1.0).modes(&scene, &Start::at_rest(), 8).unwrap();
    let slender = 22.3733 * (1e9 * 0.002 * 0.002 / 4.0 / 1000.0_f64).sqrt();
    println!("{:?}", modes.iter().map(|m| m.omega_squared).collect::<Vec<_>>());
    for mode in &modes[..6] {
        assert!(mode.omega_squared.abs() < 1e-6 * slender * slender, "{}", mode.omega_squared);
    }
    for mode in &modes[6..] {
        assert!((mode.angular_frequency() / slender - 1.0).abs() < 1e-3, "{}", mode.angular_frequency());
    }
}
