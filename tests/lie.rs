//! SO(3) and SE(3): one battery of identities for both groups, from θ = 0 to π; the coefficients against 50 digits; first and second
//! derivatives of exp, dexp and log against power series of matrices.
//!
//! Errors are counted in ulps: ε = 2⁻⁵² times the scale of the numbers that enter.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use hyperrod::Scalar;
use hyperrod::lie::{self, Pose, Twist, se3, so3};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use num_dual::{Dual, Dual2_64, Dual64};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

/// A matrix group through the library's functions, in coordinates.
trait Group {
    const DIM: usize;
    fn hat<D: Scalar>(v: &DVector<D>) -> DMatrix<D>;
    fn vee<D: Scalar>(m: &DMatrix<D>) -> DVector<D>;
    fn exp<D: Scalar>(v: &DVector<D>) -> DMatrix<D>;
    fn log<D: Scalar>(g: &DMatrix<D>) -> DVector<D>;
    fn ad(v: &DVector<f64>) -> DMatrix<f64>;
    fn bracket(a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64>;
    /// Ad_g and Ad_{g⁻¹}, each by its own function.
    fn adjoint(g: &DMatrix<f64>) -> [DMatrix<f64>; 2];
    fn dexp<D: Scalar>(v: &DVector<D>) -> DMatrix<D>;
    fn dexp_inv<D: Scalar>(v: &DVector<D>) -> DMatrix<D>;
}

struct So3;
struct Se3;

fn v3<D: Scalar>(v: &DVector<D>) -> Vector3<D> {
    Vector3::new(v[0], v[1], v[2])
}
fn m3<D: Scalar>(m: &DMatrix<D>) -> Matrix3<D> {
    m.fixed_view::<3, 3>(0, 0).into()
}
fn dynamic<D: Scalar, const N: usize>(m: nalgebra::SMatrix<D, N, N>) -> DMatrix<D> {
    DMatrix::from_column_slice(N, N, m.as_slice())
}
fn twist<D: Scalar>(v: &DVector<D>) -> Twist<D> {
    Twist::new(v3(v), Vector3::new(v[3], v[4], v[5]))
}
fn coordinates<D: Scalar>(v: Twist<D>) -> DVector<D> {
    DVector::from_column_slice(&v.to_array())
}
/// [[m, p], [0, last]]
fn homogeneous<D: Scalar>(m: Matrix3<D>, p: Vector3<D>, last: f64) -> DMatrix<D> {
    let entry = |i, j| {
        if i == 3 {
            D::from(if j == 3 { last } else { 0.0 })
        } else if j == 3 {
            p[i]
        } else {
            m[(i, j)]
        }
    };
    DMatrix::from_fn(4, 4, entry)
}
fn pose<D: Scalar>(g: &DMatrix<D>) -> Pose<D> {
    Pose::new(m3(g), Vector3::new(g[(0, 3)], g[(1, 3)], g[(2, 3)]))
}

impl Group for So3 {
    const DIM: usize = 3;
    fn hat<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        dynamic(so3::hat(&v3(v)))
    }
    fn vee<D: Scalar>(m: &DMatrix<D>) -> DVector<D> {
        DVector::from_column_slice(so3::vee(&m3(m)).as_slice())
    }
    fn exp<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        dynamic(so3::exp(&v3(v)))
    }
    fn log<D: Scalar>(g: &DMatrix<D>) -> DVector<D> {
        DVector::from_column_slice(so3::log(&m3(g)).as_slice())
    }
    fn ad(v: &DVector<f64>) -> DMatrix<f64> {
        Self::hat(v)
    }
    fn bracket(a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
        a.cross(b)
    }
    fn adjoint(g: &DMatrix<f64>) -> [DMatrix<f64>; 2] {
        [g.clone(), g.transpose()]
    }
    fn dexp<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        dynamic(so3::dexp(&v3(v)))
    }
    fn dexp_inv<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        dynamic(so3::dexp_inv(&v3(v)))
    }
}

impl Group for Se3 {
    const DIM: usize = 6;
    fn hat<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        homogeneous(so3::hat(&v3(v)), twist(v).linear, 0.0)
    }
    fn vee<D: Scalar>(m: &DMatrix<D>) -> DVector<D> {
        let angular = so3::vee(&m3(m));
        coordinates(Twist::new(angular, pose(m).position))
    }
    fn exp<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        let g = twist(v).exp();
        homogeneous(g.rotation, g.position, 1.0)
    }
    fn log<D: Scalar>(g: &DMatrix<D>) -> DVector<D> {
        coordinates(pose(g).log())
    }
    fn ad(v: &DVector<f64>) -> DMatrix<f64> {
        dynamic(twist(v).ad().to_matrix())
    }
    fn bracket(a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
        coordinates(twist(a).bracket(&twist(b)))
    }
    fn adjoint(g: &DMatrix<f64>) -> [DMatrix<f64>; 2] {
        [dynamic(pose(g).adjoint().to_matrix()), dynamic(pose(g).adjoint_inverse().to_matrix())]
    }
    fn dexp<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        dynamic(se3::dexp(&twist(v)).to_matrix())
    }
    fn dexp_inv<D: Scalar>(v: &DVector<D>) -> DMatrix<D> {
        dynamic(se3::dexp_inv(&twist(v)).to_matrix())
    }
}

/// Σ mᵏ / (k + shift)! with 60 terms: enough for |m| ≤ 10 (10⁶⁰/60! < 1e-21) and its first two derivatives.
fn power_series<D: Scalar>(m: &DMatrix<D>, shift: usize) -> DMatrix<D> {
    let mut term = DMatrix::identity(m.nrows(), m.ncols());
    let mut sum = term.clone();
    for k in 1..60 {
        term = &term * m / D::from((k + shift) as f64);
        sum += &term;
    }
    sum
}

/// The worst error of each named identity, in ulps.
#[derive(Default)]
struct Worst(BTreeMap<String, f64>);

impl Worst {
    #[track_caller]
    fn check(&mut self, name: &str, error: f64, scale: f64, tolerance: f64) {
        let ulps = error / (f64::EPSILON * scale);
        assert!(ulps <= tolerance, "{name}: {ulps:.1} ulps of {scale:e}, tolerance {tolerance}");
        let worst = self.0.entry(name.to_owned()).or_default();
        *worst = worst.max(ulps);
    }
}

fn run_battery<G: Group>(x: &DVector<f64>, y: &DVector<f64>, worst: &mut Worst) {
    let cut = |v: &DVector<f64>| v.rows(0, G::DIM).into_owned();
    let (x, y) = (cut(x), cut(y));
    // Everything is linear in the translations and of order 1 in the rotations, except where products of two occur.
    let size = |v: &DVector<f64>| 1.0 + v.rows(3.min(v.len()), G::DIM - 3).amax();
    let (s, s2) = (size(&x), size(&x) * size(&y));
    let one = DMatrix::identity(G::DIM, G::DIM);
    let (g, h) = (G::exp(&x), G::exp(&y));

    // hat and vee move numbers, v^ − (v^)ᵀ halves exactly.
    worst.check("vee hat", (G::vee(&G::hat(&x)) - &x).amax(), s, 0.0);
    // The same products, perhaps summed in another order: 4 roundings of terms ≤ π s2.
    worst.check("ad = bracket", (G::ad(&x) * &y - G::bracket(&x, &y)).amax(), s2, 4.0 * PI);
    let commutator = G::hat(&x) * G::hat(&y) - G::hat(&y) * G::hat(&x);
    worst.check("bracket = commutator", (G::vee(&commutator) - G::bracket(&x, &y)).amax(), s2, 6.0 * PI);
    let z = (&x + &y) * 0.3 - G::bracket(&y, &x) * 0.1;
    let jacobi = |a: &_, b: &_, c: &_| G::bracket(a, &G::bracket(b, c));
    let sum = jacobi(&x, &y, &z) + jacobi(&y, &z, &x) + jacobi(&z, &x, &y);
    // Three double brackets of terms ≤ π² (|z| < π), 12 roundings each.
    worst.check("Jacobi", sum.amax(), s2 * s, 36.0 * PI * PI);
    // log ∘ exp: R, its quaternion, the halving and the arctangent bring about 8 roundings in series to an ω ≤ π; dexp⁻¹ passes
    // the error on to ν with a factor ≤ π/2.
    worst.check("log exp", (G::log(&g) - &x).amax(), s, 8.0 * PI);
    worst.check("exp log", (G::exp(&G::log(&g)) - &g).amax(), s, 8.0 * PI);
    // Small angles keep *relative* accuracy: no absolute floor in ω.
    let angular = |v: &DVector<f64>| v.rows(0, 3).into_owned();
    let theta = angular(&x).norm().max(f64::MIN_POSITIVE);
    worst.check("log exp, relative", angular(&(G::log(&g) - &x)).amax(), theta, 8.0);
    // The series in ad sums terms up to πᵏ/k!, together e^π ≈ 23, each with about one rounding.
    let [adjoint, inverse] = G::adjoint(&g);
    worst.check("exp ad = Ad exp", (power_series(&G::ad(&x), 0) - &adjoint).amax(), s, PI.exp());
    worst.check("dexp = Σ adᵏ/(k+1)!", (power_series(&G::ad(&x), 1) - G::dexp(&x)).amax(), s, PI.exp());
    // Products of entries ≤ π s whose own errors are a few ulps: 3 to 6 terms.
    worst.check("Ad g Ad g⁻¹ = 1", (&adjoint * inverse - &one).amax(), s, 6.0 * PI);
    let product = &adjoint * &G::adjoint(&h)[0];
    worst.check("Ad gh = Ad g Ad h", (&G::adjoint(&(&g * &h))[0] - product).amax(), s2, 6.0 * PI);
    worst.check("dexp dexp⁻¹ = 1", (G::dexp(&x) * G::dexp_inv(&x) - &one).amax(), s, 6.0 * PI);
    for i in 0..G::DIM {
        let moved = DVector::from_fn(G::DIM, |j, _| Dual64::new(x[j], if i == j { 1.0 } else { 0.0 }));
        let rate = G::exp(&moved).map(|v| v.eps);
        let back = G::exp(&-&x);
        let (spatial, body) = (G::vee(&(&rate * &back)), G::vee(&(&back * &rate)));
        worst.check("dexp = δexp exp⁻¹", (spatial - G::dexp(&x).column(i)).amax(), s, 6.0 * PI);
        worst.check("dexp(−x) = exp⁻¹ δexp", (body - G::dexp(&-&x).column(i)).amax(), s, 6.0 * PI);
    }
}

fn angles() -> Vec<f64> {
    let mut angles: Vec<f64> =
        (0..=50).map(|k| 1e-12 * (PI / 1e-12_f64).powf(k as f64 / 50.0) * (1.0 - 1e-9)).collect();
    angles.extend([0.0, 1.0, PI / 2.0, 2.0 * PI / 3.0, 3.0, PI - 1e-4, PI - 1e-8]);
    angles
}

const AXES: [[f64; 3]; 7] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, -1.0],
    [0.48, -0.6, 0.64],
    [-0.6, 1e-9, 0.8],
    [1e-5, 1.0, -1e-5],
    [-2.0 / 3.0, -2.0 / 3.0, 1.0 / 3.0],
];

#[test]
fn group_identities_hold_from_zero_to_a_half_turn() {
    let mut worst = [Worst::default(), Worst::default()];
    let other = DVector::from_column_slice(&[-0.4, 1.1, 0.7, 0.3, -2.0, 5.0]);
    for theta in angles() {
        for axis in AXES {
            for reach in [0.0, 1.0, 1e3] {
                let omega = Vector3::from(axis).normalize() * theta;
                let x = DVector::from_column_slice(&[
                    omega.x,
                    omega.y,
                    omega.z,
                    0.3 * reach,
                    -reach,
                    0.7 * reach,
                ]);
                run_battery::<So3>(&x, &other, &mut worst[0]);
                run_battery::<Se3>(&x, &other, &mut worst[1]);
            }
        }
    }
    println!("so3 {:#.1?}\nse3 {:#.1?}", worst[0].0, worst[1].0);
}

/// At θ = π the axis may come out either way, but nothing else may go wrong.
#[test]
fn half_turns_have_a_logarithm() {
    for axis in AXES {
        let g = Twist::new(Vector3::from(axis).normalize() * PI, Vector3::new(0.2, -1.0, 0.5)).exp();
        let omega = g.log();
        // The tolerances of "log exp" and "exp log" above.
        let tolerance = 8.0 * PI * f64::EPSILON;
        assert!((omega.angular.norm() - PI).abs() < tolerance, "{omega:?}");
        assert!(approx::abs_diff_eq!(omega.exp(), g, epsilon = tolerance), "{omega:?}");
    }
}

prop_compose! {
    fn twists()(axis in prop::array::uniform3(-1.0..1.0), angle in 0.0..3.1, nu in prop::array::uniform3(-1.0..1.0), reach in -3.0..3.0)
        -> DVector<f64> {
        let omega: Vector3<f64> = Vector3::from(axis).try_normalize(1e-3).unwrap_or(Vector3::x()) * angle;
        let nu: Vector3<f64> = Vector3::from(nu) * f64::powf(10.0, reach);
        DVector::from_column_slice(&[omega.x, omega.y, omega.z, nu.x, nu.y, nu.z])
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("proptest-regressions"))),
        ..Default::default()
    })]
    #[test]
    fn group_identities_hold_for_random_twists(x in twists(), y in twists()) {
        run_battery::<So3>(&x, &y, &mut Worst::default());
        run_battery::<Se3>(&x, &y, &mut Worst::default());
    }
}

#[derive(serde::Deserialize)]
struct Row {
    theta: f64,
    x: f64,
    values: BTreeMap<String, [String; 3]>,
}

#[test]
fn coefficients_and_two_derivatives_match_fifty_digits() {
    let rows: Vec<Row> = serde_json::from_str(include_str!("data/lie_coefficients.json")).unwrap();
    let mut worst = Worst::default();
    for row in &rows {
        let x = Dual2_64::from_re(row.x).derivative();
        let ([_, d_dexp], [inv, d_inv]) = (lie::dexp_coefficients(x), lie::dexp_inv_coefficients(x));
        let mut computed: Vec<(String, Dual2_64)> =
            lie::stumpff(x).into_iter().enumerate().map(|(k, c)| (format!("c{k}"), c)).collect();
        computed.extend(["a", "b", "c"].iter().zip(d_dexp).map(|(n, c)| (format!("dexp.d{n}"), c)));
        let inverse = [("inv.a", inv[0]), ("inv.c", inv[2]), ("inv.da", d_inv[0]), ("inv.dc", d_inv[2])];
        computed.extend(inverse.map(|(n, c)| (n.to_owned(), c)));
        assert_eq!(computed.len(), row.values.len());
        for (name, c) in computed {
            for (order, computed) in [c.re, c.v1, c.v2].into_iter().enumerate() {
                let digits = |row: &Row| row.values[&name][order].parse::<f64>().unwrap();
                let (exact, at_zero) = (digits(row), digits(&rows[0]));
                let past_series = row.x > 10.0;
                let tolerance = match () {
                    // c and c′ are what is left of terms 4 to 12 times larger, the more so the higher the derivative.
                    _ if name.starts_with("inv") => 64.0,
                    // Past the series c₆ = (1/24 − c₄)/x: rounding ε/24 gives c₆″ an error 2ε/(24 x³), at x = 10 150 ε of its
                    // value 2/10! at 0; likewise c₅″ 60 ε, and dexp.dc is made of c₅.
                    _ if past_series => 256.0,
                    // Horner's last few steps and one or two subtractions that do not cancel.
                    () => 4.0,
                };
                let (error, which) = ((computed - exact).abs(), if past_series { "past π" } else { "to π" });
                let scale = exact.abs().max(at_zero.abs());
                worst.check(&format!("{name} order {order} {which}"), error, scale, tolerance);
                if row.theta <= 1.0 {
                    worst.check(&format!("{name} order {order} relative"), error, exact.abs(), tolerance);
                }
            }
        }
    }
    println!("{:#.1?}", worst.0);
}

/// Ω(t) = (t a + t² b, n₀ + t n₁): through θ = 0 at t = 0 with all derivatives at work. |ω(3)| ≈ 3.05.
fn path(t: f64) -> DVector<Dual2_64> {
    let t = Dual2_64::from_re(t).derivative();
    let linear = [(0.48, 0.02), (-0.6, 0.05), (0.64, 0.04)].map(|(a, b)| t * a + t * t * b);
    let [x, y, z] = linear;
    DVector::from_column_slice(&[x, y, z, t * 0.5 + 0.3, -t + 2.0, t * 0.2 - 1.0])
}

/// The largest difference in value, first and second derivative.
fn difference(a: &DMatrix<Dual2_64>, b: &DMatrix<Dual2_64>) -> f64 {
    let d = a - b;
    d.iter().flat_map(|d| [d.re, d.v1, d.v2]).fold(0.0, |m, v| if v.abs() <= m { m } else { v.abs() })
}

fn check_derivatives<G: Group>(t: f64, worst: &mut Worst) {
    let x = path(t).rows(0, G::DIM).into_owned();
    let hat = G::hat(&x);
    // ad in dual numbers: columns [x, eᵢ] from the commutator of matrices
    let basis =
        |i: usize| G::hat(&DVector::from_fn(G::DIM, |j, _| Dual2_64::from(if i == j { 1.0 } else { 0.0 })));
    let columns: Vec<_> = (0..G::DIM).map(|i| G::vee(&(&hat * basis(i) - basis(i) * &hat))).collect();
    let ad = DMatrix::from_columns(&columns);
    // It is the series that loses digits: its terms, and those of its derivatives, add up to about e^θ.
    let theta = Vector3::from_fn(|i, _| x[i].re).norm();
    let of_series = 4.0 * theta.exp();
    worst.check("exp", difference(&G::exp(&x), &power_series(&hat, 0)), 1.0, of_series);
    worst.check("dexp", difference(&G::dexp(&x), &power_series(&ad, 1)), 1.0, of_series);
    // Products of numbers ≤ 4 with derivatives ≤ 4: a few roundings of each.
    let identity = DMatrix::identity(G::DIM, G::DIM);
    worst.check("dexp dexp⁻¹ = 1", difference(&(G::dexp(&x) * G::dexp_inv(&x)), &identity), 1.0, 32.0);
    if theta < PI {
        let log = G::log(&G::exp(&x));
        worst.check(
            "log exp",
            difference(&DMatrix::from_columns(&[log]), &DMatrix::from_columns(&[x])),
            1.0,
            32.0,
        );
    }
}

#[test]
fn two_derivatives_hold_along_a_path_through_zero() {
    let mut worst = [Worst::default(), Worst::default()];
    for t in [0.0, 1e-12, 1e-8, 1e-4, 1e-2, 0.1, 1.0, 2.0, 3.0, 4.0] {
        check_derivatives::<So3>(t, &mut worst[0]);
        check_derivatives::<Se3>(t, &mut worst[1]);
    }
    println!("so3 {:#.1?}\nse3 {:#.1?}", worst[0].0, worst[1].0);
}

/// A dual number of a dual number: the mixed derivative of log ∘ exp = identity vanishes, at the identity too.
#[test]
fn nested_dual_numbers_work() {
    for t in [0.0, 1e-9, 1.0] {
        let constant = |v: f64| Dual::new(Dual64::from(v), Dual64::from(0.0));
        let a = Dual::new(Dual64::new(t, 1.0), Dual64::from(0.0)); // moves in the inner direction
        let b = Dual::new(Dual64::from(2.0 * t), Dual64::from(1.0)); // in the outer one
        let x = Twist::from_array([a, b, constant(t), b, a, constant(1.0)]);
        let back = x.exp().log();
        // The tolerance of "log exp" above.
        for (back, x) in back.to_array().into_iter().zip(x.to_array()) {
            let d = back - x;
            for part in [d.re.re, d.re.eps, d.eps.re, d.eps.eps] {
                assert!(part.abs() <= 32.0 * f64::EPSILON, "t = {t}: {d}");
            }
        }
    }
}

#[test]
fn not_a_number_passes_through() {
    let nan = f64::NAN;
    assert!(lie::stumpff(nan).iter().all(|c| c.is_nan()));
    assert!(so3::log(&Matrix3::from_element(nan)).iter().all(|v| v.is_nan()));
    let omega = Twist::from_array([nan, 0.0, 0.0, 1.0, 0.0, 0.0]);
    assert!(!omega.exp().position.x.is_finite() && !omega.exp().log().is_finite());
}
