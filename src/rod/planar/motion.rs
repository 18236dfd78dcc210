//! The kernel of the kinematics in the plane.

use nalgebra::{Matrix3, Vector3};

use super::magnus::{exp, exponent, taylor_data};
use super::rows::{Twists, store_pose};
use crate::lie::{Pose, Twist, Wrench};
use crate::rod::collocation::Collocation;
use crate::rod::element::Kinematics;
use crate::rod::lanes::{NOTHING, Row, STAGES, Table, run, stumpff};
use crate::scalar::{Kernel, Lane};

/// cos θ, sin θ, p_z and p_x of stages and end.
struct Motions {
    pose: [[Row; 4]; STAGES + 1],
    suspect: Row,
}

struct Move<'a> {
    table: &'a Table,
    twists: &'a Twists,
    count: usize,
    out: &'a mut Motions,
}

impl Kernel for Move<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { table, twists, count, out } = self;
        for at in (0..count).step_by(L::LANES) {
            let mut suspect = L::splat(0.0);
            for k in 0..=table.stages {
                let alpha = taylor_data::<L>(&table.taylor[k], twists, table.stages, at);
                let omega = exponent(&alpha, table.stages);
                let c = stumpff(omega.angular * omega.angular, &mut suspect);
                let pose = exp(&omega, &c);
                store_pose(&pose, &mut out.pose[k], at);
            }
            suspect.store(&mut out.suspect[at..]);
        }
    }
}

/// As [`lanes::kinematics`](crate::rod::lanes::kinematics), for elements in the plane: lengths and twists.
pub(crate) fn kinematics<const S: usize>(
    table: &Collocation<S>,
    elements: impl Fn(usize) -> (f64, [Twist; S]),
    into: &mut [Kinematics<f64, S>],
) {
    let mut twists = Twists::new();
    for i in 0..into.len() {
        let (h, xi) = elements(i);
        twists.set(i, h, &xi);
    }
    let mut out = Motions { pose: [[NOTHING; 4]; STAGES + 1], suspect: NOTHING };
    move_block(&Table::of(table), &twists, into.len(), &mut out);
    for (i, into) in into.iter_mut().enumerate() {
        if out.suspect[i] != 0.0 {
            let (h, xi) = elements(i);
            *into = Kinematics::new(table, &xi, h);
            continue;
        }
        for (pose, rows) in into.stage.iter_mut().zip(&out.pose) {
            *pose = pose_of(rows, i);
        }
        into.end = pose_of(&out.pose[S], i);
    }
}

/// Λ_i, and Λ_k into `stage`, from the wrench at the end of an element in the plane; `forces` are those of dead loads, in the frame of the first node.
pub(crate) fn wrenches<const S: usize>(
    table: &Collocation<S>,
    motion: &Kinematics<f64, S>,
    at_end: &Wrench,
    forces: Option<(f64, &[Vector3<f64>; S])>,
    stage: &mut [Wrench; S],
) -> Wrench {
    let lever = |p: &Vector3<f64>, z: f64, x: f64| p.z * x - p.x * z;
    let mut loads = [[0.0; 3]; S];
    if let Some((h, forces)) = forces {
        for ((load, force), pose) in loads.iter_mut().zip(forces).zip(&motion.stage) {
            let (z, x) = (h * force.z, h * force.x);
            *load = [lever(&pose.position, z, x), z, x];
        }
    }
    let rotation = |pose: &Pose| (pose.rotation[(0, 0)], pose.rotation[(0, 2)]);
    let wrench = |moment, z, x| Wrench::new(Vector3::new(0.0, moment, 0.0), Vector3::new(x, 0.0, z));
    let ((cos, sin), p) = (rotation(&motion.end), &motion.end.position);
    let (z, x) = (cos * at_end.force.z - sin * at_end.force.x, cos * at_end.force.x + sin * at_end.force.z);
    let mut start = [at_end.moment.y + lever(p, z, x), z, x];
    if forces.is_some() {
        start = less(start, &loads, &table.b.map(|b| -b));
    }
    for (k, (stage, pose)) in stage.iter_mut().zip(&motion.stage).enumerate() {
        let ((cos, sin), p) = (rotation(pose), &pose.position);
        let [moment, z, x] = if forces.is_some() { less(start, &loads, &table.a[k]) } else { start };
        *stage = wrench(moment - lever(p, z, x), cos * z + sin * x, cos * x - sin * z);
    }
    wrench(start[0], start[1], start[2])
}

/// `sum` − Σ weight × load.
#[inline(always)]
fn less<const S: usize>(mut sum: [f64; 3], loads: &[[f64; 3]; S], weights: &[f64; S]) -> [f64; 3] {
    for (load, weight) in loads.iter().zip(weights) {
        for r in 0..3 {
            sum[r] -= weight * load[r];
        }
    }
    sum
}

#[inline(never)]
fn move_block(table: &Table, twists: &Twists, count: usize, out: &mut Motions) {
    run(Move { table, twists, count, out }, count);
}

/// The pose in space of cos θ, sin θ, p_z and p_x.
#[inline(always)]
pub(in crate::rod) fn pose_of(rows: &[Row; 4], i: usize) -> Pose {
    let [cos, sin, z, x] = rows.each_ref().map(|row| row[i]);
    let rotation = Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos);
    Pose::new(rotation, Vector3::new(x, 0.0, z))
}
