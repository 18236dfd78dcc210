//! Rates of strain from velocities: the kinematics of the element turned round.
//!
//! The difference quotients by which a time scheme makes velocities of poses do the same for strains, but there with the order of its stages
//! only: strains are no integrals of anything the scheme integrates. Velocities have the full order, and where the base's is known, they
//! determine the rates of strain: Σ_m B_lm ξ̇_m = η_l − Ad_l⁻¹ η_i.

use nalgebra::{SMatrix, SVector};

use super::core::Core;
use crate::lie::{Strain, Twist};
use crate::rod::element::Variations;

/// The largest number of strains of an element.
const MAX: usize = 18;

impl<const S: usize> Core<S> {
    /// Puts the rates of strain that belong to the velocities into `strain_rate`, from base to tip. Where an element's kinematics cannot be
    /// inverted (they always can while it is not bent through a half circle or more) its rates stay as they are.
    ///
    /// With fixed strains velocities say more than enough, and the rates are those that miss them least.
    pub(super) fn rates_from_velocities(&mut self) {
        let mut node = self.base_rates().velocity;
        for i in 0..self.grid.elements {
            if let Some(mount) = self.between(i) {
                node = mount.turned_on(&node);
            }
            let (xi, h) = (self.grid.twists(i, &self.strain[i]), self.grid.h(i));
            let b = Variations::new(&self.grid.table, &xi, h).stage;
            // the unused rows are those of the identity
            let mut matrix = SMatrix::<f64, MAX, MAX>::identity();
            let mut rhs = SVector::<f64, MAX>::zeros();
            for l in 0..S {
                let carried = self.legs[i].stage[l].pose.adjoint_inverse().apply(&node);
                rhs.fixed_rows_mut::<6>(6 * l).copy_from(&(self.rates[i][l].velocity - carried).to_vector());
                for m in 0..S {
                    matrix.fixed_view_mut::<6, 6>(6 * l, 6 * m).copy_from(&b[l][m].to_matrix());
                }
            }
            if self.grid.has_fixed_strains() {
                least_squares(&mut matrix, &mut rhs, &self.grid.fixed, h, 6 * S);
            }
            if let Some(rates) = matrix.lu().solve(&rhs) {
                for k in 0..S {
                    self.strain_rate[i][k] = Strain::from_vector(&rates.fixed_rows::<6>(6 * k).into_owned());
                }
            }
            let rate: [Twist; S] = self.strain_rate[i].map(|rate| rate.as_twist());
            (_, node) = self.legs[i].velocities(&self.grid.table, h, &node, &rate);
        }
    }
}

/// Replaces A x = b by its normal equations for the strains that are free, rotations counting as displacements at a distance h, and x = 0 for
/// the others.
fn least_squares(
    matrix: &mut SMatrix<f64, MAX, MAX>,
    rhs: &mut SVector<f64, MAX>,
    fixed: &[bool; 6],
    h: f64,
    n: usize,
) {
    let mut weighted = *matrix;
    for row in (0..n).filter(|row| row % 6 < 3) {
        weighted.row_mut(row).scale_mut(h * h);
    }
    *rhs = weighted.transpose() * *rhs;
    *matrix = weighted.transpose() * *matrix;
    for c in (0..n).filter(|c| fixed[c % 6]) {
        matrix.row_mut(c).fill(0.0);
        matrix.column_mut(c).fill(0.0);
        matrix[(c, c)] = 1.0;
        rhs[c] = 0.0;
    }
}
