//! What can go wrong, as structured values.

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
    /// A coefficient of a law's table that cannot be what it is.
    #[error("coefficient {name} is {value}, but must be {requirement}")]
    Coefficient {
        /// Which one, for instance `C_20`, `D_1` or `mu_2`.
        name: String,
        /// Its value.
        value: f64,
        /// What it must be.
        requirement: &'static str,
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
    /// A section whose equilibrium is no minimum of its energy: it has lost its stability, or too few functions let the search end at a
    /// saddle.
    #[error(
        "the section at s = {s} m is unstable: {mode} lowers its energy (eigenvalue {eigenvalue:.1e} of the largest); try more functions, or a smaller strain"
    )]
    SectionUnstable {
        /// The displacement that weighs most in the direction of lower energy.
        mode: String,
        /// The smallest eigenvalue of the Hessian of the energy in the displacement, relative to the largest.
        eigenvalue: f64,
        /// Arc length, m.
        s: f64,
    },
    /// Something a scene declares that the solver asked does not know.
    #[error("{solver} does not know {what}")]
    NotModelled {
        /// What was declared.
        what: &'static str,
        /// Which solver was asked.
        solver: &'static str,
    },
    /// A linear system without a unique solution, for instance a tangent that lost its stiffness.
    #[error("{matrix} is singular at s = {s} m")]
    Singular {
        /// Which matrix.
        matrix: &'static str,
        /// Arc length, m.
        s: f64,
    },
    /// A rod that its supports do not hold, and no load either.
    #[error(
        "the supports leave the rod free to move: {motion} ({x:.3}, {y:.3}, {z:.3}); hold that freedom at one of them"
    )]
    FreeToMove {
        /// `translation along` or `rotation about`.
        motion: &'static str,
        /// Direction in space, a unit vector.
        x: f64,
        /// Its second component.
        y: f64,
        /// Its third component.
        z: f64,
    },
    /// A support that holds something where a rod with fixed strains cannot have it.
    #[error(
        "the supports ask for more than the rod can do: {freedom} at s = {s} m is to be {held:.4e}, and is {found:.4e} by the strains that are fixed and the supports before it; release it there, or free a strain"
    )]
    OverDetermined {
        /// Which freedom, in the frame of the support.
        freedom: &'static str,
        /// Arc length of the support, m.
        s: f64,
        /// What it is to be, rad or m.
        held: f64,
        /// What it is.
        found: f64,
    },
    /// A bounded iteration that did not reach its tolerance.
    #[error("{what} did not converge in {iterations} iterations; the last correction was {residual}")]
    NoConvergence {
        /// Which iteration.
        what: &'static str,
        /// How many iterations were made.
        iterations: usize,
        /// Size of the last correction.
        residual: f64,
    },
    /// A polygon that bounds no section.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

/// Why a polygon bounds no section: which ring, which vertices or edges.
///
/// Ring 0 is the outer boundary, ring k the k-th hole. Edge i runs from vertex i to the next one of its ring.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PolygonError {
    /// A vertex with an infinite or undefined coordinate.
    #[error("ring {ring}, vertex {vertex} is ({x}, {y}), but coordinates must be finite")]
    NotFinite {
        /// Which ring.
        ring: usize,
        /// Which vertex.
        vertex: usize,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
    },
    /// Fewer than three vertices.
    #[error("ring {ring} has {count} vertices, but needs at least 3")]
    TooFewVertices {
        /// Which ring.
        ring: usize,
        /// How many vertices it has.
        count: usize,
    },
    /// Two equal vertices in one ring. A ring closes by itself: do not repeat its first vertex.
    #[error("ring {ring} visits the same place with vertices {first} and {second}; list each vertex once")]
    RepeatedVertex {
        /// Which ring.
        ring: usize,
        /// The first of the two vertices.
        first: usize,
        /// The second of the two vertices.
        second: usize,
    },
    /// All vertices on one line.
    #[error("ring {ring} encloses no area: its vertices lie on one line")]
    ZeroArea {
        /// Which ring.
        ring: usize,
    },
    /// Two edges of one ring that cross or touch.
    #[error("ring {ring} is not simple: its edges {first} and {second} cross or touch")]
    SelfIntersection {
        /// Which ring.
        ring: usize,
        /// The first of the two edges.
        first: usize,
        /// The second of the two edges.
        second: usize,
    },
    /// Edges of two rings that cross or touch.
    #[error("edge {edge} of ring {ring} crosses or touches edge {other_edge} of ring {other}")]
    RingsCross {
        /// The ring being added.
        ring: usize,
        /// Its edge.
        edge: usize,
        /// The ring it meets.
        other: usize,
        /// The edge it meets.
        other_edge: usize,
    },
    /// A hole that lies outside the outer boundary.
    #[error("hole {ring} lies outside the outer boundary, for instance its vertex 0 at ({x}, {y})")]
    HoleOutside {
        /// Which ring.
        ring: usize,
        /// First coordinate of its first vertex.
        x: f64,
        /// Second coordinate of its first vertex.
        y: f64,
    },
    /// A hole inside another hole.
    #[error("hole {ring} and hole {other} are nested; keep the larger one only")]
    HolesNested {
        /// The ring being added.
        ring: usize,
        /// The ring it contains or lies in.
        other: usize,
    },
}

/// Result with this crate's [`enum@Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Refuses a number that does not meet its requirement.
pub(crate) fn require(
    met: bool,
    quantity: &'static str,
    value: f64,
    requirement: &'static str,
) -> Result<()> {
    if met { Ok(()) } else { Err(Error::Invalid { quantity, value, requirement }) }
}

/// Refuses a number that is not positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<()> {
    require(value > 0.0 && value.is_finite(), quantity, value, "positive and finite")
}

/// Refuses a number that is negative or not finite.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<()> {
    require(value >= 0.0 && value.is_finite(), quantity, value, "finite and not negative")
}

/// Refuses numbers of which one is not finite, by that one.
pub(crate) fn finite<'a>(quantity: &'static str, values: impl IntoIterator<Item = &'a f64>) -> Result<()> {
    values.into_iter().try_for_each(|&value| require(value.is_finite(), quantity, value, "finite"))
}
