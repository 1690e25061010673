//! The energy balance of a motion, summed over its steps: the accounts of the simulation's ledger.
//!
//! ```text
//! change of kinetic + potential energy = Σ accounts + remainder
//! ```
//!
//! The remainder is measured; it is rounding unless a contribution is missing. Schemes that do not
//! record the forces have no accounts.

use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Table;

use crate::animation::instants;
use crate::error::Result;
use crate::report::study::settings::file_name;
use crate::report::study::variation::Variation;
use crate::simulation::{Ledger, Motion, Simulation};
use crate::solver::Registry;

/// A scene stepped with one set of settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Letters, digits, `-` and `_`; unique in the report.
    #[serde(deserialize_with = "file_name")]
    pub name: String,
    /// The heading of its figure.
    pub title: String,
    /// What to see in it, one or two sentences.
    pub text: String,
    /// A shipped scene or a file.
    pub scene: String,
    /// Overridden fields of the scene.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub change: Table,
    /// Simulated time (s).
    pub duration: f64,
}

/// The accounts of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Account {
    /// The run.
    pub run: Run,
    /// The names of the accounts; empty if the scheme does not record the forces.
    pub accounts: Vec<String>,
    /// The energy balance at several instants, including the start and the end.
    pub books: Vec<Book>,
    /// The largest sum of remainders at any time (J); `None` without accounts.
    pub remainder: Option<f64>,
    /// The largest energy exchanged: kinetic energy, or a change of the potential energy (J).
    pub turnover: f64,
    /// The size of the energies in the computation, to which rounding errors are proportional (J).
    pub scale: f64,
    /// Why it ended early, if it did.
    pub ending: Option<String>,
}

/// The energy balance up to one instant (J).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Book {
    /// The time (s).
    pub time: f64,
    /// The change of kinetic energy since the start.
    pub kinetic: f64,
    /// The change of potential energy since the start.
    pub potential: f64,
    /// Each account since the start; gains are positive.
    pub accounts: Vec<f64>,
}

/// The number of instants that are kept.
const KEPT: usize = 121;

impl Book {
    fn new(time: f64, [kinetic, potential]: [f64; 2], sum: Option<&Ledger>) -> Self {
        let accounts = sum.map_or(Vec::new(), |sum| sum.accounts().map(|(_, work)| work).to_vec());
        Book { time, kinetic, potential, accounts }
    }

    /// The energy that no account explains (J).
    pub(crate) fn remainder(&self) -> f64 {
        self.kinetic + self.potential - self.accounts.iter().sum::<f64>()
    }
}

impl Run {
    /// Steps the scene with its solver, one of these, and adds up its energy balance.
    ///
    /// # Errors
    /// If the scene does not exist, or is invalid with the overridden fields.
    pub(crate) fn audit(&self, solvers: &Registry) -> Result<Account> {
        let mut scene = Variation::of(&self.scene, &self.change).scene()?;
        scene.solvers = solvers.clone();
        let start = Motion::of(&scene, &scene.states, 0);
        let steps = (self.duration / scene.step.dt).round() as usize;
        let kept = instants(steps, KEPT);
        let mut sum = Some(Ledger::default());
        let mut books = vec![Book::new(0.0, [0.0; 2], sum.as_ref())];
        let (mut remainder, mut turnover) = (0.0f64, start.kinetic);
        let mut simulation = Simulation::of(&scene)?;
        let recording = simulation.run(steps, |step| {
            sum = sum.zip(step.ledger).map(|(sum, ledger)| sum + ledger);
            let motion = &step.motion;
            let changes = [motion.kinetic - start.kinetic, motion.potential - start.potential];
            let book = Book::new(motion.time, changes, sum.as_ref());
            remainder = remainder.max(book.remainder().abs());
            turnover = turnover.max(motion.kinetic).max(changes[1].abs());
            if kept.binary_search(&step.number).is_ok() {
                books.push(book);
            }
            ControlFlow::Continue(())
        });
        let names = |sum: &Ledger| sum.accounts().map(|(name, _)| name.to_string()).to_vec();
        let accounts = sum.as_ref().map_or(Vec::new(), names);
        if sum.is_none() {
            // The entry of the start was made before this was known.
            books.iter_mut().for_each(|book| book.accounts.clear());
        }
        let (remainder, scale) = (sum.map(|_| remainder), sum.map_or(0.0, |sum| sum.scale));
        let (run, ending) = (self.clone(), recording.failure.map(|failure| failure.to_string()));
        Ok(Account { run, accounts, books, remainder, turnover, scale, ending })
    }
}
