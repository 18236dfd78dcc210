//! Three scenes for the ladder of models: a soft silicone arm, a catheter, a steel rod. Each is the same rod with any of its sections.

use hyperrod::body::{Constraint, LineDensity};
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::{NeoHookean, Station};
use hyperrod::section::{Circle, CrossSection, Relaxed, Section, Shape, Stiffness, Warping};
use hyperrod::{Body, Pose, Rod, Strain};
use nalgebra::{Vector3, vector};
use std::f64::consts::PI;

use super::figure::Outcome;

pub type Beam = Body<Box<dyn CrossSection>, LineDensity>;

pub struct Scene {
    /// For keys.
    pub short: &'static str,
    pub title: &'static str,
    pub length: f64,
    pub radius: f64,
    young: f64,
    poisson: f64,
    density: f64,
    /// In units of EI/L² and EI/L.
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

/// Sections from the cheapest to the scene's own.
pub const SECTIONS: [&str; 5] =
    ["linear law", "rigid, E and G matched", "rigid, datasheet", "relaxed, anticlastic", "relaxed, shear"];

pub fn scenes() -> [Scene; 3] {
    [
        Scene {
            short: "arm",
            title: "Soft silicone arm: L = 0.2 m, L/r = 8, E = 600 kPa, ν = 0.45, its weight and a tip force in one plane",
            length: 0.2,
            radius: 0.025,
            young: 600e3,
            poisson: 0.45,
            density: 1070.0,
            force: vector![-1.5, 0.0, 0.5],
            moment: Vector3::zeros(),
        },
        Scene {
            short: "catheter",
            title: "Catheter: L = 1 m, L/r = 1000, E = 50 MPa, ν = 0.45, tip force and moment out of every plane, buoyant",
            length: 1.0,
            radius: 1e-3,
            young: 50e6,
            poisson: 0.45,
            density: 1e-3,
            force: vector![4.0, 2.0, -1.0],
            moment: vector![0.0, 0.0, 2.0],
        },
        Scene {
            short: "steel",
            title: "Steel rod: L = 0.5 m, L/r = 100, E = 200 GPa, ν = 0.3, its weight and a tip force in one plane",
            length: 0.5,
            radius: 5e-3,
            young: 200e9,
            poisson: 0.3,
            density: 7850.0,
            force: vector![-0.2, 0.0, 0.1],
            moment: Vector3::zeros(),
        },
    ]
}

impl Scene {
    pub fn section(&self, name: &str) -> Outcome<Box<dyn CrossSection>> {
        let circle = || -> Box<dyn Shape> { Box::new(Circle::new(self.radius)) };
        let material = NeoHookean::from_young(self.young, self.poisson)?;
        let relaxed = |warping| Relaxed::new(circle(), material)?.with_warping(warping);
        let shear = self.young / (2.0 * (1.0 + self.poisson));
        Ok(match name {
            "linear law" => {
                let k = relaxed(Warping::SHEAR)?.tangent(&Station::straight(0.0), &Strain::zero())?;
                Box::new(Stiffness::new(0.5 * (k + k.transpose()))?)
            }
            // λ + 2μ = E
            "rigid, E and G matched" => {
                Box::new(Section::new(circle(), NeoHookean::new(shear, self.young - 2.0 * shear)?)?)
            }
            "rigid, datasheet" => Box::new(Section::new(circle(), material)?),
            "relaxed, anticlastic" => Box::new(relaxed(Warping::ANTICLASTIC)?),
            _ => Box::new(relaxed(Warping::SHEAR)?),
        })
    }

    pub fn rod(&self, section: &str, constraint: Constraint) -> Outcome<Rod<Beam>> {
        let mass = self.density * PI * self.radius * self.radius;
        let body = Body::new(self.length, self.section(section)?)?.with_constraint(constraint);
        let bending = self.young * PI * self.radius.powi(4) / 4.0;
        let (moment, force) =
            (self.moment * bending / self.length, self.force * bending / self.length.powi(2));
        Ok(Rod::clamped(body.with_mass_per_length(mass)?, Pose::identity())
            .with_load(Gravity::new(vector![-9.81, 0.0, 0.0])?)
            .with_tip_load(DeadWrench::new(moment, force)?))
    }
}
