use crate::body::{Constraint, Elastic};
use crate::error::Result;
use crate::lie::{Strain, Wrench};
use crate::material::{Reference, Request, Response, Station};
use crate::section::CrossSection;
use crate::solve::describe::strain_correction;

/// What a rung has for a section.
pub(super) enum SectionModel<'a> {
    /// Ψ(0) + K(0) Δξ of the scene's own.
    Linear,
    Other(&'a dyn CrossSection),
    Own,
}

/// The body of a rung: that of the scene with another section, and fewer strains.
pub(super) struct Model<'a> {
    pub(super) body: &'a dyn Elastic,
    pub(super) section: &'a SectionModel<'a>,
    pub(super) constraint: Constraint,
}

impl Elastic for Model<'_> {
    fn length(&self) -> f64 {
        self.body.length()
    }

    fn reference(&self, s: f64) -> Reference {
        self.body.reference(s)
    }

    fn respond(&self, s: f64, strain: &Strain, request: Request) -> Result<Response> {
        match self.section {
            SectionModel::Own => self.body.respond(s, strain, request),
            SectionModel::Other(section) => {
                section.respond(&Station { s, reference: self.body.reference(s) }, strain, request)
            }
            SectionModel::Linear => {
                let mut at_rest = self.body.respond(s, &Strain::zero(), Request::Tangent)?;
                at_rest.wrench += Wrench::from_vector(&(at_rest.tangent * strain.to_vector()));
                Ok(at_rest)
            }
        }
    }

    fn constraint(&self) -> Constraint {
        self.constraint
    }
}

impl Model<'_> {
    /// The strain with which the section carries a wrench, from the strain of another; `None` where none is found.
    pub(super) fn strain_of(&self, s: f64, wrench: &Wrench, near: &Strain) -> Option<Strain> {
        /// Relative to the strain: the estimate has no more digits.
        const ENOUGH: f64 = 1e-6;
        let length = self.length();
        let size = |x: &Strain| x.linear.norm() + x.angular.norm() * length;
        let fixed = self.constraint.fixed();
        let free = near.to_array();
        let mut strain = Strain::from_array(std::array::from_fn(|i| if fixed[i] { 0.0 } else { free[i] }));
        for _ in 0..30 {
            let full = strain_correction(self, s, wrench, &strain)?;
            let (mut step, mut shortened) = (full, 0);
            // a strain that the law does not admit is too far
            while self.respond(s, &(strain + step), Request::Energy).is_err() {
                if shortened == 8 {
                    return None;
                }
                (step, shortened) = (step * 0.5, shortened + 1);
            }
            strain += step;
            if shortened == 0 && size(&step) <= ENOUGH * size(&strain) {
                return Some(strain);
            }
        }
        None
    }
}
