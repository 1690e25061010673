//! What an observer wrote down: one small record an iteration.

mod convergence;

pub use convergence::{Convergence, Record};
