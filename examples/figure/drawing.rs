use hyperrod::Pose;
use nalgebra::Vector3;
use plotters::style::{RGBColor, WHITE};
use std::path::Path;

use super::Outcome;
use super::frame::{Frame, MARGIN};
use super::scale::Scale;
use super::sheet::{GREY, INK, Sheet, TEXT, text_width};

/// Width of the box, pixels; its height follows from equal scales.
const WIDTH: f64 = 640.0;

/// Room above it for the title.
const TOP: f64 = 44.0;

/// A drawing to scale: the same number of pixels for a millimetre on both axes.
pub struct Drawing {
    title: String,
    labels: [String; 2],
    legend: Vec<(String, RGBColor)>,
    items: Vec<Item>,
}

enum Item {
    Area { outline: Vec<[f64; 2]>, color: RGBColor, opacity: f64 },
    Line { points: Vec<[f64; 2]>, color: RGBColor, width: f64 },
    Disc { centre: [f64; 2], radius: f64, color: RGBColor },
    Text { text: String, at: [f64; 2] },
}

/// The outline of a rod in a plane of space: its rim on both sides of every station (pose, half width), along the body direction `across`.
///
/// The plane is given by the directions its two axes have in space; lengths are divided by `unit`, in m.
pub fn silhouette(
    stations: &[(Pose, f64)],
    across: Vector3<f64>,
    plane: [Vector3<f64>; 2],
    unit: f64,
) -> Vec<[f64; 2]> {
    let mut outline = Vec::new();
    let mut other_side = Vec::new();
    let project = |p: Vector3<f64>| plane.map(|direction| direction.dot(&p) / unit);
    for &(pose, half_width) in stations {
        outline.push(project(pose.transform_point(&(across * half_width))));
        other_side.push(project(pose.transform_point(&(across * -half_width))));
    }
    outline.extend(other_side.into_iter().rev());
    outline
}

impl Drawing {
    pub fn new(title: &str, x_label: &str, y_label: &str) -> Self {
        Self {
            title: title.into(),
            labels: [x_label.into(), y_label.into()],
            legend: Vec::new(),
            items: Vec::new(),
        }
    }

    /// A filled outline; it hides what was drawn before.
    pub fn area(mut self, outline: Vec<[f64; 2]>, color: RGBColor) -> Self {
        self.items.push(Item::Area { outline: outline.clone(), color: WHITE, opacity: 1.0 });
        self.items.push(Item::Area { outline: outline.clone(), color, opacity: 0.5 });
        self.outline(outline, color, 1.5)
    }

    /// A filled outline without a rim; it hides what was drawn before.
    pub fn cell(mut self, outline: Vec<[f64; 2]>, color: RGBColor) -> Self {
        self.items.push(Item::Area { outline, color, opacity: 1.0 });
        self
    }

    /// An entry of the legend above the box.
    pub fn legend(mut self, name: &str, color: RGBColor) -> Self {
        self.legend.push((name.into(), color));
        self
    }

    /// An outline drawn faintly: where something was before.
    pub fn ghost(mut self, outline: Vec<[f64; 2]>) -> Self {
        self.items.push(Item::Area { outline: outline.clone(), color: GREY, opacity: 0.12 });
        self.outline(outline, RGBColor(185, 185, 185), 1.0)
    }

    /// A filled outline without a line around it.
    pub fn patch(mut self, outline: Vec<[f64; 2]>, color: RGBColor) -> Self {
        self.items.push(Item::Area { outline, color, opacity: 1.0 });
        self
    }

    fn outline(mut self, mut points: Vec<[f64; 2]>, color: RGBColor, width: f64) -> Self {
        points.extend(points.first().copied());
        self.items.push(Item::Line { points, color, width });
        self
    }

    pub fn line(mut self, points: Vec<[f64; 2]>, color: RGBColor) -> Self {
        self.items.push(Item::Line { points, color, width: 1.5 });
        self
    }

    pub fn disc(mut self, centre: [f64; 2], radius: f64, color: RGBColor) -> Self {
        self.items.push(Item::Disc { centre, radius, color });
        self
    }

    /// Text centred on a point.
    pub fn text(mut self, text: &str, at: [f64; 2]) -> Self {
        self.items.push(Item::Text { text: text.into(), at });
        self
    }

    /// A wall from one point to another, hatched on its left.
    pub fn wall(mut self, from: [f64; 2], to: [f64; 2]) -> Self {
        let along = [to[0] - from[0], to[1] - from[1]];
        let count = 9;
        let step = along.map(|v| v / count as f64);
        for k in 0..count {
            let foot = [0, 1].map(|i| from[i] + step[i] * (k as f64 + 1.0));
            let head = [foot[0] - step[1] - step[0], foot[1] + step[0] - step[1]];
            self.items.push(Item::Line { points: vec![foot, head], color: INK, width: 1.0 });
        }
        self.items.push(Item::Line { points: vec![from, to], color: INK, width: 2.5 });
        self
    }

    pub fn save(&self, path: &Path) -> Outcome {
        let [x, y] = [0, 1].map(|i| self.range(i));
        let per_unit = WIDTH / (x[1] - x[0]);
        let height = per_unit * (y[1] - y[0]);
        let [left, right, _, bottom] = MARGIN;
        let top = if self.legend.is_empty() { TOP } else { MARGIN[2] };
        let frame = Frame {
            x: Scale::new(x, [left, left + WIDTH], false),
            y: Scale::new(y, [top + height, top], false),
        };
        Sheet::save(path, [left + WIDTH + right, top + height + bottom], |sheet| {
            frame.draw(sheet, [&self.labels[0], &self.labels[1]])?;
            sheet.text(&self.title, [left, 12.0], [-1, -1], 1.2 * TEXT)?;
            self.draw_legend(sheet, [left, top - 14.0])?;
            for item in &self.items {
                let px = |points: &[[f64; 2]]| points.iter().map(|p| frame.at(*p)).collect::<Vec<_>>();
                match item {
                    Item::Area { outline, color, opacity } => {
                        sheet.polygon(&px(outline), *color, *opacity)?
                    }
                    Item::Line { points, color, width } => sheet.line(&px(points), *color, *width)?,
                    Item::Disc { centre, radius, color } => {
                        sheet.disc(frame.at(*centre), radius * per_unit, *color)?
                    }
                    Item::Text { text, at } => sheet.text(text, frame.at(*at), [0, 0], TEXT)?,
                }
            }
            Ok(())
        })
    }

    fn draw_legend(&self, sheet: &Sheet<'_>, [mut x, y]: [f64; 2]) -> Outcome {
        for (name, color) in &self.legend {
            sheet.line(&[[x, y], [x + 24.0, y]], *color, 5.0)?;
            sheet.text(name, [x + 30.0, y], [-1, 0], TEXT)?;
            x += 54.0 + text_width(name, TEXT);
        }
        Ok(())
    }

    /// What the items cover along axis i, with a margin of a twentieth of the larger extent.
    fn range(&self, i: usize) -> [f64; 2] {
        let extent = |i: usize| {
            let mut range = [f64::MAX, f64::MIN];
            let mut cover = |low: f64, high: f64| range = [range[0].min(low), range[1].max(high)];
            for item in &self.items {
                match item {
                    Item::Area { outline: points, .. } | Item::Line { points, .. } => {
                        points.iter().for_each(|p| cover(p[i], p[i]))
                    }
                    Item::Disc { centre, radius, .. } => cover(centre[i] - radius, centre[i] + radius),
                    Item::Text { at, .. } => cover(at[i], at[i]),
                }
            }
            range
        };
        let [x, y] = [extent(0), extent(1)];
        let margin = 0.05 * (x[1] - x[0]).max(y[1] - y[0]);
        let [low, high] = if i == 0 { x } else { y };
        [low - margin, high + margin]
    }
}
