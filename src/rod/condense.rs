//! The linearised element with its stage strains eliminated: what the chain of elements is made of.

use nalgebra::{Matrix3, Matrix6, SMatrix, Vector6};

use super::collocation::Collocation;
use super::element::{ElementState, Linearisation, Variations};
use super::lanes::Eliminated;
use super::load_terms::{Ends, LoadTerms};
use super::planar;
use super::stage_system::{StageSystem, cross, inverse, inverse_of_free};
use super::stages::solve_general;
use crate::lie::{Pose, Strain, TwistMap, Wrench};

/// Columns of everything that depends on the element's first node: δΛ_i, then 1, then ζ_i.
///
/// Without distributed loads nothing depends on ζ_i (a wrench does not see where its rod is), and the first seven columns are all.
pub(super) const WRENCH: usize = 0;
pub(super) const ONE: usize = 6;
pub(super) const ZETA: usize = 7;
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
        if planar::holds(&state.constraint, &state.xi) {
            let done = match state.load {
                None => self.fill_in_plane(table, state),
                Some(loads) if loads.iter().all(planar::acts_in_plane) => {
                    self.fill_loaded_in_plane(table, state, loads)
                }
                Some(_) => None,
            };
            if done.is_some() {
                return Some(());
            }
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

    /// Takes over what a lane has eliminated. `None` if it cannot be trusted.
    pub(crate) fn take(&mut self, from: &Eliminated, lane: usize, end: &Pose) -> Option<()> {
        if !from.is_sound(lane) {
            return None;
        }
        for (k, strain) in self.strain.iter_mut().enumerate() {
            from.strain(lane, k, &mut strain.as_mut_slice()[..6 * LOADLESS]);
        }
        self.loaded = false;
        let t = &mut self.transfer;
        t.zeta_from_zeta = end.adjoint_inverse().to_matrix();
        // Ad_eᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]: Ad_e⁻¹ with its blocks the other way
        t.wrench_from_zeta = Matrix6::zeros();
        for c in 0..6 {
            let column = from.end(lane, c);
            for r in 0..6 {
                t.zeta_from_wrench[(r, c)] = column[r];
                let adjoint = t.zeta_from_zeta[((r + 3) % 6, (c + 3) % 6)];
                t.wrench_from_wrench[(r, c)] = column[6 + r] + adjoint;
            }
        }
        let column = from.end(lane, ONE);
        for r in 0..6 {
            (t.zeta[r], t.wrench[r]) = (column[r], column[6 + r]);
        }
        Some(())
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

    /// Takes the strains by their columns: `of(k, c)` is the c-th of N of stage k, and where it goes; the others are zero.
    #[inline(always)]
    pub(super) fn set_strains<const N: usize>(
        &mut self,
        loaded: bool,
        of: impl Fn(usize, usize) -> (usize, [f64; 6]),
    ) {
        self.loaded = loaded;
        for (k, strain) in self.strain.iter_mut().enumerate() {
            if loaded {
                strain.fill(0.0);
            } else {
                strain.fixed_columns_mut::<LOADLESS>(WRENCH).fill(0.0);
            }
            for c in 0..N {
                let (column, value) = of(k, c);
                strain.set_column(column, &value.into());
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
            let from_zeta = LoadTerms::new::<SOFT>(state, loads, &variations)?.add::<C, SOFT>(
                table,
                state,
                &mut system,
                &mut ends,
            );
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
                m -= loads.blocks[l][0] * angular[l];
                if SOFT {
                    m -= loads.blocks[l][1] * linear[l];
                }
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
