//! Prints, for every law of the reference, the worst error of Ψ in small, moderate, extreme and tiny strains, and of ∂Ψ/∂Δξ.
//!
//! Errors are relative to the integrals of the absolute values over the section. `--quick` takes a coarser quadrature, enough for
//! all but the extreme strains.

#[path = "../tests/section_reference/mod.rs"]
mod section_reference;

use std::collections::BTreeMap;

use section_reference::{DEGREE, groups};

/// Worst errors of one law: Ψ by kind of strain, and K.
#[derive(Default)]
struct Row {
    tiny: f64,
    small: f64,
    moderate: f64,
    extreme: f64,
    tangent: f64,
}

#[expect(clippy::print_stdout, reason = "an example prints")]
fn main() {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let degree = if quick { 40 } else { DEGREE };
    let mut rows: BTreeMap<String, Row> = BTreeMap::new();
    for group in groups() {
        let Some(points) = group.points(degree) else { continue };
        let row = rows.entry(group.law.clone()).or_default();
        for (case, errors) in group.errors(&points) {
            let column = match case.kind.as_str() {
                "zero" | "tiny" => &mut row.tiny,
                "small" => &mut row.small,
                "moderate" => &mut row.moderate,
                _ if quick => continue, // the pole at c = 0 needs the full degree
                _ => &mut row.extreme,
            };
            *column = column.max(errors.psi);
            row.tangent = row.tangent.max(errors.k.unwrap_or(0.0));
        }
    }
    println!(
        "{:<12} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "law", "tiny", "small", "moderate", "extreme", "tangent"
    );
    for (law, row) in &rows {
        let Row { tiny, small, moderate, extreme, tangent } = row;
        let extreme = if quick { "left out".into() } else { format!("{extreme:.1e}") };
        println!("{law:<12} {tiny:>9.1e} {small:>9.1e} {moderate:>9.1e} {extreme:>9} {tangent:>9.1e}");
    }
    let worst = |column: fn(&Row) -> f64| rows.values().map(column).fold(0.0, f64::max);
    println!(
        "material_table: {} laws, worst error in Psi {:.1e}, in tangent {:.1e}, tiny strains {:.1e}",
        rows.len(),
        worst(|row| row.small.max(row.moderate).max(row.extreme)),
        worst(|row| row.tangent),
        worst(|row| row.tiny),
    );
}
