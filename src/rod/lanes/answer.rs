//! The kernel that puts what the rod beyond an element answers into its columns; see [`Answers`](crate::rod::condense::Answers).

use super::algebra::{Matrix, Vector, add, cross, transpose_times, zeros};
use super::magnus::Placed;
use super::rows::{LOADLESS, NOTHING, Row, load_vector};
use super::run;
use crate::scalar::{Kernel, Lane};

/// Columns: w_i, then 1.
const WIDTH: usize = 4;

struct Answer<'a> {
    from: &'a [Row],
    columns: usize,
    /// Rows of the strains: after them are six of ζ, six of δΛ, and the pose.
    strains: usize,
    relation: &'a [[Row; WIDTH]; 3],
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
    relation: &[[Row; WIDTH]; 3],
    force: &[Row; 3],
    count: usize,
    into: &mut [Row],
) {
    run(Answer { from, columns, strains, relation, force, count, into }, count);
}

/// S by rows, and s.
#[derive(Clone, Copy)]
struct Given<L> {
    matrix: Matrix<L>,
    constant: Vector<L>,
    force: Vector<L>,
}

impl Kernel for Answer<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { from, columns, strains, relation, force, count, into } = self;
        let mut rotation = [NOTHING; 12];
        let pose = (strains + 12) * columns;
        rotation.copy_from_slice(&from[pose..pose + 12]);
        for at in (0..count).step_by(L::LANES) {
            let mut given =
                Given { matrix: zeros(), constant: [L::splat(0.0); 3], force: load_vector(force, at) };
            for r in 0..3 {
                for c in 0..3 {
                    given.matrix[r][c] = L::load(&relation[r][c][at..]);
                }
                given.constant[r] = L::load(&relation[r][3][at..]);
            }
            let end = Placed::<L>::load(&rotation, at);
            let base = given.base(&end);
            for row in 0..strains + 9 {
                let mut out = given.put(&from[row * columns..][..columns], at);
                if row >= strains {
                    for c in 0..WIDTH {
                        out[c] = out[c] + base[row - strains][c];
                    }
                }
                for c in 0..WIDTH {
                    out[c].store(&mut into[WIDTH * row + c][at..]);
                }
            }
            for (r, row) in rotation[..9].iter().enumerate() {
                L::load(&row[at..]).store(&mut into[WIDTH * (strains + 9) + r][at..]);
            }
        }
    }
}

impl<L: Lane> Given<L> {
    /// A row of columns (δm_i, δn_i, 1, w_i) by (w_i, 1): x · (n × w) = (x × n) · w.
    #[inline(always)]
    fn put(&self, row: &[Row], at: usize) -> [L; WIDTH] {
        let mut moment = [L::splat(0.0); 3];
        let mut force = moment;
        for c in 0..3 {
            moment[c] = L::load(&row[c][at..]);
            force[c] = L::load(&row[3 + c][at..]);
        }
        let mut turn = add(&transpose_times(&self.matrix, &moment), &cross(&force, &self.force));
        if row.len() > LOADLESS {
            for c in 0..3 {
                turn[c] = turn[c] + L::load(&row[LOADLESS + c][at..]);
            }
        }
        let constant = moment[2].mul_add(
            self.constant[2],
            moment[1].mul_add(self.constant[1], moment[0].mul_add(self.constant[0], L::load(&row[6][at..]))),
        );
        [turn[0], turn[1], turn[2], constant]
    }

    /// What Ad_e⁻¹ ζ_i and the moment of Ad_eᵀ δΛ_i add: rotation, displacement without that of the first node, moment.
    #[inline(always)]
    fn base(&self, end: &Placed<L>) -> [[L; WIDTH]; 9] {
        let zero = L::splat(0.0);
        let (r, p) = (&end.rotation, &end.position);
        let mut base = [[zero; WIDTH]; 9];
        for c in 0..3 {
            let mut unit = [zero; 3];
            unit[c] = L::splat(1.0);
            // the end moves by w × p
            let shift = transpose_times(r, &cross(&unit, p));
            let column = [self.matrix[0][c], self.matrix[1][c], self.matrix[2][c]];
            let lever = cross(&cross(&self.force, &unit), p);
            let moment = transpose_times(r, &add(&column, &lever));
            for i in 0..3 {
                base[i][c] = r[c][i];
                base[3 + i][c] = shift[i];
                base[6 + i][c] = moment[i];
            }
        }
        let constant = transpose_times(r, &self.constant);
        for i in 0..3 {
            base[6 + i][3] = constant[i];
        }
        base
    }
}
