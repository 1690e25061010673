//! Pictures of scenes in motion.

mod player;
mod strip;
#[path = "../../../crates/page/tests/suite/well_formed.rs"]
mod well_formed;
