//! The strong form marched from the base to the tip, with a search for the wrench at the base, against collocation.
//!
//! `cargo run --release --example march`
//!
//! ξ′ comes from [`Rod::strain_rate`]; it is integrated by extrapolation (Gragg, Bulirsch and Stoer) of order 12. Newton's method finds the wrench at the base that arrives at
//! the load on the tip. What both methods share is the section; one uses its Ψ′ and balance in differential form, the other neither.
//! `-- --quick` takes a mesh half as fine.
#![allow(clippy::print_stdout)]

use hyperrod::body::Elastic;
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::{NeoHookean, Request};
use hyperrod::num_dual::Dual64;
use hyperrod::rod::SectionState;
use hyperrod::section::{Circle, Converging, CrossSection, Helical, Linear, Section, Tendon};
use hyperrod::solve::{Node, Order};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Strain, Twist, Wrench};
use nalgebra::{Matrix3, Matrix6, SVector, Vector3, Vector6, vector};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

const LENGTH: f64 = 0.3;
const TAPER: Linear = Linear { from: 0.02, to: 0.012, length: LENGTH };
const TIP_FORCE: Vector3<f64> = vector![1.0, 0.6, -0.3];

fn main() -> Outcome<()> {
    let quick = std::env::args().any(|a| a == "--quick");
    let elements = if quick { 32 } else { 64 };
    let law = NeoHookean::new(2e5, 3e5)?;
    let section = || Section::new(Circle::new(TAPER), law);

    let heavy = Body::new(LENGTH, section()?)?.with_density(1100.0)?;
    let heavy = Rod::clamped(heavy, Pose::identity()).with_load(Gravity::new(vector![2.0, -9.0, 1.0])?);

    let helix = Tendon::new(Helical { radius: 9e-3, pitch: 0.4, start: 0.3 }, 6.0)?;
    let converging = Converging { from: [0.0, 0.012], to: [0.004, 0.002], length: LENGTH };
    let driven = section()?.with_actuator(helix).with_actuator(Tendon::new(converging, 9.0)?);
    let driven = Rod::clamped(Body::new(LENGTH, driven)?, Pose::identity());

    let reference = |s: Dual64| {
        let (one, zero) = (Dual64::from_re(1.0), Dual64::from_re(0.0));
        Twist::from_array([s * 6.0 + 1.0, s * s * 20.0 - 2.0, one * 0.5, zero, zero, s * 0.1 + 1.0])
    };
    let curved = Body::new(LENGTH, section()?)?.with_varying_reference(reference)?;
    let curved = Rod::clamped(curved, Pose::identity());

    println!(
        "{:<28}{:>12}{:>12}{:>12}{:>12}{:>12}",
        "rod", "position/L", "rotation", "wrench", "strain", "condition"
    );
    let worst = [
        meet("tapered, under gravity", heavy, elements)?,
        meet("driven by tendons", driven, elements)?,
        meet("curved at rest", curved, elements)?,
    ];
    println!("march: worst difference {:.1e}", worst.into_iter().fold(0.0, f64::max));
    Ok(())
}

/// Solves both ways, prints the differences, and returns the largest.
fn meet<B: Elastic>(name: &str, rod: Rod<B>, elements: usize) -> Outcome<f64> {
    let rod = rod.with_tip_load(DeadWrench::force(TIP_FORCE)?);
    let statics = Statics { elements, order: Order::Six, tolerance: 1e-10, ..Statics::default() };
    let solution = statics.solve(&rod)?;
    // nothing of the solution but the places where to compare, and a start 20 % off
    let start = solution.base().wrench * 0.8;
    let marched = shoot(&rod, &solution, start)?;
    let mut differences = [0.0_f64; 4];
    let size = |w: &Wrench| w.force.norm().max(w.moment.norm() / LENGTH);
    let largest = solution.nodes().iter().map(|n| size(&n.wrench)).fold(0.0, f64::max);
    for (node, state) in solution.nodes().iter().zip(&marched.states) {
        let pose = pose(state);
        let wrench = rod.body().respond(node.s, &strain(state), Request::Wrench)?.wrench;
        let strain = node.strain - strain(state);
        let own = [
            (pose.position - node.pose.position).norm() / LENGTH,
            (pose.rotation - node.pose.rotation).norm(),
            size(&(wrench - node.wrench)) / largest,
            strain.linear.norm().max(strain.angular.norm() * LENGTH),
        ];
        for (difference, own) in differences.iter_mut().zip(own) {
            *difference = difference.max(own);
        }
    }
    let [position, rotation, wrench, strain] = differences;
    let condition = marched.condition;
    println!("{name:<28}{position:>12.1e}{rotation:>12.1e}{wrench:>12.1e}{strain:>12.1e}{condition:>12.1e}");
    Ok(differences.into_iter().fold(0.0, f64::max))
}

/// R by columns, p, Δξ.
type State = SVector<f64, 18>;

fn pose(state: &State) -> Pose {
    Pose::new(Matrix3::from_fn(|r, c| state[r + 3 * c]), state.fixed_rows::<3>(9).into())
}

fn strain(state: &State) -> Strain {
    Strain::from_vector(&state.fixed_rows::<6>(12).into())
}

/// R′ = R ω^, p′ = R ν, and the strong form; also its condition.
fn slope<B: Elastic>(rod: &Rod<B>, s: f64, state: &State) -> hyperrod::Result<(State, f64)> {
    let (pose, strain) = (pose(state), strain(state));
    let xi = rod.body().reference(s).twist + strain;
    let rate = rod.strain_rate(&SectionState { s, pose, strain, motion: None })?;
    let turn = pose.rotation * hyperrod::lie::so3::hat(&xi.angular);
    let mut slope = State::zeros();
    slope.fixed_rows_mut::<9>(0).copy_from_slice(turn.as_slice());
    slope.fixed_rows_mut::<3>(9).copy_from(&(pose.rotation * xi.linear));
    slope.fixed_rows_mut::<6>(12).copy_from(&rate.strain.to_vector());
    Ok((slope, rate.condition))
}

/// One step by modified midpoint rules of 2, 4, …, 12 parts, extrapolated in h².
///
/// Source: Hairer, Nørsett and Wanner (1993), *Solving Ordinary Differential Equations I*, II.9.
fn step<B: Elastic>(rod: &Rod<B>, s: f64, h: f64, state: &State) -> hyperrod::Result<State> {
    const LEVELS: usize = 6;
    let parts = |level: usize| 2 * (level + 1);
    let mut row: Vec<State> = Vec::with_capacity(LEVELS);
    for level in 0..LEVELS {
        let n = parts(level);
        let part = h / n as f64;
        let (mut before, mut now) = (*state, state + slope(rod, s, state)?.0 * part);
        for i in 1..n {
            let next = before + slope(rod, s + i as f64 * part, &now)?.0 * (2.0 * part);
            (before, now) = (now, next);
        }
        // Neville's scheme in place
        let mut value = now;
        for k in 1..=level {
            let ratio = (n as f64 / parts(level - k) as f64).powi(2);
            let lower = row[k - 1];
            row[k - 1] = value;
            value += (value - lower) / (ratio - 1.0);
        }
        row.push(value);
    }
    Ok(row[LEVELS - 1])
}

struct Marched {
    states: Vec<State>,
    /// What must vanish: Ψ − Rᵀ F at the tip.
    miss: Vector6<f64>,
    condition: f64,
}

/// From the wrench at the base through all nodes.
fn march<B: Elastic>(rod: &Rod<B>, nodes: &[Node], base: &Wrench) -> Outcome<Marched> {
    let mut state = State::zeros();
    state.fixed_rows_mut::<9>(0).copy_from_slice(nodes[0].pose.rotation.as_slice());
    state.fixed_rows_mut::<3>(9).copy_from(&nodes[0].pose.position);
    state.fixed_rows_mut::<6>(12).copy_from(&strain_of(rod.body(), base)?.to_vector());
    let mut condition = slope(rod, 0.0, &state)?.1;
    let mut states = vec![state];
    for ends in nodes.windows(2) {
        state = step(rod, ends[0].s, ends[1].s - ends[0].s, &state)?;
        condition = condition.max(slope(rod, ends[1].s, &state)?.1);
        states.push(state);
    }
    let wrench = rod.body().respond(LENGTH, &strain(&state), Request::Wrench)?.wrench;
    let load = Wrench::new(Vector3::zeros(), pose(&state).rotation.tr_mul(&TIP_FORCE));
    Ok(Marched { states, miss: (wrench - load).to_vector(), condition })
}

/// Newton's method on the wrench at the base, derivatives by central differences.
fn shoot<B: Elastic>(rod: &Rod<B>, solution: &StaticSolution, start: Wrench) -> Outcome<Marched> {
    let nodes = solution.nodes();
    let mut base = start.to_vector();
    let size = base.norm();
    for _ in 0..12 {
        let marched = march(rod, nodes, &Wrench::from_vector(&base))?;
        let mut jacobian = Matrix6::zeros();
        for k in 0..6 {
            let mut small = Vector6::zeros();
            small[k] = 1e-5 * size;
            let miss = |base| march(rod, nodes, &Wrench::from_vector(&base)).map(|m| m.miss);
            jacobian.set_column(k, &((miss(base + small)? - miss(base - small)?) / (2.0 * small[k])));
        }
        let change = jacobian.lu().solve(&marched.miss).ok_or("the shooting is singular")?;
        base -= change;
        if change.norm() < 1e-11 * size {
            return march(rod, nodes, &Wrench::from_vector(&base));
        }
    }
    Err("the shooting did not converge".into())
}

/// Ψ(Δξ) = Λ at the base, by Newton's method.
fn strain_of<B: Elastic>(body: &B, wrench: &Wrench) -> Outcome<Strain> {
    let mut strain = Strain::zero();
    for _ in 0..30 {
        let response = body.respond(0.0, &strain, Request::Tangent)?;
        let miss = (*wrench - response.wrench).to_vector();
        let change = response.tangent.lu().solve(&miss).ok_or("the section has no stiffness")?;
        strain += Strain::from_vector(&change);
        if change.norm() < 1e-14 {
            return Ok(strain);
        }
    }
    Ok(strain)
}
