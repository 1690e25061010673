//! Why does my stack sink? What an answer leaves undone, why, and what helps.
//!
//! A [`Frame`] is solved as its owner solves it, and exactly. What is missing in the answer is
//! measured. Then each suspected cause is taken away, to see whether that helps: all masses are
//! made equal, the body is held that moves most in the slowest pattern, the rows are taken in
//! another order. What saves half of the sweeps or more is named as a cause, the strongest first;
//! nothing is concluded from the number of bodies or the ratio of masses alone.

mod cause;
mod course;
mod examination;
mod examine;
mod frame;
mod linear;
#[cfg(feature = "mechanics")]
mod relief;
mod remedy;
#[cfg(feature = "mechanics")]
mod run;
mod sequence;
mod show;
#[cfg(feature = "mechanics")]
mod suspect;
mod yard;

pub use cause::{Moving, Slow, Without};
pub use course::{Course, courses};
pub use examination::{Examination, Note};
pub use examine::{GOOD, HEALTHY, Load, Practice, Shortfall, examine};
pub use frame::{Body, Frame, Pair};
pub use linear::{Linear, Slowest, Way};
pub use remedy::{Relief, Remedy};
#[cfg(feature = "mechanics")]
pub use run::{exact, examine_scene, main_solve, practice};
pub use sequence::examine_sequence;
pub use yard::Yard;
