//! What distributed loads add to the linearised element.

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::collocation::Collocation;
use super::condense::ZETA;
use super::element::{ElementState, Variations};
use super::stage_system::{StageSystem, cross};
use crate::lie::so3::hat;

/// What the loads add to δΛ_{i+1}: minus blocks (angular–angular, angular–linear, linear–angular) times (δω_l, δν_l).
pub(super) struct Ends<const S: usize> {
    pub(super) blocks: [[Matrix3<f64>; 3]; S],
}

impl<const S: usize> Default for Ends<S> {
    fn default() -> Self {
        Self { blocks: [[Matrix3::zeros(); 3]; S] }
    }
}

/// δF_l = Σ_m g_lm δξ_m + e_l ζ_i: the loads of the stages brought to node i.
pub(super) struct LoadTerms<const S: usize> {
    /// G_l B_lm, blocks as in [`Ends`].
    g: [[[Matrix3<f64>; 3]; S]; S],
    e: [Matrix6<f64>; S],
}

impl<const S: usize> LoadTerms<S> {
    /// G_l = Ad_l⁻ᵀ(D_l − L(f̄_l)), e_l = Ad_l⁻ᵀ D_l Ad_l⁻¹; `None` for a load whose force depends on where it acts.
    ///
    /// Without shear and extension (`SOFT` is false) their blocks are left out.
    pub(super) fn new<const SOFT: bool>(
        state: &ElementState<'_, S>,
        loads: &[crate::load::LoadWrench; S],
        variations: &Variations<S>,
    ) -> Option<Self> {
        let mut terms = Self { g: [[[Matrix3::zeros(); 3]; S]; S], e: [Matrix6::zeros(); S] };
        for (l, load) in loads.iter().enumerate() {
            let d = |r: usize, c: usize| load.tangent.fixed_view::<3, 3>(r, c).into_owned();
            if d(3, 3) != Matrix3::zeros() {
                return None;
            }
            let pose = &state.kinematics.stage[l];
            let (r, force) = (&pose.rotation, hat(&load.wrench.force));
            let g21 = r * (d(3, 0) - force);
            let g11 = r * (d(0, 0) - hat(&load.wrench.moment)) + cross(&pose.position, &g21);
            let g12 = r * (d(0, 3) - force);
            for m in 0..S {
                let map = &variations.stage[l][m];
                let soft = if SOFT { g12 * map.diagonal } else { Matrix3::zeros() };
                terms.g[l][m] = [g11 * map.diagonal + g12 * map.lower, soft, g21 * map.diagonal];
            }
            let inverse = pose.adjoint_inverse().to_matrix();
            terms.e[l] = inverse.transpose() * load.tangent * inverse;
        }
        Some(terms)
    }

    /// Adds Ad_kᵀ h Σ a_kl δF_l to the stages, and returns what of −Ad_eᵀ h Σ b_l δF_l belongs to ζ_i.
    pub(super) fn add<const C: usize, const SOFT: bool>(
        &self,
        table: &Collocation<S>,
        state: &ElementState<'_, S>,
        system: &mut StageSystem<S, C>,
        ends: &mut Ends<S>,
    ) -> Matrix6<f64> {
        for k in 0..S {
            let pose = &state.kinematics.stage[k];
            let weights = table.a[k].map(|a| state.h * a);
            for m in 0..S {
                let [aa, al, la] = self.brought::<SOFT>(&weights, m, &pose.rotation, &pose.position);
                system.angular_angular[k][m] += aa;
                if SOFT {
                    system.angular_linear[k][m] += al;
                    system.linear_angular[k][m] += la;
                }
            }
            let e = pose.adjoint().to_matrix().transpose() * self.weighted(&weights);
            for c in 0..6 {
                for r in 0..3 {
                    system.angular_rhs[k][(r, ZETA + c)] = -e[(r, c)];
                    system.linear_rhs[k][(r, ZETA + c)] = -e[(3 + r, c)];
                }
            }
        }
        let (pose, weights) = (&state.kinematics.end, table.b.map(|b| state.h * b));
        for m in 0..S {
            ends.blocks[m] = self.brought::<SOFT>(&weights, m, &pose.rotation, &pose.position);
        }
        -(pose.adjoint().to_matrix().transpose() * self.weighted(&weights))
    }

    /// Ad_gᵀ Σ_l weight_l g_lm.
    fn brought<const SOFT: bool>(
        &self,
        weights: &[f64; S],
        m: usize,
        r: &Matrix3<f64>,
        p: &Vector3<f64>,
    ) -> [Matrix3<f64>; 3] {
        let mut sum = [Matrix3::zeros(); 3];
        for l in 0..S {
            for b in (0..3).filter(|&b| SOFT || b != 1) {
                sum[b] += self.g[l][m][b] * weights[l];
            }
        }
        // Ad_gᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]
        let soft = if SOFT { r.tr_mul(&sum[1]) } else { sum[1] };
        [r.tr_mul(&(sum[0] - cross(p, &sum[2]))), soft, r.tr_mul(&sum[2])]
    }

    fn weighted(&self, weights: &[f64; S]) -> Matrix6<f64> {
        self.e.iter().zip(weights).fold(Matrix6::zeros(), |sum, (e, w)| sum + e * *w)
    }
}
