//! The exact tangent against the derivative of the residual, by dual numbers and by differences.

use num_dual::Dual64;

use super::*;
use crate::body::{Density, HasMass, LineMass};
use crate::lie::{Strain, Twist};
use crate::load::{DeadLoad, DeadWrench, Gravity};
use crate::material::NeoHookean;
use crate::rod::Rod;
use crate::rod::condense::Condensed;
use crate::rod::element::Linearisation;
use crate::scalar::Scalar;
use crate::section::{Circle, Linear, Section};
use crate::solve::linear::{Buffers, kind_of_elements};
use crate::solve::scale::Scale;
use crate::{Body, Pose};
use nalgebra::{Matrix6, SVector, Vector3, vector};

type Tapered = Body<Section<Circle<Linear>, NeoHookean>, Density>;

const ELEMENTS: usize = 3;

fn weight() -> Vector3<f64> {
    vector![1.0, -9.0, 3.0]
}
fn tip_moment() -> Vector3<f64> {
    vector![0.02, -0.03, 0.01]
}
fn tip_force() -> Vector3<f64> {
    vector![0.3, 0.2, -0.1]
}

/// A pre-curved, tapered, heavy, neo-Hookean rod with a dead moment and a dead force on its tip; with or without its weight.
fn rod(heavy: bool) -> Rod<Tapered> {
    let radius = Linear { from: 0.02, to: 0.012, length: 0.3 };
    let section = Section::new(Circle::new(radius), NeoHookean::new(2e5, 3e5).unwrap()).unwrap();
    let curved = Twist::from_array([1.0, -2.0, 0.5, 0.02, -0.01, 1.05]);
    let body = Body::new(0.3, section).unwrap().with_reference_strain(curved).unwrap();
    let base = crate::lie::se3::exp(&Twist::from_array([0.3, -0.7, 1.1, 0.1, 0.2, -0.3]));
    let rod = Rod::clamped(body.with_density(1100.0).unwrap(), base)
        .with_tip_load(DeadWrench::new(tip_moment(), tip_force()).unwrap());
    if heavy { rod.with_load(Gravity::new(weight()).unwrap()) } else { rod }
}

/// Reproducible numbers in (−1, 1), one stream for every seed.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Stage strains of a tenth in stretch and shear, and of a few times 1/L in curvature.
fn strains<const S: usize>(mut seed: u64) -> StageStrains<S> {
    let mut strain =
        || Strain::from_array([3.0, 3.0, 3.0, 0.1, 0.1, 0.1].map(|size| size * noise(&mut seed)));
    (0..ELEMENTS).map(|_| std::array::from_fn(|_| strain())).collect()
}

impl<const S: usize> Configuration<S> {
    /// r_k = Ψ(Δξ_k) − Λ_k of element i.
    fn residual(&self, i: usize) -> [Wrench; S] {
        std::array::from_fn(|k| self.response[i][k].wrench - self.stage_wrench[i][k])
    }
}

/// With the reactions of a cantilever: none.
fn unknowns<const S: usize>(mesh: &Mesh<'_, Tapered, S>, at: &StageStrains<S>) -> Unknowns<S> {
    Unknowns { strains: at.clone(), ..Unknowns::at_rest(mesh) }
}

/// A vector fixed in space, in the frame of `pose`.
fn in_body<D: Scalar>(pose: &Pose<D>, v: &Vector3<f64>) -> Vector3<D> {
    pose.rotation.tr_mul(&v.map(D::from))
}

/// The residual over any scalar: dead loads written out, Ψ lifted to first order by the section's own tangent.
fn dual_residual<const S: usize>(
    mesh: &Mesh<'_, Tapered, S>,
    at: &StageStrains<S>,
    direction: &StageStrains<S>,
    heavy: bool,
) -> Vec<[Wrench<Dual64>; S]> {
    let (h, body) = (mesh.h(0), mesh.rod.body());
    let along = |v: [f64; 6], d: [f64; 6]| std::array::from_fn(|i| Dual64::new(v[i], d[i]));
    let mut pose: Pose<Dual64> = mesh.rod.base().cast();
    let (mut motions, mut loads) = (Vec::new(), Vec::new());
    for i in 0..mesh.elements() {
        let xi = mesh.twists(i, &at[i]);
        let xi: [Twist<Dual64>; S] =
            std::array::from_fn(|k| Twist::from_array(along(xi[k].to_array(), direction[i][k].to_array())));
        let motion = Kinematics::new(&mesh.table, &xi, h);
        let stage: [Wrench<Dual64>; S] = std::array::from_fn(|k| {
            if !heavy {
                return Wrench::zero();
            }
            let LineMass { mass, first: [x, y] } = body.line_mass(mesh.stage_s(i, k)).unwrap();
            let acceleration = in_body(&(pose * motion.stage[k]), &weight());
            let arm = vector![x, y, 0.0].map(Dual64::from_re);
            Wrench::new(arm.cross(&acceleration), acceleration * Dual64::from_re(mass))
        });
        loads.push(motion.at_node(&stage));
        pose = pose * motion.end;
        motions.push(motion);
    }
    let mut wrench = Wrench::new(in_body(&pose, &tip_moment()), in_body(&pose, &tip_force()));
    let mut residual = vec![[Wrench::zero(); S]; mesh.elements()];
    for i in (0..mesh.elements()).rev() {
        wrench = motions[i].wrench_at_start(&mesh.table, &wrench, &loads[i], h);
        let stage = motions[i].stage_wrenches(&mesh.table, &wrench, &loads[i], h);
        for k in 0..S {
            let response = body.respond(mesh.stage_s(i, k), &at[i][k], Request::Tangent).unwrap();
            let d_psi = response.tangent * direction[i][k].to_vector();
            let psi = along(response.wrench.to_array(), Wrench::from_vector(&d_psi).to_array());
            residual[i][k] = Wrench::from_array(psi) - stage[k];
        }
    }
    residual
}

fn configured<const S: usize>(mesh: &Mesh<'_, Tapered, S>, at: &StageStrains<S>) -> Configuration<S> {
    let mut state = Configuration::default();
    mesh.configure(&unknowns(mesh, at), &mut state).unwrap();
    state
}

/// The same derivative from the blocks of the linearisation: ζ forward from the clamp, δΛ backward from the tip.
fn block_derivative<const S: usize>(
    mesh: &Mesh<'_, Tapered, S>,
    at: &StageStrains<S>,
    direction: &StageStrains<S>,
) -> Vec<[Wrench; S]> {
    let state = configured(mesh, at);
    let elements: Vec<_> =
        (0..mesh.elements()).map(|i| Linearisation::new(&mesh.table, &mesh.element(i, at, &state))).collect();
    let sum = |blocks: &[Matrix6<f64>; S], strains: &[Strain; S]| {
        blocks.iter().zip(strains).fold(SVector::<f64, 6>::zeros(), |v, (b, d)| v + b * d.to_vector())
    };
    let mut zeta = vec![SVector::<f64, 6>::zeros()];
    for ((element, d), motion) in elements.iter().zip(direction).zip(&state.kinematics) {
        let next =
            motion.end.adjoint_inverse().to_matrix() * zeta[zeta.len() - 1] + sum(&element.end_strain, d);
        zeta.push(next);
    }
    let mut d_wrench = state.tip_load.tangent * zeta[mesh.elements()];
    let mut derivative = vec![[Wrench::zero(); S]; mesh.elements()];
    for (i, element) in elements.iter().enumerate().rev() {
        let known = element.wrench_from_zeta * zeta[i] + sum(&element.wrench_from_strain, &direction[i]);
        let carried = state.kinematics[i].end.adjoint().to_matrix().transpose();
        d_wrench = carried.lu().solve(&(d_wrench - known)).unwrap();
        for (k, answer) in derivative[i].iter_mut().enumerate() {
            let change = sum(&element.stage[k], &direction[i])
                - element.from_zeta[k] * zeta[i]
                - element.from_wrench[k] * d_wrench;
            *answer = Wrench::from_vector(&change);
        }
    }
    derivative
}

/// The largest difference of two sets of stage wrenches, moments and forces each relative to the largest of the second set.
fn difference<const S: usize>(a: &[[Wrench; S]], b: &[[Wrench; S]]) -> f64 {
    let mut size = [0.0_f64; 2];
    let mut error = [0.0_f64; 2];
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        let d = *a - *b;
        for (i, (d, b)) in [(d.moment, b.moment), (d.force, b.force)].into_iter().enumerate() {
            error[i] = error[i].max(d.norm());
            size[i] = size[i].max(b.norm());
        }
    }
    (error[0] / size[0]).max(error[1] / size[1])
}

fn tangent_holds<const S: usize>(heavy: bool) {
    let rod = rod(heavy);
    let mesh = Mesh::<_, S>::uniform(&rod, ELEMENTS);
    for seed in 0..4 {
        let (at, direction) = (strains::<S>(2 * seed), strains::<S>(2 * seed + 1));
        let dual = dual_residual(&mesh, &at, &direction, heavy);
        let state = configured(&mesh, &at);

        // the dual residual is the residual of the solver: the same sums in another order
        let value: Vec<_> =
            dual.iter().map(|e| e.map(|w| Wrench::from_array(w.to_array().map(|v| v.re)))).collect();
        let solver: Vec<_> = (0..ELEMENTS).map(|i| state.residual(i)).collect();
        assert!(difference(&solver, &value) < 1e-14, "{:.1e}", difference(&solver, &value));

        // and its derivative that of the blocks: some hundred roundings of 1e-16 that partly cancel; measured 3e-16
        let exact: Vec<_> =
            dual.iter().map(|e| e.map(|w| Wrench::from_array(w.to_array().map(|v| v.eps)))).collect();
        let blocks = block_derivative(&mesh, &at, &direction);
        let error = difference(&blocks, &exact);
        assert!(error < 1e-14, "S = {S}, heavy {heavy}: {error:.1e}");

        // central differences of the whole residual, section and all: step² and ε / step, 1e-10 and 1e-11; measured 7e-11
        let step = 1e-5;
        let shifted = |sign: f64| -> Vec<[Wrench; S]> {
            let moved: Vec<[Strain; S]> = at
                .iter()
                .zip(&direction)
                .map(|(a, d)| std::array::from_fn(|k| a[k] + d[k] * (sign * step)))
                .collect();
            let state = configured(&mesh, &moved);
            (0..ELEMENTS).map(|i| state.residual(i)).collect()
        };
        let (plus, minus) = (shifted(1.0), shifted(-1.0));
        let slope: Vec<_> = plus
            .iter()
            .zip(&minus)
            .map(|(p, m)| std::array::from_fn(|k| (p[k] - m[k]) * (0.5 / step)))
            .collect();
        let error = difference(&slope, &blocks);
        assert!(error < 1e-9, "S = {S}, heavy {heavy}, differences: {error:.1e}");
    }
}

#[test]
fn the_tangent_is_the_derivative_of_the_residual_at_order_two() {
    tangent_holds::<1>(false);
    tangent_holds::<1>(true);
}

#[test]
fn the_tangent_is_the_derivative_of_the_residual_at_order_four() {
    tangent_holds::<2>(false);
    tangent_holds::<2>(true);
}

#[test]
fn the_tangent_is_the_derivative_of_the_residual_at_order_six() {
    tangent_holds::<3>(false);
    tangent_holds::<3>(true);
}

/// Elimination of shear and extension first, against elimination of all strains at once.
fn short_cut_holds<const S: usize>(heavy: bool) {
    let rod = rod(heavy);
    let mesh = Mesh::<_, S>::uniform(&rod, ELEMENTS);
    let at = strains::<S>(3);
    let state = configured(&mesh, &at);
    let (kind, element) = (kind_of_elements(&mesh, &state), |i: usize| mesh.element(i, &at, &state));
    let (mut short, mut general) = (Condensed::<S>::default(), Condensed::<S>::default());
    short.begin(ELEMENTS, &kind);
    short.fill(&mesh.table, &kind, 0, 0..ELEMENTS, element, &state.node_wrench).unwrap();
    general.begin(ELEMENTS, &kind);
    let nodes = [(SVector::from([0.1, -0.2, 0.3, 0.01, 0.02, -0.03]), SVector::from([1.0; 6])); ELEMENTS];
    for i in 0..ELEMENTS {
        general.fill_alone(&mesh.table, i, &element(i)).unwrap();
        let scale = Scale { length: 0.3, force: 1.0 };
        let (a, b) = (scale.transfer(&short.transfer(i)), scale.transfer(&general.transfer(i)));
        // eighteen equations of condition 1e3 or so, in units of the rod; measured 1e-15
        let error = (a.left - b.left).norm() / b.left.norm() + (a.rhs - b.rhs).norm() / b.rhs.norm();
        assert!(error < 1e-13, "S = {S}, heavy {heavy}: {error:.1e}");
    }
    let (mut a, mut b) = (Vec::new(), Vec::new());
    short.strain_steps(&nodes, &mut a);
    general.strain_steps(&nodes, &mut b);
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        let error = (*a - *b).to_vector().norm() / b.to_vector().norm();
        assert!(error < 1e-13, "S = {S}, heavy {heavy}, strains: {error:.1e}");
    }
}

#[test]
fn eliminating_shear_and_extension_first_changes_nothing() {
    for heavy in [false, true] {
        short_cut_holds::<1>(heavy);
        short_cut_holds::<2>(heavy);
        short_cut_holds::<3>(heavy);
    }
}

/// The Newton step solves the linearised equations, chain and all: the derivative of the residual along it is minus the residual.
fn step_solves<const S: usize>(heavy: bool) {
    let rod = rod(heavy);
    let mesh = Mesh::<_, S>::uniform(&rod, ELEMENTS);
    let at = strains::<S>(5);
    let state = configured(&mesh, &at);
    let mut buffers = Buffers::<S>::default();
    let scale = Scale { length: 0.3, force: 1.0 };
    buffers.newton_step(&mesh, &unknowns(&mesh, &at), &state, &scale).unwrap();
    buffers.move_by(&Unknowns::at_rest(&mesh), 1.0);
    let along = block_derivative(&mesh, &at, &buffers.trial.strains);
    let target: Vec<_> = (0..ELEMENTS).map(|i| state.residual(i).map(|r| -r)).collect();
    let error = difference(&along, &target);
    // rounding times the condition of the tangent; measured 2e-14
    assert!(error < 1e-11, "S = {S}, heavy {heavy}: {error:.1e}");
}

#[test]
fn the_newton_step_solves_the_linearised_equations() {
    for heavy in [false, true] {
        step_solves::<1>(heavy);
        step_solves::<2>(heavy);
        step_solves::<3>(heavy);
    }
}

/// A rod with a dead force per length, and a dead moment and force on its tip, all in the plane of x and z, and bent there at rest.
fn plane_rod(constraint: Constraint) -> Rod<Tapered> {
    let radius = Linear { from: 0.02, to: 0.012, length: 0.3 };
    let section = Section::new(Circle::new(radius), NeoHookean::new(2e5, 3e5).unwrap()).unwrap();
    let curved = Twist::from_array([0.0, -2.0, 0.0, 0.0, 0.0, 1.05]);
    let body = Body::new(0.3, section).unwrap().with_reference_strain(curved).unwrap();
    let body = body.with_density(1100.0).unwrap().with_constraint(constraint);
    let tip = DeadWrench::new(vector![0.0, -0.03, 0.0], vector![0.3, 0.0, -0.1]).unwrap();
    // not its weight, which has a moment where the rod is bent at rest
    let load = DeadLoad::new(Wrench::new(Vector3::zeros(), vector![1.0, 0.0, -3.0])).unwrap();
    Rod::clamped(body, Pose::identity()).with_tip_load(tip).with_load(load)
}

/// Rotations and moments swept block by block, against all components of a chain that is kept.
fn dead_sweep_holds<const S: usize>(rod: &Rod<Tapered>, in_plane: bool) {
    // one element, and two blocks, the second not full
    for count in [1, 11] {
        dead_sweep_holds_on::<S>(rod, in_plane, count);
    }
}

fn dead_sweep_holds_on<const S: usize>(rod: &Rod<Tapered>, in_plane: bool, count: usize) {
    let mesh = Mesh::<_, S>::uniform(rod, count);
    let fixed = rod.body().constraint().fixed();
    let mut seed = 9;
    let mut strain = || {
        let mut six = [1.0, 1.0, 1.0, 0.03, 0.03, 0.03].map(|size| size * noise(&mut seed));
        for i in 0..6 {
            if fixed[i] {
                six[i] = 0.0;
            }
        }
        Strain::from_array(six)
    };
    let at: StageStrains<S> = (0..count).map(|_| std::array::from_fn(|_| strain())).collect();
    let (state, unknowns) = (configured(&mesh, &at), unknowns(&mesh, &at));
    assert_eq!(kind_of_elements(&mesh, &state).plane, in_plane);
    let scale = Scale { length: 0.3, force: 1.0 };
    let (mut dead, mut all) = (Buffers::<S>::default(), Buffers::<S>::default());
    dead.dead_step(&mesh, &unknowns, &state, &scale).unwrap().unwrap();
    all.condense(&mesh, &unknowns, &state).unwrap();
    all.solve_condensed(&mesh, &state, &scale).unwrap();
    let (a, b) = (dead.step.strains.as_flattened(), all.step.strains.as_flattened());
    let size = b.iter().fold(0.0_f64, |size, b| size.max(b.to_vector().norm()));
    let error = a.iter().zip(b).fold(0.0_f64, |e, (a, b)| e.max((*a - *b).to_vector().norm()));
    // the condition of a chain of eleven elements times rounding
    assert!(error < 1e-10 * size, "S = {S}, in the plane {in_plane}: {error:.1e} of {size:.1e}");
    for (a, b) in dead.step.nodes.iter().zip(&all.step.nodes) {
        assert!((a.0 - b.0).norm() < 1e-10 * size && (a.1 - b.1).norm() < 1e-10 * (1.0 + b.1.norm()));
    }
}

#[test]
fn under_dead_forces_half_the_components_say_it_all() {
    dead_sweep_holds::<2>(&rod(false), false);
    dead_sweep_holds::<3>(&rod(false), false);
    for (constraint, in_plane) in [
        (Constraint::none(), false),
        (Constraint::kirchhoff(), false),
        (Constraint::planar(), true),
        (Constraint::planar().and(Constraint::inextensible()), true),
        (Constraint::planar().and(Constraint::kirchhoff()), true),
    ] {
        dead_sweep_holds::<1>(&plane_rod(constraint), in_plane);
        dead_sweep_holds::<3>(&plane_rod(constraint), in_plane);
    }
}
