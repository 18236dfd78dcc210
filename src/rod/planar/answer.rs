//! As [`lanes::answer`](crate::rod::lanes::answer), in the plane: by w_y and 1.

use crate::rod::lanes::{Row, run};
use crate::scalar::{Kernel, Lane};

/// Columns: w_y, then 1.
const WIDTH: usize = 2;

struct Answer<'a> {
    from: &'a [Row],
    columns: usize,
    /// Rows of the strains: after them are three of ζ, three of δΛ, and the pose.
    strains: usize,
    relation: &'a [[Row; 4]; 3],
    force: &'a [Row; 3],
    count: usize,
    into: &'a mut [Row],
}

/// Takes a block over, row by row.
#[inline(never)]
pub(crate) fn answer(
    from: &[Row],
    columns: usize,
    strains: usize,
    relation: &[[Row; 4]; 3],
    force: &[Row; 3],
    count: usize,
    into: &mut [Row],
) {
    run(Answer { from, columns, strains, relation, force, count, into }, count);
}

impl Kernel for Answer<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { from, columns, strains, relation, force, count, into } = self;
        let pose = (strains + 6) * columns;
        for at in (0..count).step_by(L::LANES) {
            let (matrix, constant) = (L::load(&relation[0][0][at..]), L::load(&relation[0][3][at..]));
            // δn = −i n w
            let (n_z, n_x) = (L::load(&force[0][at..]), -L::load(&force[2][at..]));
            let (cos, sin) = (L::load(&from[pose][at..]), L::load(&from[pose + 1][at..]));
            let (z, x) = (L::load(&from[pose + 2][at..]), L::load(&from[pose + 3][at..]));
            // the end moves by e^{−iθ} i p w
            let back = [cos * -x + sin * z, cos * z - sin * -x];
            let zero = L::splat(0.0);
            let base = [
                [L::splat(1.0), zero],
                [back[0], zero],
                [back[1], zero],
                [matrix + x * n_z - z * n_x, constant],
            ];
            for row in 0..strains + 4 {
                let columns = &from[row * columns..][..columns];
                let moment = L::load(&columns[0][at..]);
                let mut turn =
                    moment * matrix + L::load(&columns[1][at..]) * n_z + L::load(&columns[2][at..]) * n_x;
                if columns.len() > 4 {
                    turn = turn + L::load(&columns[4][at..]);
                }
                let mut constant = moment.mul_add(constant, L::load(&columns[3][at..]));
                if row >= strains {
                    turn = turn + base[row - strains][0];
                    constant = constant + base[row - strains][1];
                }
                turn.store(&mut into[WIDTH * row][at..]);
                constant.store(&mut into[WIDTH * row + 1][at..]);
            }
            cos.store(&mut into[WIDTH * (strains + 4)][at..]);
            sin.store(&mut into[WIDTH * (strains + 4) + 1][at..]);
        }
    }
}
