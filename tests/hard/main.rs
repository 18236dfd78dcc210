//! Statics in hard cases, each against an oracle of its own.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

mod buckling;
mod elastica;
mod follower;
mod invariance;
mod limits;
mod oracle;
mod paths;
