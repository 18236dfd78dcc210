//! The same sums on every kind of lane the machine has.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use super::*;
use crate::lie::Strain;
use crate::lie::Twist;
use crate::material::{
    Active, Gent, HolzapfelGasserOgden, LinearElastic, Material, MooneyRivlin, NeoHookean, Ogden, PointRates,
    Reference, ReferencePressure, Response,
};
use crate::scalar::lane::with_each;

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

/// All answers to one request, by kind of lane; repeated, and on another thread, to the bit.
fn answers(law: &dyn Material, site: Site<'_>, request: Request) -> Vec<(&'static str, Response)> {
    let once = || {
        let mut answers = Vec::new();
        let respond = || law.integrate(site.points, site.at, site.strain, request).unwrap();
        with_each(|lane| answers.push((lane, respond())));
        answers
    };
    let first = once();
    let bits = |answers: &[(&'static str, Response)]| {
        let numbers = answers.iter().flat_map(|(_, r)| {
            let six = r.wrench.to_array().into_iter().chain(r.wrench_rate.to_array());
            six.chain([r.energy]).chain(r.tangent.iter().copied().collect::<Vec<_>>())
        });
        numbers.map(f64::to_bits).collect::<Vec<u64>>()
    };
    assert_eq!(bits(&once()), bits(&first), "repeated");
    let elsewhere = std::thread::scope(|scope| scope.spawn(once).join().unwrap());
    assert_eq!(bits(&elsewhere), bits(&first), "on another thread");
    first
}

/// Some tens of roundings a point of the size of what is summed, over up to 40 points whose parts partly cancel.
const ROUNDING: f64 = 1e-14;

/// The sum of the same law over one point after another: blocks with one point in every lane.
fn point_by_point(law: &dyn Material, site: Site<'_>, request: Request) -> Response {
    let mut sum = Response::zero();
    let Points { x, y, weight, rates } = site.points;
    for q in 0..site.points.len() {
        let rates = rates.as_ref().map(|r| PointRates {
            x: vec![r.x[q]],
            y: vec![r.y[q]],
            weight: vec![r.weight[q]],
        });
        let one = Points { x: vec![x[q]], y: vec![y[q]], weight: vec![weight[q]], rates };
        sum += law.integrate(&one, site.at, site.strain, request).unwrap();
    }
    sum
}

const REQUESTS: [Request; 4] = [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate];

fn agree(name: &str, law: &dyn Material, at: &Station) {
    for count in [1, 3, 8, 17, 40, 64, 65, 150] {
        let points = points(count);
        for strain in &strains() {
            for request in REQUESTS {
                let site = Site { points: &points, at, strain };
                let expected = point_by_point(law, site, request);
                assert!(expected.is_finite() && expected.energy != 0.0, "{name}: nothing to compare");
                for (lane, answer) in answers(law, site, request) {
                    let error = difference(&answer, &expected);
                    assert!(
                        error < ROUNDING,
                        "{name}, {count} points, {request:?} on {lane} lanes: {error:.1e}"
                    );
                }
            }
        }
    }
}

#[test]
fn local_laws_answer_alike_on_every_kind_of_lane_and_to_the_bit_when_repeated() {
    // the last one has branches: parts of the section are slack
    let laws: [(&str, &dyn Material); 5] = [
        ("Mooney-Rivlin", &ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap())),
        ("neo-Hookean", &NeoHookean::new(170e3, 400e3).unwrap()),
        ("Gent", &Gent::new(170e3, 400e3, 30.0).unwrap()),
        ("Ogden", &Ogden::new(&[(100e3, 1.3), (-40e3, -2.0)], 4e5).unwrap()),
        ("artery", &HolzapfelGasserOgden::artery([170e3, 500e3], [80e3, 1.2], 0.5).unwrap()),
    ];
    for (name, law) in laws {
        for at in &stations() {
            agree(name, law, at);
        }
    }
}

#[test]
fn sectional_laws_answer_alike_on_every_kind_of_lane_and_to_the_bit_when_repeated() {
    agree("linear elastic", &LinearElastic::new(1e6, 3e5).unwrap(), &stations()[0]);
}

#[test]
fn a_batch_answers_alike_on_every_kind_of_lane() {
    let law = HolzapfelGasserOgden::artery([170e3, 500e3], [80e3, 1.2], 0.5).unwrap();
    let points = Points { rates: None, ..points(19) };
    let sites: Vec<_> = (0..19).map(|k| (stations()[0], strains()[k % 3])).collect();
    for request in REQUESTS {
        with_each(|lane| {
            let mut out = vec![Response::zero(); sites.len()];
            law.integrate_many(&points, &sites, request, &mut out).unwrap();
            for ((at, strain), answer) in sites.iter().zip(&out) {
                let alone = law.integrate(&points, at, strain, request).unwrap();
                let error = difference(answer, &alone);
                assert!(error < ROUNDING, "{request:?} on {lane} lanes: {error:.1e}");
            }
        });
    }
}

/// Three of the strains at a time, in the plane and without shear and extension, as entries of the full response.
#[test]
fn a_response_in_three_strains_is_alike_on_every_kind_of_lane() {
    let fibres = crate::local!(|f, at| {
        let g = f.gamma();
        (g.z * g.z + g.x * g.y * 0.2 + g.x * g.z * g.z + g.y * g.y) * (at.x * 20.0 + at.y * 10.0 + 1.0) * 1e5
    });
    let laws: [(&str, &dyn Material); 4] = [
        ("artery", &HolzapfelGasserOgden::artery([170e3, 500e3], [80e3, 1.2], 0.5).unwrap()),
        ("neo-Hookean", &NeoHookean::new(170e3, 400e3).unwrap()),
        ("fibres", &fibres),
        ("linear elastic", &LinearElastic::new(1e6, 3e5).unwrap()),
    ];
    let points = Points { rates: None, ..points(19) };
    for places in [[1, 3, 5], [0, 1, 2]] {
        let active = Active::of(std::array::from_fn(|i| places.contains(&i)));
        for count in [4, 8, 19] {
            let sites: Vec<_> = (0..count).map(|k| (stations()[0], strains()[k % 3])).collect();
            for (name, law) in laws {
                with_each(|lane| {
                    let mut out = vec![Response::zero(); count];
                    law.integrate_active(&points, &sites, active, Request::Tangent, &mut out).unwrap();
                    for ((at, strain), answer) in sites.iter().zip(&out) {
                        let mut alone = law.integrate(&points, at, strain, Request::Tangent).unwrap();
                        let scale = alone;
                        let mut wrench = alone.wrench.to_array();
                        for i in places {
                            wrench[i] = answer.wrench.to_array()[i];
                            places.iter().for_each(|&j| alone.tangent[(i, j)] = answer.tangent[(i, j)]);
                        }
                        (alone.energy, alone.wrench) =
                            (answer.energy, crate::lie::Wrench::from_array(wrench));
                        let error = difference(&alone, &scale);
                        assert!(error < ROUNDING, "{name}, {places:?} on {lane} lanes: {error:.1e}");
                    }
                });
            }
        }
    }
}
