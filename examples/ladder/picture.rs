//! A deformed section, coloured by its stress.

use hyperrod::section::Deformed;
use plotters::style::RGBColor;
use std::path::Path;

use super::Outcome;
use super::figure::Drawing;

/// Cells of a grid in two parameters, mapped to the section by `place`, drawn where they went.
pub fn draw(
    path: &Path,
    title: &str,
    deformed: &Deformed<'_>,
    cells: [usize; 2],
    place: impl Fn(f64, f64) -> [f64; 2],
) -> Outcome {
    let at = |i: f64, k: f64| place(i / cells[0] as f64, k / cells[1] as f64);
    let mut patches = Vec::new();
    for i in 0..cells[0] {
        for k in 0..cells[1] {
            let (i, k) = (i as f64, k as f64);
            let [x, y] = at(i + 0.5, k + 0.5);
            let stress = deformed.point(x, y)?.cauchy()[(2, 2)];
            let mut corners = Vec::new();
            for (a, b) in [(i, k), (i + 1.0, k), (i + 1.0, k + 1.0), (i, k + 1.0)] {
                let [x, y] = at(a, b);
                let [x, y, _] = deformed.point(x, y)?.position;
                corners.push([x, y]);
            }
            patches.push((corners, stress));
        }
    }
    let largest = patches.iter().fold(0.0_f64, |m, (_, stress)| m.max(stress.abs()));
    let title = format!("{title}; axial Cauchy stress, blue −, red + {largest:.2} mu");
    let drawing =
        patches.into_iter().fold(Drawing::new(&title, "x / R", "y / R"), |drawing, (corners, stress)| {
            drawing.patch(corners, color(stress / largest))
        });
    drawing.save(path)
}

/// Blue for −1, white for 0, red for 1.
fn color(t: f64) -> RGBColor {
    let fade = |to: u8| (255.0 - (255.0 - f64::from(to)) * t.abs()).round() as u8;
    if t < 0.0 { RGBColor(fade(0), fade(90), fade(170)) } else { RGBColor(fade(200), fade(50), fade(0)) }
}
