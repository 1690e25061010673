//! Runs an experiment: the stage that simulates and solves.

use std::time::Instant;

use indicatif::ProgressBar;
use rayon::prelude::*;

use super::experiment::Experiment;
use super::results::{Machine, Results, libraries};
use super::study::{
    comparison, convergence, cross_check, drift, merits, rates, sliding, sparsity, storage,
    verification, worst_cases,
};
use crate::error::Result;
use crate::scene::{Formulation, Scene};
use crate::solver::{Entry, entry};

/// Runs everything in the experiment. The results do not depend on the number of threads.
///
/// # Errors
/// If a scene cannot be loaded; all are loaded before anything runs. If a study that needs no scene
/// is given numbers that make no problem.
pub fn run(experiment: &Experiment, progress: &ProgressBar) -> Result<Results> {
    let start = Instant::now();
    let scenes = Scenes::load(experiment)?;
    let solvers = experiment.solvers.iter().map(|name| entry(name).copied());
    let solvers: Vec<Entry> = solvers.collect::<Result<_>>()?;
    progress.set_length(scenes.tasks(experiment) as u64);
    let mut timings = Vec::new();
    let mut comparisons = Vec::new();
    for (scene, task) in scenes.comparison.iter().zip(&experiment.comparison) {
        progress.set_message(format!("comparing solvers on {}", scene.name));
        let (comparison, times) = comparison::compare(scene, &solvers, task.steps, progress);
        comparisons.push(comparison);
        timings.extend(times);
    }
    let each = Each { progress };
    let verification =
        each.once("closed forms", &experiment.verification, |size| verification::run(*size, None))?;
    let drift = each.run("energy drift", &scenes.drift, &experiment.drift, |scene, task| {
        drift::run(scene, task.duration)
    });
    let checks =
        each.run("cross-checks", &scenes.cross_check, &experiment.cross_check, |scene, task| {
            cross_check::run(scene, task.step)
        });
    let convergence =
        each.run("convergence", &scenes.convergence, &experiment.convergence, |scene, task| {
            convergence::run(scene, task.step, &task.omegas)
        });
    let rates =
        each.once("rates", &experiment.rates, |task| rates::run(&task.bodies, &task.ratios))?;
    let worst_cases =
        each.once("worst cases", &experiment.worst_cases, |task| worst_cases::run(&task.sizes))?;
    let friction =
        each.once("friction", &experiment.friction, |task| sliding::run(task.mu, task.push))?;
    let merits = each.run("merits", &scenes.merits, &experiment.merits, |scene, task| {
        merits::run(scene, task.step)
    });
    let sparsity = each.run("sparsity", &scenes.sparsity, &experiment.sparsity, |scene, task| {
        sparsity::run(scene, task.step)
    });
    let storage = each.once("storages", &experiment.storage, storage::run)?;
    let storage_times = each.once("times of storages", &experiment.storage, storage::time::run)?;
    Ok(Results {
        version: env!("CARGO_PKG_VERSION").to_string(),
        libraries: libraries(),
        experiment: experiment.clone(),
        verification: verification.unwrap_or_default(),
        comparisons,
        cross_checks: checks.into_iter().flatten().collect(),
        convergence: convergence.into_iter().flatten().collect(),
        rates: rates.unwrap_or_default(),
        worst_cases,
        friction,
        merits: merits.into_iter().flatten().collect(),
        sparsity: sparsity.into_iter().flatten().collect(),
        drift,
        storage,
        machine: Machine {
            platform: format!("{} on {}", std::env::consts::OS, std::env::consts::ARCH),
            threads: rayon::current_num_threads(),
            seconds: start.elapsed().as_secs_f64(),
            timings,
            storage: storage_times,
        },
    })
}

/// Runs studies; one on each of its scenes in parallel, results in order.
struct Each<'a> {
    progress: &'a ProgressBar,
}

impl Each<'_> {
    fn run<T: Sync, R: Send>(
        &self,
        name: &'static str,
        scenes: &[Scene],
        tasks: &[T],
        study: impl Fn(&Scene, &T) -> R + Sync,
    ) -> Vec<R> {
        self.progress.set_message(name);
        let one = |(scene, task)| {
            let result = study(scene, task);
            self.progress.inc(1);
            result
        };
        scenes.par_iter().zip(tasks).map(one).collect()
    }

    /// Runs a study that needs no scene, if it is asked for.
    fn once<T, R>(
        &self,
        name: &'static str,
        task: &Option<T>,
        study: impl Fn(&T) -> Result<R>,
    ) -> Result<Option<R>> {
        let Some(task) = task else { return Ok(None) };
        self.progress.set_message(name);
        let result = study(task)?;
        self.progress.inc(1);
        Ok(Some(result))
    }
}

/// The scenes of each study, in the order of the experiment.
struct Scenes {
    comparison: Vec<Scene>,
    cross_check: Vec<Scene>,
    convergence: Vec<Scene>,
    merits: Vec<Scene>,
    sparsity: Vec<Scene>,
    drift: Vec<Scene>,
}

impl Scenes {
    fn load(experiment: &Experiment) -> Result<Self> {
        let load = |names: Vec<&str>| names.into_iter().map(Scene::load).collect::<Result<_>>();
        Ok(Scenes {
            comparison: load(experiment.comparison.iter().map(|t| t.scene.as_str()).collect())?,
            cross_check: load(experiment.cross_check.iter().map(|t| t.scene.as_str()).collect())?,
            convergence: load(experiment.convergence.iter().map(|t| t.scene.as_str()).collect())?,
            merits: load(experiment.merits.iter().map(|t| t.scene.as_str()).collect())?,
            sparsity: load(experiment.sparsity.iter().map(|t| t.scene.as_str()).collect())?,
            drift: load(experiment.drift.iter().map(|t| t.scene.as_str()).collect())?,
        })
    }

    fn tasks(&self, experiment: &Experiment) -> usize {
        self.comparison.len() * Formulation::LEVELS.len() * experiment.solvers.len()
            + usize::from(experiment.verification.is_some())
            + self.cross_check.len()
            + self.convergence.len()
            + usize::from(experiment.rates.is_some())
            + usize::from(experiment.worst_cases.is_some())
            + usize::from(experiment.friction.is_some())
            + 2 * usize::from(experiment.storage.is_some())
            + self.merits.len()
            + self.sparsity.len()
            + self.drift.len()
    }
}
