//! Elementary functions against 106-bit values (tests/data/elementary.json, mpmath at 800 digits), basic operations against `f64`, on
//! every kind of lane the machine has.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use super::{Kernel, Lane, MAX_LANES, run_on_each};
use serde_json::Value;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Function {
    Ln,
    Ln1p,
    XMinusLn1p,
    Exp,
    ExpM1,
    Powf(f64),
}
use Function::*;

impl Function {
    #[inline(always)]
    fn of<L: Lane>(self, x: L) -> L {
        match self {
            Ln => x.ln(),
            Ln1p => x.ln_1p(),
            XMinusLn1p => x.x_minus_ln_1p(),
            Exp => x.exp(),
            ExpM1 => x.exp_m1(),
            Powf(p) => x.powf(p),
        }
    }
}

/// A function at each of some numbers.
#[derive(Clone)]
struct Evaluate<'a>(Function, &'a [f64]);

impl Kernel for Evaluate<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn run<L: Lane>(self) -> Vec<f64> {
        let Self(function, x) = self;
        let mut out = Vec::new();
        for block in x.chunks(L::LANES) {
            let mut padded = [block[0]; MAX_LANES];
            padded[..block.len()].copy_from_slice(block);
            let y = function.of(L::load(&padded));
            out.extend((0..block.len()).map(|i| y.lane(i)));
        }
        out
    }
}

/// The rows of a function: the last three numbers are x (or p), the value and what rounding it lost.
fn rows(name: &str) -> Vec<Vec<f64>> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/elementary.json"));
    let tables: Value = serde_json::from_str(text).unwrap();
    serde_json::from_value(tables[name].clone()).unwrap()
}

/// The distance to high + low in units of the last place of high.
fn ulps(actual: f64, high: f64, low: f64) -> f64 {
    let unit = (high.abs().next_up() - high.abs()).min(high.abs() - high.abs().next_down());
    let unit = if high == 0.0 { f64::from_bits(1) } else { unit };
    ((actual - high) - low).abs() / unit
}

/// The worst error of a function on each kind of lane, with the place.
fn worst(function: Function, rows: &[Vec<f64>]) -> Vec<(&'static str, f64, f64)> {
    let x: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let mut found = Vec::new();
    run_on_each(&Evaluate(function, &x), |lane, answers| {
        let errors = answers.iter().zip(rows).map(|(answer, row)| {
            let [high, low] = row[row.len() - 2..] else { panic!("a short row") };
            let error = ulps(*answer, high, low);
            (lane, if error.is_nan() { f64::INFINITY } else { error }, row[0])
        });
        found.push(errors.fold((lane, 0.0, 0.0), |a, b| if b.1 > a.1 { b } else { a }));
    });
    assert!(found.len() >= 2, "at least one number and the portable lanes");
    found
}

/// Asserts the bound the docs of [`Lane`] state, on every kind of lane.
fn within(name: &str, function: Function, bound: f64) {
    let rows = rows(name);
    assert!(rows.len() > 200, "{name}: only {} rows", rows.len());
    for (lane, error, x) in worst(function, &rows) {
        assert!(error <= bound, "{name}({x:e}) on {lane} lanes is off by {error:.2} ulp");
    }
}

#[test]
fn ln_is_within_its_bound() {
    within("ln", Ln, 1.0);
}

#[test]
fn ln_1p_is_within_its_bound() {
    within("ln_1p", Ln1p, 1.0);
}

#[test]
fn x_minus_ln_1p_is_within_its_bound() {
    within("x_minus_ln_1p", XMinusLn1p, 4.0);
}

#[test]
fn exp_is_within_its_bound() {
    within("exp", Exp, 1.0);
}

#[test]
fn exp_m1_is_within_its_bound() {
    within("exp_m1", ExpM1, 1.5);
}

/// ln x of x in (√½, √2) carries an error of some 2⁻⁵⁶, which p multiplies.
#[test]
fn powf_is_within_its_bound() {
    let rows = rows("powf");
    let mut powers: Vec<f64> = rows.iter().map(|row| row[1]).collect();
    powers.dedup();
    assert!(powers.len() >= 15 && rows.len() > 200);
    for p in powers {
        let of_p: Vec<Vec<f64>> = rows.iter().filter(|row| row[1] == p).cloned().collect();
        for (lane, error, x) in worst(Powf(p), &of_p) {
            assert!(error <= 1.0 + p.abs() / 20.0, "{x:e}^{p} on {lane} lanes is off by {error:.2} ulp");
        }
    }
}

/// The value at one number, in whichever lane it stands and whatever stands in the others.
fn assert_value(function: Function, x: f64, holds: impl Fn(f64) -> bool, expected: &str) {
    for position in 0..MAX_LANES {
        for fill in [0.3, f64::NAN, -f64::INFINITY, 1e300] {
            let mut block = [fill; MAX_LANES];
            block[position] = x;
            run_on_each(&Evaluate(function, &block), |lane, y| {
                let y = y[position];
                assert!(holds(y), "{function:?} at {x:e} on {lane} lanes: {y:e} instead of {expected}");
            });
        }
    }
}

fn assert_values(function: Function, table: &[(f64, f64)]) {
    for &(x, y) in table {
        assert_value(function, x, |actual| actual == y || (actual.is_nan() && y.is_nan()), &format!("{y:e}"));
    }
}

const INF: f64 = f64::INFINITY;
const NAN: f64 = f64::NAN;

#[test]
fn the_ends_of_the_range_have_their_limits() {
    assert_values(Ln, &[(0.0, -INF), (-0.0, -INF), (-5e-324, NAN), (-1.0, NAN), (-INF, NAN)]);
    assert_values(Ln, &[(INF, INF), (NAN, NAN), (1.0, 0.0)]);
    for function in [Ln1p, XMinusLn1p] {
        assert_values(function, &[(-1.0_f64.next_up(), NAN), (-2.0, NAN), (-INF, NAN), (NAN, NAN)]);
        assert_values(function, &[(INF, INF), (0.0, 0.0), (-0.0, 0.0)]);
    }
    assert_values(Ln1p, &[(-1.0, -INF), (5e-324, 5e-324), (-1e-300, -1e-300)]);
    assert_values(XMinusLn1p, &[(-1.0, INF), (5e-324, 0.0), (f64::MAX, f64::MAX)]);
    assert_values(Exp, &[(0.0, 1.0), (-0.0, 1.0), (5e-324, 1.0), (INF, INF), (-INF, 0.0), (NAN, NAN)]);
    assert_values(ExpM1, &[(0.0, 0.0), (5e-324, 5e-324), (-1e-310, -1e-310), (INF, INF), (-INF, -1.0)]);
    assert_values(ExpM1, &[(NAN, NAN), (-708.5, -1.0), (-f64::MAX, -1.0), (f64::MAX, INF)]);
}

/// Beyond [−708, 709] vector lanes saturate; one number goes on to the ends of the format. Both are within the docs.
#[test]
fn exp_saturates_where_its_docs_say() {
    for x in [709.8, 710.0, 1e4, f64::MAX] {
        assert_value(Exp, x, |y| y == INF, "inf");
    }
    assert_value(Exp, 709.1, |y| y == INF || (y / 709.1_f64.exp() - 1.0).abs() < 1e-15, "inf or exp");
    for x in [-746.0, -1e4, -f64::MAX] {
        assert_value(Exp, x, |y| y == 0.0, "0");
    }
    assert_value(Exp, -708.5, |y| (0.0..1e-307).contains(&y), "0, or a subnormal number");
}

#[test]
fn powers_have_their_limits_and_the_sign_of_integral_ones() {
    for (p, at_zero, at_infinity) in [(0.5, 0.0, INF), (3.0, 0.0, INF), (0.0, 1.0, 1.0), (-0.4, INF, 0.0)] {
        assert_values(Powf(p), &[(0.0, at_zero), (INF, at_infinity), (1.0, 1.0)]);
    }
    assert_values(Powf(1.5), &[(NAN, NAN), (-0.1, NAN), (-5e-324, NAN)]);
    assert_values(Powf(-1.5), &[(NAN, NAN), (-0.1, NAN)]);
    // 2^p and its reciprocal are exact, and so must a rounding within one unit be to 1e-15
    for (p, y) in [(2.0, 4.0), (3.0, -8.0), (-1.0, -0.5), (-2.0, 0.25), (0.0, 1.0), (5.0, -32.0)] {
        assert_value(Powf(p), -2.0, |actual| (actual / y - 1.0).abs() < 1e-15, &format!("{y}"));
    }
    // p ln x far outside what exp takes: saturated, not NaN
    assert_values(Powf(1e300), &[(0.5, 0.0), (2.0, INF), (1.0, 1.0)]);
    assert_values(Powf(-1e300), &[(0.5, INF), (2.0, 0.0)]);
    assert_values(Powf(4.0), &[(1e200, INF), (1e-200, 0.0)]);
}

/// Every basic operation on two blocks of numbers, one result a lane.
#[derive(Clone)]
struct Basic {
    a: [f64; MAX_LANES],
    b: [f64; MAX_LANES],
}

/// Name, results, and what `f64` gives.
type Checked = (&'static str, Vec<f64>, Vec<f64>);

impl Kernel for Basic {
    type Output = Vec<Checked>;

    #[inline(always)]
    fn run<L: Lane>(self) -> Vec<Checked> {
        let (a, b) = (L::load(&self.a), L::load(&self.b));
        let each = |y: L| (0..L::LANES).map(|i| y.lane(i)).collect::<Vec<_>>();
        let scalar =
            |f: &dyn Fn(f64, f64) -> f64| (0..L::LANES).map(|i| f(self.a[i], self.b[i])).collect::<Vec<_>>();
        let (three, yes, no) = (L::splat(3.0), L::splat(1.0), L::splat(2.0));
        let finite = |a: f64, _: f64| if a < INF { a } else { 2.0 };
        let below = a.select_lt(L::splat(INF), a, no);
        let mut stored = [7.0; 10];
        a.store(&mut stored[1..]);
        let mut sums = [NAN; MAX_LANES];
        L::sum_each(&std::array::from_fn(|k| L::load(&integers(k))), &mut sums);
        vec![
            ("load", each(a), scalar(&|a, _| a)),
            ("splat", each(three), scalar(&|_, _| 3.0)),
            ("add", each(a + b), scalar(&|a, b| a + b)),
            ("sub", each(a - b), scalar(&|a, b| a - b)),
            ("mul", each(a * b), scalar(&|a, b| a * b)),
            ("div", each(a / b), scalar(&|a, b| a / b)),
            ("neg", each(-a), scalar(&|a, _| -a)),
            ("sqrt", each(a.sqrt()), scalar(&|a, _| a.sqrt())),
            ("abs", each(a.abs()), scalar(&|a, _| a.abs())),
            ("select_lt", each(a.select_lt(b, yes, no)), scalar(&|a, b| if a < b { 1.0 } else { 2.0 })),
            ("map", each(a.map(f64::sin)), scalar(&|a, _| a.sin())),
            ("zip_map", each(a.zip_map(b, f64::atan2)), scalar(&f64::atan2)),
            ("store", stored[1..=L::LANES].to_vec(), scalar(&|a, _| a)),
            ("store, others", [&stored[..1], &stored[L::LANES + 1..]].concat(), vec![7.0; 10 - L::LANES]),
            ("spread", each(a.spread(L::LANES - 1)), scalar(&|_, _| self.a[L::LANES - 1])),
            ("sum_each", sums.to_vec(), (0..MAX_LANES).map(|k| sum_of_integers(k, L::LANES)).collect()),
            // NaN and ∞ replaced: with NaN the smallest is not defined
            ("min_lane", vec![below.min_lane()], vec![scalar(&finite).into_iter().fold(INF, f64::min)]),
            ("min", each(below.min(three)), scalar(&|a, b| finite(a, b).min(3.0))),
        ]
    }
}

/// Small integers, which add up exactly in any order; no two lanes of no two alike.
fn integers(k: usize) -> [f64; MAX_LANES] {
    std::array::from_fn(|i| f64::from(1_u32 << i) + 1000.0 * k as f64)
}

fn sum_of_integers(k: usize, lanes: usize) -> f64 {
    integers(k)[..lanes].iter().sum()
}

#[test]
fn basic_operations_are_those_of_f64_lane_by_lane() {
    let interesting = [1.5, -0.3, 0.0, -0.0, 1e-310, 3e300, INF, -INF, NAN, 7.0, f64::MIN_POSITIVE, -2.5];
    for shift in 0..interesting.len() {
        for other in 0..interesting.len() {
            let a = std::array::from_fn(|i| interesting[(i + shift) % interesting.len()]);
            let b = std::array::from_fn(|i| interesting[(i * 5 + other) % interesting.len()]);
            run_on_each(&Basic { a, b }, |lane, results| {
                for (name, actual, expected) in results {
                    for (i, (x, y)) in actual.iter().zip(&expected).enumerate() {
                        // the sign of |−0| and of NaN is not fixed
                        let same = x.to_bits() == y.to_bits() || (x.is_nan() && y.is_nan());
                        let same = same || (name == "abs" && *x == 0.0 && *y == 0.0);
                        assert!(same, "{name} on {lane} lanes, lane {i} of {a:?}, {b:?}: {x:e}, not {y:e}");
                    }
                    assert_eq!(actual.len(), expected.len(), "{name}");
                }
            });
        }
    }
}

/// a b + c, rounded once or twice, against the value with the rounding of the product kept.
#[derive(Clone)]
struct Structure<'a>(&'a [f64]);

impl Kernel for Structure<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        for block in self.0.windows(MAX_LANES) {
            let x = L::load(block);
            let (m, k) = x.split_exponent();
            let back = m.scale_by_power_of_two(k);
            let fused = x.mul_add(L::splat(0.7), L::splat(-1.3));
            let mut sum = 0.0;
            for i in 0..L::LANES {
                let (m, k) = (m.lane(i), k.lane(i));
                // √½ is rounded down to 21 bits
                assert!((0.70709..1.41422).contains(&m) && k == k.round(), "{:e} = {m} 2^{k}", block[i]);
                assert_eq!(m * 2.0_f64.powi(k as i32 / 2) * 2.0_f64.powi(k as i32 - k as i32 / 2), block[i]);
                assert_eq!(back.lane(i), block[i]);
                let exact = block[i].mul_add(0.7, -1.3);
                // one rounding of the product more
                let slack = (block[i] * 0.7).abs().max(exact.abs()) * f64::EPSILON;
                assert!((fused.lane(i) - exact).abs() <= slack);
                sum += block[i];
            }
            // a sum of L::LANES positive numbers in any order: as many roundings
            assert!((x.sum() - sum).abs() <= L::LANES as f64 * f64::EPSILON * sum);
            assert_eq!(x.sum().to_bits(), x.sum().to_bits());
        }
        for k in -1022..=1023 {
            let power = L::splat(1.0).scale_by_power_of_two(L::splat(f64::from(k)));
            let bits = ((k + 1023) as u64) << 52;
            assert!((0..L::LANES).all(|i| power.lane(i).to_bits() == bits), "2^{k}");
        }
        for (x, rounded) in [(2.4, 2.0), (-2.6, -3.0), (1e15, 1e15), (0.49, 0.0), (-1022.7, -1023.0)] {
            assert_eq!(L::splat(x).round().lane(L::LANES - 1), rounded);
        }
        // 1 + 2x + 3x² at ½
        assert_eq!(L::splat(0.5).polynomial(&[1.0, 2.0, 3.0]).lane(0), 2.75);
    }
}

#[test]
fn splitting_scaling_rounding_and_sums_hold_on_every_lane() {
    let mut numbers: Vec<f64> = (-307..308).map(|k| 1.37 * 10.0_f64.powi(k)).collect();
    numbers.extend((0..400).map(|k| 0.5 + 0.01 * f64::from(k)));
    numbers.extend([
        2.0_f64.sqrt(),
        0.5_f64.sqrt(),
        1.0,
        f64::MIN_POSITIVE,
        2.0,
        1.0_f64.next_down(),
        0.70709,
    ]);
    numbers.push(1e300);
    run_on_each(&Structure(&numbers), |_, ()| {});
}
