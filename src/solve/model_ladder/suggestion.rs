use std::fmt;

use crate::body::Constraint;

/// How far a simpler model is from the scene as it is, estimated: the largest over the nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModelError {
    /// Displacement of the axis, m; infinite where the simpler section cannot carry the wrench of the answer.
    pub position: f64,
    /// Rotation of a section, rad.
    pub rotation: f64,
    /// Arc length where the displacement is largest, m.
    pub s: f64,
}

impl ModelError {
    pub(super) fn unknown(s: f64) -> Self {
        Self { position: f64::INFINITY, rotation: f64::INFINITY, s }
    }

    /// The larger of position / L and rotation, which is what a tolerance bounds.
    pub fn size(&self, length: f64) -> f64 {
        (self.position / length).max(self.rotation)
    }
}

/// The strain whose work Ψ·Δξ a rung changes most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOut {
    /// Index of the strain: ω_x, ω_y, ω_z, ν_x, ν_y, ν_z.
    pub strain: usize,
    /// The work that the rung misses in it, of all the work ∫Ψ·Δξ ds; negative where it has too much.
    pub share: f64,
}

impl LeftOut {
    /// Below this share nothing is left out but rounding.
    const NOTHING: f64 = 1e-14;

    pub(super) fn of(work: &[f64; 6], total: f64) -> Option<Self> {
        let largest = |best: usize, i: usize| if work[i].abs() > work[best].abs() { i } else { best };
        let strain = (1..6).fold(0, largest);
        let share = work[strain] / total;
        (share.abs() > Self::NOTHING).then_some(Self { strain, share })
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const NAMES: [&str; 6] =
            ["bending about x", "bending about y", "torsion", "shear along x", "shear along y", "stretch"];
        let verb = if self.share > 0.0 { "misses" } else { "has too much:" };
        write!(f, "{verb} {:.1e} of the work, in {}", self.share.abs(), NAMES[self.strain])
    }
}

/// A model simpler than the scene, or as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelRung {
    /// `linear law`, the name given to a section, or `own section`.
    pub section: String,
    /// Which strains it has, in words.
    pub strains: &'static str,
    /// The same as a constraint of the body, those of the scene included.
    pub constraint: Constraint,
    /// Free strains: unknowns a stage.
    pub unknowns: usize,
    /// Its estimated modelling error.
    pub error: ModelError,
    /// What it leaves out, if anything.
    pub left_out: Option<LeftOut>,
}

/// The rungs of a scene with their estimated modelling errors, cheapest first, and the first that is good enough.
///
/// As text it is a table, the rung chosen marked by an arrow.
#[derive(Clone, Debug, PartialEq)]
pub struct Suggestion {
    rungs: Vec<ModelRung>,
    tolerance: f64,
    length: f64,
    mesh_error: f64,
}

impl Suggestion {
    pub(super) fn new(rungs: Vec<ModelRung>, tolerance: f64, length: f64, mesh_error: f64) -> Self {
        Self { rungs, tolerance, length, mesh_error }
    }

    /// The cheapest rung whose estimated error is below the tolerance. The scene as it is always is one.
    pub fn chosen(&self) -> &ModelRung {
        self.cheapest(self.tolerance)
    }

    /// The same for another tolerance, not below the one that was asked for: the mesh was not made for that.
    pub fn cheapest(&self, tolerance: f64) -> &ModelRung {
        &self.rungs[self.place(tolerance)]
    }

    fn place(&self, tolerance: f64) -> usize {
        let good = |rung: &ModelRung| rung.error.size(self.length) <= tolerance;
        // the scene as it is comes last, without an error
        self.rungs.iter().position(good).unwrap_or(self.rungs.len().saturating_sub(1))
    }

    /// All rungs, cheapest first.
    pub fn rungs(&self) -> &[ModelRung] {
        &self.rungs
    }

    /// The tolerance asked for, of position / L and rotation.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The estimated error of the mesh that the scene was solved on, as [`ModelError::size`].
    pub fn mesh_error(&self) -> f64 {
        self.mesh_error
    }
}

impl fmt::Display for Suggestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "modelling error allowed: {:.1e} of the length, and in rad", self.tolerance)?;
        let chosen = self.place(self.tolerance);
        let width = self.rungs.iter().map(|rung| rung.section.chars().count()).max().unwrap_or(0);
        for (i, rung) in self.rungs.iter().enumerate() {
            let (mark, error) = (if i == chosen { "→" } else { " " }, rung.error.size(self.length));
            let error = if error.is_finite() { format!("{error:.1e}") } else { "none found".into() };
            write!(
                f,
                "{mark} {:<width$}  {:<20}  {} {error:>11}  ",
                rung.section, rung.strains, rung.unknowns
            )?;
            match (&rung.left_out, rung.error.size(self.length).is_finite()) {
                (Some(left_out), _) => writeln!(f, "{left_out}")?,
                (None, true) => writeln!(f, "leaves nothing out")?,
                (None, false) => writeln!(f, "cannot carry the wrench at s = {:.3e} m", rung.error.s)?,
            }
        }
        Ok(())
    }
}
