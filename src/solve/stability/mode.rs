use nalgebra::Vector6;

use super::index::Swept;

/// The mode whose last two nodes are an eigenvector of the last pivot, back along the rod: a_i = R⁻¹ a_{i+1} in the bases of the planes.
pub(super) fn shape(swept: &Swept, k: usize) -> Option<Vec<Vector6<f64>>> {
    let (mut a, tip) = swept.last.mode(k)?;
    let mut nodes = vec![tip, swept.planes.last()?.zeta * a];
    for (plane, triangle) in swept.planes.iter().zip(&swept.triangles).rev() {
        a = triangle.solve_upper_triangular(&a)?;
        nodes.push(plane.zeta * a);
    }
    nodes.reverse();
    let larger = |most: f64, v: &f64| if v.abs() > most.abs() { *v } else { most };
    let largest = nodes.iter().flat_map(|node| node.iter()).fold(0.0, larger);
    nodes.iter_mut().for_each(|node| *node /= largest);
    nodes.iter().all(|node| node.norm().is_finite()).then_some(nodes)
}
