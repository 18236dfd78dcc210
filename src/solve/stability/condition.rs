use nalgebra::{Matrix6, Vector6};

use super::plane::Plane;
use crate::lie::Wrench;
use crate::rod::element::frame_change;
use crate::rod::support::{Condition as Held, Equations, Support};
use crate::solve::scale::Scale;

/// What holds a section of the rod against small displacements, in its own frame and in units of the rod.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Condition {
    /// Orthonormal directions, as columns; those marked in `fixed` cannot move.
    pub(super) directions: Matrix6<f64>,
    pub(super) fixed: [bool; 6],
    /// ½ ζᵀ K ζ is the energy of springs and loads on the section, where it can move.
    pub(super) stiffness: Matrix6<f64>,
}

impl Condition {
    /// A support and the loads on its section, linearised where they apply the wrench `applied` to the section.
    ///
    /// With t_j = ∂ζ/∂χ_j, what can move is spanned by the t_j of the freedoms not held, and t_jᵀ μ = −(A_j + ½ t_jᵀ L) ζ, A_j the row of the
    /// support's equations. `None` where its coordinates are singular.
    pub(crate) fn of(
        support: &Support,
        equations: &Equations,
        applied: &Wrench,
        scale: &Scale,
    ) -> Option<Self> {
        let (zeta, momentum) = (scale.displacement(), scale.wrench());
        let half = frame_change(applied) * 0.5;
        let rows = &equations.from_wrench;
        let slope = equations.from_zeta + rows * half;
        let free = |j: usize| !matches!(support.conditions()[j], Held::Fixed(_));
        let mut directions = Matrix6::zeros();
        let mut fixed = [true; 6];
        // in units of the rod a row of ∂ζ/∂χ is a displacement divided by its unit
        let unit = |r: usize| if r < 3 { 1.0 } else { scale.length };
        let mut basis = Matrix6::zeros();
        for j in (0..6).filter(|&j| free(j)) {
            basis.set_column(j, &Vector6::from_fn(|r, _| rows[(j, r)] * unit(j) / zeta[r]));
        }
        let triangle = orthonormalise(&mut basis, &mut directions, &mut fixed)?;
        // (R⁻ᵀ K̂ R⁻¹) with K̂_jl = slope_j t_l
        let work = scale.force * scale.length;
        let energy = Matrix6::from_fn(|j, l| {
            if !(free(j) && free(l)) {
                return 0.0;
            }
            let along = |r: usize| slope[(j, r)] * unit(j) * rows[(l, r)] * unit(l);
            (0..6).map(along).sum::<f64>() / work
        });
        let inverse = triangle.try_inverse()?;
        let in_basis = inverse.transpose() * energy * inverse;
        let stiffness = directions * in_basis * directions.transpose();
        debug_assert!(momentum.iter().all(|unit| *unit > 0.0));
        stiffness.iter().all(|v| v.is_finite()).then_some(Self { directions, fixed, stiffness })
    }

    /// The part before the first node: μ = K ζ for what can move, ζ = 0 for what cannot.
    pub(super) fn plane(&self) -> Plane {
        let (mut zeta, mut momentum) = (Matrix6::zeros(), Matrix6::zeros());
        let stiffness = 0.5 * (self.stiffness + self.stiffness.transpose());
        for (c, &fixed) in self.fixed.iter().enumerate() {
            let direction = self.directions.column(c);
            if fixed {
                momentum.set_column(c, &direction);
            } else {
                zeta.set_column(c, &direction);
                momentum.set_column(c, &(stiffness * direction));
            }
        }
        Plane { zeta, momentum }.orthonormal().0
    }
}

/// Makes the nonzero columns of `basis` orthonormal, completes them, and returns R (the identity for the others), with old = new R.
fn orthonormalise(
    basis: &mut Matrix6<f64>,
    directions: &mut Matrix6<f64>,
    fixed: &mut [bool; 6],
) -> Option<Matrix6<f64>> {
    let mut triangle = Matrix6::identity();
    let mut done: Vec<usize> = Vec::with_capacity(6);
    let take = |column: Vector6<f64>, done: &[usize], directions: &Matrix6<f64>| {
        let (mut column, mut along) = (column, Vector6::zeros());
        for _ in 0..2 {
            for &d in done {
                let part = directions.column(d).dot(&column);
                along[d] += part;
                column -= directions.column(d) * part;
            }
        }
        (column, along)
    };
    for j in 0..6 {
        let size = basis.column(j).norm();
        if size == 0.0 {
            continue;
        }
        let (column, along) = take(basis.column(j).into(), &done, directions);
        let norm = column.norm();
        if !(norm > 1e-12 * size) {
            return None;
        }
        triangle.set_column(j, &along);
        triangle[(j, j)] = norm;
        directions.set_column(j, &(column / norm));
        fixed[j] = false;
        done.push(j);
    }
    for j in (0..6).filter(|j| !done.contains(j)).collect::<Vec<_>>() {
        // the unit vector that is farthest from what there is
        let far = (0..6)
            .map(|k| take(Vector6::ith(k, 1.0), &done, directions).0)
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        directions.set_column(j, &far.normalize());
        done.push(j);
    }
    Some(triangle)
}
