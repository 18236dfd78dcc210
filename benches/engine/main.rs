//! The engine against derivatives taken by hand and against num-dual, in one run: `cargo bench --bench engine`.
//!
//! `cargo run --release --example engine_speed` prints the same as a table of ratios.

#[allow(dead_code, reason = "the example compares values as well")]
mod cases;

use cases::{
    LAME, NeoHookeanByHand, PolyByHand, PolyIsotropic, PolyLocal, PolySectional, hand_scalar, hand_vector,
    num_dual_by_points, num_dual_of_sum, rings, strains,
};
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main, measurement::WallTime};
use hyperrod::Strain;
use hyperrod::material::{Material, MooneyRivlin, NeoHookean, ReferencePressure, Request, Response, Station};
use hyperrod::section::{Circle, CrossSection, Section};
use std::hint::black_box;

/// Times one evaluation, going round a set of strains so that no branch is learned.
fn time(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    strains: &[Strain],
    respond: impl Fn(&Strain) -> Response,
) {
    let mut round = strains.iter().cycle();
    group.bench_function(name, |b| {
        b.iter(|| round.next().map(|strain| respond(black_box(strain))));
    });
}

/// The response of a material on given points; a failure counts as no response.
fn engine(
    material: &impl Material,
    points: &hyperrod::material::Points,
    request: Request,
) -> impl Fn(&Strain) -> Response {
    let at = Station::straight(0.0);
    move |strain| material.integrate(points, &at, strain, request).unwrap_or_else(|_| Response::zero())
}

fn tangent(c: &mut Criterion) {
    let (points, strains) = (rings(0.01), strains(512));
    let mut group = c.benchmark_group("wrench and tangent, 5-term polynomial, 24 points");
    time(&mut group, "by hand, scalar", &strains, |x| hand_scalar(PolyByHand, &points, x));
    time(&mut group, "by hand, vectorised", &strains, |x| hand_vector(PolyByHand, &points, x));
    time(&mut group, "isotropic level", &strains, engine(&PolyIsotropic, &points, Request::Tangent));
    time(&mut group, "local level", &strains, engine(&PolyLocal, &points, Request::Tangent));
    time(&mut group, "section level", &strains, engine(&PolySectional, &points, Request::Tangent));
    time(&mut group, "num-dual, at each point", &strains, |x| num_dual_by_points(PolyByHand, &points, x));
    time(&mut group, "num-dual, of the sum", &strains, |x| num_dual_of_sum(PolyByHand, &points, x));
    group.finish();

    let mut group = c.benchmark_group("wrench and tangent, neo-Hookean, 24 points");
    let Ok(law) = NeoHookean::new(LAME[0], LAME[1]) else { return };
    time(&mut group, "by hand, scalar", &strains, |x| hand_scalar(NeoHookeanByHand, &points, x));
    time(&mut group, "by hand, vectorised", &strains, |x| hand_vector(NeoHookeanByHand, &points, x));
    time(&mut group, "isotropic level", &strains, engine(&law, &points, Request::Tangent));
    group.finish();
}

fn requests(c: &mut Criterion) {
    let (points, strains) = (rings(0.01), strains(512));
    let mut group = c.benchmark_group("what is asked for, 5-term polynomial, local level, 24 points");
    for request in [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate] {
        time(&mut group, &format!("{request:?}"), &strains, engine(&PolyLocal, &points, request));
    }
    group.finish();
}

fn sections(c: &mut Criterion) {
    let strains = strains(512);
    let at = Station::straight(0.0);
    let mut group = c.benchmark_group("wrench and tangent, section with the rule its law needs");
    let Ok(law) = MooneyRivlin::new(120e3, 40e3) else { return };
    let sections = [
        ("5-term polynomial", Section::new(Circle::new(0.01), PolyIsotropic).map(boxed)),
        ("Mooney-Rivlin", Section::new(Circle::new(0.01), ReferencePressure(law)).map(boxed)),
    ];
    for (name, section) in sections {
        let Ok(section) = section else { continue };
        time(&mut group, name, &strains, |x| {
            section.respond(&at, x, Request::Tangent).unwrap_or_else(|_| Response::zero())
        });
    }
    group.finish();
}

fn boxed(section: impl CrossSection + 'static) -> Box<dyn CrossSection> {
    Box::new(section)
}

criterion_group!(benches, tangent, requests, sections);
criterion_main!(benches);
