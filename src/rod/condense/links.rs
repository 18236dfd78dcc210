//! What a sweep along the chain needs of an element: the transfer in as many dimensions as the rod has.

use nalgebra::Vector6;

use super::Condensed;
use crate::lie::{Twist, Wrench};
use crate::rod::lanes::ELEMENTS;
use crate::rod::planar::PLACES;

/// A [`Transfer`] by its blocks: N is 6 in space, and 3 in the plane, (y; z, x).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocks<const N: usize> {
    pub(crate) zeta_from_zeta: [[f64; N]; N],
    pub(crate) zeta_from_wrench: [[f64; N]; N],
    pub(crate) wrench_from_zeta: [[f64; N]; N],
    pub(crate) wrench_from_wrench: [[f64; N]; N],
    pub(crate) zeta: [f64; N],
    pub(crate) wrench: [f64; N],
}

/// The rotation and the moment at the end of an element from those at its start, where every force is dead: δn = n × w.
///
/// M is 3 in space, and 1 in the plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DeadBlocks<const M: usize> {
    pub(crate) turn_from_turn: [[f64; M]; M],
    pub(crate) turn_from_moment: [[f64; M]; M],
    pub(crate) moment_from_turn: [[f64; M]; M],
    pub(crate) moment_from_moment: [[f64; M]; M],
    pub(crate) turn: [f64; M],
    pub(crate) moment: [f64; M],
}

impl<const N: usize> Blocks<N> {
    fn zero() -> Self {
        let (matrix, vector) = ([[0.0; N]; N], [0.0; N]);
        Self {
            zeta_from_zeta: matrix,
            zeta_from_wrench: matrix,
            wrench_from_zeta: matrix,
            wrench_from_wrench: matrix,
            zeta: vector,
            wrench: vector,
        }
    }
}

impl<const M: usize> DeadBlocks<M> {
    pub(super) fn zero() -> Self {
        let (matrix, vector) = ([[0.0; M]; M], [0.0; M]);
        Self {
            turn_from_turn: matrix,
            turn_from_moment: matrix,
            moment_from_turn: matrix,
            moment_from_moment: matrix,
            turn: vector,
            moment: vector,
        }
    }
}

impl<const S: usize> Condensed<S> {
    /// Of any element.
    pub(crate) fn blocks_in_space(&self, i: usize) -> Blocks<6> {
        let t = self.transfer(i);
        let mut blocks = Blocks::zero();
        for r in 0..6 {
            for c in 0..6 {
                blocks.zeta_from_zeta[r][c] = t.zeta_from_zeta[(r, c)];
                blocks.zeta_from_wrench[r][c] = t.zeta_from_wrench[(r, c)];
                blocks.wrench_from_zeta[r][c] = t.wrench_from_zeta[(r, c)];
                blocks.wrench_from_wrench[r][c] = t.wrench_from_wrench[(r, c)];
            }
            (blocks.zeta[r], blocks.wrench[r]) = (t.zeta[r], t.wrench[r]);
        }
        blocks
    }

    /// Of an element of the plane.
    pub(crate) fn blocks_in_plane(&self, i: usize) -> Blocks<3> {
        let (layout, block, lane) = (&self.layout, self.block(i), i % ELEMENTS);
        let rows = &block[layout.pose()..];
        let [cos, sin, z, x] = [rows[0][lane], rows[1][lane], rows[2][lane], rows[3][lane]];
        // the place of the origin seen from the end is −e^{−iθ} p
        let (back_z, back_x) = (-(cos * z + sin * x), -(cos * x - sin * z));
        let zeta = |r, c| block[layout.zeta(r, c)][lane];
        let wrench = |r, c| block[layout.wrench(r, c)][lane];
        let mut t = Blocks::zero();
        t.zeta_from_zeta = [[1.0, 0.0, 0.0], [back_x, cos, sin], [-back_z, -sin, cos]];
        t.wrench_from_wrench = [[1.0, x, -z], [0.0, cos, sin], [0.0, -sin, cos]];
        for r in 0..3 {
            for c in 0..3 {
                t.zeta_from_wrench[r][c] = zeta(r, c);
                t.wrench_from_wrench[r][c] += wrench(r, c);
            }
            (t.zeta[r], t.wrench[r]) = (zeta(r, 3), wrench(r, 3));
        }
        if layout.columns > 4 {
            for r in 0..3 {
                t.zeta_from_zeta[r][0] += zeta(r, 4);
                t.wrench_from_zeta[r][0] += wrench(r, 4);
            }
        }
        if let Some(defect) = self.defect.get(i) {
            for (r, place) in PLACES.into_iter().enumerate() {
                t.wrench[r] += defect[place];
            }
        }
        t
    }

    /// Of an element of the plane whose loads are dead, with the wrench at its start.
    pub(crate) fn dead_in_plane(&self, i: usize, start: &Wrench) -> DeadBlocks<1> {
        let (layout, block, lane) = (&self.layout, self.block(i), i % ELEMENTS);
        let pose = &block[layout.pose()..];
        let (z, x) = (pose[2][lane], pose[3][lane]);
        let zeta = |c| block[layout.zeta(0, c)][lane];
        let wrench = |c| block[layout.wrench(0, c)][lane];
        // δn = −i n w
        let (n_z, n_x) = (start.force.x, -start.force.z);
        let mut turn = 1.0 + zeta(1) * n_z + zeta(2) * n_x;
        let mut moment = (wrench(1) + x) * n_z + (wrench(2) - z) * n_x;
        if layout.columns > 4 {
            turn += zeta(4);
            moment += wrench(4);
        }
        DeadBlocks {
            turn_from_turn: [[turn]],
            turn_from_moment: [[zeta(0)]],
            moment_from_turn: [[moment]],
            moment_from_moment: [[1.0 + wrench(0)]],
            turn: [zeta(3)],
            moment: [wrench(3)],
        }
    }

    /// ζ and δΛ at the end of element i from those at its start.
    pub(crate) fn forward(
        &self,
        i: usize,
        zeta: &Vector6<f64>,
        wrench: &Vector6<f64>,
    ) -> (Vector6<f64>, Vector6<f64>) {
        if !self.passed.is_empty() {
            let t = self.transfer(i);
            let next = t.zeta_from_zeta * zeta + t.zeta_from_wrench * wrench + t.zeta;
            return (next, t.wrench_from_zeta * zeta + t.wrench_from_wrench * wrench + t.wrench);
        }
        let end = self.end_pose(i);
        let before = Wrench::from_vector(wrench);
        let mut next = end.adjoint_inverse().apply(&Twist::from_vector(zeta)).to_vector();
        let lever = before.moment - end.position.cross(&before.force);
        let mut carried =
            Wrench::new(end.rotation.tr_mul(&lever), end.rotation.tr_mul(&before.force)).to_vector();
        for c in 0..self.layout.columns {
            let value = self.layout.column(c).of(zeta, wrench, 1.0);
            let (by_zeta, by_wrench) = self.column(i, c);
            next += by_zeta * value;
            carried += by_wrench * value;
        }
        if let Some(defect) = self.defect.get(i) {
            carried += defect;
        }
        (next, carried)
    }
}
