//! As [`super::condense`] with distributed loads in the plane: more terms, so in 3×3 matrices, ordered (y; z, x).

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::magnus::Variations;
use super::{PLACES, PlaneMap};
use crate::lie::{Pose, Wrench};
use crate::load::LoadWrench;
use crate::rod::collocation::Collocation;
use crate::rod::condense::{Condensed, ONE, ZETA};
use crate::rod::element::ElementState;
use crate::rod::stages::solve_free_rows;

/// Columns: δm_y, δn_z, δn_x, 1, w_y, v_z, v_x.
const COLUMNS: usize = 7;
type Columns = SMatrix<f64, 3, COLUMNS>;

/// Whether a load stays in the plane, and its change too when the section moves in the plane.
pub(in crate::rod) fn acts_in_plane(load: &LoadWrench) -> bool {
    let Wrench { moment, force } = &load.wrench;
    let out = |r: usize| PLACES.iter().all(|&c| load.tangent[(r, c)] == 0.0);
    moment.x == 0.0 && moment.z == 0.0 && force.y == 0.0 && out(0) && out(2) && out(4)
}

fn matrix(map: &PlaneMap) -> Matrix3<f64> {
    let (a, b) = (map.diagonal, map.lower);
    Matrix3::new(map.angular, 0.0, 0.0, b.re, a.re, -a.im, b.im, a.im, a.re)
}

/// Ad_g.
fn adjoint(pose: &Pose) -> Matrix3<f64> {
    let (cos, sin, p) = (pose.rotation[(0, 0)], pose.rotation[(0, 2)], &pose.position);
    Matrix3::new(1.0, 0.0, 0.0, p.x, cos, -sin, -p.z, sin, cos)
}

/// Ad_g⁻¹.
fn adjoint_inverse(pose: &Pose) -> Matrix3<f64> {
    let (cos, sin, p) = (pose.rotation[(0, 0)], pose.rotation[(0, 2)], &pose.position);
    // the place of the origin seen from g is −e^{−iθ} p
    let (z, x) = (-(cos * p.z + sin * p.x), -(cos * p.x - sin * p.z));
    Matrix3::new(1.0, 0.0, 0.0, x, cos, sin, -z, -sin, cos)
}

/// L(Λ) = [[0, −n_x, n_z], [n_x, 0, 0], [−n_z, 0, 0]].
fn frame_change(force: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -force.x, force.z, force.x, 0.0, 0.0, -force.z, 0.0, 0.0)
}

fn in_plane(m: &nalgebra::Matrix6<f64>) -> Matrix3<f64> {
    Matrix3::from_fn(|r, c| m[(PLACES[r], PLACES[c])])
}

impl<const S: usize> Condensed<S> {
    /// K_k δq_k − L(Λ_k) y_k + Ad_kᵀ h Σ a_kl δF_l = −r_k + Ad_kᵀ δΛ_i, δF_l = G_l y_l + E_l ζ_i with G_l = Ad_l⁻ᵀ(D_l − L(f̄_l)),
    /// E_l = Ad_l⁻ᵀ D_l Ad_l⁻¹ and y_k = Σ B_kl δq_l.
    pub(in crate::rod) fn fill_loaded_in_plane(
        &mut self,
        table: &Collocation<S>,
        state: &ElementState<'_, S>,
        loads: &[LoadWrench; S],
    ) -> Option<()> {
        let variations = Variations::new(table, &state.xi, state.h);
        let b = variations.stage.map(|row| row.map(|map| matrix(&map)));
        let (mut g_b, mut e) = ([[Matrix3::zeros(); S]; S], [Matrix3::zeros(); S]);
        for l in 0..S {
            let (inverse, d) = (adjoint_inverse(&state.kinematics.stage[l]), in_plane(&loads[l].tangent));
            let g = inverse.tr_mul(&(d - frame_change(&loads[l].wrench.force)));
            g_b[l] = b[l].map(|b| g * b);
            e[l] = inverse.tr_mul(&(d * inverse));
        }
        // Σ_l weight_l of both, brought to a pose
        let brought = |weights: &[f64; S], pose: &Pose| {
            let ad = adjoint(pose);
            let (mut strain, mut zeta) = ([Matrix3::zeros(); S], Matrix3::zeros());
            for l in 0..S {
                let weight = state.h * weights[l];
                zeta += e[l] * weight;
                for m in 0..S {
                    strain[m] += g_b[l][m] * weight;
                }
            }
            (strain.map(|block| ad.tr_mul(&block)), ad.tr_mul(&zeta))
        };
        let (mut system, mut rhs) = ([[Matrix3::zeros(); S]; S], [Columns::zeros(); S]);
        for k in 0..S {
            let pose = &state.kinematics.stage[k];
            let change = frame_change(&state.stage_wrench[k].force);
            let (from_strain, from_zeta) = brought(&table.a[k], pose);
            for m in 0..S {
                system[k][m] = from_strain[m] - change * b[k][m];
            }
            system[k][k] += in_plane(&state.response[k].tangent);
            let residual = state.residual(k).to_array();
            rhs[k].fixed_view_mut::<3, 3>(0, 0).copy_from(&adjoint(pose).transpose());
            rhs[k].set_column(3, &-Vector3::from(PLACES.map(|place| residual[place])));
            rhs[k].fixed_view_mut::<3, 3>(0, 4).copy_from(&-from_zeta);
        }
        let fixed = state.constraint.fixed();
        let free = [fixed[PLACES[0]], fixed[PLACES[1]], fixed[PLACES[2]], false, false, false];
        solve_free_rows(&system, &mut rhs, &free)?;
        let ends = brought(&table.b, &state.kinematics.end);
        self.take_loaded_from_plane(state, &variations.end, &ends, &rhs);
        Some(())
    }

    /// ζ_{i+1} = Ad_e⁻¹ ζ_i + y_e, δΛ_{i+1} = L(Λ_{i+1}) y_e + Ad_eᵀ(δΛ_i − h Σ b_l δF_l), in space again.
    fn take_loaded_from_plane(
        &mut self,
        state: &ElementState<'_, S>,
        end: &[PlaneMap; S],
        (from_strain, from_zeta): &([Matrix3<f64>; S], Matrix3<f64>),
        strain: &[Columns; S],
    ) {
        let (mut y, mut load) = (Columns::zeros(), Columns::zeros());
        for l in 0..S {
            y += matrix(&end[l]) * strain[l];
            load -= from_strain[l] * strain[l];
        }
        let mut from_node = load.fixed_view_mut::<3, 3>(0, 4);
        from_node -= from_zeta;
        self.start_in_plane(state);
        let t = &mut self.transfer;
        for c in 0..COLUMNS {
            let zeta = [0.0, y[(0, c)], 0.0, y[(2, c)], 0.0, y[(1, c)]];
            let mut wrench = super::change_of(state.wrench_at_end, &zeta);
            for (r, place) in PLACES.into_iter().enumerate() {
                wrench[place] += load[(r, c)];
            }
            for r in 0..6 {
                match c {
                    0..3 => {
                        t.zeta_from_wrench[(r, PLACES[c])] = zeta[r];
                        t.wrench_from_wrench[(r, PLACES[c])] += wrench[r];
                    }
                    3 => (t.zeta[r], t.wrench[r]) = (zeta[r], wrench[r]),
                    _ => {
                        t.zeta_from_zeta[(r, PLACES[c - 4])] += zeta[r];
                        t.wrench_from_zeta[(r, PLACES[c - 4])] = wrench[r];
                    }
                }
            }
        }
        self.set_strains::<COLUMNS>(true, |k, c| {
            let column = match c {
                0..3 => PLACES[c],
                3 => ONE,
                _ => ZETA + PLACES[c - 4],
            };
            let q = strain[k].column(c);
            (column, [0.0, q[0], 0.0, q[2], 0.0, q[1]])
        });
    }
}
