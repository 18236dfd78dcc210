//! The same sums on every kind of lane the machine has.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use std::marker::PhantomData;

use super::*;
use crate::lie::Twist;
use crate::material::{
    Gent, HolzapfelGasserOgden, LinearElastic, MooneyRivlin, NeoHookean, Ogden, PointRates, ReferencePressure,
};
use crate::scalar::lane::run_on_each;

/// A local law on one site, as a kernel that gives its response and can be run again.
struct LocalOnce<'a, M, O>(&'a M, Site<'a>, PhantomData<O>);

impl<M, O> Clone for LocalOnce<'_, M, O> {
    fn clone(&self) -> Self {
        Self(self.0, self.1, PhantomData)
    }
}

impl<M: Local, O: Level> Kernel for LocalOnce<'_, M, O> {
    type Output = Response;

    #[inline(always)]
    fn run<L: Lane>(self) -> Response {
        let mut out = Response::zero();
        LocalKernel { law: self.0, site: self.1, out: &mut out, level: PhantomData::<O> }.run::<L>();
        out
    }
}

/// A section-level law on one site, likewise.
struct SectionalOnce<'a, M>(&'a M, Site<'a>, Request);

impl<M> Clone for SectionalOnce<'_, M> {
    fn clone(&self) -> Self {
        Self(self.0, self.1, self.2)
    }
}

impl<M: Sectional> Kernel for SectionalOnce<'_, M> {
    type Output = Response;

    #[inline(always)]
    fn run<L: Lane>(self) -> Response {
        let mut out = Response::zero();
        SectionalKernel { law: self.0, site: self.1, request: self.2, out: &mut out }.run::<L>();
        out
    }
}

/// Points without symmetry that move, with positive weights.
fn points(count: usize) -> Points {
    let of = |scale: f64, f: &dyn Fn(f64) -> f64| (0..count).map(|q| scale * f(q as f64)).collect::<Vec<_>>();
    Points {
        x: of(0.01, &|q| (1.3 * q + 0.2).sin()),
        y: of(0.01, &|q| (2.1 * q + 0.7).cos()),
        weight: of(1e-5, &|q| 1.0 + 0.5 * q.sin()),
        rates: Some(PointRates {
            x: of(0.02, &|q| (0.3 * q).cos()),
            y: of(0.03, &|q| (0.9 * q).sin()),
            weight: of(1e-4, &|q| (1.7 * q).sin()),
        }),
    }
}

fn stations() -> [Station; 2] {
    let twist = Twist::from_array([5.0, -8.0, 3.0, 0.02, -0.01, 1.1]);
    let rate = Twist::from_array([20.0, 10.0, -30.0, 0.3, 0.2, -0.4]);
    [Station::straight(0.1), Station { s: 0.1, reference: Reference { twist, rate } }]
}

fn strains() -> [Strain; 3] {
    [
        Strain::from_array([12.0, -30.0, 25.0, 0.1, -0.05, 0.2]),
        Strain::from_array([-5.0, 8.0, -60.0, -0.3, 0.2, -0.15]),
        Strain::from_array([1e-3, 2e-3, -1e-3, 1e-5, 3e-5, -2e-5]),
    ]
}

/// The largest entry of a difference, each kind relative to its own largest and lengths (about a centimetre) taken out.
fn difference(a: &Response, b: &Response) -> f64 {
    let length = |i: usize| if i < 3 { 0.01 } else { 1.0 };
    let ratio = |part: f64, whole: f64| if part == 0.0 { 0.0 } else { part / whole };
    let six = |a: [f64; 6], b: [f64; 6]| {
        let size = |v: &dyn Fn(usize) -> f64| (0..6).map(|i| (v(i) / length(i)).abs()).fold(0.0, f64::max);
        ratio(size(&|i| a[i] - b[i]), size(&|i| b[i]))
    };
    let scaled = |r: &Response| r.tangent.map_with_location(|i, j, k| k / (length(i) * length(j)));
    six(a.wrench.to_array(), b.wrench.to_array())
        .max(six(a.wrench_rate.to_array(), b.wrench_rate.to_array()))
        .max(ratio((scaled(a) - scaled(b)).amax(), scaled(b).amax()))
        .max(ratio((a.energy - b.energy).abs(), b.energy.abs()))
}

/// All answers of a kernel, by lane; repeated, and on another thread, to the bit.
fn answers<K: Kernel<Output = Response> + Clone + Sync>(kernel: K) -> Vec<(&'static str, Response)> {
    let once = || {
        let mut answers = Vec::new();
        run_on_each(&kernel, |lane, response| answers.push((lane, response)));
        answers
    };
    let first = once();
    assert!(first.len() >= 2);
    let bits = |answers: &[(&'static str, Response)]| {
        let numbers = answers.iter().flat_map(|(_, r)| {
            let six = r.wrench.to_array().into_iter().chain(r.wrench_rate.to_array());
            six.chain([r.energy]).chain(r.tangent.iter().copied().collect::<Vec<_>>())
        });
        numbers.map(f64::to_bits).collect::<Vec<u64>>()
    };
    assert_eq!(bits(&once()), bits(&first), "repeated");
    let elsewhere = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..2).map(|_| scope.spawn(once)).collect();
        threads.into_iter().map(|t| t.join().unwrap()).collect::<Vec<_>>()
    });
    elsewhere.iter().for_each(|answers| assert_eq!(bits(answers), bits(&first), "on another thread"));
    first
}

/// Some tens of roundings a point of the size of what is summed, over up to 40 points whose parts partly cancel.
const ROUNDING: f64 = 1e-14;

fn agree(name: &str, all: &[(&'static str, Response)]) {
    let (_, expected) = &all[0];
    assert!(expected.is_finite() && expected.energy != 0.0, "{name}: nothing to compare");
    for (lane, answer) in &all[1..] {
        let error = difference(answer, expected);
        assert!(error < ROUNDING, "{name} on {lane} lanes: {error:.1e}");
    }
}

fn local_law<M: Local>(name: &str, law: M) {
    for count in [1, 3, 8, 17, 40] {
        let points = points(count);
        for at in &stations() {
            for strain in &strains() {
                let site = Site { points: &points, at, strain };
                let law = &law;
                agree(name, &answers(LocalOnce(law, site, PhantomData::<Energy>)));
                agree(name, &answers(LocalOnce(law, site, PhantomData::<Wrench>)));
                agree(name, &answers(LocalOnce(law, site, PhantomData::<Tangent>)));
                agree(name, &answers(LocalOnce(law, site, PhantomData::<Rate>)));
            }
        }
    }
}

#[test]
fn local_laws_answer_alike_on_every_kind_of_lane_and_to_the_bit_when_repeated() {
    local_law("Mooney-Rivlin", ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap()));
    local_law("neo-Hookean", NeoHookean::new(170e3, 400e3).unwrap());
    local_law("Gent", Gent::new(170e3, 400e3, 30.0).unwrap());
    local_law("Ogden", Ogden::new(&[(100e3, 1.3), (-40e3, -2.0)], 4e5).unwrap());
    // branches: parts of the section are slack
    local_law("artery", HolzapfelGasserOgden::artery([170e3, 500e3], [80e3, 1.2], 0.5).unwrap());
}

#[test]
fn sectional_laws_answer_alike_on_every_kind_of_lane_and_to_the_bit_when_repeated() {
    let law = &LinearElastic::new(1e6, 3e5).unwrap();
    for count in [1, 5, 17] {
        let points = points(count);
        for strain in &strains() {
            let at = &stations()[0];
            for request in [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate] {
                let site = Site { points: &points, at, strain };
                agree("linear elastic", &answers(SectionalOnce(law, site, request)));
            }
        }
    }
}
