//! How many ways a rod can fall: the index of an equilibrium, the number of independent displacements that lower its energy to second order.
//!
//! At an equilibrium the second variation of the energy has the Hamiltonian form: with the displacement ζ and the momentum
//! μ = δΛ − ½ L(Λ) ζ (the change of the wrench seen from half way, which makes ζ and μ conjugate on SE(3)),
//!
//! ```math
//! (\zeta, \mu)_{i+1} = T_i (\zeta, \mu)_i, \qquad T^{\mathsf T} J T = J
//! ```
//!
//! along the chain of condensed elements, and a Lagrangian plane μ = P ζ of what the part before a node answers is carried from the base to the tip. Joining an
//! element to that part frees a node: the negative directions of P + (element held at its far end) are new unstable modes, and those of
//! P + (tip) the last ones. Counting eigenvalues of symmetric 6×6 pivots finds double zeros, which signs of determinants miss (a round
//! straight rod has nothing else). It is the count of Wittrick and Williams (1971), *Q. J. Mech. Appl. Math.* 24, and of conjugate points
//! (Manning, Rogers and Maddocks 1998, *Proc. R. Soc. A* 454).
//!
//! **How exact.** The tangent of the collocation balance is symmetric to the order of the element, not to rounding; pivots are symmetrised. The critical
//! load of the chain therefore converges with the order of the element, as poses do. An element must be short enough to be stable by itself
//! when both its ends are held; [`Verdict::Unresolved`] says where it is not.

mod assess;
mod condition;
mod eigen;
mod index;
mod link;
mod mode;
mod pivot;
mod plane;
mod quick;

pub(crate) use assess::chain;
pub(crate) use index::{Chain, Verdict};

#[cfg(test)]
mod tests;
