//! A tendon of a given length: the tension that makes it so.

use super::{Failure, Reason, StaticSolution, Statics, Workspace};
use crate::body::Body;
use crate::error::Error;
use crate::rod::Rod;
use crate::section::{CrossSection, Routing, Tendon};

/// A rod whose tendon has the length asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct TendonSolution {
    /// The rod.
    pub solution: StaticSolution,
    /// Tension of the tendon, N.
    pub tension: f64,
    /// Length of the tendon, m.
    pub length: f64,
    /// How many times the rod was solved.
    pub solves: usize,
}

/// The length may miss what was asked by this much of it.
const CLOSE: f64 = 1e-12;

/// Where it no longer falls, this much is rounding of the solves.
const ROUNDING: f64 = 1e-10;

/// Solves for one length.
const MAX_SOLVES: usize = 40;

impl<R: Routing> Tendon<R> {
    /// The length of the tendon in a solved rod, ∫|γ| ds, m.
    pub fn length_in<C: CrossSection, M: Send + Sync>(
        &self,
        body: &Body<C, M>,
        solution: &StaticSolution,
    ) -> f64 {
        solution.integrate(|node| self.stretch(&body.station(node.s), &node.strain))
    }
}

impl Statics {
    /// Solves a rod whose tendon is given by its length instead of its tension, as a servo holds it.
    ///
    /// `rod` makes the rod with the tendon it is handed; the tension of `tendon` is where the search starts. The length is a function of the tension alone,
    /// whose root is found by the secant method inside a bracket once there is one; every solve is a full one, at a fixed tension.
    ///
    /// ```
    /// use hyperrod::section::{CrossSection, Stiffness, Tendon};
    /// use hyperrod::{Body, Pose, Rod, Statics};
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let finger = |tendon: Tendon<[f64; 2]>| {
    ///     let section = Stiffness::diagonal([4e-3, 4e-3, 3e-3, 50.0, 50.0, 150.0])?.with_actuator(tendon);
    ///     Ok(Rod::clamped(Body::new(0.4, section)?, Pose::identity()))
    /// };
    /// let start = Tendon::new([8e-3, 0.0], 0.5)?;
    /// let pulled = Statics::default().solve_tendon_length(0.39, start, finger)?; // 10 mm drawn in
    /// assert!((pulled.length - 0.39).abs() < 1e-12 && pulled.tension > 1.0);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`solve`](Self::solve); [`Reason::Options`] where the start has no tension, the length is not positive, `rod` fails, or the tendon is slack: as long as
    /// asked without any pull; [`Reason::Length`] where the search does not end.
    pub fn solve_tendon_length<C, M, R>(
        &self,
        length: f64,
        tendon: Tendon<R>,
        rod: impl Fn(Tendon<R>) -> crate::Result<Rod<Body<C, M>>>,
    ) -> Result<TendonSolution, Box<Failure>>
    where
        C: CrossSection,
        M: Send + Sync,
        R: Routing + Clone,
    {
        if !(length > 0.0 && length.is_finite()) {
            return Err(refused("length of the tendon", length, "positive and finite"));
        }
        if tendon.tension() == 0.0 {
            return Err(refused("tension that the search for a length starts with", 0.0, "positive"));
        }
        let mut workspace = Workspace::default();
        let mut solves = 0;
        let mut at = |tension: f64| -> Result<TendonSolution, Box<Failure>> {
            solves += 1;
            let tendon = tendon.clone().with_tension(tension).map_err(Failure::of_options)?;
            let rod = rod(tendon.clone()).map_err(Failure::of_options)?;
            let solution = self.solve_in(&mut workspace, &rod)?;
            let length = tendon.length_in(rod.body(), &solution);
            Ok(TendonSolution { solution, tension, length, solves })
        };
        search(length, tendon.tension(), &mut at)
    }
}

fn refused(quantity: &'static str, value: f64, requirement: &'static str) -> Box<Failure> {
    Failure::of_options(Error::Invalid { quantity, value, requirement })
}

/// The secant method from T and 1.1 T, kept between the tensions known to be too low and too high.
fn search(
    length: f64,
    start: f64,
    at: &mut dyn FnMut(f64) -> Result<TendonSolution, Box<Failure>>,
) -> Result<TendonSolution, Box<Failure>> {
    let slack = at(0.0)?;
    if slack.length <= length {
        return Err(refused("length of the tendon", length, "shorter than the slack tendon"));
    }
    // a longer tendon than asked: too little tension
    let (mut low, mut high) = (0.0_f64, f64::INFINITY);
    let (mut before, mut now) = (slack, at(start)?);
    let mut best = f64::INFINITY;
    loop {
        let miss = now.length - length;
        let size = miss.abs() / length;
        if size <= CLOSE || (size <= ROUNDING && size >= 0.5 * best) {
            return Ok(now);
        }
        best = best.min(size);
        if now.solves >= MAX_SOLVES {
            let reason = Reason::Length { asked: length, found: now.length, solves: now.solves };
            let report = now.solution.report().clone();
            return Err(Box::new(Failure { reason, report, last: Some(now.solution) }));
        }
        if miss > 0.0 {
            low = low.max(now.tension);
        } else {
            high = high.min(now.tension);
        }
        let slope = (now.length - before.length) / (now.tension - before.tension);
        let secant = now.tension - miss / slope;
        // no further than twice the largest tension tried
        let limit = if high.is_finite() { high } else { 2.0 * low.max(now.tension) };
        let next = if secant > low && secant < limit {
            secant
        } else if high.is_finite() {
            0.5 * (low + high)
        } else {
            limit
        };
        before = std::mem::replace(&mut now, at(next)?);
    }
}
