//! The kernel of the condensation: eight elements linearised and their stage strains eliminated.

use super::algebra::{Map, Matrix, Pair, cross_columns, dot, zeros};
use super::eliminate::{System, add_end, invert_free};
use super::linearised::Linearised;
use super::loads::Terms;
use super::magnus::{Placed, dexp_minus, exp, exponent, exponent_derivative, stumpff, taylor_data};
use super::rows::{
    BlockRows, COLUMNS, LOADLESS, MapRows, NO_MATRIX, NOTHING, Row, load_map, load_pair, store_columns,
    store_map, store_matrix,
};
use super::{STAGES, Table};
use crate::scalar::{Kernel, Lane};

/// What is worked with on the way.
#[derive(Clone)]
pub(super) struct Scratch {
    /// Body displacement of a stage, or of the end, per change of the stage strains.
    variation: [MapRows; STAGES],
    pose: [[Row; 12]; STAGES + 1],
    system: System,
    terms: Terms,
}

impl Scratch {
    pub(super) fn new() -> Self {
        Self {
            variation: [[NO_MATRIX; 2]; STAGES],
            pose: [[NOTHING; 12]; STAGES + 1],
            system: System::new(),
            terms: Terms::new(),
        }
    }
}

/// Where the results go, as in [`Eliminated`](super::Eliminated).
pub(super) struct Out<'a> {
    pub(super) strain: &'a mut [[BlockRows; 2]; STAGES],
    pub(super) end: &'a mut [BlockRows; 4],
    pub(super) pose: &'a mut [Row; 12],
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
        let (stages, soft) = (table.stages, !state.is_stiff());
        for at in (0..count).step_by(L::LANES) {
            let start = load_pair::<L>(&state.wrench_at_start, at);
            let mut suspect = L::splat(0.0);
            // one loop, so that what is long is compiled once
            for k in 0..=stages {
                let pose = vary(table, k, state, at, &mut scratch.variation, &mut suspect);
                let wrench =
                    if state.loaded { load_pair(&state.loads.internal[k], at) } else { pose.carry(&start) };
                if state.loaded {
                    pose.store(&mut scratch.pose[k], at);
                }
                if k < stages {
                    assemble(stages, k, (&pose, &wrench), state, at, scratch, &mut out, &mut suspect);
                    if state.loaded {
                        scratch.terms.set(stages, k, &pose, &scratch.variation, state, at);
                    }
                    continue;
                }
                pose.store(out.pose, at);
                if state.loaded {
                    let h = L::load(&state.twists.h[at..]);
                    scratch.terms.add(table, &scratch.pose, (h, soft), &mut scratch.system, out.strain, at);
                }
                if state.fixed[..3] != [false; 3] {
                    scratch.system.fix(&state.fixed, stages, out.strain);
                }
                scratch.system.solve(out.strain, stages, (soft, state.loaded), at, &mut suspect);
                finish_columns::<L, LOADLESS>(
                    (stages, soft),
                    &wrench,
                    0,
                    at,
                    scratch,
                    state.loaded,
                    &mut out,
                );
                if state.loaded {
                    const TURN: usize = COLUMNS - LOADLESS;
                    finish_columns::<L, TURN>((stages, soft), &wrench, LOADLESS, at, scratch, true, &mut out);
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
    let soft = !state.is_stiff();
    if soft {
        store_matrix(&invert_free(&linear, &state.fixed, suspect), &mut system.flexibility[k], at);
    }
    for l in 0..stages {
        let map = load_map::<L>(&scratch.variation[l], at);
        let by_moment = cross_columns(&wrench.first, &map.diagonal);
        let by_force = cross_columns(&wrench.second, &map.lower);
        // K at the stage itself
        let own = L::splat(if k == l { 1.0 } else { 0.0 });
        let mut a = zeros::<L>();
        for i in 0..3 {
            for j in 0..3 {
                a[i][j] = own.mul_add(angular[i][j], -(by_moment[i][j] + by_force[i][j]));
            }
        }
        store_matrix(&a, &mut system.angular[k][l], at);
        if soft {
            let turned = cross_columns(&wrench.second, &map.diagonal);
            let (mut b, mut c) = (zeros::<L>(), zeros::<L>());
            for i in 0..3 {
                for j in 0..3 {
                    b[i][j] = own.mul_add(coupling[i][j], -turned[i][j]);
                    c[i][j] = own.mul_add(coupling[j][i], -turned[i][j]);
                }
            }
            store_matrix(&b, &mut system.from_linear[k][l], at);
            store_matrix(&c, &mut system.to_linear[k][l], at);
        }
    }
    let psi = load_pair::<L>(&state.internal[k], at);
    // Ad_kᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]
    let lever = cross_columns(&pose.position, &pose.rotation);
    let mut angular = [[L::splat(0.0); LOADLESS]; 3];
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

/// ζ_{i+1} = (w, v) and L(Λ_{i+1}) ζ_{i+1} = (m × w + n × v, n × w), as far as the strains make them, less the loads.
#[inline(always)]
fn finish_columns<L: Lane, const C: usize>(
    (stages, soft): (usize, bool),
    wrench: &Pair<L>,
    from: usize,
    at: usize,
    scratch: &Scratch,
    loaded: bool,
    out: &mut Out<'_>,
) {
    let mut zeta = [[[L::splat(0.0); C]; 3]; 2];
    for l in 0..stages {
        add_end(&mut zeta, &load_map(&scratch.variation[l], at), soft, &out.strain[l], from, at);
    }
    let [w, v] = zeta;
    let mut moment = cross_columns(&wrench.first, &w);
    let by_force = cross_columns(&wrench.second, &v);
    for r in 0..3 {
        for c in 0..C {
            moment[r][c] = moment[r][c] + by_force[r][c];
        }
    }
    let mut made = [moment, cross_columns(&wrench.second, &w)];
    if loaded {
        scratch.terms.take_from_end((stages, soft), out.strain, from, &mut made, at);
        if from == LOADLESS {
            scratch.terms.take_turn(&mut made, at);
        }
    }
    store_columns(&w, &mut out.end[0], from, at);
    store_columns(&v, &mut out.end[1], from, at);
    store_columns(&made[0], &mut out.end[2], from, at);
    store_columns(&made[1], &mut out.end[3], from, at);
}
