//! The linearised rod: factored from the tip to the base, closed by what its supports say, and solved for a Newton step.

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

use super::border::{Column, put};
use super::core::Core;
use super::relation::Relation;
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist, Wrench};
use crate::rod::support::Equations;

/// How large a Newton step is, and where it is largest.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepSize {
    pub(super) size: f64,
    pub(super) rotation: f64,
    pub(super) s: f64,
}

impl<const S: usize> Core<S> {
    /// The mounts whose supports react, along the rod.
    fn reacting(&self) -> impl Iterator<Item = usize> {
        (0..self.mounts.len()).filter(|&m| self.mounts[m].reacts())
    }

    /// How many unknowns there are besides the strains.
    fn further(&self) -> usize {
        6 * (usize::from(self.loose) + self.reacting().count())
    }

    /// Linearises about the state that was balanced, and factors.
    pub(super) fn factor(&mut self) -> Result<()> {
        let relation = self.problem.relation;
        let mut response = self.mounts[self.mounts.len() - 1].force_tangent(&relation);
        for i in (0..self.grid.elements).rev() {
            let element = self.element(i, &response);
            response = self.factors[i]
                .factor(&element, &self.grid.fixed)
                .ok_or_else(|| Error::Singular { matrix: "tangent of an element", s: self.grid.node_s(i) })?;
            if let Some(mount) = self.between(i) {
                if let Some((_, inverse)) = &mount.corner {
                    let inverse = inverse.to_matrix();
                    response = inverse.transpose() * response * inverse;
                }
                response += mount.force_tangent(&relation);
            }
        }
        if self.further() == 0 {
            return Ok(());
        }
        let nodes = self.reacting().flat_map(|m| [self.mounts[m].node; 6]);
        self.border.columns = nodes.enumerate().map(|(j, node)| self.column(node, j % 6)).collect();
        let matrix = self.border_matrix(&response);
        self.border.factor(matrix, relation == Relation::Static)
    }

    /// The answer to a unit of one component of the wrench on a node.
    fn column(&self, node: usize, component: usize) -> Column<S> {
        let mut unit = [0.0; 6];
        unit[component] = 1.0;
        let mut answer = Wrench::from_array(unit);
        let mut strain = vec![[Strain::zero(); S]; node];
        let none = [Wrench::zero(); S];
        for i in (0..node).rev() {
            (strain[i], answer) = self.factors[i].back(&none, &answer);
            if let Some(mount) = self.between(i) {
                answer = mount.turned_back(&answer);
            }
        }
        Column { strain, at_base: answer }
    }

    /// What each support says of each unknown: those of the base first, then those of the supports that react.
    fn border_matrix(&self, response: &Matrix6<f64>) -> DMatrix<f64> {
        let (n, first) = (self.further(), if self.loose { 6 } else { 0 });
        let mut matrix = DMatrix::zeros(n, n);
        let rows: Vec<(usize, Equations)> = self.reacting().map(|m| (m, self.equations(m))).collect();
        let mut displaced = vec![Vector6::zeros(); self.mounts.len()];
        for c in 0..n {
            let mut zeta = Vector6::zeros();
            let mut strain = vec![[Strain::zero(); S]; self.grid.elements];
            if c < first {
                zeta[c] = 1.0;
            } else {
                let column = &self.border.columns[c - first].strain;
                strain[..column.len()].copy_from_slice(column);
            }
            self.displace(&zeta, &mut strain, |_, m, zeta, _| {
                if let Some(m) = m {
                    displaced[m] = *zeta;
                }
            });
            for (j, (m, rows)) in rows.iter().enumerate() {
                let entry = rows.from_zeta * displaced[*m];
                matrix.fixed_view_mut::<6, 1>(first + 6 * j, c).copy_from(&entry);
            }
        }
        for (j, (_, rows)) in rows.iter().enumerate() {
            let mut block = matrix.fixed_view_mut::<6, 6>(first + 6 * j, first + 6 * j);
            block += rows.from_wrench;
        }
        if self.loose {
            let base = self.equations(0);
            let answers = response + self.mounts[0].force_tangent(&self.problem.relation);
            put(&mut matrix, 0, 0, &(base.from_zeta - base.from_wrench * answers));
            for (c, column) in self.border.columns.iter().enumerate() {
                let entry = -(base.from_wrench * column.at_base.to_vector());
                matrix.fixed_view_mut::<6, 1>(0, first + c).copy_from(&entry);
            }
        }
        matrix
    }

    /// What the support of a mount applies: at the base, what the balance asks of it.
    pub(super) fn reaction(&self, m: usize) -> Wrench {
        let relation = self.problem.relation;
        let mount = &self.mounts[m];
        if relation == Relation::Impulse {
            // of which there is none yet; the body on the base counts with what is missing of its velocity
            return if m == 0 { -self.node_wrench[0] - self.base_impulse } else { Wrench::zero() };
        }
        let moving = relation != Relation::Static;
        if m == 0 { -self.node_wrench[0] - mount.force(moving) } else { mount.reaction }
    }

    /// What the support of a mount says about the state that was balanced.
    pub(super) fn equations(&self, m: usize) -> Equations {
        let mount = &self.mounts[m];
        mount.equations(&self.node_pose[mount.node], &self.reaction(m), &self.problem.relation)
    }

    /// Displacements of the nodes, base to tip, from that of the base and strains for a base that stays, which become the whole ones.
    fn displace(
        &self,
        base: &Vector6<f64>,
        strain: &mut [[Strain; S]],
        mut each: impl FnMut(usize, Option<usize>, &Vector6<f64>, Option<&[Strain; S]>),
    ) {
        let mut zeta = *base;
        for i in 0..=self.grid.elements {
            let at_node = zeta;
            if i < self.grid.elements {
                if let Some(mount) = self.between(i)
                    && mount.corner.is_some()
                {
                    zeta = mount.turned_on(&Twist::from_vector(&zeta)).to_vector();
                }
                zeta = self.factors[i].forth(&zeta, &mut strain[i]);
            }
            each(i, self.mount_at[i], &at_node, strain.get(i));
        }
    }

    /// The unknowns besides the strains, from the equations of the supports.
    fn close(&mut self, answer: &Wrench) -> Result<()> {
        let (n, first) = (self.further(), if self.loose { 6 } else { 0 });
        let mut rhs = DVector::zeros(n);
        if self.loose {
            let rows = self.equations(0);
            rhs.fixed_rows_mut::<6>(0).copy_from(&(rows.from_wrench * answer.to_vector() - rows.residual));
        }
        let reacting: Vec<usize> = self.reacting().collect();
        if !reacting.is_empty() {
            let mut strain = self.step.clone();
            let mut displaced = vec![Vector6::zeros(); self.mounts.len()];
            self.displace(&Vector6::zeros(), &mut strain, |_, m, zeta, _| {
                if let Some(m) = m {
                    displaced[m] = *zeta;
                }
            });
            for (j, &m) in reacting.iter().enumerate() {
                let rows = self.equations(m);
                let row = -(rows.residual + rows.from_zeta * displaced[m]);
                rhs.fixed_rows_mut::<6>(first + 6 * j).copy_from(&row);
            }
        }
        let found =
            self.border.solve(&rhs).ok_or(Error::Singular { matrix: "tangent of the supports", s: 0.0 })?;
        if self.loose {
            self.base_step = found.fixed_rows::<6>(0).into();
        }
        for (j, &m) in reacting.iter().enumerate() {
            let reaction: Vector6<f64> = found.fixed_rows::<6>(first + 6 * j).into();
            self.reaction_step[m] = Wrench::from_vector(&reaction);
        }
        for (column, &factor) in self.border.columns.iter().zip(found.iter().skip(first)) {
            for (step, strain) in self.step.iter_mut().zip(&column.strain) {
                for k in 0..S {
                    step[k] += strain[k] * factor;
                }
            }
        }
        Ok(())
    }

    /// The Newton step for the present residual, by the factors at hand.
    #[inline(always)]
    pub(super) fn newton_step(&mut self) -> Result<StepSize> {
        let mut answer = Wrench::zero();
        for i in (0..self.grid.elements).rev() {
            (self.step[i], answer) = self.factors[i].back(&self.residual[i], &answer);
            if let Some(mount) = self.between(i) {
                answer = mount.turned_back(&answer);
            }
        }
        self.base_step = Vector6::zeros();
        if self.further() > 0 {
            self.close(&answer)?;
        }
        let length = self.grid.length;
        let mut step = std::mem::take(&mut self.step);
        let mut found = StepSize { size: 0.0, rotation: 0.0, s: 0.0 };
        self.displace(&self.base_step, &mut step, |i, _, zeta, strains| {
            let rotation = zeta.fixed_rows::<3>(0).norm();
            let mut size = rotation.max(zeta.fixed_rows::<3>(3).norm() / length);
            found.rotation = found.rotation.max(rotation);
            for strain in strains.into_iter().flatten() {
                size = size.max(strain.linear.norm()).max(strain.angular.norm() * length);
            }
            // not max, which would drop a NaN
            if !(size <= found.size) {
                (found.size, found.s) = (size, self.grid.node_s(i));
            }
        });
        self.step = step;
        if found.size.is_finite() {
            return Ok(found);
        }
        Err(Error::Singular { matrix: "tangent of the rod", s: found.s })
    }

    /// The factors as numbers.
    pub(super) fn save_factors(&self) -> Vec<f64> {
        let mut numbers = Vec::new();
        self.factors.iter().for_each(|element| element.save(&mut numbers));
        self.border.save(&mut numbers);
        numbers
    }

    /// The opposite of [`save_factors`](Self::save_factors).
    pub(super) fn restore_factors(&mut self, numbers: &[f64]) -> Option<()> {
        let mut numbers = numbers.iter().copied();
        let fixed = self.grid.fixed;
        self.factors.iter_mut().try_for_each(|element| element.restore(&fixed, &mut numbers))?;
        let size = self.further();
        if size == 0 {
            return Some(());
        }
        let nodes: Vec<usize> = self.reacting().map(|m| self.mounts[m].node).collect();
        self.border.restore(size, nodes.into_iter(), &mut numbers)
    }
}
