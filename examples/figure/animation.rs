//! Curves that move: an SVG that browsers play, written as text.

use std::fmt::Write as _;
use std::path::Path;

use super::Outcome;

/// Width of the drawing, pixels.
const WIDTH: f64 = 640.0;

const MARGIN: f64 = 24.0;

/// A curve at instants the same time apart, played in real time or slower, over and over.
pub struct Animation {
    title: String,
    seconds: f64,
    frames: Vec<Vec<[f64; 2]>>,
}

impl Animation {
    /// An animation that takes so many seconds.
    pub fn new(title: &str, seconds: f64) -> Self {
        Self { title: title.into(), seconds, frames: Vec::new() }
    }

    /// Adds the curve of the next instant; all have the same number of points.
    pub fn push(&mut self, curve: Vec<[f64; 2]>) {
        self.frames.push(curve);
    }

    pub fn save(&self, path: &Path) -> Outcome {
        let points = || self.frames.iter().flatten();
        let range = |axis: usize| {
            points().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], p| {
                [least.min(p[axis]), most.max(p[axis])]
            })
        };
        let ([left, right], [bottom, top]) = (range(0), range(1));
        let scale = (WIDTH - 2.0 * MARGIN) / (right - left).max(top - bottom).max(f64::MIN_POSITIVE);
        let height = (top - bottom) * scale + 2.0 * MARGIN + 20.0;
        let mut values = String::new();
        for frame in &self.frames {
            for p in frame {
                let (x, y) = (MARGIN + (p[0] - left) * scale, MARGIN + 20.0 + (top - p[1]) * scale);
                write!(values, "{x:.1},{y:.1} ")?;
            }
            values.push(';');
        }
        let first = values.split(';').next().unwrap_or_default();
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\" font-family=\"sans-serif\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
             <text x=\"{MARGIN}\" y=\"24\" font-size=\"14\" fill=\"#282828\">{}</text>\n\
             <polyline fill=\"none\" stroke=\"#0072b2\" stroke-width=\"5\" stroke-linecap=\"round\" points=\"{first}\">\n\
             <animate attributeName=\"points\" dur=\"{:.2}s\" repeatCount=\"indefinite\" values=\"{}\"/>\n</polyline>\n</svg>\n",
            self.title,
            self.seconds,
            values.trim_end_matches(';')
        );
        std::fs::write(path, svg)?;
        Ok(())
    }
}
