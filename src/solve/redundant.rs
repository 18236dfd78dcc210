//! What supports hold that fixed strains hold already.

use nalgebra::Vector6;

use super::equilibrium::Configuration;
use super::mesh::Mesh;
use crate::body::Elastic;
use crate::error::{Error, Result};
use crate::lie::{Pose, Strain, Twist, Wrench};
use crate::load::LoadWrench;
use crate::rod::support::Condition;
use crate::rod::{Rod, Support};

/// Pieces of every part of the rod between two supports whose strains are moved.
const PIECES: usize = 12;

/// A row of length one is none of its own if no more than this is left when those before it are taken out.
const NOTHING: f64 = 1e-9;

/// The freedoms that the supports hold to no effect, since the strains that are free do not move them: they are let go, so that their reactions,
/// which nothing tells from those inside the rod, are zero. None at the base, which comes first.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Redundant {
    tip: [bool; 6],
    joints: Vec<[bool; 6]>,
}

impl Redundant {
    /// Of a rod that starts at `base`; `None` where there are none.
    ///
    /// δχ of what is held is linear in the displacement of the base and in the strains that are free, by ζ_P = Ad(g_P⁻¹ g) δξ ds. A row that depends on
    /// those before it, on a rod that is bent and twisted as far as it can be, is redundant.
    pub(super) fn of<B: Elastic>(rod: &Rod<B>, base: &Pose) -> Option<Self> {
        if rod.body().constraint().is_none() {
            return None;
        }
        let (mut shape, mut known) = (Shape::begin(rod, base), Vec::new());
        shape.held(&rod.base_fixture().support, &mut known);
        let joints = rod.joints().iter().map(|joint| {
            shape.go_to(joint.s);
            let held = shape.held(&joint.fixture.support, &mut known);
            shape.pose = shape.pose * joint.corner;
            held
        });
        let joints: Vec<_> = joints.collect();
        shape.go_to(rod.body().length());
        let tip = shape.held(&rod.tip_fixture().support, &mut known);
        let any = joints.iter().chain([&tip]).flatten().any(|redundant| *redundant);
        any.then_some(Self { tip, joints })
    }

    /// The support of the tip with what it has to hold.
    pub(super) fn at_tip(&self, support: &Support) -> Support {
        without(support, &self.tip)
    }

    /// The support of a joint with what it has to hold.
    pub(super) fn at_joint(&self, j: usize, support: &Support) -> Support {
        without(support, &self.joints[j])
    }

    /// Refuses supports that hold something where a solved rod, that cannot be elsewhere, has it not.
    pub(super) fn check<B: Elastic, const S: usize>(
        &self,
        mesh: &Mesh<'_, B, S>,
        state: &Configuration<S>,
        tolerance: f64,
    ) -> Result<()> {
        let length = mesh.rod.body().length();
        let of_joints = mesh.rod.joints().iter().zip(&state.joints).zip(&self.joints);
        for ((joint, at), redundant) in of_joints {
            agrees(&joint.fixture.support, redundant, &at.pose, joint.s, [tolerance, tolerance * length])?;
        }
        let (tip, pose) = (&mesh.rod.tip_fixture().support, &state.node_pose[mesh.elements()]);
        agrees(tip, &self.tip, pose, length, [tolerance, tolerance * length])
    }
}

fn without(support: &Support, redundant: &[bool; 6]) -> Support {
    support.releasing(crate::rod::Freedom::ALL.into_iter().filter(|freedom| redundant[*freedom as usize]))
}

fn agrees(
    support: &Support,
    redundant: &[bool; 6],
    pose: &Pose,
    s: f64,
    [turn, place]: [f64; 2],
) -> Result<()> {
    const NAMES: [&str; 6] = ["rotation about x", "rotation about y", "rotation about z", "x", "y", "z"];
    let (is, held) = (support.coordinates(pose), support.held());
    for j in (0..6).filter(|j| redundant[*j]) {
        if !((is[j] - held[j]).abs() <= if j < 3 { turn } else { place }) {
            return Err(Error::OverDetermined { freedom: NAMES[j], s, held: held[j], found: is[j] });
        }
    }
    Ok(())
}

/// A shape of the rod, from its base on, and how what was passed moves it: columns of ζ on a section, in units (rad, length), as they are at the base.
struct Shape<'r, B> {
    rod: &'r Rod<B>,
    s: f64,
    pose: Pose,
    /// Displacements of all that follows.
    motions: Vec<Twist>,
}

impl<'r, B: Elastic> Shape<'r, B> {
    fn begin(rod: &'r Rod<B>, base: &Pose) -> Self {
        let mut shape = Self { rod, s: 0.0, pose: *base, motions: Vec::new() };
        shape.move_by([true; 6]);
        shape
    }

    /// Lets a section here move against the one before.
    fn move_by(&mut self, free: [bool; 6]) {
        let (length, out) = (self.rod.body().length(), self.pose.adjoint());
        for j in (0..6).filter(|j| free[*j]) {
            let mut unit = [0.0; 6];
            unit[j] = if j < 3 { 1.0 } else { length };
            self.motions.push(out.apply(&Twist::from_array(unit)));
        }
    }

    fn go_to(&mut self, s: f64) {
        let (body, from) = (self.rod.body(), self.s);
        let (constraint, length, h) = (body.constraint(), body.length(), (s - from) / PIECES as f64);
        for piece in 0..PIECES {
            let middle = from + (piece as f64 + 0.5) * h;
            let xi = body.reference(middle).twist + constraint.free_part(somehow(middle / length, length));
            let half = (xi * (0.5 * h)).exp();
            self.pose = self.pose * half;
            self.move_by(constraint.fixed().map(|fixed| !fixed));
            self.pose = self.pose * half;
        }
        self.s = s;
    }

    /// Which freedoms are held by the support of this section and by `known` rows too; the others become known, those first of which
    /// most is left.
    fn held(&self, support: &Support, known: &mut Vec<Vec<f64>>) -> [bool; 6] {
        let mut rows = self.rows(support);
        known.iter().for_each(|other| rows.iter_mut().for_each(|(_, row)| take_out(row, other)));
        let mut redundant = support.conditions().map(|condition| matches!(condition, Condition::Fixed(_)));
        let left = |(_, row): &(usize, Vec<f64>)| norm(row);
        while let Some(most) = (0..rows.len()).max_by(|a, b| left(&rows[*a]).total_cmp(&left(&rows[*b]))) {
            let (j, mut row) = rows.swap_remove(most);
            let size = norm(&row);
            if !(size > NOTHING) {
                break;
            }
            redundant[j] = false;
            // a second time, for what rounding left
            known.iter().for_each(|other| take_out(&mut row, other));
            let size = norm(&row);
            row.iter_mut().for_each(|v| *v /= size);
            rows.iter_mut().for_each(|(_, other)| take_out(other, &row));
            known.push(row);
        }
        redundant
    }

    /// What is held by the support of this section: which freedom, and how it changes with every motion, in units of the largest change.
    fn rows(&self, support: &Support) -> Vec<(usize, Vec<f64>)> {
        let every = Support::clamped(*support.frame());
        let of_zeta = every.linearised(&self.pose, &Wrench::zero(), &LoadWrench::none(), &[0.0; 6]).from_zeta;
        let inverse = self.pose.adjoint_inverse();
        let here: Vec<Vector6<f64>> = self.motions.iter().map(|z| inverse.apply(z).to_vector()).collect();
        let held = (0..6).filter(|j| matches!(support.conditions()[*j], Condition::Fixed(_)));
        let row = |j: usize| {
            let row: Vec<f64> = here.iter().map(|zeta| (of_zeta.row(j) * zeta)[0]).collect();
            let size = norm(&row).max(f64::MIN_POSITIVE);
            (j, row.into_iter().map(|v| v / size).collect())
        };
        held.map(row).collect()
    }
}

/// Strains without any symmetry, of some tenths: angular ones in units of 1/L.
fn somehow(place: f64, length: f64) -> Strain {
    let wave = |j: f64| 0.4 * (0.7 + 1.3 * j + (2.1 + j) * place).sin();
    let (bend, stretch) = (1.0 / length, 0.25);
    let sizes = [bend, bend, bend, stretch, stretch, stretch];
    Strain::from_array(std::array::from_fn(|j| sizes[j] * wave(j as f64)))
}

fn norm(row: &[f64]) -> f64 {
    row.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Takes out of a row its part along a unit one, known from the first motions on.
fn take_out(row: &mut [f64], unit: &[f64]) {
    let part: f64 = row.iter().zip(unit).map(|(a, b)| a * b).sum();
    row.iter_mut().zip(unit).for_each(|(a, b)| *a -= part * b);
}
