//! Every operation of a jet against num-dual's `Dual2SVec64<3>`, which takes other formulas, in value, gradient and Hessian.

#![allow(clippy::unwrap_used)] // a test that cannot go on should panic
#![allow(clippy::op_ref, clippy::nonminimal_bool)] // operators with references, and each comparison, are what is tested

use nalgebra::{Const, Matrix3, RowVector3, U1};
use num_dual::{Derivative, Dual2SVec64, DualNum, DualStruct};
use num_traits::{FromPrimitive, Num, One, Signed, Zero};

use super::{Jet, lanes_disagreed};
use crate::scalar::Scalar;
use crate::scalar::lane::{Lane, Portable};

/// Some tens of operations of num-dual's formulas and of the jet's, each on numbers up to ten times what they leave.
const ROUNDING: f64 = 1e-13;

type Three = Dual2SVec64<3>;
type Packed<L> = Jet<L, 3, 6>;

/// A number with derivatives that depend on `seed` and have no zero among them.
fn dual(value: f64, seed: f64) -> Three {
    let g = RowVector3::from_fn(|_, j| (1.3 * j as f64 + seed).sin() + 0.1);
    let h = Matrix3::from_fn(|i, j| (0.7 * (i * j) as f64 + (i + j) as f64 + seed).cos());
    Three::new(value, Derivative::some(g), Derivative::some(h))
}

const UPPER: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// The numbers as a jet, one a lane.
fn pack<L: Lane>(numbers: &[Three]) -> Packed<L> {
    let lanes = |f: &dyn Fn(&Three) -> f64| {
        L::load(&std::array::from_fn::<f64, 8, _>(|i| numbers.get(i).map_or(0.0, f)))
    };
    Jet {
        value: lanes(&|x| x.re),
        gradient: std::array::from_fn(|j| lanes(&|x| x.v1.unwrap_generic(U1, Const::<3>)[j])),
        hessian: UPPER.map(|(i, j)| lanes(&|x| x.v2.unwrap_generic(Const::<3>, Const::<3>)[(i, j)])),
        first: 0b111,
        second: 0b111_111,
    }
}

/// Value, gradient and Hessian, each relative to its largest entry.
fn error_of<L: Lane>(jet: &Packed<L>, lane: usize, expected: &Three) -> f64 {
    let g = expected.v1.unwrap_generic(U1, Const::<3>);
    let h = expected.v2.unwrap_generic(Const::<3>, Const::<3>);
    let ratio = |error: f64, scale: f64| if error == 0.0 { 0.0 } else { error / scale };
    let mut worst = ratio((jet.value.lane(lane) - expected.re).abs(), expected.re.abs());
    for j in 0..3 {
        worst = worst.max(ratio((jet.gradient[j].lane(lane) - g[j]).abs(), g.amax()));
    }
    for (k, (i, j)) in UPPER.into_iter().enumerate() {
        worst = worst.max(ratio((jet.hessian[k].lane(lane) - h[(i, j)]).abs(), h.amax()));
    }
    let numbers = [jet.value, jet.gradient[0], jet.hessian[0]].map(|n| n.lane(lane));
    assert!(numbers.iter().all(|n| n.is_finite()), "{jet:?}");
    worst
}

/// Holds a function of two numbers x and y over the product of two lists, one pair alone and four in the lanes of a jet.
macro_rules! same {
    ($xs:expr, $ys:expr, $tolerance:expr, |$x:ident, $y:ident| $body:expr) => {{
        fn function<D: Scalar>($x: D, $y: D) -> D {
            $body
        }
        let pairs: Vec<(Three, Three)> = $xs
            .iter()
            .flat_map(|&x: &f64| $ys.iter().map(move |&y: &f64| (dual(x, x + 0.3), dual(y, 2.0 - y))))
            .collect();
        for start in 0..pairs.len() {
            let four: Vec<_> = (0..4).map(|i| pairs[(start + i) % pairs.len()]).collect();
            let (xs, ys): (Vec<_>, Vec<_>) = four.iter().copied().unzip();
            let packed = function(pack::<Portable>(&xs), pack::<Portable>(&ys));
            let alone = function(pack::<f64>(&xs), pack::<f64>(&ys));
            for (i, (x, y)) in four.iter().enumerate() {
                let expected = function(*x, *y);
                let mut error = error_of(&packed, i, &expected);
                if i == 0 {
                    error = error.max(error_of(&alone, 0, &expected));
                }
                let text = stringify!($body);
                assert!(error <= $tolerance, "{text} at {}, {}: {error:.1e}", x.re, y.re);
            }
        }
        lanes_disagreed(); // some of these compare
    }};
}

const ANY: [f64; 7] = [-2.3, -0.7, -1e-3, 1e-3, 0.4, 1.0, 3.1];
const POSITIVE: [f64; 6] = [1e-3, 0.3, 0.99, 1.0, 2.7, 40.0];
const WITHIN_ONE: [f64; 5] = [-0.8, -0.1, 1e-3, 0.35, 0.9];

#[test]
fn arithmetic_is_that_of_num_dual() {
    same!(ANY, ANY, ROUNDING, |x, y| x + y * 0.7);
    same!(ANY, ANY, ROUNDING, |x, y| x - y * 0.7);
    same!(ANY, ANY, ROUNDING, |x, y| x * y);
    same!(ANY, ANY, ROUNDING, |x, y| x / y);
    same!(ANY, ANY, ROUNDING, |x, y| -x * y);
    same!(ANY, ANY, ROUNDING, |x, y| x * &y + &y);
    same!(ANY, ANY, ROUNDING, |x, y| x / &y - &y);
    same!(ANY, ANY, ROUNDING, |x, y| x.mul_add(y, y * y + 10.0));
    same!(ANY, ANY, ROUNDING, |x, y| (x + 0.3) * (y - 0.7) / 3.0 * 1.7);
    same!(ANY, ANY, ROUNDING, |x, y| {
        let mut z = x;
        z += y * 2.0;
        z *= x;
        z /= y;
        z *= 3.0;
        z /= 7.0;
        z += 50.0;
        z -= 7.0;
        z -= y;
        z
    });
    same!(ANY, ANY, ROUNDING, |x, y| [x, x * x, y * y].into_iter().sum::<D>() + 5.0);
    same!(ANY, ANY, ROUNDING, |x, y| [x, y, x].into_iter().product::<D>());
}

#[test]
fn integral_powers_and_reciprocals_are_those_of_num_dual() {
    same!(ANY, [1.0], ROUNDING, |x, _y| x.recip());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.inv());
    macro_rules! powers {
        ($($n:literal)*) => { $(same!(ANY, [1.0], ROUNDING, |x, _y| x.powi($n));)* };
    }
    powers!(-4 -3 -2 -1 0 1 2 3 4 5 6);
}

#[test]
fn real_powers_are_those_of_num_dual_also_integral_ones_of_negative_numbers() {
    macro_rules! powers {
        ($numbers:expr, $($p:literal)*) => { $(same!($numbers, [1.0], ROUNDING, |x, _y| x.powf($p));)* };
    }
    powers!(POSITIVE, -2.5 -0.6666666666666666 0.0 0.3333333333333333 0.5 1.0 1.5 2.0 2.5 3.0 7.3);
    powers!(ANY, -2.0 -1.0 0.0 1.0 2.0 3.0 4.0);
    same!(POSITIVE, ANY, ROUNDING, |x, y| x.powd(y));
}

/// At 0, where num-dual divides by x: the derivatives by hand, p x^(p−1) and p(p−1) x^(p−2).
#[test]
fn real_powers_at_zero_are_the_limits() {
    for (p, value, first, second) in [
        (0.0, 1.0, 0.0, 0.0),
        (1.0, 0.0, 1.0, 0.0),
        (2.0, 0.0, 0.0, 2.0),
        (2.5, 0.0, 0.0, 0.0),
        (3.0, 0.0, 0.0, 0.0),
    ] {
        let x = Jet::<Portable, 1, 1>::variable(Portable::splat(0.0), 0).powf(p);
        assert_eq!(
            [x.value.lane(3), x.gradient[0].lane(3), x.hessian[0].lane(3)],
            [value, first, second],
            "{p}"
        );
    }
    let x = Jet::<Portable, 1, 1>::variable(Portable::splat(0.0), 0).powf(1.5);
    assert_eq!([x.value.lane(0), x.gradient[0].lane(0), x.hessian[0].lane(0)], [0.0, 0.0, f64::INFINITY]);
}

#[test]
fn roots_exponentials_and_logarithms_are_those_of_num_dual() {
    same!(POSITIVE, [1.0], ROUNDING, |x, _y| x.sqrt());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.cbrt());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.exp());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.exp2());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.exp_m1());
    same!(POSITIVE, [1.0], ROUNDING, |x, _y| x.ln());
    same!(POSITIVE, [1.0], ROUNDING, |x, _y| x.log2());
    same!(POSITIVE, [1.0], ROUNDING, |x, _y| x.log10());
    same!(POSITIVE, [1.0], ROUNDING, |x, _y| x.log(3.0));
    same!(POSITIVE, [1.0], ROUNDING, |x, _y| x.ln_1p());
    same!(WITHIN_ONE, [1.0], ROUNDING, |x, _y| x.ln_1p());
}

#[test]
fn circular_and_hyperbolic_functions_are_those_of_num_dual() {
    same!(ANY, [1.0], ROUNDING, |x, _y| x.sin());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.cos());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.sin_cos().0 + x.sin_cos().1 * 2.0);
    same!(ANY, [1.0], ROUNDING, |x, _y| x.tan());
    same!(WITHIN_ONE, [1.0], ROUNDING, |x, _y| x.asin());
    same!(WITHIN_ONE, [1.0], ROUNDING, |x, _y| x.acos());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.atan());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.sinh());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.cosh());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.tanh());
    same!(ANY, [1.0], ROUNDING, |x, _y| x.asinh());
    same!([1.1, 2.0, 7.0], [1.0], ROUNDING, |x, _y| x.acosh());
    same!(WITHIN_ONE, [1.0], ROUNDING, |x, _y| x.atanh());
}

/// sin x/x and the like, which num-dual forms as they are written: at x = 0.4 the second derivative of (3 sin x − 3x cos x)/x³ − sin x/x
/// loses 1/x⁴ = 40 times 1/x² of its digits.
#[test]
fn spherical_bessel_functions_are_those_of_num_dual() {
    let away = [-2.3, -0.7, 0.4, 1.0, 3.1];
    same!(away, [1.0], ROUNDING, |x, _y| x.sph_j0());
    same!(away, [1.0], 10.0 * ROUNDING, |x, _y| x.sph_j1());
    same!(away, [1.0], 100.0 * ROUNDING, |x, _y| x.sph_j2());
}

#[test]
fn the_angle_is_right_in_every_quadrant_and_on_the_axes() {
    // num-dual divides y by x and loses the digits that a small x takes
    same!(ANY, [-2.3, -0.7, 0.4, 1.0, 3.1], ROUNDING, |y, x| y.atan2(x));
    // on the axis: θ = π/2, ∂θ/∂x = −1/y, ∂²θ/∂x∂y = 1/y², the others 0
    let y = Jet::<f64, 2, 3>::variable(2.0, 0);
    let angle = y.atan2(Jet::variable(0.0, 1));
    assert_eq!(angle.value, std::f64::consts::FRAC_PI_2);
    assert_eq!((angle.gradient, angle.hessian), ([0.0, -0.5], [0.0, 0.25, 0.0]));
}

#[test]
fn signs_and_remainders_are_those_of_num_dual_and_of_their_definition() {
    same!(ANY, ANY, ROUNDING, |x, y| x.abs() * y);
    same!(ANY, [1.0], ROUNDING, |x, _y| x.signum() * 3.0);
    same!(ANY, ANY, ROUNDING, |x, y| x.abs_sub(&y) + 1.0);
    // num-dual has no remainder: a − b trunc(a/b)
    for (a, b) in [(7.5, 2.0), (-7.5, 2.0), (0.3, 0.7), (9.1, -2.5)] {
        let (x, y) = (dual(a, 0.1), dual(b, 0.9));
        let quotient = (a / b).trunc();
        let expected = x - y * quotient;
        let packed = pack::<Portable>(&[x; 4]) % pack::<Portable>(&[y; 4]);
        assert!(error_of(&packed, 2, &expected) <= ROUNDING && (packed.value.lane(1) - a % b).abs() <= 1e-15);
        let mut by_number = pack::<Portable>(&[x; 4]);
        by_number %= b;
        assert!(error_of(&by_number, 0, &(x - b * quotient)) <= ROUNDING);
    }
}

#[test]
fn comparisons_see_values_and_mark_lanes_that_disagree() {
    let jet = |values: [f64; 4]| Packed::<Portable>::constant(Portable::load(&values));
    let (low, high) = (jet([-1.0, -2.0, -3.0, -4.0]), jet([1.0, 2.0, 3.0, 4.0]));
    let mixed = jet([1.0, 1.0, 1.0, -1.0]);
    lanes_disagreed();
    assert!(low < high && high > low && low < 0.0 && high >= 0.5 && low != high && high != 0.0);
    assert!(high.is_positive() && low.is_negative() && !low.is_zero() && jet([0.0; 4]).is_zero());
    assert!(!lanes_disagreed(), "they agreed");
    let questions: [fn(Packed<Portable>) -> bool; 9] = [
        |x| x < 0.0,
        |x| x > Jet::zero(),
        |x| x <= Jet::zero(),
        |x| x == 1.0,
        |x| x != Jet::one(),
        |x| x.is_positive(),
        |x| x.is_negative(),
        |x| x.re() > 0.0,
        |x| (x - 1.0).is_zero(),
    ];
    for (k, question) in questions.into_iter().enumerate() {
        question(mixed);
        assert!(lanes_disagreed(), "question {k} with an answer for one lane only");
        assert!(!lanes_disagreed(), "asking takes the mark away");
    }
    // what selects lane by lane needs no mark
    assert_eq!(mixed.abs().value.lane(3), 1.0);
    assert_eq!(mixed.signum().value.lane(3), -1.0);
    assert!(!lanes_disagreed());
}

#[test]
fn a_jet_is_made_of_numbers_as_num_dual_says() {
    type J = Packed<Portable>;
    let values = [Some(J::from(2.0)), Some(J::from_re(2.0)), J::from_f64(2.0), Some(J::one() + 1.0)];
    for value in values.into_iter().chain([J::from_i64(2), J::from_u64(2)]).map(Option::unwrap) {
        assert_eq!(
            (value.value.lane(3), value.gradient[1].lane(2), value.hessian[5].lane(1)),
            (2.0, 0.0, 0.0)
        );
    }
    assert!(J::from_str_radix("2", 10).is_ok_and(|x| x == 2.0) && J::from_str_radix("x", 10).is_err());
    assert_eq!((J::NDERIV, Jet::<f64, 3, 0>::NDERIV, Jet::<f64, 0, 0>::NDERIV), (2, 1, 0));
}

#[test]
fn scaling_is_multiplying_by_a_number() {
    let x = dual(1.3, 0.4);
    assert!(error_of(&pack::<Portable>(&[x; 4]).scale(&-2.5), 1, &(x * -2.5)) <= ROUNDING);
}

/// First order and value alone leave out what second order has, and nothing else.
#[test]
fn lower_orders_give_the_same_numbers() {
    fn function<D: Scalar>(x: D, y: D) -> D {
        (x * y + 2.0).sqrt() * (x - y * 0.3).exp() / (y * y + 1.0).ln_1p() + x.powf(1.7) - y.atan2(x)
    }
    let (x, y) = (0.7, 1.9);
    let second = function(Jet::<f64, 2, 3>::variable(x, 0), Jet::variable(y, 1));
    let first = function(Jet::<f64, 2, 0>::variable(x, 0), Jet::variable(y, 1));
    let value = function(Jet::<f64, 0, 0>::constant(x), Jet::constant(y));
    assert_eq!((first.value, first.gradient), (second.value, second.gradient));
    assert_eq!(value.value, second.value);
}
