//! The engine: time of an evaluation against the error of its quadrature, per law and level; and against derivatives taken by hand.

use hyperrod::material::{
    Deformation, Gent, Local, Material, NeoHookean, Point, Points, Request, Response, Sectional, Station,
};
use hyperrod::section::{Circle, CrossSection, Section};
use hyperrod::{Scalar, Strain};
use std::hint::black_box;

use super::engine_cases::{
    LAME, NeoHookeanByHand, PolyByHand, PolyIsotropic, difference, hand_scalar, hand_vector, num_dual_of_sum,
    rings, strains,
};
use super::figure::{Chart, Outcome, stack};
use super::page::{Page, digits, scientific};
use super::table::{Row, Table};
use super::{Run, timing};

const CURVES: &str = "engine.csv";
const BY_HAND: &str = "engine_by_hand.csv";
const FIGURE: &str = "work_precision_engine.svg";

const RADIUS: f64 = 0.01;

/// Strains an element solver asks about at a time.
const BATCH: usize = 24;

type Make = Box<dyn Fn(usize) -> hyperrod::Result<Box<dyn CrossSection>>>;

fn of<M: Material + Copy + 'static>(material: M) -> Make {
    Box::new(move |degree| Ok(Box::new(Section::new(Circle::new(RADIUS), material)?.with_degree(degree)?)))
}

/// Law, level, and the section of a degree.
fn curves() -> Outcome<[(&'static str, &'static str, Make); 5]> {
    let [mu, lambda] = LAME;
    let neo = NeoHookean::new(mu, lambda)?;
    Ok([
        ("neo-Hookean", "isotropic", of(neo)),
        ("neo-Hookean", "local", of(NeoLocal)),
        ("neo-Hookean", "section", of(NeoSectional)),
        ("polynomial", "isotropic", of(PolyIsotropic)),
        ("Gent", "isotropic", of(Gent::new(mu, lambda, 30.0)?)),
    ])
}

/// The same neo-Hookean law at the local level, from γ.
#[derive(Clone, Copy)]
struct NeoLocal;

impl Local for NeoLocal {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, _at: &Point<D>) -> D {
        let g = f.gamma();
        neo_hookean(g.x, g.y, g.z)
    }
}

/// The same at the section level, from Δξ and the point.
#[derive(Clone, Copy)]
struct NeoSectional;

impl Sectional for NeoSectional {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, xi: &Strain<D>, at: &Point<D>) -> D {
        let (w, n) = (xi.angular, xi.linear);
        neo_hookean(n.x - w.z * at.y, n.y + w.z * at.x, n.z + w.x * at.y - w.y * at.x)
    }
}

#[inline(always)]
fn neo_hookean<D: Scalar>(a: D, b: D, e: D) -> D {
    let [mu, lambda] = LAME;
    let log = e.ln_1p();
    (a * a + b * b + e * e + (e - log) * 2.0) * (0.5 * mu) + log * log * (0.5 * lambda)
}

pub fn measure(run: &Run) -> Outcome {
    quadrature(run)?;
    by_hand(run)
}

/// All strains, in batches.
fn respond_all(
    section: &dyn CrossSection,
    sites: &[(Station, Strain)],
    out: &mut [Response],
) -> hyperrod::Result<()> {
    for (sites, out) in sites.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
        section.respond_many(sites, Request::Tangent, out)?;
    }
    Ok(())
}

fn quadrature(run: &Run) -> Outcome {
    /// Converged for every law here: the error falls by a digit for a degree or two.
    const EXACT: usize = 60;
    let tick = timing::tick();
    let strains = strains(10 * BATCH);
    let sites: Vec<_> = strains.iter().map(|strain| (Station::straight(0.0), *strain)).collect();
    let (mut exact, mut out) = (vec![Response::zero(); sites.len()], vec![Response::zero(); sites.len()]);
    let mut table = Table::new(&["law", "level", "degree", "error", "ns", "ticks"]);
    for (law, level, make) in curves()? {
        respond_all(&make(EXACT)?, &sites, &mut exact)?;
        let degrees: &[usize] = match law {
            "polynomial" => &[2, 4, 8],
            _ => run.of(&[2, 8, 12, 16], &[2, 4, 6, 8, 10, 12, 16, 20, 24]),
        };
        for &degree in degrees {
            let section = make(degree)?;
            respond_all(&section, &sites, &mut out)?;
            let errors = exact.iter().zip(&out).zip(&strains);
            let error = errors.map(|((a, b), x)| difference(a, b, x, RADIUS)).fold(0.0, f64::max);
            let micros = timing::quartile(run, || {
                let _ = black_box(respond_all(&section, black_box(&sites), &mut out));
            });
            let ns = 1e3 * micros / sites.len() as f64;
            table.push(&[law, level], &[degree as f64, error, ns, ns * 1e-3 / tick]);
        }
    }
    table.save(&run.output.path(CURVES))
}

/// One strain after the other over the same 24 points, each code in its turn.
fn by_hand(run: &Run) -> Outcome {
    let (points, strains) = (rings(RADIUS), strains(50));
    let (points, strains) = (&points, &strains);
    let neo = NeoHookean::new(LAME[0], LAME[1])?;
    fn each<'a, R>(strains: &'a [Strain], respond: impl Fn(&Strain) -> R + 'a) -> Box<dyn FnMut() + 'a> {
        Box::new(move || {
            for strain in strains {
                black_box(&respond(black_box(strain)));
            }
        })
    }
    fn engine<'a>(
        strains: &'a [Strain],
        material: &'a impl Material,
        points: &'a Points,
    ) -> Box<dyn FnMut() + 'a> {
        let at = Station::straight(0.0);
        each(strains, move |strain| material.integrate(points, &at, strain, Request::Tangent))
    }
    let names = [
        ("polynomial", "hand scalar"),
        ("polynomial", "hand vectorised"),
        ("polynomial", "num-dual"),
        ("polynomial", "isotropic"),
        ("neo-Hookean", "hand scalar"),
        ("neo-Hookean", "hand vectorised"),
        ("neo-Hookean", "num-dual"),
        ("neo-Hookean", "isotropic"),
        ("neo-Hookean", "local"),
        ("neo-Hookean", "section"),
    ];
    let mut calls = [
        each(strains, |x| hand_scalar(PolyByHand, points, x)),
        each(strains, |x| hand_vector(PolyByHand, points, x)),
        each(strains, |x| num_dual_of_sum(PolyByHand, points, x)),
        engine(strains, &PolyIsotropic, points),
        each(strains, |x| hand_scalar(NeoHookeanByHand, points, x)),
        each(strains, |x| hand_vector(NeoHookeanByHand, points, x)),
        each(strains, |x| num_dual_of_sum(NeoHookeanByHand, points, x)),
        engine(strains, &neo, points),
        engine(strains, &NeoLocal, points),
        engine(strains, &NeoSectional, points),
    ];
    let tick = timing::tick();
    let micros = timing::interleaved(run.of(11, 401), &mut calls);
    let mut table = Table::new(&["law", "code", "ns", "ticks"]);
    for ((law, code), micros) in names.into_iter().zip(micros) {
        let ns = 1e3 * micros / strains.len() as f64;
        table.push(&[law, code], &[ns, ns * 1e-3 / tick]);
    }
    table.save(&run.output.path(BY_HAND))
}

pub fn page(run: &Run, page: &mut Page) -> Outcome {
    let table = Table::load(&run.output.path(CURVES))?;
    let curve = |law: &str, level: &str| -> Vec<[f64; 2]> {
        let rows = table.rows().filter(|row| row.is("law", law) && row.is("level", level));
        rows.map(|row| [row.number("ns"), row.number("error").max(1e-17)]).collect()
    };
    let chart =
        |title: &str| Chart::new(title, "time of an evaluation, ns", "error of Ψ and ∂Ψ/∂Δξ").log(true, true);
    let mut levels = chart("Levels of a law: neo-Hookean, degree 2 to 24, against degree 60");
    for level in ["isotropic", "local", "section"] {
        levels = levels.dots(&format!("{level} level"), curve("neo-Hookean", level));
    }
    let mut laws = chart("Laws at the isotropic level, against degree 60");
    for law in ["polynomial", "neo-Hookean", "Gent"] {
        laws = laws.dots(law, curve(law, "isotropic"));
    }
    stack(&run.output.path("figures").join(FIGURE), &[levels, laws])?;

    page.heading("Engine");
    page.paragraph(
        "One evaluation is the energy, the wrench Ψ and its tangent of a circular section at one strain, 24 strains at a call as the element solver asks; \
         strains of up to 30 % at the surface. The error is the largest over 240 random strains, relative to the largest entry, and is that of the quadrature alone: a \
         five-term polynomial is exact from degree 4 on.",
    );
    page.figure(FIGURE, "Time of an evaluation against the error of its quadrature");
    let used = |row: &Row<'_>| row.number("degree") == if row.is("law", "polynomial") { 4.0 } else { 12.0 };
    let mut rows = Vec::new();
    for row in table.rows().filter(used) {
        let (law, level) = (row.text("law"), row.text("level"));
        let key = format!("engine.{law}.{level}");
        rows.push(vec![
            format!("{law}, {level} level, degree {}", row.number("degree")),
            page.key(&format!("{key}.ns"), &digits(row.number("ns"))),
            page.key(&format!("{key}.ticks"), &digits(row.number("ticks"))),
            page.key(&format!("{key}.error"), &scientific(row.number("error"))),
        ]);
    }
    page.table(&["law at the degree it has by default", "ns", "ticks", "error"], &rows);
    ratios(run, page)
}

fn ratios(run: &Run, page: &mut Page) -> Outcome {
    let table = Table::load(&run.output.path(BY_HAND))?;
    page.paragraph(
        "Against derivatives taken by hand, over the same 24 points, one strain at a call: `hand scalar` as a careful programmer writes it, `hand \
         vectorised` on the widest vectors of the machine, `num-dual` the `hessian()` of that crate in six variables.",
    );
    let time = |law: &str, code: &str| {
        table
            .rows()
            .find(|row| row.is("law", law) && row.is("code", code))
            .map_or(f64::NAN, |row| row.number("ns"))
    };
    let mut rows = Vec::new();
    for row in table.rows() {
        let (law, code, ns) = (row.text("law"), row.text("code"), row.number("ns"));
        let key = format!("engine.{law}.{code}");
        let mut cells = vec![format!("{law}, {code}"), digits(ns), digits(row.number("ticks"))];
        for (other, name) in
            [("hand scalar", "of_scalar"), ("hand vectorised", "of_vectorised"), ("num-dual", "of_num_dual")]
        {
            cells.push(page.key(&format!("{key}.{name}"), &digits(ns / time(law, other))));
        }
        rows.push(cells);
    }
    page.table(&["code", "ns", "ticks", "/ hand scalar", "/ hand vectorised", "/ num-dual"], &rows);
    Ok(())
}
