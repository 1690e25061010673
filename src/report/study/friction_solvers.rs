//! What friction costs: the library's problems with friction under each model, by every method that takes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::families::{self, Contender, Limits, Models, Row};
use super::problems;
use crate::error::Result;
use crate::lcp::friction::Model;
use crate::memory::Memory;
use crate::report::methods;
use crate::solver::{Options, Stop};

/// Problem families with friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Families of the library, problem files, folders of them, or patterns.
    pub families: Vec<String>,
    /// The models of friction, by name.
    #[serde(default = "models")]
    pub models: Vec<String>,
    /// The methods, by name; all without it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub solvers: Vec<String>,
    /// How many problems of each family that has a seed.
    #[serde(default = "seeds")]
    pub seeds: u32,
}

fn seeds() -> u32 {
    3
}

fn models() -> Vec<String> {
    Model::ALL.iter().map(ToString::to_string).collect()
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
        let problems = problems::named(&self.families[task], self.seeds, Memory::default())?;
        let options = Options::default();
        let models: Vec<Model> = self.models.iter().map(|m| m.parse()).collect::<Result<_>>()?;
        let methods = match self.solvers.as_slice() {
            [] => methods::all(),
            names => {
                let named = names.iter().map(|name| methods::named(name));
                named.collect::<Result<Vec<_>>>()?.concat()
            }
        };
        let limits = Limits { stop: &Stop::default(), each: None, tick: &|| () };
        let (models, contenders) = (Models::Usual(&models), Contender::unnamed(methods));
        let mut rows = families::run_on(&problems, models, &contenders, &options, &limits);
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
