//! From the energy of an actuator to its share of the response.

use super::Actuator;
use crate::error::{Error, Result};
use crate::lie::{Strain, Twist, Wrench};
use crate::material::{Active, Request, Response, Station};
use crate::scalar::Jet;

/// An [`Actuator`] in `f64`, which can be made into an object.
pub(super) trait Actuation: Send + Sync {
    fn respond(&self, at: &Station, strain: &Strain, request: Request) -> Result<Response> {
        self.respond_active(at, strain, Active::all(), request)
    }

    /// What is said about strains that are not active is not to be relied on.
    fn respond_active(
        &self,
        at: &Station,
        strain: &Strain,
        active: Active,
        request: Request,
    ) -> Result<Response>;
    fn breakpoints(&self) -> Vec<f64>;
}

impl<A: Actuator> Actuation for A {
    fn respond_active(
        &self,
        at: &Station,
        strain: &Strain,
        active: Active,
        request: Request,
    ) -> Result<Response> {
        crate::material::check_strain(strain, at.s)?;
        let response = match request {
            Request::Energy => {
                let energy = self.energy(&(at.reference.twist + *strain), at.s);
                Response { energy, ..Response::zero() }
            }
            Request::Wrench => differentiate::<6, 0, _>(self, at, strain),
            Request::Tangent if active.count() <= 3 => differentiate_in_three(self, at, strain, active),
            Request::Tangent => differentiate::<6, 21, _>(self, at, strain),
            Request::Rate => differentiate::<7, 28, _>(self, at, strain),
        };
        if response.is_finite() {
            return Ok(response);
        }
        let (quantity, value) = match response.energy.is_finite() {
            false => ("energy per length of an actuator", response.energy),
            true => ("wrench or tangent of an actuator", f64::NAN),
        };
        Err(Error::InvalidAt { quantity, value, requirement: self.domain(), s: at.s })
    }

    fn breakpoints(&self) -> Vec<f64> {
        Actuator::breakpoints(self)
    }
}

/// Value, gradient and Hessian in Δξ. With N = 7 the last variable is s, on which ξ = ξ*(s) + Δξ depends as well; only the mixed derivatives are
/// read, for which ξ*′ is enough.
fn differentiate<const N: usize, const M: usize, A: Actuator>(
    actuator: &A,
    at: &Station,
    strain: &Strain,
) -> Response {
    let (xi, rate) = ((at.reference.twist + *strain).to_array(), at.reference.rate.to_array());
    let xi: [Jet<f64, N, M>; 6] = std::array::from_fn(|i| {
        let variable = Jet::variable(xi[i], i);
        if N == 7 { variable.with_slope(6, rate[i]) } else { variable }
    });
    let s = if N == 7 { Jet::variable(at.s, 6) } else { Jet::constant(at.s) };
    let u = actuator.energy(&Twist::from_array(xi), s);
    let mut response = Response {
        energy: u.value,
        wrench: Wrench::from_array(std::array::from_fn(|i| u.gradient[i])),
        ..Response::zero()
    };
    let mut rate = [0.0; 6];
    // the upper triangle by rows
    let mut entries = u.hessian.iter();
    for i in 0..N {
        for (j, &value) in (i..N).zip(&mut entries) {
            if j < 6 {
                response.tangent[(i, j)] = value;
                response.tangent[(j, i)] = value;
            } else if i < 6 {
                rate[i] = value;
            }
        }
    }
    response.wrench_rate = Wrench::from_array(rate);
    response
}

/// Value, gradient and Hessian in no more than three components of Δξ.
fn differentiate_in_three<A: Actuator>(
    actuator: &A,
    at: &Station,
    strain: &Strain,
    active: Active,
) -> Response {
    let mut xi = (at.reference.twist + *strain).to_array().map(Jet::<f64, 3, 6>::constant);
    let places = || active.places().take(3);
    for (variable, i) in places().enumerate() {
        xi[i] = xi[i].with_slope(variable, 1.0);
    }
    let u = actuator.energy(&Twist::from_array(xi), Jet::constant(at.s));
    let (mut response, mut wrench) = (Response { energy: u.value, ..Response::zero() }, [0.0; 6]);
    for (r, i) in places().enumerate() {
        wrench[i] = u.gradient[r];
        for (c, j) in places().enumerate() {
            response.tangent[(i, j)] = u.hessian[[[0, 1, 2], [1, 3, 4], [2, 4, 5]][r][c]];
        }
    }
    response.wrench = Wrench::from_array(wrench);
    response
}
