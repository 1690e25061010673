//! Settings of all solvers.

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
    /// An iterative solver computes its residual every `check_every` iterations; each costs about
    /// as much as a sweep.
    pub check_every: usize,
    /// A solver does not start if its own data, such as a dense factor, would need more memory than
    /// this.
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
    /// Checks that the settings are valid.
    ///
    /// # Errors
    /// Lists each invalid setting.
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

    /// The status of a solver that needs this much memory, if it is more than the limit.
    pub fn refusal(&self, needs: Memory) -> Option<Status> {
        let limit = self.memory;
        (needs > limit).then_some(Status::TooLarge { needs, limit })
    }
}
