//! The residual of a rod on a mesh, and its linearisation, for a given set of stage strains.

use nalgebra::{Matrix6, SMatrix, SVector};

use super::chain::{EndRows, Transfer};
use super::mesh::{Mesh, StageStrains};
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::{Pose, Strain, Twist, Wrench};
use crate::load::LoadWrench;
use crate::material::{Request, Response};
use crate::rod::element::{ElementState, Kinematics, Linearisation};

/// Everything that follows from the stage strains.
pub(crate) struct Configuration<const S: usize> {
    pub(crate) node_pose: Vec<Pose>,
    pub(crate) node_wrench: Vec<Wrench>,
    pub(crate) stage_wrench: Vec<[Wrench; S]>,
    pub(crate) response: Vec<[Response; S]>,
    pub(crate) kinematics: Vec<Kinematics<f64, S>>,
    loads: Option<Vec<[LoadWrench; S]>>,
    tip_load: LoadWrench,
}

impl<B: Elastic, const S: usize> Mesh<'_, B, S> {
    /// Poses forward, section responses, loads, and wrenches backward.
    pub(crate) fn configure(&self, strains: &StageStrains<S>) -> Result<Configuration<S>> {
        let (n, body) = (self.elements(), self.rod.body());
        let mut node_pose = Vec::with_capacity(n + 1);
        let mut kinematics = Vec::with_capacity(n);
        let mut response = Vec::with_capacity(n);
        let mut pose = *self.rod.base();
        node_pose.push(pose);
        for (i, element) in strains.iter().enumerate() {
            let mut stage_response = [Response::zero(); S];
            for k in 0..S {
                stage_response[k] = body.respond(self.stage_s(i, k), &element[k], Request::Tangent)?;
            }
            response.push(stage_response);
            let motion = Kinematics::new(&self.table, &self.twists(i, element), self.h(i));
            pose = pose * motion.end;
            node_pose.push(pose);
            kinematics.push(motion);
        }
        let loads = self.stage_loads(&node_pose, &kinematics)?;
        let tip_load = self.tip_load(&pose)?;

        let mut node_wrench = vec![tip_load.wrench; n + 1];
        let mut stage_wrench = vec![[Wrench::zero(); S]; n];
        for i in (0..n).rev() {
            let (motion, h) = (&kinematics[i], self.h(i));
            let node_loads = match &loads {
                Some(loads) => motion.at_node(&loads[i].map(|l| l.wrench)),
                None => [Wrench::zero(); S],
            };
            node_wrench[i] = motion.wrench_at_start(&self.table, &node_wrench[i + 1], &node_loads, h);
            stage_wrench[i] = motion.stage_wrenches(&self.table, &node_wrench[i], &node_loads, h);
        }
        Ok(Configuration { node_pose, node_wrench, stage_wrench, response, kinematics, loads, tip_load })
    }

    fn stage_loads(
        &self,
        node_pose: &[Pose],
        kinematics: &[Kinematics<f64, S>],
    ) -> Result<Option<Vec<[LoadWrench; S]>>> {
        if self.rod.loads().is_empty() {
            return Ok(None);
        }
        let mut loads = Vec::with_capacity(self.elements());
        for (i, motion) in kinematics.iter().enumerate() {
            let mut stage = [no_load(); S];
            for k in 0..S {
                let (s, pose) = (self.stage_s(i, k), node_pose[i] * motion.stage[k]);
                for load in self.rod.loads() {
                    add_load(&mut stage[k], load.at(self.rod.body(), s, &pose)?);
                }
                check_load(&stage[k], "distributed load", s)?;
            }
            loads.push(stage);
        }
        Ok(Some(loads))
    }

    fn tip_load(&self, pose: &Pose) -> Result<LoadWrench> {
        let mut total = no_load();
        for load in self.rod.tip_loads() {
            add_load(&mut total, load.at(pose)?);
        }
        check_load(&total, "tip load", self.rod.body().length())?;
        Ok(total)
    }

    /// The linearised elements about a configuration.
    pub(crate) fn linearise(
        &self,
        strains: &StageStrains<S>,
        state: &Configuration<S>,
    ) -> Vec<Linearisation<S>> {
        (0..self.elements())
            .map(|i| {
                let load = state.loads.as_ref().map(|loads| loads[i].map(|l| (l.wrench, l.tangent)));
                let element = ElementState {
                    h: self.h(i),
                    xi: self.twists(i, &strains[i]),
                    kinematics: state.kinematics[i],
                    tangent: state.response[i].map(|r| r.tangent),
                    stage_wrench: state.stage_wrench[i],
                    residual: state.residual(i),
                    wrench_at_end: state.node_wrench[i + 1],
                    load,
                };
                Linearisation::new(&self.table, &element)
            })
            .collect()
    }

    /// Strain energy Σ h b U and the potential of the loads, `None` where one has none.
    pub(crate) fn energies(&self, state: &Configuration<S>) -> (f64, Option<f64>) {
        let weights = |i: usize| self.table.b.map(|b| self.h(i) * b);
        let mut elastic = 0.0;
        for (i, stage) in state.response.iter().enumerate() {
            elastic += weights(i).iter().zip(stage).map(|(w, r)| w * r.energy).sum::<f64>();
        }
        let mut potential = state.tip_load.potential;
        for (i, stage) in state.loads.iter().flatten().enumerate() {
            let weights = weights(i);
            for k in 0..S {
                potential = potential.zip(stage[k].potential).map(|(sum, p)| sum + weights[k] * p);
            }
        }
        (elastic, potential)
    }
}

fn no_load() -> LoadWrench {
    LoadWrench { wrench: Wrench::zero(), tangent: Matrix6::zeros(), potential: Some(0.0) }
}

fn add_load(total: &mut LoadWrench, load: LoadWrench) {
    total.wrench += load.wrench;
    total.tangent += load.tangent;
    total.potential = total.potential.zip(load.potential).map(|(a, b)| a + b);
}

fn check_load(load: &LoadWrench, quantity: &'static str, s: f64) -> Result<()> {
    let size = load.wrench.to_vector().norm() + load.tangent.norm();
    if size.is_finite() {
        return Ok(());
    }
    Err(Error::InvalidAt { quantity, value: size, requirement: "finite", s })
}

impl<const S: usize> Configuration<S> {
    /// r_k = Ψ(Δξ_k) − Λ_k of element i.
    pub(crate) fn residual(&self, i: usize) -> [Wrench; S] {
        std::array::from_fn(|k| self.response[i][k].wrench - self.stage_wrench[i][k])
    }

    /// The six equations at the tip: δΛ_N = D ζ_N.
    pub(crate) fn tip_rows(&self, scale: &Scale) -> EndRows {
        let mut matrix = SMatrix::<f64, 6, 12>::zeros();
        let d = scale.wrench_of_displacement(&self.tip_load.tangent);
        matrix.fixed_view_mut::<6, 6>(0, 0).copy_from(&-d);
        matrix.fixed_view_mut::<6, 6>(0, 6).fill_with_identity();
        EndRows { matrix, rhs: SVector::zeros() }
    }
}

/// Units that make the chain's unknowns comparable: a length for displacements, a force for wrenches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    pub(crate) length: f64,
    pub(crate) force: f64,
}

impl Scale {
    fn displacement(&self) -> [f64; 6] {
        [1.0, 1.0, 1.0, self.length, self.length, self.length]
    }

    fn wrench(&self) -> [f64; 6] {
        let moment = self.force * self.length;
        [moment, moment, moment, self.force, self.force, self.force]
    }

    fn rescale(matrix: &Matrix6<f64>, rows: [f64; 6], columns: [f64; 6]) -> Matrix6<f64> {
        Matrix6::from_fn(|r, c| matrix[(r, c)] * columns[c] / rows[r])
    }

    fn wrench_of_displacement(&self, m: &Matrix6<f64>) -> Matrix6<f64> {
        Self::rescale(m, self.wrench(), self.displacement())
    }

    /// The size of a wrench in these units.
    pub(crate) fn wrench_size(&self, wrench: &Wrench) -> f64 {
        let unit = self.wrench();
        wrench.to_array().iter().zip(unit).fold(0.0, |size, (w, u)| f64::max(size, (w / u).abs()))
    }

    /// The physical displacement and wrench of a node's scaled unknowns.
    pub(crate) fn unscale(&self, y: &SVector<f64, 12>) -> (Twist, Wrench) {
        let (d, w) = (self.displacement(), self.wrench());
        (
            Twist::from_array(std::array::from_fn(|i| y[i] * d[i])),
            Wrench::from_array(std::array::from_fn(|i| y[6 + i] * w[i])),
        )
    }

    /// The transfer of an element in scaled unknowns, from the one in physical units.
    fn transfer(&self, t: &[[Matrix6<f64>; 2]; 2], c: &[SVector<f64, 6>; 2]) -> Transfer {
        let units = [self.displacement(), self.wrench()];
        let mut transfer = Transfer { matrix: SMatrix::zeros(), rhs: SVector::zeros() };
        for i in 0..2 {
            for j in 0..2 {
                let block = Self::rescale(&t[i][j], units[i], units[j]);
                transfer.matrix.fixed_view_mut::<6, 6>(6 * i, 6 * j).copy_from(&block);
            }
            for r in 0..6 {
                transfer.rhs[6 * i + r] = c[i][r] / units[i][r];
            }
        }
        transfer
    }
}

/// An element with its stage strains eliminated: δξ_k = X_k (ζ_i, δΛ_i, 1).
pub(crate) struct Condensed<const S: usize> {
    pub(crate) transfer: Transfer,
    strain: [SMatrix<f64, 6, 13>; S],
}

impl<const S: usize> Condensed<S> {
    /// Eliminates the stage strains of a linearised element. `None` if its stage matrix is singular.
    pub(crate) fn new(element: &Linearisation<S>, scale: &Scale) -> Option<Self> {
        let strain = solve_stages(element)?;
        let part = |k: usize, column: usize| strain[k].fixed_view::<6, 6>(0, column).into_owned();
        let mut t =
            [[element.end_adjoint, Matrix6::zeros()], [element.wrench_from_zeta, element.wrench_from_wrench]];
        let mut c = [SVector::<f64, 6>::zeros(); 2];
        for k in 0..S {
            let blocks = [element.end_strain[k], element.wrench_from_strain[k]];
            for i in 0..2 {
                t[i][0] += blocks[i] * part(k, 0);
                t[i][1] += blocks[i] * part(k, 6);
                c[i] += blocks[i] * strain[k].column(12);
            }
        }
        Some(Self { transfer: scale.transfer(&t, &c), strain })
    }

    /// δξ at the stages from the solution at the element's first node.
    pub(crate) fn strain_step(&self, zeta: &Twist, wrench: &Wrench) -> [Strain; S] {
        let (zeta, wrench) = (zeta.to_vector(), wrench.to_vector());
        std::array::from_fn(|k| {
            let x = &self.strain[k];
            let step = x.fixed_view::<6, 6>(0, 0) * zeta + x.fixed_view::<6, 6>(0, 6) * wrench + x.column(12);
            Strain::from_vector(&step)
        })
    }
}

/// Solves A X = (P_ζ, P_Λ, −r) by Gaussian elimination with row pivoting, rows scaled by their largest entry.
fn solve_stages<const S: usize>(element: &Linearisation<S>) -> Option<[SMatrix<f64, 6, 13>; S]> {
    const MAX: usize = 18;
    const WIDTH: usize = MAX + 13;
    let n = 6 * S;
    let mut rows = [[0.0_f64; WIDTH]; MAX];
    for k in 0..S {
        for r in 0..6 {
            let row = &mut rows[6 * k + r];
            for m in 0..S {
                for c in 0..6 {
                    row[6 * m + c] = element.stage[k][m][(r, c)];
                }
            }
            for c in 0..6 {
                row[n + c] = element.from_zeta[k][(r, c)];
                row[n + 6 + c] = element.from_wrench[k][(r, c)];
            }
            row[n + 12] = -element.residual[k].to_array()[r];
            let size = row[..n].iter().fold(0.0_f64, |size, v| size.max(v.abs()));
            row.iter_mut().for_each(|v| *v /= size);
        }
    }
    let width = n + 13;
    for column in 0..n {
        let pivot = (column..n).max_by(|&p, &q| rows[p][column].abs().total_cmp(&rows[q][column].abs()))?;
        if !(rows[pivot][column].abs() > f64::MIN_POSITIVE && rows[pivot][column].is_finite()) {
            return None;
        }
        rows.swap(column, pivot);
        let (done, rest) = rows.split_at_mut(column + 1);
        let pivot_row = &done[column];
        for row in &mut rest[..n - column - 1] {
            let factor = row[column] / pivot_row[column];
            for c in column..width {
                row[c] -= factor * pivot_row[c];
            }
        }
    }
    for column in (0..n).rev() {
        let (above, rest) = rows.split_at_mut(column);
        let row = &mut rest[0];
        let inverse = 1.0 / row[column];
        row[n..width].iter_mut().for_each(|v| *v *= inverse);
        for other in above {
            let factor = other[column];
            for c in n..width {
                other[c] -= factor * row[c];
            }
        }
    }
    Some(std::array::from_fn(|k| SMatrix::from_fn(|r, c| rows[6 * k + r][n + c])))
}

#[cfg(test)]
mod tests;
