//! The strong form: its defect along a solution, its load on the rate, its inertia, and what it refuses.

use hyperrod::body::{Constraint, Density};
use hyperrod::load::{DeadWrench, Gravity};
use hyperrod::material::{NeoHookean, Request};
use hyperrod::rod::{Motion, RateLoad, SectionState};
use hyperrod::section::{
    Actuated, Circle, CrossSection, Helical, Linear, Resultant, Resultants, Section, Stiffness, Tendon,
};
use hyperrod::solve::Order;
use hyperrod::{Body, Error, Pose, Rod, Scalar, Statics, Strain, Twist, Wrench};
use nalgebra::{Matrix6, Vector6, vector};
use num_dual::Dual64;

const LENGTH: f64 = 0.3;

type Arm = Body<Actuated<Section<Circle<Linear>, NeoHookean>>, Density>;

/// Tapered, neo-Hookean, heavy, with a helical tendon and a reference that varies.
fn arm() -> Rod<Arm> {
    let taper = Linear { from: 0.02, to: 0.012, length: LENGTH };
    let section = Section::new(Circle::new(taper), NeoHookean::new(2e5, 3e5).unwrap()).unwrap();
    let tendon = Tendon::new(Helical { radius: 9e-3, pitch: 0.5, start: 0.3 }, 5.0).unwrap();
    let body = Body::new(LENGTH, section.with_actuator(tendon)).unwrap();
    let body = body
        .with_varying_reference(|s: Dual64| {
            let (one, zero) = (Dual64::from_re(1.0), Dual64::from_re(0.0));
            Twist::from_array([s * 6.0 + 1.0, s * s * 20.0 - 2.0, one * 0.5, zero, zero, s * 0.1 + 1.0])
        })
        .unwrap();
    Rod::clamped(body.with_density(1100.0).unwrap(), Pose::identity())
        .with_load(Gravity::new(vector![2.0, -9.0, 1.0]).unwrap())
        .with_tip_load(DeadWrench::force(vector![1.0, 0.6, -0.3]).unwrap())
}

/// The largest defect Δξ′ − formula, relative to the largest Δξ′, with Δξ′ by 13-point differences of the strains of the nodes.
fn defect(rod: &Rod<Arm>, order: Order, elements: usize) -> f64 {
    const REACH: usize = 6;
    let factorial = |n: usize| (1..=n).map(|i| i as f64).product::<f64>();
    let weights: [f64; REACH] = std::array::from_fn(|i| {
        let k = i + 1;
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        sign * factorial(REACH).powi(2) / (k as f64 * factorial(REACH - k) * factorial(REACH + k))
    });
    let statics = Statics { elements, order, tolerance: 1e-11, ..Statics::default() };
    let solution = statics.solve(rod).unwrap();
    let nodes = solution.nodes();
    let size = |strain: &Strain| strain.linear.norm().max(strain.angular.norm() * LENGTH);
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    // at the same places on every mesh
    for i in (4..=12).map(|k| k * elements / 16) {
        let mut slope = Strain::zero();
        for (k, weight) in (1..).zip(weights) {
            slope += (nodes[i + k].strain - nodes[i - k].strain) * (weight * elements as f64 / LENGTH);
        }
        let node = &nodes[i];
        let at = SectionState { s: node.s, pose: node.pose, strain: node.strain, motion: None };
        let rate = rod.strain_rate(&at).unwrap();
        largest = largest.max(size(&rate.strain));
        worst = worst.max(size(&(slope - rate.strain)));
    }
    worst / largest
}

/// Without Ψ′, the taper and the reference would leave a defect that does not fall. (At order six the differences, of order 12, add to that of the coarser mesh.)
#[test]
fn the_defect_of_the_strong_form_along_a_solution_falls_at_the_order_of_the_element() {
    let rod = arm();
    for (order, p, meshes) in
        [(Order::Two, 2, [64, 128]), (Order::Four, 4, [32, 64]), (Order::Six, 6, [32, 64])]
    {
        let [coarse, fine] = meshes.map(|elements| defect(&rod, order, elements));
        let observed = (coarse / fine).ln() / (meshes[1] as f64 / meshes[0] as f64).ln();
        println!("{order:?}: {coarse:.1e} {fine:.1e}, order {observed:.2}");
        assert!(observed > p as f64 - 0.1, "{order:?}: {coarse:.1e}, {fine:.1e}, order {observed:.2}");
    }
}

/// The rod without its tendon under (Ā, B̄) of the tendon moves as the rod with the tendon.
#[test]
fn a_load_on_the_rate_of_strain_is_the_actuator_it_is_made_from() {
    let k = Stiffness::diagonal([3.9e-3, 4.5e-3, 2.6e-3, 52.0, 50.0, 157.0]).unwrap();
    let tendon = || Tendon::new(Helical { radius: 8e-3, pitch: 0.3, start: 0.4 }, 1.5).unwrap();
    let curved = |s: Dual64| {
        let zero = Dual64::from_re(0.0);
        Twist::from_array([s * 6.0 + 1.0, s * s * 20.0 - 2.0, zero + 0.5, zero, zero, s * 0.1 + 1.0])
    };
    let actuated =
        Body::new(LENGTH, k.with_actuator(tendon())).unwrap().with_varying_reference(curved).unwrap();
    let bare = Body::new(LENGTH, k).unwrap().with_varying_reference(curved).unwrap();
    let s = 0.11;
    let strain = Strain::from_array([9.0, -7.0, 12.0, 0.06, -0.05, 0.04]);
    // the tendon alone: a response minus that of the rod
    let with = actuated.section().respond(&actuated.station(s), &strain, Request::Rate).unwrap();
    let without = bare.section().respond(&bare.station(s), &strain, Request::Rate).unwrap();
    let reference = bare.station(s).reference;
    let xi = reference.twist + strain;
    let a_bar = without.tangent - with.tangent;
    let pull = with.wrench - without.wrench;
    let along = Wrench::from_vector(&(a_bar * reference.rate.to_vector()));
    let b_bar = pull.ad_transpose(&xi) - (with.wrench_rate - without.wrench_rate) - along;

    let at = SectionState { s, pose: Pose::identity(), strain, motion: None };
    let rod = |body| Rod::clamped(body, Pose::identity());
    let bare = rod(bare).strain_rate_with(&at, &RateLoad { a_bar, b_bar }).unwrap();
    let actuated = Rod::clamped(actuated, Pose::identity()).strain_rate(&at).unwrap();
    let error = (bare.twist - actuated.twist).to_vector().norm() / actuated.twist.to_vector().norm();
    // rounding of differences of responses of size 1e2
    assert!(error < 1e-12, "{error:.1e}");
    assert!(
        (actuated.twist - reference.rate - Twist::from_array(actuated.strain.to_array())).to_vector().norm()
            < 1e-12
    );
}

/// A rigid motion of a free, unstrained rod: in a frame that moves with velocity η, the inertial wrench is M η̇ − ad_ηᵀ M η, by hand
/// (μ(v̇ + w × v), J ẇ + w × J w) for a centred section.
#[test]
fn inertia_enters_as_newton_and_euler_have_it() {
    let k = [3.9e-3, 4.5e-3, 2.6e-3, 52.0, 50.0, 157.0];
    let rod = Rod::clamped(Body::new(LENGTH, Stiffness::diagonal(k).unwrap()).unwrap(), Pose::identity());
    let (mass, j) = (0.7, vector![2e-3, 3e-3, 5e-3]);
    let inertia = Matrix6::from_diagonal(&Vector6::new(j.x, j.y, j.z, mass, mass, mass));
    let (w, v) = (vector![1.0, -2.0, 0.5], vector![0.3, 0.1, -0.7]);
    let (dw, dv) = (vector![-4.0, 2.0, 3.0], vector![5.0, -1.0, 2.0]);
    let motion = Motion { inertia, velocity: Twist::new(w, v), acceleration: Twist::new(dw, dv) };
    let at = SectionState { s: 0.1, pose: Pose::identity(), strain: Strain::zero(), motion: Some(motion) };
    let rate = rod.strain_rate(&at).unwrap().strain;
    let moment = j.component_mul(&dw) + w.cross(&j.component_mul(&w));
    let force = (dv + w.cross(&v)) * mass;
    let exact = Strain::new(
        moment.component_div(&vector![k[0], k[1], k[2]]),
        force.component_div(&vector![k[3], k[4], k[5]]),
    );
    assert!((rate - exact).to_vector().norm() < 1e-13 * exact.to_vector().norm(), "{rate:?} {exact:?}");
}

/// No stiffness against twist.
struct Loose;

impl Resultant for Loose {
    fn energy<D: Scalar>(&self, strain: &Strain<D>, _s: D) -> D {
        let (omega, nu) = (strain.angular, strain.linear);
        omega.x * omega.x + omega.y * omega.y + nu.dot(&nu)
    }
}

#[test]
fn what_the_strong_form_cannot_solve_is_refused_by_name() {
    let at = SectionState { s: 0.1, pose: Pose::identity(), strain: Strain::zero(), motion: None };
    let rod = Rod::clamped(Body::new(LENGTH, Resultants(Loose)).unwrap(), Pose::identity());
    let singular = rod.strain_rate(&at).unwrap_err();
    assert_eq!(singular, Error::Singular { matrix: "tangent of the strong form", s: 0.1 });

    let stiff = Stiffness::diagonal([1.0, 1.0, 1.0, 1e6, 1e6, 1e6]).unwrap();
    let rod = Rod::clamped(Body::new(LENGTH, stiff).unwrap(), Pose::identity());
    // units do not make it ill-conditioned; a load that nearly cancels the stiffness does
    assert!((rod.strain_rate(&at).unwrap().condition - 1.0).abs() < 1e-12);
    let mut a_bar = Matrix6::zeros();
    let fill = 1.0 - 1e-6;
    (a_bar[(0, 1)], a_bar[(1, 0)]) = (fill, fill);
    let near = rod.strain_rate_with(&at, &RateLoad { a_bar, b_bar: Wrench::zero() }).unwrap();
    assert!((near.condition / 4e6).log10().abs() < 0.5, "{:.1e}", near.condition);

    let body = Body::new(LENGTH, stiff).unwrap().with_constraint(Constraint::kirchhoff());
    let refused = Rod::clamped(body, Pose::identity()).strain_rate(&at).unwrap_err();
    assert!(refused.to_string().contains("number of strains that are fixed is 3"), "{refused}");
}
