//! A flat ribbon in space, seen from far away.

use crate::figure::Drawing;
use hyperrod::Pose;
use nalgebra::Vector3;
use plotters::style::RGBColor;

/// Draws a ribbon whose width lies along x of its sections, what is far first; its front (+y) in the first colour, its back in the second.
pub fn ribbon(
    mut drawing: Drawing,
    stations: &[Pose],
    width: f64,
    [right, up]: [Vector3<f64>; 2],
    [front, back]: [RGBColor; 2],
) -> Drawing {
    let toward_eye = right.cross(&up);
    let depth = |ends: &[Pose]| toward_eye.dot(&(ends[0].position + ends[1].position));
    let mut pieces: Vec<&[Pose]> = stations.windows(2).collect();
    pieces.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    for ends in pieces {
        let rim = |pose: &Pose, side: f64| {
            let p = pose.transform_point(&vector_x(0.5 * side * width));
            [right.dot(&p) * 1e3, up.dot(&p) * 1e3]
        };
        let corners = vec![rim(&ends[0], -1.0), rim(&ends[0], 1.0), rim(&ends[1], 1.0), rim(&ends[1], -1.0)];
        let seen = toward_eye.dot(&ends[0].rotation.column(1).into_owned()) > 0.0;
        let color = if seen { front } else { back };
        // the rims across hide the seams
        drawing = drawing
            .line(corners[..2].to_vec(), color)
            .line(corners[2..].to_vec(), color)
            .cell(corners, color);
    }
    drawing
}

fn vector_x(x: f64) -> Vector3<f64> {
    Vector3::x() * x
}
