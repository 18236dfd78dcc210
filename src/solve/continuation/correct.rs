//! From a point on the path to the next one.

use super::family::Family;
use crate::error::{Error, Result};

/// A point with the unit tangent of the path in it.
#[derive(Clone, Debug)]
pub(super) struct Place<F: Family> {
    pub(super) state: F::State,
    pub(super) factor: f64,
    /// dx/ds.
    pub(super) direction: F::Step,
    /// dλ/ds.
    pub(super) slope: f64,
}

/// What Newton's method in the hyperplane is allowed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corrector {
    pub(super) iterations: usize,
    /// A step of this length is the last.
    pub(super) tolerance: f64,
}

/// A corrector may not leave the predicted point by more than so many lengths of the step.
const FARTHEST: f64 = 4.0;

/// A step this small that no longer falls is rounding.
const ROUNDING: f64 = 1e-7;

impl Corrector {
    /// The point of the path in the hyperplane at `length` along the tangent, and how many iterations it took.
    pub(super) fn step<F: Family>(
        &self,
        family: &mut F,
        from: &Place<F>,
        length: f64,
    ) -> Result<(Place<F>, usize)> {
        let mut travelled = family.combined(length, &from.direction, 0.0, &from.direction);
        let mut factor = from.factor + length * from.slope;
        let mut previous = f64::INFINITY;
        for iteration in 1..=self.iterations {
            let state = family.moved(&from.state, &travelled);
            let tangents = family.tangents(&state, factor)?;
            let (u, v) = (&tangents.correction, &tangents.per_factor);
            let ahead = family.product(&from.direction, &travelled) + from.slope * (factor - from.factor);
            let missing = length - ahead - family.product(&from.direction, u);
            let d_factor = missing / (family.product(&from.direction, v) + from.slope);
            let step = family.combined(1.0, u, d_factor, v);
            let size = (family.product(&step, &step) + d_factor * d_factor).sqrt();
            travelled = family.combined(1.0, &travelled, 1.0, &step);
            factor += d_factor;
            let distance = family.product(&travelled, &travelled).sqrt();
            if !size.is_finite() || distance + size > FARTHEST * length.abs().max(1e-300) + 1.0 {
                return Err(no_convergence(iteration, size));
            }
            if size <= self.tolerance || (size < ROUNDING && size > 0.5 * previous) {
                let state = family.moved(&from.state, &travelled);
                return Ok((place(family, state, factor, from)?, iteration));
            }
            previous = size;
        }
        Err(no_convergence(self.iterations, previous))
    }

    /// Newton's method at fixed λ.
    pub(super) fn at<F: Family>(&self, family: &mut F, state: F::State, factor: f64) -> Result<F::State> {
        let (mut state, mut previous) = (state, f64::INFINITY);
        for _ in 0..self.iterations {
            let step = family.tangents(&state, factor)?.correction;
            let size = family.product(&step, &step).sqrt();
            state = family.moved(&state, &step);
            if size <= self.tolerance || (size < ROUNDING && size > 0.5 * previous) {
                return Ok(state);
            }
            if !size.is_finite() {
                break;
            }
            previous = size;
        }
        Err(no_convergence(self.iterations, previous))
    }
}

fn no_convergence(iterations: usize, residual: f64) -> Error {
    Error::NoConvergence { what: "corrector of the path", iterations, residual }
}

/// The point with its tangent, turned so that the path goes on as it came.
pub(super) fn place<F: Family>(
    family: &mut F,
    state: F::State,
    factor: f64,
    from: &Place<F>,
) -> Result<Place<F>> {
    let v = family.tangents(&state, factor)?.per_factor;
    let onward = family.product(&from.direction, &v) + from.slope;
    Ok(oriented(family, state, factor, &v, onward))
}

/// The point with its tangent along growing λ.
pub(super) fn start<F: Family>(family: &mut F, state: F::State, factor: f64) -> Result<Place<F>> {
    let v = family.tangents(&state, factor)?.per_factor;
    Ok(oriented(family, state, factor, &v, 1.0))
}

fn oriented<F: Family>(family: &F, state: F::State, factor: f64, v: &F::Step, onward: f64) -> Place<F> {
    let norm = (family.product(v, v) + 1.0).sqrt();
    let slope = if onward < 0.0 { -1.0 / norm } else { 1.0 / norm };
    Place { state, factor, direction: family.combined(slope, v, 0.0, v), slope }
}
