//! Scenes and their pictures, one file each: what a rod of hyperrod can be.
//!
//! `cargo run --release --example gallery -- NAME` runs one of them, without a name all. Pictures go to `target/hyperrod/gallery/`; `--docs` renews
//! those in `docs/figures/` as well; `--quick` takes coarser meshes.
#![allow(clippy::print_stdout)]

#[path = "../figure/mod.rs"]
mod figure;
mod ribbon_view;
mod tube;

mod buckled_strut;
mod graded_stiffness;
mod helix;
mod poynting;
mod ribbon;
mod snapping_arch;
mod soft_arm;
mod square_bar;
mod tendon_gripper;
mod whip;

use figure::{Outcome, Output};
use std::path::Path;
use std::time::Instant;

/// What a scene is called, and what draws it; `quick` asks for a coarse mesh.
type Scene = (&'static str, fn(quick: bool, picture: &Path) -> Outcome);

const SCENES: [Scene; 10] = [
    ("soft_arm", soft_arm::draw),
    ("helix", helix::draw),
    ("tendon_gripper", tendon_gripper::draw),
    ("buckled_strut", buckled_strut::draw),
    ("snapping_arch", snapping_arch::draw),
    ("square_bar", square_bar::draw),
    ("poynting", poynting::draw),
    ("whip", whip::draw),
    ("ribbon", ribbon::draw),
    ("graded_stiffness", graded_stiffness::draw),
];

fn main() -> Outcome {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    if let Some(unknown) = wanted.iter().find(|name| SCENES.iter().all(|(scene, _)| scene != name)) {
        let names = SCENES.map(|(name, _)| name).join(", ");
        return Err(format!("no scene {unknown}; there are {names}").into());
    }
    let output = Output::of("gallery")?;
    for (name, draw) in SCENES {
        if !wanted.is_empty() && wanted.iter().all(|w| w != name) {
            continue;
        }
        let (start, picture) = (Instant::now(), output.path(&format!("{name}.svg")));
        draw(figure::flag("--quick"), &picture)?;
        println!("{name:<18}{:>8.2} s  {}", start.elapsed().as_secs_f64(), picture.display());
        if figure::flag("--docs") {
            for part in [name.to_string(), format!("{name}_path")] {
                let picture = output.path(&format!("{part}.svg"));
                if picture.exists() {
                    figure::copy_to_docs(&picture, &format!("gallery_{part}.svg"))?;
                }
            }
        }
    }
    Ok(())
}
