//! Stiffnesses at rest against closed forms.

use hyperrod::section::Warping;
use std::f64::consts::PI;

use super::{Outcome, Tally, relative, respond, shape, solid, warping};

/// μ = 1, ν = 0.3.
pub const LAMBDA: f64 = 1.5;
const YOUNG: f64 = 2.6;

pub fn run(tally: &mut Tally) -> Outcome {
    let inertia = |name: &str| match name {
        "circle" => [PI, PI / 4.0, PI / 4.0],
        "square" => [1.0, 1.0 / 12.0, 1.0 / 12.0],
        "rect1x2" => [2.0, 2.0 / 3.0, 1.0 / 6.0],
        _ => [PI / 2.0, PI / 32.0, PI / 8.0],
    };
    for name in ["circle", "square", "rect1x2", "ellipse"] {
        let [area, i_x, i_y] = inertia(name);
        for (rung, places) in [
            (Warping::CONTRACTION, &[("EA", 5, area)][..]),
            (Warping::ANTICLASTIC, &[("EI_x", 0, i_x), ("EI_y", 1, i_y)][..]),
        ] {
            let k = respond(&solid(shape(name), LAMBDA, rung)?, [0.0; 6])?.tangent;
            for &(what, place, exact) in places {
                let what = format!("{name}: {what} = E times the moment");
                tally.line(&what, &rung.to_string(), k[(place, place)], YOUNG * exact, 1e-10);
            }
        }
    }
    torsion(tally)?;
    shear(tally)?;
    tangent(tally)
}

/// ∂Ψ/∂Δξ against central differences of Ψ: step 1e-5, of which 1e-10 is left by truncation and 1e-11 by rounding.
fn tangent(tally: &mut Tally) -> Outcome {
    const STEP: f64 = 1e-5;
    let strain = [0.2, -0.1, 0.4, 0.1, 0.05, 0.15];
    for name in ["square", "ellipse"] {
        let section = solid(shape(name), 9.0, Warping::SHEAR)?;
        let k = respond(&section, strain)?.tangent;
        let mut differences = Vec::new();
        for i in 0..6 {
            let psi = |sign: f64| -> Outcome<_> {
                let moved = std::array::from_fn(|j| strain[j] + if i == j { sign * STEP } else { 0.0 });
                Ok(respond(&section, moved)?.wrench.to_vector())
            };
            differences.extend(((psi(1.0)? - psi(-1.0)?) / (2.0 * STEP)).iter().copied());
        }
        let rung = Warping::SHEAR.to_string();
        tally.error(&format!("{name}: asymmetry of the tangent"), &rung, (k - k.transpose()).amax(), 0.0);
        let what = format!("{name}: tangent against differences");
        tally.error(&what, &rung, relative(k.as_slice(), &differences), 1e-8);
    }
    Ok(())
}

/// Saint-Venant's constants, in closed form and by his series.
fn torsion(tally: &mut Tally) -> Outcome {
    let series = |b: f64| {
        let odd = (0..60).map(|n| f64::from(2 * n + 1));
        let sum: f64 = odd.map(|n| (n * PI * b / 2.0).tanh() / n.powi(5)).sum();
        b / 3.0 * (1.0 - 192.0 / (PI.powi(5) * b) * sum)
    };
    let ellipse = PI / 8.0 / 1.25;
    for (name, exact, rungs) in [
        ("ellipse", ellipse, &[((3, 2), 1e-10)][..]),
        ("square", series(1.0), &[((5, 4), 2e-3), ((7, 6), 1e-3), ((9, 8), 1e-3)][..]),
        ("rect1x2", series(2.0), &[((5, 4), 1e-2), ((7, 6), 1e-3), ((9, 8), 1e-3)][..]),
    ] {
        for &(degrees, tolerance) in rungs {
            let k = respond(&solid(shape(name), LAMBDA, warping(degrees))?, [0.0; 6])?.tangent;
            let rung = warping(degrees).to_string();
            tally.line(
                &format!("{name}: Saint-Venant's torsion constant"),
                &rung,
                k[(2, 2)],
                exact,
                tolerance,
            );
        }
    }
    Ok(())
}

fn shear(tally: &mut Tally) -> Outcome {
    for (name, area, factors) in [
        ("square", 1.0, [5.0 / 6.0; 2]),
        ("rect1x2", 2.0, [5.0 / 6.0; 2]),
        ("circle", PI, [6.0 / 7.0; 2]),
        ("ellipse", PI / 2.0, [39.0 / 44.0, 21.0 / 26.0]),
    ] {
        let rung = warping((2, 3));
        let k = respond(&solid(shape(name), LAMBDA, rung)?, [0.0; 6])?.tangent;
        for (place, axis, exact) in [(3, "x", factors[0]), (4, "y", factors[1])] {
            let what = format!("{name}: shear factor {exact:.4} along {axis}");
            tally.line(&what, &rung.to_string(), k[(place, place)] / area, exact, 1e-8);
        }
    }
    Ok(())
}
