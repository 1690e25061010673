//! What the last step's answer is worth as a start: each problem of a simulation is solved as it
//! comes, from the impulses that the same rows had before, and once more from 0.

use crate::simulation;
use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::attempt::entries;
use super::settings::Stepped;
use crate::error::Result;
use crate::scene::Scene;
use crate::simulation::{Simulation, Solve};
use crate::solver::{Entry, Options, Settings, Start, Status};
use crate::trace::Work;

/// Which simulations and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Scenes and how many steps each takes.
    pub scenes: Vec<Stepped>,
    /// The solvers.
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    #[serde(default = "target")]
    pub tolerance: f64,
    /// More sweeps, steps or pivots are not made in a solve.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn target() -> f64 {
    1e-6
}

fn limit() -> usize {
    20_000
}

/// A scene stepped by a solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The scene.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// The solver.
    pub solver: String,
    /// One a step, as far as the simulation came.
    pub steps: Vec<Pair>,
    /// Why it came no further, if it did not.
    pub failure: Option<String>,
}

/// The solves of a step, added up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// Iterations from the last step's answer.
    pub warm: usize,
    /// The same from 0.
    pub cold: usize,
    /// Multiplications ([`Work`]) from the last step's answer.
    #[serde(with = "lcplab_study::number::always")]
    pub warm_work: f64,
    /// The same from 0.
    #[serde(with = "lcplab_study::number::always")]
    pub cold_work: f64,
    /// Solves that were not claimed solved, of either kind.
    pub unsolved: usize,
}

impl Study for Plan {
    const NAME: &'static str = "warm-start";
    type Finding = Run;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let pairs = self.pairs();
        pairs.into_iter().map(|(at, solver)| format!("{}, {solver}", at.scene)).collect()
    }

    fn run(&self, task: usize) -> Result<(Run, ())> {
        let (Stepped { scene, steps }, solver) = self.pairs()[task];
        let entry = entries(std::slice::from_ref(solver))?[0];
        let mut scene = Scene::load(scene)?;
        scene.solver.tolerance = self.tolerance;
        scene.solver.max_iterations = self.max_iterations;
        let options = Options {
            settings: Settings {
                tolerance: self.tolerance,
                max_iterations: self.max_iterations,
                ..Settings::default()
            },
            ..simulation::options(&scene)
        };
        let (name, title) = (scene.name.clone(), scene.title.clone());
        let mut pairs = Vec::new();
        let mut simulation = Simulation::new(scene, (entry.build)(&options));
        let recording = simulation.run(*steps, |step| {
            let of = |solve: &Solve| solved(&entry, &options, solve);
            pairs.push(step.solves.iter().map(of).fold(Pair::default(), Pair::and));
            ControlFlow::Continue(())
        });
        let failure = recording.failure.map(|failure| failure.to_string());
        Ok((Run { scene: name, title, solver: solver.clone(), steps: pairs, failure }, ()))
    }
}

impl Plan {
    fn pairs(&self) -> Vec<(&Stepped, &String)> {
        let of = |at| self.solvers.iter().map(move |solver| (at, solver));
        self.scenes.iter().flat_map(of).collect()
    }
}

/// A problem of the simulation from where its solver started, and from 0.
fn solved(entry: &Entry, options: &Options, solve: &Solve) -> Pair {
    let lcp = &solve.problem.lcp;
    let run = |start: Start<'_>| {
        let mut work = Work::of(entry, lcp);
        let solution = (entry.build)(options).solve(lcp, &start, &mut work);
        (solution.iterations, work.multiplications, solution.status != Status::Solved)
    };
    let (warm, warm_work, missed) = run(Start::at(&solve.start));
    let (cold, cold_work, missed_too) = run(Start::default());
    let unsolved = usize::from(missed) + usize::from(missed_too);
    Pair { warm, cold, warm_work, cold_work, unsolved }
}

impl Default for Pair {
    fn default() -> Self {
        Pair { warm: 0, cold: 0, warm_work: 0.0, cold_work: 0.0, unsolved: 0 }
    }
}

impl Pair {
    fn and(self, other: Pair) -> Pair {
        Pair {
            warm: self.warm + other.warm,
            cold: self.cold + other.cold,
            warm_work: self.warm_work + other.warm_work,
            cold_work: self.cold_work + other.cold_work,
            unsolved: self.unsolved + other.unsolved,
        }
    }
}
