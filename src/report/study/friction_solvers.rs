//! What friction costs: the library's problems with friction under each model, by every method that takes it.

use serde::{Deserialize, Serialize};

use super::Study;
use super::families::{self, Row};
use crate::error::Result;
use crate::lcp::friction::Model;
use crate::lcp::library;
use crate::report::methods;
use crate::solver::Options;

/// Problem families with friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The families.
    pub families: Vec<String>,
    /// How many problems of each family that has a seed.
    #[serde(default = "seeds")]
    pub seeds: u32,
}

fn seeds() -> u32 {
    3
}

/// Wall time of a method on a family under a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The family.
    pub family: String,
    /// The model.
    pub model: String,
    /// The solver.
    pub solver: String,
    /// Seconds a problem.
    pub seconds: f64,
}

impl Study for Plan {
    const NAME: &'static str = "friction-solvers";
    type Finding = Vec<Row>;
    type Times = Vec<Times>;

    fn tasks(&self) -> Vec<String> {
        self.families.clone()
    }

    fn run(&self, task: usize) -> Result<(Vec<Row>, Vec<Times>)> {
        let family = library::by_name(&self.families[task])?;
        let options = Options::default();
        let mut rows = families::run(&[family], &Model::ALL, &methods::all(), &options, self.seeds);
        let times = rows.iter_mut().map(|row| Times {
            family: row.family.clone(),
            model: row.model.clone().unwrap_or_default(),
            solver: row.solver.clone(),
            seconds: std::mem::take(&mut row.seconds) / row.problems.max(1) as f64,
        });
        let times = times.collect();
        Ok((rows, times))
    }
}
