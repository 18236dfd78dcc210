//! The traps of num-dual that the crate shields its users from: each test shows the trap, then the safe way.

use hyperrod::scalar::{
    arsinh_sqrt_squared, cosh_multiple_m1, exp_m1_minus_x, pow, pow_1p_m1, x_minus_ln_1p,
};
use num_dual::{Dual2_64, DualNum, HyperDual64};

fn variable(value: f64) -> Dual2_64 {
    Dual2_64::from_re(value).derivative()
}

fn parts(x: Dual2_64) -> [f64; 3] {
    [x.re, x.v1, x.v2]
}

/// Relative in value, first and second derivative.
fn assert_close(actual: Dual2_64, expected: [f64; 3], tolerance: f64, what: &str) {
    for (part, (a, e)) in parts(actual).into_iter().zip(expected).enumerate() {
        assert!((a - e).abs() <= tolerance * e.abs(), "{what}, derivative {part}: {a} instead of {e}");
    }
}

#[test]
fn powf_at_zero_is_nan_and_pow_is_not() {
    for p in [1.5, 2.5] {
        let trap = variable(0.0).powf(p);
        assert!(trap.re.is_nan(), "num-dual has mended powf({p}) at 0: the crate's pow may go");
        let a = variable(0.0);
        assert_eq!(parts(pow(a * a, p)), [0.0, 0.0, 0.0]); // |a|^2p
    }
    assert_eq!(parts(pow(variable(0.0), 2.0)), [0.0, 0.0, 2.0]);
    assert_eq!(parts(pow(variable(0.0), 1.0)), [0.0, 1.0, 0.0]);
    assert_eq!(parts(pow(variable(0.0), 0.0)), [1.0, 0.0, 0.0]);
    assert_eq!(parts(pow(variable(0.0), 3.0)), [0.0, 0.0, 0.0]);
}

#[test]
fn pow_agrees_with_powf_away_from_zero() {
    for x in [1e-300_f64, 1e-12, 0.3, 1.0, 7.5, 1e12] {
        for p in [-1.5_f64, 0.5, 1.0, 1.5, 2.0, 2.5, 6.0] {
            let expected = [x.powf(p), p * x.powf(p - 1.0), p * (p - 1.0) * x.powf(p - 2.0)];
            if expected.iter().all(|e| e.is_finite()) {
                assert_close(pow(variable(x), p), expected, 1e-15, "pow");
            }
        }
    }
}

#[test]
fn the_kink_of_an_absolute_value_has_no_derivative() {
    let a = variable(0.0);
    assert!((a * a).sqrt().v1.is_nan()); // num-dual: sqrt(x*x)
    assert!(pow(a * a, 0.5).re.is_nan()); // ours: no derivative exists, so no number is given
    assert_eq!(pow(0.0, 0.5), 0.0); // the value alone does
    assert!(a.powd(Dual2_64::from_re(2.0)).v1.is_nan()); // powd goes through ln(0)
    assert_eq!(parts(pow(a, 2.0)), [0.0, 0.0, 2.0]);
}

#[test]
fn comparisons_see_the_real_part_only() {
    let zero = Dual2_64::from_re(0.0);
    assert!(variable(0.0) == zero, "equal although the derivatives differ");
    assert!(
        num_traits::Zero::is_zero(&variable(0.0)),
        "`if x.is_zero() {{ return zero }}` would drop a derivative"
    );
    // so the crate's primitives never test for zero: the derivative at rest is there
    assert_eq!(parts(pow_1p_m1(variable(0.0), 0.5)), [0.0, 0.5, -0.25]);
    assert_eq!(parts(x_minus_ln_1p(variable(0.0))), [0.0, 0.0, 1.0]);
    assert_eq!(parts(exp_m1_minus_x(variable(0.0))), [0.0, 0.0, 1.0]);
    assert_eq!(parts(arsinh_sqrt_squared(variable(0.0))), [0.0, 1.0, -2.0 / 3.0]);
}

#[test]
fn sums_of_powers_of_two_stretches_are_exact_polynomials_for_even_exponents() {
    let mut z = 1e-30_f64;
    while z < 1e6 {
        // cosh 2θ = 1 + 2z = c, cosh 4θ = 2c² − 1, cosh 6θ = 4c³ − 3c, cosh θ = √(1+z)
        let root = (1.0_f64 + z).sqrt();
        let cases = [
            (1.0, [z / (1.0 + root), 0.5 / root, -0.25 / root.powi(3)]),
            (2.0, [2.0 * z, 2.0, 0.0]),
            (-2.0, [2.0 * z, 2.0, 0.0]),
            (4.0, [8.0 * z * (1.0 + z), 8.0 + 16.0 * z, 16.0]),
            (6.0, [z * (18.0 + z * (48.0 + z * 32.0)), 18.0 + z * (96.0 + z * 96.0), 96.0 + 192.0 * z]),
        ];
        for (alpha, expected) in cases {
            let [w, w1, w2] = parts(cosh_multiple_m1(variable(z), alpha));
            // rounding of θ is amplified by αθ in cosh αθ, of w″ by the division by z(1+z), 1/16 at least
            let tolerance = 1e-15 * (4.0 + alpha.abs() * z.sqrt().asinh());
            assert!((w - expected[0]).abs() <= tolerance * expected[0], "{alpha} {z}: {w}");
            assert!((w1 - expected[1]).abs() <= tolerance * expected[1], "{alpha} {z}: {w1}");
            let scale = expected[2].abs() + expected[1] / (z.max(1.0 / 16.0));
            assert!((w2 - expected[2]).abs() <= 2.0 * tolerance * scale, "{alpha} {z}: {w2} {}", expected[2]);
        }
        z *= 1.37;
    }
}

#[test]
fn any_exponent_obeys_the_double_angle_and_the_limit_of_small_exponents() {
    for alpha in [0.3, 1.3, 2.5, 5.0, -3.7] {
        for z in [0.0, 1e-15, 1e-3, 0.06, 0.065, 0.7, 30.0] {
            // cosh 2αθ − 1 = 2 (cosh αθ − 1)(cosh αθ + 1)
            let w = cosh_multiple_m1(variable(z), alpha);
            let double = cosh_multiple_m1(variable(z), 2.0 * alpha);
            let product = w * (w + 2.0) * 2.0;
            for (a, b) in parts(double).into_iter().zip(parts(product)) {
                assert!((a - b).abs() <= 2e-13 * (a.abs() + double.v1), "{alpha} {z}: {a} {b}");
            }
            // (cosh αθ − 1) 2/α² = θ² + α²θ⁴/12 + …
            let theta_squared = arsinh_sqrt_squared(variable(z));
            let small = cosh_multiple_m1(variable(z), 1e-5) * 2e10;
            for (a, b) in parts(theta_squared).into_iter().zip(parts(small)) {
                assert!((a - b).abs() <= 1e-9 * (a.abs() + theta_squared.v1), "{z}: {a} {b}");
            }
        }
    }
}

#[test]
fn the_switch_between_series_and_closed_form_cannot_be_seen() {
    let (below, above) = (0.0625, 0.0625_f64.next_up());
    for alpha in [-2.0, 0.7, 1.3, 5.0, 9.0] {
        let [a, b] = [below, above].map(|z| parts(cosh_multiple_m1(variable(z), alpha)));
        for k in 0..3 {
            assert!(
                (a[k] - b[k]).abs() < 1e-14 * (a[k].abs() + 16.0 * a[1].abs()),
                "{alpha}, {k}: {a:?} {b:?}"
            );
        }
    }
    for r in [0.25_f64, -0.25] {
        let beyond = if r > 0.0 { r.next_up() } else { r.next_down() };
        assert!((x_minus_ln_1p(r) - x_minus_ln_1p(beyond)).abs() < 1e-16);
    }
    for r in [1.0_f64, -1.0] {
        let beyond = if r > 0.0 { r.next_up() } else { r.next_down() };
        // one unit in the last place times the slope e − 1, and the rounding of e − 1
        assert!((exp_m1_minus_x(r) - exp_m1_minus_x(beyond)).abs() < 8e-16);
    }
}

#[test]
fn mixed_derivatives_come_through_every_primitive() {
    // ∂²/∂x∂y of f(xy) = f′ + xy f″
    let x = HyperDual64::from_re(0.3).derivative1();
    let y = HyperDual64::from_re(0.5).derivative2();
    let product = 0.15;
    for (mixed, expected) in [
        (pow(x * y, 1.5).eps1eps2, 2.25 * product.sqrt()),
        (exp_m1_minus_x(x * y).eps1eps2, product.exp_m1() + product * product.exp()),
        (cosh_multiple_m1(x * y, 4.0).eps1eps2, 8.0 + 32.0 * product),
    ] {
        assert!((mixed - expected).abs() < 1e-14 * expected, "{mixed} {expected}");
    }
}
