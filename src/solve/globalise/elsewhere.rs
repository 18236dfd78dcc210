//! Starts that are not the reference shape.

use nalgebra::Vector3;

use crate::body::Elastic;
use crate::lie::{Pose, Strain, so3};
use crate::solve::mesh::Mesh;
use crate::solve::unknowns::Unknowns;

/// The largest change of a curvature by each of its waves, in units of 1/L.
const BEND: f64 = 4.0;

/// Waves along the rod: constant, half a wave, a whole one.
const WAVES: usize = 3;

/// Steele, Lea and Flood (2014), SplitMix: the same numbers every time.
fn between_minus_one_and_one(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The reference shape bent and twisted by some radians, as far as it can be, and turned about its base where that may turn: one shape for every number.
pub(super) fn elsewhere<B: Elastic, const S: usize>(mesh: &Mesh<'_, B, S>, number: u64) -> Unknowns<S> {
    let (length, constraint) = (mesh.rod.body().length(), mesh.rod.body().constraint());
    let mut state = number;
    let mut vector = |size: f64| {
        let mut component = || size * between_minus_one_and_one(&mut state);
        Vector3::new(component(), component(), component())
    };
    let waves: [Vector3<f64>; WAVES] = std::array::from_fn(|_| vector(BEND / length));
    let turn = vector(std::f64::consts::FRAC_PI_2);
    let mut unknowns = Unknowns::at_rest(mesh);
    for (i, element) in unknowns.strains.iter_mut().enumerate() {
        for (k, strain) in element.iter_mut().enumerate() {
            let phase = std::f64::consts::PI * mesh.stage_s(i, k) / length;
            let bent = waves.iter().enumerate().map(|(m, wave)| wave * (m as f64 * phase).cos());
            *strain += constraint.free_part(Strain { angular: bent.sum(), linear: Vector3::zeros() });
        }
    }
    if !mesh.rod.base_fixture().support.is_clamped() {
        unknowns.base = unknowns.base * Pose::new(so3::exp(&turn), Vector3::zeros());
    }
    unknowns
}
