//! Which model is enough: the richest one solved once, and how far every simpler one would be from it.

mod model;
mod solved;
mod suggestion;

use super::failure::Failure;
use crate::body::{Constraint, Elastic};
use crate::error::{Error, Result};
use crate::material::Station;
use crate::rod::Rod;
use crate::section::CrossSection;

use model::{AtRest, Model, SectionModel};
use solved::Solved;
pub use suggestion::{LeftOut, ModelError, ModelRung, Suggestion};

/// The cheapest model of a scene whose estimated modelling error is below a tolerance, and why; see [`ModelLadder`].
///
/// ```
/// use hyperrod::load::DeadWrench;
/// use hyperrod::section::Stiffness;
/// use hyperrod::solve::suggest;
/// use hyperrod::{Body, Pose, Rod};
/// use nalgebra::vector;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // a slender rod: EI = 1 N m², GA and EA of order 1e6 N, so that shear and stretch are of order 1e-6
/// let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e6, 1e6, 3e6])?)?;
/// let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(vector![3.0, 0.0, 0.0])?);
///
/// let suggestion = suggest(&rod, 1e-4)?;
/// let rung = suggestion.chosen();
/// assert_eq!((rung.strains, rung.unknowns), ("planar xz, Kirchhoff", 1));
/// assert!(rung.error.size(1.0) < 1e-5);
/// println!("{suggestion}"); // every rung with its error and what it leaves out
/// # Ok(()) }
/// ```
///
/// # Errors
/// As [`ModelLadder::suggest`].
pub fn suggest<B: Elastic>(rod: &Rod<B>, tolerance: f64) -> Result<Suggestion, Box<Failure>> {
    ModelLadder::of(rod).suggest(tolerance)
}

/// The simpler models of a scene: strains left out, the law made linear, and other sections.
///
/// The scene is solved once, as it is. A simpler section carries the wrench Ψ of that answer with another strain, Δξ + δ:
///
/// ```math
/// \Psi_\text{simple}(\Delta\xi + \delta) = \Psi(\Delta\xi), \qquad (\Delta\xi + \delta)_i = 0 \text{ for a strain } i \text{ left out}
/// ```
///
/// δ acts on the rod as a strain at rest would. One linear solve with the tangent of the answer, loads and supports
/// included, gives the displacements it makes at the nodes: the modelling error of the simpler model, to first order in δ. There is no
/// second nonlinear solve.
///
/// A rung is cheaper than another by its section first, then by its number of free strains: the linear law Ψ(0) + K(0) Δξ, then the sections
/// [given](Self::with_section) in their order, then the scene's own.
///
/// # Limits
/// First order in δ: an error of a tenth of the length is good to some tens of percent, one as large as the rod says "large" and no more. That a
/// simpler rod may be unstable, or find another answer, is not seen. Statics only.
///
/// Source: a model error by its residual in the linearised problem, as in Oden and Prudhomme (2002), J. Comput. Phys. 182, 496.
pub struct ModelLadder<'r, B> {
    rod: &'r Rod<B>,
    sections: Vec<(String, Box<dyn CrossSection>)>,
}

/// Which strains a rung leaves out, fewest free ones first.
const STRAINS: [(&str, Constraint); 8] = [
    ("planar xz, Kirchhoff", Constraint::fixing([true, false, true, true, true, true])),
    ("planar yz, Kirchhoff", Constraint::fixing([false, true, true, true, true, true])),
    ("planar xz", Constraint::planar()),
    ("planar yz", Constraint::fixing([false, true, true, true, false, false])),
    ("Kirchhoff", Constraint::kirchhoff()),
    ("unshearable", Constraint::unshearable()),
    ("inextensible", Constraint::inextensible()),
    ("all strains", Constraint::none()),
];

impl<'r, B: Elastic> ModelLadder<'r, B> {
    /// The rungs that follow from the scene itself: eight choices of strains, each with its own law and with that law made linear.
    pub fn of(rod: &'r Rod<B>) -> Self {
        Self { rod, sections: Vec::new() }
    }

    /// The same with rungs of another section, which is cheaper than the scene's own and dearer than those given before: a rigid one for a
    /// relaxed one, fewer functions of [`Warping`](crate::section::Warping), a law with fewer terms.
    ///
    /// ```
    /// use hyperrod::load::DeadWrench;
    /// use hyperrod::material::NeoHookean;
    /// use hyperrod::section::{Circle, Relaxed, Section, Warping};
    /// use hyperrod::solve::ModelLadder;
    /// use hyperrod::{Body, Pose, Rod};
    /// use nalgebra::vector;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let (circle, rubber) = (Circle::new(0.01), NeoHookean::from_young(1e6, 0.45)?);
    /// let section = Relaxed::new(circle.clone(), rubber)?.with_warping(Warping::ANTICLASTIC)?;
    /// let push = DeadWrench::force(vector![0.05, 0.0, 0.0])?; // N
    /// let rod = Rod::clamped(Body::new(0.3, section)?, Pose::identity()).with_tip_load(push);
    ///
    /// let ladder = ModelLadder::of(&rod).with_section("rigid", Section::new(circle, rubber)?)?;
    /// let suggestion = ladder.suggest(1e-2)?;
    /// let rigid = suggestion.rungs().iter().find(|r| r.section == "rigid" && r.strains == "all strains");
    /// assert!(rigid.is_some_and(|rung| rung.error.size(0.3) > 0.1)); // λ + 2μ is 3.8 E
    /// assert_eq!(suggestion.chosen().section, "linear law");
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`CrossSection::adapt_to`], which is called as [`Body`](crate::Body) does.
    pub fn with_section(mut self, name: &str, mut section: impl CrossSection + 'static) -> Result<Self> {
        const PLACES: usize = 16;
        let body = self.rod.body();
        for k in 0..=PLACES {
            let s = body.length() * k as f64 / PLACES as f64;
            section.adapt_to(&Station { s, reference: body.reference(s) })?;
        }
        self.sections.push((name.into(), Box::new(section)));
        Ok(self)
    }

    /// Solves the scene as it is, and estimates the modelling error of every rung.
    ///
    /// # Errors
    /// A [`Failure`] of that solve, or of its accuracy where the mesh cannot be made fine enough to see the tolerance;
    /// [`Reason::Options`](super::Reason::Options) for a tolerance that is not positive and finite.
    pub fn suggest(&self, tolerance: f64) -> Result<Suggestion, Box<Failure>> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            let (quantity, requirement) = ("tolerance of a model", "positive and finite");
            return Err(Failure::of_options(Error::Invalid { quantity, value: tolerance, requirement }));
        }
        let mut solved = Solved::to(self.rod, tolerance)?;
        let mut rungs = Vec::new();
        for (name, section) in self.section_models(solved.at_rest()?) {
            for (strains, constraint) in STRAINS {
                let constraint = constraint.and(self.rod.body().constraint());
                let own = matches!(section, SectionModel::Own);
                if rungs.iter().any(|r: &ModelRung| r.section == name && r.constraint == constraint) {
                    continue; // what the scene leaves out anyway
                }
                let model = Model { body: self.rod.body(), section: &section, constraint };
                let whole = own && constraint == self.rod.body().constraint();
                let (error, left_out) =
                    if whole { (ModelError::default(), None) } else { solved.error_of(&model) };
                let unknowns = constraint.fixed().iter().filter(|fixed| !**fixed).count();
                rungs.push(ModelRung {
                    section: name.clone(),
                    strains,
                    constraint,
                    unknowns,
                    error,
                    left_out,
                });
            }
        }
        Ok(Suggestion::new(rungs, tolerance, self.rod.body().length(), solved.mesh_error()))
    }

    /// Names and models of the sections, cheapest first.
    fn section_models(&self, at_rest: AtRest) -> Vec<(String, SectionModel<'_>)> {
        let mut models = vec![("linear law".to_string(), SectionModel::Linear(at_rest))];
        models.extend(self.sections.iter().map(|(name, s)| (name.clone(), SectionModel::Other(s.as_ref()))));
        models.push(("own section".to_string(), SectionModel::Own));
        models
    }
}
