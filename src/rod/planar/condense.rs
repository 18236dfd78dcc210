//! The kernel of the condensation in the plane: eight elements linearised and their stage strains eliminated.

use super::algebra::{Complex, PlaneMap};
use super::eliminate::{Angular, Linear, System, flexibility};
use super::magnus::{Placed, vary};
use super::rows::{Linearised, PlaneWrench, load_wrench, store_pose, store_wrench};
use crate::body::Constraint;
use crate::rod::collocation::Collocation;
use crate::rod::lanes::{NOTHING, Row, STAGES, Table, run};
use crate::scalar::{Kernel, Lane};

/// Columns of everything that depends on an element's first node: δm_y, δn_z, δn_x, then 1, then w_y where there are loads.
pub(super) const COLUMNS: usize = 5;

/// How many of them there are.
pub(in crate::rod) fn columns(loaded: bool) -> usize {
    if loaded { COLUMNS } else { COLUMNS - 1 }
}

type Rows = [[Row; COLUMNS]; 3];
const NO_ROWS: Rows = [[NOTHING; COLUMNS]; 3];

/// Elements with their strains eliminated; components in the order (y; z, x).
#[derive(Clone)]
pub(in crate::rod) struct Eliminated {
    pub(in crate::rod) strain: [Rows; STAGES],
    /// What the strains make of ζ_{i+1}.
    pub(in crate::rod) zeta: Rows,
    /// What strains and loads make of δΛ_{i+1}.
    pub(in crate::rod) wrench: Rows,
    pub(in crate::rod) pose: [Row; 4],
    /// Not 0 where the elimination cannot be trusted.
    pub(in crate::rod) suspect: Row,
}

impl Eliminated {
    pub(in crate::rod) fn new() -> Self {
        Self {
            strain: [NO_ROWS; STAGES],
            zeta: NO_ROWS,
            wrench: NO_ROWS,
            pose: [NOTHING; 4],
            suspect: NOTHING,
        }
    }
}

/// Linearises and eliminates the first `count` elements of a block.
pub(in crate::rod) fn condense<const S: usize>(
    table: &Collocation<S>,
    constraint: &Constraint,
    state: &Linearised,
    count: usize,
    out: &mut Eliminated,
) {
    let fixed = constraint.fixed();
    condense_block(&Table::of(table), [fixed[5], fixed[3]], state, count, out);
}

#[inline(never)]
fn condense_block(table: &Table, fixed: [bool; 2], state: &Linearised, count: usize, out: &mut Eliminated) {
    run(Condense { table, fixed, state, count, out }, count);
}

struct Condense<'a> {
    table: &'a Table,
    /// Whether ν_z and ν_x are.
    fixed: [bool; 2],
    state: &'a Linearised,
    /// Elements in use.
    count: usize,
    out: &'a mut Eliminated,
}

/// A load by a change of strains: moment and force by δω, and the moment by δν, as a row.
type ByStrain<L> = (PlaneWrench<L>, Complex<L>);

/// What loads add: δF_l = Σ_m g_lm δq_m + e_l w_i, the loads of the stages brought to node i.
struct Loads<L> {
    /// Of δω_m: moment and force; of δν_m: the moment alone, as a row.
    angular: [[PlaneWrench<L>; STAGES]; STAGES],
    linear: [[Complex<L>; STAGES]; STAGES],
    turn: [PlaneWrench<L>; STAGES],
}

impl Kernel for Condense<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { table, fixed, state, count, out } = self;
        let (stages, soft) = (table.stages, fixed != [true; 2]);
        for at in (0..count).step_by(L::LANES) {
            let mut suspect = L::splat(0.0);
            let zero = L::splat(0.0);
            let none = (zero, Complex::zero());
            let mut pose = [Placed { turn: Complex::zero(), position: Complex::zero() }; STAGES + 1];
            let mut variation = [[PlaneMap::zero(); STAGES]; STAGES + 1];
            for k in 0..=stages {
                (pose[k], variation[k]) = vary(&table.taylor[k], &state.twists, stages, at, &mut suspect);
            }
            let start = load_wrench::<L>(&state.wrench_at_start, at);
            let mut wrench = [none; STAGES + 1];
            for k in 0..=stages {
                wrench[k] =
                    if state.loaded { load_wrench(&state.wrench[k], at) } else { carried(&pose[k], &start) };
            }
            let mut system = System::zero();
            for k in 0..stages {
                system.flexibility[k] = flexibility(&state.tangent[k], at, fixed, &mut suspect);
                assemble(&mut system, stages, k, &pose[k], &variation[k], &wrench[k], state, at);
            }
            let mut ends = [(none, Complex::zero()); STAGES];
            let mut end_turn = none;
            if state.loaded {
                let loads = Loads::new(stages, &pose, &variation, state, at);
                let h = L::load(&state.twists.h[at..]);
                for k in 0..stages {
                    let (turn, strain) = loads.brought((stages, state.turning), &table.a[k], h, &pose[k]);
                    for m in 0..stages {
                        let ((moment, force), row) = strain[m];
                        system.angular[k][m] = system.angular[k][m] + moment;
                        system.from_linear[k][m] = system.from_linear[k][m] + row;
                        if state.turning {
                            system.to_linear[k][m] = system.to_linear[k][m] + force;
                        }
                    }
                    system.angular_rhs[k][4] = -turn.0;
                    system.linear_rhs[k][4] = Complex::zero() - turn.1;
                }
                (end_turn, ends) = loads.brought((stages, state.turning), &table.b, h, &pose[stages]);
            }
            system.solve(stages, soft, &mut suspect);
            finish(&system, stages, (&variation[stages], &wrench[stages]), (&end_turn, &ends), at, out);
            store_pose(&pose[stages], &mut out.pose, at);
            suspect.store(&mut out.suspect[at..]);
        }
    }
}

/// Ad_gᵀ(m, n) = (m − Im(p̄ n), e^{−iθ} n).
#[inline(always)]
fn carried<L: Lane>(pose: &Placed<L>, (moment, force): &PlaneWrench<L>) -> PlaneWrench<L> {
    (*moment - pose.position.cross(*force), pose.turn.conj() * *force)
}

/// Ad_g⁻ᵀ(m, n) = (m + Im(p̄ e^{iθ} n), e^{iθ} n).
#[inline(always)]
fn at_node<L: Lane>(pose: &Placed<L>, (moment, force): &PlaneWrench<L>) -> PlaneWrench<L> {
    let force = pose.turn * *force;
    (*moment + pose.position.cross(force), force)
}

/// The row (z, x) of −Im(n̄ A ν).
#[inline(always)]
fn minus_cross_row<L: Lane>(force: Complex<L>, diagonal: Complex<L>) -> Complex<L> {
    let along = force.conj() * diagonal;
    Complex::new(-along.im, -along.re)
}

/// K_k δq_k − L(Λ_k) Σ_l B_kl δq_l = −r_k + Ad_kᵀ δΛ_i with q = (ω_y, ν), where L(Λ)(w, v) = (Im(n̄ v), −i n w).
#[inline(always)]
#[allow(clippy::too_many_arguments)] // one place, inlined
fn assemble<L: Lane>(
    system: &mut System<L>,
    stages: usize,
    k: usize,
    pose: &Placed<L>,
    variation: &[PlaneMap<L>; STAGES],
    (moment, force): &PlaneWrench<L>,
    state: &Linearised,
    at: usize,
) {
    let tangent = &state.tangent[k];
    let coupling = Complex::new(L::load(&tangent[1][at..]), L::load(&tangent[2][at..]));
    for l in 0..stages {
        let map = &variation[l];
        system.angular[k][l] = -force.cross(map.lower);
        system.from_linear[k][l] = minus_cross_row(*force, map.diagonal);
        system.to_linear[k][l] = force.turned().scale(map.angular);
    }
    system.angular[k][k] = system.angular[k][k] + L::load(&tangent[0][at..]);
    system.from_linear[k][k] = system.from_linear[k][k] + coupling;
    system.to_linear[k][k] = system.to_linear[k][k] + coupling;
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let psi = load_wrench::<L>(&state.internal[k], at);
    let (p, back) = (pose.position, pose.turn.conj());
    system.angular_rhs[k] = [one, p.im, -p.re, *moment - psi.0, zero];
    system.linear_rhs[k] = [Complex::zero(), back, back.turned(), *force - psi.1, Complex::zero()];
}

impl<L: Lane> Loads<L> {
    /// g_l = Ad_l⁻ᵀ(D_l − L(f̄_l)) B_l, e_l = Ad_l⁻ᵀ D_l, for loads that do not depend on where they act. A load that is not turning keeps its force in
    /// space: only its lever changes.
    #[inline(always)]
    fn new(
        stages: usize,
        pose: &[Placed<L>; STAGES + 1],
        variation: &[[PlaneMap<L>; STAGES]; STAGES + 1],
        state: &Linearised,
        at: usize,
    ) -> Self {
        let none = (L::splat(0.0), Complex::zero());
        let mut loads = Self {
            angular: [[none; STAGES]; STAGES],
            linear: [[Complex::zero(); STAGES]; STAGES],
            turn: [none; STAGES],
        };
        for l in 0..stages {
            let (_, mut force) = load_wrench::<L>(&state.load[l], at);
            if !state.turning {
                // −i f w
                let turned = Complex::zero() - force.turned();
                loads.turn[l] = (pose[l].position.cross(turned), turned);
                force = pose[l].turn.conj() * force;
                for m in 0..stages {
                    loads.angular[l][m].0 = -force.cross(variation[l][m].lower);
                    loads.linear[l][m] = minus_cross_row(force, variation[l][m].diagonal);
                }
                continue;
            }
            let slope = load_wrench::<L>(&state.slope[l], at);
            loads.turn[l] = at_node(&pose[l], &slope);
            let turned = slope.1 + force.turned();
            for m in 0..stages {
                let map = &variation[l][m];
                let moment = slope.0 * map.angular - force.cross(map.lower);
                loads.angular[l][m] = at_node(&pose[l], &(moment, turned.scale(map.angular)));
                loads.linear[l][m] = minus_cross_row(force, map.diagonal);
            }
        }
        loads
    }

    /// Ad_gᵀ h Σ_l weight_l of e_l, and of g_lm for every m.
    #[inline(always)]
    fn brought(
        &self,
        (stages, turning): (usize, bool),
        weights: &[f64; STAGES],
        h: L,
        pose: &Placed<L>,
    ) -> (PlaneWrench<L>, [ByStrain<L>; STAGES]) {
        let none = (L::splat(0.0), Complex::zero());
        let (mut turn, mut strain) = (none, [(none, Complex::zero()); STAGES]);
        for l in 0..stages {
            let weight = h * L::splat(weights[l]);
            turn = add_scaled(&turn, weight, &self.turn[l]);
            for m in 0..stages {
                if turning {
                    strain[m].0 = add_scaled(&strain[m].0, weight, &self.angular[l][m]);
                } else {
                    strain[m].0.0 = weight.mul_add(self.angular[l][m].0, strain[m].0.0);
                }
                strain[m].1 = strain[m].1.add_scaled(weight, self.linear[l][m]);
            }
        }
        if turning {
            for m in 0..stages {
                strain[m].0 = carried(pose, &strain[m].0);
            }
        }
        (carried(pose, &turn), strain)
    }
}

#[inline(always)]
fn add_scaled<L: Lane>(a: &PlaneWrench<L>, k: L, b: &PlaneWrench<L>) -> PlaneWrench<L> {
    (k.mul_add(b.0, a.0), a.1.add_scaled(k, b.1))
}

/// y_e and L(Λ_{i+1}) y_e − Ad_eᵀ h Σ b_l δF_l, and the strains themselves.
#[inline(always)]
fn finish<L: Lane>(
    system: &System<L>,
    stages: usize,
    (variation, (_, force)): (&[PlaneMap<L>; STAGES], &PlaneWrench<L>),
    (turn, ends): (&PlaneWrench<L>, &[ByStrain<L>; STAGES]),
    at: usize,
    out: &mut Eliminated,
) {
    let (angular, linear): (&[Angular<L>; STAGES], &[Linear<L>; STAGES]) =
        (&system.angular_rhs, &system.linear_rhs);
    for c in 0..COLUMNS {
        let (mut w, mut v) = (L::splat(0.0), Complex::zero());
        let (mut moment, mut pull) = (L::splat(0.0), Complex::zero());
        if c == 4 {
            (moment, pull) = (-turn.0, Complex::zero() - turn.1);
        }
        for l in 0..stages {
            let (map, ((m, n), row)) = (&variation[l], &ends[l]);
            let (omega, nu) = (angular[l][c], linear[l][c]);
            w = map.angular.mul_add(omega, w);
            v = v.add_scaled(omega, map.lower) + map.diagonal * nu;
            moment = moment - *m * omega - row.re * nu.re - row.im * nu.im;
            pull = pull.add_scaled(-omega, *n);
            let [y, z, x] = &mut out.strain[l];
            store_wrench(&(omega, nu), [&mut y[c], &mut z[c], &mut x[c]], at);
        }
        moment = moment + force.cross(v);
        pull = pull.add_scaled(-w, force.turned());
        let [y, z, x] = &mut out.zeta;
        store_wrench(&(w, v), [&mut y[c], &mut z[c], &mut x[c]], at);
        let [y, z, x] = &mut out.wrench;
        store_wrench(&(moment, pull), [&mut y[c], &mut z[c], &mut x[c]], at);
    }
}
