//! The kernel of the condensation: eight elements linearised and their stage strains eliminated.

use super::algebra::{Forms, Map, Matrix, Pair, add_multiple, cross_columns, dot, zeros};
use super::eliminate::{System, add_end, invert_free};
use super::linearised::Linearised;
use super::loads::{Moved, Terms};
use super::magnus::{
    Placed, dexp_minus, exp, exponent, exponent_derivative, forms_by_rotation, stumpff, taylor_data,
};
use super::rows::{
    BlockRows, COLUMNS, LOADLESS, MapRows, NO_MATRIX, NOTHING, Row, load_map, load_pair, store_columns,
    store_map, store_matrix,
};
use super::{STAGES, Table, Taylor};
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
                let place = Local::new(&table.taylor[k], state, stages, at, &mut suspect);
                let pose = place.pose;
                let wrench =
                    if state.loaded { load_pair(&state.loads.internal[k], at) } else { pose.carry(&start) };
                if soft || k == stages {
                    place.vary(table, k, at, &mut scratch.variation);
                }
                if state.loaded {
                    pose.store(&mut scratch.pose[k], at);
                }
                if k < stages {
                    if soft {
                        assemble(stages, k, (&pose, &wrench), state, at, scratch, &mut suspect);
                    } else {
                        place.assemble_stiff(table, k, &wrench, state, at, scratch);
                    }
                    begin_columns(k, (&pose, &wrench), state, at, &mut out);
                    if state.loaded && state.turning {
                        scratch.terms.set_turn(k, &pose, state, at);
                    }
                    continue;
                }
                pose.store(out.pose, at);
                if state.loaded {
                    let h = L::load(&state.twists.h[at..]);
                    let (terms, system) = (&mut scratch.terms, &mut scratch.system);
                    if state.turning {
                        terms.add(table, &scratch.pose, (h, soft), system, out.strain, at);
                    } else {
                        terms.add_dead(table, &scratch.pose, (h, soft, state), system, out.strain, at);
                    }
                }
                if state.fixed[..3] != [false; 3] {
                    scratch.system.fix(&state.fixed, stages, out.strain);
                }
                scratch.system.solve(out.strain, stages, (soft, state.loaded), at, &mut suspect);
                finish_columns::<L, LOADLESS>(stages, state, &wrench, 0, at, scratch, &mut out);
                if state.loaded {
                    const TURN: usize = COLUMNS - LOADLESS;
                    finish_columns::<L, TURN>(stages, state, &wrench, LOADLESS, at, scratch, &mut out);
                }
            }
            suspect.store(&mut out.suspect[at..]);
        }
    }
}

/// What a stage, or the end, has of the Magnus vector Ω.
struct Local<L> {
    h: L,
    alpha: [Pair<L>; STAGES],
    /// dexp₋Ω.
    dexp: Map<L>,
    pose: Placed<L>,
}

impl<L: Lane> Local<L> {
    #[inline(always)]
    fn new(t: &Taylor, state: &Linearised, stages: usize, at: usize, suspect: &mut L) -> Self {
        let alpha = taylor_data::<L>(t, &state.twists, stages, at);
        let omega = exponent(&alpha, stages);
        let c = stumpff(dot(&omega.first, &omega.first), suspect);
        let h = L::load(&state.twists.h[at..]);
        Self { h, alpha, dexp: dexp_minus(&omega, &c), pose: exp(&omega, &c) }
    }

    /// Body displacements dexp₋Ω ∂Ω/∂ξ_l = h Σ_j t_jl dexp₋Ω ∂Ω/∂α_j, into `variation`.
    #[inline(always)]
    fn vary(&self, table: &Table, k: usize, at: usize, variation: &mut [MapRows; STAGES]) {
        let derivative = exponent_derivative(&self.alpha, table.stages);
        for j in 0..table.stages {
            let turned = self.dexp.times(&derivative[j]);
            for l in 0..table.stages {
                let mut sum = if j == 0 {
                    Map { diagonal: zeros(), lower: zeros() }
                } else {
                    load_map(&variation[l], at)
                };
                sum.add(self.h * L::splat(table.taylor[k][j][l]), &turned);
                store_map(&sum, &mut variation[l], at);
            }
        }
    }

    /// K_k δω_k − L(Λ_k) Σ_l B_kl δω_l of a rod that neither shears nor stretches, and what its loads add: all that is made of B at a stage.
    #[inline(always)]
    fn assemble_stiff(
        &self,
        table: &Table,
        k: usize,
        wrench: &Pair<L>,
        state: &Linearised,
        at: usize,
        scratch: &mut Scratch,
    ) {
        let zero = zeros();
        let mut forms = [Forms::of_wrench(wrench); 3];
        let mut count = 1;
        if state.loaded {
            let moved = Moved::new(k, &self.pose, state, at);
            (forms[1], forms[2]) = (moved.moment, Forms { angular: moved.force, linear: zero });
            count = if state.turning { 3 } else { 2 };
        }
        // one loop, as in the kernel
        for (f, forms) in forms[..count].iter().enumerate() {
            let by_alpha = forms_by_rotation(&forms.times(&self.dexp), &self.alpha, table.stages);
            let h = if f == 0 { -self.h } else { self.h };
            for l in 0..table.stages {
                let mut sum = if f == 0 && k == l { load_bending(&state.tangent[k], at) } else { zero };
                for j in 0..table.stages {
                    sum = add_multiple(sum, h * L::splat(table.taylor[k][j][l]), &by_alpha[j]);
                }
                if f == 0 {
                    store_matrix(&sum, &mut scratch.system.angular[k][l], at);
                } else {
                    scratch.terms.set_by_rotation((k, l), f == 2, &sum, at);
                }
            }
        }
    }
}

/// K_k δξ_k − L(Λ_k) Σ_l B_kl δξ_l of a rod that shears or stretches, and what its loads add.
#[inline(always)]
fn assemble<L: Lane>(
    stages: usize,
    k: usize,
    (pose, wrench): (&Placed<L>, &Pair<L>),
    state: &Linearised,
    at: usize,
    scratch: &mut Scratch,
    suspect: &mut L,
) {
    let system = &mut scratch.system;
    let [angular, coupling, linear] = load_stiffness::<L>(&state.tangent[k], at);
    store_matrix(&invert_free(&linear, &state.fixed, suspect), &mut system.flexibility[k], at);
    for l in 0..stages {
        let map = load_map::<L>(&scratch.variation[l], at);
        let by_moment = cross_columns(&wrench.first, &map.diagonal);
        let by_force = cross_columns(&wrench.second, &map.lower);
        let turned = cross_columns(&wrench.second, &map.diagonal);
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
    if state.loaded {
        let moved = Moved::new(k, pose, state, at);
        scratch.terms.set(stages, k, &moved, &scratch.variation, state.turning, at);
    }
}

/// What that is equal to: −r_k + Ad_kᵀ δΛ_i.
#[inline(always)]
fn begin_columns<L: Lane>(
    k: usize,
    (pose, wrench): (&Placed<L>, &Pair<L>),
    state: &Linearised,
    at: usize,
    out: &mut Out<'_>,
) {
    let psi = load_pair::<L>(&state.internal[k], at);
    // Ad_kᵀ = [[Rᵀ, −Rᵀ p^], [0, Rᵀ]]
    let lever = cross_columns(&pose.position, &pose.rotation);
    let mut angular = [[L::splat(0.0); LOADLESS]; 3];
    for r in 0..3 {
        for c in 0..3 {
            angular[r][c] = pose.rotation[c][r];
            angular[r][3 + c] = lever[c][r];
        }
        angular[r][6] = wrench.first[r] - psi.first[r];
    }
    store_columns(&angular, &mut out.strain[k][0], 0, at);
    if state.is_stiff() {
        return;
    }
    let mut linear = [[L::splat(0.0); 4]; 3];
    for r in 0..3 {
        for c in 0..3 {
            linear[r][c] = pose.rotation[c][r];
        }
        linear[r][3] = wrench.second[r] - psi.second[r];
    }
    store_columns(&linear, &mut out.strain[k][1], 3, at);
}

/// The block of K against bending and twist, from the rows of its lower triangle.
#[inline(always)]
fn load_bending<L: Lane>(triangle: &[Row; 21], at: usize) -> Matrix<L> {
    let mut block = zeros();
    for r in 0..3 {
        for c in 0..=r {
            block[r][c] = L::load(&triangle[super::packed(r, c)][at..]);
            block[c][r] = block[r][c];
        }
    }
    block
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
    stages: usize,
    state: &Linearised,
    wrench: &Pair<L>,
    from: usize,
    at: usize,
    scratch: &Scratch,
    out: &mut Out<'_>,
) {
    let soft = !state.is_stiff();
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
    if state.loaded {
        scratch.terms.take_from_end(stages, (soft, state.turning), out.strain, from, &mut made, at);
        if from == LOADLESS {
            scratch.terms.take_turn(&mut made, at);
        }
    }
    store_columns(&w, &mut out.end[0], from, at);
    store_columns(&v, &mut out.end[1], from, at);
    store_columns(&made[0], &mut out.end[2], from, at);
    store_columns(&made[1], &mut out.end[3], from, at);
}
