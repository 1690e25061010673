//! What every solver can be told.

use super::Status;
use lcplab_problem::error::{Defects, Result};
use lcplab_problem::memory::Memory;

/// The settings that all solvers share.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Stop when the scaled residual
    /// ([`merit::scaled_residual`](lcplab_problem::merit::scaled_residual)) is at most this.
    pub tolerance: f64,
    /// Stop after this many iterations (sweeps, pivots).
    pub max_iterations: usize,
    /// An iterative solver looks at its residual every so many iterations: a look costs about as
    /// much as a sweep.
    pub check_every: usize,
    /// A solver does not begin if what it makes of the problem, such as a dense factor, takes more.
    pub memory: Memory,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            tolerance: 1e-8,
            max_iterations: 10_000,
            check_every: 1,
            memory: Memory::default(),
        }
    }
}

impl Settings {
    /// Whether the settings can be used.
    ///
    /// # Errors
    /// Lists each setting that cannot.
    pub fn validate(&self) -> Result<()> {
        let mut defects = Defects::default();
        if !(self.tolerance >= 0.0 && self.tolerance.is_finite()) {
            defects.add("tolerance", format!("must be at least 0, is {}", self.tolerance));
        }
        if self.check_every == 0 {
            defects.add("check_every", "must be at least 1, is 0");
        }
        defects.into_result("settings")
    }

    /// The status of a solver that would need so much memory, if it may not have it.
    pub fn refusal(&self, needs: Memory) -> Option<Status> {
        let limit = self.memory;
        (needs > limit).then_some(Status::TooLarge { needs, limit })
    }
}
