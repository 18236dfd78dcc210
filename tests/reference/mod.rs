//! Reads the reference solutions in `tests/data` and builds the rods they describe.
#![allow(dead_code)] // each test binary uses its own part
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use hyperrod::lie::so3;
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::NeoHookean;
use hyperrod::section::{Circle, CrossSection, Linear, Section, Stiffness};
use hyperrod::{Body, Pose, Rod, StaticSolution, Twist};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use serde::Deserialize;
use serde_json::Value;

/// The parsed file `tests/data/NAME`.
pub fn data(name: &str) -> Value {
    let path = format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// Base pose of a case.
#[derive(Clone, Debug, Deserialize)]
pub struct Base {
    pub p: [f64; 3],
    pub q_wxyz: [f64; 4],
}

/// The reference state at one arc length.
#[derive(Clone, Debug, Deserialize)]
pub struct StationData {
    pub s: f64,
    pub p: [f64; 3],
    pub q_wxyz: [f64; 4],
    pub psi: [f64; 6],
    #[serde(default)]
    pub dxi: Option<[f64; 6]>,
}

/// A static reference case of set B or C4.
#[derive(Clone, Debug, Deserialize)]
pub struct StaticCase {
    pub id: String,
    #[serde(rename = "L")]
    pub length: f64,
    #[serde(rename = "K_diag", default)]
    pub k_diag: Option<[f64; 6]>,
    #[serde(default)]
    pub xi_ref: Option<[f64; 6]>,
    #[serde(rename = "R0", default)]
    pub radius: Option<f64>,
    #[serde(default)]
    pub taper: f64,
    #[serde(default)]
    pub material: Value,
    pub base: Base,
    pub tip_force_dead: [f64; 3],
    pub tip_moment_dead: [f64; 3],
    #[serde(default)]
    pub distributed_force_dead_per_ref_length: [f64; 3],
    pub stations: Vec<StationData>,
}

/// The static cases of a file.
pub fn static_cases(name: &str) -> Vec<StaticCase> {
    serde_json::from_value(data(name)["cases"].clone()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// One of them.
pub fn static_case(name: &str, id: &str) -> StaticCase {
    static_cases(name).into_iter().find(|case| case.id == id).unwrap_or_else(|| panic!("no {id} in {name}"))
}

pub fn rotation(q_wxyz: [f64; 4]) -> Matrix3<f64> {
    let [w, x, y, z] = q_wxyz;
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner()
}

pub fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("no number {key} in {value}"))
}

impl StaticCase {
    /// The rod the case describes: a constant stiffness, or a (tapered) neo-Hookean circle. A distributed dead force is the weight of a rod
    /// with one kilogram per metre.
    pub fn rod(&self) -> Rod<Body<Box<dyn CrossSection>, hyperrod::body::LineDensity>> {
        self.rod_with_degree(40)
    }

    /// As [`rod`](Self::rod), with a section quadrature of the given degree.
    pub fn rod_with_degree(
        &self,
        degree: usize,
    ) -> Rod<Body<Box<dyn CrossSection>, hyperrod::body::LineDensity>> {
        let section: Box<dyn CrossSection> = match self.k_diag {
            Some(k) => Box::new(Stiffness::diagonal(k).unwrap()),
            None => {
                let law =
                    NeoHookean::new(number(&self.material, "mu"), number(&self.material, "lam")).unwrap();
                let radius = self.radius.unwrap();
                if self.taper == 0.0 {
                    let section = Section::new(Circle::new(radius), law).unwrap();
                    Box::new(section.with_degree(degree).unwrap())
                } else {
                    let to = radius * (1.0 - self.taper);
                    let profile = Linear { from: radius, to, length: self.length };
                    let section = Section::new(Circle::new(profile), law).unwrap();
                    Box::new(section.with_degree(degree).unwrap())
                }
            }
        };
        let mut body = Body::new(self.length, section).unwrap();
        if let Some(xi) = self.xi_ref {
            body = body.with_reference_strain(Twist::from_array(xi)).unwrap();
        }
        let body = body.with_mass_per_length(1.0).unwrap();
        let base = Pose::new(rotation(self.base.q_wxyz), Vector3::from(self.base.p));
        let mut rod = Rod::clamped(body, base)
            .with_tip_load(DeadWrench::new(self.tip_moment_dead.into(), self.tip_force_dead.into()).unwrap());
        let weight = Vector3::from(self.distributed_force_dead_per_ref_length);
        if weight != Vector3::zeros() {
            rod = rod.with_load(Gravity::new(weight).unwrap());
        }
        rod
    }

    /// Errors of a solution at the stations, each relative to its scale: position / L, rotation, wrench / (largest wrench, moment and
    /// force apart but tied by the length).
    pub fn errors(&self, solution: &StaticSolution) -> Errors {
        let force = self
            .stations
            .iter()
            .flat_map(|st| {
                let [mx, my, mz, nx, ny, nz] = st.psi;
                [Vector3::new(nx, ny, nz).norm(), Vector3::new(mx, my, mz).norm() / self.length]
            })
            .fold(0.0, f64::max);
        let mut errors = Errors::default();
        for station in &self.stations {
            let at_station = |n: &&hyperrod::solve::Node| (n.s - station.s).abs() < 1e-9 * self.length;
            let Some(node) = solution.nodes().iter().find(at_station) else {
                // a mesh of the solver's choice has nodes where it wants, and always at both ends
                assert!(station.s > 0.0 && station.s < self.length, "{}: no node at an end", self.id);
                continue;
            };
            let p = node.pose.position - Vector3::from(station.p);
            let r = so3::log(&(node.pose.rotation.transpose() * rotation(station.q_wxyz)));
            let psi = hyperrod::Wrench::from_array(station.psi);
            let w = node.wrench - psi;
            errors.position = errors.position.max(p.norm() / self.length);
            errors.rotation = errors.rotation.max(r.norm());
            errors.wrench =
                errors.wrench.max(w.force.norm() / force).max(w.moment.norm() / (force * self.length));
            if let Some(dxi) = station.dxi {
                let d = node.strain - hyperrod::Strain::from_array(dxi);
                errors.strain = errors.strain.max(d.linear.norm()).max(d.angular.norm() * self.length);
            }
        }
        errors
    }
}

/// Largest errors of a solution over the stations of a case.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    pub position: f64,
    pub rotation: f64,
    pub wrench: f64,
    pub strain: f64,
}

impl Errors {
    pub fn worst(&self) -> f64 {
        self.position.max(self.rotation).max(self.wrench).max(self.strain)
    }
}
