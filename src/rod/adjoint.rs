//! The element in its variational form: the balance is the adjoint of the Magnus kinematics.
//!
//! With B_kl the body displacement of stage k per change of the strain of stage l (and B_el that of the end), the principle of virtual
//! work on one element gives, for loads f̄_l in the frames of the stages,
//!
//! h b_k Ψ_k = B_ekᵀ Λ_{i+1} + Σ_l h b_l B_lkᵀ f̄_l, Λ_i = Ad_e⁻ᵀ Λ_{i+1} + Σ_l h b_l Ad_l⁻ᵀ f̄_l.
//!
//! With inertia among the loads this is a Lagrangian system, which the collocation form of the balance is not: undamped and loaded, that one
//! gains energy.

use nalgebra::Matrix6;
use num_dual::{Dual2_64, Dual64};

use super::collocation::Collocation;
use super::element::{Variations, frame_change};
use super::magnus::{exponent, exponent_derivative_transpose, taylor_data};
use crate::lie::{Pose, Twist, TwistMap, Wrench, se3};

/// The motion from the first node of an element to a stage or to its end, exp Ω.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg<const S: usize> {
    alpha: [Twist; S],
    omega: Twist,
    pub(crate) pose: Pose,
}

impl<const S: usize> Leg<S> {
    pub(crate) fn still() -> Self {
        Self { alpha: [Twist::zero(); S], omega: Twist::zero(), pose: Pose::identity() }
    }

    #[inline(always)]
    fn new(t: &[[f64; S]; S], xi: &[Twist; S], h: f64) -> Self {
        let alpha = taylor_data(t, xi, h);
        let omega = exponent(&alpha);
        Self { alpha, omega, pose: se3::exp(&omega) }
    }

    /// Adds Bᵀ Λ to the stages.
    #[inline(always)]
    fn pull(&self, t: &[[f64; S]; S], h: f64, wrench: &Wrench, into: &mut [Wrench; S]) {
        let at_start = se3::dexp(&-self.omega).apply_transpose(&(*wrench * h));
        let by_alpha = exponent_derivative_transpose(&self.alpha, &at_start);
        for l in 0..S {
            for j in 0..S {
                into[l] += by_alpha[j] * t[j][l];
            }
        }
    }

    /// B δξ: the body velocity, relative to the first node, that rates of strain give.
    fn push(&self, t: &[[f64; S]; S], h: f64, rate: &[Twist; S]) -> Twist {
        let alpha_rate = taylor_data(t, rate, h);
        let moving: [Twist<Dual64>; S] = std::array::from_fn(|j| {
            let (value, slope) = (self.alpha[j].to_array(), alpha_rate[j].to_array());
            Twist::from_array(std::array::from_fn(|c| Dual64::new(value[c], slope[c])))
        });
        let omega_rate = exponent(&moving).map(|v| v.eps);
        se3::dexp(&-self.omega).apply(&omega_rate)
    }
}

/// The motions of one element: to its stages and to its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Legs<const S: usize> {
    pub(crate) stage: [Leg<S>; S],
    pub(crate) end: Leg<S>,
}

impl<const S: usize> Legs<S> {
    pub(crate) fn still() -> Self {
        Self { stage: [Leg::still(); S], end: Leg::still() }
    }

    #[inline(always)]
    pub(crate) fn fill(&mut self, table: &Collocation<S>, xi: &[Twist; S], h: f64) {
        for k in 0..S {
            self.stage[k] = Leg::new(&table.stage[k], xi, h);
        }
        self.end = Leg::new(&table.end, xi, h);
    }

    /// Λ_i, and B_ekᵀ Λ_{i+1} + Σ_l B_lkᵀ F_l at the stages, for F_l = h b_l f̄_l.
    #[inline(always)]
    pub(crate) fn balance(
        &self,
        table: &Collocation<S>,
        h: f64,
        wrench_at_end: &Wrench,
        forces: &[Wrench; S],
    ) -> (Wrench, [Wrench; S]) {
        let mut at_stages = [Wrench::zero(); S];
        self.end.pull(&table.end, h, wrench_at_end, &mut at_stages);
        let mut at_start = brought(&self.end.pose, wrench_at_end);
        for l in 0..S {
            self.stage[l].pull(&table.stage[l], h, &forces[l], &mut at_stages);
            at_start += brought(&self.stage[l].pose, &forces[l]);
        }
        (at_start, at_stages)
    }

    /// The velocities of the stages and the end from that of the first node and the rates of strain.
    pub(crate) fn velocities(
        &self,
        table: &Collocation<S>,
        h: f64,
        node: &Twist,
        rate: &[Twist; S],
    ) -> ([Twist; S], Twist) {
        let at =
            |leg: &Leg<S>, t: &[[f64; S]; S]| leg.pose.adjoint_inverse().apply(node) + leg.push(t, h, rate);
        (std::array::from_fn(|k| at(&self.stage[k], &table.stage[k])), at(&self.end, &table.end))
    }
}

/// Velocities and accelerations of the stages and the end of an element whose first node does not move and whose strains are
/// ξ + τ ξ̇: exact second derivatives of the Magnus kinematics.
pub(crate) fn free_motion<const S: usize>(
    table: &Collocation<S>,
    h: f64,
    xi: &[Twist; S],
    rate: &[Twist; S],
) -> ([[Twist; 2]; S], [Twist; 2]) {
    let moving: [Twist<Dual2_64>; S] = std::array::from_fn(|k| {
        let (value, slope) = (xi[k].to_array(), rate[k].to_array());
        Twist::from_array(std::array::from_fn(|c| Dual2_64::new(value[c], slope[c], 0.0)))
    });
    let at = |t: &[[f64; S]; S]| {
        let (_, velocity, acceleration) = se3::exp(&exponent(&taylor_data(t, &moving, h))).motion();
        [velocity, acceleration]
    };
    (std::array::from_fn(|k| at(&table.stage[k])), at(&table.end))
}

/// Ad_g⁻ᵀ Λ = (R m + p × R n, R n): a wrench brought from the frame of g to the one it is relative to.
#[inline(always)]
pub(crate) fn brought(pose: &Pose, wrench: &Wrench) -> Wrench {
    let force = pose.rotation * wrench.force;
    Wrench::new(pose.rotation * wrench.moment + pose.position.cross(&force), force)
}

/// The state of an element about which it is linearised.
pub(crate) struct AdjointState<'a, const S: usize> {
    pub(crate) h: f64,
    pub(crate) xi: [Twist; S],
    pub(crate) legs: &'a Legs<S>,
    /// The derivative of the internal wrench in the strain, ∂Ψ/∂Δξ and what damping adds.
    pub(crate) stiffness: &'a [Matrix6<f64>; S],
    /// The internal wrench of the stages.
    pub(crate) wrench: &'a [Wrench; S],
    pub(crate) wrench_at_end: &'a Wrench,
    /// F_l = h b_l f̄_l and its derivative in a displacement of stage l.
    pub(crate) force: &'a [Wrench; S],
    pub(crate) force_tangent: &'a [Matrix6<f64>; S],
    /// Whether the wrenches turn with the frames: not so where only inertia counts.
    pub(crate) geometric: bool,
}

/// The linearised element,
///
/// Σ_m A_km δξ_m = −r_k + B_ekᵀ δΛ_{i+1} + P_k ζ_i, ζ_{i+1} = Ad_e⁻¹ ζ_i + Σ B_em δξ_m,
/// δΛ_i = Ad_e⁻ᵀ δΛ_{i+1} + U ζ_i − Σ Q_m δξ_m.
///
/// Its rows are scaled by h b_k. The derivatives of B are those of collocation, exact to the order of the element: with
/// N_e = L(Λ_{i+1}) and N_l = L(F_l) − D_l,
///
/// A_km = h b_k (K_k δ_km − L(Ψ_k) B_km) + B_ekᵀ N_e B_em + Σ_l B_lkᵀ N_l B_lm, P_k = Σ_l B_lkᵀ D_l Ad_l⁻¹,
/// Q_m = Ad_e⁻ᵀ N_e B_em + Σ_l Ad_l⁻ᵀ N_l B_lm, U = Σ_l Ad_l⁻ᵀ D_l Ad_l⁻¹.
pub(crate) struct AdjointElement<const S: usize> {
    pub(crate) a: [[Matrix6<f64>; S]; S],
    pub(crate) p: [Matrix6<f64>; S],
    pub(crate) q: [Matrix6<f64>; S],
    pub(crate) u: Matrix6<f64>,
    pub(crate) end: [TwistMap; S],
    pub(crate) end_inverse: TwistMap,
}

impl<const S: usize> AdjointElement<S> {
    /// The relation at the end, δΛ_{i+1} = R ζ_{i+1} + …, may be put in at once: then δΛ_{i+1} above is only what R ζ leaves.
    pub(crate) fn new(table: &Collocation<S>, state: &AdjointState<'_, S>, relation: &Matrix6<f64>) -> Self {
        let variations = Variations::new(table, &state.xi, state.h);
        let zero = Matrix6::zeros();
        let end_inverse = state.legs.end.pose.adjoint_inverse();
        let mut element =
            Self { a: [[zero; S]; S], p: [zero; S], q: [zero; S], u: zero, end: variations.end, end_inverse };
        for k in 0..S {
            let weight = state.h * table.b[k];
            element.a[k][k] = state.stiffness[k] * weight;
            if state.geometric {
                let change = frame_change(&(state.wrench[k] * weight));
                for m in 0..S {
                    element.a[k][m] -= right(&change, &variations.stage[k][m]);
                }
            }
        }
        element.add(&variations.end, &end_inverse, relation, state.wrench_at_end, state.geometric);
        for l in 0..S {
            let inverse = state.legs.stage[l].pose.adjoint_inverse();
            let row = variations.stage[l];
            element.add(&row, &inverse, &state.force_tangent[l], &state.force[l], state.geometric);
        }
        element
    }

    /// What a wrench Λ with the derivative D, acting where B leads, adds.
    #[inline(always)]
    fn add(
        &mut self,
        b: &[TwistMap; S],
        inverse: &TwistMap,
        d: &Matrix6<f64>,
        wrench: &Wrench,
        geometric: bool,
    ) {
        let n = if geometric { frame_change(wrench) - d } else { -d };
        let d_inverse = right(d, inverse);
        self.u += left(inverse, &d_inverse);
        for k in 0..S {
            self.p[k] += left(&b[k], &d_inverse);
        }
        for m in 0..S {
            let n_b = right(&n, &b[m]);
            self.q[m] += left(inverse, &n_b);
            for k in 0..S {
                self.a[k][m] += left(&b[k], &n_b);
            }
        }
    }
}

/// X B for B = [[A, 0], [C, A]].
#[inline(always)]
pub(crate) fn right(x: &Matrix6<f64>, b: &TwistMap) -> Matrix6<f64> {
    let mut out = Matrix6::zeros();
    for c in 0..3 {
        for k in 0..3 {
            let (a, l) = (b.diagonal[(k, c)], b.lower[(k, c)]);
            for r in 0..6 {
                out[(r, c)] += x[(r, k)] * a + x[(r, 3 + k)] * l;
                out[(r, 3 + c)] += x[(r, 3 + k)] * a;
            }
        }
    }
    out
}

/// Bᵀ X for B = [[A, 0], [C, A]].
#[inline(always)]
pub(crate) fn left(b: &TwistMap, x: &Matrix6<f64>) -> Matrix6<f64> {
    let mut out = Matrix6::zeros();
    for c in 0..6 {
        for r in 0..3 {
            let (mut upper, mut lower) = (0.0, 0.0);
            for k in 0..3 {
                upper += b.diagonal[(k, r)] * x[(k, c)] + b.lower[(k, r)] * x[(3 + k, c)];
                lower += b.diagonal[(k, r)] * x[(3 + k, c)];
            }
            out[(r, c)] = upper;
            out[(3 + r, c)] = lower;
        }
    }
    out
}
