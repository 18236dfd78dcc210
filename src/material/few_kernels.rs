//! A law at points and strains, a strain a lane, in three components of the strain: the sums of few entries stay in registers beside it.

use std::marker::PhantomData;

use super::blocks::{Blocks, parts};
use super::differentiate::Fibre;
use super::few::{Entries, Few, Sums};
use super::kinematics::Point;
use super::law::{Local, Sectional};
use super::sectional::{EnergyJet, Spans};
use super::span::column;
use super::sums::energy_of;
use super::three::{Plane, Rotations, Set, Three};
use crate::lie::Strain;
use crate::scalar::lane::{Kernel, MAX_LANES, dispatch};
use crate::scalar::{Jet, Lane, lanes_disagreed};

/// A law of the deformation that sums its response in three components.
pub trait BlocksOfFew: Blocks {
    /// Whether the entries are right: J > 0 everywhere, and lanes agreed on every comparison.
    fn sum_few(&self, few: &Few<'_>, entries: &mut Entries) -> bool;
}

/// A law of the strain that does.
pub trait SpansOfFew: Spans {
    /// Whether the entries are right: lanes agreed on every comparison.
    fn sum_few(&self, few: &Few<'_>, entries: &mut Entries) -> bool;
}

impl<M: Local> BlocksOfFew for M {
    fn sum_few(&self, few: &Few<'_>, entries: &mut Entries) -> bool {
        let admissible = match few.set {
            Set::Plane => dispatch(SumLocal { law: self, few, entries, set: PhantomData::<Plane> }),
            Set::Rotations => dispatch(SumLocal { law: self, few, entries, set: PhantomData::<Rotations> }),
        };
        admissible & !lanes_disagreed()
    }
}

impl<M: Sectional> SpansOfFew for M {
    fn sum_few(&self, few: &Few<'_>, entries: &mut Entries) -> bool {
        match few.set {
            Set::Plane => dispatch(SumSectional { law: self, few, entries, set: PhantomData::<Plane> }),
            Set::Rotations => {
                dispatch(SumSectional { law: self, few, entries, set: PhantomData::<Rotations> })
            }
        }
        !lanes_disagreed()
    }
}

struct SumLocal<'a, M, T> {
    law: &'a M,
    few: &'a Few<'a>,
    entries: &'a mut Entries,
    set: PhantomData<T>,
}

impl<M: Local, T: Three> Kernel for SumLocal<'_, M, T> {
    /// Whether J > 0 everywhere.
    type Output = bool;
    const ALIGNED: bool = true;

    #[inline(always)]
    fn run<L: Lane>(self) -> bool {
        let Self { law, few, entries, .. } = self;
        let Few { points, xi, s, .. } = few;
        let (mut smallest, mut sums) = (L::splat(f64::INFINITY), Sums::zero());
        let (mut part, mut q) = (0, 0);
        // one loop over parts and points: a single place where the law is evaluated
        while part < MAX_LANES / L::LANES && q < points.len() {
            let strain = parts(xi, part);
            let position = [L::splat(points.x[q]), L::splat(points.y[q])];
            let zero = L::splat(0.0);
            let fibre = Fibre {
                position,
                position_rate: [zero; 2],
                s: s.part(part),
                gamma: column(&strain, position[0], position[1]),
                gamma_rate: [zero; 3],
            };
            smallest = smallest.min(L::splat(1.0) + fibre.gamma[2]);
            let two = law.respond_in_two_ways::<L, T>(&fibre);
            sums.add_two_ways(T::stretch(position), L::splat(points.weight[q]), &two);
            q += 1;
            if q == points.len() {
                sums.write(energy_of(&strain), part, entries);
                (part, q, sums) = (part + 1, 0, Sums::zero());
            }
        }
        smallest.min_lane() > 0.0
    }
}

struct SumSectional<'a, M, T> {
    law: &'a M,
    few: &'a Few<'a>,
    entries: &'a mut Entries,
    set: PhantomData<T>,
}

impl<M: Sectional, T: Three> Kernel for SumSectional<'_, M, T> {
    type Output = ();
    const ALIGNED: bool = true;

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { law, few, entries, .. } = self;
        let Few { points, xi, s, .. } = few;
        let (mut part, mut q, mut sums) = (0, 0, Sums::zero());
        while part < MAX_LANES / L::LANES && q < points.len() {
            let strain = parts(xi, part);
            let constant = |x: f64| Jet::constant(L::splat(x));
            let at =
                Point { x: constant(points.x[q]), y: constant(points.y[q]), s: Jet::constant(s.part(part)) };
            let u: Jet<L, 3, 6> = law.energy_jet(&variables::<L, T>(&strain), &at);
            let ([g_0, g_1, g_2], [h_00, h_01, h_02, h_11, h_12, h_22]) = (u.gradient, u.hessian);
            let all = [u.value, g_0, g_1, g_2, h_00, h_01, h_02, h_11, h_12, h_22];
            sums.add(L::splat(points.weight[q]), &all);
            q += 1;
            if q == points.len() {
                sums.write(energy_of(&strain), part, entries);
                (part, q, sums) = (part + 1, 0, Sums::zero());
            }
        }
    }
}

/// Three components of Δξ as variables, the others as constants.
#[inline(always)]
fn variables<L: Lane, T: Three>(values: &[L; 6]) -> Strain<Jet<L, 3, 6>> {
    let mut xi = [Jet::constant(L::splat(0.0)); 6];
    for i in 0..6 {
        xi[i] = Jet::constant(values[i]);
    }
    for k in 0..3 {
        let i = T::PLACES[k];
        xi[i] = Jet::variable(values[i], k);
    }
    Strain::from_array(xi)
}
