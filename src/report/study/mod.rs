//! The studies of reports, one per file: each runs simulations or solvers and returns plain results
//! that can be stored, compared and drawn later without solving anything again.
//!
//! A [`Study`] is a list of independent tasks.

pub mod animation;
pub mod cards;
mod clock;
pub mod comparison;
pub mod convergence;
pub mod cross_check;
pub mod defects;
pub mod drift;
pub mod friction;
pub mod grid;
pub mod posed;
pub mod problems;
pub mod profiles;
pub mod scenes;
pub mod settings;
pub mod side_by_side;
pub mod slider;
pub mod sliding;
pub mod solved;
pub mod solver_times;
pub mod sparsity;
pub mod variation;
pub mod verification;

pub use lcplab_analysis::{ci, families, receipt, regression, tally, trial};

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Result;
use crate::solver::Registry;

/// A kind of study; a value has the settings of one section in a report file.
pub trait Study: JsonSchema + Serialize + DeserializeOwned + Send + Sync {
    /// The kind's name in report files.
    const NAME: &'static str;
    /// The finding of a task: the same in every run on the same kind of processor.
    type Finding: Serialize + DeserializeOwned + Send;
    /// The machine-dependent data; `()` if nothing is timed.
    type Times: Serialize + DeserializeOwned + Send;

    /// Whether a task must run alone, because it is timed.
    fn alone(&self, _task: usize) -> bool {
        false
    }

    /// Its own name and heading, if the settings define them; otherwise those of the kind are used.
    fn named(&self) -> Option<(String, String)> {
        None
    }

    /// The names of the tasks, such as a scene's name or a size.
    fn tasks(&self) -> Vec<String>;

    /// Runs the task with this index in [`Study::tasks`]; solvers that the settings name are those
    /// of the registry.
    ///
    /// # Errors
    /// If the task cannot be done, with the reason, which becomes a row of the report. Other tasks
    /// continue.
    fn run(&self, task: usize, solvers: &Registry) -> Result<(Self::Finding, Self::Times)>;
}
