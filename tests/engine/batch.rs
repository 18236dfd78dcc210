//! Many strains at once: what one at a time gives, for every request, count and kind of section.

use hyperrod::Strain;
use hyperrod::material::*;
use hyperrod::section::{Circle, Composite, CrossSection, Linear, Rectangle, Section};

use crate::oracle::*;

/// The batch sums point by point, one at a time over lanes: up to 91 points, each rounded some tens of times.
pub const ROUNDING: f64 = 1e-14;

pub fn sites(count: usize, at: impl Fn(f64) -> Station) -> Vec<(Station, Strain)> {
    (0..count)
        .map(|k| {
            let k = k as f64;
            let direction = [0.5 * k.sin(), k.cos(), 0.7, 0.2 * k.cos(), -0.4, 0.3 * (2.0 * k).sin()];
            (at(0.02 * k), strain(direction, 0.2))
        })
        .collect()
}

pub fn difference(a: &Response, b: &Response) -> f64 {
    let ratio = |error: f64, scale: f64| if error == 0.0 { 0.0 } else { error / scale };
    let six = |v: [f64; 6]| (0..6).map(|i| if i < 3 { v[i] * 100.0 } else { v[i] }.abs()).fold(0.0, f64::max);
    let k = |r: &Response| r.tangent.map_with_location(|i, j, k| k * [1e2, 1.0][i / 3] * [1e2, 1.0][j / 3]);
    ratio((a.energy - b.energy).abs(), b.energy.abs())
        .max(ratio(six((a.wrench - b.wrench).to_array()), six(b.wrench.to_array())))
        .max(ratio((k(a) - k(b)).amax(), k(b).amax()))
        .max(ratio(six((a.wrench_rate - b.wrench_rate).to_array()), six(b.wrench_rate.to_array())))
}

pub fn sections() -> Vec<(&'static str, Box<dyn CrossSection>)> {
    let neo_hookean = || NeoHookean::new(170e3, 400e3).unwrap();
    let circle = || Circle::new(0.01);
    let graded = hyperrod::isotropic!(|i, at| i.i1_excess() * (at.s * 3.0 + at.x * 20.0 + 1.0) * 1e5);
    let graded_closure = isotropic(|i, at| i.i1_excess() * (at.s * 3.0 + at.x * 20.0 + 1.0) * 1e5);
    // twisted fibres and not helices, which have no direction on the axis
    let turns = (Twisted::new(40.0).unwrap(), Twisted::new(-40.0).unwrap());
    let artery = HolzapfelGasserOgden::new([3e3, 100e3], [2e3, 0.8], turns).unwrap();
    let taper = Linear { from: 0.01, to: 0.006, length: 1.0 };
    let composite = Composite::new(Section::new(circle(), neo_hookean()).unwrap())
        .with(Section::new(Rectangle::new(0.01, 0.02), artery).unwrap());
    let boxed: Box<dyn Material> = Box::new(neo_hookean());
    vec![
        ("neo-Hookean", Box::new(Section::new(circle(), neo_hookean()).unwrap())),
        ("graded", Box::new(Section::new(circle(), graded).unwrap())),
        ("graded closure", Box::new(Section::new(circle(), graded_closure).unwrap())),
        ("artery", Box::new(Section::new(Rectangle::new(0.01, 0.02), artery).unwrap())),
        ("tapered", Box::new(Section::new(Circle::new(taper), neo_hookean()).unwrap())),
        ("quadratic", Box::new(Section::new(circle(), MooneyRivlin::new(120e3, 40e3).unwrap()).unwrap())),
        ("sectional", Box::new(Section::new(circle(), LinearElastic::new(1e6, 3e5).unwrap()).unwrap())),
        ("stress-free", Box::new(Section::new(circle(), StressFree(neo_hookean())).unwrap())),
        ("boxed", Box::new(Section::new(circle(), boxed).unwrap())),
        ("composite", Box::new(composite)),
    ]
}

#[test]
fn a_batch_gives_what_one_at_a_time_gives() {
    type Place = fn(f64) -> Station;
    let mixed: Place = |s| if (s * 100.0) as i32 % 3 == 0 { curved() } else { Station::straight(s) };
    let places: [(&str, Place); 3] =
        [("straight", Station::straight), ("curved", |_| curved()), ("mixed", mixed)];
    for (name, section) in sections() {
        for (place, at) in places {
            for count in 0..=20 {
                let sites = sites(count, at);
                for request in REQUESTS {
                    let mut out = vec![Response::zero(); count];
                    section.respond_many(&sites, request, &mut out).unwrap();
                    for ((at, strain), answer) in sites.iter().zip(&out) {
                        let alone = section.respond(at, strain, request).unwrap();
                        let error = difference(answer, &alone);
                        assert!(
                            error <= ROUNDING,
                            "{name}, {place}, {count} strains, {request:?}: {error:.1e}"
                        );
                    }
                }
            }
        }
    }
}

/// Wherever it stands, the first inadmissible strain is the one that is named, and what comes before it has been answered.
#[test]
fn an_inadmissible_strain_in_a_batch_is_named_as_it_is_alone() {
    let inside_out = Strain::from_array([30.0, -20.0, 0.0, 0.0, 0.0, -0.9]);
    let nan = Strain::from_array([0.0, 0.0, 0.0, f64::NAN, 0.0, 0.0]);
    for (name, section) in sections() {
        for count in [1, 4, 9, 19] {
            for place in [0, 1, count / 2, count - 1] {
                for bad in [inside_out, nan] {
                    if name == "sectional" && bad == inside_out {
                        continue; // J is not asked about
                    }
                    let mut sites = sites(count, Station::straight);
                    let place = place.min(count - 1);
                    sites[place].1 = bad;
                    if place + 2 < count {
                        sites[place + 2].1 = nan;
                    }
                    for request in REQUESTS {
                        let mut out = vec![Response::zero(); count];
                        let error = section.respond_many(&sites, request, &mut out).unwrap_err();
                        let alone = section.respond(&sites[place].0, &bad, request).unwrap_err();
                        assert_eq!(error.to_string(), alone.to_string(), "{name}, {count} strains, {place}");
                        for ((at, strain), answer) in sites.iter().zip(&out).take(place) {
                            let alone = section.respond(at, strain, request).unwrap();
                            assert!(difference(answer, &alone) <= ROUNDING, "{name}: before the error");
                        }
                    }
                }
            }
        }
    }
}

/// As many are answered as there is room for, and no more are written than were asked.
#[test]
fn a_batch_fills_the_shorter_of_the_two() {
    let section = &sections()[0].1;
    let sites = sites(13, Station::straight);
    for room in [0, 1, 8, 12, 13, 20] {
        let untouched = Response { energy: -7.0, ..Response::zero() };
        let mut out = vec![untouched; room];
        section.respond_many(&sites, Request::Tangent, &mut out).unwrap();
        for (k, answer) in out.iter().enumerate() {
            assert_eq!(*answer == untouched, k >= 13, "{room}: {k}");
        }
    }
}
