//! Blocks of elements against the elements done alone, with pivoting.

use nalgebra::{Matrix6, SMatrix, Vector6};

use super::*;
use crate::body::Constraint;
use crate::lie::{Twist, Wrench};
use crate::load::LoadWrench;
use crate::material::Response;
use crate::rod::collocation::Collocation;
use crate::rod::element::{ElementState, Kinematics};
use crate::rod::stage_loads::StageLoads;

/// One element and all that its linearisation needs.
struct Case<const S: usize> {
    h: f64,
    xi: [Twist; S],
    response: [Response; S],
    start: Wrench,
    load: Option<[LoadWrench; S]>,
    /// The forces of the same in the frame of the first node, where they are to be taken from there.
    dead: Option<[Vector3<f64>; S]>,
    constraint: Constraint,
    kinematics: Kinematics<f64, S>,
    stage_wrench: [Wrench; S],
    end: Wrench,
}

/// Reproducible numbers in (−1, 1).
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn wrench(seed: &mut u64, plane: bool) -> Wrench {
    let mut six = [1.0; 6].map(|size: f64| size * noise(seed));
    if plane {
        (six[0], six[2], six[4]) = (0.0, 0.0, 0.0);
    }
    Wrench::from_array(six)
}

/// A load that turns with the section in its own way, or keeps its force in space.
fn load(seed: &mut u64, kind: &Kind) -> LoadWrench {
    let mut load = wrench(seed, kind.plane);
    let mut tangent = Matrix6::zeros();
    if kind.loads == Loads::Dead {
        load.moment = Vector3::zeros();
        tangent.fixed_view_mut::<3, 3>(3, 0).copy_from(&crate::lie::so3::hat(&load.force));
    } else {
        for c in 0..3 {
            tangent.set_column(c, &wrench(seed, kind.plane).to_vector());
        }
    }
    LoadWrench { wrench: load, tangent, potential: None }
}

/// Stretched, sheared, bent by some 3/L, stiffnesses positive definite with every coupling.
fn case<const S: usize>(table: &Collocation<S>, seed: &mut u64, kind: &Kind) -> Case<S> {
    let mut sizes = [3.0, 3.0, 3.0, 0.1, 0.1, 0.1];
    if kind.plane {
        (sizes[0], sizes[2], sizes[4]) = (0.0, 0.0, 0.0);
    }
    let xi =
        std::array::from_fn(|_| Twist::from_array(sizes.map(|size| size * noise(seed))) + Twist::straight());
    let response = std::array::from_fn(|_| {
        let factor: Matrix6<f64> = SMatrix::from_fn(|_, _| 0.3 * noise(seed)) + Matrix6::identity();
        let scale = Matrix6::from_diagonal(&Vector6::from([1.0, 1.0, 1.0, 30.0, 30.0, 30.0]));
        let tangent = scale * factor * factor.transpose() * scale;
        let tangent = 0.5 * (tangent + tangent.transpose());
        Response { wrench: wrench(seed, false), tangent, ..Response::zero() }
    });
    let start = wrench(seed, kind.plane);
    let load = (kind.loads != Loads::None).then(|| std::array::from_fn(|_| load(seed, kind)));
    let h = 0.3 + 0.1 * noise(seed);
    let kinematics = Kinematics::new(table, &xi, h);
    let loads = load.map(|stage: [LoadWrench; S]| kinematics.at_node(&stage.map(|load| load.wrench)));
    let (stage_wrench, end) = kinematics.wrenches_from_start(table, &start, loads, h);
    let constraint = kind.constraint;
    // one way and the other in turn
    let as_dead = kind.loads == Loads::Dead && noise(seed) > 0.0;
    let force =
        |load: [LoadWrench; S]| std::array::from_fn(|k| kinematics.stage[k].rotation * load[k].wrench.force);
    let dead = load.filter(|_| as_dead).map(force);
    Case { h, xi, response, start, load, dead, constraint, kinematics, stage_wrench, end }
}

impl<const S: usize> Case<S> {
    fn state(&self) -> ElementState<'_, S> {
        ElementState {
            h: self.h,
            xi: self.xi,
            kinematics: &self.kinematics,
            response: &self.response,
            stage_wrench: &self.stage_wrench,
            wrench_at_end: &self.end,
            load: match (&self.dead, &self.load) {
                (Some(dead), _) => StageLoads::Dead(dead),
                (None, Some(load)) => StageLoads::Any(load),
                (None, None) => StageLoads::None,
            },
            constraint: self.constraint,
        }
    }
}

/// The elements of a block, and the same done alone.
fn both<const S: usize>(table: &Collocation<S>, kind: &Kind, cases: &[&Case<S>]) -> [Condensed<S>; 2] {
    let (mut block, mut alone) = (Condensed::default(), Condensed::default());
    let start: Vec<Wrench> = cases.iter().map(|case| case.start).collect();
    block.begin(cases.len(), kind);
    block.fill(table, kind, 0, 0..cases.len(), |i| cases[i].state(), &start).unwrap();
    alone.begin(cases.len(), kind);
    for (i, case) in cases.iter().enumerate() {
        alone.fill_alone(table, i, &case.state()).unwrap();
    }
    [block, alone]
}

/// The transfer and the strains of an element, by every column.
fn numbers<const S: usize>(condensed: &Condensed<S>, i: usize) -> [Vec<f64>; 2] {
    let t = condensed.transfer(i);
    let blocks = [&t.zeta_from_zeta, &t.zeta_from_wrench, &t.wrench_from_zeta, &t.wrench_from_wrench];
    let transfer = blocks.iter().flat_map(|m| m.iter()).chain(&t.zeta).chain(&t.wrench).copied().collect();
    let mut strains = Vec::new();
    let unit = |c: usize| Vector6::from_fn(|r, _| if r == c { 1.0 } else { 0.0 });
    for c in 0..6 {
        for steps in [
            condensed.strain_of_node(i, &Vector6::zeros(), &unit(c)),
            condensed.strain_of_node(i, &unit(c), &Vector6::zeros()),
        ] {
            strains.extend(steps.iter().flat_map(|strain| strain.to_array()));
        }
    }
    let mut all = Vec::new();
    condensed.strain_steps(&vec![(Vector6::zeros(), Vector6::zeros()); i + 1], &mut all);
    strains.extend(all[i].iter().flat_map(|strain| strain.to_array()));
    [transfer, strains]
}

/// Free, every kind of constraint, in the plane and out of it; under no load, dead loads and others.
fn kinds() -> Vec<Kind> {
    let planar = Constraint::planar();
    let constraints = [
        (Constraint::none(), false),
        (Constraint::inextensible(), false),
        (Constraint::unshearable(), false),
        (Constraint::kirchhoff(), false),
        (Constraint::twist_free(), false),
        (planar, false),
        (Constraint::kirchhoff().and(Constraint::twist_free()), false),
        (planar, true),
        (planar.and(Constraint::inextensible()), true),
        (planar.and(Constraint::unshearable()), true),
        (planar.and(Constraint::kirchhoff()), true),
    ];
    let loads = [Loads::None, Loads::Dead, Loads::Turning];
    let kind = |(constraint, plane): (Constraint, bool)| loads.map(|loads| Kind { constraint, plane, loads });
    constraints.into_iter().flat_map(kind).collect()
}

fn agrees<const S: usize>() {
    let (table, mut seed) = (Collocation::<S>::gauss(), 7);
    for kind in kinds() {
        for _ in 0..5 {
            let cases: Vec<Case<S>> = (0..ELEMENTS).map(|_| case(&table, &mut seed, &kind)).collect();
            let [block, alone] = both(&table, &kind, &cases.iter().collect::<Vec<_>>());
            for i in 0..ELEMENTS {
                for (one, other) in numbers(&alone, i).iter().zip(numbers(&block, i)) {
                    let size = one.iter().fold(0.0_f64, |size, v| size.max(v.abs()));
                    let error = one.iter().zip(other).fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()));
                    // eighteen equations of condition 1e3 or so, as with one element by two eliminations
                    assert!(error < 1e-12 * size, "S = {S}, {kind:?}: {error:.1e} of {size:.1e}");
                }
            }
        }
    }
}

#[test]
fn an_element_in_a_block_is_the_element_alone() {
    agrees::<1>();
    agrees::<2>();
    agrees::<3>();
}

#[test]
fn an_element_is_the_same_to_the_bit_whatever_its_block() {
    let (table, mut seed) = (Collocation::<3>::gauss(), 11);
    for kind in kinds() {
        let cases: Vec<Case<3>> = (0..ELEMENTS).map(|_| case(&table, &mut seed, &kind)).collect();
        let [all, _] = both(&table, &kind, &cases.iter().collect::<Vec<_>>());
        for (i, one) in cases.iter().enumerate() {
            let [alone, _] = both(&table, &kind, &[one]);
            let [last, _] =
                both(&table, &kind, &[&cases[0], &cases[1], &cases[2], &cases[3], &cases[4], one]);
            for (other, place) in [(alone, 0), (last, 5)] {
                assert!(numbers(&all, i) == numbers(&other, place), "element {i}, {kind:?}");
            }
        }
    }
}

/// Without pivoting a singular pivot must be noticed; the element alone then has a solution all the same.
#[test]
fn an_element_whose_pivot_vanishes_is_done_alone_and_no_other() {
    let (table, mut seed) = (Collocation::<2>::gauss(), 13);
    for plane in [false, true] {
        let constraint = if plane { Constraint::planar() } else { Constraint::none() };
        let kind = Kind { constraint, plane, loads: Loads::None };
        let mut cases: Vec<Case<2>> = (0..3).map(|_| case(&table, &mut seed, &kind)).collect();
        // no stiffness against shear and extension at a stage
        for i in 3..6 {
            for j in 0..6 {
                cases[1].response[0].tangent[(i, j)] = 0.0;
                cases[1].response[0].tangent[(j, i)] = 0.0;
            }
        }
        let [block, alone] = both(&table, &kind, &cases.iter().collect::<Vec<_>>());
        let same = [0, 1, 2].map(|i| numbers(&block, i) == numbers(&alone, i));
        assert_eq!(same, [false, true, false], "in the plane: {plane}");
    }
}

/// Poses of a block of elements, in space and in the plane, against one element by [`Kinematics::new`].
#[test]
fn poses_in_a_block_are_those_of_the_elements_alone() {
    let (table, mut seed) = (Collocation::<3>::gauss(), 17);
    for plane in [false, true] {
        let kind = Kind { constraint: Constraint::none(), plane, loads: Loads::None };
        let cases: Vec<Case<3>> = (0..ELEMENTS).map(|_| case(&table, &mut seed, &kind)).collect();
        let mut motions = [Kinematics { stage: [Pose::identity(); 3], end: Pose::identity() }; ELEMENTS];
        if plane {
            planar::kinematics(&table, |i| (cases[i].h, cases[i].xi), &mut motions);
        } else {
            let mut twists = lanes::Twists::new();
            for (i, case) in cases.iter().enumerate() {
                twists.set(i, case.h, &case.xi);
            }
            lanes::kinematics(&table, &twists, &mut motions);
        }
        for (case, motion) in cases.iter().zip(&motions) {
            let pairs = case.kinematics.stage.iter().zip(&motion.stage);
            for (a, b) in pairs.chain([(&case.kinematics.end, &motion.end)]) {
                let error = (a.rotation - b.rotation).norm() + (a.position - b.position).norm();
                // some thirty roundings of numbers of size one
                assert!(error < 1e-14, "in the plane: {plane}: {error:.1e}");
            }
        }
    }
}

/// Rotation, displacement and moment at the end, and strains, when the node of an element turns and moves and what is beyond answers: by the
/// answers of a block, and by all columns of the elements done alone.
fn answers_agree<const S: usize>() {
    let (table, mut seed) = (Collocation::<S>::gauss(), 19);
    for kind in kinds().into_iter().filter(|kind| kind.loads <= Loads::Dead) {
        let cases: Vec<Case<S>> = (0..ELEMENTS).map(|_| case(&table, &mut seed, &kind)).collect();
        let [block, alone] = both(&table, &kind, &cases.iter().collect::<Vec<_>>());
        let start: Vec<Wrench> = cases.iter().map(|case| case.start).collect();
        let mut of_plane = |size: f64| if kind.plane { 0.0 } else { size * noise(&mut seed) };
        let (mut turns, mut relations) = (Vec::new(), Vec::new());
        for i in 0..ELEMENTS {
            let (a, b) = (0.3 + 0.1 * i as f64, 0.2 - 0.1 * i as f64);
            turns.push([of_plane(1.0), a, of_plane(1.0)]);
            let mut relation = [[0.0; 4]; 3];
            relation[0] = [3.0 + b, of_plane(1.0), of_plane(1.0), a];
            for row in &mut relation[1..] {
                *row = [0.0; 4].map(|_: f64| of_plane(1.0));
            }
            relations.push(relation);
        }
        let mut answers = Answers::default();
        answers.begin(&block, ELEMENTS);
        if !kind.plane {
            answers.turn(&block, 0, &start);
        }
        answers.take(0, &block, 0, &relations, &start);
        let mut strains = Vec::new();
        answers.strains(0, &turns, &mut strains);
        for (i, (turn, s)) in turns.iter().zip(&relations).enumerate() {
            let shift = [0.4, of_plane(1.0), -0.3];
            let row = |r: usize| s[r][0] * turn[0] + s[r][1] * turn[1] + s[r][2] * turn[2] + s[r][3];
            let moment = if kind.plane {
                Vector3::new(0.0, s[0][0] * turn[1] + s[0][3], 0.0)
            } else {
                Vector3::new(row(0), row(1), row(2))
            };
            let force = start[i].force.cross(&Vector3::from(*turn));
            let wrench = Wrench::new(moment, force).to_vector();
            let zeta = Twist::new(Vector3::from(*turn), Vector3::from(shift)).to_vector();
            let t = alone.transfer(i);
            let next = t.zeta_from_zeta * zeta + t.zeta_from_wrench * wrench + t.zeta;
            let carried = t.wrench_from_zeta * zeta + t.wrench_from_wrench * wrench + t.wrench;
            let answer = answers.of(i, turn, &shift);
            let mut expected = vec![(zeta, wrench); i + 1];
            expected[i] = (zeta, wrench);
            let mut all = Vec::new();
            alone.strain_steps(&expected, &mut all);
            // as for the columns, of which these are sums
            let near = |a: f64, b: f64, size: f64| {
                assert!((a - b).abs() < 1e-11 * size, "S = {S}, {kind:?}: {a} {b}")
            };
            for r in 0..3 {
                near(answer.turn[r], next[r], next.norm());
                near(answer.shift[r], next[3 + r], next.norm());
                near(answer.moment[r], carried[r], carried.norm());
            }
            for (a, b) in strains[i].iter().zip(&all[i]) {
                let size = b.to_vector().norm();
                for (a, b) in a.to_array().into_iter().zip(b.to_array()) {
                    near(a, b, size);
                }
            }
        }
    }
}

#[test]
fn what_an_element_answers_is_what_its_columns_say() {
    answers_agree::<1>();
    answers_agree::<2>();
    answers_agree::<3>();
}

#[test]
fn wrenches_in_the_plane_are_those_in_space() {
    let (table, mut seed) = (Collocation::<3>::gauss(), 29);
    for loads in [Loads::None, Loads::Dead] {
        let kind = Kind { constraint: Constraint::planar(), plane: true, loads };
        for _ in 0..20 {
            let Case { kinematics, end, load, h, .. } = case(&table, &mut seed, &kind);
            let (mut space, mut plane) = ([Wrench::zero(); 3], [Wrench::zero(); 3]);
            let start = if let Some(load) = &load {
                let node_loads = kinematics.at_node(&load.map(|load| load.wrench));
                let start = kinematics.wrench_at_start(&table, &end, &node_loads, h);
                space = kinematics.stage_wrenches(&table, &start, &node_loads, h);
                start
            } else {
                kinematics.wrenches_without_load(&end, &mut space)
            };
            let force = |load: [LoadWrench; 3]| {
                std::array::from_fn(|k| kinematics.stage[k].rotation * load[k].wrench.force)
            };
            let forces = load.map(force);
            let forces = forces.as_ref().map(|forces| (h, forces));
            let starts = [start, planar::wrenches(&table, &kinematics, &end, forces, &mut plane)];
            let size = starts[0].to_vector().norm() + if load.is_some() { 1.0 } else { 0.0 };
            let pairs = space.iter().zip(&plane).chain([(&starts[0], &starts[1])]);
            for (a, b) in pairs {
                let error = (*a - *b).to_vector().norm();
                // a dozen roundings
                assert!(error < 1e-15 * 5.0 * size.max(end.to_vector().norm()), "{error:.1e} of {size:.1e}");
            }
        }
    }
}
