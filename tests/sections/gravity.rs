//! The weight of a section whose centroid is off the axis.

use std::f64::consts::PI;

use hyperrod::body::HasMass;
use hyperrod::lie::so3;
use hyperrod::load::{Gravity, Load};
use hyperrod::material::LinearElastic;
use hyperrod::section::*;
use hyperrod::{Body, Pose, Rod, Statics, Twist};
use nalgebra::{Vector3, vector};

fn law() -> LinearElastic {
    LinearElastic::new(1e6, 4e5).unwrap()
}

fn pose() -> Pose {
    Pose::new(so3::exp(&vector![0.4, -0.8, 0.3]), vector![0.1, 0.2, -0.3])
}

fn offset_body() -> Body<Section<Shifted<Circle>, LinearElastic>, hyperrod::body::Density> {
    let section = Section::new(Circle::new(0.01).shifted(0.004, -0.007), law()).unwrap();
    Body::new(0.3, section).unwrap().with_density(1100.0).unwrap()
}

#[test]
fn the_weight_pulls_at_the_centroid() {
    let (body, pose) = (offset_body(), pose());
    let load = Gravity::standard().at(&body, 0.1, &pose).unwrap();
    let force = pose.rotation.transpose() * vector![0.0, 0.0, -9.80665] * (1100.0 * PI * 1e-4);
    let moment = vector![0.004, -0.007, 0.0].cross(&force);
    assert!((load.wrench.force - force).norm() < 1e-15 * force.norm());
    assert!((load.wrench.moment - moment).norm() < 2e-15 * moment.norm());
    let height = (pose.position + pose.rotation * vector![0.004, -0.007, 0.0]).z;
    let weight = 9.80665 * 1100.0 * PI * 1e-4;
    assert!((load.potential.unwrap() - weight * height).abs() < 1e-15 * weight);
}

/// Central differences in ζ with h = 1e-5: error h²/6 + ε/h ≈ 4e-11 of the size.
#[test]
fn tangent_and_potential_are_the_derivatives() {
    let (body, pose, h) = (offset_body(), pose(), 1e-5);
    let gravity = Gravity::new(vector![3.0, -5.0, -8.0]).unwrap();
    let load = gravity.at(&body, 0.1, &pose).unwrap();
    let (mut worst, size) = (0.0f64, load.wrench.to_vector().norm());
    for j in 0..6 {
        let at = |step: f64| {
            let zeta = Twist::from_array(std::array::from_fn(|i| if i == j { step } else { 0.0 }));
            gravity.at(&body, 0.1, &(pose * zeta.exp())).unwrap()
        };
        let (ahead, behind) = (at(h), at(-h));
        for i in 0..6 {
            let slope = (ahead.wrench.to_array()[i] - behind.wrench.to_array()[i]) / (2.0 * h);
            worst = worst.max((slope - load.tangent[(i, j)]).abs() / size);
        }
        let slope = (ahead.potential.unwrap() - behind.potential.unwrap()) / (2.0 * h);
        worst = worst.max((slope + load.wrench.to_array()[j]).abs() / size);
    }
    println!("gravity: derivatives against differences {worst:.1e}");
    assert!(worst < 1e-9, "{worst:e}");
}

/// A slice of a torus segment: volume per length A (its centroid circle is the axis), centre of mass off by κI/A outwards.
#[test]
fn a_slice_of_a_curved_rod_is_thicker_outside() {
    let (r, kappa) = (0.01, 30.0);
    let body =
        Body::new(0.1, Section::new(Circle::new(r), law()).unwrap()).unwrap().with_density(1000.0).unwrap();
    let body = body.with_reference_strain(Twist::from_array([0.0, kappa, 0.0, 0.0, 0.0, 1.0])).unwrap();
    let mass = body.line_mass(0.05).unwrap();
    let (area, i) = (PI * r * r, PI * r.powi(4) / 4.0);
    assert!((mass.mass - 1000.0 * area).abs() < 1e-13 * mass.mass);
    // j = 1 − κx is less on the side of the centre of curvature, x = 1/κ
    assert!((mass.first[0] + 1000.0 * kappa * i).abs() < 1e-13 * 1000.0 * kappa * i);
    assert!(mass.first[1].abs() < 1e-13 * 1000.0 * kappa * i);
}

/// The same rod described about two axes: through the centroid, and beside it. Where the base turns with the section, all
/// places of the body are the same.
#[test]
fn a_rod_hangs_alike_whichever_axis_describes_it() {
    let offset = vector![0.006, -0.004, 0.0];
    let rotation = so3::exp(&vector![0.3, 1.3, 0.0]);
    let solve = |shift: Vector3<f64>, base: Vector3<f64>| {
        let section = Section::new(Rectangle::new(0.02, 0.012).shifted(shift.x, shift.y), law()).unwrap();
        let body = Body::new(0.25, section).unwrap().with_density(1200.0).unwrap();
        let rod = Rod::clamped(body, Pose::new(rotation, base)).with_load(Gravity::standard());
        let statics = Statics { elements: 12, ..Default::default() };
        let solution = statics.solve(&rod).unwrap();
        let tip = solution.nodes().last().unwrap().pose;
        (tip, solution.report().error.position)
    };
    let (centred, _) = solve(Vector3::zeros(), Vector3::zeros());
    let (beside, _) = solve(offset, -(rotation * offset));
    let place = beside.position + beside.rotation * offset;
    let gap = (place - centred.position).norm() / 0.25;
    let turn = (beside.rotation - centred.rotation).norm();
    let bent = (centred.rotation - rotation).norm();
    println!("two axes: tip {gap:.1e}, rotation {turn:.1e}, bent by {bent:.2}");
    assert!(bent > 0.3, "the rod must bend for this to mean anything");
    // the mesh error of order 6 is that of the element, which is not the same about two axes
    assert!(gap < 1e-8 && turn < 1e-7, "{gap:e} {turn:e}");
}
