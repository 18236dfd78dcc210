//! Tapered tension, pure bending and torsion with a free end (set C), solved at the section by Newton on its wrench and tangent.

use hyperrod::material::*;
use hyperrod::quadrature::{annulus, gauss_legendre};
use hyperrod::section::{Circle, CrossSection, Linear, Rectangle, Section, Shape};
use hyperrod::{Strain, Wrench};
use serde_json::Value;

/// Far below what 1e-9 needs: the strains of set C stay away from c = 0 by 0.1 at least.
const DEGREE: usize = 80;

fn cases(name: &str) -> Vec<Value> {
    let path = format!("{}/tests/data/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    data["cases"].as_array().unwrap().clone()
}

fn get(value: &Value, name: &str) -> f64 {
    value[name].as_f64().unwrap_or_else(|| panic!("no {name} in {value}"))
}

/// Newton on ν_z until n_z is the given force, the other strains held; the step is shortened where a state is inadmissible.
fn solve_axial(section: &dyn CrossSection, at: &Station, mut strain: Strain, force: f64) -> (Strain, Wrench) {
    for _ in 0..100 {
        let response = section.respond(at, &strain, Request::Tangent).expect("admissible");
        let correction = (force - response.wrench.force.z) / response.tangent[(5, 5)];
        if correction.abs() < 1e-15 * (1.0 + strain.linear.z.abs()) {
            return (strain, response.wrench);
        }
        let mut step = correction;
        loop {
            let mut next = strain;
            next.linear.z += step;
            if section.respond(at, &next, Request::Wrench).is_ok() {
                strain = next;
                break;
            }
            step *= 0.5;
            assert!(step.abs() > 1e-14, "no admissible step");
        }
    }
    let response = section.respond(at, &strain, Request::Tangent).expect("admissible");
    // rounding may keep the last correction from falling below one unit
    assert!(((force - response.wrench.force.z) / response.tangent[(5, 5)]).abs() < 1e-12);
    (strain, response.wrench)
}

/// Points filled with a law.
struct Filled<L> {
    points: Points,
    law: L,
}

impl<L: Material> CrossSection for Filled<L> {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> hyperrod::Result<Response> {
        self.law.integrate(&self.points, at, strain, request)
    }
}

fn section(case: &Value) -> Option<Box<dyn CrossSection>> {
    fn fill<L: Material + 'static>(case: &Value, law: hyperrod::Result<L>) -> Option<Box<dyn CrossSection>> {
        let (shape, law) = (&case["section"], law.expect("the constants are admissible"));
        let size = |name: &str| get(shape, name);
        let place = |shape: &dyn Shape| shape.rule(DEGREE).and_then(|rule| shape.place(&rule, 0.0));
        let points = match shape["kind"].as_str()? {
            "circle" => place(&Circle::new(shape.get("Ro").or(shape.get("R"))?.as_f64()?)),
            "rectangle" => place(&Rectangle::new(size("b"), size("h"))),
            "annulus" => annulus(DEGREE)
                .and_then(|rule| rule.at(size("Ri"), size("Ro")))
                .map(crate::section_reference::as_points),
            _ => return None,
        };
        Some(Box::new(Filled { points: points.expect("an admissible section"), law }))
    }
    let constants = &case["material"];
    let c = |name: &str| get(constants, name);
    match case["energy"].as_str()? {
        "neo_hookean" => fill(case, NeoHookean::new(c("mu"), c("lam"))),
        "svk" => fill(case, SaintVenantKirchhoff::new(c("mu"), c("lam"))),
        "gent" => fill(case, Gent::new(c("mu"), c("lam"), c("Jm"))),
        "mr_pressure" => fill(case, MooneyRivlin::new(c("C1"), c("C2")).map(ReferencePressure)),
        "mr_relaxed" => fill(case, Ok(crate::section_reference::relaxed_fibre(c("C1"), c("C2")))),
        "poly5_bar" => {
            let powers =
                [((1, 0), "C10"), ((0, 1), "C01"), ((2, 0), "C20"), ((1, 1), "C11"), ((0, 2), "C02")];
            let table = powers.map(|(powers, name)| (powers, c(name)));
            fill(case, IsochoricPolynomial::with_divisors(&table, &[c("D1"), c("D2")]))
        }
        other => panic!("no law {other}"),
    }
}

fn assert_close(actual: f64, expected: f64, scale: f64, what: &str) {
    assert!((actual - expected).abs() <= 1e-9 * scale, "{what}: {actual} instead of {expected}");
}

#[test]
fn a_tapered_rod_in_tension_stretches_as_the_reference_says() {
    for case in cases("C1_tapered_tension") {
        let (radius, length) = (get(&case, "R0"), get(&case, "L"));
        let shape = Circle::new(Linear { from: radius, to: 0.5 * radius, length });
        let section =
            Section::new(shape, NeoHookean::new(get(&case, "mu"), get(&case, "lam")).unwrap()).unwrap();
        let stretch = |s: f64| {
            // start near the answer: the load of the last case is far from rest
            let mut strain = Strain::zero();
            for fraction in 1..=20 {
                let force = get(&case, "F") * f64::from(fraction) / 20.0;
                strain = solve_axial(&section, &Station::straight(s), strain, force).0;
            }
            1.0 + strain.linear.z
        };
        for (name, s) in [("c_base", 0.0), ("c_mid", 0.5 * length), ("c_tip", length)] {
            assert_close(stretch(s), get(&case, name), get(&case, name), name);
        }
        let line = gauss_legendre(24).unwrap().on(0.0, length).unwrap();
        let tip: f64 = line.iter().map(|(s, w)| w * stretch(s)).sum();
        assert_close(tip, get(&case, "tip_z"), get(&case, "tip_z"), "tip");
    }
}

#[test]
fn pure_bending_without_axial_force_shifts_the_neutral_axis_as_the_reference_says() {
    let mut rows = 0;
    for case in cases("C2_pure_bending") {
        let section = section(&case).expect("a known kind of section");
        for row in case["rows"].as_array().unwrap() {
            let mut strain = Strain::zero();
            strain.angular.y = get(row, "omega_y");
            strain.linear.z = 0.9 * get(row, "nu_z");
            let (strain, wrench) = solve_axial(&*section, &Station::straight(0.0), strain, 0.0);
            assert_close(strain.linear.z, get(row, "nu_z"), 1.0, &case["id"].to_string());
            assert_close(wrench.moment.y, get(row, "m_y"), get(row, "m_y"), &case["id"].to_string());
            rows += 1;
        }
    }
    assert!(rows >= 15, "{rows} rows");
}

#[test]
fn a_twisted_rod_lengthens_or_shortens_as_the_reference_says() {
    let mut rows = 0;
    for case in cases("C3_torsion_poynting") {
        let section = section(&case).expect("a known kind of section");
        for row in case["rows"].as_array().unwrap() {
            let torque = get(row, "torque");
            let mut strain = Strain::zero();
            strain.angular.z = get(row, "omega_z");
            let (strain, wrench) = solve_axial(&*section, &Station::straight(0.0), strain, 0.0);
            assert_close(1.0 + strain.linear.z, get(row, "axial_stretch_c"), 1.0, &case["id"].to_string());
            assert_close(wrench.moment.z, torque, torque, &case["id"].to_string());
            rows += 1;
        }
    }
    assert!(rows >= 32, "{rows} rows");
}
