//! The engine against num-dual: every law, level and request.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic
#![allow(dead_code)] // the oracle is shared

mod every_law;
mod levels;
#[path = "../engine/oracle.rs"]
mod oracle;
