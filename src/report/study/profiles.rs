//! Problem families × solvers at several tolerances.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::posed::Source;
use super::problems;
use super::settings::AtStep;
use crate::error::Result;
use crate::lcp::Lcp;
use crate::lcp::Question;
use crate::lcp::file::{Expected, Problem};
use crate::lcp::friction::ProblemForm;
use crate::lcp::library;
use crate::memory::Memory;
use crate::report::methods;
use crate::solver::{Entry, Method, Options, Registry, Settings, is_semidefinite};
pub use lcplab_analysis::profiles::{
    Cost, FamilyAttempts, ProblemAttempts, Profile, costs, of_all, profiles,
};
use lcplab_analysis::trial::{Attempt, Trial};

/// The problems and solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Families of the library, problem files, folders of them, or patterns; by default the whole
    /// library.
    #[serde(default)]
    pub families: Vec<String>,
    /// The number of seeds, 1 … `seeds`, for families with random numbers.
    #[serde(default = "one")]
    pub seeds: u32,
    /// Steps of scenes, each as a separate family.
    #[serde(default)]
    pub scenes: Vec<AtStep>,
    /// The solvers; by default all.
    #[serde(default)]
    pub solvers: Vec<String>,
    /// The required scaled residuals, one after another.
    #[serde(default = "ladder")]
    pub tolerances: Vec<f64>,
    /// The maximum number of sweeps, steps or pivots.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn one() -> u32 {
    1
}

fn ladder() -> Vec<f64> {
    vec![1e-4, 1e-8]
}

fn limit() -> usize {
    20_000
}

impl Study for Plan {
    const NAME: &'static str = "profiles";
    type Finding = FamilyAttempts;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let steps = self.scenes.iter().map(|at| Source::Scene(at.clone()).name());
        self.families().into_iter().chain(steps).collect()
    }

    fn run(&self, task: usize, solvers: &Registry) -> Result<(FamilyAttempts, ())> {
        let entries = methods::entries(&self.solvers, solvers)?;
        let families = self.families();
        let (family, problems) = match families.get(task) {
            Some(name) => (name.clone(), self.of_family(name)?),
            None => {
                let source = Source::Scene(self.scenes[task - families.len()].clone());
                (source.name(), vec![(source.posed()?.lcp, false)])
            }
        };
        let posed = |(lcp, impossible): (Lcp, bool)| {
            let at = |tolerance: &f64| self.attempts(&entries, &lcp, *tolerance);
            let attempts = self.tolerances.iter().map(at).collect();
            let semidefinite = lcp.matrix().is_symmetric() && is_semidefinite(&lcp);
            ProblemAttempts { rows: lcp.len(), impossible, semidefinite, attempts }
        };
        let problems = problems.into_iter().map(posed).collect();
        Ok((FamilyAttempts { family, problems }, ()))
    }
}

impl Plan {
    /// The attempts of the solvers at a problem.
    fn attempts(&self, entries: &[Entry], lcp: &Lcp, tolerance: f64) -> Vec<Attempt> {
        let max_iterations = self.max_iterations;
        let settings =
            Settings::default().with_tolerance(tolerance).with_max_iterations(max_iterations);
        let options = Options::default().with_settings(settings);
        let problem = ProblemForm::Boxed(lcp.clone());
        let attempt = |entry: &Entry| {
            let trial = Trial::run(&Method::Boxed(entry.clone()), &problem, &options, &mut ());
            trial.attempt(&entry.name, lcp, tolerance)
        };
        entries.iter().map(attempt).collect()
    }

    fn families(&self) -> Vec<String> {
        if self.families.is_empty() {
            library::all().map(|family| family.name().to_string()).collect()
        } else {
            self.families.clone()
        }
    }

    /// The problems with this name, and whether each is known to have no solution.
    fn of_family(&self, name: &str) -> Result<Vec<(Lcp, bool)>> {
        let named = problems::named(name, self.seeds, Memory::default())?;
        let problems = named.into_iter().flat_map(|(_, problems)| problems);
        let impossible = |problem: &Problem| {
            Expected::of(problem).is_some_and(|expected| expected.is_impossible())
        };
        let boxed = |problem: Problem| {
            let place = format!("{name}: {}", problem.name);
            let question = Question::new(&problem, None, &place)?;
            let lcp = question.require_boxed("profiles are", &place)?.clone();
            Ok((lcp, impossible(&problem)))
        };
        problems.map(boxed).collect()
    }
}
