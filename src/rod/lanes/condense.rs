//! The kernel of the condensation: eight loadless elements linearised and their stage strains eliminated.

use super::algebra::{Map, Matrix, Pair, add_scaled, cross, cross_columns, dot, transpose_times, zeros};
use super::eliminate::{System, add_end, invert_definite};
use super::magnus::{Placed, dexp_minus, exp, exponent, exponent_derivative, stumpff, taylor_data};
use super::rows::{
    BlockRows, COLUMNS, MapRows, NO_MATRIX, Row, load_map, load_pair, store_columns, store_map, store_matrix,
};
use super::{Linearised, STAGES, Table};
use crate::scalar::{Kernel, Lane};

/// What is worked with on the way.
#[derive(Clone)]
pub(super) struct Scratch {
    /// Body displacement of a stage, or of the end, per change of the stage strains.
    variation: [MapRows; STAGES],
    system: System,
}

impl Scratch {
    pub(super) fn new() -> Self {
        Self { variation: [[NO_MATRIX; 2]; STAGES], system: System::new() }
    }
}

/// Where the results go, as in [`Eliminated`](super::Eliminated).
pub(super) struct Out<'a> {
    pub(super) strain: &'a mut [[BlockRows; 2]; STAGES],
    pub(super) end: &'a mut [BlockRows; 4],
    pub(super) suspect: &'a mut Row,
}

pub(super) struct Condense<'a> {
    pub(super) table: &'a Table,
    pub(super) state: &'a Linearised,
    /// Elements in use.
    pub(super) count: usize,
    pub(super) scratch: &'a mut Scratch,
    pub(super) out: Out<'a>,
}

impl Kernel for Condense<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { table, state, count, scratch, mut out } = self;
        for at in (0..count).step_by(L::LANES) {
            let start = load_pair::<L>(&state.wrench_at_start, at);
            let mut suspect = L::splat(0.0);
            // one loop, so that what is long is compiled once
            for k in 0..=table.stages {
                let pose = vary(table, k, state, at, &mut scratch.variation, &mut suspect);
                let wrench = carried(&pose, &start);
                if k < table.stages {
                    assemble(table.stages, k, (&pose, &wrench), state, at, scratch, &mut out, &mut suspect);
                } else {
                    scratch.system.solve(out.strain, table.stages, at, &mut suspect);
                    finish(table.stages, &wrench, at, scratch, &mut out);
                }
            }
            suspect.store(&mut out.suspect[at..]);
        }
    }
}

/// The pose at a stage or the end; its body displacements dexp₋Ω ∂Ω/∂ξ_l = h Σ_j t_jl dexp₋Ω ∂Ω/∂α_j go into `variation`.
#[inline(always)]
fn vary<L: Lane>(
    table: &Table,
    k: usize,
    state: &Linearised,
    at: usize,
    variation: &mut [MapRows; STAGES],
    suspect: &mut L,
) -> Placed<L> {
    let t = &table.taylor[k];
    let alpha = taylor_data::<L>(t, &state.twists, table.stages, at);
    let omega = exponent(&alpha, table.stages);
    let c = stumpff(dot(&omega.first, &omega.first), suspect);
    let dexp = dexp_minus(&omega, &c);
    let h = L::load(&state.twists.h[at..]);
    let derivative = exponent_derivative(&alpha, table.stages);
    for j in 0..table.stages {
        let turned = dexp.times(&derivative[j]);
        for l in 0..table.stages {
            let mut sum =
                if j == 0 { Map { diagonal: zeros(), lower: zeros() } } else { load_map(&variation[l], at) };
            sum.add(h * L::splat(t[j][l]), &turned);
            store_map(&sum, &mut variation[l], at);
        }
    }
    exp(&omega, &c)
}

/// K_k δξ_k − L(Λ_k) Σ_l B_kl δξ_l = −r_k + Ad_kᵀ δΛ_i.
#[inline(always)]
#[allow(clippy::too_many_arguments)] // one place, inlined
fn assemble<L: Lane>(
    stages: usize,
    k: usize,
    (pose, wrench): (&Placed<L>, &Pair<L>),
    state: &Linearised,
    at: usize,
    scratch: &mut Scratch,
    out: &mut Out<'_>,
    suspect: &mut L,
) {
    let system = &mut scratch.system;
    let [angular, coupling, linear] = load_stiffness::<L>(&state.tangent[k], at);
    store_matrix(&invert_definite(&linear, suspect), &mut system.flexibility[k], at);
    for l in 0..stages {
        let map = load_map::<L>(&scratch.variation[l], at);
        let turned = cross_columns(&wrench.second, &map.diagonal);
        let by_moment = cross_columns(&wrench.first, &map.diagonal);
        let by_force = cross_columns(&wrench.second, &map.lower);
        // K at the stage itself
        let own = L::splat(if k == l { 1.0 } else { 0.0 });
        let (mut a, mut b, mut c) = (zeros::<L>(), zeros::<L>(), zeros::<L>());
        for i in 0..3 {
            for j in 0..3 {
                a[i][j] = own.mul_add(angular[i][j], -(by_moment[i][j] + by_force[i][j]));
                b[i][j] = own.mul_add(coupling[i][j], -turned[i][j]);
                c[i][j] = own.mul_add(coupling[j][i], -turned[i][j]);
            }
        }
        store_matrix(&a, &mut system.angular[k][l], at);
        store_matrix(&b, &mut system.from_linear[k][l], at);
        store_matrix(&c, &mut system.to_linear[k][l], at);
    }
    let psi = load_pair::<L>(&state.internal[k], at);
    // Ad_kᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]
    let lever = cross_columns(&pose.position, &pose.rotation);
    let mut angular = [[L::splat(0.0); COLUMNS]; 3];
    let mut linear = [[L::splat(0.0); 4]; 3];
    for r in 0..3 {
        for c in 0..3 {
            angular[r][c] = pose.rotation[c][r];
            angular[r][3 + c] = lever[c][r];
            linear[r][c] = pose.rotation[c][r];
        }
        angular[r][6] = wrench.first[r] - psi.first[r];
        linear[r][3] = wrench.second[r] - psi.second[r];
    }
    store_columns(&angular, &mut out.strain[k][0], 0, at);
    store_columns(&linear, &mut out.strain[k][1], 3, at);
}

/// Ad_gᵀ Λ = (Rᵀ(m − p × n), Rᵀ n).
#[inline(always)]
fn carried<L: Lane>(pose: &Placed<L>, wrench: &Pair<L>) -> Pair<L> {
    let lever = cross(&pose.position, &wrench.second);
    let moment = add_scaled(&wrench.first, L::splat(-1.0), &lever);
    Pair {
        first: transpose_times(&pose.rotation, &moment),
        second: transpose_times(&pose.rotation, &wrench.second),
    }
}

/// The blocks of K from the rows of its lower triangle: angular–angular, angular–linear, linear–linear.
#[inline(always)]
fn load_stiffness<L: Lane>(triangle: &[Row; 21], at: usize) -> [Matrix<L>; 3] {
    let mut blocks = [zeros(); 3];
    for r in 0..3 {
        for c in 0..3 {
            let (low, high) = if r < c { (r, c) } else { (c, r) };
            blocks[0][r][c] = L::load(&triangle[super::packed(high, low)][at..]);
            blocks[1][r][c] = L::load(&triangle[super::packed(3 + c, r)][at..]);
            blocks[2][r][c] = L::load(&triangle[super::packed(3 + high, 3 + low)][at..]);
        }
    }
    blocks
}

/// ζ_{i+1} = (w, v) and L(Λ_{i+1}) ζ_{i+1} = (m × w + n × v, n × w), as far as the strains make them.
#[inline(always)]
fn finish<L: Lane>(stages: usize, wrench: &Pair<L>, at: usize, scratch: &Scratch, out: &mut Out<'_>) {
    let mut zeta = [[[L::splat(0.0); COLUMNS]; 3]; 2];
    for l in 0..stages {
        add_end(&mut zeta, &load_map(&scratch.variation[l], at), &out.strain[l], at);
    }
    let [w, v] = zeta;
    let mut moment = cross_columns(&wrench.first, &w);
    let by_force = cross_columns(&wrench.second, &v);
    for r in 0..3 {
        for c in 0..COLUMNS {
            moment[r][c] = moment[r][c] + by_force[r][c];
        }
    }
    let force = cross_columns(&wrench.second, &w);
    store_columns(&w, &mut out.end[0], 0, at);
    store_columns(&v, &mut out.end[1], 0, at);
    store_columns(&moment, &mut out.end[2], 0, at);
    store_columns(&force, &mut out.end[3], 0, at);
}
