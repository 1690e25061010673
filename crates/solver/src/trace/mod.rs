//! Observers that record one small entry per iteration.

mod convergence;
mod path;
mod provenance;
mod work;

pub use convergence::{Convergence, Record};
pub use path::Path;
pub use provenance::{NO_ITERATES, Provenance};
pub use work::{Cost, Effort, Work};
