//! The stage equations of one element, and their solution: shear and extension first, then bending and torsion of all stages together.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::condense::{ONE, WRENCH};
use super::element::{ElementState, Variations};
use super::stages::{solve_free_rows, solve_rows};
use crate::lie::Wrench;

/// v × every column.
#[inline(always)]
pub(super) fn cross<const C: usize>(v: &Vector3<f64>, m: &SMatrix<f64, 3, C>) -> SMatrix<f64, 3, C> {
    let mut result = SMatrix::<f64, 3, C>::zeros();
    for c in 0..C {
        let (x, y, z) = (m[(0, c)], m[(1, c)], m[(2, c)]);
        result[(0, c)] = v.y * z - v.z * y;
        result[(1, c)] = v.z * x - v.x * z;
        result[(2, c)] = v.x * y - v.y * x;
    }
    result
}

/// The inverse of a positive definite stiffness against shear and extension; `None` where it is not clearly definite.
#[inline(always)]
pub(super) fn inverse(k: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    /// Of the determinant relative to the product of the diagonal: the cofactors keep six digits.
    const LEAST: f64 = 1e-10;
    // scaled, so that EA = 1e150 is still fine
    let scale = 1.0 / (k[(0, 0)].abs() + k[(1, 1)].abs() + k[(2, 2)].abs());
    let k = k * scale;
    let (c0, c1, c2) = (k.column(0).into_owned(), k.column(1).into_owned(), k.column(2).into_owned());
    let cofactors = [c1.cross(&c2), c2.cross(&c0), c0.cross(&c1)];
    let determinant = c0.dot(&cofactors[0]);
    let diagonal = k[(0, 0)] * k[(1, 1)] * k[(2, 2)];
    let definite = k[(0, 0)] > 0.0 && k[(1, 1)] > 0.0 && determinant > LEAST * diagonal && diagonal > 0.0;
    if !(definite && scale > 0.0) {
        return None;
    }
    Some(Matrix3::from_columns(&cofactors).transpose() * (scale / determinant))
}

/// The inverse among the strains that are free, zero in the rows and columns of those that are fixed.
pub(super) fn inverse_of_free(mut k: Matrix3<f64>, fixed: &[bool; 6]) -> Option<Matrix3<f64>> {
    let size = (0..3).filter(|&i| !fixed[3 + i]).fold(0.0_f64, |size, i| size.max(k[(i, i)]));
    let held = |i: usize| fixed[3 + i];
    for i in (0..3).filter(|&i| held(i)) {
        k.row_mut(i).fill(0.0);
        k.column_mut(i).fill(0.0);
        k[(i, i)] = size;
    }
    let mut flexibility = inverse(&k)?;
    for i in (0..3).filter(|&i| held(i)) {
        flexibility[(i, i)] = 0.0;
    }
    Some(flexibility)
}

/// The stage equations, rows (angular, linear) and unknowns (δω, δν); the block linear–linear is K_νν alone.
pub(super) struct StageSystem<const S: usize, const C: usize> {
    pub(super) angular_angular: [[Matrix3<f64>; S]; S],
    pub(super) angular_linear: [[Matrix3<f64>; S]; S],
    pub(super) linear_angular: [[Matrix3<f64>; S]; S],
    pub(super) angular_rhs: [SMatrix<f64, 3, C>; S],
    pub(super) linear_rhs: [SMatrix<f64, 3, C>; S],
}

impl<const S: usize, const C: usize> StageSystem<S, C> {
    /// K_k δξ_k − L(Λ_k) Σ_l B_kl δξ_l = −r_k + Ad_kᵀ δΛ_i.
    #[inline(always)]
    pub(super) fn new<const SOFT: bool>(state: &ElementState<'_, S>, variations: &Variations<S>) -> Self {
        let zero = [[Matrix3::zeros(); S]; S];
        let mut system = Self {
            angular_angular: zero,
            angular_linear: zero,
            linear_angular: zero,
            angular_rhs: [SMatrix::zeros(); S],
            linear_rhs: [SMatrix::zeros(); S],
        };
        for k in 0..S {
            let Wrench { moment, force } = &state.stage_wrench[k];
            for l in 0..S {
                let map = &variations.stage[k][l];
                system.angular_angular[k][l] = -(cross(moment, &map.diagonal) + cross(force, &map.lower));
                if SOFT {
                    let by_force = cross(force, &map.diagonal);
                    system.angular_linear[k][l] = -by_force;
                    system.linear_angular[k][l] = -by_force;
                }
            }
            let tangent = &state.response[k].tangent;
            system.angular_angular[k][k] += tangent.fixed_view::<3, 3>(0, 0);
            if SOFT {
                system.angular_linear[k][k] += tangent.fixed_view::<3, 3>(0, 3);
                system.linear_angular[k][k] += tangent.fixed_view::<3, 3>(3, 0);
            }

            // Ad_kᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]
            let (pose, residual) = (&state.kinematics.stage[k], state.residual(k));
            let transpose = pose.rotation.transpose();
            let (angular, linear) = (&mut system.angular_rhs[k], &mut system.linear_rhs[k]);
            angular.fixed_view_mut::<3, 3>(0, WRENCH).copy_from(&transpose);
            let lever = cross(&pose.position, &pose.rotation).transpose();
            angular.fixed_view_mut::<3, 3>(0, WRENCH + 3).copy_from(&lever);
            angular.fixed_view_mut::<3, 1>(0, ONE).copy_from(&-residual.moment);
            if SOFT {
                linear.fixed_view_mut::<3, 3>(0, WRENCH + 3).copy_from(&transpose);
                linear.fixed_view_mut::<3, 1>(0, ONE).copy_from(&-residual.force);
            }
        }
        system
    }

    /// Puts (δω, δν) of all stages where the right-hand sides are.
    #[inline(always)]
    pub(super) fn solve<const SOFT: bool>(
        &mut self,
        flexibility: &[Matrix3<f64>; S],
        fixed: &[bool; 6],
    ) -> Option<()> {
        let (matrix, rhs) = (&mut self.angular_angular, &mut self.angular_rhs);
        if SOFT {
            for k in 0..S {
                for l in 0..S {
                    let factor = self.angular_linear[k][l] * flexibility[l];
                    for m in 0..S {
                        matrix[k][m] -= factor * self.linear_angular[l][m];
                    }
                    rhs[k] -= factor * self.linear_rhs[l];
                }
            }
        }
        if fixed[..3] == [false; 3] {
            solve_rows(matrix, rhs)?;
        } else {
            solve_free_rows(matrix, rhs, fixed)?;
        }
        let linear = &mut self.linear_rhs;
        if !SOFT {
            linear.iter_mut().for_each(|linear| linear.fill(0.0));
            return Some(());
        }
        for k in 0..S {
            for l in 0..S {
                linear[k] -= self.linear_angular[k][l] * rhs[l];
            }
            linear[k] = flexibility[k] * linear[k];
        }
        Some(())
    }
}
