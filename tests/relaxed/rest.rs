//! The small-strain stiffnesses come out of the energy.
use hyperrod::section::{Annulus, Circle, Ellipse, Rectangle, Shape};
use std::f64::consts::PI;

use crate::{respond, solid};

/// λ for which E = μ(3λ+2μ)/(λ+μ) = 2.6 and ν = 0.3.
const LAMBDA: f64 = 1.5;
const YOUNG: f64 = 2.6;

fn shapes() -> [(&'static str, Box<dyn Shape>, [f64; 3]); 4] {
    let (a, b) = (1e-3, 0.4e-3);
    let quarter = PI / 4.0;
    [
        ("circle", Box::new(Circle::new(a)), [PI * a * a, quarter * a.powi(4), quarter * a.powi(4)]),
        ("square", Box::new(Rectangle::new(a, a)), [a * a, a.powi(4) / 12.0, a.powi(4) / 12.0]),
        (
            "rectangle",
            Box::new(Rectangle::new(a, 2.0 * a)),
            [2.0 * a * a, 8.0 * a.powi(4) / 12.0, 2.0 * a.powi(4) / 12.0],
        ),
        (
            "ellipse",
            Box::new(Ellipse::new(a, b)),
            [PI * a * b, quarter * a * b.powi(3), quarter * a.powi(3) * b],
        ),
    ]
}

/// Oracle: closed form, E·A and E·I. 1e-10 leaves six digits to rounding, on a section of 1 mm.
#[test]
fn a_section_that_contracts_and_bends_back_has_the_young_s_modulus_of_its_material() {
    for (name, shape, [area, i_x, i_y]) in shapes() {
        let k = respond(&solid(shape, LAMBDA, (2, 0)), [0.0; 6]).tangent;
        for (got, exact) in [(k[(5, 5)], YOUNG * area), (k[(0, 0)], YOUNG * i_x), (k[(1, 1)], YOUNG * i_y)] {
            assert!((got / exact - 1.0).abs() < 1e-10, "{name}: {got} instead of {exact}");
        }
    }
}

/// Oracle: μπa³b³/(a²+b²), reached by the quadratic warping xy.
#[test]
fn the_torsion_constant_of_an_ellipse_is_exact_with_quadratic_warping() {
    let (a, b): (f64, f64) = (1.0, 0.5);
    let k = respond(&solid(Ellipse::new(a, b), LAMBDA, (3, 2)), [0.0; 6]).tangent;
    let exact = PI * (a * b).powi(3) / (a * a + b * b);
    assert!((k[(2, 2)] / exact - 1.0).abs() < 1e-10, "{}", k[(2, 2)]);
}

/// Oracle: Saint-Venant's series, 0.140577014955 for the unit square and 0.4573673 for 1 × 2.
/// (5, 4) reaches 1.2e-3 and 6.7e-3, (7, 6) 6.2e-4 and 3.7e-4: 1e-3 is asked of the rung that gets there.
#[test]
fn the_torsion_constants_of_square_and_rectangle_converge_from_above() {
    let series = |b: f64| {
        let sum: f64 =
            (0..60).map(|n| f64::from(2 * n + 1)).map(|n| (n * PI * b / 2.0).tanh() / n.powi(5)).sum();
        b / 3.0 * (1.0 - 192.0 / (PI.powi(5) * b) * sum)
    };
    for (b, rung) in [(1.0, (7, 6)), (2.0, (7, 6))] {
        let shape = || Rectangle::new(1.0, b);
        let low = respond(&solid(shape(), LAMBDA, (3, 2)), [0.0; 6]).tangent[(2, 2)];
        let high = respond(&solid(shape(), LAMBDA, rung), [0.0; 6]).tangent[(2, 2)];
        let exact = series(b);
        assert!(low > high && high > exact, "an upper bound that falls: {low} {high} {exact}");
        assert!(high / exact - 1.0 < 1e-3, "{b}: {:e}", high / exact - 1.0);
    }
}

/// Oracle: 5/6 and 6/7 (conditions on the displacement that hold no Poisson's ratio), exact with cubic warping.
#[test]
fn the_shear_factors_are_5_6_and_6_7() {
    let factor = |shape: Box<dyn Shape>, area: f64| {
        let k = respond(&solid(shape, LAMBDA, (2, 3)), [0.0; 6]).tangent;
        [k[(3, 3)] / area, k[(4, 4)] / area]
    };
    for (got, exact) in [
        (factor(Box::new(Rectangle::new(1.0, 1.0)), 1.0), [5.0 / 6.0; 2]),
        (factor(Box::new(Rectangle::new(1.0, 2.0)), 2.0), [5.0 / 6.0; 2]),
        (factor(Box::new(Circle::new(1.0)), PI), [6.0 / 7.0; 2]),
        (factor(Box::new(Ellipse::new(1.0, 0.5)), PI / 2.0), [39.0 / 44.0, 21.0 / 26.0]),
    ] {
        assert!(crate::relative(&got, &exact) < 1e-8, "{got:?} instead of {exact:?}");
    }
}

/// Oracle: closed forms of a tube with inner radius ½: EA, EI, GJ = μ(I_x+I_y), and the shear factor 10/17, whose warping holds r⁻¹
/// and converges in k: 1e-4 with rᵏ up to k = 3.
#[test]
fn a_tube_takes_functions_of_radius_and_angle() {
    let k = respond(&solid(Annulus::new(0.5, 1.0), LAMBDA, (2, 3)), [0.0; 6]).tangent;
    let (area, i) = (PI * 0.75, PI / 4.0 * (1.0 - 0.0625));
    let got = [k[(5, 5)], k[(0, 0)], k[(1, 1)], k[(2, 2)]];
    assert!(crate::relative(&got, &[YOUNG * area, YOUNG * i, YOUNG * i, 2.0 * i]) < 1e-10, "{got:?}");
    assert!((k[(3, 3)] / area - 10.0 / 17.0).abs() < 1e-3, "{}", k[(3, 3)] / area);
}
