//! Every published figure and table of speed against error, in one command.
//!
//! `cargo run --release --example work_precision` measures the engine, statics, dynamics, relaxed sections and the ladder of models; writes CSV files into
//! `target/hyperrod/work_precision`, `docs/work-precision.md` and its figures from them, and renews every number that README, docs and guide quote
//! by a key of that page. `-- --page` makes the page again from the CSV files there are; `-- --quick` measures little, into
//! `target/hyperrod/work_precision/quick` alone.
//!
//! Times are lower quartiles on one thread, each beside its ratio to a loop of a thousand dependent multiply-adds.
#![allow(clippy::print_stdout)] // an example tells what it found

mod dynamics;
mod engine;
#[path = "../../benches/engine/cases.rs"]
#[allow(dead_code, reason = "other programs use the rest")]
mod engine_cases;
#[path = "../figure/mod.rs"]
mod figure;
mod machine;
mod models;
mod page;
mod quotes;
mod scenes;
#[path = "../ladder/cases.rs"]
#[allow(dead_code, reason = "other programs use the rest")]
mod section_cases;
mod sections;
mod statics;
mod table;
mod timing;

use figure::{Outcome, Output, flag};
use indicatif::{ProgressBar, ProgressStyle};
use page::Page;

/// How the command was asked to run, and where its files go.
struct Run {
    quick: bool,
    output: Output,
    /// Counts what has been timed.
    bar: ProgressBar,
}

impl Run {
    /// One of two, for the short run and the long one.
    fn of<T>(&self, quick: T, long: T) -> T {
        if self.quick { quick } else { long }
    }
}

type Part = (&'static str, fn(&Run) -> Outcome, fn(&Run, &mut Page) -> Outcome);

const PARTS: [Part; 6] = [
    ("machine", machine::measure, machine::page),
    ("engine", engine::measure, engine::page),
    ("statics", statics::measure, statics::page),
    ("dynamics", dynamics::measure, dynamics::page),
    ("sections", sections::measure, sections::page),
    ("models", models::measure, models::page),
];

fn main() -> Outcome {
    let quick = flag("--quick");
    let output = Output::of(if quick { "work_precision/quick" } else { "work_precision" })?;
    std::fs::create_dir_all(output.path("figures"))?;
    let style = ProgressStyle::with_template("{spinner} {msg}: {pos} timed, {elapsed}")?;
    let run = Run { quick, output, bar: ProgressBar::new_spinner().with_style(style) };
    let only: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let mut page = Page::new();
    for (name, measure, write) in PARTS {
        if !flag("--page") && (only.is_empty() || only.iter().any(|part| part == name)) {
            run.bar.set_message(name);
            let start = std::time::Instant::now();
            measure(&run)?;
            let seconds = start.elapsed().as_secs_f64();
            run.bar.suspend(|| println!("{name}: measured in {seconds:.1} s"));
        }
        write(&run, &mut page)?;
    }
    run.bar.finish_and_clear();
    let path = run.output.path("work-precision.md");
    std::fs::write(&path, page.text())?;
    println!("work_precision: {} keys in {}", page.keys().len(), path.display());
    if quick { Ok(()) } else { quotes::publish(&run.output, &page) }
}
