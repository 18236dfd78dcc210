//! The linearised element with its stage strains eliminated: what the chain of elements is made of.

use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use super::collocation::Collocation;
use super::element::{ElementState, Linearisation, Variations};
use super::planar;
use super::stages::{solve_free_rows, solve_general, solve_rows};
use crate::lie::{Strain, TwistMap, Wrench, so3::hat};

/// Columns of everything that depends on the element's first node: δΛ_i, then 1, then ζ_i.
///
/// Without distributed loads nothing depends on ζ_i (a wrench does not see where its rod is), and the first seven columns are all.
const WRENCH: usize = 0;
const ONE: usize = 6;
const ZETA: usize = 7;
pub(super) const COLUMNS: usize = 13;

/// ζ_{i+1} and δΛ_{i+1} from ζ_i and δΛ_i.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transfer {
    pub(crate) zeta_from_zeta: Matrix6<f64>,
    pub(crate) zeta_from_wrench: Matrix6<f64>,
    pub(crate) wrench_from_zeta: Matrix6<f64>,
    pub(crate) wrench_from_wrench: Matrix6<f64>,
    pub(crate) zeta: Vector6<f64>,
    pub(crate) wrench: Vector6<f64>,
}

/// An element with its stage strains eliminated: its transfer, and δξ_k = X_k (δΛ_i, 1, ζ_i).
#[derive(Clone, Debug)]
pub(crate) struct Condensed<const S: usize> {
    pub(crate) transfer: Transfer,
    strain: [SMatrix<f64, 6, COLUMNS>; S],
    /// Whether the strains depend on ζ_i.
    loaded: bool,
}

impl<const S: usize> Condensed<S> {
    pub(crate) fn empty() -> Self {
        let (matrix, vector) = (Matrix6::zeros(), Vector6::zeros());
        let transfer = Transfer {
            zeta_from_zeta: matrix,
            zeta_from_wrench: matrix,
            wrench_from_zeta: matrix,
            wrench_from_wrench: matrix,
            zeta: vector,
            wrench: vector,
        };
        Self { transfer, strain: [SMatrix::zeros(); S], loaded: false }
    }

    /// Linearises and eliminates. `None` if the stage matrix is singular.
    pub(crate) fn fill(&mut self, table: &Collocation<S>, state: &ElementState<'_, S>) -> Option<()> {
        if state.load.is_none()
            && planar::holds(&state.constraint, &state.xi)
            && self.fill_in_plane(table, state).is_some()
        {
            return Some(());
        }
        let stiff = state.constraint.fixed()[3..] == [true; 3];
        let done = match (state.load, stiff) {
            (None, false) => self.eliminate::<LOADLESS, true>(table, state),
            (None, true) => self.eliminate::<LOADLESS, false>(table, state),
            (Some(_), false) => self.eliminate::<COLUMNS, true>(table, state),
            (Some(_), true) => self.eliminate::<COLUMNS, false>(table, state),
        };
        match done {
            Some(()) => Some(()),
            None => self.fill_general(table, state),
        }
    }

    /// By elimination of all strains at once, with pivoting: where the stiffness against shear and extension is not definite, or
    /// a load depends on where it acts.
    pub(crate) fn fill_general(&mut self, table: &Collocation<S>, state: &ElementState<'_, S>) -> Option<()> {
        let element = Linearisation::new(table, state);
        self.strain = solve_general(&element, &state.constraint.fixed())?;
        self.loaded = true;
        let t = &mut self.transfer;
        (t.zeta_from_zeta, t.zeta_from_wrench) = (element.end_adjoint, Matrix6::zeros());
        (t.wrench_from_zeta, t.wrench_from_wrench) = (element.wrench_from_zeta, element.wrench_from_wrench);
        (t.zeta, t.wrench) = (Vector6::zeros(), Vector6::zeros());
        for (k, x) in self.strain.iter().enumerate() {
            let (from_wrench, from_zeta) = (x.fixed_columns::<6>(WRENCH), x.fixed_columns::<6>(ZETA));
            let (b, l) = (&element.end_strain[k], &element.wrench_from_strain[k]);
            t.zeta_from_zeta += b * from_zeta;
            t.zeta_from_wrench += b * from_wrench;
            t.zeta += b * x.column(ONE);
            t.wrench_from_zeta += l * from_zeta;
            t.wrench_from_wrench += l * from_wrench;
            t.wrench += l * x.column(ONE);
        }
        Some(())
    }

    /// δξ at the stages from the solution at the element's first node.
    pub(crate) fn strain_step(&self, zeta: &Vector6<f64>, wrench: &Vector6<f64>) -> [Strain; S] {
        std::array::from_fn(|k| {
            let x = &self.strain[k];
            let mut step = x.fixed_columns::<6>(WRENCH) * wrench + x.column(ONE);
            if self.loaded {
                step += x.fixed_columns::<6>(ZETA) * zeta;
            }
            Strain::from_vector(&step)
        })
    }

    /// Strains of an element without distributed loads: δξ_k by the column `c` of four, and which component of δΛ_i that goes with; that
    /// which goes with none is the constant.
    #[inline(always)]
    pub(super) fn set_strains(&mut self, column: impl Fn(usize, usize) -> (Option<usize>, [f64; 6])) {
        self.loaded = false;
        for (k, strain) in self.strain.iter_mut().enumerate() {
            strain.fixed_columns_mut::<LOADLESS>(WRENCH).fill(0.0);
            for c in 0..4 {
                let (place, value) = column(k, c);
                strain.set_column(place.map_or(ONE, |place| WRENCH + place), &value.into());
            }
        }
    }

    /// δξ at the stages by a displacement and a change of wrench at the element's first node alone.
    pub(crate) fn strain_of_node(&self, zeta: &Vector6<f64>, wrench: &Vector6<f64>) -> [Strain; S] {
        let nothing = self.strain_step(&Vector6::zeros(), &Vector6::zeros());
        let all = self.strain_step(zeta, wrench);
        std::array::from_fn(|k| all[k] - nothing[k])
    }

    /// Shear and extension first, a 3×3 inverse at every stage, then bending and torsion of all stages together. `None` where that is not
    /// safe or not possible.
    ///
    /// A strain that is fixed has no compliance: K_νν⁻¹ has zeros there, and all of them where neither shear nor extension is free
    /// (`SOFT` is false).
    #[inline(always)]
    fn eliminate<const C: usize, const SOFT: bool>(
        &mut self,
        table: &Collocation<S>,
        state: &ElementState<'_, S>,
    ) -> Option<()> {
        let variations = Variations::new(table, &state.xi, state.h);
        let fixed = state.constraint.fixed();
        let mut flexibility = [Matrix3::zeros(); S];
        if SOFT {
            for k in 0..S {
                let k_nu = state.response[k].tangent.fixed_view::<3, 3>(3, 3).into();
                flexibility[k] =
                    if fixed[3..] == [false; 3] { inverse(&k_nu)? } else { inverse_of_free(k_nu, &fixed)? };
            }
        }
        let mut system = StageSystem::<S, C>::new::<SOFT>(state, &variations);
        let mut ends = Ends::<S>::default();
        if let Some(loads) = state.load {
            let from_zeta =
                LoadTerms::new(state, loads, &variations)?.add(table, state, &mut system, &mut ends);
            self.transfer.wrench_from_zeta = from_zeta;
        } else {
            self.transfer.wrench_from_zeta = Matrix6::zeros();
        }
        system.solve::<SOFT>(&flexibility, &fixed)?;
        for k in 0..S {
            self.strain[k].fixed_view_mut::<3, C>(0, 0).copy_from(&system.angular_rhs[k]);
            self.strain[k].fixed_view_mut::<3, C>(3, 0).copy_from(&system.linear_rhs[k]);
        }
        self.loaded = C == COLUMNS;
        self.transfer_from::<C, SOFT>(state, &variations.end, &ends, &system.angular_rhs, &system.linear_rhs);
        Some(())
    }

    /// ζ_{i+1} = Ad_e⁻¹ ζ_i + y_e, δΛ_{i+1} = L(Λ_{i+1}) y_e + Ad_eᵀ δΛ_i − loads.
    #[inline(always)]
    fn transfer_from<const C: usize, const SOFT: bool>(
        &mut self,
        state: &ElementState<'_, S>,
        end: &[TwistMap; S],
        loads: &Ends<S>,
        angular: &[SMatrix<f64, 3, C>; S],
        linear: &[SMatrix<f64, 3, C>; S],
    ) {
        let (mut w, mut v) = (SMatrix::<f64, 3, C>::zeros(), SMatrix::<f64, 3, C>::zeros());
        for l in 0..S {
            w += end[l].diagonal * angular[l];
            v += end[l].lower * angular[l];
            if SOFT {
                v += end[l].diagonal * linear[l];
            }
        }
        let Wrench { moment, force } = state.wrench_at_end;
        let mut m = cross(moment, &w) + cross(force, &v);
        let mut n = cross(force, &w);
        if C == COLUMNS {
            for l in 0..S {
                m -= loads.blocks[l][0] * angular[l] + loads.blocks[l][1] * linear[l];
                n -= loads.blocks[l][2] * angular[l];
            }
        }
        let t = &mut self.transfer;
        t.zeta_from_zeta = state.kinematics.end.adjoint_inverse().to_matrix();
        t.wrench_from_wrench = state.kinematics.end.adjoint().to_matrix().transpose();
        for c in 0..6 {
            for r in 0..3 {
                t.zeta_from_wrench[(r, c)] = w[(r, c)];
                t.zeta_from_wrench[(3 + r, c)] = v[(r, c)];
                t.wrench_from_wrench[(r, c)] += m[(r, c)];
                t.wrench_from_wrench[(3 + r, c)] += n[(r, c)];
                if C == COLUMNS {
                    t.zeta_from_zeta[(r, c)] += w[(r, ZETA + c)];
                    t.zeta_from_zeta[(3 + r, c)] += v[(r, ZETA + c)];
                    t.wrench_from_zeta[(r, c)] += m[(r, ZETA + c)];
                    t.wrench_from_zeta[(3 + r, c)] += n[(r, ZETA + c)];
                }
            }
        }
        for r in 0..3 {
            (t.zeta[r], t.zeta[3 + r]) = (w[(r, ONE)], v[(r, ONE)]);
            (t.wrench[r], t.wrench[3 + r]) = (m[(r, ONE)], n[(r, ONE)]);
        }
    }
}

/// Columns without ζ_i.
const LOADLESS: usize = 7;

/// v × every column.
#[inline(always)]
fn cross<const C: usize>(v: &Vector3<f64>, m: &SMatrix<f64, 3, C>) -> SMatrix<f64, 3, C> {
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
fn inverse(k: &Matrix3<f64>) -> Option<Matrix3<f64>> {
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
fn inverse_of_free(mut k: Matrix3<f64>, fixed: &[bool; 6]) -> Option<Matrix3<f64>> {
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
struct StageSystem<const S: usize, const C: usize> {
    angular_angular: [[Matrix3<f64>; S]; S],
    angular_linear: [[Matrix3<f64>; S]; S],
    linear_angular: [[Matrix3<f64>; S]; S],
    angular_rhs: [SMatrix<f64, 3, C>; S],
    linear_rhs: [SMatrix<f64, 3, C>; S],
}

impl<const S: usize, const C: usize> StageSystem<S, C> {
    /// K_k δξ_k − L(Λ_k) Σ_l B_kl δξ_l = −r_k + Ad_kᵀ δΛ_i.
    #[inline(always)]
    fn new<const SOFT: bool>(state: &ElementState<'_, S>, variations: &Variations<S>) -> Self {
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
    fn solve<const SOFT: bool>(&mut self, flexibility: &[Matrix3<f64>; S], fixed: &[bool; 6]) -> Option<()> {
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

/// What the loads add to δΛ_{i+1}: minus blocks (angular–angular, angular–linear, linear–angular) times (δω_l, δν_l).
struct Ends<const S: usize> {
    blocks: [[Matrix3<f64>; 3]; S],
}

impl<const S: usize> Default for Ends<S> {
    fn default() -> Self {
        Self { blocks: [[Matrix3::zeros(); 3]; S] }
    }
}

/// δF_l = Σ_m g_lm δξ_m + e_l ζ_i: the loads of the stages brought to node i.
struct LoadTerms<const S: usize> {
    /// G_l B_lm, blocks as in [`Ends`].
    g: [[[Matrix3<f64>; 3]; S]; S],
    e: [Matrix6<f64>; S],
}

impl<const S: usize> LoadTerms<S> {
    /// G_l = Ad_l⁻ᵀ(D_l − L(f̄_l)), e_l = Ad_l⁻ᵀ D_l Ad_l⁻¹; `None` for a load whose force depends on where it acts.
    fn new(
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
                terms.g[l][m] =
                    [g11 * map.diagonal + g12 * map.lower, g12 * map.diagonal, g21 * map.diagonal];
            }
            let inverse = pose.adjoint_inverse().to_matrix();
            terms.e[l] = inverse.transpose() * load.tangent * inverse;
        }
        Some(terms)
    }

    /// Adds Ad_kᵀ h Σ a_kl δF_l to the stages, and returns what of −Ad_eᵀ h Σ b_l δF_l belongs to ζ_i.
    fn add<const C: usize>(
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
                let [aa, al, la] = self.brought(&weights, m, &pose.rotation, &pose.position);
                system.angular_angular[k][m] += aa;
                system.angular_linear[k][m] += al;
                system.linear_angular[k][m] += la;
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
            ends.blocks[m] = self.brought(&weights, m, &pose.rotation, &pose.position);
        }
        -(pose.adjoint().to_matrix().transpose() * self.weighted(&weights))
    }

    /// Ad_gᵀ Σ_l weight_l g_lm.
    fn brought(&self, weights: &[f64; S], m: usize, r: &Matrix3<f64>, p: &Vector3<f64>) -> [Matrix3<f64>; 3] {
        let mut sum = [Matrix3::zeros(); 3];
        for l in 0..S {
            for b in 0..3 {
                sum[b] += self.g[l][m][b] * weights[l];
            }
        }
        // Ad_gᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]
        [r.tr_mul(&(sum[0] - cross(p, &sum[2]))), r.tr_mul(&sum[1]), r.tr_mul(&sum[2])]
    }

    fn weighted(&self, weights: &[f64; S]) -> Matrix6<f64> {
        self.e.iter().zip(weights).fold(Matrix6::zeros(), |sum, (e, w)| sum + e * *w)
    }
}
