//! Every case of the converged 2-D finite elements, at the rung that the balance rule names.
use hyperrod::section::{Circle, Ellipse, Rectangle, Shape};
use serde_json::Value;
use std::path::Path;

use crate::{relative, respond, solid};

fn shape(name: &str) -> Box<dyn Shape> {
    match name {
        "circle" => Box::new(Circle::new(1.0)),
        "square" => Box::new(Rectangle::new(1.0, 1.0)),
        "rect1x2" => Box::new(Rectangle::new(1.0, 2.0)),
        _ => Box::new(Ellipse::new(1.0, 0.5)),
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// The rung for a strain, and what Ψ is to be within: 5e-2 where corners at a large twist are slow for polynomials.
fn rung(name: &str, strain: &str) -> ((usize, usize), f64) {
    match (name, strain) {
        (_, "rest" | "stretch+0.5" | "stretch-0.3") => ((1, 0), 1e-10),
        ("circle", "twist0.5" | "twist1.5") => ((3, 0), 1e-3),
        ("ellipse", "twist0.5") => ((5, 4), 1e-3),
        ("ellipse", "twist1.5") => ((9, 8), 1e-3),
        (_, "twist0.5") => ((7, 6), 1e-3),
        (_, "twist1.5") => ((7, 6), 5e-2),
        (_, "bend0.2") => ((4, 0), 1e-3),
        (_, "bend0.5") => ((6, 0), 1e-3),
        (_, "shear0.3") => ((4, 3), 1e-3),
        _ => panic!("no rung for {strain}"),
    }
}

#[test]
fn every_reference_case_is_met_at_its_rung() {
    let mut count = 0;
    for name in ["circle", "square", "rect1x2", "ellipse"] {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/relaxed/section_{name}.json"));
        let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        for case in data["cases"].as_array().unwrap() {
            let (law, strain) = (case["law"].as_str().unwrap(), case["strain"].as_str().unwrap());
            let lambda = data["laws"][law]["lambda"].as_f64().unwrap();
            let (degrees, tolerance) = rung(name, strain);
            let response =
                respond(&solid(shape(name), lambda, degrees), numbers(&case["dxi"]).try_into().unwrap());
            let (psi, exact) = (response.wrench.to_array(), numbers(&case["Psi"]));
            let error = if strain == "rest" {
                psi.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
            } else {
                relative(&psi, &exact)
            };
            assert!(error < tolerance, "{name} {law} {strain}: {error:e} at {degrees:?}");
            count += 1;
        }
    }
    assert_eq!(count, 64);
}

/// Torsion of the square at (5, 4) against the finite elements: the energy of a Ritz basis is an upper bound and falls with the basis.
#[test]
fn the_energy_falls_towards_that_of_the_finite_elements() {
    let exact = 0.1576848011036; // square nh030 twist1.5
    let energies: Vec<f64> = [(0, 0), (3, 2), (5, 4), (7, 6), (9, 8)]
        .map(|degrees| respond(&solid(shape("square"), 1.5, degrees), [0.0, 0.0, 1.5, 0.0, 0.0, 0.0]).energy)
        .to_vec();
    assert!(energies.windows(2).all(|pair| pair[0] > pair[1] - 1e-12), "{energies:?}");
    assert!(energies[4] > exact && energies[4] / exact - 1.0 < 2e-4, "{energies:?}");
}
