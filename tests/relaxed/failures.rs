//! What a relaxed section refuses, and how it says so; what it reports.
use hyperrod::material::{Invariants, Isotropic, NeoHookean, Point, Reference, Station};
use hyperrod::quadrature::{Rule, rectangle};
use hyperrod::section::{
    Circle, CrossSection, Deformable, EffectiveStiffness, Linear, PathOptions, PointCloud, Rectangle,
    Relaxed, Section, Shape, StrainRange, Warping, WrenchPath,
};
use hyperrod::{Error, Scalar, Strain, Twist, Wrench};
use nalgebra::Matrix3;

use crate::{at_rest, relative, respond, solid};

fn rubber() -> NeoHookean {
    NeoHookean::new(1.0, 9.0).unwrap()
}

#[test]
fn a_basis_too_rich_for_its_quadrature_is_refused() {
    // asked for by degree
    let section = Relaxed::new(Circle::new(1.0), rubber()).unwrap();
    let poor = section.with_degree(6);
    assert!(
        matches!(
            poor,
            Err(Error::Invalid { quantity: "degree of the quadrature of a relaxed section", value: 6.0, .. })
        ),
        "{poor:?}"
    );
    // given by points: nine of them cannot tell 21 functions apart
    let square = rectangle(4).unwrap();
    let points = PointCloud::new(
        Rule::new(square.x().into(), square.y().into(), square.weights().into(), 12).unwrap(),
    );
    let poor = Relaxed::new(points, rubber());
    assert!(
        matches!(
            poor,
            Err(Error::Invalid { quantity: "independent functions for the displacement of a section", .. })
        ),
        "{poor:?}"
    );
}

#[test]
fn degrees_beyond_the_largest_and_an_incompressible_rigid_section_are_refused() {
    let section = || Relaxed::new(Circle::new(1.0), rubber()).unwrap();
    assert!(section().with_warping(Warping { in_plane: 13, axial: 0 }).is_err());
    let rigid = Relaxed::incompressible(Circle::new(1.0), rubber()).unwrap().with_warping(Warping::RIGID);
    assert!(matches!(
        rigid,
        Err(Error::Invalid { quantity: "in-plane degree of an incompressible section", .. })
    ));
}

/// A law without stability at rest: it would rather be sheared. Invariants cannot tell x from y, so the round section stays an
/// equilibrium, at a saddle.
struct DoubleWell;

impl Isotropic for DoubleWell {
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        // neo-Hookean but for a negative share of (Ī₁ − 3) that saturates: the shear modulus is 1 − 3 = −2 at rest, 1 far away
        let ln_j = i.j().ln_1p();
        let distortion = i.i1_isochoric();
        distortion * 0.5 - (-distortion * 4.0).exp_m1() * (-1.5 / 4.0) + ln_j * ln_j * 4.0
    }
}

#[test]
fn a_section_that_has_lost_its_stability_says_in_which_mode() {
    let section =
        Relaxed::new(Circle::new(1.0), DoubleWell).unwrap().with_warping(Warping::CONTRACTION).unwrap();
    let error = section.energy(&at_rest(), &Strain::zero()).unwrap_err();
    let Error::SectionUnstable { mode, eigenvalue, .. } = &error else { panic!("{error}") };
    assert!(*eigenvalue < 0.0 && mode.contains("degree 1"), "{error}");
    assert!(error.to_string().contains("unstable"));
}

/// Symmetry keeps Newton's method on the ridge: it ends at an equilibrium, and the equilibrium is refused, because a state that no
/// symmetric step reaches, sheared in the plane, has a lower energy.
#[test]
fn a_saddle_is_refused_although_it_is_an_equilibrium() {
    let section =
        Relaxed::new(Circle::new(1.0), DoubleWell).unwrap().with_warping(Warping::CONTRACTION).unwrap();
    let strain = Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, 1e-3]);
    let error = section.energy(&at_rest(), &strain).unwrap_err();
    assert!(matches!(error, Error::SectionUnstable { .. }), "{error}");
    let energy = |x: f64, y: f64| {
        let h = Matrix3::from_diagonal(&nalgebra::Vector3::new(x - 1.0, y - 1.0, 1e-3));
        DoubleWell.energy_density(&Invariants::of_gradient(&h), &Point { x: 0.0, y: 0.0, s: 0.0 })
    };
    assert!(
        energy(1.2, 1.0 / 1.2) < energy(1.0, 1.0) - 1e-3,
        "{} {}",
        energy(1.2, 1.0 / 1.2),
        energy(1.0, 1.0)
    );
}

#[test]
fn a_strain_that_turns_points_inside_out_is_refused_with_its_place() {
    let section = solid(Circle::new(1.0), 9.0, (2, 0));
    let error = section.energy(&at_rest(), &Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, -1.1])).unwrap_err();
    assert!(matches!(error, Error::Inadmissible { quantity: "J", .. }), "{error}");
    let error =
        section.energy(&at_rest(), &Strain::from_array([f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0])).unwrap_err();
    assert!(matches!(error, Error::InvalidAt { quantity: "strain component omega_x", .. }), "{error}");
    let tapered = Relaxed::new(Circle::new(Linear { from: 1.0, to: 0.0, length: 1.0 }), rubber()).unwrap();
    assert!(tapered.energy(&Station::straight(2.0), &Strain::zero()).is_err());
}

/// About a curved reference a section must not reach the centre of curvature: j = 1 − κ y at y = ½.
#[test]
fn a_reference_curved_into_its_section_is_refused_with_the_place() {
    let section = Relaxed::new(Rectangle::new(1.0, 1.0), rubber()).unwrap();
    let curved = |curvature: f64| {
        let mut twist = Twist::zero();
        (twist.angular.x, twist.linear.z) = (curvature, 1.0);
        Station { s: 0.4, reference: Reference { twist, rate: Twist::zero() } }
    };
    assert!(section.energy(&curved(1.5), &Strain::zero()).unwrap().abs() < 1e-12);
    let error = section.energy(&curved(-2.5), &Strain::zero()).unwrap_err();
    let Error::Inadmissible { quantity, value, s, y, .. } = &error else { panic!("{error}") };
    assert!(quantity.contains("reference") && *value < 0.0 && *s == 0.4 && y.abs() > 0.3, "{error}");
}

/// Oracle: a relaxed section without modes, whose integral of the tractions is Ψ.
#[test]
fn a_rigid_section_shows_its_points_too() {
    let strain = Strain::from_array([0.2, -0.1, 0.4, 0.1, 0.05, 0.15]);
    let rigid = Section::new(Rectangle::new(1.0, 0.5), rubber()).unwrap();
    let unrelaxed =
        Relaxed::new(Rectangle::new(1.0, 0.5), rubber()).unwrap().with_warping(Warping::RIGID).unwrap();
    let shown = rigid.deformed(&at_rest(), &strain).unwrap();
    let same = unrelaxed.deformed(&at_rest(), &strain).unwrap();
    let (a, b) = (shown.point(0.3, -0.2).unwrap(), same.point(0.3, -0.2).unwrap());
    assert!((a.gradient - b.gradient).norm() < 1e-15 && (a.piola - b.piola).norm() < 1e-13);
    assert!(a.position == [0.3, -0.2, 0.0] && shown.extremes().unwrap().stress.von_mises() > 0.1);
    let inside_out = Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, -1.1]);
    assert!(matches!(rigid.deformed(&at_rest(), &inside_out), Err(Error::Inadmissible { .. })));
}

/// A bent section reached only by small steps: a curvature of 0.9 / R from nothing, against the same along a path of warm starts.
#[test]
fn a_strain_far_away_is_reached_and_does_not_depend_on_the_way() {
    let section = solid(Circle::new(1.0), 9.0, (4, 0));
    let strain = |f: f64| Strain::from_array([0.8 * f, 0.0, 0.5 * f, 0.0, 0.0, 0.1 * f]);
    let request = hyperrod::material::Request::Tangent;
    let (cold, _) = section.respond_from(None, &at_rest(), &strain(1.0), request).unwrap();
    let mut start = None;
    for k in 1..=20 {
        let (_, next) =
            section.respond_from(start.as_ref(), &at_rest(), &strain(f64::from(k) / 20.0), request).unwrap();
        start = Some(next);
    }
    let (warm, _) = section.respond_from(start.as_ref(), &at_rest(), &strain(1.0), request).unwrap();
    assert!(relative(&warm.wrench.to_array(), &cold.wrench.to_array()) < 1e-12);
}

/// Oracle: Ψ = ∫ (r + w) × P e₃, P e₃ over the points that `deformed` shows, and free sides: P n = 0 on the rim to the accuracy of the
/// basis.
#[test]
fn stresses_at_points_carry_the_wrench_and_leave_the_sides_free() {
    let section = solid(Circle::new(1.0), 9.0, (5, 4));
    let strain = [0.2, -0.1, 0.4, 0.1, 0.05, 0.15];
    let psi = respond(&section, strain).wrench.to_array();
    let deformed = section.deformed(&at_rest(), &Strain::from_array(strain)).unwrap();
    // an independent quadrature: Gauss in the radius, 40 equal angles
    let mut sum = [0.0; 6];
    let (radii, weights): (Vec<f64>, Vec<f64>) = {
        let rule = hyperrod::quadrature::gauss_legendre(12).unwrap();
        (rule.nodes().to_vec(), rule.weights().to_vec())
    };
    for (t, w) in radii.iter().zip(&weights) {
        let r = 0.5 * (t + 1.0);
        for k in 0..40 {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 40.0).sin_cos();
            let point = deformed.point(r * cos, r * sin).unwrap();
            let area = 0.5 * w * r * std::f64::consts::TAU / 40.0;
            let (p, x) = (point.piola.column(2).into_owned(), nalgebra::Vector3::from(point.position));
            let moment = x.cross(&p);
            for i in 0..3 {
                sum[i] += area * moment[i];
                sum[3 + i] += area * p[i];
            }
        }
    }
    assert!(relative(&sum, &psi) < 1e-6, "{sum:?} {psi:?}");
    let (sin, cos) = 0.7_f64.sin_cos();
    let rim = deformed.point(cos, sin).unwrap();
    let normal = nalgebra::Vector3::new(cos, sin, 0.0);
    assert!(
        (rim.piola * normal).norm() < 2e-2 * rim.piola.norm(),
        "{}",
        (rim.piola * normal).norm() / rim.piola.norm()
    );
    let asymmetry: Matrix3<f64> = rim.cauchy() - rim.cauchy().transpose();
    assert!(asymmetry.norm() < 1e-12 * rim.cauchy().norm());
    let extremes = deformed.extremes().unwrap();
    assert!(extremes.stretch.largest_stretch() >= 1.2 && extremes.stress.von_mises() > 0.5);
}

/// Oracle: Steiner: centres where the section is, and stiffnesses about them those of the centred one.
#[test]
fn the_report_finds_the_centres_of_a_section_beside_the_axis() {
    let stiffness = |shape: Box<dyn Shape>| {
        let section = Relaxed::new(shape, rubber()).unwrap().with_warping(Warping::SHEAR).unwrap();
        EffectiveStiffness::of(&section, &at_rest(), &Strain::zero()).unwrap()
    };
    let centred = stiffness(Box::new(Rectangle::new(1.0, 0.5)));
    let beside = stiffness(Box::new(Rectangle::new(1.0, 0.5).shifted(0.3, -0.2)));
    assert!(relative(&beside.shear_centre, &[0.3, -0.2]) < 1e-9, "{:?}", beside.shear_centre);
    assert!(relative(&beside.tension_centre, &[0.3, -0.2]) < 1e-9, "{:?}", beside.tension_centre);
    let list =
        |s: &EffectiveStiffness| [s.axial, s.bending[0], s.bending[1], s.torsion, s.shear[0], s.shear[1]];
    for (a, b) in list(&beside).iter().zip(list(&centred)) {
        assert!((a / b - 1.0).abs() < 1e-8, "{beside:?} {centred:?}");
    }
}

/// The moment of a bent rubber tube has a limit: found by arc length, stationary there, and passed.
#[test]
fn a_bent_tube_has_a_limit_moment_that_the_path_passes() {
    let section = solid(hyperrod::section::Annulus::new(0.5, 1.0), 1.5, (3, 0));
    let moment = Wrench::from_array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let options = PathOptions { largest: 0.45, step: 0.1, max_points: 20 };
    let path = WrenchPath::follow(&section, &at_rest(), &moment, &options).unwrap();
    assert!(path.ended.is_none(), "{:?}", path.ended);
    let limit = path.limits.first().expect("a limit point");
    let highest = path.points.iter().map(|p| p.load).fold(0.0, f64::max);
    assert!(limit.load >= highest, "{} {highest}", limit.load);
    // 0.5400 with this basis: that of k, m ≤ 3
    assert!((limit.load - 0.53999).abs() < 1e-4, "{}", limit.load);
    let k = respond(&section, limit.strain.to_array()).tangent;
    let eigenvalues = k.symmetric_eigenvalues();
    assert!(
        eigenvalues.min().abs() < 1e-6 * eigenvalues.max(),
        "the tangent is singular at the limit: {eigenvalues}"
    );
}

#[test]
fn the_ladder_is_climbed_until_the_wrench_stays_and_thin_sections_are_told() {
    let range = StrainRange { axial: 0.1, shear: 0.1, ..Default::default() };
    let (section, report) =
        Relaxed::new(Rectangle::new(1.0, 1.0), rubber()).unwrap().choose(2e-3, &range).unwrap();
    assert!(report.reached && !report.thin, "{report}");
    assert_eq!(section.warping(), report.chosen);
    assert!(report.chosen >= Warping::SHEAR && report.estimated_error <= 2e-3, "{report}");
    assert!(report.steps[0].difference > 0.1, "a rigid section is wrong: {report}");
    let (_, report) =
        Relaxed::new(Rectangle::new(1.0, 10.0), rubber()).unwrap().choose(1e-9, &range).unwrap();
    assert!(!report.reached && report.thin && report.to_string().contains("thin"), "{report}");
    // an L, whose inner corner polynomials cannot follow
    let corners = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.4], [0.4, 0.4], [0.4, 1.0], [0.0, 1.0]];
    let angle = hyperrod::section::Polygon::new(corners).unwrap().shifted(-0.35, -0.35);
    let (_, report) = Relaxed::new(angle, rubber()).unwrap().choose(1e-4, &range).unwrap();
    assert!(!report.reached && report.to_string().contains("re-entrant"), "{report}");
}
