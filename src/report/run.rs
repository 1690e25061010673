//! Runs a report's studies: the stage that simulates and solves.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use rayon::prelude::*;

use super::experiment::Experiment;
use super::results::{Results, Task};
use crate::error::Result;

/// Results are saved no more often than this while the report runs.
const PAUSE: Duration = Duration::from_secs(1);

/// Runs every task that `earlier` results lack; `save` gets the results as they grow.
///
/// The findings do not depend on the number of threads. A task that fails is a row with its reason.
///
/// # Errors
/// If the results cannot be saved before the first task.
pub fn run(
    experiment: &Experiment,
    earlier: Option<&Results>,
    progress: &ProgressBar,
    save: &(dyn Fn(&Results) -> Result<()> + Sync),
) -> Result<Results> {
    let start = Instant::now();
    let mut results = Results::empty(experiment);
    if let Some(earlier) = earlier {
        results.resume(earlier);
    }
    save(&results)?;
    let missing = missing(&results);
    progress.set_length(missing.len() as u64);
    let growing = Growing { results: Mutex::new((results, Instant::now())), save };
    let one = |&(section, task): &(usize, usize)| {
        let Some(study) = &experiment.sections[section].study else { return };
        progress.set_message(format!("{}: {}", study.name(), growing.name(section, task)));
        let ended = study.run(task);
        growing.note(|results| results.note(section, task, ended));
        progress.inc(1);
    };
    let alone = |&(section, _): &(usize, usize)| {
        experiment.sections[section].study.as_ref().is_some_and(|study| study.alone())
    };
    let (timed, together): (Vec<_>, Vec<_>) = missing.into_iter().partition(alone);
    together.par_iter().for_each(one);
    timed.iter().for_each(one);
    let (mut results, _) = growing.results.into_inner().unwrap_or_else(PoisonError::into_inner);
    in_order(&mut results);
    results.machine.seconds = start.elapsed().as_secs_f64();
    Ok(results)
}

/// The places of the tasks that are not done: section and task.
fn missing(results: &Results) -> Vec<(usize, usize)> {
    let open = |tasks: &[Task]| -> Vec<usize> {
        (0..tasks.len()).filter(|&task| !tasks[task].is_over()).collect()
    };
    let sections = results.sections.iter().enumerate();
    sections.flat_map(|(s, part)| open(&part.tasks).into_iter().map(move |t| (s, t))).collect()
}

/// Times in the order of the report, whichever task ended first.
fn in_order(results: &mut Results) {
    let Results { sections, machine, .. } = results;
    let place = |section: &str, task: &str| {
        let s = sections.iter().position(|part| part.id == section);
        let t = s.and_then(|s| sections[s].tasks.iter().position(|other| other.name == task));
        (s, t)
    };
    machine.times.sort_by_key(|timed| place(&timed.section, &timed.task));
}

/// Results to which tasks add what they find out, saved now and then.
struct Growing<'a> {
    results: Mutex<(Results, Instant)>,
    save: &'a (dyn Fn(&Results) -> Result<()> + Sync),
}

impl Growing<'_> {
    fn name(&self, section: usize, task: usize) -> String {
        let held = self.results.lock().unwrap_or_else(PoisonError::into_inner);
        held.0.sections[section].tasks[task].name.clone()
    }

    fn note(&self, note: impl FnOnce(&mut Results)) {
        let mut held = self.results.lock().unwrap_or_else(PoisonError::into_inner);
        let (results, saved) = &mut *held;
        note(results);
        if saved.elapsed() >= PAUSE {
            // A disk that is full now may not be at the end, when a failure is reported.
            let _ = (self.save)(results);
            *saved = Instant::now();
        }
    }
}
