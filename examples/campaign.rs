//! Random rods, solved with default options: laws, sections, tapers, curved references, lengths, loads, and every end condition there is.
//!
//! ```sh
//! cargo run --release --example campaign -- --count 10000 --seed 1
//! ```
//!
//! writes a row for every case to `target/hyperrod/campaign.csv`. The same seed gives the same cases; `--only N` solves one of them
//! and follows its equilibria from rest, as far as the load can grow.
#![allow(clippy::print_stdout)]

use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use hyperrod::lie::se3;
use hyperrod::load::{DeadLoad, DeadWrench, FollowerLoad, FollowerWrench, Gravity};
use hyperrod::material::{
    Gent, IsochoricNeoHookean, LinearElastic, Material, MooneyRivlin, NeoHookean, ReferencePressure,
};
use hyperrod::rod::{Freedom, Support};
use hyperrod::section::{Annulus, Circle, CrossSection, Linear, Rectangle, Section, Shape, Stiffness};
use hyperrod::solve::{Failure, PathOptions, PathState, Stability};
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics, Twist, Wrench};
use nalgebra::{UnitQuaternion, Vector3, vector};

/// Steele, Lea and Flood (2014), SplitMix.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e3779b97f4a7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58476d1ce4e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d049bb133111eb);
        z ^ (z >> 31)
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    /// Uniform in the logarithm.
    fn scale(&mut self, a: f64, b: f64) -> f64 {
        self.between(a.ln(), b.ln()).exp()
    }

    fn pick(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }

    fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = vector![self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0)];
            if v.norm() > 0.1 && v.norm() < 1.0 {
                return v.normalize();
            }
        }
    }
}

type Scene = Rod<Body<Box<dyn CrossSection>, hyperrod::body::LineDensity>>;

/// What a case is, for its row.
#[derive(Default)]
struct Labels {
    section: String,
    reference: &'static str,
    ends: String,
    loads: String,
    length: f64,
    slenderness: f64,
    /// The largest of PL²/EI, qL³/EI and ML/EI.
    load: f64,
}

/// Bending stiffness about the soft axis at rest, the radius, and the section.
fn section(
    random: &mut Random,
    length: f64,
    labels: &mut Labels,
) -> hyperrod::Result<(f64, Box<dyn CrossSection>)> {
    let slenderness = random.scale(10.0, 1e3);
    let r = length / slenderness;
    labels.slenderness = slenderness;
    if random.chance(0.25) {
        let ei = random.scale(1e-6, 1e3);
        let ratio = random.scale(1.0, 5.0);
        let axial = 4.0 * ei / (r * r);
        let shear = axial * random.between(0.2, 0.5);
        let k = [ei, ei * ratio, ei * random.between(0.5, 1.5), shear, shear, axial];
        labels.section = "stiffness".into();
        return Ok((ei, Box::new(Stiffness::diagonal(k)?)));
    }
    let mu = random.scale(1e4, 1e8);
    let lambda = mu * random.scale(0.3, 3.0);
    let (name, law): (_, Box<dyn Material>) = match random.pick(5) {
        0 => ("linear", Box::new(LinearElastic::new(3.0 * mu, mu)?)),
        1 => ("neo-Hookean", Box::new(NeoHookean::new(mu, lambda)?)),
        2 => ("Mooney-Rivlin", Box::new(ReferencePressure(MooneyRivlin::new(0.35 * mu, 0.15 * mu)?))),
        3 => ("isochoric neo-Hookean", Box::new(IsochoricNeoHookean::new(mu, lambda + 0.67 * mu)?)),
        _ => ("Gent", Box::new(Gent::new(mu, lambda, random.between(20.0, 60.0))?)),
    };
    let taper = random.between(0.5, 1.0);
    let tapered = |size: f64| Linear { from: size, to: taper * size, length };
    let (shape_name, shape): (_, Box<dyn Shape>) = match random.pick(4) {
        0 => ("circle", Box::new(Circle::new(r))),
        1 => ("tapered circle", Box::new(Circle::new(tapered(r)))),
        2 => ("annulus", Box::new(Annulus::new(0.6 * r, r))),
        _ => ("tapered rectangle", Box::new(Rectangle::new(tapered(2.0 * r), tapered(r)))),
    };
    labels.section = format!("{shape_name} {name}");
    let section = Section::new(shape, law)?;
    let at = hyperrod::material::Station::straight(length);
    let tangent = section.tangent(&at, &hyperrod::Strain::zero())?;
    Ok((tangent[(0, 0)].min(tangent[(1, 1)]), Box::new(section)))
}

/// A curved reference that turns by up to a coil.
fn reference(random: &mut Random, length: f64, labels: &mut Labels) -> Option<Twist> {
    let turn = random.direction() * (random.between(0.0, 6.0) / length);
    let (name, omega) = match random.pick(4) {
        0 | 1 => ("straight", None),
        2 => ("arc", Some(vector![turn.x, turn.y, 0.0])),
        _ => ("helix", Some(turn)),
    };
    labels.reference = name;
    // a section must not reach the centre of its curvature
    let limit = 0.2 * labels.slenderness / length;
    omega.map(|omega| {
        let omega = if omega.norm() > limit { omega * (limit / omega.norm()) } else { omega };
        Twist::new(omega, Vector3::z())
    })
}

/// A support about `pose` that holds what it is told to, a little away from it; some freedoms on springs.
fn support(
    random: &mut Random,
    held: [bool; 6],
    pose: &Pose,
    ei: f64,
    length: f64,
) -> hyperrod::Result<Support> {
    let mut support = Support::free().with_frame(*pose);
    for (k, freedom) in Freedom::ALL.into_iter().enumerate() {
        let (unit, stiffness) = if k < 3 { (0.3, ei / length) } else { (0.03 * length, ei / length.powi(3)) };
        if held[k] {
            support = support.holding(freedom, random.between(-unit, unit))?;
        } else if random.chance(0.15) {
            support = support.with_spring(freedom, stiffness * random.scale(0.1, 100.0))?;
        }
    }
    Ok(support)
}

/// Which freedoms the two ends hold, so that together they hold the rod: the base is clamped, or each holds half.
fn conditions(random: &mut Random) -> ([bool; 6], [bool; 6]) {
    match random.pick(4) {
        0 => ([true; 6], [false; 6]),
        1 => ([true; 6], std::array::from_fn(|_| random.chance(0.5))),
        2 => ([true; 6], [true; 6]),
        // a ball joint that holds the twist at one end, at least a line at the other
        _ => {
            let mut base = [false, false, true, true, true, true];
            let mut tip = [false, false, false, true, true, random.chance(0.5)];
            (0..2).for_each(|k| base[k] = random.chance(0.3));
            (0..3).for_each(|k| tip[k] = random.chance(0.3));
            (base, tip)
        }
    }
}

fn scene(random: &mut Random) -> hyperrod::Result<(Scene, Labels)> {
    let mut labels = Labels::default();
    let length = random.scale(0.01, 10.0);
    labels.length = length;
    let (ei, section) = section(random, length, &mut labels)?;
    let reference = reference(random, length, &mut labels);
    let weight = ei / length.powi(3) * random.scale(0.03, 10.0) / 9.81;
    let mut body = Body::new(length, section)?;
    if let Some(xi) = reference {
        body = body.with_reference_strain(xi)?;
    }
    let body = body.with_mass_per_length(weight)?;
    let base =
        se3::exp(&Twist::new(random.direction() * random.between(0.0, 3.0), random.direction() * length));
    let rest = base * se3::exp(&(reference.unwrap_or_else(Twist::straight) * length));
    let (at_base, at_tip) = conditions(random);
    let mark = |held: &[bool; 6]| held.iter().map(|h| if *h { 'x' } else { '-' }).collect::<String>();
    labels.ends = format!("{} {}", mark(&at_base), mark(&at_tip));
    let base_support = if at_base == [true; 6] {
        Support::clamped(base)
    } else {
        support(random, at_base, &base, ei, length)?
    };
    let tip_support =
        if at_tip == [false; 6] { Support::free() } else { support(random, at_tip, &rest, ei, length)? };
    let rod = Rod::between(body, base_support, tip_support);
    let rod = loaded(random, rod, ei, length, &mut labels)?;
    Ok((rod, labels))
}

/// One to three loads of up to 30 in units of EI and L; a corner or a support in the middle now and then.
fn loaded(
    random: &mut Random,
    mut rod: Scene,
    ei: f64,
    length: f64,
    labels: &mut Labels,
) -> hyperrod::Result<Scene> {
    for _ in 0..=random.pick(3) {
        let size = random.scale(0.03, 30.0);
        labels.load = labels.load.max(size);
        let force = random.direction() * (size * ei / length.powi(2));
        let moment = random.direction() * (size.min(6.0) * ei / length);
        let (name, loaded) = match random.pick(6) {
            0 => ("dead force", rod.with_tip_load(DeadWrench::force(force)?)),
            1 => ("dead wrench", rod.with_tip_load(DeadWrench::new(moment * 0.3, force)?)),
            2 => ("follower wrench", rod.with_tip_load(FollowerWrench::new(moment, force * 0.3)?)),
            3 => ("weight", rod.with_load(Gravity::new(random.direction() * 9.81)?)),
            4 => ("dead load", rod.with_load(DeadLoad::new(Wrench::new(Vector3::zeros(), force / length))?)),
            _ => (
                "follower load",
                rod.with_load(FollowerLoad::new(Wrench::new(Vector3::zeros(), force * (0.3 / length)))?),
            ),
        };
        rod = loaded;
        let _ = write!(labels.loads, "{}{name}", if labels.loads.is_empty() { "" } else { " + " });
    }
    if random.chance(0.15) {
        let s = length * random.between(0.2, 0.8);
        let force = random.direction() * (random.scale(0.1, 10.0) * ei / length.powi(2));
        rod = rod.with_point_load(s, DeadWrench::force(force)?)?;
        labels.loads.push_str(" + point force");
    }
    if random.chance(0.1) {
        let turn = UnitQuaternion::from_scaled_axis(random.direction() * random.between(0.1, 1.5));
        rod = rod.with_corner(length * random.between(0.2, 0.8), turn)?;
        labels.loads.push_str(" + corner");
    }
    Ok(rod)
}

/// What became of a case.
enum Outcome {
    Solved(Box<StaticSolution>),
    /// Numbers that are none in an answer.
    Nan,
    Failed(Box<Failure>),
    /// The scene itself was refused.
    Refused(hyperrod::Error),
    Panicked,
}

fn random(seed: u64, number: u64) -> Random {
    Random(seed.wrapping_mul(0x2545f4914f6cdd1d) ^ number.wrapping_mul(0xd1342543de82ef95))
}

/// How far the load of a case can grow on the path from rest.
fn look_into(seed: u64, number: u64) -> Result<(), Box<dyn std::error::Error>> {
    let (rod, _) = scene(&mut random(seed, number))?;
    // as the last rung of a solve walks it, but further
    let path = Statics { elements: 32, ..Statics::default() }.trace(&rod, &PathOptions::default())?;
    for point in path.points.iter().step_by(1 + path.points.len() / 20).chain(path.points.last()) {
        let PathState { load_factor, arc_length, solution, .. } = point;
        println!(
            "load factor {load_factor:.6} at arc length {arc_length:.3}: {}",
            solution.report().stability
        );
    }
    for event in &path.events {
        println!("{:?} at load factor {:.6}", event.kind, event.state.load_factor);
    }
    println!("the path ends after {} points: {:?}", path.points.len(), path.end);
    Ok(())
}

fn solve(seed: u64, number: u64) -> (Outcome, Labels, f64) {
    let mut random = random(seed, number);
    let start = Instant::now();
    let run = catch_unwind(AssertUnwindSafe(|| match scene(&mut random) {
        Err(error) => (Outcome::Refused(error), Labels::default()),
        Ok((rod, labels)) => match Statics::default().solve(&rod) {
            Ok(solution) if is_finite(&solution) => (Outcome::Solved(Box::new(solution)), labels),
            Ok(_) => (Outcome::Nan, labels),
            Err(failure) => (Outcome::Failed(failure), labels),
        },
    }));
    let seconds = start.elapsed().as_secs_f64();
    let (outcome, labels) = run.unwrap_or((Outcome::Panicked, Labels::default()));
    (outcome, labels, seconds)
}

fn is_finite(solution: &StaticSolution) -> bool {
    let node = |n: &hyperrod::solve::Node| {
        n.pose.position.iter().chain(n.pose.rotation.iter()).all(|v| v.is_finite())
            && n.wrench.is_finite()
            && n.strain.is_finite()
    };
    solution.nodes().iter().all(node)
}

/// The row of a case, and what it is counted as.
fn row(number: u64, outcome: &Outcome, labels: &Labels, seconds: f64) -> String {
    let Labels { section, reference, ends, loads, length, slenderness, load } = labels;
    let (state, detail) = match outcome {
        Outcome::Solved(solution) => {
            let report = solution.report();
            let rung = report.rungs.last().map_or(String::new(), |rung| format!("{rung:?}"));
            let stability = match report.stability {
                Stability::Unknown => "unknown",
                ref told if told.is_unstable() => "unstable",
                _ => "stable",
            };
            (
                "solved",
                format!(
                    "{rung},{stability},{},{:.1e}",
                    report.iterations.len(),
                    report.error.relative(*length)
                ),
            )
        }
        Outcome::Nan => ("nan", ",,,".into()),
        Outcome::Failed(failure) => (
            "error",
            format!(",,{},{}", failure.report.iterations.len(), failure.reason.to_string().replace(',', ";")),
        ),
        Outcome::Refused(error) => ("error", format!(",,,{}", error.to_string().replace(',', ";"))),
        Outcome::Panicked => ("panic", ",,,".into()),
    };
    format!(
        "{number},{state},{section},{reference},{ends},{loads},{length:.4},{slenderness:.1},{load:.3},{seconds:.6},{detail}\n"
    )
}

struct Arguments {
    count: u64,
    seed: u64,
    only: Option<u64>,
}

fn arguments() -> Result<Arguments, String> {
    let mut parsed = Arguments { count: 1000, seed: 1, only: None };
    let mut given = std::env::args().skip(1);
    while let Some(name) = given.next() {
        if name == "--quick" {
            parsed.count = 200;
            continue;
        }
        let value = given.next().and_then(|v| v.parse().ok()).ok_or(format!("{name} needs a number"))?;
        match name.as_str() {
            "--count" => parsed.count = value,
            "--seed" => parsed.seed = value,
            "--only" => parsed.only = Some(value),
            _ => return Err(format!("{name} is no option: --count N, --seed S, --only N, --quick")),
        }
    }
    Ok(parsed)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Arguments { count, seed, only } = arguments()?;
    std::panic::set_hook(Box::new(|_| ()));
    let mut table = String::from(
        "case,state,section,reference,ends,loads,length,slenderness,load,seconds,rung,stability,iterations,error\n",
    );
    let (mut solved, mut errors, mut panics, mut nan, mut worst) = (0, 0, 0, 0, 0.0_f64);
    for number in only.map_or(0..count, |number| number..number + 1) {
        let (outcome, labels, seconds) = solve(seed, number);
        match outcome {
            Outcome::Solved(_) => solved += 1,
            Outcome::Failed(_) | Outcome::Refused(_) => errors += 1,
            Outcome::Panicked => panics += 1,
            Outcome::Nan => nan += 1,
        }
        worst = worst.max(seconds);
        let row = row(number, &outcome, &labels, seconds);
        if only.is_some() || !matches!(outcome, Outcome::Solved(_)) {
            print!("{row}");
        }
        table.push_str(&row);
    }
    let folder = std::path::Path::new("target/hyperrod");
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("campaign.csv"), table)?;
    if let Some(number) = only {
        look_into(seed, number)?;
    }
    let total = only.map_or(count, |_| 1);
    println!(
        "campaign: {solved} of {total} solved, {errors} errors, {panics} panics, {nan} nan, worst {worst:.3} s"
    );
    Ok(())
}
