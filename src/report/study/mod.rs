//! What a report measures, one study a file: each runs simulations or solvers and returns plain
//! results that can be stored, compared and drawn later without solving anything again.
//!
//! A [`Study`] is a list of tasks that do not depend on each other.

pub mod cards;
pub mod comparison;
pub mod convergence;
pub mod cross_check;
pub mod drift;
pub mod film;
pub mod footage;
pub mod frames;
pub mod friction;
pub mod grid;
pub mod posed;
pub mod problems;
pub mod profiles;
pub mod scenes;
pub mod settings;
pub mod slider;
pub mod sliding;
pub mod sparsity;
pub mod variation;
pub mod verification;

pub use lcplab_study::{attempt, families, regression};

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Result;

/// A kind of study; a value holds the settings that one section of a report file states.
pub trait Study: JsonSchema + Serialize + DeserializeOwned + Send + Sync {
    /// The kind's name in report files.
    const NAME: &'static str;
    /// What a task finds out: the same in every run on the same kind of processor.
    type Finding: Serialize + DeserializeOwned + Send;
    /// What differs from machine to machine; `()` where nothing is timed.
    type Times: Serialize + DeserializeOwned + Send;

    /// Whether its tasks run one after the other and beside nothing else, because they are timed.
    fn alone(&self) -> bool {
        false
    }

    /// A name and a heading of its own, where the settings bring them; those of the kind else.
    fn named(&self) -> Option<(String, String)> {
        None
    }

    /// What tells the tasks apart: a scene's name, a size.
    fn tasks(&self) -> Vec<String>;

    /// Carries out the task of this place in [`Study::tasks`].
    ///
    /// # Errors
    /// What it cannot do, with the reason: a row of the report. Other tasks go on.
    fn run(&self, task: usize) -> Result<(Self::Finding, Self::Times)>;
}

/// The solver that studies use where the solver is not what they study.
const STEPPER: &str = "dantzig";
