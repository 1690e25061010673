//! What an observer wrote down: one small record an iteration.

mod convergence;
mod provenance;

pub use convergence::{Convergence, Record};
pub use provenance::Provenance;
