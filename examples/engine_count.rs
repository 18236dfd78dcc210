//! A fixed number of evaluations and nothing else, for counting instructions: `.ci/instructions` runs it under callgrind.
//!
//! `engine_count CASE COUNT` evaluates one case COUNT times; the difference of two counts is what an evaluation costs.

#[path = "../benches/engine/cases.rs"]
#[allow(dead_code, reason = "only the engine's own side is counted")]
mod cases;

use cases::{LAME, PolyIsotropic, PolyLocal, PolySectional, rings, strains};
use hyperrod::material::{Material, MooneyRivlin, NeoHookean, ReferencePressure, Request, Station};
use hyperrod::section::{Circle, CrossSection, Section};
use std::hint::black_box;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--quick");
    let case = arguments.next().unwrap_or_else(|| "local".into());
    let count: usize = arguments.next().map_or(Ok(100), |n| n.parse())?;
    let (points, strains, at) = (rings(0.01), strains(64), Station::straight(0.0));
    let neo_hookean = NeoHookean::new(LAME[0], LAME[1])?;
    let section = Section::new(Circle::new(0.01), ReferencePressure(MooneyRivlin::new(120e3, 40e3)?))?;
    let (material, request): (&dyn Material, _) = match case.as_str() {
        "energy" => (&PolyLocal, Request::Energy),
        "wrench" => (&PolyLocal, Request::Wrench),
        "rate" => (&PolyLocal, Request::Rate),
        "isotropic" => (&PolyIsotropic, Request::Tangent),
        "sectional" => (&PolySectional, Request::Tangent),
        "logarithm" => (&neo_hookean, Request::Tangent),
        "local" | "quadratic" => (&PolyLocal, Request::Tangent),
        other => return Err(format!("no case {other}").into()),
    };
    for strain in strains.iter().cycle().take(count) {
        let strain = black_box(strain);
        if case == "quadratic" {
            let _ = black_box(&section.respond(&at, strain, request));
        } else {
            let _ = black_box(&material.integrate(&points, &at, strain, request));
        }
    }
    Ok(())
}
