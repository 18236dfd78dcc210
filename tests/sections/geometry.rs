//! Area, first and second moments of every shape against closed forms, from the lowest quadrature a section ever has.

use std::f64::consts::PI;

use hyperrod::material::LinearElastic;
use hyperrod::quadrature::Rule;
use hyperrod::section::*;

fn moments(shape: impl Shape) -> AreaMoments {
    let section = Section::new(shape, LinearElastic::new(1e6, 3e5).unwrap()).unwrap();
    assert_eq!(section.degree(), 2);
    section.moments(0.3).unwrap()
}

/// Relative to A, A r, A r² with the polar radius r: 2e-15 is some ten roundings.
fn assert_moments(name: &str, m: AreaMoments, [area, x, y, i_x, i_y, i_xy]: [f64; 6]) {
    let (second, first) = (i_x + i_y, (area * (i_x + i_y)).sqrt());
    let errors = [
        (m.area - area) / area,
        (m.first[0] - x) / first,
        (m.first[1] - y) / first,
        (m.i_x - i_x) / second,
        (m.i_y - i_y) / second,
        (m.i_xy - i_xy) / second,
    ];
    let worst = errors.iter().fold(0.0, |worst: f64, e| worst.max(e.abs()));
    println!("{name}: {worst:.1e}");
    assert!(worst < 2e-15, "{name}: {errors:?}");
}

/// By Green's theorem: ∫x^p y^q dA over a polygon as a sum over its edges.
fn green(vertices: &[[f64; 2]]) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for (i, [x, y]) in vertices.iter().enumerate() {
        let [u, v] = vertices[(i + 1) % vertices.len()];
        let cross = x * v - u * y;
        let terms = [
            cross / 2.0,
            cross * (x + u) / 6.0,
            cross * (y + v) / 6.0,
            cross * (y * y + y * v + v * v) / 12.0,
            cross * (x * x + x * u + u * u) / 12.0,
            cross * (x * v + 2.0 * x * y + 2.0 * u * v + u * y) / 24.0,
        ];
        sum.iter_mut().zip(terms).for_each(|(s, t)| *s += t);
    }
    sum
}

const L: [[f64; 2]; 6] =
    [[-0.011, -0.006], [0.019, -0.006], [0.019, 0.0], [-0.005, 0.0], [-0.005, 0.014], [-0.011, 0.014]];

#[test]
fn every_shape_has_the_moments_of_its_closed_form() {
    let r4 = |r: f64| PI * r.powi(4) / 4.0;
    assert_moments("circle", moments(Circle::new(0.01)), [PI * 1e-4, 0.0, 0.0, r4(0.01), r4(0.01), 0.0]);
    let (ri, ro) = (0.006, 0.01);
    let i = r4(ro) - r4(ri);
    assert_moments("annulus", moments(Annulus::new(ri, ro)), [PI * (ro * ro - ri * ri), 0.0, 0.0, i, i, 0.0]);
    let full = moments(Annulus::new(0.0, ro));
    assert_moments("full annulus", full, [PI * ro * ro, 0.0, 0.0, r4(ro), r4(ro), 0.0]);
    // a wall of 1e-6 of the radius: A = 2πRt(1 − t/2R) and I = AR²(…)/2 to rounding of the radii themselves
    let (ri, ro) = (1.0, 1.0 + 2f64.powi(-20));
    let area = PI * (ro - ri) * (ro + ri);
    let i = area * (ro * ro + ri * ri) / 4.0;
    assert_moments("thin annulus", moments(Annulus::new(ri, ro)), [area, 0.0, 0.0, i, i, 0.0]);
    let (a, b) = (0.02f64, 0.005f64);
    assert_moments(
        "ellipse",
        moments(Ellipse::new(a, b)),
        [PI * a * b, 0.0, 0.0, PI * a * b.powi(3) / 4.0, PI * a.powi(3) * b / 4.0, 0.0],
    );
    assert_moments(
        "rectangle",
        moments(Rectangle::new(a, b)),
        [a * b, 0.0, 0.0, a * b.powi(3) / 12.0, b * a.powi(3) / 12.0, 0.0],
    );
    for n in [3, 4, 5, 6, 17] {
        let (t, r) = (2.0 * PI / n as f64, 0.01f64);
        let i = n as f64 / 24.0 * r.powi(4) * t.sin() * (2.0 + t.cos());
        let area = n as f64 / 2.0 * r * r * t.sin();
        assert_moments(
            "regular polygon",
            moments(RegularPolygon::new(n, r).unwrap()),
            [area, 0.0, 0.0, i, i, 0.0],
        );
    }
    assert_moments("L", moments(Polygon::new(L.to_vec()).unwrap()), green(&L));
    let hole = [[-0.009, -0.004], [0.0, -0.004], [0.0, -0.002], [-0.009, -0.001]];
    let holed = Polygon::new(L.to_vec()).unwrap().with_hole(hole.to_vec()).unwrap();
    let (outer, inner) = (green(&L), green(&hole));
    assert_moments("L with a hole", moments(holed), std::array::from_fn(|i| outer[i] - inner[i]));
    let wires = Rule::new(vec![1.0, -1.0, 2.0], vec![0.0, 3.0, 1.0], vec![0.5, 0.25, 1.0], 12).unwrap();
    assert_moments("points", moments(PointCloud::new(wires)), [1.75, 2.25, 1.75, 3.25, 4.75, 1.25]);
}

/// A rectangle b × h moved by (dx, dy), then turned by φ about the axis.
#[test]
fn a_shape_is_scaled_shifted_and_rotated_in_the_order_written() {
    let (b, h, dx, dy, angle, factor) = (0.02, 0.008, 0.03, -0.01, 0.7f64, 1.5);
    let corners = [[-b / 2.0, -h / 2.0], [b / 2.0, -h / 2.0], [b / 2.0, h / 2.0], [-b / 2.0, h / 2.0]];
    let (sin, cos) = angle.sin_cos();
    let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let shape = Rectangle::new(b, h).scaled(factor).shifted(dx, dy).rotated(angle);
    let image = corners.map(|[x, y]| turn([factor * x + dx, factor * y + dy]));
    assert_moments("scaled, shifted, rotated", moments(shape), green(&image));
    let shape = Rectangle::new(b, h).rotated(angle).shifted(dx, dy).scaled(factor);
    let image = corners.map(turn).map(|[x, y]| [factor * (x + dx), factor * (y + dy)]);
    assert_moments("rotated, shifted, scaled", moments(shape), green(&image));
}

#[test]
fn principal_axes_turn_with_the_section() {
    let [b, h] = [0.02f64, 0.008f64];
    for angle in [0.0, 0.3, 1.2, -0.9, 1.5] {
        let m = moments(Rectangle::new(b, h).shifted(0.01, 0.02).rotated(angle));
        let [x, y] = m.centroid();
        let (sin, cos) = f64::sin_cos(angle);
        assert!(
            (x - (cos * 0.01 - sin * 0.02)).abs() < 1e-16 && (y - (sin * 0.01 + cos * 0.02)).abs() < 1e-16
        );
        let axes = m.about_centroid().principal_axes();
        // 1e-14: the parallel-axis term is ten times the moment that remains
        assert!((axes.largest - h * b.powi(3) / 12.0).abs() < 1e-14 * axes.largest);
        assert!((axes.smallest - b * h.powi(3) / 12.0).abs() < 1e-13 * axes.smallest);
        // stiffest about its y, which is at angle + π/2, up to a half turn
        assert!((2.0 * (axes.angle - angle) - PI).sin().abs() < 1e-13, "{angle} {}", axes.angle);
        assert!((axes.angle - angle).cos().abs() < 1e-13);
    }
    let round = moments(RegularPolygon::new(5, 0.01).unwrap()).principal_axes();
    assert_eq!(round.angle, 0.0);
    assert!((round.largest - round.smallest) < 1e-14 * round.largest);
}

#[test]
fn a_composite_adds_areas_and_weighs_densities() {
    let law = LinearElastic::new(1e6, 3e5).unwrap();
    let core = Section::new(Circle::new(0.004), law).unwrap();
    let sleeve = Section::new(Annulus::new(0.004, 0.01), law).unwrap();
    let cable = Composite::new(sleeve).with_relative_density(core, 3.0).unwrap();
    let i = PI * 1e-8 / 4.0;
    assert_moments("composite", cable.moments(0.0).unwrap(), [PI * 1e-4, 0.0, 0.0, i, i, 0.0]);
    let mass = cable.weighted_moments(0.0).unwrap().area;
    assert!((mass - PI * (1e-4 + 2.0 * 1.6e-5)).abs() < 1e-18);
    assert_eq!(cable.part_count(), 2);
}
