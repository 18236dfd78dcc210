//! Reads `tests/data/A_section_response.json`: Ψ and ∂Ψ/∂Δξ of eight laws on four sections in 54-digit arithmetic.
#![allow(dead_code)] // each binary uses its own part
#![allow(clippy::expect_used, clippy::unwrap_used)] // a test stops where its data are wrong

use hyperrod::material::*;
use hyperrod::quadrature::{Polygon, Rule, annulus};
use hyperrod::section::{Circle, Rectangle, Shape};
use hyperrod::{Error, Strain};
use num_dual::Dual2SVec64;
use serde_json::Value;

/// The quadrature degree at which every case, c = 0.05 in the outermost fibre included, has converged to rounding: the pole of
/// ln J at c = 0 lies 5 % outside the section, so the error falls like 1.37^−degree.
pub const DEGREE: usize = 160;

/// One strain and the reference answer.
pub struct Case {
    pub kind: String,
    pub strain: Strain,
    pub psi: [f64; 6],
    /// Upper triangle, row by row; not every case has it.
    pub k_upper: Option<Vec<f64>>,
}

/// All cases of one law on one section.
pub struct Group {
    pub section: String,
    pub law: String,
    pub shape: Value,
    pub constants: Value,
    pub cases: Vec<Case>,
}

/// Every group of the file, sections without a shape here left out.
pub fn groups() -> Vec<Group> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/A_section_response.json"));
    let data: Value = serde_json::from_str(text).expect("the reference file is JSON");
    let mut groups = Vec::new();
    for (section, laws) in data["cases"].as_object().expect("sections") {
        for (law, cases) in laws.as_object().expect("laws") {
            groups.push(Group {
                section: section.clone(),
                law: law.clone(),
                shape: data["sections"][section].clone(),
                constants: data["materials"][law].clone(),
                cases: cases.as_array().expect("cases").iter().map(case).collect(),
            });
        }
    }
    groups
}

/// A rule's points, where no shape is needed.
pub fn as_points(rule: Rule) -> Points {
    let [x, y, weight] = [rule.x(), rule.y(), rule.weights()].map(<[f64]>::to_vec);
    Points { x, y, weight, rates: None }
}

fn case(value: &Value) -> Case {
    Case {
        kind: value["type"].as_str().expect("type").into(),
        strain: Strain::from_array(six(&value["dxi"])),
        psi: six(&value["psi"]),
        k_upper: value["K_upper"].as_array().map(|k| k.iter().map(number).collect()),
    }
}

fn six(value: &Value) -> [f64; 6] {
    std::array::from_fn(|i| number(&value[i]))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

impl Group {
    /// The points of the section; `None` for a kind of section not known here.
    pub fn points(&self, degree: usize) -> Option<Points> {
        let size = |name: &str| number(&self.shape[name]);
        let place = |shape: &dyn Shape| shape.rule(degree).and_then(|rule| shape.place(&rule, 0.0));
        let vertex = |v: &Value| [number(&v[0]), number(&v[1])];
        let points = match self.shape["kind"].as_str()? {
            "circle" => place(&Circle::new(size("R"))),
            "rectangle" => place(&Rectangle::new(size("b"), size("h"))),
            "annulus" => annulus(degree).and_then(|r| r.at(size("Ri"), size("Ro"))).map(as_points),
            "L" => {
                let vertices = self.shape["vertices"].as_array()?.iter().map(vertex).collect();
                Polygon::new(vertices).and_then(|polygon| polygon.rule(degree)).map(as_points)
            }
            _ => return None,
        };
        Some(points.expect("the section is admissible"))
    }

    /// Errors of every case of this law on this section.
    pub fn errors(&self, points: &Points) -> Vec<(&Case, Errors)> {
        let get = |name: &str| number(&self.constants[name]);
        let poly = || {
            let c = [
                ((1, 0), get("C10")),
                ((0, 1), get("C01")),
                ((2, 0), get("C20")),
                ((1, 1), get("C11")),
                ((0, 2), get("C02")),
            ];
            (c, [get("D1"), get("D2")])
        };
        match self.law.as_str() {
            "mr_raw" => self.compare(&MooneyRivlin::new(get("C1"), get("C2")), points),
            "mr_pressure" => {
                self.compare(&MooneyRivlin::new(get("C1"), get("C2")).map(ReferencePressure), points)
            }
            "poly5_raw" => {
                let (c, d) = poly();
                self.compare(&Polynomial::with_divisors(&c, &d), points)
            }
            "poly5_bar" => {
                let (c, d) = poly();
                self.compare(&IsochoricPolynomial::with_divisors(&c, &d), points)
            }
            "neo_hookean" => self.compare(&NeoHookean::new(get("mu"), get("lam")), points),
            "svk" => self.compare(&SaintVenantKirchhoff::new(get("mu"), get("lam")), points),
            "gent" => self.compare(&Gent::new(get("mu"), get("lam"), get("Jm")), points),
            "mr_relaxed" => self.compare(&Ok(relaxed_fibre(get("C1"), get("C2"))), points),
            other => panic!("no law {other}"),
        }
    }

    fn compare<L: Sectional>(&self, law: &Result<L, Error>, points: &Points) -> Vec<(&Case, Errors)> {
        let law: &dyn Law = law.as_ref().unwrap_or_else(|error| panic!("{}: {error}", self.law));
        self.cases.iter().map(|case| (case, errors(law, points, case))).collect()
    }
}

/// A fibre of incompressible Mooney–Rivlin rubber that is free to contract, lateral stretch c^(−1/2); its differences are
/// factored: 2/c + c² − 3 = (c−1)²(c+2)/c and 1/c² + 2c − 3 = (c−1)²(2c+1)/c².
pub fn relaxed_fibre(c1: f64, c2: f64) -> impl Isotropic {
    hyperrod::isotropic!([c1: f64, c2: f64] |i, _at| {
        let (e, c) = (i.j(), i.j() + 1.0);
        let shear = i.i1_excess() - e * e;
        let i1 = shear + e * e * (e + 3.0) / c;
        let i2 = (shear + e * e * (e * 2.0 + 3.0) / c) / c;
        i1 * c1 + i2 * c2
    })
}

/// Errors relative to the integrals of the absolute values, ∫|∂u/∂Δξ| dA and ∫|∂²u/∂Δξ²| dA; moments and forces, and the blocks of K, are
/// each measured against their largest one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    pub psi: f64,
    pub k: Option<f64>,
}

/// A law and its energy density with a full Hessian: an object, so that what is done with it is compiled once.
trait Law: Material {
    fn hessian(&self, strain: &Strain<Dual2SVec64<6>>, at: &Point) -> Dual2SVec64<6>;
}

impl<L: Sectional> Law for L {
    fn hessian(&self, strain: &Strain<Dual2SVec64<6>>, at: &Point) -> Dual2SVec64<6> {
        self.energy_density(strain, &at.cast())
    }
}

fn errors(law: &dyn Law, points: &Points, case: &Case) -> Errors {
    let response = law
        .integrate(points, &Station::straight(0.0), &case.strain, Request::Tangent)
        .unwrap_or_else(|error| panic!("{}: {error}", case.kind));
    let (psi_scale, k_scale) = absolute_integrals(law, points, &case.strain);
    let psi = response.wrench.to_vector();
    let block = |i: usize| i / 3;
    let psi_error = (0..6)
        .map(|i| {
            let scale = (0..6).filter(|&j| block(j) == block(i)).map(|j| psi_scale[j]).fold(0.0, f64::max);
            relative(psi[i] - case.psi[i], scale)
        })
        .fold(0.0, f64::max);
    let k_error = case.k_upper.as_ref().map(|upper| {
        let mut worst = 0.0_f64;
        let pairs = (0..6).flat_map(|i| (i..6).map(move |j| (i, j)));
        for ((i, j), expected) in pairs.zip(upper) {
            let same = |&(m, n): &(usize, usize)| block(m) == block(i) && block(n) == block(j);
            let all = (0..6).flat_map(|m| (0..6).map(move |n| (m, n)));
            let scale = all.filter(same).map(|(m, n)| k_scale[m][n]).fold(0.0, f64::max);
            worst = worst.max(relative(response.tangent[(i, j)] - expected, scale));
        }
        worst
    });
    Errors { psi: psi_error, k: k_error }
}

fn relative(error: f64, scale: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error.abs() / scale }
}

fn absolute_integrals(law: &dyn Law, points: &Points, strain: &Strain) -> ([f64; 6], [[f64; 6]; 6]) {
    let (mut psi, mut k) = ([0.0; 6], [[0.0; 6]; 6]);
    let xi = strain.to_array();
    let xi = Strain::from_array(std::array::from_fn(|i| Dual2SVec64::<6>::from_re(xi[i]).derivative(i)));
    for q in 0..points.len() {
        let at = Point { x: points.x[q], y: points.y[q], s: 0.0 };
        let u = law.hessian(&xi, &at);
        let gradient = u.v1.unwrap_generic(nalgebra::U1, nalgebra::U6);
        let hessian = u.v2.unwrap_generic(nalgebra::U6, nalgebra::U6);
        for i in 0..6 {
            psi[i] += points.weight[q] * gradient[i].abs();
            for j in 0..6 {
                k[i][j] += points.weight[q] * hessian[(i, j)].abs();
            }
        }
    }
    (psi, k)
}
