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

/// A chart of lines and points with a legend above it.
#[derive(Clone, Default)]
pub struct Chart {
    title: String,
    labels: [String; 2],
    log: [bool; 2],
    curves: Vec<Curve>,
    /// What the markers mean, where they mean something.
    key: Vec<(String, Marker)>,
    slopes: Vec<Slope>,
}

#[derive(Clone)]
struct Curve {
    name: String,
    points: Vec<[f64; 2]>,
    line: bool,
    marker: Option<Marker>,
}

/// What a point is drawn as.
#[derive(Clone, Copy)]
pub enum Marker {
    Disc,
    SmallDisc,
    Ring,
    SmallRing,
}

impl Marker {
    fn draw(self, sheet: &Sheet<'_>, at: [f64; 2], color: RGBColor) -> Outcome {
        match self {
            Self::Disc => sheet.disc(at, 4.0, color),
            Self::SmallDisc => sheet.disc(at, 2.5, color),
            Self::Ring => sheet.ring(at, 5.0, color),
            Self::SmallRing => sheet.ring(at, 3.2, color),
        }
    }
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
        self.curve(name, points, true, None)
    }

    /// A line with a dot at every point.
    pub fn dots(self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.curve(name, points, true, Some(Marker::Disc))
    }

    /// Points without a line; under a name that is there already, in its colour.
    pub fn marks(self, name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.marks_as(name, Marker::Disc, points)
    }

    pub fn marks_as(self, name: &str, marker: Marker, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.curve(name, points, false, Some(marker))
    }

    /// What a marker means, in the legend.
    pub fn key(mut self, name: &str, marker: Marker) -> Self {
        self.key.push((name.into(), marker));
        self
    }

    fn curve(
        mut self,
        name: &str,
        points: impl IntoIterator<Item = [f64; 2]>,
        line: bool,
        marker: Option<Marker>,
    ) -> Self {
        self.curves.push(Curve { name: name.into(), points: points.into_iter().collect(), line, marker });
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
        let [left, right, _, bottom] = MARGIN;
        let (width, height) = (SIZE[0], self.height());
        let scale = |i: usize, pixel| {
            let data = self.curves.iter().flat_map(|c| c.points.iter().map(move |p| p[i]));
            let corners = self.slopes.iter().flat_map(move |s| s.corners().map(|p| p[i]));
            Scale::new(Scale::fit(data.chain(corners), self.log[i]), pixel, self.log[i])
        };
        let frame = Frame {
            x: scale(0, [left, width - right]),
            y: scale(1, [offset + height - bottom, offset + self.top()]),
        };
        frame.draw(sheet, [&self.labels[0], &self.labels[1]])?;
        sheet.text(&self.title, [left, offset + 8.0], [-1, -1], 1.15 * TEXT)?;
        for curve in &self.curves {
            let color = self.color(&curve.name);
            let drawable = |p: &&[f64; 2]| (0..2).all(|i| p[i].is_finite() && (!self.log[i] || p[i] > 0.0));
            let points: Vec<_> = curve.points.iter().filter(drawable).map(|p| frame.at(*p)).collect();
            if curve.line {
                sheet.line(&points, color, 2.0)?;
            }
            for point in points.iter().filter(|_| curve.marker.is_some()) {
                curve.marker.unwrap_or(Marker::Disc).draw(sheet, *point, color)?;
            }
        }
        self.draw_legend(sheet, offset)?;
        for slope in &self.slopes {
            slope.draw(sheet, &frame)?;
        }
        Ok(())
    }
}

impl Chart {
    /// The names of the curves, each once.
    fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for curve in &self.curves {
            if !names.contains(&curve.name.as_str()) {
                names.push(&curve.name);
            }
        }
        names
    }

    /// Height, with a legend of more than the usual rows.
    fn height(&self) -> f64 {
        SIZE[1] + self.top() - MARGIN[2]
    }

    /// Where the box begins.
    fn top(&self) -> f64 {
        let rows = self.legend().last().map_or(0.0, |place| place[1]) + 1.0;
        MARGIN[2] + ROW * (rows - 2.0).max(0.0)
    }

    /// Where the entries of the legend are: x, and the row.
    fn legend(&self) -> Vec<[f64; 2]> {
        legend_places(self.names().into_iter().chain(self.key.iter().map(|(name, _)| name.as_str())))
    }

    fn color(&self, name: &str) -> RGBColor {
        let place = self.names().iter().position(|other| *other == name).unwrap_or_default();
        PALETTE[place % PALETTE.len()]
    }

    /// Every name in its colour, then what the markers mean.
    fn draw_legend(&self, sheet: &Sheet<'_>, offset: f64) -> Outcome {
        let (names, places) = (self.names(), self.legend());
        let last = places.last().map_or(0.0, |place| place[1]);
        for (i, [x, row]) in places.into_iter().enumerate() {
            let y = offset + self.top() - 12.0 - ROW * (last - row);
            let (name, line, marker, color) = match names.get(i) {
                Some(name) => {
                    let curves = || self.curves.iter().filter(|curve| curve.name == *name);
                    let plain = (!self.key.is_empty()).then_some(Marker::Disc);
                    let marker = plain.or_else(|| curves().find_map(|curve| curve.marker));
                    (*name, curves().any(|curve| curve.line), marker, self.color(name))
                }
                None => {
                    let (name, marker) = &self.key[i - names.len()];
                    (name.as_str(), false, Some(*marker), INK)
                }
            };
            if line {
                sheet.line(&[[x, y], [x + 24.0, y]], color, 3.0)?;
            }
            if let Some(marker) = marker {
                marker.draw(sheet, [x + 12.0, y], color)?;
            }
            sheet.text(name, [x + 30.0, y], [-1, 0], TEXT)?;
        }
        Ok(())
    }
}

/// Where the entries of the legend begin: x, and the row; a new one where an entry does not fit any more.
fn legend_places<'a>(names: impl Iterator<Item = &'a str>) -> Vec<[f64; 2]> {
    let [left, right, ..] = MARGIN;
    let (mut x, mut row, mut places) = (left, 0.0, Vec::new());
    for name in names {
        let width = 54.0 + text_width(name, TEXT);
        if x > left && x + width > SIZE[0] - 0.5 * right {
            (x, row) = (left, row + 1.0);
        }
        places.push([x, row]);
        x += width;
    }
    places
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
    let height = charts.iter().map(Chart::height).sum();
    Sheet::save(path, [SIZE[0], height], |sheet| {
        let mut offset = 0.0;
        for chart in charts {
            chart.draw(sheet, offset)?;
            offset += chart.height();
        }
        Ok(())
    })
}
