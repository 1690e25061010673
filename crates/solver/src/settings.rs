//! Settings of all solvers.

use super::Status;
use crate::tolerances::DEFAULT_TOLERANCE;
use lcplab_lcp::error::{Defects, Result};
use lcplab_lcp::memory::Memory;

/// The settings that all solvers share. Each `with_` function changes one of them.
///
/// ```
/// use lcplab_solver::Settings;
///
/// let settings = Settings::default().with_tolerance(1e-10).with_max_iterations(50);
/// assert_eq!((settings.tolerance, settings.max_iterations), (1e-10, 50));
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// Stop when the scaled residual
    /// ([`merit::scaled_residual`](lcplab_lcp::merit::scaled_residual)) is at most this.
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
            tolerance: DEFAULT_TOLERANCE,
            max_iterations: 10_000,
            check_every: 1,
            memory: Memory::default(),
        }
    }
}

impl Settings {
    /// Stop at this scaled residual.
    #[must_use]
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Settings { tolerance, ..self }
    }

    /// Stop after this many iterations.
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: usize) -> Self {
        Settings { max_iterations, ..self }
    }

    /// Compute the residual of an iterative solver after this many iterations each.
    #[must_use]
    pub fn with_check_every(self, check_every: usize) -> Self {
        Settings { check_every, ..self }
    }

    /// Do not start if the solver's own data would need more memory than this.
    #[must_use]
    pub fn with_memory(self, memory: Memory) -> Self {
        Settings { memory, ..self }
    }

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
    ///
    /// ```
    /// use lcplab_lcp::memory::Memory;
    /// use lcplab_solver::{Settings, Status};
    ///
    /// let settings = Settings::default().with_memory(Memory::bytes(1000)).with_check_every(0);
    /// assert_eq!(settings.refusal(Memory::numbers(125)), None); // 1000 bytes
    /// let refusal = settings.refusal(Memory::numbers(126)).unwrap();
    /// assert!(matches!(refusal, Status::TooLarge { .. }));
    /// assert_eq!(
    ///     settings.validate().unwrap_err().to_string(),
    ///     "settings: check_every: must be at least 1, is 0"
    /// );
    /// ```
    pub fn refusal(&self, needs: Memory) -> Option<Status> {
        let limit = self.memory;
        (needs > limit).then_some(Status::TooLarge { needs, limit })
    }
}
