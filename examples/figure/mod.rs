//! Figures and tables of the examples: where they go, CSV files, line charts, and drawings with equal axes.
//!
//! Everything is written into `target/hyperrod/<example>/`.

#![allow(dead_code, unused_imports, reason = "each example uses its own part")]

mod animation;
mod chart;
mod drawing;
mod frame;
mod scale;
mod sheet;

pub use animation::Animation;
pub use chart::{Chart, Marker, Slope, stack};
pub use drawing::{Drawing, silhouette};
pub use sheet::{BLUE, GREEN, GREY, ORANGE, PURPLE, SKY};

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

pub type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// The output folder of an example, and how it was asked to run.
pub struct Output {
    folder: PathBuf,
}

impl Output {
    /// Makes `target/hyperrod/<example>/`, below `CARGO_TARGET_DIR` where that is set.
    pub fn of(example: &str) -> Outcome<Self> {
        let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or(manifest.join("target"), PathBuf::from);
        let folder = target.join("hyperrod").join(example);
        std::fs::create_dir_all(&folder)?;
        Ok(Self { folder })
    }

    /// Where a file of that name goes.
    pub fn path(&self, file: &str) -> PathBuf {
        self.folder.join(file)
    }

    /// Writes a CSV file: a header (with units), then the rows, with all their digits.
    pub fn csv<const N: usize>(
        &self,
        file: &str,
        header: [&str; N],
        rows: impl IntoIterator<Item = [f64; N]>,
    ) -> Outcome {
        let mut text = header.join(",") + "\n";
        for row in rows {
            writeln!(text, "{}", row.map(|v| format!("{v:?}")).join(","))?;
        }
        Ok(std::fs::write(self.path(file), text)?)
    }
}

/// Whether `flag` was given on the command line. Every example takes `--quick`, the short run of continuous integration.
pub fn flag(flag: &str) -> bool {
    std::env::args().any(|argument| argument == flag)
}

/// Copies a figure to `docs/figures/`, where the README shows it.
pub fn copy_to_docs(figure: &Path, name: &str) -> Outcome {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/figures");
    std::fs::create_dir_all(&folder)?;
    std::fs::copy(figure, folder.join(name))?;
    Ok(())
}
