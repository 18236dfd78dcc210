//! The laws that the integrals over sections leave out, at a point, against 50 digits of their textbook formulas.

use hyperrod::Strain;
use hyperrod::material::*;
use serde_json::Value;

use crate::every_law::{Visitor, every_local_law};

/// Some twenty operations, each rounded, on numbers up to ten times what they leave.
const TOLERANCE: f64 = 1e-13;

const DATA: &str = include_str!("../data/laws.json");

/// Rows of law, γ, u, ∂u/∂γ and ∂²u/∂γ² (aa, ab, ae, bb, be, ee); how many were compared, and the largest error.
struct Rows {
    data: Value,
    count: usize,
    worst: (f64, String),
}

fn number(value: &Value) -> f64 {
    value.as_f64().or_else(|| value.as_str()?.parse().ok()).unwrap()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| number(&value[i]))
}

/// The largest difference relative to the largest number; 0 where both are nothing.
fn difference(answer: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let error = answer.iter().zip(expected).fold(0.0_f64, |error, (a, b)| error.max((a - b).abs()));
    if error == 0.0 { 0.0 } else { error / size }
}

impl Rows {
    fn new() -> Self {
        Self { data: serde_json::from_str(DATA).unwrap(), count: 0, worst: (0.0, String::new()) }
    }

    fn compare(&mut self, name: &str, law: &dyn Material) {
        let one = |v: &Value| vec![number(v)];
        let points =
            Points { x: one(&self.data["x"]), y: one(&self.data["y"]), weight: vec![1.0], rates: None };
        for row in self.data["rows"].as_array().unwrap().iter().filter(|row| row[0] == name) {
            let [a, b, e] = numbers(&row[1]);
            let strain = Strain::from_array([0.0, 0.0, 0.0, a, b, e]);
            let answer = law.integrate(&points, &Station::straight(0.0), &strain, Request::Tangent).unwrap();
            let k = answer.tangent.fixed_view::<3, 3>(3, 3);
            let second = [k[(0, 0)], k[(0, 1)], k[(0, 2)], k[(1, 1)], k[(1, 2)], k[(2, 2)]];
            let error = difference(&[answer.energy], &[number(&row[2])])
                .max(difference(answer.wrench.force.as_slice(), &numbers::<3>(&row[3])))
                .max(difference(&second, &numbers::<6>(&row[4])));
            self.count += 1;
            if !(error <= self.worst.0) {
                self.worst = (error, format!("{name} at {}", row[1]));
            }
        }
    }
}

impl Visitor for Rows {
    fn visit<L: Local + Clone + 'static>(&mut self, name: &str, law: &L) {
        self.compare(name, law);
    }
}

#[test]
fn energy_stress_and_stiffness_of_every_other_law_have_fifty_digits_to_go_by() {
    let mut rows = Rows::new();
    every_local_law(&mut rows);
    assert_eq!(rows.count, 12 * 12, "twelve laws at twelve strains");
    assert!(rows.worst.0 <= TOLERANCE, "{:.1e}: {}", rows.worst.0, rows.worst.1);
}

#[test]
fn a_constant_off_by_one_part_in_a_trillion_is_seen_at_a_point() {
    let mut rows = Rows::new();
    rows.compare("Fung", &Fung::new(170e3 * (1.0 + 1e-12), 500e3, 2.5).unwrap());
    assert!(rows.count == 12 && rows.worst.0 > TOLERANCE, "{:.1e}", rows.worst.0);
}
