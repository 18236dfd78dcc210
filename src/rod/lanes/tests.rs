//! Lanes against the elements done alone.

use nalgebra::{Matrix6, SMatrix, Vector6};

use super::*;
use crate::rod::condense::Condensed;
use crate::rod::element::ElementState;

/// One element and all that its linearisation needs.
struct Case<const S: usize> {
    h: f64,
    xi: [Twist; S],
    response: [Response; S],
    start: Wrench,
}

/// Reproducible numbers in (−1, 1).
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Stretched, sheared, bent by some 3/L, stiffnesses positive definite with every coupling.
fn case<const S: usize>(seed: &mut u64) -> Case<S> {
    let xi = [3.0, 3.0, 3.0, 0.1, 0.1, 0.1];
    let xi =
        std::array::from_fn(|_| Twist::from_array(xi.map(|size| size * noise(seed))) + Twist::straight());
    let response = std::array::from_fn(|_| {
        let factor: Matrix6<f64> = SMatrix::from_fn(|_, _| 0.3 * noise(seed)) + Matrix6::identity();
        let scale = Matrix6::from_diagonal(&Vector6::from([1.0, 1.0, 1.0, 30.0, 30.0, 30.0]));
        let tangent = scale * factor * factor.transpose() * scale;
        let tangent = 0.5 * (tangent + tangent.transpose());
        let wrench = Wrench::from_array([1.0; 6].map(|size| size * noise(seed)));
        Response { wrench, tangent, ..Response::zero() }
    });
    let start = Wrench::from_array([1.0; 6].map(|size| size * noise(seed)));
    Case { h: 0.3 + 0.1 * noise(seed), xi, response, start }
}

fn alone<const S: usize>(table: &Collocation<S>, case: &Case<S>) -> (Kinematics<f64, S>, Condensed<S>) {
    let kinematics = Kinematics::new(table, &case.xi, case.h);
    let (stage_wrench, end) = kinematics.wrenches_from_start(table, &case.start, None, case.h);
    let state = ElementState {
        h: case.h,
        xi: case.xi,
        kinematics: &kinematics,
        response: &case.response,
        stage_wrench: &stage_wrench,
        wrench_at_end: &end,
        load: None,
        constraint: crate::body::Constraint::none(),
    };
    let mut condensed = Condensed::empty();
    condensed.fill_general(table, &state).unwrap();
    (kinematics, condensed)
}

/// Kinematics and condensation of some elements, in one block.
fn in_lanes<const S: usize>(
    table: &Collocation<S>,
    cases: &[&Case<S>],
) -> Vec<(Kinematics<f64, S>, Condensed<S>)> {
    let nothing = Kinematics { stage: [Pose::identity(); S], end: Pose::identity() };
    let (mut state, mut out) = (Linearised::new(), Eliminated::new());
    let mut motions = vec![nothing; cases.len()];
    for (i, case) in cases.iter().enumerate() {
        state.set(i, (case.h, &case.xi), &case.response, &case.start);
    }
    kinematics(table, &state.twists, &mut motions);
    condense(table, &state, cases.len(), &mut out);
    let taken = motions.into_iter().enumerate().map(|(i, motion)| {
        let mut condensed = Condensed::empty();
        condensed.take(&out, i, &motion.end).unwrap();
        (motion, condensed)
    });
    taken.collect()
}

fn numbers<const S: usize>((motion, condensed): &(Kinematics<f64, S>, Condensed<S>)) -> [Vec<f64>; 3] {
    let mut poses = Vec::new();
    for pose in motion.stage.iter().chain([&motion.end]) {
        poses.extend(pose.rotation.iter().chain(&pose.position));
    }
    let t = &condensed.transfer;
    let blocks = [&t.zeta_from_zeta, &t.zeta_from_wrench, &t.wrench_from_zeta, &t.wrench_from_wrench];
    let transfer = blocks.iter().flat_map(|m| m.iter()).chain(&t.zeta).chain(&t.wrench).copied().collect();
    let mut strains = Vec::new();
    for c in 0..=6 {
        let wrench = Vector6::from_fn(|r, _| if r == c { 1.0 } else { 0.0 });
        let steps = condensed.strain_step(&Vector6::zeros(), &wrench);
        strains.extend(steps.iter().flat_map(|strain| strain.to_array()));
    }
    [poses, transfer, strains]
}

fn agrees<const S: usize>() {
    let (table, mut seed) = (Collocation::<S>::gauss(), 7);
    for _ in 0..20 {
        let cases: Vec<Case<S>> = (0..ELEMENTS).map(|_| case(&mut seed)).collect();
        let lanes = in_lanes(&table, &cases.iter().collect::<Vec<_>>());
        for (case, lane) in cases.iter().zip(&lanes) {
            for (one, other) in numbers(&alone(&table, case)).iter().zip(numbers(lane)) {
                let size = one.iter().fold(0.0_f64, |size, v| size.max(v.abs()));
                let error = one.iter().zip(other).fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()));
                // eighteen equations of condition 1e3 or so, as with one element by two eliminations
                assert!(error < 1e-12 * size, "S = {S}: {error:.1e} of {size:.1e}");
            }
        }
    }
}

#[test]
fn an_element_in_a_lane_is_the_element_alone() {
    agrees::<1>();
    agrees::<2>();
    agrees::<3>();
}

#[test]
fn an_element_is_the_same_to_the_bit_whatever_its_block() {
    let (table, mut seed) = (Collocation::<3>::gauss(), 11);
    let cases: Vec<Case<3>> = (0..ELEMENTS).map(|_| case(&mut seed)).collect();
    let all = in_lanes(&table, &cases.iter().collect::<Vec<_>>());
    for (i, one) in cases.iter().enumerate() {
        let first = numbers(&all[i]);
        let alone = in_lanes(&table, &[one]);
        let last = in_lanes(&table, &[&cases[0], &cases[1], &cases[2], &cases[3], &cases[4], one]);
        for other in [&alone[0], &last[5]] {
            assert!(first == numbers(other), "element {i}");
        }
    }
}

/// Without pivoting a singular pivot must be noticed; the element alone then has a solution all the same.
#[test]
fn a_pivot_that_vanishes_makes_its_lane_suspect_and_no_other() {
    let (table, mut seed) = (Collocation::<2>::gauss(), 13);
    let mut cases: Vec<Case<2>> = (0..3).map(|_| case(&mut seed)).collect();
    // no stiffness against shear and extension at a stage
    for i in 3..6 {
        for j in 0..6 {
            cases[1].response[0].tangent[(i, j)] = 0.0;
            cases[1].response[0].tangent[(j, i)] = 0.0;
        }
    }
    let (mut state, mut out) = (Linearised::new(), Eliminated::new());
    for (i, case) in cases.iter().enumerate() {
        state.set(i, (case.h, &case.xi), &case.response, &case.start);
    }
    condense(&table, &state, cases.len(), &mut out);
    assert_eq!([0, 1, 2].map(|i| out.is_sound(i)), [true, false, true]);
}
