use crate::body::{Constraint, Elastic};
use crate::error::Result;
use crate::lie::{Strain, Wrench};
use crate::material::{Reference, Request, Response, Station};
use crate::section::CrossSection;
use crate::solve::describe::strain_correction;

/// What a rung has for a section.
pub(super) enum SectionModel<'a> {
    /// Ψ(0) + K(0) Δξ of the scene's own.
    Linear(AtRest),
    Other(&'a dyn CrossSection),
    Own,
}

/// What a body answers to Δξ = 0 at some places.
pub(super) struct AtRest {
    places: Vec<f64>,
    responses: Vec<Response>,
}

impl AtRest {
    pub(super) fn of(body: &dyn Elastic, places: Vec<f64>) -> Result<Self> {
        let rest = |s: &f64| body.respond(*s, &Strain::zero(), Request::Tangent);
        let responses: Result<Vec<_>> = places.iter().map(rest).collect();
        Ok(Self { responses: responses?, places })
    }

    /// Ψ(0) + K(0) Δξ with its tangent, at the place next to s.
    fn linear(&self, s: f64, strain: &Strain) -> Response {
        let next = self.places.partition_point(|place| *place < s).min(self.responses.len() - 1);
        let mut response = self.responses[next];
        response.wrench += Wrench::from_vector(&(response.tangent * strain.to_vector()));
        response
    }
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
            SectionModel::Linear(at_rest) => Ok(at_rest.linear(s, strain)),
        }
    }

    fn constraint(&self) -> Constraint {
        self.constraint
    }
}

impl Model<'_> {
    /// The strain with which the section carries a wrench, from the strain of another; `None` where none is found.
    pub(super) fn strain_of(&self, s: f64, wrench: &Wrench, near: &Strain) -> Option<Strain> {
        /// Of a step, relative to the strain: what it leaves is of the size of its square, and the estimate has fewer digits.
        const ENOUGH: f64 = 1e-5;
        const ITERATIONS: usize = 30;
        let size = |x: &Strain| x.linear.norm() + x.angular.norm() * self.length();
        let (fixed, free) = (self.constraint.fixed(), near.to_array());
        let start = std::array::from_fn(|i| if fixed[i] { 0.0 } else { free[i] });
        let mut strain = Strain::from_array(start);
        let mut step = strain_correction(self, s, wrench, &strain)?;
        for _ in 0..ITERATIONS {
            let moved = strain + step;
            if size(&step) <= ENOUGH * size(&moved) {
                return Some(moved);
            }
            // a strain that the law does not admit is too far
            match strain_correction(self, s, wrench, &moved) {
                Some(next) => (strain, step) = (moved, next),
                None => step = step * 0.5,
            }
        }
        None
    }
}
