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
mod remedy_table;
#[cfg(feature = "mechanics")]
mod run;
mod sequence;
mod show;
mod slow;
mod suspect;
mod thresholds;

pub use cause::{Moving, Slow, Without};
// The hidden items are parts of an examination, for reports and tests. They are no promise.
#[doc(hidden)]
pub use error_history::{ErrorHistory, error_histories};
pub use examination::{Examination, OVERLAP, StepSummary};
#[doc(hidden)]
pub use examine::examine;
pub use examine::{Load, UnsupportedLoad, UserSolver};
#[doc(hidden)]
pub use frame::{Body, Frame, Pair};
#[doc(hidden)]
pub use linear::{Linear, Slowest, SweepParameters};
#[doc(hidden)]
pub use reference::ReferenceSolution;
pub use remedy::{Remedy, RemedyEffect};
#[cfg(feature = "mechanics")]
#[doc(hidden)]
pub use run::{exact, main_solve};
#[cfg(feature = "mechanics")]
pub use run::{examine_scene, user_solver};
pub use sequence::examine_sequence;
#[doc(hidden)]
pub use show::percent;
pub use thresholds::{GOOD, HEALTHY};
