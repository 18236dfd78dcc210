use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::path::Path;

use super::Outcome;

/// Colours that differ for colour-blind readers too (Okabe and Ito, 2008).
pub const BLUE: RGBColor = RGBColor(0, 114, 178);
pub const ORANGE: RGBColor = RGBColor(213, 94, 0);
pub const GREEN: RGBColor = RGBColor(0, 158, 115);
pub const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub const SKY: RGBColor = RGBColor(86, 180, 233);
pub const AMBER: RGBColor = RGBColor(230, 159, 0);
pub const GREY: RGBColor = RGBColor(120, 120, 120);
pub const INK: RGBColor = RGBColor(40, 40, 40);

/// The backend rounds to whole units: eight of them a pixel keep curves smooth.
const FINE: f64 = 8.0;

/// Size of text, pixels.
pub const TEXT: f64 = 14.0;

/// A white sheet measured in pixels, y down.
pub struct Sheet<'a> {
    area: DrawingArea<SVGBackend<'a>, Shift>,
}

impl Sheet<'_> {
    /// Draws on a sheet of that size and writes it as SVG.
    pub fn save(path: &Path, size: [f64; 2], draw: impl FnOnce(&Sheet<'_>) -> Outcome) -> Outcome {
        let [width, height] = size.map(|v| v.round() as u32);
        let [w, h] = size.map(|v| (v.round() * FINE) as u32);
        let mut svg = String::new();
        {
            let sheet = Sheet { area: SVGBackend::with_string(&mut svg, (w, h)).into_drawing_area() };
            sheet.area.fill(&WHITE)?;
            draw(&sheet)?;
            sheet.area.present()?;
        }
        let fine = format!("width=\"{w}\" height=\"{h}\" viewBox");
        let coarse = format!("width=\"{width}\" height=\"{height}\" viewBox");
        Ok(std::fs::write(path, svg.replacen(&fine, &coarse, 1))?)
    }

    pub fn line(&self, points: &[[f64; 2]], color: RGBColor, width: f64) -> Outcome {
        let style = color.stroke_width((width * FINE) as u32);
        Ok(self.area.draw(&PathElement::new(points.iter().map(fine).collect::<Vec<_>>(), style))?)
    }

    pub fn polygon(&self, points: &[[f64; 2]], color: RGBColor, opacity: f64) -> Outcome {
        let style = color.mix(opacity).filled();
        Ok(self.area.draw(&Polygon::new(points.iter().map(fine).collect::<Vec<_>>(), style))?)
    }

    pub fn disc(&self, centre: [f64; 2], radius: f64, color: RGBColor) -> Outcome {
        Ok(self.area.draw(&Circle::new(fine(&centre), (radius * FINE) as i32, color.filled()))?)
    }

    /// A circle, white inside.
    pub fn ring(&self, centre: [f64; 2], radius: f64, color: RGBColor) -> Outcome {
        self.disc(centre, radius, color)?;
        self.disc(centre, radius - 1.6, WHITE)
    }

    /// Text at a point: `h` in {−1, 0, 1} puts it right of the point, centred, left of it; `v` below, centred, above.
    pub fn text(&self, text: &str, at: [f64; 2], [h, v]: [i8; 2], size: f64) -> Outcome {
        self.draw_text(text, at, [h, v], size, FontTransform::None)
    }

    /// Text that reads upward, centred on the point.
    pub fn text_upward(&self, text: &str, at: [f64; 2]) -> Outcome {
        self.draw_text(text, at, [0, 0], TEXT, FontTransform::Rotate270)
    }

    fn draw_text(
        &self,
        text: &str,
        at: [f64; 2],
        [h, v]: [i8; 2],
        size: f64,
        turn: FontTransform,
    ) -> Outcome {
        let h = [HPos::Left, HPos::Center, HPos::Right][(h + 1) as usize];
        let v = [VPos::Top, VPos::Center, VPos::Bottom][(v + 1) as usize];
        let font = ("sans-serif", size * FINE).into_font().transform(turn);
        let style = TextStyle::from(font).color(&INK).pos(Pos::new(h, v));
        Ok(self.area.draw_text(text, &style, fine(&at))?)
    }
}

fn fine(p: &[f64; 2]) -> (i32, i32) {
    ((p[0] * FINE).round() as i32, (p[1] * FINE).round() as i32)
}

/// About how wide a text is, pixels.
pub fn text_width(text: &str, size: f64) -> f64 {
    0.58 * size * text.chars().count() as f64
}
