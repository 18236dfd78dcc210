//! Integration over a line and over plane sections, exact to a stated polynomial degree.
//!
//! What lives here knows about polynomials, points and positive weights, and nothing about mechanics: no strain, no
//! material, no arc length. Every rule has positive weights and points strictly inside its shape, so an integrand is
//! never asked about a place that does not exist, and an integral of a positive function is positive.
//!
//! | shape | function | points for degree 2, 4, 8 |
//! |---|---|---|
//! | interval | [`gauss_legendre`] | 2, 3, 5 |
//! | unit disk, centred | [`disk`] | 3, 6, 19 |
//! | annulus, centred | [`annulus`] | 3, 10, 27 |
//! | unit square, centred | [`rectangle`] | 3, 6, 25 |
//! | triangle (0,0), (1,0), (0,1) | [`triangle`] | 3, 6, 25 |
//! | simple polygon with holes | [`Polygon::rule`] | about 3, 6, 16–20 |
//!
//! [`Rule::scaled`] and [`Rule::transformed`] carry a rule to ellipses, rectangles and parallelograms without loss of
//! degree. [`Rule::compressed`] turns any positive rule into one with at most (d+1)(d+2)/2 of its points.

mod basis;
mod compress;
mod disk;
mod eliminate;
mod householder;
mod line;
mod polygon;
mod rectangle;
mod ring;
mod rule;
mod slabs;
mod triangle;

pub use compress::MAX_COMPRESSED_DEGREE;
pub use disk::{PolarPoint, PolarRule, annulus, disk};
pub use line::{LineRule, MAX_NODES, gauss_legendre};
pub use polygon::Polygon;
pub use rectangle::rectangle;
pub use rule::{MAX_DEGREE, Rule};
pub use triangle::triangle;
