//! Out of the crate: a solved rod as a table, for ParaView, and as JSON.
//!
//! What lives here writes states of a rod, a slice of [`Node`](crate::solve::Node)s (the stages of a rod in motion convert to them), to whatever takes bytes; it solves nothing and opens no file.
//!
//! | format | how | needs |
//! |---|---|---|
//! | CSV | [`write_csv`] | |
//! | VTK XML PolyData (`.vtp`), for ParaView | [`Polyline`] | |
//! | JSON and whatever else serde knows | `Serialize` and `Deserialize` of the types of [`lie`](crate::lie) and [`solve`](crate::solve) | feature `serde` |
//!
//! Poses convert to and from nalgebra's [`Isometry3`](nalgebra::Isometry3): `Isometry3::from(pose)`, `Pose::from(isometry)`.

mod csv;
mod frame;
mod vtp;

pub use csv::write_csv;
pub use vtp::Polyline;
