//! The index against closed forms: Euler, Greenhill, and counts of modes.

use std::f64::consts::PI;

use nalgebra::vector;

use super::*;
use crate::body::Elastic;
use crate::lie::{Strain, Wrench};
use crate::load::DeadWrench;
use crate::material::NeoHookean;
use crate::rod::{Freedom, Support};
use crate::section::{Circle, Section, Stiffness};
use crate::solve::continuation::illinois;
use crate::solve::equilibrium::Configuration;
use crate::solve::linear::Buffers;
use crate::solve::mesh::Mesh;
use crate::solve::scale::Scale;
use crate::solve::unknowns::{StageStrains, Unknowns};
use crate::{Body, Pose, Rod};

/// How the ends of a column are held; the base is at the origin, the tip at a height that a load or a support gives.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Ends {
    ClampedFree,
    Pinned,
    Clamped,
    /// Clamped, but free to slide along the axis.
    ClampedSliding,
}

/// The chain of a rod whose strain is the same everywhere, under the wrench `tip` at its tip.
fn chain_of<B: Elastic, const S: usize>(rod: &Rod<B>, elements: usize, strain: Strain, tip: Wrench) -> Chain {
    let mesh = Mesh::<_, S>::uniform(rod, elements);
    let n = mesh.elements();
    let unknowns = Unknowns { strains: vec![[strain; S]; n], tip, ..Unknowns::at_rest(&mesh) };
    let mut state = Configuration::default();
    mesh.configure(&unknowns, &mut state).unwrap();
    let (length, tangent) = (rod.body().length(), state.response[0][0].tangent);
    let scale = Scale { length, force: tangent[(0, 0)].max(tangent[(1, 1)]) / length.powi(2) };
    let mut buffers = Buffers::<S>::default();
    buffers.condense(&mesh, &unknowns, &state).unwrap();
    chain(&mesh, &state, &buffers.condensed, &scale).unwrap()
}

/// A straight rod under a constant wrench (moment and force along its axis).
struct Straight {
    length: f64,
    stiffness: [f64; 6],
    twist: f64,
    force: f64,
    elements: usize,
}

impl Straight {
    fn chain<const S: usize>(&self, ends: Ends) -> Chain {
        let body = Body::new(self.length, Stiffness::diagonal(self.stiffness).unwrap()).unwrap();
        let wrench = Wrench::new(vector![0.0, 0.0, self.twist], vector![0.0, 0.0, self.force]);
        let (k, w) = (self.stiffness, wrench.to_array());
        let strain = Strain::from_array(std::array::from_fn(|i| w[i] / k[i]));
        let base = Support::clamped(Pose::identity());
        let height = self.length * (1.0 + strain.linear.z);
        let turn = crate::lie::so3::exp(&vector![0.0, 0.0, strain.angular.z * self.length]);
        let tip = Support::clamped(Pose::new(turn, vector![0.0, 0.0, height]));
        let push = DeadWrench::force(wrench.force).unwrap();
        let pinned = Support::pinned(Pose::identity()).holding(Freedom::RotationZ, 0.0).unwrap();
        let roller = tip.releasing([Freedom::RotationX, Freedom::RotationY, Freedom::RotationZ, Freedom::Z]);
        let rod = match ends {
            Ends::ClampedFree => Rod::between(body, base, Support::free()).with_tip_load(push),
            Ends::Pinned => Rod::between(body, pinned, roller).with_tip_load(push),
            Ends::Clamped => Rod::between(body, base, tip),
            Ends::ClampedSliding => Rod::between(body, base, tip.releasing([Freedom::Z])).with_tip_load(push),
        };
        chain_of::<_, S>(&rod, self.elements, strain, wrench)
    }

    fn index<const S: usize>(&self, ends: Ends) -> usize {
        match self.chain::<S>(ends).verdict(1e-11) {
            Verdict::Index { unstable, .. } => unstable,
            verdict => panic!("{verdict:?}"),
        }
    }
}

/// A round rod of radius `r`, E = 1e6, ν = ½, under a compressive force.
fn column(length: f64, r: f64, force: f64, elements: usize) -> Straight {
    let (e, i, a) = (1e6, PI * r.powi(4) / 4.0, PI * r * r);
    let g = e / 3.0;
    let stiffness = [e * i, e * i, 2.0 * g * i, g * a, g * a, e * a];
    Straight { length, stiffness, twist: 0.0, force: -force, elements }
}

/// (kL)² of a round column: P(1 + P(1/GA − 1/EA)) L²/EI.
fn slenderness(c: &Straight) -> f64 {
    let (k, p) = (c.stiffness, -c.force);
    p * (1.0 + p * (1.0 / k[3] - 1.0 / k[5])) * c.length * c.length / k[0]
}

/// Critical (kL) of the modes of a plane, ascending.
fn criticals(ends: Ends, n: usize) -> Vec<f64> {
    match ends {
        Ends::ClampedFree => (0..n).map(|i| (i as f64 + 0.5) * PI).collect(),
        Ends::Pinned => (0..n).map(|i| (i as f64 + 1.0) * PI).collect(),
        _ => (0..n)
            .map(|i| if i % 2 == 0 { (i as f64 + 2.0) * PI } else { 2.0 * tangent_root(i.div_ceil(2)) })
            .collect(),
    }
}

/// The i-th root of tan x = x, in (iπ, (i + ½)π).
fn tangent_root(i: usize) -> f64 {
    let (mut a, mut b) = (i as f64 * PI, (i as f64 + 0.5) * PI);
    for _ in 0..100 {
        let x = 0.5 * (a + b);
        if (x.sin() - x * x.cos() > 0.0) == (a.sin() - a * a.cos() > 0.0) { a = x } else { b = x }
    }
    a
}

#[test]
fn the_index_of_a_column_counts_euler_s_modes_twice() {
    for ends in [Ends::ClampedFree, Ends::Pinned, Ends::Clamped] {
        for force in [-0.01, 1e-4, 1.3e-3, 5.5e-3, 0.02, 0.05, 0.13, 0.31] {
            let rod = column(1.0, 0.005, force, 24);
            let critical = criticals(ends, 12);
            let expected = 2 * critical.iter().filter(|k| *k * *k < slenderness(&rod)).count();
            assert_eq!(rod.index::<2>(ends), expected, "{ends:?} at {force}, order 4");
            assert_eq!(rod.index::<3>(ends), expected, "{ends:?} at {force}, order 6");
        }
    }
}

#[test]
fn a_clamped_rod_shortened_by_a_tenth_has_an_unstable_mode_for_each_euler_load_it_passed() {
    let (r, e) = (0.02_f64, 1e6);
    let rod = column(1.0, r, 0.1 * e * PI * r * r, 20);
    let expected = criticals(Ends::Clamped, 40).iter().filter(|k| *k * *k < slenderness(&rod)).count();
    assert_eq!(rod.index::<3>(Ends::Clamped), 2 * expected);
    assert!(expected > 5);
}

#[test]
fn a_twisted_clamped_rod_buckles_at_greenhill_s_moment() {
    // tan(ML/4EI·…): with both ends held against everything but extension, M L/EI = 2 · 4.4934 (Greenhill 1883; Antman and Kenney 1981)
    let critical = 2.0 * tangent_root(1);
    for (factor, expected) in [(0.999, 0), (1.001, 1)] {
        let mut rod = column(1.0, 0.005, 0.0, 24);
        rod.twist = factor * critical * rod.stiffness[0];
        let found = rod.index::<3>(Ends::ClampedSliding);
        assert!(if expected == 0 { found == 0 } else { found > 0 }, "{factor}: {found}");
    }
}

/// Where the margin of the first mode vanishes, by the Illinois rule about a closed form.
fn critical_load(mut rod: Straight, ends: Ends, about: f64) -> f64 {
    let mut margin = |force: f64| {
        rod.force = -force;
        rod.chain::<3>(ends).margin(0)
    };
    let bracket = [0.9 * about, 1.1 * about].map(|force| (force, margin(force).unwrap()));
    assert!(bracket[0].1 > 0.0 && bracket[1].1 < 0.0, "{bracket:?}");
    illinois(bracket, 0.0, margin).unwrap()
}

#[test]
fn buckling_loads_are_those_of_the_linearised_rod() {
    // reference: determinant of the linearised problem, 1e-12. The phase of three Gauss stages is off by h⁶/100800 relative, h = 2π/40 at most;
    // the load goes with its square
    let tolerance = 2.0 * (2.0 * PI / 40.0).powi(6) / 100800.0;
    for (length, radius, [clamped, free, pinned]) in [
        (0.6, 0.05, [479.70470304403176, 33.36055890629672, 130.25537912080944]),
        (1.0, 0.005, [0.019369369236823822, 0.0012111453292087766, 0.004844133184028474]),
    ] {
        for (ends, reference) in [(Ends::Clamped, clamped), (Ends::ClampedFree, free), (Ends::Pinned, pinned)]
        {
            let found = critical_load(column(length, radius, 0.0, 40), ends, reference);
            let error = (found / reference - 1.0).abs();
            assert!(error < tolerance, "{found} {reference} {error:e} {tolerance:e}");
        }
    }
}

#[test]
fn the_mode_of_a_clamped_rod_is_euler_s() {
    // 1 − cos(2πs/L) sideways, in some direction; found beside the critical load, where the mode is off by the distance from it
    let rod = column(1.0, 0.005, 0.019369369236823822 * (1.0 + 1e-7), 20);
    let mode = rod.chain::<3>(Ends::Clamped).mode(0).unwrap();
    let (middle, _) = mode[10];
    let size = middle[3].hypot(middle[4]);
    for (i, (node, _)) in mode.iter().enumerate() {
        let shape = 0.5 * (1.0 - (2.0 * PI * i as f64 / 20.0).cos());
        for r in 3..5 {
            assert!((node[r] - middle[r] * shape).abs() < 1e-6 * size, "node {i}");
        }
        assert!(node[5].abs() < 1e-6 * size && node[2].abs() < 1e-6 * size);
    }
}

/// A clamped neo-Hookean rod of uniform section, stretched to c by a dead force F; μ, λ, A and I.
struct Tension {
    mu: f64,
    lame: f64,
    radius: f64,
    length: f64,
    stretch: f64,
}

impl Tension {
    fn area(&self) -> f64 {
        PI * self.radius.powi(2)
    }

    /// A (μ (c − 1/c) + λ ln c / c).
    fn force(&self) -> f64 {
        let c = self.stretch;
        self.area() * (self.mu * (c - 1.0 / c) + self.lame * c.ln() / c)
    }

    /// Modes of the plane: with the shear eliminated, ½ EI θ′² − ½ n (n/GA − c) θ², θ(0) = 0.
    fn modes(&self) -> usize {
        let (c, n) = (self.stretch, self.force());
        let modulus = self.mu * (1.0 + c.powi(-2)) + self.lame * (1.0 - c.ln()) / (c * c);
        let bending = modulus * PI * self.radius.powi(4) / 4.0;
        let load = n * (n / (self.mu * self.area()) - c) * self.length.powi(2) / bending;
        (0..100).filter(|k| ((*k as f64 + 0.5) * PI).powi(2) < load).count()
    }

    fn rod(&self) -> Rod<Body<Section<Circle<f64>, NeoHookean>>> {
        let law = NeoHookean::new(self.mu, self.lame).unwrap();
        let body = Body::new(self.length, Section::new(Circle::new(self.radius), law).unwrap()).unwrap();
        let pull = DeadWrench::force(vector![0.0, 0.0, self.force()]).unwrap();
        Rod::clamped(body, Pose::identity()).with_tip_load(pull)
    }

    /// Unstable modes, and the energy that the sections win by tilting through ε sin(πs/2L), over ε².
    fn found(&self) -> (usize, f64) {
        const TILT: f64 = 1e-3;
        let (rod, elements) = (self.rod(), 24);
        let mesh = Mesh::<_, 3>::uniform(&rod, elements);
        let straight = Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, self.stretch - 1.0]);
        let strains: StageStrains<3> = vec![[straight; 3]; elements];
        let (wave, shear) = (0.5 * PI / self.length, self.force() / (self.mu * self.area()));
        let tilted: StageStrains<3> = (0..elements)
            .map(|i| {
                std::array::from_fn(|k| {
                    let phase = wave * mesh.stage_s(i, k);
                    let [bend, slip] = [TILT * wave * phase.cos(), -shear * TILT * phase.sin()];
                    straight + Strain::from_array([0.0, bend, 0.0, slip, 0.0, 0.0])
                })
            })
            .collect();
        let energy = |strains: &StageStrains<3>| {
            let mut state = Configuration::default();
            let unknowns = Unknowns { strains: strains.clone(), ..Unknowns::at_rest(&mesh) };
            mesh.configure(&unknowns, &mut state).unwrap();
            let (elastic, load) = mesh.energies(&state);
            elastic + load.unwrap()
        };
        let won = (energy(&strains) - energy(&tilted)) / (TILT * TILT);
        match chain_of::<_, 3>(&rod, elements, straight, Wrench::zero()).verdict(1e-11) {
            Verdict::Index { unstable, .. } => (unstable, won),
            verdict => panic!("{verdict:?}"),
        }
    }
}

#[test]
fn a_neo_hookean_rod_in_long_tension_is_stable_until_its_sections_would_rather_tilt() {
    // a rigid section keeps its area: beyond ln c = μ/λ volume is dearer than shear, and the tension tilts the sections
    for (lame, stretch) in
        [(3e5, 1.4), (3e5, 1.9), (3e5, 2.1), (3e5, 2.5), (4e4, 15.0), (0.0, 15.0), (4e4, 0.97)]
    {
        let rod = Tension { mu: 2e5, lame, radius: 0.01, length: 0.3, stretch };
        let (unstable, won) = rod.found();
        assert_eq!(unstable, 2 * rod.modes(), "λ = {lame}, c = {stretch}");
        assert_eq!(won > 0.0, rod.modes() > 0, "λ = {lame}, c = {stretch}: {won}");
    }
}

#[test]
fn supports_in_the_middle_raise_the_load_to_that_of_a_bay() {
    // a pinned column held sideways at its middle buckles as one of half the length, (2π)², in two ways; one more at (2 · 4.4934)² · … from
    // the clamped-pinned bays: kL/2 = 4.4934, also double
    for (factor, expected) in [(0.98, 0), (1.02, 2)] {
        let (ei, length) = (1.0, 1.0);
        let force = factor * (2.0 * PI).powi(2) * ei;
        let body = Body::new(length, Stiffness::diagonal([ei, ei, 1.0, 1e9, 1e9, 1e9]).unwrap()).unwrap();
        let pinned = Support::pinned(Pose::identity()).holding(Freedom::RotationZ, 0.0).unwrap();
        let roller = Support::free().holding(Freedom::X, 0.0).unwrap().holding(Freedom::Y, 0.0).unwrap();
        let push = DeadWrench::force(vector![0.0, 0.0, -force]).unwrap();
        let rod = Rod::between(body, pinned, roller).with_tip_load(push).with_support(0.5, roller).unwrap();
        let wrench = Wrench::new(vector![0.0, 0.0, 0.0], vector![0.0, 0.0, -force]);
        let strain = Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, -force / 1e9]);
        let verdict = chain_of::<_, 3>(&rod, 16, strain, wrench).verdict(1e-11);
        assert!(
            matches!(verdict, Verdict::Index { unstable, .. } if unstable == expected),
            "{factor}: {verdict:?}"
        );
    }
}
