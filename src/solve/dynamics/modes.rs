use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

use super::begin::{balance, set_strains};
use super::core::Core;
use super::engine::on_mesh;
use super::failure::{Failure, Reason};
use super::options::Dynamics;
use super::relation::Relation;
use super::scene::{Movable, Scene};
use super::state::Start;
use super::whole::{LinearRod, six};
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist};
use crate::material::Request;
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
    /// assert!((modes[1].frequency() * std::f64::consts::TAU / slender - 1.0).abs() < 1e-4); // Hz
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

/// ω² and q of a mode.
type Pair = (f64, DVector<f64>);

/// The smallest ω² with K q = ω² M q and qᵀ M q = 1, in ascending order.
///
/// A rigid mode has 1/(ω² + σ) = 1/σ, of whose rounding the others get ω²/σ times as much. The share σ that makes K + σM definite is that small that nothing
/// might be left of them; where there are rigid modes they are thus found once more, with a share of the size of what is wanted.
fn eigenpairs(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    unit: f64,
    free: bool,
    count: usize,
) -> Result<Vec<Pair>> {
    /// Of the largest ω² wanted; the smallest are then known to a tenth of its rounding.
    const SHARE: f64 = 0.1;
    let mut shifts = std::iter::once(0.0).chain((-12..=6).map(|power| 10.0_f64.powi(power) / unit));
    let found = shifts.find_map(|shift| Some((shift, shifted_pairs(stiffness, mass, shift, free, count)?)));
    let (shift, pairs) =
        found.ok_or(Error::Singular { matrix: "stiffness with any share of the mass", s: 0.0 })?;
    let wanted = SHARE * pairs.last().map_or(0.0, |(omega_squared, _)| *omega_squared);
    if !(shift > 0.0 && wanted > shift) {
        return Ok(pairs);
    }
    Ok(shifted_pairs(stiffness, mass, wanted, free, count).unwrap_or(pairs))
}

/// The same from the largest 1/(ω² + σ) of (K + σM)⁻¹ M; `None` where K + σM is not definite.
fn shifted_pairs(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    shift: f64,
    free: bool,
    count: usize,
) -> Option<Vec<Pair>> {
    let shifted = stiffness + mass * shift;
    let scale = shifted.diagonal().map(|d| 1.0 / d.abs().max(f64::MIN_POSITIVE).sqrt());
    let scaled =
        |m: &DMatrix<f64>| DMatrix::from_fn(m.nrows(), m.ncols(), |r, c| m[(r, c)] * scale[r] * scale[c]);
    let l = Cholesky::new(scaled(&shifted))?.l();
    // a pivot that is only rounding is no pivot
    if free && l.diagonal().min() < 1e-6 {
        return None;
    }
    let half = l.solve_lower_triangular(&scaled(mass))?;
    let matrix = l.solve_lower_triangular(&half.transpose())?;
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
    Some(pairs.collect())
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
