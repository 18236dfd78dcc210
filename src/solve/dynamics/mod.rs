//! Rods in motion: a [`Scene`] says what acts on a rod in time, [`Dynamics`] moves it, a [`Frame`] describes it at an instant.
//!
//! The unknowns are the strains of the statics. The poses that follow from them are compared with those at the beginning of a step; what the
//! time scheme makes of the difference are velocities and accelerations at the Gauss stages, and these make a load. So an instant is
//! a static problem with another load, whose tangent is exact but for what is of higher order than the element.

mod alpha;
mod begin;
mod border;
mod conserve;
mod consistent;
mod core;
mod engine;
mod factor;
mod failure;
mod frame;
mod grid;
mod linear;
mod march;
mod modes;
mod mount;
mod newton;
mod options;
mod place;
mod present;
mod relation;
mod report;
mod runge_kutta;
mod scene;
mod scheme;
mod state;
mod strain_rates;

pub use failure::{Failure, Reason};
pub use frame::{Energies, Frame, MovingNode, MovingStage};
pub use modes::{Mode, ModeStage};
pub use options::{Adaptive, Dynamics, Step, Stepper};
pub use report::StepReport;
pub use scene::{Movable, Scene};
pub use scheme::Scheme;
pub use state::{Start, State};
