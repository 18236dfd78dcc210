//! The converged 2-D finite elements of the section, and sections to compare with them.

use hyperrod::material::NeoHookean;
use hyperrod::section::{Circle, Ellipse, Rectangle, Relaxed, Shape, Warping};
use serde_json::Value;
use std::path::Path;

/// A section of the neo-Hookean law of the references.
pub type Solid = Relaxed<Box<dyn Shape>, NeoHookean>;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

pub struct Case {
    pub section: String,
    pub law: String,
    pub strain: String,
    pub lambda: f64,
    pub dxi: [f64; 6],
    pub psi: Vec<f64>,
}

pub fn cases() -> Outcome<Vec<Case>> {
    let mut cases = Vec::new();
    for section in ["circle", "square", "rect1x2", "ellipse"] {
        let file = format!("tests/data/relaxed/section_{section}.json");
        let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file))?;
        let data: Value = serde_json::from_str(&text)?;
        for case in data["cases"].as_array().into_iter().flatten() {
            let text = |name: &str| case[name].as_str().unwrap_or_default().to_string();
            let mut dxi = [0.0; 6];
            dxi.copy_from_slice(&numbers(&case["dxi"]));
            let law = text("law");
            cases.push(Case {
                section: section.to_string(),
                lambda: data["laws"][&law]["lambda"].as_f64().unwrap_or(f64::NAN),
                law,
                strain: text("strain"),
                dxi,
                psi: numbers(&case["Psi"]),
            });
        }
    }
    Ok(cases)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
}

pub fn shape(name: &str) -> Box<dyn Shape> {
    match name {
        "circle" => Box::new(Circle::new(1.0)),
        "square" => Box::new(Rectangle::new(1.0, 1.0)),
        "rect1x2" => Box::new(Rectangle::new(1.0, 2.0)),
        _ => Box::new(Ellipse::new(1.0, 0.5)),
    }
}

/// The rung that the balance rule names for a strain, the degree of the warping that it brings and one more in the plane; and what Ψ is to be within:
/// 5e-2 where corners at 86° a side are slow for polynomials.
pub fn rung(section: &str, strain: &str) -> ((usize, usize), f64) {
    match (section, strain) {
        (_, "rest" | "stretch+0.5" | "stretch-0.3") => ((1, 0), 1e-10),
        ("circle", "twist0.5" | "twist1.5") => ((3, 0), 1e-3),
        ("ellipse", "twist0.5") => ((5, 4), 1e-3),
        ("ellipse", "twist1.5") => ((9, 8), 1e-3),
        (_, "twist0.5") => ((7, 6), 1e-3),
        (_, "twist1.5") => ((7, 6), 5e-2),
        (_, "bend0.2") => ((4, 0), 1e-3),
        (_, "bend0.5") => ((6, 0), 1e-3),
        _ => ((4, 3), 1e-3),
    }
}

/// μ = 1.
pub fn solid(shape: Box<dyn Shape>, lambda: f64, warping: Warping) -> Outcome<Solid> {
    Ok(Relaxed::new(shape, NeoHookean::new(1.0, lambda)?)?.with_warping(warping)?)
}

/// The largest difference, relative to the largest entry of the second.
pub fn relative(got: &[f64], exact: &[f64]) -> f64 {
    let scale = exact.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    got.iter().zip(exact).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()))
        / scale.max(f64::MIN_POSITIVE)
}
