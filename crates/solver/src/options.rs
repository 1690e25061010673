//! The options of solvers that a user can choose.

use super::{Damping, Order, Settings};
use lcplab_lcp::error::{Defects, Result};
use lcplab_lcp::memory::Memory;

/// An option that only some solvers use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// [`Options::omega`].
    Omega,
    /// [`Options::order`].
    Order,
    /// [`Options::damping`].
    Damping,
}

impl Choice {
    /// The option's name.
    pub fn name(self) -> &'static str {
        match self {
            Choice::Omega => "omega",
            Choice::Order => "order",
            Choice::Damping => "damping",
        }
    }
}

/// The options of a solver that a user can choose. Each `with_` function changes one of them.
///
/// ```
/// use lcplab_solver::Options;
///
/// let options = Options::default().with_tolerance(1e-10).with_max_iterations(50).with_omega(1.5);
/// assert_eq!((options.settings.tolerance, options.settings.max_iterations), (1e-10, 50));
/// assert_eq!(options.omega, 1.5);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The common settings.
    pub settings: Settings,
    /// The relaxation factor ω of PGS and SOR.
    pub omega: f64,
    /// The order of the rows in a sweep of PGS and SOR.
    pub order: Order,
    /// The step length of Jacobi's method.
    pub damping: Damping,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            settings: Settings::default(),
            omega: 1.3,
            order: Order::default(),
            damping: Damping::default(),
        }
    }
}

impl Options {
    /// These common settings.
    #[must_use]
    pub fn with_settings(self, settings: Settings) -> Self {
        Options { settings, ..self }
    }

    /// See [`Settings::with_tolerance`].
    #[must_use]
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Options { settings: self.settings.with_tolerance(tolerance), ..self }
    }

    /// See [`Settings::with_max_iterations`].
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: usize) -> Self {
        Options { settings: self.settings.with_max_iterations(max_iterations), ..self }
    }

    /// See [`Settings::with_memory`].
    #[must_use]
    pub fn with_memory(self, memory: Memory) -> Self {
        Options { settings: self.settings.with_memory(memory), ..self }
    }

    /// The relaxation factor ω of PGS and SOR.
    #[must_use]
    pub fn with_omega(self, omega: f64) -> Self {
        Options { omega, ..self }
    }

    /// The order of the rows in a sweep of PGS and SOR.
    #[must_use]
    pub fn with_order(self, order: Order) -> Self {
        Options { order, ..self }
    }

    /// The step length of Jacobi's method.
    #[must_use]
    pub fn with_damping(self, damping: Damping) -> Self {
        Options { damping, ..self }
    }

    /// Checks that the options are valid.
    ///
    /// ```
    /// use lcplab_lcp::memory::Memory;
    /// use lcplab_solver::{Choice, Damping, Options, Order, Settings};
    ///
    /// let options = Options::default()
    ///     .with_settings(Settings::default().with_check_every(5))
    ///     .with_memory(Memory::bytes(1_000_000))
    ///     .with_order(Order::Reverse)
    ///     .with_damping(Damping::Factor(0.5));
    /// assert!(options.validate().is_ok());
    /// assert_eq!(options.settings.memory.to_string(), "1 MB");
    /// assert_eq!(Choice::Omega.name(), "omega");
    /// assert_eq!(
    ///     options.with_omega(2.5).validate().unwrap_err().to_string(),
    ///     "settings: omega: must lie between 0 and 2, is 2.5"
    /// );
    /// ```
    ///
    /// # Errors
    /// Names the invalid option.
    pub fn validate(&self) -> Result<()> {
        self.settings.validate()?;
        let mut defects = Defects::default();
        let damping = match self.damping {
            Damping::Safe => 1.0,
            // Values from 2/λ on diverge, and λ ≥ 1.
            Damping::Factor(theta) => theta,
        };
        for (choice, value) in [(Choice::Omega, self.omega), (Choice::Damping, damping)] {
            if !(value > 0.0 && value < 2.0) {
                defects.add(choice.name(), format!("must lie between 0 and 2, is {value}"));
            }
        }
        defects.into_result("settings")
    }
}
