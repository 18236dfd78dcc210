//! Finite strain against closed forms: Mooney's tension, Rivlin's torsion.

use hyperrod::material::{MooneyRivlin, NeoHookean, ReferencePressure};
use hyperrod::section::{Circle, Relaxed, Warping};
use std::f64::consts::PI;

use super::{Outcome, Tally, respond, warping};

pub fn run(tally: &mut Tally) -> Outcome {
    for (law, c1, c2) in [("neo-Hookean", 0.5, 0.0), ("Mooney-Rivlin", 0.4, 0.1)] {
        let rubber = ReferencePressure(MooneyRivlin::new(c1, c2)?);
        for rung in [Warping::CONTRACTION, Warping::SHEAR] {
            let section = Relaxed::incompressible(Circle::new(1.0), rubber)?.with_warping(rung)?;
            let (stretch, twist): (f64, f64) = (1.5, 0.5);
            let tension = respond(&section, [0.0, 0.0, 0.0, 0.0, 0.0, stretch - 1.0])?.wrench.force.z;
            let mooney = 2.0 * PI * (stretch - stretch.powi(-2)) * (c1 + c2 / stretch);
            let torsion = respond(&section, [0.0, 0.0, twist, 0.0, 0.0, 0.0])?.wrench;
            let (torque, force) = (PI * twist * (c1 + c2), -0.5 * PI * twist * twist * (c1 + 2.0 * c2));
            let name = format!("incompressible {rung}");
            tally.line(&format!("{law} cylinder: tension at 1.5"), &name, tension, mooney, 1e-8);
            tally.line(&format!("{law} cylinder: torque at 0.5"), &name, torsion.moment.z, torque, 1e-8);
            tally.line(&format!("{law} cylinder: axial force of twist"), &name, torsion.force.z, force, 1e-8);
        }
    }
    // ν = 0.499 without the pressure, at the shear modulus of the incompressible one
    let (mu, poisson) = (1.0, 0.499);
    let law = NeoHookean::from_young(2.0 * mu * (1.0 + poisson), poisson)?;
    let section = Relaxed::new(Circle::new(1.0), law)?.with_warping(warping((3, 0)))?;
    let tension = respond(&section, [0.0, 0.0, 0.0, 0.0, 0.0, 0.5])?.wrench.force.z;
    let torsion = respond(&section, [0.0, 0.0, 0.5, 0.0, 0.0, 0.0])?.wrench;
    let rung = warping((3, 0)).to_string();
    tally.line("nu = 0.499: tension at 1.5", &rung, tension, PI * mu * (1.5 - 1.5_f64.powi(-2)), 1e-3);
    tally.line("nu = 0.499: torque at 0.5", &rung, torsion.moment.z, PI * mu * 0.25, 1e-3);
    // the force is the law's own pressure: below Rivlin's by (μ/λ)(1 + τ²a²/3), 2.2e-3 (radial balance to second order in 1/λ)
    let compressible = 1.0 - (1.0 - 2.0 * poisson) / (2.0 * poisson) * (1.0 + 0.25 / 3.0);
    let force = -PI * mu / 16.0 * compressible;
    tally.line("nu = 0.499: axial force of twist", &rung, torsion.force.z, force, 1e-3);
    println!("  (below Rivlin's incompressible one by {:.1e})", 1.0 + torsion.force.z / (PI * mu / 16.0));
    Ok(())
}
