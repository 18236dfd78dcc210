//! A twisted square bar: how its section leaves its plane. Nothing is typed in but the energy of the rubber.

use crate::figure::{BLUE, Drawing, ORANGE, Outcome};
use hyperrod::Strain;
use hyperrod::material::{NeoHookean, Station};
use hyperrod::section::{EffectiveStiffness, Rectangle, Relaxed};
use plotters::style::RGBColor;
use std::path::Path;

const SIDE: f64 = 0.010; // m
const TWIST: f64 = 40.0; // rad/m

pub fn draw(quick: bool, picture: &Path) -> Outcome {
    let bar = Relaxed::new(Rectangle::new(SIDE, SIDE), NeoHookean::from_young(1e6, 0.45)?)?;
    let at = Station::straight(0.0);
    let polar = SIDE.powi(4) / 6.0;
    let rest = EffectiveStiffness::of(&bar, &at, &Strain::zero())?;
    let constant = rest.torsion / (1e6 / 2.9 * polar); // of G (I_x + I_y); Saint-Venant's is 0.8435
    let mut strain = Strain::zero();
    strain.angular.z = TWIST;
    let section = bar.deformed(&at, &strain)?;

    let count = if quick { 10 } else { 24 };
    let corner = |i: usize| SIDE * (i as f64 / count as f64 - 0.5);
    let mut cells = Vec::new();
    let mut largest: f64 = 0.0;
    for (i, j) in (0..count * count).map(|k| (k / count, k % count)) {
        let place = |i: usize, j: usize| section.point(corner(i), corner(j)).map(|p| p.position);
        let corners = [place(i, j)?, place(i + 1, j)?, place(i + 1, j + 1)?, place(i, j + 1)?];
        let warping = corners.iter().map(|p| p[2]).sum::<f64>() / 4.0;
        largest = largest.max(warping.abs());
        cells.push((corners.map(|p| [p[0] * 1e3, p[1] * 1e3]).to_vec(), warping));
    }
    let title = format!(
        "10 mm square bar twisted by {TWIST} rad/m: warping (at rest GJ = {constant:.3} G (Ix + Iy))"
    );
    let mut drawing = Drawing::new(&title, "x, mm", "y, mm")
        .legend(&format!("w = +{:.2} mm along the bar", largest * 1e3), ORANGE)
        .legend(&format!("−{:.2} mm, white 0", largest * 1e3), BLUE);
    for (outline, warping) in cells {
        drawing = drawing.cell(outline, shade(warping / largest));
    }
    drawing.save(picture)
}

/// From blue at −1 through white to orange at 1.
fn shade(value: f64) -> RGBColor {
    let RGBColor(r, g, b) = if value > 0.0 { ORANGE } else { BLUE };
    let mix = |c: u8| (255.0 + (f64::from(c) - 255.0) * value.abs().min(1.0)) as u8;
    RGBColor(mix(r), mix(g), mix(b))
}
