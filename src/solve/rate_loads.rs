//! Loads that depend on the strain twist and its rate, at the stages of the elements of a mesh.

use nalgebra::Matrix6;

use super::mesh::Mesh;
use crate::body::Elastic;
use crate::error::Result;
use crate::lie::{Pose, Strain, Twist, Wrench};
use crate::load::LoadWrench;
use crate::rod::SectionState;
use crate::rod::element::Kinematics;

/// Half the distance of two states whose difference is taken, in units of one, 1/L or L: ε^⅓, of which rounding and the third derivative make about ε^⅔ each.
const STEP: f64 = 6e-6;

impl<B: Elastic, const S: usize> Mesh<'_, B, S> {
    /// Adds these loads of element i to the others, and their derivatives in the displacement of the stages; those in the strains go apart.
    pub(super) fn rate_loads(
        &self,
        i: usize,
        strains: &[Strain; S],
        node: &Pose,
        motion: &Kinematics<f64, S>,
        (loads, by_strain): (&mut [LoadWrench; S], &mut [Matrix6<f64>; S]),
    ) -> Result<()> {
        let length = self.rod.body().length();
        for k in 0..S {
            let (s, pose, strain) = (self.stage_s(i, k), *node * motion.stage[k], strains[k]);
            let at = |pose: Pose, strain: Strain| {
                let state = SectionState { s, pose, strain, motion: None };
                self.rod.rate_wrench(&state, self.load_factor)
            };
            let slope = |plus: Wrench, minus: Wrench, step: f64| (plus - minus).to_vector() / (2.0 * step);
            for j in 0..6 {
                let mut unit = [0.0; 6];
                // displacements of the frame
                let step = if j < 3 { STEP } else { STEP * length };
                unit[j] = step;
                let (there, back) =
                    (Twist::from_array(unit).exp(), Twist::from_array(unit.map(|v| -v)).exp());
                let column = slope(at(pose * there, strain)?, at(pose * back, strain)?, step);
                let mut tangent = loads[k].tangent.column_mut(j);
                tangent += column;
                let step = if j < 3 { STEP / length } else { STEP };
                unit[j] = step;
                let change = Strain::from_array(unit);
                let column = slope(at(pose, strain + change)?, at(pose, strain - change)?, step);
                by_strain[k].set_column(j, &column);
            }
            loads[k].wrench += at(pose, strain)?;
            loads[k].potential = None;
            loads[k].check("load by the rate of the strain", s)?;
        }
        Ok(())
    }
}
