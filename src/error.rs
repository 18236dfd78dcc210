use thiserror::Error;

/// What can go wrong below the solver: which quantity, which value, where.
///
/// A solve that fails carries more (its history and the last good state): see [`solve::Failure`](crate::solve::Failure).
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// A number given by the user cannot be what it is meant to be.
    #[error("{quantity} is {value}, but must be {requirement}")]
    Invalid {
        /// Which quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        requirement: &'static str,
    },
    /// As [`Error::Invalid`], for a quantity that varies along the rod.
    #[error("{quantity} is {value} at s = {s} m, but must be {requirement}")]
    InvalidAt {
        /// Which quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        requirement: &'static str,
        /// Arc length, m.
        s: f64,
    },
    /// A state of strain the material cannot be in, such as J ≤ 0.
    #[error(
        "inadmissible strain: {quantity} = {value} at s = {s} m, point (x, y) = ({x}, {y}) m; it must be {requirement}"
    )]
    Inadmissible {
        /// Which quantity, for instance `J`.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        requirement: &'static str,
        /// Arc length, m.
        s: f64,
        /// Section coordinate, m.
        x: f64,
        /// Section coordinate, m.
        y: f64,
    },
    /// A linear system without a unique solution, for instance a tangent that lost its stiffness.
    #[error("{matrix} is singular at s = {s} m")]
    Singular {
        /// Which matrix.
        matrix: &'static str,
        /// Arc length, m.
        s: f64,
    },
}

/// Result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;
