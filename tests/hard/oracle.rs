//! Answers that do not come from the solver: elliptic integrals, and a rod marched from a tip whose wrench is known.

use std::f64::consts::FRAC_PI_2;

use hyperrod::lie::so3;
use hyperrod::{Pose, Twist, Wrench};

/// ∫ f over [a, b] by composite Gauss quadrature with three points on `n` intervals.
pub fn integral(a: f64, b: f64, n: usize, f: impl Fn(f64) -> f64) -> f64 {
    let h = (b - a) / n as f64;
    let d = 0.5 * h * 0.6_f64.sqrt();
    let panel = |i: usize| {
        let m = a + (i as f64 + 0.5) * h;
        h * (5.0 * f(m - d) + 8.0 * f(m) + 5.0 * f(m + d)) / 18.0
    };
    (0..n).map(panel).sum()
}

/// F(φ, k) and E(φ, k) for the complementary modulus k′, by quadrature: 1 − k² sin² = cos² + k′² sin².
fn incomplete(phi: f64, complement: f64) -> [f64; 2] {
    let root = move |t: f64| t.cos().hypot(complement * t.sin());
    // the integrand of F is steep where cos t ~ k′: t = π/2 − k′ sinh u opens that out
    let first = |t: f64| if t < FRAC_PI_2 { ((FRAC_PI_2 - t) / complement).asinh() } else { 0.0 };
    let (from, to) = (first(phi), first(0.0));
    let f = integral(from, to, 2_000, |u| {
        let t = FRAC_PI_2 - complement * u.sinh();
        complement * u.cosh() / root(t)
    });
    [f, integral(0.0, phi, 400, root)]
}

/// K(k) and E(k) by the arithmetic-geometric mean.
pub fn complete(complement: f64) -> [f64; 2] {
    let (mut a, mut b) = (1.0, complement);
    let (mut sum, mut power) = (0.5 * (1.0 - complement * complement), 0.5);
    for _ in 0..60 {
        let (mean, c) = (0.5 * (a + b), 0.5 * (a - b));
        b = (a * b).sqrt();
        a = mean;
        power *= 2.0;
        sum += power * c * c;
        if c.abs() < 1e-17 {
            break;
        }
    }
    let k = FRAC_PI_2 / a;
    [k, k * (1.0 - sum)]
}

/// The root of a monotone function in a bracket.
pub fn root(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let sign = f(a) > 0.0;
    for _ in 0..70 {
        let m = 0.5 * (a + b);
        if (f(m) > 0.0) == sign { a = m } else { b = m }
    }
    0.5 * (a + b)
}

/// Sideways and axial position of the tip over L of an inextensible cantilever under a dead transverse force, α = PL²/EI.
///
/// √α = K(k) − F(φ₁, k), sin φ₁ = 1/(k√2), k² = (1 + sin θ)/2; x/L = 1 − … as in Bisshopp and Drucker (1945), *Q. Appl. Math.* 3.
pub fn elastica(alpha: f64) -> [f64; 2] {
    let wanted = alpha.sqrt();
    if alpha > 900.0 {
        // a boundary layer, k = 1 but for e^−√α < 1e-13
        let half = 0.5_f64.sqrt();
        return [1.0 - 2.0 / wanted * (1.0 - half), 2.0_f64.sqrt() / wanted];
    }
    let parts = |log_complement: f64| {
        let complement = log_complement.exp();
        let k = ((1.0 - complement) * (1.0 + complement)).sqrt();
        let phi = (1.0 / (k * 2.0_f64.sqrt())).min(1.0).asin();
        ([complete(complement), incomplete(phi, complement)], k)
    };
    let length = |log: f64| {
        let ([whole, part], _) = parts(log);
        whole[0] - part[0] - wanted
    };
    let log = root(-120.0, 0.5_f64.ln() * 0.5 - 1e-13, length);
    let ([whole, part], k) = parts(log);
    let sideways = 1.0 - 2.0 / wanted * (whole[1] - part[1]);
    let sine = 2.0 * k * k - 1.0;
    [sideways, (2.0 * sine).sqrt() / wanted]
}

/// A straight linear rod with diagonal stiffness K marched by Runge and Kutta's method from a tip with the body wrench `tip` to the base, under a
/// load per length fixed in the body frame: pose of the tip in the frame of the base.
pub fn marched_from_tip(k: [f64; 6], length: f64, tip: Wrench, load: Wrench, steps: usize) -> Pose {
    type State = (Pose, Wrench);
    // over σ = L − s: g′ = −g ξ^, Λ′ = −(ad_ξᵀ Λ − f̄)
    let rate = |(pose, wrench): &State| -> State {
        let mut xi = Twist::from_array(std::array::from_fn(|i| wrench.to_array()[i] / k[i]));
        xi.linear.z += 1.0;
        let turn = -(pose.rotation * so3::hat(&xi.angular));
        (Pose::new(turn, -(pose.rotation * xi.linear)), load - wrench.ad_transpose(&xi))
    };
    let moved = |(pose, wrench): &State, (dp, dw): &State, h: f64| -> State {
        let pose = Pose::new(pose.rotation + dp.rotation * h, pose.position + dp.position * h);
        (pose, *wrench + *dw * h)
    };
    let h = length / steps as f64;
    let mut state = (Pose::identity(), tip);
    for _ in 0..steps {
        let k1 = rate(&state);
        let k2 = rate(&moved(&state, &k1, 0.5 * h));
        let k3 = rate(&moved(&state, &k2, 0.5 * h));
        let k4 = rate(&moved(&state, &k3, h));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            state = moved(&state, &k, weight * h / 6.0);
        }
    }
    state.0.inverse()
}
