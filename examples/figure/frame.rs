use plotters::style::RGBColor;

use super::Outcome;
use super::scale::Scale;
use super::sheet::{INK, Sheet, TEXT};

const GRID: RGBColor = RGBColor(225, 225, 225);

/// Room around a frame for ticks and labels: left, right, top, bottom, pixels.
pub const MARGIN: [f64; 4] = [78.0, 28.0, 64.0, 58.0];

/// A box with two axes.
pub struct Frame {
    pub x: Scale,
    pub y: Scale,
}

impl Frame {
    /// Pixels of a point of data.
    pub fn at(&self, p: [f64; 2]) -> [f64; 2] {
        [self.x.px(p[0]), self.y.px(p[1])]
    }

    /// Grid, box, ticks and labels.
    pub fn draw(&self, sheet: &Sheet<'_>, [x_label, y_label]: [&str; 2]) -> Outcome {
        let ([left, right], [bottom, top]) = (self.x.pixel(), self.y.pixel());
        for (value, label) in self.x.ticks(80.0) {
            let x = self.x.px(value);
            sheet.line(&[[x, bottom], [x, top]], GRID, 1.0)?;
            sheet.text(&label, [x, bottom + 8.0], [0, -1], TEXT)?;
        }
        for (value, label) in self.y.ticks(50.0) {
            let y = self.y.px(value);
            sheet.line(&[[left, y], [right, y]], GRID, 1.0)?;
            sheet.text(&label, [left - 8.0, y], [1, 0], TEXT)?;
        }
        let corners = [[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]];
        sheet.line(&corners, INK, 1.0)?;
        sheet.text(x_label, [0.5 * (left + right), bottom + 30.0], [0, -1], TEXT)?;
        sheet.text_upward(y_label, [left - 58.0, 0.5 * (bottom + top)])
    }
}
