use nalgebra::{Matrix6, SymmetricEigen, Vector6};

use super::Probe;
use super::report::{AxisRange, Bound};
use crate::error::Error;
use crate::material::Request;

/// Steps of the search in each direction; the loss is then found by bisection.
const STEPS: usize = 100;

/// Halvings of a step: to 1e-9 of it.
const HALVINGS: usize = 30;

/// Rounding of a 6×6 eigenvalue, with a margin for that of the tangent itself.
const ROUNDING: f64 = 1e-12;

/// What is found at one strain.
enum State {
    Stable,
    Lost([f64; 6]),
    Refused(Error),
}

/// How far each strain alone can go, either way, before ∂Ψ/∂Δξ stops being positive definite.
pub(super) fn ranges(probe: &Probe<'_>, largest: f64) -> [AxisRange; 6] {
    std::array::from_fn(|axis| AxisRange {
        axis,
        lower: bound(probe, axis, -largest),
        upper: bound(probe, axis, largest),
        length: if axis < 3 { probe.length } else { 1.0 },
    })
}

fn bound(probe: &Probe<'_>, axis: usize, largest: f64) -> Bound {
    let mut stable = 0.0;
    for step in 0..=STEPS {
        let strain = largest * step as f64 / STEPS as f64;
        match state(probe, axis, strain) {
            State::Stable => stable = strain,
            lost => return refine(probe, axis, stable, strain, lost),
        }
    }
    Bound::Beyond { strain: largest }
}

fn refine(probe: &Probe<'_>, axis: usize, mut stable: f64, mut lost: f64, state_there: State) -> Bound {
    let mut found = state_there;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (stable + lost);
        match state(probe, axis, middle) {
            State::Stable => stable = middle,
            other => (lost, found) = (middle, other),
        }
    }
    match found {
        State::Refused(error) => Bound::Inadmissible { strain: lost, error },
        State::Lost(mode) => Bound::Unstable { strain: lost, mode },
        State::Stable => Bound::Beyond { strain: lost },
    }
}

fn state(probe: &Probe<'_>, axis: usize, size: f64) -> State {
    let mut components = [0.0; 6];
    components[axis] = size;
    let response = match probe.respond(&probe.strain(components), Request::Tangent) {
        Ok(response) => response,
        Err(error) => return State::Refused(error),
    };
    match lost_mode(&probe.tangent(&response)) {
        Some(mode) => State::Lost(mode.into()),
        None => State::Stable,
    }
}

/// The direction in which a tangent is not positive definite; `None` where it is.
///
/// Judged with its diagonal scaled to one: near a pole of the law entries differ by more digits than there are, and the sign of the
/// smallest eigenvalue of the plain matrix is rounding.
fn lost_mode(tangent: &Matrix6<f64>) -> Option<Vector6<f64>> {
    if let Some(axis) = (0..6).find(|&i| tangent[(i, i)] <= 0.0) {
        return Some(Vector6::ith(axis, 1.0));
    }
    let scale = tangent.diagonal().map(|k| k.sqrt().recip());
    let eigen = SymmetricEigen::new(tangent.component_mul(&(scale * scale.transpose())));
    let smallest = eigen.eigenvalues.imin();
    if eigen.eigenvalues[smallest] > -ROUNDING {
        return None;
    }
    let mode = eigen.eigenvectors.column(smallest).component_mul(&scale).normalize();
    Some(mode * mode[mode.iamax()].signum())
}
