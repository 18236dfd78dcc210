//! What the times were measured on.

use std::process::Command;

use super::Run;
use super::figure::Outcome;
use super::page::{Page, digits};
use super::table::Table;
use super::timing;

const FILE: &str = "machine.csv";

pub fn measure(run: &Run) -> Outcome {
    let mut table = Table::new(&["what", "value"]);
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?.to_string();
        Some(line.split(':').nth(1)?.trim().to_string())
    });
    let load = std::fs::read_to_string("/proc/loadavg").ok();
    let load = load.and_then(|text| text.split(' ').next().map(str::to_string));
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    let known = |value: Option<String>| value.unwrap_or_else(|| "unknown".into());
    table.push(&["processor", &known(processor)], &[]);
    table.push(&["widest vectors used", widest()], &[]);
    table.push(&["cores", &cores.to_string()], &[]);
    table.push(&["load at the start", &known(load)], &[]);
    table.push(&["system", &format!("{} {}", std::env::consts::OS, std::env::consts::ARCH)], &[]);
    table.push(&["compiler", &known(output_of("rustc", &["--version"]))], &[]);
    table.push(&["build", "cargo --release without flags"], &[]);
    table.push(&["revision", &known(output_of("git", &["describe", "--always", "--dirty"]))], &[]);
    table.push(&["date", &known(output_of("date", &["-u", "+%Y-%m-%d"]))], &[]);
    table.push(&["calibration loop, µs"], &[timing::tick()]);
    table.save(&run.output.path(FILE))
}

fn widest() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f") {
            return "AVX-512";
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            return "AVX2";
        }
    }
    "portable"
}

fn output_of(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).trim().to_string();
    (output.status.success() && !text.is_empty()).then_some(text)
}

pub fn page(run: &Run, page: &mut Page) -> Outcome {
    page.paragraph(
        "Written by `cargo run --release --example work_precision`, figures included; the numbers behind it are in \
         `target/hyperrod/work_precision/*.csv` after that. Lower quartiles on one thread, of as many calls as fit into a fifth of a second. The machine is \
         shared: single times are good to about ±30 %. Each has its ratio to a *tick* beside it, the time of a loop of a thousand dependent multiply-adds, \
         measured next to it. Before every number that is quoted elsewhere stands its key, in a comment.",
    );
    let table = Table::load(&run.output.path(FILE))?;
    let mut rows = Vec::new();
    for row in table.rows() {
        let (what, mut value) = (row.text("what"), row.text("value").to_string());
        if what.starts_with("calibration") {
            value = page.key("machine.tick.us", &digits(row.number("value")));
        }
        rows.push(vec![what.to_string(), value]);
    }
    page.table(&["machine", ""], &rows);
    Ok(())
}
