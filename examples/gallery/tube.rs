//! A round rod in space, seen from far away.

use crate::figure::Drawing;
use hyperrod::StaticSolution;
use nalgebra::Vector3;
use plotters::style::RGBColor;

/// Where the axis goes, from base to tip, at nodes and stages, m.
pub fn axis(solution: &StaticSolution) -> Vec<Vector3<f64>> {
    let mut states: Vec<_> = solution.nodes().iter().chain(solution.stages()).collect();
    states.sort_by(|a, b| a.s.total_cmp(&b.s));
    states.iter().map(|state| state.pose.position).collect()
}

/// Draws a tube about an axis, what is far first. `view` has the directions to the right and upwards; lengths are divided by 1 mm.
pub fn tube(
    mut drawing: Drawing,
    axis: &[Vector3<f64>],
    radius: f64,
    [right, up]: [Vector3<f64>; 2],
    color: RGBColor,
) -> Drawing {
    let toward_eye = right.cross(&up);
    let light = |share: f64| {
        let mix = |c: u8| (f64::from(c) * share + 255.0 * (1.0 - share)) as u8;
        RGBColor(mix(color.0), mix(color.1), mix(color.2))
    };
    let mut pieces: Vec<_> = axis.windows(2).map(|ends| [ends[0], ends[1]]).collect();
    pieces.sort_by(|a, b| toward_eye.dot(&(a[0] + a[1])).total_cmp(&toward_eye.dot(&(b[0] + b[1]))));
    for [from, to] in pieces {
        let side = (to - from).cross(&toward_eye);
        let side = if side.norm() > 0.0 { side.normalize() * radius } else { up * radius };
        // a little longer than it is, so that the next piece leaves no gap
        let along = (to - from) * 0.1;
        let corners = [from - along + side, to + along + side, to + along - side, from - along - side];
        let corners = corners.map(|p| [right.dot(&p) * 1e3, up.dot(&p) * 1e3]);
        drawing = drawing.cell(corners.to_vec(), light(0.55));
        drawing = drawing.line(corners[..2].to_vec(), color).line(corners[2..].to_vec(), color);
    }
    drawing
}
