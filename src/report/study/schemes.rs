//! The same scene by every scheme: energy, drift, penetration and cost side by side.

use std::time::Instant;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::Study;
use super::footage::{Footage, Way, shots};
use super::history::{self, History};
use super::settings::file_name;
use super::variation::Variation;
use crate::error::Result;
use crate::film::Take;
use crate::scene::Scheme;

/// Scenes, each stepped by every scheme that knows its model of friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The scenes.
    pub cases: Vec<Case>,
}

/// A scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Letters, digits, `-` and `_`; unique in the report.
    #[serde(deserialize_with = "file_name")]
    pub name: String,
    /// What to see in it, a sentence or two.
    pub text: String,
    /// A shipped scene or a file.
    pub scene: String,
    /// Fields of the scene that are changed for every scheme.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub change: Table,
    /// Simulated time (s).
    pub duration: f64,
    /// Ways to step it beside the schemes as they are.
    #[serde(default)]
    pub also: Vec<Way>,
    /// Who is shown in a film, schemes and ways by name; no film without any.
    #[serde(default)]
    pub film: Vec<String>,
    /// Instants of the film.
    #[serde(default = "shots")]
    pub shots: usize,
    /// A run whose energy changes by more than this (J) is cut off in the figures; the table has it.
    #[serde(default)]
    pub energy_limit: Option<f64>,
}

/// What the schemes make of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The case.
    pub case: Case,
    /// The scene's title.
    pub title: String,
    /// A run each.
    pub runs: Vec<Run>,
    /// Some of them as a film.
    pub footage: Option<Footage>,
}

/// A scene stepped by a scheme.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The scheme, or the way.
    pub name: String,
    /// The scheme.
    pub scheme: String,
    /// The solver; none where the scheme asks no solver.
    pub solver: Option<String>,
    /// How it went.
    pub history: History,
}

/// Wall times of one case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The case.
    pub case: String,
    /// Seconds for each step taken, by the name of the run.
    pub step_seconds: Vec<(String, f64)>,
}

impl Case {
    fn ways(&self) -> Result<Vec<Way>> {
        let base = Variation::of(&self.scene, &self.change);
        let way = |scheme: Scheme| {
            let name = scheme.name().to_string();
            let step = Table::from_iter([("scheme".into(), Value::from(name.clone()))]);
            Way { name, change: Table::from_iter([("step".into(), Value::from(step))]) }
        };
        base.scene()?;
        let schemes = Scheme::ALL.into_iter().map(way);
        let able = schemes.filter(|way| base.and(&way.change).scene().is_ok());
        Ok(able.chain(self.also.clone()).collect())
    }

    fn run(&self, way: &Way) -> Result<(Run, Option<Take>, f64)> {
        let scene = Variation::of(&self.scene, &self.change).and(&way.change).scene()?;
        let start = Instant::now();
        let (history, take) = match self.film.contains(&way.name) {
            true => {
                let shown = (way.name.as_str(), self.shots);
                let (history, take) = history::filmed(&scene, self.duration, shown, |_| ())?;
                (history, Some(take))
            }
            false => (history::run(&scene, self.duration, |_| ())?, None),
        };
        let seconds = start.elapsed().as_secs_f64() / history.steps.max(1) as f64;
        let scheme = scene.step.scheme;
        let solver = scheme.solves_lcps().then(|| scene.solver.name.clone());
        let run = Run { name: way.name.clone(), scheme: scheme.name().into(), solver, history };
        Ok((run, take, seconds))
    }
}

impl Study for Plan {
    const NAME: &'static str = "schemes";
    type Finding = Finding;
    type Times = Times;

    fn tasks(&self) -> Vec<String> {
        self.cases.iter().map(|case| case.name.clone()).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let case = &self.cases[task];
        let outcomes: Vec<_> =
            case.ways()?.par_iter().map(|way| case.run(way)).collect::<Result<_>>()?;
        let base = Variation::of(&case.scene, &case.change);
        let mut takes: Vec<Take> =
            outcomes.iter().filter_map(|(_, take, _)| take.clone()).collect();
        takes.sort_by_key(|take| case.film.iter().position(|name| *name == take.name));
        let times = outcomes.iter().map(|(run, _, seconds)| (run.name.clone(), *seconds)).collect();
        let title = base.scene()?.title;
        let id = format!("film_{}", case.name);
        let footage = (!takes.is_empty()).then(|| Footage::of(id, base, &takes));
        let runs = outcomes.into_iter().map(|(run, ..)| run).collect();
        let finding = Finding { case: case.clone(), title, runs, footage };
        Ok((finding, Times { case: case.name.clone(), step_seconds: times }))
    }
}
