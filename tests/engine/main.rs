//! The engine where it takes a way of its own: lanes that disagree, batches, and the shortcut for quadratic laws.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

mod active;
mod batch;
mod branches;
mod oracle;
mod pressure;
mod quadratic;
