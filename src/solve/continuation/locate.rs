//! Where between two points of a path a number vanishes or the index changes.

use super::correct::{Corrector, Place};
use super::family::Family;

/// Numbers looked at to find a zero.
const TRIALS: usize = 60;

/// A bracket this small, of the length of the step, is a point.
const POINT: f64 = 1e-13;

/// Bisections by the index before a margin is tried.
const BISECTIONS: usize = 4;

/// A place and how far along the tangent it was found.
pub(super) type Found<F> = (Place<F>, f64);

/// The zero of `number` between two of its values of different sign, by the Illinois rule (Dowell and Jarratt 1971, *BIT* 11), with bisection
/// every sixth time against a number that bends strongly. `None` where a number is missing.
pub(crate) fn illinois(
    ends: [(f64, f64); 2],
    close: f64,
    mut number: impl FnMut(f64) -> Option<f64>,
) -> Option<f64> {
    let [mut a, mut b] = ends;
    let length = (b.0 - a.0).abs();
    let mut best = if a.1.abs() < b.1.abs() { a } else { b };
    let mut kept = 0_i32;
    for trial in 0..TRIALS {
        let middle = 0.5 * (a.0 + b.0);
        let secant = (a.0 * b.1 - b.0 * a.1) / (b.1 - a.1);
        let s = if trial % 6 == 5 || !secant.is_finite() { middle } else { secant };
        let value = number(s)?;
        if value.abs() < best.1.abs() {
            best = (s, value);
        }
        if value.abs() <= close || (b.0 - a.0).abs() <= POINT * length {
            break;
        }
        let (same, other, side) =
            if (value > 0.0) == (a.1 > 0.0) { (&mut a, &mut b, 1) } else { (&mut b, &mut a, -1) };
        *same = (s, value);
        if kept * side > 0 {
            other.1 *= 0.5;
        }
        kept = side;
    }
    Some(best.0)
}

/// The place where `number` is zero; `ends` are its values at `from` and at `length` further on.
pub(super) fn zero<F: Family>(
    family: &mut F,
    corrector: &Corrector,
    from: &Place<F>,
    length: f64,
    ends: [f64; 2],
    close: f64,
    number: impl Fn(&Place<F>) -> f64,
) -> Option<Found<F>> {
    let s = illinois([(0.0, ends[0]), (length, ends[1])], close, |s| {
        corrector.step(family, from, s).ok().map(|(place, _)| number(&place))
    })?;
    Some((corrector.step(family, from, s).ok()?.0, s))
}

/// The place where the index stops being what it is at `from`: by bisection, then by the margin of the mode that changes.
pub(super) fn index_change<F: Family>(
    family: &mut F,
    corrector: &Corrector,
    from: &Place<F>,
    length: f64,
    indices: [usize; 2],
) -> Option<Found<F>> {
    let (mut a, mut b) = (0.0, length);
    // with growing index the first mode above those there are, with falling index the highest of them
    let mode = if indices[1] > indices[0] { indices[0] } else { indices[0].checked_sub(1)? };
    let mut last = None;
    for bisection in 0..TRIALS {
        let middle = 0.5 * (a + b);
        let Ok((place, _)) = corrector.step(family, from, middle) else { break };
        let Some(index) = family.index(&place.state, place.factor) else { break };
        last = Some((place, middle));
        if index == indices[0] {
            a = middle
        } else {
            b = middle
        }
        if bisection + 1 == BISECTIONS
            && let Some(found) = by_margin(family, corrector, from, [a, b], mode)
        {
            return Some(found);
        }
        if b - a <= POINT * length {
            break;
        }
    }
    last
}

fn by_margin<F: Family>(
    family: &mut F,
    corrector: &Corrector,
    from: &Place<F>,
    bracket: [f64; 2],
    mode: usize,
) -> Option<Found<F>> {
    let mut margin = |s: f64| {
        let (place, _) = corrector.step(family, from, s).ok()?;
        family.margin(&place.state, place.factor, mode)
    };
    let ends = [margin(bracket[0])?, margin(bracket[1])?];
    if ends[0] * ends[1] > 0.0 {
        return None;
    }
    let s = illinois([(bracket[0], ends[0]), (bracket[1], ends[1])], 0.0, margin)?;
    Some((corrector.step(family, from, s).ok()?.0, s))
}
