//! Responses in some of the strains: the rows and columns of the full response, for every set of strains, kind of section, request and count.

use hyperrod::material::*;
use hyperrod::section::*;
use hyperrod::{Scalar, Strain};

use crate::batch::{ROUNDING, difference, sites};
use crate::oracle::*;

/// Fibres along the rod, and shear that depends on the direction and on the place.
struct Fibred;

impl Local for Fibred {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        let g = f.gamma();
        let (stretch, shear) =
            (g.z * g.z * (g.z * 0.3 + 1.0), g.x * g.x * 0.2 + g.x * g.y * 0.1 + g.y * g.y * 0.3);
        (stretch + shear * (g.z + 1.0) + g.z * g.x * 0.1) * (at.y * 20.0 + at.s + 1.0) * 1e6
    }
}

/// A law of the resultants at a point, with every strain in it.
struct Resultant;

impl Sectional for Resultant {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, xi: &Strain<D>, at: &Point<D>) -> D {
        let e = xi.linear.z + xi.angular.x * at.y - xi.angular.y * at.x;
        let (a, b) = (xi.linear.x - xi.angular.z * at.y, xi.linear.y + xi.angular.z * at.x);
        let warped = e * (a + b * 2.0) * 0.1 + xi.angular.z * xi.angular.z * (at.x * at.x);
        (e * e * (e * 0.3 + 1.0) * 0.5 + (a * a + b * b) * 0.2 + warped) * (at.s + 1.0) * 1e6
    }
}

/// A branch that depends on the strain: parts of a bent section are slack.
struct Slack;

impl Sectional for Slack {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, xi: &Strain<D>, at: &Point<D>) -> D {
        let e = xi.linear.z + xi.angular.x * at.y - xi.angular.y * at.x;
        let stiff = if e.re() > 0.0 { 1e6 } else { 2e5 };
        (e * e + xi.linear.x * xi.linear.x + xi.linear.y * xi.linear.y + xi.angular.z * xi.angular.z * 1e-4)
            * stiff
    }
}

/// A cable whose stiffness grows with its stretch.
struct Cable;

impl hyperrod::section::Resultant for Cable {
    fn energy<D: Scalar>(&self, strain: &Strain<D>, s: D) -> D {
        let (v, n) = (strain.angular, strain.linear);
        let (bending, shear) =
            (v.dot(&v) * (n.z * n.z + s + 1.0) * 1e-2, (n.x * n.x + n.y * n.y) * (n.z + 2.0) * 50.0);
        bending + shear + n.z * n.z * (n.z + 1.0) * 100.0 + v.x * n.y * 0.3
    }
}

fn sections() -> Vec<(&'static str, Box<dyn CrossSection>)> {
    fn of<M: Material + 'static>(law: M) -> Box<dyn CrossSection> {
        Box::new(Section::new(Rectangle::new(0.01, 0.02), law).unwrap())
    }
    let neo_hookean = || NeoHookean::new(170e3, 400e3).unwrap();
    let actuated = Section::new(Circle::new(0.01), neo_hookean()).unwrap();
    let actuated = actuated.with_actuator(Tendon::new([8e-3, 1e-3], 5.0).unwrap());
    let helix = Helical { radius: 8e-3, pitch: 0.1, start: 0.3 };
    let actuated = actuated.with_actuator(Tendon::new(helix, 2.0).unwrap().ending_at(0.2).unwrap());
    let entries = |i, j| if i == j { [2.0, 3.0, 1.5, 1e3, 2e3, 3e3][i] } else { 0.1 * (i + j) as f64 };
    let stiffness = Stiffness::new(nalgebra::Matrix6::from_fn(entries)).unwrap();
    let closure = local(|f, at| f.gamma().dot(&f.gamma()) * (at.x * 20.0 + 1.0) * 1e5);
    let mut all = crate::batch::sections();
    all.extend([
        ("fibred", of(Fibred)),
        (
            "local quadratic",
            of(hyperrod::local!(degree 2, uniform; |f, _at| f.gamma().dot(&f.gamma()) * 1e5)),
        ),
        ("resultant at a point", of(Resultant)),
        ("slack", of(Slack)),
        ("local closure", of(closure)),
        ("polynomial", of(Yeoh::new([1e5, 2e4, 1e4], [4e5, 1e5, 1e5]).unwrap())),
        ("stiffness", Box::new(stiffness)),
        ("resultants", Box::new(Resultants(Cable))),
        ("actuated", Box::new(actuated)),
        ("boxed section", Box::new(of(Fibred)) as Box<dyn CrossSection>),
    ]);
    all
}

fn sets() -> impl Iterator<Item = Active> {
    (1..64).map(|bits: usize| Active::of(std::array::from_fn(|i| bits & (1 << i) != 0)))
}

/// An answer with what is not active as it should be.
fn completed(answer: &Response, full: &Response, active: Active) -> Response {
    let mut completed = *full;
    let six = |w: hyperrod::Wrench| w.to_array();
    let wrench =
        std::array::from_fn(|i| if active.contains(i) { six(answer.wrench)[i] } else { six(full.wrench)[i] });
    completed.wrench = hyperrod::Wrench::from_array(wrench);
    for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
        if active.contains(i) && active.contains(j) {
            completed.tangent[(i, j)] = answer.tangent[(i, j)];
        }
    }
    let rate = std::array::from_fn(|i| {
        if active.contains(i) { six(answer.wrench_rate)[i] } else { six(full.wrench_rate)[i] }
    });
    completed.wrench_rate = hyperrod::Wrench::from_array(rate);
    Response { energy: answer.energy, ..completed }
}

/// What was there before, which no active entry may keep.
fn nothing() -> Response {
    let wrench = hyperrod::Wrench::from_array([f64::NAN; 6]);
    Response { energy: f64::NAN, wrench, tangent: nalgebra::Matrix6::repeat(f64::NAN), wrench_rate: wrench }
}

#[test]
fn a_response_in_some_strains_is_that_part_of_the_full_one() {
    type Place = fn(f64) -> Station;
    let places: [(&str, Place); 2] = [("straight", Station::straight), ("curved", |_| curved())];
    for (name, section) in sections() {
        for (place, at) in places {
            for count in [1, 2, 5, 8, 19] {
                let sites = sites(count, at);
                for request in REQUESTS {
                    let full: Vec<_> = sites
                        .iter()
                        .map(|(at, strain)| section.respond(at, strain, request).unwrap())
                        .collect();
                    for active in sets() {
                        let mut out = vec![nothing(); count];
                        section.respond_active(&sites, active, request, &mut out).unwrap();
                        for (answer, full) in out.iter().zip(&full) {
                            let error = difference(&completed(answer, full, active), full);
                            assert!(
                                error <= ROUNDING,
                                "{name}, {place}, {count} strains, {active:?}, {request:?}: {error:.1e}"
                            );
                        }
                    }
                }
            }
        }
    }
}

/// Wherever it stands, and whatever is active, the first inadmissible strain is the one that is named.
#[test]
fn an_inadmissible_strain_is_named_as_in_the_full_response() {
    let inside_out = Strain::from_array([30.0, -20.0, 0.0, 0.0, 0.0, -0.9]);
    let nan = Strain::from_array([0.0, 0.0, 0.0, 0.0, f64::NAN, 0.0]);
    for (name, section) in sections() {
        for count in [1, 4, 9] {
            for place in [0, 1, count - 1] {
                for bad in [inside_out, nan] {
                    let mut sites = sites(count, Station::straight);
                    let place = place.min(count - 1);
                    sites[place].1 = bad;
                    if place + 2 < count {
                        sites[place + 2].1 = nan;
                    }
                    let Err(alone) = section.respond(&sites[place].0, &bad, Request::Tangent) else {
                        continue; // a section that does not ask about J
                    };
                    for active in sets() {
                        let mut out = vec![Response::zero(); count];
                        let error = section.respond_active(&sites, active, Request::Tangent, &mut out);
                        let error = error.unwrap_err();
                        assert_eq!(error.to_string(), alone.to_string(), "{name}, {count} strains, {place}");
                    }
                }
            }
        }
    }
}

/// Points of the same x are one for a law that is the same everywhere: bending in the plane, about a straight and a curved reference.
#[test]
fn bending_in_the_plane_is_that_of_the_full_response_whatever_the_law_says_of_the_place() {
    let neo_hookean = || NeoHookean::new(170e3, 400e3).unwrap();
    let ogden = || Ogden::new(&[(100e3, 1.3), (-40e3, -2.0)], 4e5).unwrap();
    let circle = || Circle::new(0.01);
    let sections: [(&str, Box<dyn CrossSection>); 5] = [
        ("circle", Box::new(Section::new(circle(), neo_hookean()).unwrap())),
        ("rectangle", Box::new(Section::new(Rectangle::new(0.01, 0.02), ogden()).unwrap())),
        ("stress-free", Box::new(Section::new(circle(), StressFree(neo_hookean())).unwrap())),
        ("not the same everywhere", Box::new(Section::new(circle(), Sum(neo_hookean(), Fibred)).unwrap())),
        ("a point alone", Box::new(Section::new(circle().shifted(2e-3, 1e-3), neo_hookean()).unwrap())),
    ];
    let arc = |s| {
        let twist = hyperrod::Twist::from_array([0.0, 12.0, 4.0, 0.1, 0.0, 1.1]);
        Station { s, reference: Reference { twist, rate: hyperrod::Twist::zero() } }
    };
    let planar = [
        Active::of([false, true, false, true, false, true]),
        Active::of([false, true, false, false, false, false]),
    ];
    for (name, section) in &sections {
        for at in [Station::straight as fn(f64) -> Station, arc] {
            let mut sites = sites(11, at);
            for (_, strain) in &mut sites {
                (strain.angular.x, strain.angular.z) = (0.0, 0.0);
            }
            for (active, request) in
                planar.into_iter().flat_map(|active| REQUESTS.map(|request| (active, request)))
            {
                let mut out = vec![nothing(); sites.len()];
                section.respond_active(&sites, active, request, &mut out).unwrap();
                for ((at, strain), answer) in sites.iter().zip(&out) {
                    let full = section.respond(at, strain, request).unwrap();
                    let error = difference(&completed(answer, &full, active), &full);
                    assert!(error <= ROUNDING, "{name}, {active:?}, {request:?}: {error:.1e}");
                }
                // one that is turned inside out is named with its point
                let mut bad = sites.clone();
                bad[6].1 = Strain::from_array([0.0, 5.0, 0.0, 0.1, 0.0, -1.7]);
                let error = section.respond_active(&bad, active, request, &mut out).unwrap_err();
                let alone = section.respond(&bad[6].0, &bad[6].1, request).unwrap_err();
                assert_eq!(error.to_string(), alone.to_string(), "{name}");
            }
        }
    }
}
