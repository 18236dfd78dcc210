//! The battery every material law must pass, from one line:
//!
//! ```ignore
//! conforms!(gent, Gent::new(170e3, 400e3, 30.0).unwrap(), shear: 170e3, axial: 740e3);
//! ```
//!
//! The points are a fixed cloud with weights, not a shape, so that a law is judged by itself.

use hyperrod::material::{Material, Point, Points, Request, Response, Sectional, Station};
use hyperrod::{Error, Strain};
use nalgebra::{Matrix6, Vector6};
use num_dual::{Dual2SVec64, HyperDualSVec64};

/// What is known of a law beforehand.
#[derive(Clone, Copy)]
pub struct Expected {
    /// ∂²u/∂a² and ∂²u/∂b² at rest, Pa.
    pub shear: f64,
    /// ∂²u/∂e² at rest, Pa.
    pub axial: f64,
    /// ∂u/∂e at rest, Pa.
    pub rest_stress: f64,
    /// Whether the energy depends on the invariants alone.
    pub isotropic: bool,
    /// The size of strain the finite differences are taken at.
    pub size: f64,
}

impl Default for Expected {
    fn default() -> Self {
        Self { shear: f64::NAN, axial: f64::NAN, rest_stress: 0.0, isotropic: true, size: 0.1 }
    }
}

/// One line gives a law the whole battery, each check a test of its own.
macro_rules! conforms {
    ($name:ident, $law:expr, $($field:ident : $value:expr),* $(,)?) => {
        mod $name {
            #[allow(unused_imports)]
            use super::*;
            use $crate::battery::{self, Expected};

            fn expected() -> Expected {
                Expected { $($field: $value,)* ..Default::default() }
            }

            #[test]
            fn has_no_energy_and_the_stated_stress_at_rest() {
                battery::rest(&$law, &expected());
            }

            #[test]
            fn has_the_stated_moduli_at_small_strain() {
                battery::moduli(&$law, &expected());
            }

            #[test]
            fn keeps_its_digits_at_tiny_strain() {
                battery::tiny(&$law, &expected());
            }

            #[test]
            fn depends_on_the_invariants_alone() {
                battery::objective(&$law, &expected());
            }

            #[test]
            fn has_derivatives_that_are_those_of_finite_differences() {
                battery::differences(&$law, &expected());
            }

            #[test]
            fn gives_the_same_at_every_level() {
                battery::levels(&$law, &expected());
            }

            #[test]
            fn stays_finite_or_refuses_as_j_vanishes() {
                battery::collapse(&$law);
            }

            #[test]
            fn refuses_what_is_inadmissible() {
                battery::inadmissible(&$law);
            }
        }
    };
}

/// A law and its energy density in the numbers the battery evaluates it with: as an object, so that the battery is compiled once and not for
/// every law.
pub trait Energies: Material {
    fn energy(&self, strain: &Strain, at: &Point) -> f64;
    fn hessian(&self, strain: &Strain<Dual2SVec64<6>>, at: &Point) -> Dual2SVec64<6>;
    fn mixed(&self, strain: &Strain<HyperDualSVec64<6, 6>>, at: &Point) -> HyperDualSVec64<6, 6>;
    fn as_material(&self) -> &dyn Material;
}

impl<L: Sectional> Energies for L {
    fn energy(&self, strain: &Strain, at: &Point) -> f64 {
        self.energy_density(strain, at)
    }

    fn hessian(&self, strain: &Strain<Dual2SVec64<6>>, at: &Point) -> Dual2SVec64<6> {
        self.energy_density(strain, &at.cast())
    }

    fn mixed(&self, strain: &Strain<HyperDualSVec64<6, 6>>, at: &Point) -> HyperDualSVec64<6, 6> {
        self.energy_density(strain, &at.cast())
    }

    fn as_material(&self) -> &dyn Material {
        self
    }
}

const RADIUS: f64 = 0.01;

/// Points of a section without symmetry, m, with weights that add to its area.
pub fn cloud() -> Points {
    let at = [(0.9, 0.2), (-0.3, 0.8), (-0.7, -0.6), (0.4, -0.9), (0.1, 0.3)];
    let weight = [0.8, 1.1, 0.9, 0.7, 0.5];
    Points {
        x: at.iter().map(|p| p.0 * RADIUS).collect(),
        y: at.iter().map(|p| p.1 * RADIUS).collect(),
        weight: weight.iter().map(|w| w * RADIUS * RADIUS).collect(),
        rates: None,
    }
}

/// ∫dA, ∫y², ∫x², ∫xy, ∫x, ∫y of the cloud.
fn moments() -> [f64; 6] {
    let points = cloud();
    let mut sums = [0.0; 6];
    for q in 0..points.len() {
        let (x, y, w) = (points.x[q], points.y[q], points.weight[q]);
        for (sum, f) in sums.iter_mut().zip([1.0, y * y, x * x, x * y, x, y]) {
            *sum += w * f;
        }
    }
    sums
}

/// Lengths that make the six strain components comparable: Δξ_i LENGTH_i is a strain.
const LENGTH: [f64; 6] = [RADIUS, RADIUS, RADIUS, 1.0, 1.0, 1.0];

/// Strains in all directions, each of order `size` at the rim.
pub fn directions(size: f64) -> Vec<Strain> {
    let rows: [[f64; 6]; 6] = [
        [0.5, -0.3, 0.7, 0.2, -0.4, 0.3],
        [-0.2, 0.6, -0.4, 0.5, 0.1, -0.3],
        [0.3, 0.3, 0.9, -0.1, 0.3, 0.1],
        [-0.8, 0.1, 0.2, -0.3, -0.5, 0.5],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.4],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    ];
    rows.iter().map(|row| strain(std::array::from_fn(|i| size * row[i] / LENGTH[i]))).collect()
}

pub fn strain(xi: [f64; 6]) -> Strain {
    Strain::from_array(xi)
}

/// The response of a law over the cloud.
pub fn respond(law: &dyn Material, strain: &Strain, request: Request) -> hyperrod::Result<Response> {
    law.integrate(&cloud(), &Station::straight(0.0), strain, request)
}

fn must(law: &dyn Material, strain: &Strain, request: Request) -> Response {
    respond(law, strain, request).unwrap_or_else(|error| panic!("{strain:?}: {error}"))
}

/// Ψ and K with lengths taken out, so that all entries are comparable: stress times area.
fn scaled_wrench(response: &Response) -> Vector6<f64> {
    let mut wrench = response.wrench.to_vector();
    for i in 0..6 {
        wrench[i] /= LENGTH[i];
    }
    wrench
}

fn scaled_tangent(response: &Response) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| response.tangent[(i, j)] / (LENGTH[i] * LENGTH[j]))
}

/// Zero energy and the stated stress at rest; exactly so if that stress is zero.
pub fn rest(law: &dyn Material, expected: &Expected) {
    let response = must(law, &Strain::zero(), Request::Wrench);
    assert_eq!(response.energy, 0.0, "energy at rest");
    let [area, _, _, _, x, y] = moments();
    let p = expected.rest_stress;
    let stated = Vector6::new(p * y, -p * x, 0.0, 0.0, 0.0, p * area);
    let error = (response.wrench.to_vector() - stated).amax();
    // five points: five roundings of sums of the size of p A
    assert!(error <= 1e-15 * p.abs() * area, "wrench at rest {:?} instead of {stated:?}", response.wrench);
}

/// K at rest is that of the stated moduli, all 36 entries.
pub fn moduli(law: &dyn Material, expected: &Expected) {
    let (g, e) = (expected.shear, expected.axial);
    let [area, i_x, i_y, i_xy, x, y] = moments();
    #[rustfmt::skip]
    let stated = Matrix6::from_row_slice(&[
        e * i_x,  -e * i_xy, 0.0,             0.0,     0.0,    e * y,
        -e * i_xy, e * i_y,  0.0,             0.0,     0.0,   -e * x,
        0.0,       0.0,      g * (i_x + i_y), -g * y,  g * x,  0.0,
        0.0,       0.0,      -g * y,          g * area, 0.0,   0.0,
        0.0,       0.0,      g * x,           0.0,     g * area, 0.0,
        e * y,    -e * x,    0.0,             0.0,     0.0,    e * area,
    ]);
    let tangent = must(law, &Strain::zero(), Request::Tangent).tangent;
    for i in 0..6 {
        for j in 0..6 {
            let scale = g.max(e) * area * LENGTH[i] * LENGTH[j];
            let error = (tangent[(i, j)] - stated[(i, j)]).abs();
            // some tens of operations in u, five points
            assert!(error <= 1e-14 * scale, "K[{i},{j}] = {} instead of {}", tangent[(i, j)], stated[(i, j)]);
        }
    }
}

/// Ψ = Ψ(0) + K Δξ and U = Ψ(0)·Δξ + Δξ·K Δξ/2 to 1e-13, from |Δξ| = 1e-15 up; what exceeds rounding is of second order.
pub fn tiny(law: &dyn Material, expected: &Expected) {
    let rest = must(law, &Strain::zero(), Request::Wrench);
    let rest_scale = expected.rest_stress.abs() * moments()[0];
    for exponent in 3..=15 {
        let size = 10.0_f64.powi(-exponent);
        for strain in directions(size) {
            let response = must(law, &strain, Request::Tangent);
            let change = response.tangent * strain.to_vector();
            let scale =
                scaled_wrench(&Response { wrench: hyperrod::Wrench::from_vector(&change), ..response })
                    .norm();
            let error = Response { wrench: response.wrench - rest.wrench, ..response };
            let error = (scaled_wrench(&error)
                - scaled_wrench(&Response { wrench: hyperrod::Wrench::from_vector(&change), ..response }))
            .norm();
            // third derivatives are some tens of the second ones; a stress at rest rounds at its own size
            let tolerance = (1e-13 + 100.0 * size) * scale + 4e-16 * rest_scale;
            assert!(error <= tolerance, "at {size:e}: error of the wrench {:e} of {scale:e}", error);
            let quadratic = 0.5 * strain.to_vector().dot(&change);
            let error = (response.energy - strain.pair(&rest.wrench) - quadratic).abs();
            let tolerance = (1e-13 + 100.0 * size) * scale * size + 1e-15 * rest_scale * size;
            assert!(error <= tolerance, "at {size:e}: energy {:e}, K gives {quadratic:e}", response.energy);
        }
    }
}

/// Rotating the deformation about e₃, and reflecting it, leaves the energy of a point.
pub fn objective(law: &dyn Energies, expected: &Expected) {
    if !expected.isotropic {
        return;
    }
    let at = Point { x: 0.0, y: 0.0, s: 0.0 };
    let energy = |a: f64, b: f64, e: f64| law.energy(&strain([0.0, 0.0, 0.0, a, b, e]), &at);
    for e in [-0.3, 0.0, 0.4] {
        let u = energy(0.3, 0.0, e);
        assert!(u.is_finite() && (u != energy(0.0, 0.0, e) || expected.shear == 0.0));
        for angle in [0.4_f64, 1.9, 3.0, 5.5] {
            let turned = energy(0.3 * angle.cos(), 0.3 * angle.sin(), e);
            assert!((turned - u).abs() <= 1e-13 * u.abs().max(expected.shear), "e = {e}, angle {angle}");
        }
    }
}

/// Ψ is the difference quotient of U, K that of Ψ, and that quotient is symmetric.
pub fn differences(law: &dyn Material, expected: &Expected) {
    for at in directions(expected.size) {
        let response = must(law, &at, Request::Tangent);
        let (wrench, tangent) = (scaled_wrench(&response), scaled_tangent(&response));
        // fourth-order central differences, step h: rounding 1e-16/h, truncation h⁴ times fifth derivatives over second ones
        let h = 1e-3 * expected.size / 0.1;
        let step = |j: usize, multiple: f64| {
            let mut xi = at.to_array();
            xi[j] += multiple * h / LENGTH[j];
            must(law, &strain(xi), Request::Wrench)
        };
        let mut quotient = Matrix6::zeros();
        for j in 0..6 {
            let [m2, m1, p1, p2] = [-2.0, -1.0, 1.0, 2.0].map(|multiple| step(j, multiple));
            let slope = (8.0 * (p1.energy - m1.energy) - (p2.energy - m2.energy)) / (12.0 * h);
            let scale = tangent.amax() * expected.size;
            assert!((slope - wrench[j]).abs() <= 1e-7 * scale, "Psi[{j}] = {}, quotient {slope}", wrench[j]);
            let column = (8.0 * (scaled_wrench(&p1) - scaled_wrench(&m1))
                - (scaled_wrench(&p2) - scaled_wrench(&m2)))
                / (12.0 * h);
            quotient.set_column(j, &column);
        }
        let error = (quotient - tangent).amax() / tangent.amax();
        assert!(error <= 1e-7, "K differs from its quotient by {error:e} at {at:?}");
        let asymmetry = (quotient - quotient.transpose()).amax() / tangent.amax();
        assert!(asymmetry <= 1e-7, "the quotient is asymmetric by {asymmetry:e}");
    }
}

/// The section's answer is that of six plain dual variables, both for one number with a full Hessian and for mixed ones.
pub fn levels(law: &dyn Energies, expected: &Expected) {
    for at in directions(expected.size).into_iter().chain(directions(1e-9)) {
        let response = must(law.as_material(), &at, Request::Tangent);
        let xi = at.to_array();
        let points = cloud();
        let (mut energy, mut wrench) = (0.0, Vector6::zeros());
        let (mut hessian, mut mixed) = (Matrix6::zeros(), Matrix6::zeros());
        for q in 0..points.len() {
            let (point, w) = (Point { x: points.x[q], y: points.y[q], s: 0.0 }, points.weight[q]);
            let dual = xi.map(Dual2SVec64::<6>::from_re);
            let dual = Strain::from_array(std::array::from_fn(|i| dual[i].derivative(i)));
            let u = law.hessian(&dual, &point);
            energy += w * u.re;
            wrench += u.v1.unwrap_generic(nalgebra::U1, nalgebra::U6).transpose() * w;
            hessian += u.v2.unwrap_generic(nalgebra::U6, nalgebra::U6) * w;
            let dual = std::array::from_fn(|i| {
                HyperDualSVec64::<6, 6>::from_re(xi[i]).derivative1(i).derivative2(i)
            });
            let u = law.mixed(&Strain::from_array(dual), &point);
            mixed += u.eps1eps2.unwrap_generic(nalgebra::U6, nalgebra::U6) * w;
        }
        // the largest part before anything cancels: the modulus times area, and times the strain
        let stiffness = scaled_tangent(&response).amax();
        let scale = stiffness * xi.iter().zip(LENGTH).map(|(x, l)| (x * l).abs()).fold(0.0, f64::max)
            + expected.rest_stress.abs() * moments()[0];
        assert!((energy - response.energy).abs() <= 1e-13 * scale, "U {energy} {}", response.energy);
        for i in 0..6 {
            let error = (wrench[i] - response.wrench.to_vector()[i]).abs() / LENGTH[i];
            assert!(error <= 1e-13 * scale, "Psi[{i}] by {error:e} of {scale:e}");
            for j in 0..6 {
                let unit = LENGTH[i] * LENGTH[j] * stiffness;
                let k = response.tangent[(i, j)];
                assert!((hessian[(i, j)] - k).abs() <= 1e-13 * unit, "K[{i},{j}] {k} {}", hessian[(i, j)]);
                assert!((mixed[(i, j)] - k).abs() <= 1e-13 * unit, "K[{i},{j}] {k} {}", mixed[(i, j)]);
                assert!((hessian[(i, j)] - hessian[(j, i)]).abs() <= 1e-14 * unit, "asymmetry at {i},{j}");
            }
        }
    }
}

/// From J = 0.1 to 1e-300 and below: finite or an error, and an error that names J once it is not positive.
pub fn collapse(law: &dyn Material) {
    for exponent in 1..=300 {
        let e = -1.0 + 10.0_f64.powi(-exponent);
        for shear in [0.0, 0.3, 10.0] {
            let strain = strain([0.0, 0.0, 0.0, shear, 0.0, e]);
            match respond(law, &strain, Request::Tangent) {
                Ok(response) => assert!(response.is_finite(), "J = 1e-{exponent}"),
                Err(Error::Inadmissible { .. } | Error::InvalidAt { .. }) => {}
                Err(other) => panic!("J = 1e-{exponent}: {other}"),
            }
        }
    }
    for e in [-1.0, -1.5, -3.0] {
        match respond(law, &strain([0.0, 0.0, 0.0, 0.0, 0.0, e]), Request::Wrench) {
            Err(Error::Inadmissible { quantity: "J", value, .. }) => assert_eq!(value, 1.0 + e),
            other => panic!("J = {} gave {other:?}", 1.0 + e),
        }
    }
}

/// NaN, infinity and strains beyond all bounds: finite or an error with a name, never NaN.
pub fn inadmissible(law: &dyn Material) {
    for bad in [f64::NAN, f64::INFINITY] {
        for i in 0..6 {
            let mut xi = [0.0; 6];
            xi[i] = bad;
            let error = respond(law, &strain(xi), Request::Tangent).expect_err("a strain that is no number");
            assert!(error.to_string().contains("strain component"), "{error}");
        }
    }
    for size in [10.0, 1e3, 1e10, 1e100, 1e200] {
        for strain in directions(size) {
            for request in [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate] {
                match respond(law, &strain, request) {
                    Ok(response) => assert!(response.is_finite(), "{strain:?}"),
                    Err(error) => assert!(error.to_string().contains("s = 0 m"), "{error}"),
                }
            }
        }
    }
}
