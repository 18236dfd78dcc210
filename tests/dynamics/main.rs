//! Rods in motion, against references, closed forms and what a motion must keep.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

mod cases;
mod damping;
mod ends;
mod energy;
mod held;
mod oracle;
mod orders;
mod release;
mod stability;
mod stepping;
mod vibration;
