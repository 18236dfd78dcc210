use nalgebra::{Cholesky, DMatrix, DVector, Matrix6, RowVector6, SymmetricEigen, Vector6};

use super::begin::{balance, set_strains};
use super::core::Core;
use super::engine::on_mesh;
use super::failure::{Failure, Reason};
use super::mount::Mount;
use super::options::Dynamics;
use super::relation::Relation;
use super::scene::{Movable, Scene};
use super::state::Start;
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist, Wrench};
use crate::material::Request;
use crate::rod::adjoint::AdjointElement;
use crate::rod::support::Condition;
use crate::solve::Order;

/// A small vibration about an equilibrium: every section moves with ζ(s) cos ωt, small and in its own frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// ω², 1/s²; negative where the equilibrium is unstable, and zero but for rounding for a rigid motion of a free rod.
    pub omega_squared: f64,
    /// The displacements of the nodes, base to tip, which are those of a [`Frame`](super::Frame).
    pub nodes: Vec<Twist>,
    /// Displacements and strains at the Gauss stages, base to tip.
    pub stages: Vec<ModeStage>,
}

/// A mode at a Gauss stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeStage {
    /// Arc length s, m.
    pub s: f64,
    /// The weight of this stage in an integral over the rod, m.
    pub weight: f64,
    /// The small displacement ζ of the section, body frame.
    pub displacement: Twist,
    /// The change of its strain.
    pub strain: Strain,
}

impl Mode {
    /// The angular frequency ω, rad/s; NaN for an unstable one.
    pub fn angular_frequency(&self) -> f64 {
        self.omega_squared.sqrt()
    }

    /// The frequency ω/2π, Hz.
    pub fn frequency(&self) -> f64 {
        self.angular_frequency() / std::f64::consts::TAU
    }
}

impl Dynamics {
    /// The slowest modes about the static equilibrium nearest to a start, undamped, slowest first, each with ∫ζᵀ M ζ ds = 1 (and the
    /// like of rigid bodies with it), under what the supports and fixed strains allow.
    ///
    /// ```math
    /// K\,\delta\xi = \omega^2 M\,\delta\xi
    /// ```
    ///
    /// in the strains of the mesh, whose K and M are the tangents of a step. Under a load that has no potential K is not symmetric; its
    /// symmetric part is taken. The work grows with the cube of the number of strains: some ten elements are plenty.
    ///
    /// ```
    /// use hyperrod::material::LinearElastic;
    /// use hyperrod::section::{Circle, Section};
    /// use hyperrod::solve::dynamics::{Dynamics, Scene, Start};
    /// use hyperrod::{Body, Pose, Rod};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let section = Section::new(Circle::new(1e-3), LinearElastic::new(200e9, 80e9)?)?;
    /// let rod = Rod::clamped(Body::new(0.5, section)?.with_density(7800.0)?, Pose::identity());
    /// let modes = Dynamics::default().modes(&Scene::new(&rod), &Start::at_rest(), 2)?;
    /// // a slender cantilever: ω = 3.516 √(E I / (ρ A L⁴)), in both planes
    /// let slender = 3.51602 / 0.25 * (200e9 * 1e-6 / 4.0 / 7800.0_f64).sqrt();
    /// assert!((modes[0].angular_frequency() / slender - 1.0).abs() < 1e-4);
    /// assert!((modes[1].angular_frequency() / slender - 1.0).abs() < 1e-4);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// Where no equilibrium is found, or no combination of K and M is positive definite.
    pub fn modes<B: Movable>(
        &self,
        scene: &Scene<'_, B>,
        start: &Start,
        count: usize,
    ) -> Result<Vec<Mode>, Box<Failure>> {
        let found = match self.order {
            Order::Two => modes_of(on_mesh::<B, 1>(self, scene, start.time)?, self, scene, start, count),
            Order::Four => modes_of(on_mesh::<B, 2>(self, scene, start.time)?, self, scene, start, count),
            Order::Six => modes_of(on_mesh::<B, 3>(self, scene, start.time)?, self, scene, start, count),
        };
        found.map_err(|reason| Failure::early(start.time, reason))
    }
}

fn modes_of<B: Movable, const S: usize>(
    mut core: Core<S>,
    options: &Dynamics,
    scene: &Scene<'_, B>,
    start: &Start,
    count: usize,
) -> Result<Vec<Mode>, Reason> {
    core.at_time(scene, start.time).map_err(Reason::Inadmissible)?;
    set_strains(&mut core, start)?;
    balance(&mut core, scene, options.tolerance, options.max_iterations.max(50))?;
    // Held first: the state is left with the wrenches of the equilibrium
    let mut basis = DMatrix::zeros(0, 0);
    let mut matrices = [Relation::Held, Relation::Static].map(|relation| (relation, DMatrix::zeros(0, 0)));
    for (relation, matrix) in &mut matrices {
        core.problem.relation = *relation;
        core.problem.stiffness = if *relation == Relation::Held { 0.0 } else { 1.0 };
        core.move_to_strains();
        core.respond(scene, Request::Tangent).map_err(Reason::Inadmissible)?;
        core.balance();
        let linear = LinearRod::new(&core);
        if basis.is_empty() {
            basis = linear.basis(&core);
        }
        let whole = linear.assemble();
        *matrix = basis.transpose() * whole * &basis;
    }
    let [(_, mass), (_, stiffness)] = matrices;
    let unit = mass.diagonal().sum() / stiffness.diagonal().sum();
    let pairs = eigenpairs(&stiffness, &mass, unit, core.loose, count).map_err(Reason::Singular)?;
    let shape =
        |(omega_squared, q): (f64, DVector<f64>)| shape(&core, omega_squared, (&basis * q).as_slice());
    Ok(pairs.into_iter().map(shape).collect())
}

/// The rod linearised in its strains, and in the displacement of a base that can move.
pub(super) struct LinearRod<'a, const S: usize> {
    core: &'a Core<S>,
    elements: Vec<AdjointElement<S>>,
    /// What the wrench on the section of each mount answers to a displacement of it.
    tangents: Vec<Matrix6<f64>>,
}

impl<'a, const S: usize> LinearRod<'a, S> {
    /// About the state that `core` has balanced.
    fn new(core: &'a Core<S>) -> Self {
        let relation = core.problem.relation;
        let elements = (0..core.grid.elements).map(|i| core.element(i, &Matrix6::zeros())).collect();
        let tangent = |(m, mount): (usize, &Mount)| {
            let mut tangent = mount.force_tangent(&relation);
            if !mount.support.is_free() && relation != Relation::Held {
                // −Σ (∂χ_j/∂ζ)ᵀ ∂(Q_j + k χ_j)/∂ζ over what is not held
                let (pose, rows) = (&core.node_pose[mount.node], core.equations(m));
                let chi = mount.coordinate_map(pose);
                for (j, condition) in mount.support.conditions().iter().enumerate() {
                    if !matches!(condition, Condition::Fixed(_)) {
                        tangent -= chi.row(j).transpose() * rows.from_zeta.row(j);
                    }
                }
            }
            tangent
        };
        let tangents = core.mounts.iter().enumerate().map(tangent).collect();
        Self { core, elements, tangents }
    }

    fn strains(&self) -> usize {
        6 * S * self.elements.len()
    }

    fn size(&self) -> usize {
        self.strains() + if self.core.loose { 6 } else { 0 }
    }

    /// The displacement of every node, before its corner.
    fn displacements(&self, q: &[f64]) -> Vec<Vector6<f64>> {
        let strains = self.strains();
        let mut zeta = vec![if q.len() > strains { six(q, strains) } else { Vector6::zeros() }];
        for (i, element) in self.elements.iter().enumerate() {
            let mut next = element.end_inverse.apply(&self.turned_on(i, &zeta[i]));
            for k in 0..S {
                next += element.end[k].apply(&Twist::from_vector(&six(q, 6 * (S * i + k))));
            }
            zeta.push(next.to_vector());
        }
        zeta
    }

    fn turned_on(&self, i: usize, zeta: &Vector6<f64>) -> Twist {
        let zeta = Twist::from_vector(zeta);
        self.core.between(i).map_or(zeta, |mount| mount.turned_on(&zeta))
    }

    /// The matrix whose columns are what the rod answers to unit strains, and to unit displacements of a base that can move; symmetric.
    fn assemble(&self) -> DMatrix<f64> {
        let n = self.size();
        let mut matrix = DMatrix::zeros(n, n);
        let mut q = vec![0.0; n];
        for column in 0..n {
            q[column] = 1.0;
            let answer = self.apply(&q);
            matrix.column_mut(column).copy_from_slice(&answer[..n]);
            q[column] = 0.0;
        }
        let transpose = matrix.transpose();
        (matrix + transpose) * 0.5
    }

    /// The residuals of the stages, and minus the wrench on the base.
    fn apply(&self, q: &[f64]) -> Vec<f64> {
        let zeta = self.displacements(q);
        let n = self.elements.len();
        let mut answer = vec![0.0; self.strains() + 6];
        let mut wrench = self.tangents[self.tangents.len() - 1] * zeta[n];
        for (i, element) in self.elements.iter().enumerate().rev() {
            let beyond = Wrench::from_vector(&wrench);
            let start = self.turned_on(i, &zeta[i]).to_vector();
            let mut before = element.end_inverse.apply_transpose(&beyond).to_vector() + element.u * start;
            for k in 0..S {
                let mut row = -element.end[k].apply_transpose(&beyond).to_vector() - element.p[k] * start;
                for m in 0..S {
                    row += element.a[k][m] * six(q, 6 * (S * i + m));
                }
                answer[6 * (S * i + k)..6 * (S * i + k) + 6].copy_from_slice(row.as_slice());
                before -= element.q[k] * six(q, 6 * (S * i + k));
            }
            if let Some(mount) = self.core.between(i) {
                before = mount.turned_back(&Wrench::from_vector(&before)).to_vector();
            }
            if let Some(m) = self.core.mount_at[i] {
                before += self.tangents[m] * zeta[i];
            }
            wrench = before;
        }
        let base = self.strains();
        answer[base..].copy_from_slice((-wrench).as_slice());
        answer
    }

    /// The motions that fixed strains and supports allow, as columns.
    fn basis(&self, core: &Core<S>) -> DMatrix<f64> {
        let (n, strains) = (self.size(), self.strains());
        let free: Vec<usize> = (0..n).filter(|&c| c >= strains || !core.grid.fixed[c % 6]).collect();
        let held = |mount: &&Mount| !mount.support.is_free() && (mount.node > 0 || core.loose);
        let mut rows: Vec<(usize, RowVector6<f64>)> = Vec::new();
        for mount in core.mounts.iter().filter(held) {
            let chi = mount.coordinate_map(&core.node_pose[mount.node]);
            for (j, condition) in mount.support.conditions().iter().enumerate() {
                if matches!(condition, Condition::Fixed(_)) {
                    let unit = if j < 3 { 1.0 } else { core.grid.length };
                    rows.push((mount.node, chi.row(j) / unit));
                }
            }
        }
        let mut conditions = DMatrix::zeros(rows.len(), free.len());
        let mut q = vec![0.0; n];
        for (c, &unknown) in free.iter().enumerate() {
            q[unknown] = 1.0;
            let zeta = self.displacements(&q);
            for (r, (node, row)) in rows.iter().enumerate() {
                conditions[(r, c)] = (row * zeta[*node])[0];
            }
            q[unknown] = 0.0;
        }
        let inner = null_space(conditions);
        let mut basis = DMatrix::zeros(n, inner.ncols());
        for (r, &unknown) in free.iter().enumerate() {
            basis.row_mut(unknown).copy_from(&inner.row(r));
        }
        basis
    }
}

/// A basis of the vectors that a matrix of few rows sends to zero: elimination with complete pivoting.
fn null_space(mut rows: DMatrix<f64>) -> DMatrix<f64> {
    /// A pivot this small says nothing that others have not said.
    const NOTHING: f64 = 1e-10;
    let n = rows.ncols();
    let mut pivots: Vec<usize> = Vec::new();
    for r in 0..rows.nrows() {
        let rest = rows.rows(r, rows.nrows() - r);
        let (row, column) = rest.iamax_full();
        if !(rest[(row, column)].abs() > NOTHING) {
            break;
        }
        rows.swap_rows(r, r + row);
        let scale = 1.0 / rows[(r, column)];
        rows.row_mut(r).scale_mut(scale);
        for other in (0..rows.nrows()).filter(|&other| other != r) {
            let factor = rows[(other, column)];
            let change = rows.row(r) * factor;
            let mut target = rows.row_mut(other);
            target -= change;
        }
        pivots.push(column);
    }
    let others: Vec<usize> = (0..n).filter(|c| !pivots.contains(c)).collect();
    let mut basis = DMatrix::zeros(n, others.len());
    for (c, &other) in others.iter().enumerate() {
        basis[(other, c)] = 1.0;
        for (r, &pivot) in pivots.iter().enumerate() {
            basis[(pivot, c)] = -rows[(r, other)];
        }
    }
    basis
}

fn six(q: &[f64], at: usize) -> Vector6<f64> {
    Vector6::from_column_slice(&q[at..at + 6])
}

/// The smallest ω² with K q = ω² M q and qᵀ M q = 1, from the largest 1/(ω² + σ) of (K + σM)⁻¹ M: the wanted ones come with all their digits.
fn eigenpairs(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    unit: f64,
    free: bool,
    count: usize,
) -> Result<Vec<(f64, DVector<f64>)>> {
    let shifts = std::iter::once(0.0).chain((-12..=6).map(|power| 10.0_f64.powi(power) / unit));
    for shift in shifts {
        let shifted = stiffness + mass * shift;
        let scale = shifted.diagonal().map(|d| 1.0 / d.abs().max(f64::MIN_POSITIVE).sqrt());
        let scaled =
            |m: &DMatrix<f64>| DMatrix::from_fn(m.nrows(), m.ncols(), |r, c| m[(r, c)] * scale[r] * scale[c]);
        let Some(factor) = Cholesky::new(scaled(&shifted)) else { continue };
        // a pivot that is only rounding is no pivot
        if free && factor.l().diagonal().min() < 1e-6 {
            continue;
        }
        let l = factor.l();
        let solved = l
            .solve_lower_triangular(&scaled(mass))
            .and_then(|half| l.solve_lower_triangular(&half.transpose()));
        let Some(matrix) = solved else { continue };
        let eigen = SymmetricEigen::new((&matrix + matrix.transpose()) * 0.5);
        let mut order: Vec<usize> = (0..matrix.nrows()).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let pairs = order.into_iter().take(count).filter(|&i| eigen.eigenvalues[i] > 0.0).filter_map(|i| {
            let mu = eigen.eigenvalues[i];
            // q = S L⁻ᵀ y has qᵀ M q = μ
            let y = l.tr_solve_lower_triangular(&eigen.eigenvectors.column(i).into_owned())?;
            let q = y.component_mul(&scale) / mu.sqrt();
            Some((1.0 / mu - shift, q))
        });
        return Ok(pairs.collect());
    }
    Err(Error::Singular { matrix: "stiffness with any share of the mass", s: 0.0 })
}

/// A mode from its strains, by the kinematics of `core`.
fn shape<const S: usize>(core: &Core<S>, omega_squared: f64, q: &[f64]) -> Mode {
    let strains = 6 * S * core.grid.elements;
    let mut node = if core.loose { Twist::from_vector(&six(q, strains)) } else { Twist::zero() };
    let mut mode = Mode { omega_squared, nodes: vec![node], stages: Vec::new() };
    for i in 0..core.grid.elements {
        if let Some(mount) = core.between(i) {
            node = mount.turned_on(&node);
            mode.nodes.push(node);
        }
        let rate: [Twist; S] = std::array::from_fn(|k| Twist::from_vector(&six(q, 6 * (S * i + k))));
        let (stage, end) = core.legs[i].velocities(&core.grid.table, core.grid.h(i), &node, &rate);
        for k in 0..S {
            mode.stages.push(ModeStage {
                s: core.grid.stage_s(i, k),
                weight: core.grid.weight(i, k),
                displacement: stage[k],
                strain: Strain::new(rate[k].angular, rate[k].linear),
            });
        }
        node = end;
        mode.nodes.push(node);
    }
    mode
}
