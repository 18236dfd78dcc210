use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

use super::CrossSection;
use crate::error::{Error, Result, positive};
use crate::lie::{Strain, Wrench};
use crate::material::{Request, Station};

/// A curve of a section: the strains in equilibrium with a growing wrench, Ψ(Δξ) = λ Λ₀, followed by arc length through its limit points.
///
/// Moment–curvature, torque–twist and force–stretch curves with all other resultants zero are those of Λ₀ = a unit moment about x, one
/// about e₃ and a unit force along e₃.
///
/// ```
/// use hyperrod::Wrench;
/// use hyperrod::material::{NeoHookean, Station};
/// use hyperrod::section::{Circle, PathOptions, Relaxed, Warping, WrenchPath};
/// # fn main() -> hyperrod::Result<()> {
/// let arm = Relaxed::new(Circle::new(0.01), NeoHookean::from_young(1e6, 0.45)?)?.with_warping(Warping::CONTRACTION)?;
/// let torque = Wrench::from_array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
/// let curve = WrenchPath::follow(&arm, &Station::straight(0.0), &torque, &PathOptions::default())?;
/// let last = curve.points.last().expect("a curve has points");
/// assert!(last.strain.linear.z > 0.0); // a twisted cylinder grows longer (Poynting)
/// # Ok(()) }
/// ```
///
/// Source: Riks (1979), Int. J. Solids Struct. 15, 529; Keller (1977), in *Applications of Bifurcation Theory*.
#[derive(Clone, Debug)]
pub struct WrenchPath {
    /// The points of the curve, from rest on.
    pub points: Vec<PathPoint>,
    /// Where λ is largest or smallest on the way: what a load cannot pass.
    pub limits: Vec<PathPoint>,
    /// What ended it before the largest strain was reached, if anything did.
    pub ended: Option<Error>,
}

/// A point of a [`WrenchPath`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// The factor λ of the wrench.
    pub load: f64,
    /// Δξ.
    pub strain: Strain,
    /// U, J/m.
    pub energy: f64,
}

/// How far and how finely a [`WrenchPath`] is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathOptions {
    /// The size of a strain to stop at: stretches and shears as they are, curvatures times the radius of gyration √(EI_x/EA).
    pub largest: f64,
    /// The arc length from point to point, in the same measure.
    pub step: f64,
    /// The most points there may be.
    pub max_points: usize,
}

impl Default for PathOptions {
    /// Up to 0.5 in steps of 0.02, 200 points at most.
    fn default() -> Self {
        Self { largest: 0.5, step: 0.02, max_points: 200 }
    }
}

type Vector7 = SVector<f64, 7>;

/// Newton iterations at a point, halvings of a step, and of the interval around a limit point.
const ITERATIONS: usize = 12;
const HALVINGS: usize = 12;
const BISECTIONS: usize = 40;
/// The size of a correction, in the measure of the arc length, that ends the iteration.
const TOLERANCE: f64 = 1e-10;

struct Follower<'a, C: ?Sized> {
    section: &'a C,
    at: &'a Station,
    direction: Vector6<f64>,
    /// Units of (Δξ, λ).
    scale: Vector7,
}

/// A point, the unit tangent there in scaled variables, and the energy.
#[derive(Clone, Copy)]
struct Stop {
    z: Vector7,
    tangent: Vector7,
    energy: f64,
}

impl WrenchPath {
    /// Follows the curve of a wrench from rest.
    ///
    /// # Errors
    /// As [`CrossSection::respond`] at rest; [`Error::Invalid`] if the wrench is zero or an option is not positive and finite;
    /// [`Error::Singular`] if the section has no stiffness at rest. What fails later ends the curve.
    pub fn follow(
        section: &(impl CrossSection + ?Sized),
        at: &Station,
        direction: &Wrench,
        options: &PathOptions,
    ) -> Result<Self> {
        for (quantity, value) in [
            ("largest strain of a path", options.largest),
            ("step of a path", options.step),
            ("wrench of a path", direction.to_vector().norm()),
        ] {
            positive(quantity, value)?;
        }
        let rest = section.respond(at, &Strain::zero(), Request::Tangent)?;
        let singular = Error::Singular { matrix: "tangent of the section at rest", s: at.s };
        let follower =
            Follower::new(section, at, direction.to_vector(), &rest.tangent).ok_or(singular.clone())?;
        let toward = Vector7::from_fn(|i, _| f64::from(u8::from(i == 6)));
        let tangent = follower.tangent(&rest.tangent, &toward).ok_or(singular)?;
        let first = Stop { z: Vector7::zeros(), tangent, energy: rest.energy };
        Ok(follower.run(first, options))
    }
}

impl<'a, C: CrossSection + ?Sized> Follower<'a, C> {
    fn new(section: &'a C, at: &'a Station, direction: Vector6<f64>, rest: &Matrix6<f64>) -> Option<Self> {
        let length = (rest[(0, 0)] / rest[(5, 5)]).abs().sqrt();
        let mut scale = Vector7::from_element(1.0);
        for i in 0..3 {
            scale[i] = 1.0 / length;
        }
        let response = rest.lu().solve(&direction)?;
        let size = (0..6).map(|i| (response[i] / scale[i]).powi(2)).sum::<f64>().sqrt();
        scale[6] = 1.0 / size;
        (size.is_finite() && size > 0.0).then_some(Self { section, at, direction, scale })
    }

    /// The bordered matrix [K −Λ₀; tᵀ] in scaled variables.
    fn bordered(&self, k: &Matrix6<f64>, row: &Vector7) -> SMatrix<f64, 7, 7> {
        let mut m = SMatrix::<f64, 7, 7>::zeros();
        for i in 0..6 {
            for j in 0..6 {
                m[(i, j)] = k[(i, j)] * self.scale[j] * self.scale[i];
            }
            m[(i, 6)] = -self.direction[i] * self.scale[6] * self.scale[i];
        }
        let largest = m.amax();
        for j in 0..7 {
            m[(6, j)] = row[j] * largest;
        }
        m
    }

    fn tangent(&self, k: &Matrix6<f64>, toward: &Vector7) -> Option<Vector7> {
        let m = self.bordered(k, toward);
        let right = Vector7::from_fn(|i, _| if i == 6 { m.amax() } else { 0.0 });
        let t = m.lu().solve(&right)?.normalize();
        (t.iter().all(|v| v.is_finite())).then_some(t)
    }

    /// The point at arc length `step` from another.
    fn advance(&self, from: &Stop, step: f64) -> Result<Stop> {
        let mut z = from.z + from.tangent * step;
        let singular = Error::Singular { matrix: "bordered tangent of the section", s: self.at.s };
        let mut size = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let strain = self.strain(&z);
            let response = self.section.respond(self.at, &strain, Request::Tangent)?;
            if size < TOLERANCE {
                let tangent = self.tangent(&response.tangent, &from.tangent).ok_or(singular)?;
                return Ok(Stop { z, tangent, energy: response.energy });
            }
            let psi = response.wrench.to_vector();
            let m = self.bordered(&response.tangent, &from.tangent);
            let mut right = Vector7::zeros();
            for i in 0..6 {
                right[i] = -(psi[i] - z[6] * self.scale[6] * self.direction[i]) * self.scale[i];
            }
            right[6] = (step - from.tangent.dot(&(z - from.z))) * m.amax();
            let change = m.lu().solve(&right).ok_or(singular.clone())?;
            size = change.norm();
            z += change;
        }
        let what = "a point of a section's path";
        Err(Error::NoConvergence { what, iterations: ITERATIONS, residual: size })
    }

    fn strain(&self, z: &Vector7) -> Strain {
        Strain::from_array(std::array::from_fn(|i| z[i] * self.scale[i]))
    }

    fn point(&self, stop: &Stop) -> PathPoint {
        PathPoint { load: stop.z[6] * self.scale[6], strain: self.strain(&stop.z), energy: stop.energy }
    }

    fn run(&self, first: Stop, options: &PathOptions) -> WrenchPath {
        let mut path = WrenchPath { points: vec![self.point(&first)], limits: Vec::new(), ended: None };
        let mut here = first;
        while path.points.len() < options.max_points {
            let next = match self.step(&here, options.step) {
                Ok(next) => next,
                Err(error) => {
                    path.ended = Some(error);
                    break;
                }
            };
            if here.tangent[6] * next.tangent[6] < 0.0 {
                path.limits.extend(self.limit(&here, &next).map(|stop| self.point(&stop)));
            }
            here = next;
            path.points.push(self.point(&here));
            if here.z.fixed_rows::<6>(0).norm() >= options.largest {
                break;
            }
        }
        path
    }

    /// One step, halved where it does not converge.
    fn step(&self, here: &Stop, step: f64) -> Result<Stop> {
        let mut fraction = step;
        let mut last = None;
        for _ in 0..HALVINGS {
            match self.advance(here, fraction) {
                // a tangent that turns by more than 60° has gone to another branch
                Ok(next) if next.tangent.dot(&here.tangent) > 0.5 => return Ok(next),
                Ok(_) => {}
                Err(error) => last = Some(error),
            }
            fraction *= 0.5;
        }
        let what = "a step of a section's path";
        Err(last.unwrap_or(Error::NoConvergence { what, iterations: HALVINGS, residual: fraction }))
    }

    /// Where the load is stationary between two points, by bisection on the arc length.
    fn limit(&self, from: &Stop, to: &Stop) -> Option<Stop> {
        let (mut low, mut high) = (0.0, from.tangent.dot(&(to.z - from.z)));
        let mut found = None;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let stop = self.advance(from, middle).ok()?;
            if stop.tangent[6] * from.tangent[6] > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
            found = Some(stop);
            if high - low < TOLERANCE {
                break;
            }
        }
        found
    }
}
