use nalgebra::Vector6;

use super::index::Swept;
use super::link::Link;

/// The mode whose last two nodes are an eigenvector of the last pivot, back along the rod in the bases of the planes.
pub(super) fn shape(swept: &Swept, last: &Link, place: usize) -> Option<Vec<(Vector6<f64>, Vector6<f64>)>> {
    let (mut a, tip) = swept.last.mode(place)?;
    let plane = swept.planes.last()?;
    let (zeta, momentum) = (plane.zeta * a, plane.momentum * a);
    let at_tip = last.momentum_zeta * zeta + last.momentum_momentum * momentum;
    let mut nodes = vec![(tip, at_tip), (zeta, momentum)];
    for (plane, back) in swept.planes.iter().zip(&swept.back).rev() {
        a = back * a;
        nodes.push((plane.zeta * a, plane.momentum * a));
    }
    nodes.reverse();
    let larger = |most: f64, v: &f64| if v.abs() > most.abs() { *v } else { most };
    let largest = nodes.iter().flat_map(|(zeta, _)| zeta.iter()).fold(0.0, larger);
    nodes.iter_mut().for_each(|(zeta, momentum)| {
        *zeta /= largest;
        *momentum /= largest;
    });
    nodes.iter().all(|(zeta, momentum)| (zeta + momentum).norm().is_finite()).then_some(nodes)
}
