//! Ψ and ∂Ψ/∂Δξ against the 54-digit references of set A, and Ψ′ of the tapered circle (`A_taper.json`).

use std::collections::BTreeMap;

use hyperrod::material::{
    Material, MooneyRivlin, NeoHookean, Points, ReferencePressure, Request, Response, Station,
};
use hyperrod::section::*;
use hyperrod::{Strain, isotropic, local};
use serde::Deserialize;
use serde_json::Value;

use super::reference::{data, number};

#[derive(Deserialize)]
struct Case {
    #[serde(rename = "type")]
    kind: String,
    dxi: [f64; 6],
    psi: [f64; 6],
    #[serde(rename = "K_upper", default)]
    upper: Option<Vec<f64>>,
}

fn shape(section: &Value) -> Box<dyn Shape> {
    match section["kind"].as_str().unwrap() {
        "circle" => Box::new(Circle::new(number(section, "R"))),
        "annulus" => Box::new(Annulus::new(number(section, "Ri"), number(section, "Ro"))),
        "rectangle" => Box::new(Rectangle::new(number(section, "b"), number(section, "h"))),
        "ellipse" => Box::new(Ellipse::new(number(section, "a"), number(section, "b"))),
        "L" | "triangle" => {
            let vertices: Vec<[f64; 2]> = serde_json::from_value(section["vertices"].clone()).unwrap();
            Box::new(Polygon::new(vertices).unwrap())
        }
        other => panic!("unknown section {other}"),
    }
}

/// The law of a key, where the crate has it or a macro writes it in a line.
fn law(key: &str, m: &Value) -> Option<Box<dyn Material>> {
    let n = |name| number(m, name);
    Some(match key {
        "mr_raw" => Box::new(MooneyRivlin::new(n("C1"), n("C2")).unwrap()),
        "mr_pressure" => Box::new(ReferencePressure(MooneyRivlin::new(n("C1"), n("C2")).unwrap())),
        "neo_hookean" => Box::new(NeoHookean::new(n("mu"), n("lam")).unwrap()),
        "poly5_raw" => {
            let (c10, c01, c20, c11, c02) = (n("C10"), n("C01"), n("C20"), n("C11"), n("C02"));
            let (d1, d2) = (n("D1"), n("D2"));
            Box::new(isotropic!(
                [c10: f64, c01: f64, c20: f64, c11: f64, c02: f64, d1: f64, d2: f64] degree 4; |i, _at| {
                    let (p, q, v) = (i.i1(), i.i2(), i.j() * i.j());
                    p * c10 + q * c01 + p * p * c20 + p * q * c11 + q * q * c02 + v / d1 + v * v / d2
                }
            ))
        }
        "svk" => {
            let (lam, mu) = (n("lam"), n("mu"));
            Box::new(local!([lam: f64, mu: f64] degree 4; |f, _at| {
                let g = f.gamma();
                let shear = g.x * g.x + g.y * g.y;
                let e = shear + g.z * (g.z + 2.0); // q − 1
                e * e * (lam / 8.0 + mu / 4.0) + shear * (mu / 2.0)
            }))
        }
        _ => return None,
    })
}

/// ∫|·|dA of every entry: each point on its own, sizes added.
fn scale(law: &dyn Material, points: &Points, strain: &Strain) -> ([f64; 6], [f64; 36]) {
    let (mut psi, mut k) = ([0.0; 6], [0.0; 36]);
    for q in 0..points.len() {
        let one = |v: &[f64]| vec![v[q]];
        let point = Points { x: one(&points.x), y: one(&points.y), weight: one(&points.weight), rates: None };
        let Response { wrench, tangent, .. } =
            law.integrate(&point, &Station::straight(0.0), strain, Request::Tangent).unwrap();
        psi.iter_mut().zip(wrench.to_array()).for_each(|(s, v)| *s += v.abs());
        k.iter_mut().zip(tangent.iter()).for_each(|(s, v)| *s += v.abs());
    }
    (psi, k)
}

/// Enough for c = 0.05 at the rim, where ln J and 1/J are nearly singular: (1.38)^-110 = 4e-16.
const SMOOTH: usize = 130;

#[test]
fn set_a_on_every_section_with_every_law() {
    let file = data("A_section_response.json");
    let mut worst: BTreeMap<(String, String), [f64; 2]> = BTreeMap::new();
    let mut count = 0;
    for (name, laws) in file["cases"].as_object().unwrap() {
        for (key, cases) in laws.as_object().unwrap() {
            let Some(material) = law(key, &file["materials"][key]) else { continue };
            let polynomial = material.polynomial_degree().is_some();
            let mut section = Section::new(shape(&file["sections"][name]), material).unwrap();
            if !polynomial {
                section = section.with_degree(SMOOTH).unwrap();
            }
            let points =
                section.shape().place(&section.shape().rule(section.degree()).unwrap(), 0.0).unwrap();
            let cases: Vec<Case> = serde_json::from_value(cases.clone()).unwrap();
            for case in cases {
                count += 1;
                let strain = Strain::from_array(case.dxi);
                let ours = section.respond(&Station::straight(0.0), &strain, Request::Tangent).unwrap();
                let (psi_scale, k_scale) = scale(section.material().as_ref(), &points, &strain);
                let entry = worst.entry((key.clone(), case.kind.clone())).or_default();
                for ((ours, exact), scale) in ours.wrench.to_array().iter().zip(case.psi).zip(psi_scale) {
                    let error = (ours - exact).abs();
                    if error > 0.0 {
                        entry[0] = entry[0].max(error / scale);
                    }
                }
                let Some(upper) = &case.upper else { continue };
                let mut entries = upper.iter();
                for i in 0..6 {
                    for j in i..6 {
                        let error = (ours.tangent[(i, j)] - entries.next().unwrap()).abs();
                        if error > 0.0 {
                            entry[1] = entry[1].max(error / k_scale[6 * j + i]);
                        }
                    }
                }
            }
        }
    }
    for ((law, kind), [psi, k]) in &worst {
        println!("{law:12} {kind:10} Psi {psi:.1e}  K {k:.1e}");
    }
    assert_eq!(count, 200, "five laws on four sections, ten strains each");
    for (case, errors) in worst {
        assert!(errors[0] < 1e-13 && errors[1] < 1e-13, "{case:?}: {errors:?}");
    }
}

#[test]
fn the_rate_of_the_tapered_circle() {
    let file = data("A_taper.json");
    let (radius, length) = (number(&file, "R0"), number(&file, "L"));
    let taper = Linear { from: radius, to: radius / 2.0, length };
    let mut worst: f64 = 0.0;
    let mut count = 0;
    for case in file["cases"].as_array().unwrap() {
        let key = case["energy"].as_str().unwrap();
        let Some(material) = law(key, &file["materials"][key]) else { continue };
        let polynomial = material.polynomial_degree().is_some();
        let mut section = Section::new(Circle::new(taper), material).unwrap();
        if !polynomial {
            section = section.with_degree(SMOOTH).unwrap();
        }
        let numbers = |name: &str| -> [f64; 6] { serde_json::from_value(case[name].clone()).unwrap() };
        let at = Station::straight(number(case, "s"));
        let ours = section.respond(&at, &Strain::from_array(numbers("dxi")), Request::Rate).unwrap();
        worst = worst.max(super::direct::relative_difference(ours.wrench.to_array(), numbers("psi")));
        worst =
            worst.max(super::direct::relative_difference(ours.wrench_rate.to_array(), numbers("dpsi_ds")));
        count += 1;
    }
    println!("A_taper: {count} cases, worst {worst:.1e}");
    assert!(count >= 8 && worst < 1e-13, "{count} {worst:e}");
}
