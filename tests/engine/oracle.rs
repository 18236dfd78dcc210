//! U, Ψ, K and Ψ′ point by point with num-dual's own numbers: no lanes, no chain rule by hand, no moments.

use hyperrod::material::{
    Local, Point, PointRates, Points, Reference, Request, Response, Sectional, Station,
};
use hyperrod::{Scalar, Strain, Twist, Wrench};
use nalgebra::{Const, Matrix6, U1};
use num_dual::{Dual2SVec64, HyperDualSVec64};

/// Lengths that make the six components of strain and wrench comparable, m.
const LENGTH: [f64; 6] = [0.01, 0.01, 0.01, 1.0, 1.0, 1.0];

/// Over which lengths a section of these tests may change, m: the scale of Ψ′ is Ψ over it.
const CHANGE: f64 = 0.1;

type Hessian = Dual2SVec64<7>;
type Mixed = HyperDualSVec64<6, 7>;

/// A density in J/m³ of strain and point, per dA ds, in num-dual's numbers: an object, so that what is made of it is compiled once.
pub trait Density {
    fn hessian(&self, strain: &Strain<Hessian>, at: &Point<Hessian>, station: &Station) -> Hessian;
    fn mixed(&self, strain: &Strain<Mixed>, at: &Point<Mixed>, station: &Station) -> Mixed;
}

/// Any law, on a straight reference.
pub struct Straight<'a, M>(pub &'a M);

impl<M: Sectional> Density for Straight<'_, M> {
    fn hessian(&self, strain: &Strain<Hessian>, at: &Point<Hessian>, _: &Station) -> Hessian {
        self.0.energy_density(strain, at)
    }

    fn mixed(&self, strain: &Strain<Mixed>, at: &Point<Mixed>, _: &Station) -> Mixed {
        self.0.energy_density(strain, at)
    }
}

/// A local law on a curved reference: j u(γ/j), with j the volume of the reference.
pub struct Curved<'a, M>(pub &'a M);

impl<M: Local> Density for Curved<'_, M> {
    fn hessian(&self, strain: &Strain<Hessian>, at: &Point<Hessian>, station: &Station) -> Hessian {
        let (j, over_j) = divided(strain, at, station);
        Straight(self.0).hessian(&over_j, at, station) * j
    }

    fn mixed(&self, strain: &Strain<Mixed>, at: &Point<Mixed>, station: &Station) -> Mixed {
        let (j, over_j) = divided(strain, at, station);
        Straight(self.0).mixed(&over_j, at, station) * j
    }
}

/// j, and the strain divided by it, whose γ at the point is γ/j.
fn divided<D: Scalar>(strain: &Strain<D>, at: &Point<D>, station: &Station) -> (D, Strain<D>) {
    let (xi, rate) = (station.reference.twist.to_array(), station.reference.rate.to_array());
    let along = |i: usize| (at.s - station.s) * rate[i] + xi[i];
    let j = along(5) + along(0) * at.y - along(1) * at.x;
    (j, Strain::from_array(strain.to_array().map(|x| x / j)))
}

/// What num-dual gives, and the sums of the magnitudes of what the points contribute, lengths taken out.
pub struct Expected {
    response: Response,
    energy: f64,
    wrench: f64,
    tangent: f64,
}

/// The sums over the points, each differentiated in (Δξ, s) as a whole: w(s) u(Δξ, x(s), y(s), s).
pub fn expected(density: &dyn Density, points: &Points, station: &Station, strain: &Strain) -> Expected {
    let mut response = Response::zero();
    let (mut energy, mut wrench, mut tangent) = (0.0, [0.0; 6], Matrix6::zeros());
    for q in 0..points.len() {
        let variables: [Hessian; 7] =
            std::array::from_fn(|i| Hessian::from_re(component(strain, station, i)).derivative(i));
        let (strain_there, point, weight) = at_point(points, q, station, variables);
        let u = density.hessian(&strain_there, &point, station) * weight;
        let gradient = u.v1.unwrap_generic(U1, Const::<7>);
        let hessian = u.v2.unwrap_generic(Const::<7>, Const::<7>);
        // the mixed derivatives once more with numbers that keep two sets of variables apart
        let mixed: [Mixed; 7] = std::array::from_fn(|i| {
            let x = Mixed::from_re(component(strain, station, i)).derivative2(i);
            if i < 6 { x.derivative1(i) } else { x }
        });
        let (strain_there, point, weight) = at_point(points, q, station, mixed);
        let mixed = (density.mixed(&strain_there, &point, station) * weight).eps1eps2;
        let mixed = mixed.unwrap_generic(Const::<6>, Const::<7>);
        let largest = hessian.amax() * (1.0 + CHANGE);
        for i in 0..6 {
            for j in 0..7 {
                let error = (mixed[(i, j)] - hessian[(i, j)]).abs();
                assert!(error <= 1e-12 * largest, "num-dual disagrees with itself: {error:e} of {largest:e}");
            }
        }
        response.energy += u.re;
        energy += u.re.abs();
        response.wrench += Wrench::from_array(std::array::from_fn(|i| gradient[i]));
        response.wrench_rate += Wrench::from_array(std::array::from_fn(|i| hessian[(i, 6)]));
        let block = hessian.fixed_view::<6, 6>(0, 0).into_owned();
        response.tangent += block;
        for i in 0..6 {
            wrench[i] += (gradient[i] / LENGTH[i]).abs().max((hessian[(i, 6)] / LENGTH[i]).abs() * CHANGE);
        }
        tangent += block.map_with_location(|i, j, k| (k / (LENGTH[i] * LENGTH[j])).abs());
    }
    let largest = wrench.into_iter().fold(0.0, f64::max);
    Expected { response, energy, wrench: largest, tangent: tangent.amax() }
}

fn component(strain: &Strain, station: &Station, i: usize) -> f64 {
    if i < 6 { strain.to_array()[i] } else { station.s }
}

/// Strain, point and weight as they depend on (Δξ, s).
fn at_point<D: Scalar>(points: &Points, q: usize, station: &Station, v: [D; 7]) -> (Strain<D>, Point<D>, D) {
    let step = v[6] - station.s;
    let moving = |value: f64, rate: fn(&PointRates) -> &Vec<f64>| {
        step * points.rates.as_ref().map_or(0.0, |rates| rate(rates)[q]) + value
    };
    let (x, y) = (moving(points.x[q], |r| &r.x), moving(points.y[q], |r| &r.y));
    let strain = Strain::from_array([v[0], v[1], v[2], v[3], v[4], v[5]]);
    (strain, Point { x, y, s: v[6] }, moving(points.weight[q], |r| &r.weight))
}

impl Expected {
    /// The largest error of what was asked for, relative to the sums of magnitudes.
    pub fn error_of(&self, answer: &Response, request: Request) -> f64 {
        let d = |a: Wrench, b: Wrench| {
            let d = (a - b).to_array();
            (0..6).map(|i| (d[i] / LENGTH[i]).abs()).fold(0.0, f64::max)
        };
        let expected = &self.response;
        let mut worst = ratio((answer.energy - expected.energy).abs(), self.energy);
        if request >= Request::Wrench {
            worst = worst.max(ratio(d(answer.wrench, expected.wrench), self.wrench));
        }
        if request >= Request::Tangent {
            let k = (answer.tangent - expected.tangent)
                .map_with_location(|i, j, k| k / (LENGTH[i] * LENGTH[j]))
                .amax();
            worst = worst.max(ratio(k, self.tangent));
            assert_eq!(answer.tangent, answer.tangent.transpose(), "a symmetric tangent, to the bit");
        }
        if request == Request::Rate {
            worst = worst.max(ratio(d(answer.wrench_rate, expected.wrench_rate) * CHANGE, self.wrench));
        }
        if worst.is_nan() { f64::INFINITY } else { worst }
    }
}

fn ratio(error: f64, scale: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / scale }
}

/// Entries that were not asked for are zero.
pub fn assert_nothing_more(answer: &Response, request: Request) {
    let rest = Response {
        energy: 0.0,
        wrench: if request < Request::Wrench { answer.wrench } else { Wrench::zero() },
        tangent: if request < Request::Tangent { answer.tangent } else { Matrix6::zeros() },
        wrench_rate: if request < Request::Rate { answer.wrench_rate } else { Wrench::zero() },
    };
    assert_eq!(rest, Response::zero(), "{request:?} gave more than asked");
}

pub const REQUESTS: [Request; 4] = [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate];

/// Points without symmetry, of a section of about a centimetre, that move along s where asked.
pub fn points(count: usize, moving: bool) -> Points {
    let of = |scale: f64, f: &dyn Fn(f64) -> f64| (0..count).map(|q| scale * f(q as f64)).collect::<Vec<_>>();
    let rates = PointRates {
        x: of(0.04, &|q| (0.3 * q).cos()),
        y: of(0.05, &|q| (0.9 * q).sin()),
        weight: of(1e-4, &|q| (1.7 * q).sin()),
    };
    Points {
        x: of(0.01, &|q| (1.3 * q + 0.2).sin()),
        y: of(0.01, &|q| (2.1 * q + 0.7).cos()),
        weight: of(1e-5, &|q| 1.0 + 0.5 * q.sin()),
        rates: moving.then_some(rates),
    }
}

pub fn straight() -> Station {
    Station::straight(0.11)
}

pub fn curved() -> Station {
    let twist = Twist::from_array([5.0, -8.0, 3.0, 0.02, -0.01, 1.1]);
    let rate = Twist::from_array([20.0, 10.0, -30.0, 0.3, 0.2, -0.4]);
    Station { s: 0.11, reference: Reference { twist, rate } }
}

/// Of six numbers of order one: a strain of that size at the rim.
pub fn strain(direction: [f64; 6], size: f64) -> Strain {
    Strain::from_array(std::array::from_fn(|i| size * direction[i] / LENGTH[i]))
}
