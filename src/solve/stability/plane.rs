use nalgebra::{Matrix6, SVector};

use super::condition::Condition;
use super::eigen::Symmetric;
use super::link::Link;

/// A Lagrangian plane of pairs (ζ, μ): the six columns of an orthonormal basis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    pub(super) zeta: Matrix6<f64>,
    pub(super) momentum: Matrix6<f64>,
}

impl Plane {
    /// What the plane becomes behind an element, and R with T (columns) = (new columns) R.
    pub(super) fn behind(&self, link: &Link) -> (Self, Matrix6<f64>) {
        let zeta = link.zeta_zeta * self.zeta + link.zeta_momentum * self.momentum;
        let momentum = link.momentum_zeta * self.zeta + link.momentum_momentum * self.momentum;
        Self { zeta, momentum }.orthonormal()
    }

    /// What the plane becomes behind a support: displacements that it allows, with what it applies added to their momenta, and its reactions.
    /// Also the coefficients of the old plane from those of the new.
    pub(super) fn supported(&self, by: &Condition) -> Option<(Self, Matrix6<f64>)> {
        let stiffness = 0.5 * (by.stiffness + by.stiffness.transpose());
        let held = Matrix6::from_fn(|r, c| {
            if by.fixed[r] { by.directions.column(r).dot(&self.zeta.column(c)) } else { 0.0 }
        });
        let gram = held.tr_mul(&held);
        let eigen = Symmetric::part_of(6, |r, c| gram[(r, c)]).eigen();
        let kept = by.fixed.iter().filter(|fixed| !**fixed).count();
        let (mut zeta, mut momentum, mut from) = (Matrix6::zeros(), Matrix6::zeros(), Matrix6::zeros());
        // combinations that the support does not hold, and of these the ones that are more than a reaction of it
        let mut found = 0;
        for k in 0..6 {
            let a = nalgebra::Vector6::from_fn(|r, _| eigen.vector[r][k]);
            let moved = self.zeta * a;
            let applied = self.momentum * a + stiffness * moved;
            let (mut z, mut m) = (moved, applied);
            for c in (0..6).filter(|&c| by.fixed[c]) {
                let d = by.directions.column(c);
                z -= d * d.dot(&moved);
                m -= d * d.dot(&applied);
            }
            if found < kept && z.norm() + m.norm() > REACTION {
                zeta.set_column(found, &z);
                momentum.set_column(found, &m);
                from.set_column(found, &a);
                found += 1;
            }
        }
        for c in (0..6).filter(|&c| by.fixed[c]) {
            if found == 6 {
                break;
            }
            momentum.set_column(found, &by.directions.column(c));
            found += 1;
        }
        let (plane, triangle) = Self { zeta, momentum }.orthonormal();
        let back = from * triangle.try_inverse()?;
        (found == 6 && plane.zeta.iter().all(|v| v.is_finite())).then_some((plane, back))
    }

    /// An orthonormal basis of the same plane, by Gram and Schmidt's process done twice, and R with (old columns) = (new columns) R.
    pub(super) fn orthonormal(&self) -> (Self, Matrix6<f64>) {
        let mut columns: [SVector<f64, 12>; 6] = std::array::from_fn(|c| {
            SVector::from_fn(|r, _| if r < 6 { self.zeta[(r, c)] } else { self.momentum[(r - 6, c)] })
        });
        let mut triangle = Matrix6::zeros();
        for c in 0..6 {
            for _ in 0..2 {
                for earlier in 0..c {
                    let along = columns[earlier].dot(&columns[c]);
                    triangle[(earlier, c)] += along;
                    let part = columns[earlier] * along;
                    columns[c] -= part;
                }
            }
            let norm = columns[c].norm();
            triangle[(c, c)] = norm;
            columns[c] /= norm;
        }
        let zeta = Matrix6::from_fn(|r, c| columns[c][r]);
        let momentum = Matrix6::from_fn(|r, c| columns[c][6 + r]);
        (Self { zeta, momentum }, triangle)
    }

    /// The plane as a bounded relation; `None` where it is no plane of numbers.
    pub(super) fn relation(&self) -> Option<Relation> {
        let gram = self.zeta * self.zeta.transpose();
        let eigen = Symmetric::part_of(6, |r, c| gram[(r, c)]).eigen();
        if !eigen.is_finite() {
            return None;
        }
        // cos² of the angles, ascending: stiff directions first; the cut is where the angles are farthest apart, not near a clamp or a free end
        let cut = (0..=6)
            .filter(|&k| {
                let (below, above) = (value(&eigen.value, k, true), value(&eigen.value, k, false));
                below < MOST_STIFF && above > LEAST_SOFT
            })
            .max_by(|&a, &b| gap(&eigen.value, a).total_cmp(&gap(&eigen.value, b)))?;
        let basis = Matrix6::from_fn(|r, c| eigen.vector[r][c]);
        let (zeta, momentum) = (basis.tr_mul(&self.zeta), basis.tr_mul(&self.momentum));
        // (μ_stiff, ζ_soft) determine (ζ_stiff, μ_soft)
        let given = Matrix6::from_fn(|r, c| if r < cut { momentum[(r, c)] } else { zeta[(r, c)] });
        let answer = Matrix6::from_fn(|r, c| if r < cut { zeta[(r, c)] } else { momentum[(r, c)] });
        let inverse = given.try_inverse()?;
        let matrix = answer * inverse;
        matrix.iter().all(|v| v.is_finite()).then_some(Relation { stiff: cut, basis, matrix, inverse })
    }
}

/// A combination smaller than this, of unit ones, is but a reaction of a support.
const REACTION: f64 = 1e-9;

/// cos² of a direction above which it is not taken as stiff.
const MOST_STIFF: f64 = 0.98;

/// cos² of a direction below which it is not taken as soft.
const LEAST_SOFT: f64 = 0.02;

/// The eigenvalue below or above a cut.
fn value(values: &[f64], cut: usize, below: bool) -> f64 {
    match (below, cut) {
        (true, 0) => 0.0,
        (true, _) => values[cut - 1],
        (false, 6) => 1.0,
        (false, _) => values[cut],
    }
}

fn gap(values: &[f64], cut: usize) -> f64 {
    value(values, cut, false) - value(values, cut, true)
}

/// A plane in an orthonormal basis of directions, the first of which are stiff: (ζ_stiff, μ_soft) = M (μ_stiff, ζ_soft).
///
/// M_stiff,stiff is a compliance, zero where the direction is held; M_soft,soft a stiffness, zero where it is free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relation {
    pub(super) stiff: usize,
    /// The directions, as columns.
    pub(super) basis: Matrix6<f64>,
    pub(super) matrix: Matrix6<f64>,
    /// The coefficients in the basis of the plane from (μ_stiff, ζ_soft).
    pub(super) inverse: Matrix6<f64>,
}
