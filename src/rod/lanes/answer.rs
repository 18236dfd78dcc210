//! The kernels that put into the columns of an element under dead forces what is known of them, and then what the rod beyond it answers; see
//! [`Answers`](crate::rod::condense::Answers).

use super::algebra::{Vector, cross, transpose_times};
use super::magnus::Placed;
use super::rows::{LOADLESS, NOTHING, Row, load_vector};
use super::run;
use crate::scalar::{Kernel, Lane};

/// Columns of an element under dead forces: δm_i, then 1, then w_i with all that turns with it.
pub(crate) const DEAD_COLUMNS: usize = 7;

/// Rows of the end after those of the strains: rotation, displacement without that of the first node, moment.
pub(crate) const END: usize = 9;

/// Columns of an answer: w_i, then 1.
const WIDTH: usize = 4;

struct Turn<'a> {
    from: &'a [Row],
    columns: usize,
    /// Rows of the strains: after them are six of ζ, six of δΛ, and the pose.
    strains: usize,
    force: &'a [Row; 3],
    count: usize,
    into: &'a mut [Row],
}

/// Puts δn_i = n_i × w_i into the columns of a block, row by row; the rotation of the end comes last.
#[inline(never)]
pub(crate) fn turn(
    from: &[Row],
    columns: usize,
    strains: usize,
    force: &[Row; 3],
    count: usize,
    into: &mut [Row],
) {
    run(Turn { from, columns, strains, force, count, into }, count);
}

impl Kernel for Turn<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { from, columns, strains, force, count, into } = self;
        let mut rotation = [NOTHING; 12];
        let pose = (strains + 12) * columns;
        rotation.copy_from_slice(&from[pose..pose + 12]);
        for at in (0..count).step_by(L::LANES) {
            let n = load_vector(force, at);
            let end = Placed::<L>::load(&rotation, at);
            let base = base(&end, &n);
            for row in 0..strains + END {
                let mut out = put(&from[row * columns..][..columns], &n, at);
                if row >= strains {
                    for c in 0..3 {
                        out[4 + c] = out[4 + c] + base[row - strains][c];
                        if row >= strains + 6 {
                            // the moment of Ad_eᵀ δΛ_i
                            out[c] = out[c] + end.rotation[c][row - strains - 6];
                        }
                    }
                }
                for c in 0..DEAD_COLUMNS {
                    out[c].store(&mut into[DEAD_COLUMNS * row + c][at..]);
                }
            }
            for (r, row) in rotation[..9].iter().enumerate() {
                L::load(&row[at..]).store(&mut into[DEAD_COLUMNS * (strains + END) + r][at..]);
            }
        }
    }
}

/// A row of columns (δm_i, δn_i, 1, w_i) by (δm_i, 1, w_i): x · (n × w) = (x × n) · w.
#[inline(always)]
fn put<L: Lane>(row: &[Row], n: &Vector<L>, at: usize) -> [L; DEAD_COLUMNS] {
    let mut moment = [L::splat(0.0); 3];
    let mut force = moment;
    for c in 0..3 {
        moment[c] = L::load(&row[c][at..]);
        force[c] = L::load(&row[3 + c][at..]);
    }
    let mut turn = cross(&force, n);
    if row.len() > LOADLESS {
        for c in 0..3 {
            turn[c] = turn[c] + L::load(&row[LOADLESS + c][at..]);
        }
    }
    [moment[0], moment[1], moment[2], L::load(&row[6][at..]), turn[0], turn[1], turn[2]]
}

/// What Ad_e⁻¹ ζ_i and the moment of Ad_eᵀ (0, n × w_i) add, by w_i.
#[inline(always)]
fn base<L: Lane>(end: &Placed<L>, n: &Vector<L>) -> [[L; 3]; END] {
    let zero = L::splat(0.0);
    let (r, p) = (&end.rotation, &end.position);
    let mut base = [[zero; 3]; END];
    for c in 0..3 {
        let mut unit = [zero; 3];
        unit[c] = L::splat(1.0);
        // the end moves by w × p
        let shift = transpose_times(r, &cross(&unit, p));
        let moment = transpose_times(r, &cross(&cross(n, &unit), p));
        for i in 0..3 {
            base[i][c] = r[c][i];
            base[3 + i][c] = shift[i];
            base[6 + i][c] = moment[i];
        }
    }
    base
}

struct Answer<'a> {
    from: &'a [Row],
    rows: usize,
    relation: &'a [[Row; WIDTH]; 3],
    count: usize,
    into: &'a mut [Row],
}

/// Puts δm_i = S_i w_i + s_i into the columns of so many rows of a block, and takes over the rotation after them.
#[inline(never)]
pub(crate) fn answer(
    from: &[Row],
    rows: usize,
    relation: &[[Row; WIDTH]; 3],
    count: usize,
    into: &mut [Row],
) {
    run(Answer { from, rows, relation, count, into }, count);
}

impl Kernel for Answer<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { from, rows, relation, count, into } = self;
        for at in (0..count).step_by(L::LANES) {
            let mut given = [[L::splat(0.0); 3]; WIDTH];
            for c in 0..WIDTH {
                for r in 0..3 {
                    given[c][r] = L::load(&relation[r][c][at..]);
                }
            }
            for row in 0..rows {
                let columns = &from[DEAD_COLUMNS * row..][..DEAD_COLUMNS];
                let mut moment = [L::splat(0.0); 3];
                for r in 0..3 {
                    moment[r] = L::load(&columns[r][at..]);
                }
                for c in 0..WIDTH {
                    // w_i after 1
                    let own = L::load(&columns[if c < 3 { 4 + c } else { 3 }][at..]);
                    let [x, y, z] = given[c];
                    let sum = moment[2].mul_add(z, moment[1].mul_add(y, moment[0].mul_add(x, own)));
                    sum.store(&mut into[WIDTH * row + c][at..]);
                }
            }
            for r in 0..9 {
                L::load(&from[DEAD_COLUMNS * rows + r][at..]).store(&mut into[WIDTH * rows + r][at..]);
            }
        }
    }
}
