//! How fast an energy is turned into wrench and tangent, against derivatives taken by hand and against num-dual.
//!
//! `cargo run --release --example engine_speed` prints a table of times and, what counts on a shared machine, of ratios within the
//! run, and writes `target/hyperrod/engine_speed/engine.csv`. `--quick` measures less long.

#![allow(clippy::print_stdout)] // an example tells what it found

#[path = "../benches/engine/cases.rs"]
mod cases;
mod figure;

use cases::{
    LAME, NeoHookeanByHand, POLY, PolyByHand, PolyIsotropic, PolyLocal, PolySectional, difference,
    hand_scalar, hand_vector, num_dual_by_points, num_dual_of_sum, rings, strains,
};
use figure::{Outcome, Output, flag};
use hyperrod::Strain;
use hyperrod::material::{
    Material, MooneyRivlin, NeoHookean, Points, ReferencePressure, Request, Response, Station, isotropic,
};
use hyperrod::section::{Circle, CrossSection, Linear, Section};
use std::hint::black_box;
use std::time::Instant;

/// What is timed: a name, how many points, and which column of hand-derived code it is compared with.
struct Case<'a> {
    name: &'static str,
    points: usize,
    law: Law,
    run: Run<'a>,
}

/// Evaluates every one of the strains.
type Run<'a> = Box<dyn Fn(&[Strain]) + 'a>;

#[derive(Clone, Copy, PartialEq)]
enum Law {
    Polynomial,
    NeoHookean,
}

/// Evaluates every strain; each whole answer is used, so that no part of it is optimised away.
fn each<'a, R>(respond: impl Fn(&Strain) -> R + 'a) -> Run<'a> {
    Box::new(move |strains| {
        for strain in strains {
            black_box(&respond(black_box(strain)));
        }
    })
}

fn engine<'a, M: Material>(material: &'a M, points: &'a Points, request: Request) -> Run<'a> {
    let at = Station::straight(0.0);
    each(move |strain| material.integrate(points, &at, strain, request))
}

fn section<'a>(section: &'a dyn CrossSection, request: Request) -> Run<'a> {
    let at = Station::straight(0.0);
    each(move |strain| section.respond(&at, strain, request))
}

fn batch<'a>(section: &'a dyn CrossSection) -> Run<'a> {
    let at = Station::straight(0.0);
    Box::new(move |strains| {
        let sites: Vec<_> = strains.iter().map(|x| (at, *x)).collect();
        let mut out = vec![Response::zero(); sites.len()];
        let _ = black_box(section.respond_many(&sites, Request::Tangent, &mut out));
        black_box(&out);
    })
}

fn main() -> Outcome {
    let quick = flag("--quick");
    let output = Output::of("engine_speed")?;
    let (count, rounds) = if quick { (200, 5) } else { (1000, 41) };
    let (points, strains) = (rings(0.01), strains(count));
    let neo = NeoHookean::new(LAME[0], LAME[1])?;
    let [c10, c01, c20, c11, d1] = POLY;
    let closure = isotropic(move |i, _| {
        let (a, b, e) = (i.i1(), i.i2(), i.j());
        a * c10 + b * c01 + a * a * c20 + a * b * c11 + e * e * d1
    });
    let own_rule = Section::new(Circle::new(0.01), PolyIsotropic)?;
    let tapered = Section::new(Circle::new(Linear { from: 0.01, to: 0.005, length: 1.0 }), PolyIsotropic)?;
    let mooney = Section::new(Circle::new(0.01), ReferencePressure(MooneyRivlin::new(120e3, 40e3)?))?;

    let worst = agreement(&points, &strains, &neo)?;

    use Law::{NeoHookean as Neo, Polynomial as Poly};
    use Request::{Energy, Rate, Tangent, Wrench};
    let case = |name, points, law, run| Case { name, points, law, run };
    let cases = [
        case("hand scalar", 24, Poly, each(|x| hand_scalar(PolyByHand, &points, x))),
        case("hand vectorised", 24, Poly, each(|x| hand_vector(PolyByHand, &points, x))),
        case("num-dual at each point", 24, Poly, each(|x| num_dual_by_points(PolyByHand, &points, x))),
        case("num-dual of the sum", 24, Poly, each(|x| num_dual_of_sum(PolyByHand, &points, x))),
        case("isotropic level", 24, Poly, engine(&PolyIsotropic, &points, Tangent)),
        case("local level", 24, Poly, engine(&PolyLocal, &points, Tangent)),
        case("section level", 24, Poly, engine(&PolySectional, &points, Tangent)),
        case("isotropic closure", 24, Poly, engine(&closure, &points, Tangent)),
        case("local level energy", 24, Poly, engine(&PolyLocal, &points, Energy)),
        case("local level wrench", 24, Poly, engine(&PolyLocal, &points, Wrench)),
        case("local level rate", 24, Poly, engine(&PolyLocal, &points, Rate)),
        case("isotropic level energy", 24, Poly, engine(&PolyIsotropic, &points, Energy)),
        case("isotropic level wrench", 24, Poly, engine(&PolyIsotropic, &points, Wrench)),
        case("isotropic level rate", 24, Poly, engine(&PolyIsotropic, &points, Rate)),
        case("own rule", own_rule.point_count(), Poly, section(&own_rule, Tangent)),
        case("own rule batch", own_rule.point_count(), Poly, batch(&own_rule)),
        case("own rule tapered rate", tapered.point_count(), Poly, section(&tapered, Rate)),
        case("Mooney-Rivlin own rule", mooney.point_count(), Poly, section(&mooney, Tangent)),
        case("log hand scalar", 24, Neo, each(|x| hand_scalar(NeoHookeanByHand, &points, x))),
        case("log hand vectorised", 24, Neo, each(|x| hand_vector(NeoHookeanByHand, &points, x))),
        case(
            "log num-dual at each point",
            24,
            Neo,
            each(|x| num_dual_by_points(NeoHookeanByHand, &points, x)),
        ),
        case("log num-dual of the sum", 24, Neo, each(|x| num_dual_of_sum(NeoHookeanByHand, &points, x))),
        case("log isotropic level", 24, Neo, engine(&neo, &points, Tangent)),
    ];

    let ns = median_times(&cases, &strains, rounds);
    report(&cases, &ns, &output)?;
    println!(
        "largest difference from the hand-derived values: {worst:.1e} of work, largest force or stiffness"
    );
    println!("{}", output.path("engine.csv").display());
    Ok(())
}

/// Times of the cases and their ratios to code derived by hand and to num-dual, printed and as CSV.
fn report(cases: &[Case<'_>], ns: &[f64], output: &Output) -> Outcome {
    let find = |name: &str| cases.iter().position(|c| c.name == name).map_or(f64::NAN, |k| ns[k]);
    println!(
        "{:<28}{:>7}{:>10}{:>16}{:>16}{:>14}",
        "case", "points", "ns", "/ hand scalar", "/ hand vector", "/ num-dual"
    );
    let mut csv = String::from("case,points,ns,ratio_to_hand_scalar,ratio_to_num_dual\n");
    for (case, &time) in cases.iter().zip(ns) {
        let prefix = if case.law == Law::NeoHookean { "log " } else { "" };
        let against = |other: &str| time / find(&format!("{prefix}{other}"));
        let (hand, vector) = (against("hand scalar"), against("hand vectorised"));
        // the quicker of the two ways of using it
        let dual = against("num-dual at each point").max(against("num-dual of the sum"));
        println!("{:<28}{:>7}{time:>10.1}{hand:>16.3}{vector:>16.3}{dual:>14.4}", case.name, case.points);
        csv += &format!("{},{},{time:?},{hand:?},{dual:?}\n", case.name, case.points);
    }
    std::fs::write(output.path("engine.csv"), csv)?;
    Ok(())
}

/// The largest difference of any path from the code derived by hand.
fn agreement(points: &Points, strains: &[Strain], neo: &NeoHookean) -> Outcome<f64> {
    let at = Station::straight(0.0);
    let mut worst: f64 = 0.0;
    for strain in strains {
        let hand = hand_scalar(PolyByHand, points, strain);
        let responses = [
            hand_vector(PolyByHand, points, strain),
            num_dual_by_points(PolyByHand, points, strain),
            num_dual_of_sum(PolyByHand, points, strain),
            PolyIsotropic.integrate(points, &at, strain, Request::Tangent)?,
            PolyLocal.integrate(points, &at, strain, Request::Tangent)?,
            PolySectional.integrate(points, &at, strain, Request::Tangent)?,
        ];
        worst = responses.iter().map(|r| difference(&hand, r, strain, 0.01)).fold(worst, f64::max);
        let hand = hand_scalar(NeoHookeanByHand, points, strain);
        let responses = [
            hand_vector(NeoHookeanByHand, points, strain),
            num_dual_by_points(NeoHookeanByHand, points, strain),
            num_dual_of_sum(NeoHookeanByHand, points, strain),
            neo.integrate(points, &at, strain, Request::Tangent)?,
        ];
        worst = responses.iter().map(|r| difference(&hand, r, strain, 0.01)).fold(worst, f64::max);
    }
    Ok(worst)
}

/// Median over the rounds of the time of one evaluation, ns; the cases take turns within a round.
fn median_times(cases: &[Case<'_>], strains: &[Strain], rounds: usize) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(rounds); cases.len()];
    for _ in 0..rounds {
        for (case, times) in cases.iter().zip(&mut times) {
            let start = Instant::now();
            (case.run)(strains);
            times.push(start.elapsed().as_secs_f64() * 1e9 / strains.len() as f64);
        }
    }
    times
        .iter_mut()
        .map(|times| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        })
        .collect()
}
