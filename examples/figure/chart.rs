use plotters::style::RGBColor;
use std::path::Path;

use super::Outcome;
use super::frame::{Frame, MARGIN};
use super::scale::Scale;
use super::sheet::{AMBER, BLUE, GREEN, GREY, INK, ORANGE, PURPLE, SKY, Sheet, TEXT, text_width};

const PALETTE: [RGBColor; 8] = [BLUE, ORANGE, GREEN, PURPLE, SKY, AMBER, GREY, INK];

/// Height of a row of the legend, pixels.
const ROW: f64 = 17.0;
const SIZE: [f64; 2] = [760.0, 420.0];

/// A line chart with a legend of one row or two above it.
#[derive(Clone, Default)]
pub struct Chart {
    title: String,
    labels: [String; 2],
    log: [bool; 2],
    curves: Vec<Curve>,
    slopes: Vec<Slope>,
}

#[derive(Clone)]
struct Curve {
    name: String,
    points: Vec<[f64; 2]>,
    line: bool,
    markers: bool,
}

/// A triangle that shows an order of convergence on logarithmic axes, y ~ x^order.
#[derive(Clone, Copy)]
pub struct Slope {
    pub order: f64,
    /// Its left corner.
    pub at: [f64; 2],
    /// x at its right end, divided by x at its left end.
    pub ratio: f64,
}

impl Chart {
    /// Labels carry the unit: `"curvature, 1/m"`.
    pub fn new(title: &str, x_label: &str, y_label: &str) -> Self {
        Self { title: title.into(), labels: [x_label.into(), y_label.into()], ..Self::default() }
    }

    /// Logarithmic axes: x, y.
    pub fn log(self, x: bool, y: bool) -> Self {
        Self { log: [x, y], ..self }
    }

    pub fn line(self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.curve(name, points, [true, false])
    }

    /// A line with a dot at every point.
    pub fn dots(self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.curve(name, points, [true, true])
    }

    /// Dots without a line.
    pub fn marks(self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.curve(name, points, [false, true])
    }

    fn curve(
        mut self,
        name: &str,
        points: impl IntoIterator<Item = [f64; 2]>,
        [line, markers]: [bool; 2],
    ) -> Self {
        self.curves.push(Curve { name: name.into(), points: points.into_iter().collect(), line, markers });
        self
    }

    pub fn slope(mut self, slope: Slope) -> Self {
        self.slopes.push(slope);
        self
    }

    pub fn save(&self, path: &Path) -> Outcome {
        stack(path, std::slice::from_ref(self))
    }

    fn draw(&self, sheet: &Sheet<'_>, offset: f64) -> Outcome {
        let [left, right, top, bottom] = MARGIN;
        let scale = |i: usize, pixel| {
            let data = self.curves.iter().flat_map(|c| c.points.iter().map(move |p| p[i]));
            let corners = self.slopes.iter().flat_map(move |s| s.corners().map(|p| p[i]));
            Scale::new(Scale::fit(data.chain(corners), self.log[i]), pixel, self.log[i])
        };
        let frame = Frame {
            x: scale(0, [left, SIZE[0] - right]),
            y: scale(1, [offset + SIZE[1] - bottom, offset + top]),
        };
        frame.draw(sheet, [&self.labels[0], &self.labels[1]])?;
        sheet.text(&self.title, [left, offset + 8.0], [-1, -1], 1.15 * TEXT)?;
        let places = self.legend_places();
        for ((curve, color), legend) in self.curves.iter().zip(PALETTE.into_iter().cycle()).zip(places) {
            let legend = [legend[0], offset + legend[1]];
            let drawable = |p: &&[f64; 2]| (0..2).all(|i| p[i].is_finite() && (!self.log[i] || p[i] > 0.0));
            let points: Vec<_> = curve.points.iter().filter(drawable).map(|p| frame.at(*p)).collect();
            if curve.line {
                sheet.line(&points, color, 2.0)?;
            }
            let dots: &[[f64; 2]] = if curve.markers { &points } else { &[] };
            for dot in dots {
                sheet.disc(*dot, 4.0, color)?;
            }
            if curve.line {
                sheet.line(&[legend, [legend[0] + 24.0, legend[1]]], color, 3.0)?;
            }
            if curve.markers {
                sheet.disc([legend[0] + 12.0, legend[1]], 4.0, color)?;
            }
            sheet.text(&curve.name, [legend[0] + 30.0, legend[1]], [-1, 0], TEXT)?;
        }
        for slope in &self.slopes {
            slope.draw(sheet, &frame)?;
        }
        Ok(())
    }
}

impl Chart {
    /// Where the entries of the legend begin: a new row where one does not fit any more, the last just above the box.
    fn legend_places(&self) -> Vec<[f64; 2]> {
        let [left, right, top, _] = MARGIN;
        let (mut x, mut row, mut places) = (left, 0.0, Vec::new());
        for curve in &self.curves {
            let width = 54.0 + text_width(&curve.name, TEXT);
            if x > left && x + width > SIZE[0] - 0.5 * right {
                (x, row) = (left, row + 1.0);
            }
            places.push([x, row]);
            x += width;
        }
        places.into_iter().map(|[x, r]| [x, top - 12.0 - ROW * (row - r)]).collect()
    }
}

impl Slope {
    /// Left end, right end, and the corner of the right angle.
    fn corners(&self) -> [[f64; 2]; 3] {
        let [x, y] = self.at;
        let (far, rise) = (x * self.ratio, y * self.ratio.powf(self.order));
        [[x, y], [far, rise], [far, y]]
    }

    fn draw(&self, sheet: &Sheet<'_>, frame: &Frame) -> Outcome {
        let [a, b, c] = self.corners().map(|p| frame.at(p));
        sheet.line(&[a, b, c, a], INK, 1.0)?;
        let (order, beside) = (self.order.abs().to_string(), [c[0] + 6.0, 0.5 * (b[1] + c[1])]);
        sheet.text(&order, beside, [-1, 0], TEXT)?;
        // on the side of the level leg that is outside the triangle
        let (v, gap) = if b[1] > c[1] { (1, -4.0) } else { (-1, 4.0) };
        sheet.text("1", [0.5 * (a[0] + c[0]), c[1] + gap], [0, v], TEXT)
    }
}

/// Charts one below the other in one file.
pub fn stack(path: &Path, charts: &[Chart]) -> Outcome {
    Sheet::save(path, [SIZE[0], SIZE[1] * charts.len() as f64], |sheet| {
        for (i, chart) in charts.iter().enumerate() {
            chart.draw(sheet, SIZE[1] * i as f64)?;
        }
        Ok(())
    })
}
