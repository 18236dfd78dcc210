use std::io::{Result, Write};

use crate::solve::Node;

/// Names of the columns, with their units.
const HEADER: &str = "s_m,x_m,y_m,z_m,q_w,q_x,q_y,q_z,omega_x_per_m,omega_y_per_m,omega_z_per_m,nu_x,nu_y,nu_z,\
                      moment_x_Nm,moment_y_Nm,moment_z_Nm,force_x_N,force_y_N,force_z_N";

/// Writes states of a rod as CSV, one a row: arc length, position, unit quaternion (body to space), strain Δξ and wrench Ψ in the body frame.
///
/// The columns are named with their units in the first row. Numbers have all the digits that it takes to read the same number back.
///
/// ```
/// use hyperrod::output::write_csv;
/// # use hyperrod::{Body, Pose, Rod, Statics, load::DeadWrench, section::Stiffness};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
/// # let pull = DeadWrench::force(nalgebra::vector![1.0, 0.0, 0.0])?;
/// let solution = Statics::default().solve(&Rod::clamped(body, Pose::identity()).with_tip_load(pull))?;
/// let mut table = Vec::new(); // or a `std::fs::File`
/// write_csv(&mut table, solution.nodes())?; // or solution.stages()
/// assert!(table.starts_with(b"s_m,x_m,y_m,z_m,"));
/// assert_eq!(table.iter().filter(|c| **c == b'\n').count(), 1 + solution.nodes().len());
/// # Ok(()) }
/// ```
///
/// # Errors
/// Those of `out`.
pub fn write_csv(mut out: impl Write, nodes: &[Node]) -> Result<()> {
    writeln!(out, "{HEADER}")?;
    for node in nodes {
        let (p, q) = (node.pose.position, node.pose.quaternion());
        write!(out, "{:?},{:?},{:?},{:?},{:?},{:?},{:?},{:?}", node.s, p.x, p.y, p.z, q.w, q.i, q.j, q.k)?;
        for value in node.strain.to_array().into_iter().chain(node.wrench.to_array()) {
            write!(out, ",{value:?}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}
