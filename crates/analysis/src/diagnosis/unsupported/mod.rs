//! Why does my stack sink? The error of an answer, its causes, and remedies.
//!
//! A [`Frame`] is solved as the user solves it, and exactly, and the error of the answer is
//! measured, in each independent part of the frame too. Then each suspected cause is removed to
//! see whether that helps: all masses are made equal, pairs of bodies are decoupled, the rows are
//! taken in another order. A change that saves at least half of the sweeps is reported as a cause,
//! the strongest first; nothing is concluded from the number of bodies or the ratio of masses
//! alone.

mod cause;
mod error_history;
mod examination;
mod examine;
mod frame;
mod island;
mod linear;
#[cfg(feature = "mechanics")]
mod moving;
mod reference;
mod remedy;
#[cfg(feature = "mechanics")]
mod remedy_effect;
#[cfg(feature = "mechanics")]
mod run;
mod sequence;
mod show;
mod slow;
mod suspect;
mod thresholds;

pub use cause::{Moving, Slow, Without};
pub use error_history::{ErrorHistory, error_histories};
pub use examination::{Examination, StepSummary};
pub use examine::{Load, UnsupportedLoad, UserSolver, examine};
pub use frame::{Body, Frame, Pair};
pub use linear::{Linear, Slowest, SweepParameters};
pub use reference::ReferenceSolution;
pub use remedy::{Remedy, RemedyEffect};
#[cfg(feature = "mechanics")]
pub use run::{exact, examine_scene, main_solve, user_solver};
pub use sequence::examine_sequence;
pub use thresholds::{GOOD, HEALTHY};
