use nalgebra::Vector3;
use std::io::{Result, Write};

use crate::solve::Node;

/// The axis of a rod as a line of VTK, with what the rod bears at its points: a `.vtp` file for ParaView.
///
/// The point data are `s`; the directors `d1`, `d2`, `d3`; `moment` and `force` in space; `moment_body`, `force_body`, `curvature_body` (Δω) and
/// `stretch_body` (Δν) as components in the frame of the section; and what [`with_radius`](Self::with_radius) and
/// [`with_scalar`](Self::with_scalar) add. In ParaView, the filter Tube with Scalars `radius`, Vary Radius *By Absolute Scalar*, draws the rod
/// as it is; Glyph draws a vector such as `force`.
///
/// ```
/// use hyperrod::output::Polyline;
/// # use hyperrod::{Body, Pose, Rod, Statics, load::DeadWrench, section::Stiffness};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
/// # let pull = DeadWrench::force(nalgebra::vector![1.0, 0.0, 0.0])?;
/// let solution = Statics::default().solve(&Rod::clamped(body, Pose::identity()).with_tip_load(pull))?;
/// let mut file = Vec::new(); // or a `std::fs::File`
/// Polyline::new(solution.nodes())
///     .with_radius(|s| 0.02 - 0.01 * s)
///     .with_scalar("stretch", |node| 1.0 + node.strain.linear.z)
///     .write(&mut file)?;
/// assert!(String::from_utf8(file)?.contains("Name=\"radius\""));
/// # Ok(()) }
/// ```
///
/// Source: Kitware, *VTK File Formats*, XML PolyData.
#[derive(Clone, Debug)]
pub struct Polyline<'a> {
    nodes: &'a [Node],
    scalars: Vec<(String, Vec<f64>)>,
}

impl<'a> Polyline<'a> {
    /// Through the given states, in their order.
    pub fn new(nodes: &'a [Node]) -> Self {
        Self { nodes, scalars: Vec::new() }
    }

    /// The same with the radius of the section at s, m, as the scalar `radius`.
    pub fn with_radius(self, radius: impl Fn(f64) -> f64) -> Self {
        self.with_scalar("radius", |node| radius(node.s))
    }

    /// The same with another scalar at every point. VTK writes no infinities: what is not finite becomes NaN.
    pub fn with_scalar(mut self, name: &str, value: impl Fn(&Node) -> f64) -> Self {
        self.scalars.push((escaped(name), self.nodes.iter().map(value).collect()));
        self
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, mut out: impl Write) -> Result<()> {
        let count = self.nodes.len();
        let lines = usize::from(count > 1);
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(out, "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>")?;
        writeln!(
            out,
            "<Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"0\" NumberOfLines=\"{lines}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">"
        )?;
        writeln!(out, "<Points>")?;
        self.vectors(&mut out, "Points", |node| node.pose.position)?;
        writeln!(out, "</Points>\n<Lines>")?;
        let line = if lines == 1 { 0..count } else { 0..0 };
        let ends = if lines == 1 { vec![count] } else { Vec::new() };
        integers(&mut out, "connectivity", line)?;
        integers(&mut out, "offsets", ends)?;
        writeln!(out, "</Lines>\n<PointData>")?;
        self.point_data(&mut out)?;
        writeln!(out, "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>")
    }

    fn point_data(&self, out: &mut impl Write) -> Result<()> {
        array(out, "s", 1, self.nodes.iter().map(|node| [node.s]))?;
        for (name, values) in &self.scalars {
            array(out, name, 1, values.iter().map(|v| [*v]))?;
        }
        for (k, name) in ["d1", "d2", "d3"].into_iter().enumerate() {
            self.vectors(out, name, |node| node.pose.rotation.column(k).into_owned())?;
        }
        self.vectors(out, "moment", |node| node.pose.rotation * node.wrench.moment)?;
        self.vectors(out, "force", |node| node.pose.rotation * node.wrench.force)?;
        self.vectors(out, "moment_body", |node| node.wrench.moment)?;
        self.vectors(out, "force_body", |node| node.wrench.force)?;
        self.vectors(out, "curvature_body", |node| node.strain.angular)?;
        self.vectors(out, "stretch_body", |node| node.strain.linear)
    }

    fn vectors(&self, out: &mut impl Write, name: &str, value: impl Fn(&Node) -> Vector3<f64>) -> Result<()> {
        array(out, name, 3, self.nodes.iter().map(|node| value(node).into()))
    }
}

fn array<const N: usize>(
    out: &mut impl Write,
    name: &str,
    components: usize,
    rows: impl Iterator<Item = [f64; N]>,
) -> Result<()> {
    writeln!(
        out,
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    )?;
    for row in rows {
        writeln!(
            out,
            "{}",
            row.map(|v| if v.is_finite() { format!("{v:?}") } else { "nan".into() }).join(" ")
        )?;
    }
    writeln!(out, "</DataArray>")
}

fn integers(out: &mut impl Write, name: &str, values: impl IntoIterator<Item = usize>) -> Result<()> {
    writeln!(out, "<DataArray type=\"Int64\" Name=\"{name}\" format=\"ascii\">")?;
    for value in values {
        write!(out, "{value} ")?;
    }
    writeln!(out, "\n</DataArray>")
}

/// A name as an attribute of XML.
fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
