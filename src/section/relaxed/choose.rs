use std::fmt;

use super::{Relaxed, Warping};
use crate::error::{Error, Result, positive};
use crate::lie::Strain;
use crate::material::{Local, Request};
use crate::section::degree::StrainRange;
use crate::section::geometry::AreaMoments;
use crate::section::shape::Shape;

/// What climbing the ladder of [`Warping`] found: which rung meets a tolerance over a range of strains.
#[derive(Clone, Debug, PartialEq)]
pub struct LadderReport {
    /// The lowest rung within the tolerance of the highest that was looked at; the highest, where none is.
    pub chosen: Warping,
    /// Whether the last rungs agreed within the tolerance, and every strain could be reached.
    pub reached: bool,
    /// Largest change of Ψ between the chosen rung and the highest that was looked at, relative to the largest entry of Ψ.
    pub estimated_error: f64,
    /// The rungs in the order they were climbed.
    pub steps: Vec<LadderStep>,
    /// A²/2π(I_x + I_y), 1 for a disk: below [`LadderReport::THIN`] a section that is no round tube is thin-walled or slender.
    pub compactness: f64,
    /// Whether the section is one that polynomials serve poorly because it is thin-walled or slender.
    pub thin: bool,
}

/// One rung of a [`LadderReport`].
#[derive(Clone, Debug, PartialEq)]
pub struct LadderStep {
    /// The rung.
    pub warping: Warping,
    /// How many modes it has.
    pub modes: usize,
    /// Largest difference of Ψ from the highest rung looked at, over the sample strains, relative to the largest entry of Ψ.
    pub difference: f64,
    /// The first sample strain that could not be reached, and why.
    pub failed: Option<(Strain, Error)>,
}

impl LadderReport {
    /// The compactness below which a section counts as thin: a rectangle of 5:1 has 0.36, of 10:1 0.19.
    pub const THIN: f64 = 0.35;
}

impl fmt::Display for LadderReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.reached { "within" } else { "NOT within" };
        writeln!(
            f,
            "{}: {verdict} the tolerance, estimated error {:.1e}",
            self.chosen, self.estimated_error
        )?;
        for step in &self.steps {
            write!(f, "  {:<28}{:>4} modes{:>12.1e}", step.warping.to_string(), step.modes, step.difference)?;
            match &step.failed {
                Some((_, error)) => writeln!(f, "  {error}")?,
                None => writeln!(f)?,
            }
        }
        if !self.reached {
            writeln!(
                f,
                "  the last rungs still differ: polynomials converge slowly where a section has re-entrant corners or is thin"
            )?;
        }
        if self.thin {
            writeln!(
                f,
                "  the section is thin or slender (compactness {:.2}): its torsion wants a mesh of the section",
                self.compactness
            )?;
        }
        Ok(())
    }
}

/// Ψ for every sample, as six numbers of the unit of a force, or why not.
type Answers = Vec<Result<[f64; 6]>>;

impl<S: Shape, M: Local> Relaxed<S, M> {
    /// The lowest rung of the ladder whose Ψ is within a tolerance for strains up to the limits of a range, and a report.
    ///
    /// It climbs until two rungs that both warp agree within the tolerance, and takes the lowest that agrees with the last. Where none
    /// does it takes the last, and says so.
    ///
    /// ```
    /// use hyperrod::material::NeoHookean;
    /// use hyperrod::section::{Circle, Relaxed, StrainRange, Warping};
    /// # fn main() -> hyperrod::Result<()> {
    /// let rubber = NeoHookean::from_young(1e6, 0.3)?;
    /// let range = StrainRange { axial: 0.05, shear: 0.05, ..Default::default() };
    /// let (arm, report) = Relaxed::new(Circle::new(0.01), rubber)?.choose(1e-2, &range)?;
    /// assert!(report.reached && arm.warping() == Warping::SHEAR, "{report}");
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// If the tolerance or the range is not positive and finite; as [`with_warping`](Self::with_warping).
    pub fn choose(mut self, tolerance: f64, range: &StrainRange) -> Result<(Self, LadderReport)> {
        positive("tolerance of a ladder", tolerance)?;
        range.check()?;
        let points = self.modes(range.at.s)?.into_owned().points;
        let radius = points.x.iter().zip(&points.y).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
        let moments = AreaMoments::of(&points).about_centroid();
        let compactness = moments.area.powi(2) / (std::f64::consts::TAU * moments.polar());
        let samples = range.samples(radius);
        let mut climbed: Vec<(Warping, usize, Answers)> = Vec::new();
        let mut reached = false;
        for warping in Warping::LADDER {
            self = self.with_warping(warping)?;
            let answer = |strain: &Strain| {
                let wrench = self.respond_from(None, &range.at, strain, Request::Wrench)?.0.wrench.to_array();
                Ok(std::array::from_fn(|i| if i < 3 { wrench[i] / radius } else { wrench[i] }))
            };
            let answers: Answers = samples.iter().map(answer).collect();
            let warped_before = climbed.last().is_some_and(|(before, ..)| before.axial > 1);
            let change = climbed.last().map_or(f64::INFINITY, |(_, _, before)| difference(before, &answers));
            climbed.push((warping, self.modes(range.at.s)?.len(), answers));
            if warped_before && change <= tolerance {
                reached = true;
                break;
            }
        }
        let steps: Vec<LadderStep> = steps(&climbed, &samples);
        let enough = steps.iter().find(|step| reached && step.difference <= tolerance);
        let chosen = enough.or(steps.last()).map_or(Warping::FULL, |step| step.warping);
        let estimated_error = estimate(&steps, chosen);
        let thin = compactness < LadderReport::THIN && !self.shape.is_ring();
        let report = LadderReport { chosen, reached, estimated_error, steps, compactness, thin };
        Ok((self.with_warping(chosen)?, report))
    }
}

fn steps(climbed: &[(Warping, usize, Answers)], samples: &[Strain]) -> Vec<LadderStep> {
    let Some((.., highest)) = climbed.last() else { return Vec::new() };
    let step = |(warping, modes, answers): &(Warping, usize, Answers)| LadderStep {
        warping: *warping,
        modes: *modes,
        difference: difference(answers, highest),
        failed: samples.iter().zip(answers).find_map(|(s, a)| Some((*s, a.as_ref().err()?.clone()))),
    };
    climbed.iter().map(step).collect()
}

/// The difference of the chosen rung from the highest; of the last but one, if it is the highest itself.
fn estimate(steps: &[LadderStep], chosen: Warping) -> f64 {
    let last = steps.last().is_some_and(|step| step.warping == chosen);
    let place = steps.iter().position(|step| step.warping == chosen).unwrap_or(0);
    let place = if last { place.saturating_sub(1) } else { place };
    steps.get(place).map_or(f64::INFINITY, |step| step.difference)
}

/// The largest difference over the samples, relative to the largest entry; infinite where one has no answer.
fn difference(one: &Answers, other: &Answers) -> f64 {
    one.iter().zip(other).fold(0.0, |worst, pair| {
        let (Ok(a), Ok(b)) = pair else { return f64::INFINITY };
        let size = b.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let error = a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        if size > 0.0 { f64::max(worst, error / size) } else { worst }
    })
}
