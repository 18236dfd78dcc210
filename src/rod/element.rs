//! One collocation element: kinematics, balance, and their exact linearisation about node i.

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::collocation::Collocation;
use super::magnus::{exponent, exponent_derivative, taylor_data};
use super::stage_loads::StageLoads;
use crate::body::Constraint;
use crate::lie::{Pose, Twist, TwistMap, Wrench, se3, so3::hat};
use crate::material::Response;
use crate::scalar::Scalar;

/// Poses of the stages and the end of an element relative to its first node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kinematics<D, const S: usize> {
    pub(crate) stage: [Pose<D>; S],
    pub(crate) end: Pose<D>,
}

impl<D: Scalar, const S: usize> Kinematics<D, S> {
    #[inline(always)]
    pub(crate) fn new(table: &Collocation<S>, xi: &[Twist<D>; S], h: f64) -> Self {
        let pose = |t: &[[f64; S]; S]| se3::exp(&exponent(&taylor_data(t, xi, h)));
        let mut motion = Self { stage: [Pose::identity(); S], end: pose(&table.end) };
        for k in 0..S {
            motion.stage[k] = pose(&table.stage[k]);
        }
        motion
    }

    /// The loads of the stages brought to the first node: F_l = Ad_l⁻ᵀ f̄_l.
    pub(crate) fn at_node(&self, stage_loads: &[Wrench<D>; S]) -> [Wrench<D>; S] {
        let mut loads = *stage_loads;
        for (load, pose) in loads.iter_mut().zip(&self.stage) {
            *load = brought_back(pose, load);
        }
        loads
    }

    /// Λ_i of an element without distributed load; the Λ_k go into `stage`.
    #[inline(always)]
    pub(crate) fn wrenches_without_load(
        &self,
        wrench_at_end: &Wrench<D>,
        stage: &mut [Wrench<D>; S],
    ) -> Wrench<D> {
        let at_start = brought_back(&self.end, wrench_at_end);
        for (wrench, pose) in stage.iter_mut().zip(&self.stage) {
            *wrench = carried(pose, &at_start);
        }
        at_start
    }

    /// Λ_k at the stages and Λ at the end, from Λ_i and the loads brought to the first node.
    pub(crate) fn wrenches_from_start(
        &self,
        table: &Collocation<S>,
        wrench_at_start: &Wrench<D>,
        node_loads: Option<[Wrench<D>; S]>,
        h: f64,
    ) -> ([Wrench<D>; S], Wrench<D>) {
        let node_loads = node_loads.unwrap_or([Wrench::zero(); S]);
        let mut at_end = *wrench_at_start;
        for l in 0..S {
            at_end -= node_loads[l] * D::from(h * table.b[l]);
        }
        (self.stage_wrenches(table, wrench_at_start, &node_loads, h), carried(&self.end, &at_end))
    }

    /// Λ_i = Ad_e⁻ᵀ Λ_{i+1} + h Σ b_l F_l.
    pub(crate) fn wrench_at_start(
        &self,
        table: &Collocation<S>,
        wrench_at_end: &Wrench<D>,
        node_loads: &[Wrench<D>; S],
        h: f64,
    ) -> Wrench<D> {
        let mut wrench = brought_back(&self.end, wrench_at_end);
        for l in 0..S {
            wrench += node_loads[l] * D::from(h * table.b[l]);
        }
        wrench
    }

    /// Λ_k = Ad_kᵀ(Λ_i − h Σ a_kl F_l) at the stages.
    pub(crate) fn stage_wrenches(
        &self,
        table: &Collocation<S>,
        wrench_at_start: &Wrench<D>,
        node_loads: &[Wrench<D>; S],
        h: f64,
    ) -> [Wrench<D>; S] {
        let mut stage = [*wrench_at_start; S];
        for (k, wrench) in stage.iter_mut().enumerate() {
            for l in 0..S {
                *wrench -= node_loads[l] * D::from(h * table.a[k][l]);
            }
            *wrench = carried(&self.stage[k], wrench);
        }
        stage
    }
}

impl<const S: usize> Kinematics<f64, S> {
    /// Λ_i of an element whose loads are dead forces, in the frame of the first node; the Λ_k go into `stage`.
    #[inline(always)]
    pub(crate) fn wrenches_of_dead(
        &self,
        table: &Collocation<S>,
        wrench_at_end: &Wrench,
        forces: &[Vector3<f64>; S],
        h: f64,
        stage: &mut [Wrench; S],
    ) -> Wrench {
        // Λ_i, and all Λ_k before they are carried, are sums of F_l = (p_l × f_l, f_l)
        let mut at_start = brought_back(&self.end, wrench_at_end);
        for l in 0..S {
            let force = forces[l] * (h * table.b[l]);
            at_start += Wrench::new(self.stage[l].position.cross(&force), force);
        }
        for (k, (wrench, pose)) in stage.iter_mut().zip(&self.stage).enumerate() {
            let mut sum = at_start;
            for l in 0..S {
                let force = forces[l] * (h * table.a[k][l]);
                sum -= Wrench::new(self.stage[l].position.cross(&force), force);
            }
            *wrench = carried(pose, &sum);
        }
        at_start
    }
}

/// Ad_gᵀ Λ = (Rᵀ(m − p × n), Rᵀ n).
#[inline(always)]
fn carried<D: Scalar>(pose: &Pose<D>, wrench: &Wrench<D>) -> Wrench<D> {
    let moment = wrench.moment - pose.position.cross(&wrench.force);
    Wrench::new(pose.rotation.tr_mul(&moment), pose.rotation.tr_mul(&wrench.force))
}

/// Ad_g⁻ᵀ Λ = (R m + p × R n, R n).
#[inline(always)]
fn brought_back<D: Scalar>(pose: &Pose<D>, wrench: &Wrench<D>) -> Wrench<D> {
    let force = pose.rotation * wrench.force;
    Wrench::new(pose.rotation * wrench.moment + pose.position.cross(&force), force)
}

/// Body displacements of stages and end per change of the stage strains: B_kl = dexp₋Ω_k ∂Ω_k/∂ξ_l.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Variations<const S: usize> {
    pub(crate) stage: [[TwistMap; S]; S],
    pub(crate) end: [TwistMap; S],
}

impl<const S: usize> Variations<S> {
    #[inline(always)]
    pub(crate) fn new(table: &Collocation<S>, xi: &[Twist; S], h: f64) -> Self {
        let zero = TwistMap { diagonal: Matrix3::zeros(), lower: Matrix3::zeros() };
        let mut all = Self { stage: [[zero; S]; S], end: [zero; S] };
        for k in 0..S {
            fill_row(&table.stage[k], xi, h, &mut all.stage[k]);
        }
        fill_row(&table.end, xi, h, &mut all.end);
        all
    }
}

/// dexp₋Ω ∂Ω/∂ξ_l = h Σ_j t_jl dexp₋Ω ∂Ω/∂α_j.
#[inline(always)]
fn fill_row<const S: usize>(t: &[[f64; S]; S], xi: &[Twist; S], h: f64, row: &mut [TwistMap; S]) {
    let alpha = taylor_data(t, xi, h);
    let d_omega = exponent_derivative(&alpha);
    let dexp = se3::dexp(&(-exponent(&alpha)));
    let mut moved = d_omega;
    for j in 0..S {
        moved[j] = dexp * d_omega[j];
    }
    for l in 0..S {
        let mut sum = moved[0].scale(h * t[0][l]);
        for j in 1..S {
            let weight = h * t[j][l];
            sum.diagonal += moved[j].diagonal * weight;
            sum.lower += moved[j].lower * weight;
        }
        row[l] = sum;
    }
}

/// L(Λ) = [[m^, n^], [n^, 0]]: the change L(Λ) ζ of Ad_gᵀ(constant) when the frame moves by ζ.
pub(crate) fn frame_change(wrench: &Wrench) -> Matrix6<f64> {
    let (m, n) = (hat(&wrench.moment), hat(&wrench.force));
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&m);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&n);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&n);
    matrix
}

/// What the linearisation of an element needs: the state about which it is taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementState<'a, const S: usize> {
    pub(crate) h: f64,
    /// ξ at the stages.
    pub(crate) xi: [Twist; S],
    pub(crate) kinematics: &'a Kinematics<f64, S>,
    /// Ψ and ∂Ψ/∂Δξ at the stages.
    pub(crate) response: &'a [Response; S],
    /// Λ_k at the stages.
    pub(crate) stage_wrench: &'a [Wrench; S],
    pub(crate) wrench_at_end: &'a Wrench,
    pub(crate) load: StageLoads<'a, S>,
    /// Strains that do not vary: their equations are left out.
    pub(crate) constraint: Constraint,
}

impl<const S: usize> ElementState<'_, S> {
    /// The force of dead loads at stage k, in the frame of the first node.
    #[inline(always)]
    pub(crate) fn dead_force(&self, k: usize) -> Vector3<f64> {
        match &self.load {
            StageLoads::None => Vector3::zeros(),
            StageLoads::Dead(forces) => forces[k],
            StageLoads::Any(loads) | StageLoads::Strained(loads, _) => {
                self.kinematics.stage[k].rotation * loads[k].wrench.force
            }
        }
    }

    /// r_k = Ψ(Δξ_k) − Λ_k.
    pub(crate) fn residual(&self, k: usize) -> Wrench {
        self.response[k].wrench - self.stage_wrench[k]
    }
}

/// The linearised element about node i, with the stage strains still in it, for any load and any law; see [`condense`](super::condense)
/// for the short cut that most take:
///
/// A δξ = −r + P_ζ ζ_i + P_Λ δΛ_i, and ζ_{i+1}, δΛ_{i+1} from ζ_i, δΛ_i and δξ.
#[derive(Clone, Debug)]
pub(crate) struct Linearisation<const S: usize> {
    /// A, S×S blocks.
    pub(crate) stage: [[Matrix6<f64>; S]; S],
    pub(crate) from_zeta: [Matrix6<f64>; S],
    pub(crate) from_wrench: [Matrix6<f64>; S],
    pub(crate) residual: [Wrench; S],
    /// B_el.
    pub(crate) end_strain: [Matrix6<f64>; S],
    /// ∂Λ_{i+1}/∂ζ_i at fixed δξ.
    pub(crate) wrench_from_zeta: Matrix6<f64>,
    /// ∂Λ_{i+1}/∂ξ_l.
    pub(crate) wrench_from_strain: [Matrix6<f64>; S],
}

impl<const S: usize> Linearisation<S> {
    /// With y_k = Σ_l B_kl δξ_l and z_l = Ad_l⁻¹ ζ_i + y_l the displacement of stage l,
    ///
    /// δΛ_k = L(Λ_k) y_k + Ad_kᵀ(δΛ_i − h Σ a_kl δF_l), δF_l = Ad_l⁻ᵀ(D_l z_l − L(f̄_l) y_l),
    /// K_k δξ_k − δΛ_k = −r_k,
    /// ζ_{i+1} = Ad_e⁻¹ ζ_i + y_e, δΛ_{i+1} = L(Λ_{i+1}) y_e + Ad_eᵀ(δΛ_i − h Σ b_l δF_l).
    pub(crate) fn new(table: &Collocation<S>, state: &ElementState<'_, S>) -> Self {
        let variations = Variations::new(table, &state.xi, state.h);
        let b = variations.stage.map(|row| row.map(|map| map.to_matrix()));
        let end_strain = variations.end.map(|map| map.to_matrix());
        let transpose = state.kinematics.stage.map(|g| g.adjoint().to_matrix().transpose());
        let end_transpose = state.kinematics.end.adjoint().to_matrix().transpose();
        let end_change = frame_change(state.wrench_at_end);

        let mut stage: [[Matrix6<f64>; S]; S] = std::array::from_fn(|k| {
            let change = frame_change(&state.stage_wrench[k]);
            std::array::from_fn(|m| {
                let block = -(change * b[k][m]);
                if k == m { block + state.response[k].tangent } else { block }
            })
        });
        let mut from_zeta = [Matrix6::zeros(); S];
        let mut wrench_from_zeta = Matrix6::zeros();
        let mut wrench_from_strain = end_strain.map(|block| end_change * block);

        for (l, pose) in state.kinematics.stage.iter().enumerate() {
            let Some(load) = state.load.at_stage(l, pose) else { break };
            let inverse = pose.adjoint_inverse().to_matrix();
            // δF_l = G_l y_l + E_l ζ_i
            let g = inverse.transpose() * (load.tangent - frame_change(&load.wrench));
            let e = inverse.transpose() * load.tangent * inverse;
            let g_b = b[l].map(|block| g * block);
            for k in 0..S {
                let factor = transpose[k] * (state.h * table.a[k][l]);
                for m in 0..S {
                    stage[k][m] += factor * g_b[m];
                }
                from_zeta[k] -= factor * e;
            }
            let factor = end_transpose * (state.h * table.b[l]);
            for m in 0..S {
                wrench_from_strain[m] -= factor * g_b[m];
            }
            wrench_from_zeta -= factor * e;
            if let Some(by_strain) = state.load.by_strain(l) {
                let at_node = inverse.transpose() * by_strain;
                for k in 0..S {
                    stage[k][l] += transpose[k] * (state.h * table.a[k][l]) * at_node;
                }
                wrench_from_strain[l] -= factor * at_node;
            }
        }
        Self {
            stage,
            from_zeta,
            from_wrench: transpose,
            residual: std::array::from_fn(|k| state.residual(k)),
            end_strain,
            wrench_from_zeta,
            wrench_from_strain,
        }
    }
}
